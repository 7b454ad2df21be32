"""The two flakes of an isotropic medium: mirrors scatter alike in all directions, diffuse ones like diffuse spheres.

The phase function of dupuy2016 (5), from omega_1 to omega_2, is the mean over the flakes that omega_1 meets. With all
normals alike, D = 1 / (4 pi) and sigma = 1/4, so that a flake inclined by beta to the light is met with the density
D cos(beta) / sigma = cos(beta) / pi per steradian. mu = omega_1 . omega_2 is the cosine of the deflection, so that
mu = -1 is light sent back.
"""

from sympy import Integral, Max, Rational, acos, cos, pi, sin, sqrt, symbols

from xsec_sym.proof import Source, interval

project = Source("xsec", section="flakes")

beta, chi, lam, mu, y = symbols("beta chi lambda mu y", real=True)
D, SIGMA = 1 / (4 * pi), Rational(1, 4)
PLAIN = "D per steradian and without direction, flakes that absorb nothing"


# --- mirrors --------------------------------------------------------------------------------------------------

met = D * cos(beta) / SIGMA  # per steradian of normals
spread = 4 * cos(beta)  # the solid angle of the reflected light over that of the normals: kenha2018:4.reflected

mirror = project.claim(
    "flakes.mirror",
    "mirror flakes without direction scatter alike in all directions",
    left=met / spread,
    corrected=1 / (4 * pi),
    where=[interval(beta, 0, pi / 2, open=True)],
    reading=PLAIN + "; beta is the angle between light and normal, the light is deflected by pi - 2 beta, and normals "
    "fill the solid angle of directions over 4 cos(beta)",
)
mirror.proof(lambda step: step.close())

share = project.claim(
    "flakes.mirror.share",
    "the same as shares: flakes inclined by less than beta send their light into a cap of that share of the sphere",
    left=Integral(2 * pi * sin(y) * (D * cos(y) / SIGMA), (y, 0, beta)),
    corrected=(1 - (2 * cos(beta) ** 2 - 1)) / 2,
    where=[interval(beta, 0, pi / 2)],
    reading=PLAIN + "; the rim of the cap is at 2 beta from the light, whose cosine is 2 cos(beta)^2 - 1",
)
share.proof(lambda step: step.antiderivative(sin(y) ** 2))


# --- diffuse flakes -------------------------------------------------------------------------------------------

lune = project.claim(
    "flakes.lune",
    "the two clamped cosines, over the circle through both directions",
    left=Integral(Max(0, cos(lam)) * Max(0, cos(lam - chi)), (lam, -pi, pi)),
    corrected=(sin(chi) + (pi - chi) * cos(chi)) / 2,
    where=[interval(chi, 0, pi)],
    reading="chi is the angle between the direction to the light and omega_2",
)

clamped = Integral(1 - y**2, (y, -1, 1)) * lune.left

diffuse_angle = project.claim(
    "flakes.diffuse.angle",
    "the phase function of diffuse flakes, by the angle between the directions to the light and to the viewer",
    left=clamped * D / (pi * SIGMA),
    corrected=2 * (sin(chi) + (pi - chi) * cos(chi)) / (3 * pi**2),
    where=[interval(chi, 0, pi)],
    reading=PLAIN + ". A normal at the height y over the plane of both directions and at the angle lambda in it has "
    "the cosines sqrt(1 - y^2) cos(lambda) and sqrt(1 - y^2) cos(lambda - chi), and the sphere the area dy d lambda",
)

diffuse = project.claim(
    "flakes.diffuse",
    "the phase function of diffuse flakes is that of a diffuse sphere, by the cosine of the deflection",
    left=clamped.subs(chi, acos(-mu)) * D / (pi * SIGMA),
    corrected=2 * (sqrt(1 - mu**2) - mu * acos(mu)) / (3 * pi**2),
    where=[interval(mu, -1, 1)],
    reading=PLAIN + "; per steradian, and mu = -1 is backscattering, where it is largest, 2 / (3 pi)",
)

unit = project.claim(
    "flakes.diffuse.unit",
    "it is normalised",
    left=Integral(2 * pi * diffuse.corrected, (mu, -1, 1)),
    corrected=1,
    reading="flakes that absorb nothing",
)
moment = project.claim(
    "flakes.diffuse.mean",
    "its mean cosine is -4/9",
    left=Integral(2 * pi * mu * diffuse.corrected, (mu, -1, 1)),
    corrected=-Rational(4, 9),
    reading="the same as that of a Lambertian sphere",
)


@lune.proof
def lit_from_both(step):
    step.split(-pi / 2, chi - pi / 2, pi / 2)
    step.antiderivative((lam * cos(chi) + sin(lam) * cos(lam - chi)) / 2)


@diffuse_angle.proof
def latitude_apart(step):
    step.lemma(lune, {chi: chi}).antiderivative(y - y**3 / 3)


@diffuse.proof
def by_the_cosine(step):
    step.lemma(diffuse_angle, {chi: acos(-mu)})


@unit.proof
def by_parts(step):
    root = sqrt(1 - mu**2)
    area = (mu * root - acos(mu)) / 2  # of the root
    weighted = mu**2 * acos(mu) / 2 + area * -1 / 2 - acos(mu) / 2 if False else None
    del weighted
    step.antiderivative(4 / (3 * pi) * (area - (mu**2 * acos(mu) / 2 - (mu * root + acos(mu)) / 4)))


@moment.proof
def by_parts_again(step):
    root = sqrt(1 - mu**2)
    step.antiderivative(4 / (3 * pi) * (-(root**3) / 3 - mu**3 * acos(mu) / 3 + root / 3 - root**3 / 9))


if __name__ == "__main__":
    project.tell()
