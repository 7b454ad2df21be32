"""Section 1: the squared spheroidal lobe is GGX at half the angle, and its root is the polar radius of a spheroid.

The centre and the semi-axes are read off the lobe itself: its two values on the axis give those along the axis, and
the equation of a spheroid, solved for the remaining semi-axis, gives the same value in every direction.
"""

from sympy import Integral, Matrix, cos, pi, sqrt, symbols

from derivations.extensions.half_angle import half_angle
from xsec_sym.exact import LobeGGX, ggx
from xsec_sym.proof import Source, interval

paper = Source("tokuyoshi_harada", section="1")

theta, alpha, m, phi = symbols("theta alpha m phi", real=True)
ROUGH = interval(alpha, 0, 1, open="left")
AREA = "D per steradian with unit projected area, as in deon2016 (24); the lobe is 1 on its axis"
COSINE = "; m = cos(theta), so that cos(theta / 2) is the root of (1 + m) / 2"


# --- the lobe -------------------------------------------------------------------------------------------

lobe = paper.claim(
    "ssl",
    "the squared spheroidal lobe is GGX at half the angle",
    left=pi * alpha**2 * ggx(cos(theta / 2), alpha),
    printed=4 * alpha**4 / (1 - cos(theta) + alpha**2 * (1 + cos(theta))) ** 2,
    where=[interval(theta, 0, pi), ROUGH],
    reading=AREA + "; D(0) is the limit at the horizon, and alpha = 0 is left out, where the lobe is 0 / 0 on its axis",
)


@lobe.proof
def double_the_angle(step):
    step.swap().lemma(half_angle, {theta: theta})


# --- the spheroid ---------------------------------------------------------------------------------------


def radius(cosine):
    """The root of the lobe, pi alpha^2 D, at an angle with the given cosine."""
    return sqrt(LobeGGX(cosine, alpha))


def to_the_surface(cosine, centre, across, along):
    """The distance from the origin to a spheroid about the z axis: the positive root of its quadratic equation."""
    square = (1 - cosine**2) / across**2 + cosine**2 / along**2
    linear = -centre * cosine / along**2
    constant = centre**2 / along**2 - 1
    return (sqrt(linear**2 - square * constant) - linear) / square


def below_the_peak(step):
    """The denominator of the lobe, (1 - m) + alpha^2 (1 + m), is positive."""
    lifted = alpha**2 * (1 + m)
    step.unfold().fact(1 - m + lifted, (1 - m) * (1 - alpha**2), 2 * alpha**2)


spheroid = paper.claim(
    "claim.spheroid",
    "the root of pi D at half the angle is a spheroid with the centre (1 - alpha^2) / (2 alpha) on the axis and the "
    "semi-axes 1, 1 and (1 + alpha^2) / (2 alpha)",
    left=radius(m) / alpha,
    printed=to_the_surface(m, (1 - alpha**2) / (2 * alpha), 1, (1 + alpha**2) / (2 * alpha)),
    where=[interval(m, -1, 1), ROUGH],
    reading=AREA + COSINE + "; the right side is the distance to that spheroid, in every direction: the two surfaces "
    "are one",
    statement=True,
)
spheroid.proof(below_the_peak)

top, bottom = radius(1), radius(-1)
middle, along = (top - bottom) / 2, (top + bottom) / 2

for side, wave in (("x", cos(phi)), ("y", cos(phi - pi / 2))):
    level = paper.claim(
        f"c.{side}",
        f"the centre of the lobe's spheroid along {side}",
        left=Integral(radius(m) * sqrt(1 - m**2) * wave, (phi, 0, 2 * pi)) / (2 * pi),
        printed=0,
        where=[interval(m, -1, 1), ROUGH],
        reading=AREA + COSINE + "; the left side is the mean over the circle of all points at one angle",
    )
    level.proof(lambda step, wave=wave: around_the_axis(step, wave))

paper.claim(
    "c.z",
    "the centre of the lobe's spheroid along the axis",
    left=middle,
    printed=(1 - alpha**2) / 2,
    where=[ROUGH],
    reading=AREA + "; half-way between the two points on the axis",
).proof(lambda step: step.unfold())

across = paper.claim(
    "r.xy",
    "the semi-axes of the lobe's spheroid across the axis",
    left=radius(m) * sqrt(1 - m**2) / sqrt(1 - ((radius(m) * m - middle) / along) ** 2),
    printed=alpha,
    where=[interval(m, -1, 1, open=True), ROUGH],
    reading=AREA + COSINE + "; the equation of a spheroid, solved for the semi-axis at every angle; x and y alike, "
    "since the lobe depends on the angle alone",
)


@across.proof
def the_same_at_every_angle(step):
    below_the_peak(step)


paper.claim(
    "r.z",
    "the semi-axis of the lobe's spheroid along the axis",
    left=along,
    printed=(1 + alpha**2) / 2,
    where=[ROUGH],
    reading=AREA + "; half the distance between the two points on the axis",
).proof(lambda step: step.unfold())


def around_the_axis(step, wave):
    below_the_peak(step)
    root = 2 * alpha**2 / (1 - m + alpha**2 * (1 + m))
    step.antiderivative(root * sqrt(1 - m**2) * wave.subs(phi, phi - pi / 2))


paper.whole("c", "the centre of the lobe's spheroid", ["c.x", "c.y", "c.z"],
            left=Matrix([symbols("c_x c_y c_z", real=True)]), printed=Matrix([[0, 0, (1 - alpha**2) / 2]]))  # fmt: skip
paper.whole("r", "the semi-axes of the lobe's spheroid", ["r.xy", "r.z"],
            left=Matrix([symbols("r_x r_y r_z", real=True)]),
            printed=Matrix([[alpha, alpha, (1 + alpha**2) / 2]]))  # fmt: skip


if __name__ == "__main__":
    paper.tell()
