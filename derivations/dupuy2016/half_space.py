"""Section 4.2: the isotropic half-space, from its single scattering to Chandrasekhar's H function.

Depth z >= 0 grows into the medium; light comes in under the cosine mu_i and leaves under mu_o, both positive. The
projected area sigma is the same from everywhere. A beam that brings unit irradiance to the surface collides between z
and z + dz with the probability sigma / mu_i exp(-sigma z / mu_i) dz, and the light sent towards mu_o survives the way
out with exp(-sigma z / mu_o): nothing else is assumed of the single scattering.

H is tested against both of its definitions: the Wiener-Hopf factor of K(t) = 1 - a arctan(t) / t, and the integral
equation H(u) [1 - a u / 2 integral of H(v) / (u + v) over v from 0 to 1] = 1 that follows from invariance.
"""

from sympy import Integral, Rational, atan, cos, exp, log, oo, pi, sin, symbols

from derivations.extensions.isotropic_half_space import below, tau
from xsec_sym.exact import HIsotropic, HTransform, RingCrossSection, wiener_hopf
from xsec_sym.proof import Source, interval

paper = Source("dupuy2016", section="4.2")

mu_i, mu_o = symbols("mu_i mu_o", real=True)  # cos(theta_i) and cos(theta_o)
a, beta, c, f_p, sigma, z, u, t, x, y, phi = symbols("a beta c f_p sigma z u t x y phi", real=True)

COSINES = [interval(mu_i, 0, 1, open="left"), interval(mu_o, 0, 1, open="left")]
AREA = interval(sigma, 0, oo, open=True)
ALBEDO = interval(a, 0, 1, open="left")
BOTH = "mu_i = cos(theta_i), mu_o = cos(theta_o)"
FREE = "; sigma is free, so that the paper's sigma = 1 is one case of many"

collision = sigma / mu_i * exp(-sigma * z / mu_i)
way_out = exp(-sigma * z / mu_o)
visible = Integral(collision * way_out, (z, 0, oo))  # given that the point was reached from mu_i


# --- single scattering ------------------------------------------------------------------------------------

paper.out_of_scope(
    "claim.stochastic",
    "the multiple scattering of the Smith model must be evaluated stochastically, which is unusual for parametric "
    "microfacet models and common for subsurface scattering",
    because="a remark on what is known and usual; that no deterministic evaluation is known refutes none",
)

brdf = paper.claim(
    "25",
    "the single-scattering BRDF of an isotropic half-space",
    left=Integral(collision * a / (4 * pi) * way_out / mu_o, (z, 0, oo)),
    printed=a / (4 * pi * mu_i + mu_o),
    corrected=a / (4 * pi * (mu_i + mu_o)),
    edit="put brackets about cos(theta_i) + cos(theta_o): 4 pi multiplies both",
    where=[*COSINES, ALBEDO, AREA],
    reading=BOTH + "; radiance that leaves, over irradiance" + FREE,
)

chain = paper.claim(
    "26",
    "the cosine-weighted BRDF is the phase function times the shadowing given the masking",
    left=mu_o * Integral(collision * f_p * way_out / mu_o, (z, 0, oo)),
    printed=f_p * visible,
    where=[*COSINES, AREA, interval(f_p, 0, oo)],
    reading=BOTH + "; f_p contains the albedo, as in (27); the condition is that the path from outside along omega_1 "
    "has its collision at r, so that r has the depth of a free path, as with (22), and not that of a random point",
)


phase = paper.claim(
    "27",
    "the isotropic phase function of albedo a",
    left=a / (Integral(1, (x, -1, 1)) * Integral(1, (phi, 0, 2 * pi))),
    printed=a / (4 * pi),
    where=[ALBEDO],
    reading="per steradian; with (27) the albedo is in f_p, while the f_p of (5) is a probability density",
)

conditional = paper.claim(
    "28",
    "the shadowing given the masking",
    left=visible,
    printed=1 / (1 + mu_o / mu_i),
    corrected=1 / (1 + mu_i / mu_o),
    edit="exchange theta_o and theta_i, as (22) has them",
    where=[*COSINES, AREA],
    reading=BOTH + "; the point r has the depth of a free path that came along omega_1" + FREE,
)

