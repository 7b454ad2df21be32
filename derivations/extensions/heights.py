"""Smith's functions as inequalities and limits, and what a distribution of slopes shows to a direction.

Visibilities of one point in two directions fall together with its depth, so they are correlated: what is seen from one
side is seen from the other more often than if they were independent.
"""

from sympy import Function, Integral, Max, exp, oo, sqrt, symbols

from derivations.extensions.smith_link import LAMBDA_GGX, SPHEROID, u_i
from xsec_sym.exact import SigmaGGX
from xsec_sym.proof import Source, interval

project = Source("xsec", section="heights")

u, x, z, alpha, r, w = symbols("u x z alpha r w", real=True)
L_i, L_o = symbols("Lambda_i Lambda_o", real=True)
P = Function("P", real=True, nonnegative=True)
LAMBDAS = [interval(L_i, 0, oo), interval(L_o, 0, oo)]


def g1(lam):
    """dupuy2016 (20)."""
    return 1 / (1 + lam)


g2 = 1 / (1 + L_i + L_o)  # dupuy2016 (21)
SHARES = "Lambda >= 0; the masking function G1 and the masking-shadowing function G2 of dupuy2016 (20) and (21)"


# --- inequalities ---------------------------------------------------------------------------------------


def bound(label, title, greater, lesser, gap):
    claim = project.inequality(f"heights.{label}", title, greater, lesser, where=LAMBDAS, reading=SHARES)
    claim.proof(lambda step: step.fact(step.right, gap).settle())


bound("g2-below-g1", "masking and shadowing let less through than masking", g1(L_i), g2,
      L_o / ((1 + L_i) * (1 + L_i + L_o)))  # fmt: skip
bound("g2-above-product", "masking and shadowing let more through than both independently", g2, g1(L_i) * g1(L_o),
      L_i * L_o / ((1 + L_i) * (1 + L_o) * (1 + L_i + L_o)))  # fmt: skip
bound("g2-above-sum", "at most the sum of what either hides is hidden", g2, g1(L_i) + g1(L_o) - 1,
      L_i * L_o * (2 + L_i + L_o) / ((1 + L_i) * (1 + L_o) * (1 + L_i + L_o)))  # fmt: skip
bound("conditional-above-g1", "what is seen from one direction is seen from another more often than any point",
      g2 / g1(L_i), g1(L_o), L_i * L_o / ((1 + L_o) * (1 + L_i + L_o)))  # fmt: skip
bound("conditional-below-1", "shadowing given masking is a share", 1, g2 / g1(L_i), L_o / (1 + L_i + L_o))


# --- from a distribution of normals to its masking function ---------------------------------------------

across = sqrt(1 - x**2) / x  # the slope of a facet whose normal has the cosine x
sin_theta = sqrt(1 - u**2)

slopes = project.claim(
    "heights.slopes",
    "what the facets show to a direction, over their normals and over their slopes, azimuth by azimuth",
    left=Integral(Max(0, u * x - sin_theta * sqrt(1 - x**2) * w) * P(across) / x**4, (x, 0, 1)),
    corrected=Integral(r * Max(0, u - sin_theta * w * r) * P(r), (r, 0, oo)),
    where=[interval(u, -1, 1), interval(w, -1, 1)],
    instances={P: (lambda v: exp(-(v**2)), lambda v: exp(-v), lambda v: 1 / (1 + v**2) ** 3)},
    reading="D = P / x^4 per steradian for x = cos(theta_m) > 0 and none below, P being the density of slopes, with "
    "r the steepness and w the cosine of its azimuth: the surface rises by w r towards the direction. The integral of "
    "P over the slopes across the ray is the P(q) of dupuy2016 (18)",
)


@slopes.proof
def steepness_by_inclination(step):
    step.fact(1 - x**2, (1 - x) * (1 + x), inside=(x, 0, 1))
    step.swap().substitute(x, across, 1, 0)


masking = project.claim(
    "heights.masking.ggx",
    "the half-space of GGX flakes masks like Smith's surface: 1 / (1 + Lambda)",
    left=Integral(exp(z) * exp(SigmaGGX(-u, alpha) / u * z), (z, -oo, 0)),
    corrected=1 / (1 + LAMBDA_GGX),
    where=[interval(u, 0, 1, open="left"), interval(alpha, 0, oo, open=True)],
    reading="D per steradian, with unit projected area; exp(sigma(omega) z / cos(theta)) is the visibility from the "
    "height z, whose density is exp(z)",
    reduces=["deon2016:25"],
)


@masking.proof
def exponential_in_the_height(step):
    rate = (1 + sqrt(alpha**2 * (1 - u**2) + u**2) / u) / 2
    step.fact(*SPHEROID)
    step.lemma("deon2016:25", {u_i: -u})
    step.antiderivative(exp(rate * z) / rate)


if __name__ == "__main__":
    project.tell()
