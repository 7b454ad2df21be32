"""The spheroid x^2 + y^2 + z^2 / alpha^2 = 1 as a mirror: its distribution of normals is GGX.

The left sides come from the spheroid's gradient (see `xsec_sym.exact.revolution`), the printed ones from the slope of
z(b). The angle theta_m runs from 0 to pi/2, and alpha over all positive numbers: the article's minor half-axis, or,
beyond 1, a major one.
"""

from sympy import Integral, Rational, cos, oo, pi, sin, sqrt, symbols, tan

from derivations.kenha2018.surface import FACETS, alpha, b, phi, theta
from xsec_sym.exact import NormalsGGX, SpheroidFacets, SpheroidRadius, SpheroidRate, SpheroidSlope
from xsec_sym.proof import Source, interval

paper = Source("kenha2018", section="the spheroid")

x, y, z = symbols("x y z", real=True)

ROUGH = interval(alpha, 0, oo, open=True)
ANGLE = interval(theta, 0, pi / 2, open=True)
INSIDE = interval(b, 0, 1, open="right")

square = sin(theta) ** 2 + alpha**2 * cos(theta) ** 2
bell = alpha**2 + tan(theta) ** 2
area_density = alpha**2 / (cos(theta) ** 4 * bell**2)
facets = SpheroidFacets(theta, alpha)


# --- the profile ----------------------------------------------------------------------------------------

paper.definition("ellipsoid", "the spheroid", left=x**2 + y**2 + z**2 / alpha**2, printed=1,
                 reading="half-axes 1, 1 and alpha")  # fmt: skip

height = paper.claim(
    "z",
    "the upper half of the spheroid as a height",
    left=sqrt(alpha**2 * (1 - (b * cos(phi)) ** 2 - (b * sin(phi)) ** 2)),
    printed=alpha * sqrt(1 - b**2),
    where=[interval(b, 0, 1), interval(phi, 0, 2 * pi), ROUGH],
    reading="x = b cos(phi), y = b sin(phi), and z is the root of the spheroid's equation that is not negative",
)


@height.proof
def squares_of_a_circle(step):
    """cos^2 + sin^2 = 1."""


slope = paper.claim(
    "dzdb.1",
    "the slope of the profile",
    left=SpheroidSlope(b, alpha),
    printed=-alpha * b / sqrt(1 - b**2),
    where=[INSIDE, ROUGH],
)
slope.proof(lambda step: step.unfold())

tangent = paper.claim(
    "dzdb.2",
    "the slope at the point whose normal is inclined by theta_m",
    left=SpheroidSlope(SpheroidRadius(theta, alpha), alpha),
    printed=tan(theta),
    corrected=-tan(theta),
    edit="put a minus sign before tan(theta_m): the profile falls",
    where=[ANGLE, ROUGH],
    reading="0 < theta_m < pi/2; a negative theta_m would save this line, but not the sign of db/d theta_m below",
)

paper.whole(
    "dzdb",
    "the slope of the profile, which is the tangent",
    ["dzdb.1", "dzdb.2"],
    left=SpheroidSlope(b, alpha),
    printed=slope.printed,
    reading="0 < theta_m < pi/2",
)


def positive(step, inside=()):
    step.fact(square, sin(theta) ** 2, alpha**2 * cos(theta) ** 2, inside=inside)


@tangent.proof
def complement_of_the_radius(step):
    """1 - b^2 is alpha^2 cos^2 over sin^2 + alpha^2 cos^2."""
    positive(step)
    step.unfold()


# --- the radius and its rate ----------------------------------------------------------------------------

radius = paper.claim(
    "b2",
    "the squared radius",
    left=SpheroidRadius(theta, alpha) ** 2,
    printed=tan(theta) ** 2 / bell,
    where=[interval(theta, 0, pi / 2, open="right"), ROUGH],
)

rate = paper.claim(
    "dbdtheta",
    "how the radius grows with the angle",
    left=SpheroidRate(theta, alpha),
    printed=alpha**2 / (cos(theta) ** 2 * bell ** Rational(3, 2)),
    where=[interval(theta, 0, pi / 2, open="right"), ROUGH],
)