weighted = paper.claim(
    "29",
    "the cosine-weighted single-scattering BRDF",
    left=mu_o * Integral(collision * a / (4 * pi) * way_out / mu_o, (z, 0, oo)),
    printed=a / (4 * pi) / (1 + mu_o / mu_i),
    corrected=a / (4 * pi) / (1 + mu_i / mu_o),
    edit="exchange theta_o and theta_i, as in (28)",
    where=[*COSINES, ALBEDO, AREA],
    reading=BOTH + FREE,
)

paper.claim(
    "claim.29-gives-25.printed",
    "(29) over cos(theta_o) is (25), both as they are printed",
    left=a / (4 * pi) / (1 + mu_o / mu_i) / mu_o,
    printed=a / (4 * pi * mu_i + mu_o),
    where=[*COSINES, ALBEDO],
    statement=True,
    reading=BOTH,
)

mended = paper.claim(
    "claim.29-gives-25",
    "(29) over cos(theta_o) is (25), both as they are mended",
    left=weighted.corrected / mu_o,
    corrected=brdf.corrected,
    where=[*COSINES, ALBEDO],
    statement=True,
    reading=BOTH + "; with the brackets of (25) alone the statement would still fail: (29) as printed is not "
    "reciprocal once it is divided by cos(theta_o)",
)
mended.proof(lambda step: step.close())


@brdf.proof
@chain.proof
@conditional.proof
@weighted.proof
def one_exponential(step):
    """The two attenuations are one exponential of the depth, so that the integrand is its own primitive's multiple."""
    rate = sigma * (1 / mu_i + 1 / mu_o)
    step.antiderivative(-step.integrals[0].function / rate).swap()
    if step.left.has(Integral):
        step.antiderivative(-step.integrals[0].function / rate)


@phase.proof
def whole_sphere(step):
    step.antiderivative(x, step.over(-1, 1)).antiderivative(phi, step.over(0, 2 * pi))


# --- mirrors ----------------------------------------------------------------------------------------------

seen = Integral(2 * pi * sin(y) * cos(y) * c, (y, 0, pi / 2))  # the projected area of D = c

mirror = paper.claim(
    "claim.isotropic-mirror",
    "mirror flakes with a constant D scatter alike in all directions",
    left=c * cos(beta) / seen / (4 * cos(beta)),
    corrected=1 / (4 * pi),
    where=[interval(beta, 0, pi / 2, open=True), interval(c, 0, oo, open=True)],
    statement=True,
    reading="(5) with D = c of any size: a flake inclined by beta to the light is met with the density (6), and "
    "the solid angle of the reflected light is 4 cos(beta) times that of the normals (kenha2018:4.reflected); see also "
    "xsec:flakes.mirror.share",
)
mirror.proof(lambda step: step.antiderivative(pi * c * sin(y) ** 2))


# --- the projected area ------------------------------------------------------------------------------------

constant = paper.claim(
    "claim.sigma-one",
    "the projected area of an isotropic medium is constant, and it is 1 for D = 1 / pi",
    left=Integral(RingCrossSection(x, u) / pi, (x, -1, 1)),
    corrected=1,
    where=[interval(u, -1, 1)],
    statement=True,
    reduces=("deon2016:9", "deon2016:10", "deon2016:11", "deon2016:12"),
    reading="D per steradian; four times the D of unit mass, whose projected area is 1/4 (xsec:isotropic). Neither "
    "(28) nor (29) depends on it: sigma only sets the unit of depth",
)
constant.proof(lambda step: step.linear(RingCrossSection(x, u) / pi).lemma("deon2016:T1.1.s"))


# --- all orders of scattering ------------------------------------------------------------------------------

COT = "the logarithm of both sides; cot is written as cos / sin"
cotangent = cos(t) / sin(t)
exponent = -u / pi * Integral(log(1 - t * a * cotangent) / (u**2 * sin(t) ** 2 + cos(t) ** 2), (t, 0, pi / 2))
REACH = interval(u, 0, 20, open="left")
ABSORBING = interval(a, 0, Rational(99, 100), open="left")


