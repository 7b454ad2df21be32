"""The two flakes of an isotropic medium: mirrors scatter alike in all directions, diffuse ones like diffuse spheres.

The phase function of dupuy2016 (5), from omega_1 to omega_2, is the mean over the flakes that omega_1 meets. With all
normals alike, D = 1 / (4 pi) and sigma = 1/4, so that a flake inclined by beta to the light is met with the density
D cos(beta) / sigma = cos(beta) / pi per steradian. mu = omega_1 . omega_2 is the cosine of the deflection, so that
mu = -1 is light sent back.
"""

from sympy import Integral, Max, Rational, acos, cos, pi, sin, sqrt, symbols

from xsec_sym.proof import Source, interval

project = Source("xsec", section="flakes")

beta, chi, mu, p, v, w, y = symbols("beta chi mu p v w y", real=True)
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

bright = project.claim(
    "flakes.clamp.bright",
    "a sine over the first half of the turn is its own clamp",
    left=Max(0, sin(p)),
    corrected=sin(p),
    where=[interval(p, 0, pi)],
)
dark = project.claim(
    "flakes.clamp.dark",
    "its negative is clamped to 0",
    left=Max(0, -sin(p)),
    corrected=0,
    where=[interval(p, 0, pi)],
)


difference = project.claim(
    "flakes.sine-of-a-difference",
    "the sine of a difference",
    left=sin(chi - v),
    corrected=sin(chi) * cos(v) - cos(chi) * sin(v),
    where=[interval(v, -2 * pi, 2 * pi), interval(chi, -2 * pi, 2 * pi)],
)


def both(angle):
    return Max(0, sin(angle)) * Max(0, sin(angle - chi))


lune = project.claim(
    "flakes.lune",
    "the two clamped cosines, over the circle through both directions",
    left=Integral(both(p), (p, 0, chi)) + Integral(both(v), (v, chi, pi)) + Integral(both(w), (w, pi, 2 * pi)),
    corrected=(sin(chi) + (pi - chi) * cos(chi)) / 2,
    where=[interval(chi, 0, pi)],
    reading="chi is the angle between the direction to the light and omega_2; the angle of the normal is counted from "
    "where it begins to face the light, on three arcs that make the circle",
)

clamped = Integral(1 - y**2, (y, -1, 1)) * lune.left

diffuse_angle = project.claim(
    "flakes.diffuse.angle",
    "the phase function of diffuse flakes, by the angle between the directions to the light and to the viewer",
    left=clamped * D / (pi * SIGMA),
    corrected=2 * (sin(chi) + (pi - chi) * cos(chi)) / (3 * pi**2),
    where=[interval(chi, 0, pi)],
    reading=PLAIN + ". A normal at the height y over the plane of both directions and at the angle p in it has the "
    "cosines sqrt(1 - y^2) sin(p) and sqrt(1 - y^2) sin(p - chi), and the sphere the area dy dp",
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


@bright.proof
@dark.proof
def first_half_of_a_turn(step):
    for branch in step.cases(p):
        if branch.is_empty:
            branch.vacuous()
        elif branch.left.has(p):
            for inner in branch.cases(pi - p, p, pi, -1):
                inner.vacuous() if inner.is_empty else inner.settle()


@difference.proof
def oscillation(step):
    step.ode(v, [1, 0, 1], at=0)


@lune.proof
def lit_from_both(step):
    step.lemma(dark, {p: chi - p}).lemma(dark, {p: w - pi}).lemma(bright, {p: v}).lemma(bright, {p: v - chi})
    step.antiderivative(0, step.over(0, chi)).antiderivative(0, step.over(pi, 2 * pi))
    step.lemma(difference, {v: v, chi: chi})
    step.antiderivative(cos(chi) * (v - sin(v) * cos(v)) / 2 - sin(chi) * sin(v) ** 2 / 2)


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
    step.antiderivative(4 / (3 * pi) * (area - (mu**2 * acos(mu) / 2 - (mu * root + acos(mu)) / 4)))


@moment.proof
def by_parts_again(step):
    root = sqrt(1 - mu**2)
    step.antiderivative(4 / (3 * pi) * (-(root**3) / 3 - mu**3 * acos(mu) / 3 + root / 3 - root**3 / 9))


if __name__ == "__main__":
    project.tell()