@radius.proof
@rate.proof
def gradient_and_slope_agree(step):
    positive(step)
    step.unfold()


# --- the density of the facets --------------------------------------------------------------------------

density = paper.claim(
    "dsigma.1",
    "the facets' area per solid angle by (5)",
    left=facets,
    printed=1 / cos(theta) * SpheroidRadius(theta, alpha) / sin(theta) * SpheroidRate(theta, alpha),
    where=[ANGLE, ROUGH],
    reading=FACETS + "; the bars about db/d theta_m are idle, since it is positive",
)

written_out = paper.claim(
    "dsigma.2",
    "the same written out",
    left=facets,
    printed=1 / (cos(theta) * sin(theta)) * tan(theta) / sqrt(bell) * alpha**2 / (cos(theta) ** 2 * sqrt(bell) ** 3),
    where=[ANGLE, ROUGH],
    reading=FACETS,
)

closed = paper.claim(
    "dsigma.3",
    "the facets' area per solid angle of their normals",
    left=facets,
    printed=area_density,
    where=[ANGLE, ROUGH],
    reading=FACETS,
)


@density.proof
@written_out.proof
@closed.proof
def meridian_and_circle(step):
    positive(step)
    step.unfold()


# --- the total cross-section ----------------------------------------------------------------------------

hemisphere = ((theta, 0, pi / 2), (phi, 0, 2 * pi))
DISK = Integral(2 * pi * b, (b, 0, 1))

covered = paper.claim(
    "sigma.1",
    "the facets seen from the light cover the disk of radius 1",
    left=DISK,
    printed=Integral(facets * cos(theta) * sin(theta), *hemisphere),
    where=[ROUGH],
    reading=FACETS + "; the left side is what the text calls the total cross-section, the area seen from the light",
)

explicit = paper.claim(
    "sigma.2",
    "the same with the area per solid angle written out",
    left=Integral(facets * cos(theta) * sin(theta), *hemisphere),
    printed=Integral(area_density * cos(theta) * sin(theta), *hemisphere),
    where=[ROUGH],
    reading=FACETS,
)

total = paper.claim(
    "sigma.3",
    "the total cross-section",
    left=Integral(facets * cos(theta) * sin(theta), *hemisphere),
    printed=pi,
    where=[ROUGH],
    reading=FACETS,
)


def angle_by_angle(step):
    """Up to theta_m the disk is covered out to sin^2 / (sin^2 + alpha^2 cos^2)."""
    step.unfold()
    positive(step, (theta, 0, pi / 2))
    step.exchange()
    step.antiderivative(phi, next(i for i in step.left.atoms(Integral) if i.limits[0][0] == phi))
    step.antiderivative(pi * sin(theta) ** 2 / square)


@covered.proof
def disk(step):
    step.antiderivative(pi * b**2).swap()
    angle_by_angle(step)


@total.proof
def hemisphere_of_normals(step):
    angle_by_angle(step)


@explicit.proof
def both_by_angle(step):
    angle_by_angle(step)
    step.swap()
    angle_by_angle(step)


# --- the distribution -----------------------------------------------------------------------------------

ggx = paper.claim(
    "ggx",
    "the spheroid's distribution of normals",
    left=facets / DISK,
    printed=alpha**2 / (pi * cos(theta) ** 4 * bell**2),
    where=[ANGLE, ROUGH],
    reading=FACETS + "; D has unit projected area",
)

same = paper.claim(
    "claim.ggx",
    "it is the GGX distribution (1)",
    left=facets / DISK,
    corrected=NormalsGGX(cos(theta), alpha),
    where=[ANGLE, ROUGH],
    reading="the GGX of deon2016 (24): D per steradian, with unit projected area",
    statement=True,
)


@ggx.proof
@same.proof
def over_the_disk(step):
    step.antiderivative(pi * b**2)
    positive(step)
    step.unfold().settle().swap().settle()


if __name__ == "__main__":
    paper.tell()
