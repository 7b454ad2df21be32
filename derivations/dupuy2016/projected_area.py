"""Section 3.2: height fields, and what ties their projected area to Smith's Lambda, (17)-(19).

A direction with the cosine cos(theta) is written u here where slopes are involved. Light that travels along omega meets
the facets with omega . omega_m < 0, so sigma(omega_i), for light on its way out, counts the facets that face away from
omega_i, and sigma(-omega_i), for light on its way in, those that face it.

A facet whose surface rises by q towards omega_i shows it the cosine u - s q, s = sin(theta), per unit of macroscopic
area. So with P(q) the distribution of slopes along the ray, sigma(-omega_i) is the integral of max(0, u - s q) P(q),
and sigma(omega_i) that of max(0, s q - u) P(q): see xsec:heights.slopes.
"""

from sympy import Function, Integral, Max, exp, oo, pi, sqrt, symbols

from xsec_sym.exact import NormalsBeckmann, NormalsGGX, ahead, behind
from xsec_sym.exact.smith import COSINE
from xsec_sym.proof import Source, interval

paper = Source("dupuy2016", section="3.2")

u, q, x, alpha = symbols("u q x alpha", real=True)
a, b, m, q_0 = symbols("a b m q_0", real=True)
c_i = symbols("c_i", real=True)  # cos(theta_i)

P = Function("P", real=True, nonnegative=True)
A = Function("A", real=True, nonnegative=True)
SLOPES = {P: (lambda v: exp(-(v**2)), lambda v: 1 / (1 + v**2) ** 2, lambda v: exp(-(v**2) - v))}
FACETS = {A: (lambda v: exp(v), lambda v: (1 + v) ** 2, lambda v: 1 / (2 - v))}

s = sqrt(1 - u**2)
mu = u / s
ROUGH = interval(alpha, 0, oo, open=True)
UPWARD = interval(u, 0, 1, open=True)
WITHIN = interval(b, 0, oo, open=True)
AREA = "D per steradian, with unit projected area"
AROUND = "A(c) is D summed over the azimuths about omega_i, c = omega_i . omega_m; so D is any distribution"
ALONG = "P(q): the distribution of the surface's slopes q towards omega_i, any one"


# --- the height field -----------------------------------------------------------------------------------

D = Function("D", real=True)
omega = symbols("omega_m", real=True)
omega_i = symbols("omega_i", real=True)
facing_up = symbols("(omega_m.omega_g)", real=True)
dot = symbols("(omega_i.omega_m)", real=True)
sigma, Lam = Function("sigma"), Function("Lambda")

paper.definition(
    "17",
    "a height field's distribution of normals",
    left=Integral(D(omega) * Max(0, facing_up), omega),
    printed=1,
    reading="over the whole sphere, D per steradian and 0 in the hemisphere away from omega_g; it is a condition on D",
)

for name, normals, proven in (
    ("beckmann", NormalsBeckmann, "deon2016:19.norm"),
    ("ggx", NormalsGGX, "deon2016:24.norm"),
):
    paper.claim(
        f"17.{name}",
        f"the distribution of {name} meets the condition",
        left=Integral(2 * pi * x * normals(x, alpha), (x, -1, 1)),
        corrected=1,
        where=[ROUGH],
        reading=AREA,
    ).proof(lambda step, proven=proven: step.lemma(proven))


# --- Lambda ---------------------------------------------------------------------------------------------

SHADOWED = Integral((q - mu) * P(q), (q, mu, oo)) / mu  # Smith's Lambda

paper.definition(
    "18.1",
    "the projected area for light on its way out, by (4)",
    left=sigma(omega_i),
    printed=Integral(Max(0, -dot) * D(omega), omega),
)

out = paper.claim(
    "18.2",
    "the projected area for light on its way out is Lambda cos(theta_i)",
    left=Integral(Max(0, s * q - u) * P(q), (q, -oo, oo)),
    printed=u * SHADOWED,
    where=[UPWARD],
    instances=SLOPES,
    reading=ALONG + ". Smith's Lambda is 1 / mu times the integral of (q - mu) P(q) over q > mu = cot(theta_i)",
)


def at_the_horizon_slope(step):
    """s q - u changes its sign where q = u / s."""
    step.fact(1 - u**2, (1 - u) * (1 + u))
    step.fact(s * q - u, -(mu - q) * s, inside=(q, -oo, mu))
    step.fact(s * q - u, (q - mu) * s, inside=(q, mu, oo))