def amplified(mu):
    """What invariance makes of H: the light at the surface in a direction, for each unit that comes from outside."""
    return 1 / (1 - a * mu / 2 * HTransform(mu, a))


paper.claim(
    "30",
    "the BRDF of the isotropic half-space, all orders of scattering together",
    left=a / (4 * pi) * amplified(mu_i) * amplified(mu_o) / (mu_i + mu_o),
    printed=a / (4 * pi) * HIsotropic(mu_i, a) * HIsotropic(mu_o, a) / (mu_i + mu_o),
    where=[*COSINES, ALBEDO],
    reading=BOTH + "; a layer on top changes nothing, so that 4 pi (mu_i + mu_o) f_r is a N(mu_i) N(mu_o) with "
    "N(mu) = 1 + 2 pi mu times the integral of f_r over the other cosine (Ambartsumian). With f_r as printed, "
    "N = 1 + a mu / 2 N times the integral of N(v) / (mu + v): the left side is f_r by this N, with the H of the "
    "right side under its integral",
)

factor = paper.claim(
    "31.factor",
    "the closed form of H is the Wiener-Hopf factor of the transport equation",
    left=wiener_hopf(u, a).args[0],
    printed=exponent,
    where=[interval(u, 0, oo, open=True), ALBEDO],
    reading="the factor of 1 / K, K(t) = 1 - a arctan(t) / t, that has neither zeros nor poles for Re u > 0; at a = 1 "
    "the logarithm is infinite at t = 0, and integrable; " + COT,
)

paper.claim(
    "31.equation",
    "the closed form of H solves Chandrasekhar's integral equation",
    left=log(amplified(u)),
    printed=exponent,
    where=[REACH, ABSORBING],
    reading="H(u) (1 - a u / 2 times the integral of H(v) / (u + v)) = 1 with H by the closed form, under the integral "
    "too. For a < 1 the equation has a second solution, with a pole at u > 1; the closed form is bounded; " + COT,
)

paper.claim(
    "31.equation.conservative",
    "the same with little absorption or none",
    left=amplified(u),
    printed=HIsotropic(u, a),
    where=[REACH, interval(a, Rational(99, 100), 1)],
    reading="H is enclosed by the factor of 31.factor, under the integral too, since the logarithm that diverges at "
    "a = 1 leaves the closed form no enclosure; its digits on the second route are those of the closed form",
)

paper.whole(
    "31",
    "a closed form of Chandrasekhar's H function",
    ["31.factor", "31.equation", "31.equation.conservative"],
    left=HIsotropic(u, a),
    printed=exp(exponent),
    reading="proved to be the Wiener-Hopf factor, and confirmed to solve the integral equation, for 0 < a <= 1 and "
    "u > 0, also beyond 1; cot is written as cos / sin",
)


@factor.proof
def tangent(step):
    """t = arctan(tau): sin and cos become algebraic."""
    step.swap().substitute(tau, atan(tau), 0, oo)
    parts = (tau**3 / (3 * (1 + tau**2)), below.left, (1 - a) * atan(tau))
    step.fact(tau - a * atan(tau), *parts, inside=(tau, 0, oo), by=below, mapping={tau: tau})


paper.out_of_scope(
    "claim.plane-parallel",
    "averaging lateral displacements, a plane-parallel analysis, is common and simpler than a BSSRDF",
    because="a remark on methods; the BRDF that it gives is (30)",
)
paper.out_of_scope(
    "claim.other-methods",
    "(30) also follows from singular eigenfunctions or from the Wiener-Hopf method; both have been used for "
    "anisotropic media, where the discrete eigenvalues are no longer paired and the diffusion is advected",
    because="reports of other works, about media that this text does not define; the factor itself is 31.factor",
)
paper.out_of_scope(
    "claim.4.2-open-questions",
    "deterministic methods may serve for rough surfaces, and non-symmetric cross-sections are worth including",
    because="questions and plans of work",
)

if __name__ == "__main__":
    paper.tell()
