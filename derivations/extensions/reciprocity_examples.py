"""Distributions of normals that are, or are not, reciprocal when seen from outside: `reciprocity.py` tried.

Not reciprocal: tilted facets, although they are a height field with unit projected area; any height field whose mean
slope is not 0. Reciprocal, although neither symmetric nor a height field: the spherical Gaussian about the macroscopic
normal. Not symmetric, and yet with a symmetric cross-section: the third harmonic.
"""

from sympy import Integral, Max, Rational, cos, erf, exp, oo, pi, sin, sqrt, symbols, tan

from derivations.deon2016.cells import CLOSED, u, x
from derivations.deon2016.table1 import p as power
from derivations.extensions.reciprocity import m, omega, reals
from derivations.kenha2018.surface import ANGLE, AROUND, on_the_sphere, reflected, theta
from xsec_sym.exact import RingCrossSection, SigmaSphericalGaussian
from xsec_sym.exact.reciprocity import dot, opposite
from xsec_sym.proof import Source, interval

project = Source("xsec", section="reciprocity, examples")

albedo, tilt, alpha, b, c, c_i, c_o, p_0, slope = symbols("a tau alpha b c c_i c_o p_0 p", real=True)
p, q = symbols("p_x p_y", real=True), symbols("q_x q_y", real=True)
ALBEDO = interval(albedo, 0, 1, open="left")


# --- one tilted facet -----------------------------------------------------------------------------------


def facet_brdf(normal, lateral_in, lateral_out):
    """All flakes alike and diffuse; i / cos = (lateral_in, 1), o / cos = (lateral_out, 1)."""
    into, out = dot((*lateral_in, 1), normal), dot((*lateral_out, 1), normal)
    scattered = albedo / pi * Max(0, into) * Max(0, out)
    return scattered / (Max(0, into) + Max(0, -out))


tilted = (m[0], 0, m[2])  # the first axis is the one that the normal leans to

facet = project.claim(
    "reciprocity-facet",
    "diffuse flakes that all face m: the BRDF is a / pi times o . m / cos(theta_o), which is not reciprocal",
    left=facet_brdf(tilted, p, q),
    corrected=albedo / pi * dot((*q, 1), tilted),
    where=[*reals(*p, *q, *m[::2]), ALBEDO, dot((*p, 1), tilted) > 0, dot((*q, 1), tilted) > 0],
    reading="m = (m_x, 0, m_z). The left side is K / (c_i c_o) over the denominator of xsec:reciprocity-single. It is "
    "the whole BRDF: sigma(o) = <-o, m> = 0, so that light which a flake has scattered meets no other. D = delta(m) / "
    "m_z is a height field with unit projected area, dupuy2016 (17)",
)

numbers = project.claim(
    "reciprocity-facet.numbers",
    "from the macroscopic normal to a facet's, over the way back: 1 / cos^2 of the tilt, 25/16 where it is 4/5",
    left=facet_brdf((sin(tilt), 0, cos(tilt)), (0, 0), (tan(tilt), 0))
    / facet_brdf((sin(tilt), 0, cos(tilt)), (tan(tilt), 0), (0, 0)),
    corrected=1 / cos(tilt) ** 2,
    where=[interval(tilt, 0, pi / 2, open=True), ALBEDO],
    reading="the facet of xsec:reciprocity-facet, m = (sin, 0, cos) of the tilt tau",
)

facet.proof(lambda step: None)
numbers.proof(lambda step: None)


# --- height fields --------------------------------------------------------------------------------------

bell = exp(-((slope - p_0) ** 2) / alpha**2)
sheared = project.claim(
    "reciprocity-height-field",
    "the lateral part of M is the mean slope: Beckmann's slopes, sheared by p_0",
    left=Integral(-slope * bell / (alpha * sqrt(pi)), (slope, -oo, oo)),
    corrected=-p_0,
    where=[interval(p_0, -oo, oo), interval(alpha, 0, oo, open=True)],
    reading="m D dm = (-p, -q, 1) P(p, q) dp dq, so M = (-mean p, -mean q, 1): a height field is reciprocal for every "
    "micro-BSDF exactly where its mean slope is 0",
)
sheared.proof(lambda step: step.antiderivative(alpha / (2 * sqrt(pi)) * bell - p_0 / 2 * erf((slope - p_0) / alpha)))


# --- neither symmetric nor a height field ---------------------------------------------------------------


def opposites(v):
    """Half of what opposite directions differ by, over the cosine."""
    return (SigmaSphericalGaussian(v, alpha) - SigmaSphericalGaussian(-v, alpha)) / 2 / v


gaussian = project.claim(
    "reciprocity-gaussian",
    "the spherical Gaussian about the macroscopic normal is reciprocal: i and o may be swapped",
    left=opposites(c_i) - opposites(c_o),
    corrected=0,
    where=[*(interval(v, 0, 1, open="left") for v in (c_i, c_o)), interval(alpha, Rational(1, 2), oo)],
    reading="half of what the swap takes off the denominator of single scattering. It is positive below the horizon, "
    "and not symmetric: xsec:sg-odd gives sigma(u) - sigma(-u) = (coth kappa - 1 / kappa) u, so M is along the normal",
    reduces=("xsec:sg-positive",),
)


@gaussian.proof
def linear_in_the_cosine(step):
    for cosine in (c_i, c_o):
        step.lemma("xsec:sg-odd", {u: cosine})


third = (5 * x**3 - 3 * x) / 2
ring = RingCrossSection(x, u) / (4 * pi)

harmonic = project.claim(
    "reciprocity-harmonic",
    "of a third harmonic the cross-section shows nothing: with b = 0 D is not symmetric, sigma = 1/4 is",
    left=Integral(ring * (1 + b * x + c * third), (x, -1, 1)),
    corrected=Rational(1, 4) + b * u / 6,
    where=[interval(u, -1, 1), *reals(b, c)],
    reading="per steradian, unit mass; D = (1 + b x + c P_3(x)) / (4 pi) is nowhere negative for b = 0 and |c| <= 1",
    reduces=CLOSED,
)


@harmonic.proof
def rows_of_the_table(step):
    step.linear(ring, ring * (b - 3 * c / 2) * x, ring * 5 * c / 2 * x**3)
    step.lemma("deon2016:T1.1.s").lemma("deon2016:T1.u.s").lemma("deon2016:T1.odd.s", {power: 3})


# --- mirrors --------------------------------------------------------------------------------------------

mirror = project.claim(
    "reciprocity-mirror",
    "for mirrors sigma f_p is D / 4 at the half vector of i and o, which is the same both ways",
    left=cos(theta) * sin(theta) / on_the_sphere(reflected),
    corrected=Rational(1, 4),
    where=[ANGLE, AROUND],
    reading="K d omega_o = <i, m> D(m) d omega_m; where a reflectance depends on the angle of incidence, i . m = o . m",
)
mirror.proof(lambda step: None)

bounce = dot(opposite(omega), m)
down = project.inequality(
    "reciprocity-proviso.down",
    "a mirror that faces down sends light down: the height of its direction of travel never rises",
    greater=omega[2],
    lesser=2 * bounce * m[2] + omega[2],
    where=[*reals(*omega, *m[:2]), interval(m[2], -oo, 0), bounce >= 0],
    reading="omega after the reflection is omega + 2 (-omega . m) m. Nothing emerges from such a medium, so it is "
    "reciprocal whatever its M: the proviso of xsec:reciprocity.only-if is needed",
)
down.proof(lambda step: step.settle())

if __name__ == "__main__":
    project.tell()
