"""Section 4.1: reciprocity with non-symmetric distributions of normals, and Figures 6 to 8.

M is the integral of m D(m) dm. Opposite directions of travel differ in the cross-section by omega . M
(`xsec:reciprocity-odd`), so that over a way d the optical thickness is E - d . M / 2 there and E + d . M / 2 back. Here
E is any number, as large as |d . M| / 2 at least, since no thickness is negative. The section's equations are tested in
these terms, and its pictures on the distributions that they show. Its open question is answered in
`derivations/extensions/reciprocity.py`.
"""

from sympy import Function, Integral, Max, Ne, Rational, exp, oo, pi, sign, symbols, true

from derivations.extensions.reciprocity import (
    BOTH_WAYS,
    n,
    outside,
    reals,
    up_and_down,
)
from derivations.extensions.reciprocity_examples import facet_brdf, harmonic
from xsec_sym.exact import RingCrossSection, SigmaGGX
from xsec_sym.exact.reciprocity import dot
from xsec_sym.proof import Source, integers, interval

paper = Source("dupuy2016", section="4.1")

u, x, z, ell, alpha, tau = symbols("u x z ell alpha tau", real=True)
b, c = symbols("b c", real=True)
M_x, M_y, M_z = M = symbols("M_x M_y M_z", real=True)
E_1, E_2 = symbols("E_1 E_2", real=True)
m = symbols("m_x m_y m_z", real=True)
omega = symbols("omega_x omega_y omega_z", real=True)
r_1 = (0, 0, 0)  # the origin: only distances count
r_2, r_3 = (symbols(f"x_{i} y_{i} z_{i}", real=True) for i in (2, 3))

ROUGH = interval(alpha, 0, oo, open=True)
LONG = interval(ell, 0, oo)
ALONG = "the mean normal M is along the macroscopic normal, M = (0, 0, M_z), as for every distribution with azimuthal "
ALONG += "symmetry and every height field whose mean slope is 0"
VIEW = "GGX about the macroscopic normal; u is the cosine between -omega and the normal: u > 0 travels down"


def visibility(start, end, mean, area):
    """(11): exp(-l sigma), with l sigma = area - (end - start) . M / 2."""
    return exp(-(area - dot((e - s for s, e in zip(start, end, strict=True)), mean) / 2))


# --- mono-sided flakes, Figure 6 --------------------------------------------------------------------------

flake = paper.claim(
    "claim.figure-6.flake",
    "a flake with one side blocks light from that side, and lets light from the other side through",
    left=Max(0, -u) * Max(0, u),
    printed=0,
    where=[interval(u, -1, 1)],
    reading="D = delta at m, u = omega . m: of sigma(omega) = <-omega, m> and sigma(-omega) one is 0",
    statement=True,
)


@flake.proof
def one_side(step):
    for side in step.cases(u):
        side.settle()


def asymmetry(f, v):
    """1 where a function differs from its mirror image, 0 where it does not."""
    return sign((f - f.subs(v, -v)) ** 2)


density = (1 + c * (5 * x**3 - 3 * x) / 2) / (4 * pi)

paper.claim(
    "claim.figure-6.non-symmetric",
    "where D is not symmetric, the transport is not reciprocal",
    left=asymmetry(harmonic.form.subs(b, 0), u),
    printed=asymmetry(density, x),
    where=[interval(c, 0, 1, open="left"), *(interval(v, 0, Rational(1, 2), open=True) for v in (u, x))],
    reading="1 for yes, on D(x) = (1 + c P_3(x)) / (4 pi), per steradian, whose sigma is 1/4 from everywhere by "
    "xsec:reciprocity-harmonic. It takes more than asymmetry: sigma is symmetric exactly where M = 0",
    statement=True,
)

paper.whole(
    "claim.figure-6",
    "Figure 6: if D is not symmetric the flakes have one side, and the transport is not reciprocal",
    ["claim.figure-6.flake", "claim.figure-6.non-symmetric"],
    left=asymmetry(density, x),
)


# --- surface-like transport, Figure 7 -------------------------------------------------------------------

DOWN = [interval(u, 0, 1, open="left"), LONG]
FLAT = "D = delta at the macroscopic normal, so sigma = max(0, u) for the cosine u of -omega"


def flat(v):
    """deon2016 (7)."""
    return RingCrossSection(v, 1) / (2 * pi)


hit = paper.claim(
    "claim.figure-7.hit",
    "all light that enters the volume of a flat specular surface meets a flake",
    left=Integral(flat(u) / u * exp(-z * flat(u) / u), (z, 0, oo)),
    printed=1,
    where=[interval(u, 0, 1, open="left")],
    reading=FLAT + "; the chance of a first meeting at any depth z",
    statement=True,
)