@out.proof
def slopes_that_rise_above_the_ray(step):
    at_the_horizon_slope(step)
    step.split(mu).linear(s * (q - mu) * P(q))


paper.whole(
    "18",
    "the projected area for light on its way out",
    ["18.1", "18.2"],
    left=sigma(omega_i),
    printed=Lam(omega_i) * c_i,
)


# --- the other side -------------------------------------------------------------------------------------

paper.definition(
    "19.1",
    "the projected area for light on its way in, by (4)",
    left=sigma(-omega_i),
    printed=Integral(Max(0, dot) * D(omega), omega),
)

moment = paper.claim(
    "19.moment",
    "the two projected areas differ by omega . M, M the sum of all normals",
    left=ahead(A) - behind(A),
    corrected=Integral(COSINE * A(COSINE), (COSINE, -1, 1)),
    instances=FACETS,
    reading=AROUND + "; omega . M is the integral of (omega . omega_m) D over the sphere",
)

both = paper.claim(
    "19.general",
    "the projected area for light on its way in, for any slopes",
    left=Integral(Max(0, m - q) * P(q), (q, -b, b)),
    corrected=m * Integral(P(q), (q, -b, b))
    - Integral(q * P(q), (q, -b, b))
    + Integral(Max(0, q - m) * P(q), (q, -b, b)),
    where=[interval(m, 0, oo), WITHIN],
    instances=SLOPES,
    reading=ALONG + ", up to a steepness b; m = cot(theta_i), and both sides are over sin(theta_i). With unit area "
    "(17) and mean slope 0 this is (19), the last term being Lambda cos(theta_i) over sin(theta_i)",
)


@moment.proof
@both.proof
def positive_and_negative_part(step):
    """max(0, y) - max(0, -y) = y."""


# Every distribution with mean 0 mixes pairs of slopes with mean 0, and both sides are linear in it.
PAIR = (b / (a + b), -a), (a / (a + b), b)
BALANCED = "one pair of slopes -a and b, with the weights that give mean slope 0: M = omega_g. Every such height field "
BALANCED += "mixes such pairs along each ray, and both sides are linear in D"

inward = paper.claim(
    "19.2",
    "the projected area for light on its way in is (1 + Lambda) cos(theta_i)",
    left=sum(w * Max(0, m - p) for w, p in PAIR),
    printed=(1 + sum(w * Max(0, p - m) / m for w, p in PAIR)) * m,
    where=[interval(m, 0, oo, open=True), interval(a, 0, oo, open=True), WITHIN],
    reading=BALANCED + "; m = mu = cot(theta_i), and both sides are over sin(theta_i)",
)


@inward.proof
def each_side_of_the_ray(step):
    for branch in step.cases(b - m, b, m):
        branch.settle().swap().settle()


paper.whole(
    "19",
    "the projected area for light on its way in",
    ["19.1", "19.2"],
    left=sigma(-omega_i),
    printed=(1 + Lam(omega_i)) * c_i,
    reading="where the sum of all normals is omega_g; by 19.moment it holds for every omega_i only then",
)

tilted = paper.claim(
    "claim.condition-suffices",
    "(17) and a height field's normals are enough for (19)",
    left=Max(0, u - s * q_0),
    printed=u + Max(0, s * q_0 - u),
    where=[UPWARD, interval(q_0, -oo, oo)],
    reading="tried on a single facet with the slope q_0 towards omega_i and the weight 1 / cos(theta_m), which (17) "
    "asks for: M is then omega_g minus the slope, and (19) fails unless q_0 = 0",
    statement=True,
)

one_facet = paper.claim(
    "19.tilted",
    "a single facet of the slope q_0: what (19) lacks is sin(theta_i) q_0",
    left=Max(0, u - s * q_0),
    corrected=u + Max(0, s * q_0 - u) - s * q_0,
    where=[interval(u, 0, 1), interval(q_0, -oo, oo)],
    reading="it meets (17), and has the mean slope q_0",
)
one_facet.proof(positive_and_negative_part)

level = paper.claim(
    "claim.symmetric-volume",
    "only a non-symmetric distribution can act like a surface: a symmetric one has the same area from both sides",
    left=ahead(lambda c: A(c) + A(-c)),
    corrected=behind(lambda c: A(c) + A(-c)),
    instances=FACETS,
    reading=AROUND + "; by (18) and (19) a surface needs sigma(-omega_i) - sigma(omega_i) = cos(theta_i)",
    statement=True,
)


@level.proof
def mirror_image(step):
    step.swap().substitute(x, -x, 1, -1)


if __name__ == "__main__":
    paper.tell()
