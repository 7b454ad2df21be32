"""Smith's functions as inequalities and limits, and what a distribution of slopes shows to a direction.

Visibilities of one point in two directions fall together with its depth, so they are correlated: what is seen from one
side is seen from the other more often than if they were independent.
"""

from sympy import Function, Integral, Max, cos, exp, oo, pi, sin, sqrt, symbols

from derivations.extensions.smith_link import LAMBDA_BECKMANN, LAMBDA_GGX, SPHEROID, u_i
from xsec_sym.exact import SigmaBeckmann, SigmaGGX
from xsec_sym.proof import Source, interval

project = Source("xsec", section="heights")

u, z, alpha, r, phi, p, q = symbols("u z alpha r phi p q", real=True)
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


def masked(name, sigma, closed, form, high):
    claim = project.claim(
        f"heights.{name}.masking",
        f"the half-space of {name} flakes masks like Smith's surface: 1 / (1 + Lambda)",
        left=Integral(exp(z + sigma(-u, alpha) / u * z), (z, -oo, 0)),
        corrected=1 / (1 + form.subs({}, simultaneous=True)),
        where=[interval(u, 0, 1, open=high), interval(alpha, 0, oo, open=True)],
        reading="D per steradian, with unit projected area; exp(sigma(omega) z / cos(theta)) is the visibility from the "
        "height z, whose density is exp(z)",
        reduces=[closed],
    )

    @claim.proof
    def by_the_closed_cross_section(step):
        step.fact(*SPHEROID)
        step.lemma(closed, {u_i: -u})
        rate = step.left.function.args[0].coeff(z)
        step.antiderivative(step.left.function / rate)


if __name__ == "__main__":
    project.tell()