escape = paper.claim(
    "claim.figure-7.escape",
    "after the first bounce it escapes, as it does from the surface",
    left=exp(-ell * flat(-u)),
    printed=1,
    where=DOWN,
    reading=FLAT + "; the light goes up, and its attenuation over any way ell is 1",
    statement=True,
)

double = paper.claim(
    "claim.figure-7.double-sided",
    "if the flakes had two sides it would meet them again before it leaves",
    left=exp(-ell * (flat(-u) + RingCrossSection(-u, -1) / (2 * pi))),
    printed=exp(-ell * u),
    where=DOWN,
    reading="D = delta at the normal and at its opposite; less than 1 for each ell > 0",
    statement=True,
)


def pole(step, *places):
    """A ring at the pole is one normal."""
    for v, up in places:
        step.lemma("deon2016:8.piecewise.rest", {symbols("u", real=True): v, symbols("u_n", real=True): up})
    return step.settle()


@hit.proof
def exponential(step):
    pole(step, (u, 1)).antiderivative(-exp(-z))


@escape.proof
def no_side_above(step):
    pole(step, (-u, 1))


@double.proof
def other_side(step):
    pole(step, (-u, 1), (-u, -1))


paper.whole(
    "claim.figure-7",
    "Figure 7: thanks to flakes with one side the volume of a flat mirror acts like the mirror",
    ["claim.figure-7.hit", "claim.figure-7.escape", "claim.figure-7.double-sided"],
    left=flat(u),
)


# --- non-reciprocal transport, (23) and Figure 8 --------------------------------------------------------

ratio = paper.claim(
    "23.ratio",
    "the visibility over that of the way back: 1 exactly where the way is orthogonal to M",
    left=visibility(r_1, r_2, M, E_1) / visibility(r_2, r_1, M, E_1),
    corrected=exp(dot((v - w for v, w in zip(r_2, r_1, strict=True)), M)),
    where=[*reals(*r_2, *M), interval(E_1, 0, oo)],
    reading=BOTH_WAYS,
)
ratio.proof(lambda step: None)

witness = paper.claim(
    "23.witness",
    "the visibility over that of the way back, for GGX: not 1 except along the horizon",
    left=exp(-ell * (SigmaGGX(u, alpha) - SigmaGGX(-u, alpha))),
    corrected=exp(-ell * u),
    where=[interval(u, -1, 1), ROUGH, LONG],
    reading=VIEW,
    reduces=["deon2016:25"],
)

areas = paper.claim(
    "claim.figure-8.areas",
    "Figure 8: the projected area is different for two opposite directions",
    left=SigmaGGX(u, alpha) - SigmaGGX(-u, alpha),
    printed=u,
    where=[interval(u, -1, 1), ROUGH],
    reading=VIEW,
    statement=True,
    reduces=["deon2016:25"],
)


@witness.proof
@areas.proof
def both_sides_of_ggx(step):
    viewer = symbols("u_i", real=True)
    step.lemma("deon2016:25", {viewer: u}).lemma("deon2016:25", {viewer: -u})


V = Function("V")
ends = symbols("r_1 omega_1 r_2", real=True)

paper.whole(
    "23",
    "in general the visibility is not reciprocal",
    ["23.ratio", "23.witness"],
    left=Ne(V(*ends), V(ends[2], -ends[1], ends[0])),
    printed=true,
    reading="in general: it is so for one D, GGX, and for any D over every way that is not orthogonal to M",
)

depth = paper.claim(
    "claim.depth",
    "what breaks the reciprocity inside is the change of depth, and nothing else",
    left=visibility(r_1, r_2, (0, 0, M_z), E_1) / visibility(r_2, r_1, (0, 0, M_z), E_1),
    printed=exp(M_z * (r_2[2] - r_1[2])),
    where=[*reals(*r_2, M_z), interval(E_1, 0, oo)],
    reading=BOTH_WAYS + ", if " + ALONG,
    statement=True,
)
depth.proof(lambda step: None)


# --- globally reciprocal, (24) --------------------------------------------------------------------------

level = (*r_3[:2], r_1[2])  # r_3 at the height of r_1


def there(mean):
    return visibility(r_1, r_2, mean, E_1) * visibility(r_2, level, mean, E_2)


def back(mean):
    return visibility(level, r_2, mean, E_2) * visibility(r_2, r_1, mean, E_1)


SPACE = [*reals(*r_2, *r_3[:2]), interval(E_1, 0, oo), interval(E_2, 0, oo)]

same = paper.claim(
    "24",
    "between points of one height the attenuation along a path is the same both ways",
    left=there((0, 0, M_z)),
    printed=back((0, 0, M_z)),
    where=[*SPACE, *reals(M_z)],
    reading=BOTH_WAYS + ", if " + ALONG + ". Of any other D see claim.equal-heights",
)

