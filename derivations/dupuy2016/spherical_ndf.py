"""Section 4.3 and figures 9 to 12: normals on the whole sphere, from a flat mirror to an isotropic medium.

The section asks for a family of distributions and names none. The spherical Gaussian of deon2016, with alpha = m, is
one that meets all three wishes; they are tested on it.
"""

from sympy import Integral, Matrix, Rational, coth, exp, oo, pi, sqrt, symbols

from xsec_sym.exact import SigmaSphericalGaussian, beckmann, ggx, spherical_gaussian
from xsec_sym.proof import Source, interval

paper = Source("dupuy2016", section="4.3")

alpha, b, u, v, x, y = symbols("alpha b u v x y", real=True)
kappa = 2 / alpha**2
mass = 1 - exp(-2 * kappa)
across = 1 / sqrt(1 + alpha**2 * v**2)
ROUGH = interval(alpha, 0, oo, open=True)
FAMILY = (
    "the family is the spherical Gaussian of deon2016 (28), alpha = m, per steradian with unit mass; kappa = 2 / m^2"
)


# --- the height of a height field ----------------------------------------------------------------------------

paper.out_of_scope(
    "claim.spiky",
    "surfaces of very high roughness are unreasonably spiky; Beckmann's are, past a roughness of about 0.8 (figure 9)",
    because="an appearance, for which no measure is given",
)


def scaled(name, ndf, slopes):
    """With tan(theta) = alpha v, the density of v per area of the slope plane."""
    claim = paper.claim(
        f"claim.figure-9.{name}",
        f"the roughness of {name} only scales the surface's height: the slopes over the roughness do not depend on it",
        left=alpha**2 * across**4 * ndf(across, alpha),
        corrected=slopes,
        where=[interval(v, 0, oo), ROUGH],
        statement=True,
        reading="slopes are distributed as cos(theta)^4 D, D per steradian with unit projected area; a surface that is "
        "stretched vertically has its slopes multiplied",
    )

    @claim.proof
    def stretched(step):
        step.fact(1 + alpha**2 * v**2, 1, alpha**2 * v**2)


scaled("beckmann", beckmann, exp(-(v**2)) / pi)
scaled("ggx", ggx, 1 / (pi * (1 + v**2) ** 2))

paper.out_of_scope(
    "claim.figure-10",
    "one could use a parameter that goes from height fields over other surfaces to pure volumes",
    because="a proposal; what the text asks of such a family is claim.family",
)
paper.out_of_scope("claim.figure-11", "Beckmann height fields", because="a picture, with no statement")


# --- a sphere as a mirror --------------------------------------------------------------------------------------

inward = Matrix([0, 0, -1])
normal = Matrix([b, 0, sqrt(1 - b**2)])  # of the unit sphere, where a ray at the distance b from the axis meets it
reflected = inward - 2 * inward.dot(normal) * normal

sphere = paper.claim(
    "claim.mirror-sphere",
    "a mirror ball scatters alike in all directions: rays nearer to the axis than b fill a cap of the sphere, whose "
    "share of the sphere is the rays' share of the beam",
    left=Integral(2 * y, (y, 0, b)),
    corrected=(1 + inward.dot(reflected)) / 2,
    where=[interval(b, 0, 1)],
    statement=True,
    reading="the far field of one ball, all rays parallel; a cap about the light with the cosine c at its rim has the "
    "share (1 - c) / 2 of the sphere, and the rays nearer to the axis are sent into it",
)


@sphere.proof
def disk_and_cap(step):
    step.antiderivative(y**2)


paper.out_of_scope(
    "claim.roughest",
    "an isotropically scattering half-space is, by some definition, the roughest surface possible",
    because="the definition is not given",
)


# --- the family ------------------------------------------------------------------------------------------------

flat = paper.claim(
    "claim.family.flat",
    "a Dirac delta of the up direction for m = 0: the mean of 1 - cos(theta) is m^2 / 2 - (coth(kappa) - 1)",
    left=Integral(2 * pi * (1 - x) * spherical_gaussian(x, alpha), (x, -1, 1)),
    corrected=alpha**2 / 2 - (coth(kappa) - 1),
    where=[interval(alpha, 0, 10, open="left")],
    statement=True,
    reading=FAMILY + ". coth exceeds 1, so this is at most m^2 / 2 and goes to 0 with m: all mass closes on the pole",
)
flat.proof(lambda step: step.lemma("deon2016:claim.flat-limit.spherical-gaussian", {alpha: alpha}))

low = paper.claim(
    "claim.family.beckmann",
    "asymptotic to Beckmann for low m: the ratio at slopes tan(theta) = m v",
    left=spherical_gaussian(across, alpha) / beckmann(across, alpha),
    corrected=across**4 * exp(alpha**2 * v**4 * (1 + 2 * across) / (1 + 1 / across) ** 2) / mass,
    where=[interval(v, 0, 6), interval(alpha, Rational(1, 20), 1)],
    statement=True,
    reading=FAMILY + ". The right side is 1 + O(m^2 (v^2 + v^4)), which is the whole mass of both; at a fixed angle "
    "the ratio goes to infinity (deon2016:claim.sg-beckmann-asymptotic.fixed)",
)

high = paper.claim(
    "claim.family.constant",
    "the constant distribution on the whole sphere for m to infinity: the largest value over the mean is "
    "kappa + kappa coth(kappa)",
    left=4 * pi * spherical_gaussian(1, alpha),
    corrected=kappa + kappa * coth(kappa),
    where=[ROUGH],
    statement=True,
    reading=FAMILY + ". kappa coth(kappa) is between 1 and 1 + kappa^2 / 3, so 4 pi D goes to 1 everywhere; smoothly, "
    "as D is analytic in m > 0",
)
high.proof(lambda step: step.lemma("deon2016:claim.sg-isotropic", {alpha: alpha}))

paper.whole(
    "claim.family",
    "there is a family of distributions that is a flat mirror at m = 0, Beckmann's for low m, and constant for m to "
    "infinity",
    ["claim.family.flat", "claim.family.beckmann", "claim.family.constant"],
    left=Rational(0),
    reading=FAMILY,
)

seen = paper.claim(
    "claim.figure-12",
    "its cross-sections go from a rough surface, dark from below, to an isotropic medium, the same from everywhere: "
    "half the difference of opposite views is (coth(kappa) - 1 / kappa) u / 2",
    left=(SigmaSphericalGaussian(u, alpha) - SigmaSphericalGaussian(-u, alpha)) / 2,
    corrected=(coth(kappa) - 1 / kappa) * u / 2,
    where=[interval(u, -1, 1), ROUGH],
    statement=True,
    reduces=("xsec:sg-positive",),
    reading=FAMILY + ". The factor goes from 1 at m = 0, where the sum of both views is |u|, to 0 for m to infinity, "
    "where each is 1/4; the curves of the figure are not given in numbers",
)


seen.proof(lambda step: step.lemma("xsec:sg-odd", {u: u, alpha: alpha}))

paper.out_of_scope(
    "claim.semi-porous",
    "as the roughness grows such surfaces become semi-porous and turn into a sea of mirror spheres",
    because="a picture of the mind; that mirror balls scatter alike in all directions is claim.mirror-sphere",
)
paper.out_of_scope(
    "claim.4.3-open-questions",
    "sampling the visible normals may be hard, and one model could span from mirrors to isotropic media",
    because="plans and hopes",
)

if __name__ == "__main__":
    paper.tell()