lateral = paper.claim(
    "24.lateral",
    "the same for any D: the lateral part of M counts, over the lateral distance of the end points",
    left=there(M) / back(M),
    corrected=exp(M_x * (r_3[0] - r_1[0]) + M_y * (r_3[1] - r_1[1])),
    where=[*SPACE, *reals(*M)],
    reading=BOTH_WAYS + "; the left side of (24) over its right side",
)

paper.claim(
    "claim.equal-heights",
    "the attenuation is the same both ways whenever the end points are at one height, whatever D",
    left=there(M),
    printed=back(M),
    where=[
        *(interval(v, -1, 1) for v in (*r_2, *r_3[:2], *M)),
        *(interval(v, 5, 6) for v in (E_1, E_2)),
    ],
    reading=BOTH_WAYS + ", E_1 and E_2 so large that no visibility is above 1. The text "
    "asks nothing of D; 24 says what it needs, and 24.lateral what holds without",
    statement=True,
)

same.proof(lambda step: None)
lateral.proof(lambda step: None)

above = paper.claim(
    "claim.outside",
    "so it is for a path of any number of segments that starts and ends outside",
    left=outside.left,
    printed=0,
    where=[integers(n, 1), *reals(M_z)],
    instances=up_and_down,
    reading="by how much the way back is thicker, as in xsec:reciprocity.if.path; " + ALONG,
    statement=True,
)
above.proof(lambda step: step.lemma(outside))


# --- the open question ----------------------------------------------------------------------------------

a = symbols("a", real=True)
p, q = symbols("p_x p_y", real=True), symbols("q_x q_y", real=True)
tilted = (m[0], 0, m[2])

paper.claim(
    "claim.height-field",
    "if D is a height field, the emerging transport is reciprocal",
    left=facet_brdf(tilted, p, q),
    printed=facet_brdf(tilted, q, p),
    where=[*reals(*p, *q, *m[::2]), interval(a, 0, 1, open="left"), dot((*p, 1), tilted) > 0, dot((*q, 1), tilted) > 0],
    reading="a height field as (17) defines it, D = delta(m) / m_z, m = (m_x, 0, m_z), with diffuse facets of albedo "
    "a: their whole BRDF, see xsec:reciprocity-facet. The statement holds for a "
    "height field whose mean slope is 0, that is, M along the macroscopic normal: xsec:reciprocity.if",
    statement=True,
)


def two_sided(into, out):
    """The denominator of single scattering for one flake and its opposite, seen under cosines over cos(theta)."""
    return sum(Max(0, side * into) + Max(0, -side * out) for side in (1, -1))


symmetric = paper.claim(
    "claim.symmetric",
    "if D is symmetric, the emerging transport is reciprocal",
    left=two_sided(b, c),
    printed=two_sided(c, b),
    where=reals(b, c),
    reading="flake by flake, each with its opposite: the denominator of single scattering with i and o swapped, b and "
    "c being i . m / cos(theta_i) and o . m / cos(theta_o). Of all orders it is xsec:reciprocity.if with M = 0, for "
    "a reciprocal micro-BSDF",
    statement=True,
)
symmetric.proof(lambda step: None)

for slug, title, because in (
    (
        "open-question",
        "can one determine the exact set of distributions such that the emerging transport is reciprocal?",
        "it asks; xsec:reciprocity.if and xsec:reciprocity.only-if answer: M parallel to the macroscopic normal",
    ),
    (
        "other-interpretation",
        "can rough surfaces be modelled otherwise than by flakes with one side?",
        "it asks; xsec:reciprocity-gauge has one way, flakes with two sides of half the area that scatter by the same "
        "sigma f_p, and xsec:reciprocity-balance the conditional probability that the text hopes for",
    ),
    (
        "information",
        "intuitively, the loss or gain of information with depth is what breaks the reciprocity",
        "an intuition; claim.depth and xsec:reciprocity-balance are what can be said in numbers",
    ),
    (
        "surface-like",
        "it is precisely because D is not symmetric that the transport can mimic a surface's",
        "a cause, of which claim.figure-7 shows an example; xsec:reciprocity-gauge has a medium with a symmetric "
        "extinction and the same emerging transport",
    ),
    (
        "voxels",
        "is it valid to have voxels with non-symmetric distributions?",
        "it asks what is valid; by xsec:reciprocity-path a bounded medium is reciprocal between all points of its "
        "surface only if M = 0",
    ),
):
    paper.out_of_scope(f"claim.{slug}", title, because=because)

if __name__ == "__main__":
    paper.tell()
