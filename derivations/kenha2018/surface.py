"""The surface elements of a mirror of revolution, and the distribution of normals that they define, (1)-(6).

The surface is z(b), b the distance from the axis; light falls along the axis. Position, normal and reflected direction
are written out as vectors, and every area is the length of a cross product: nothing else is assumed. The angle
theta_m runs from 0 to pi/2, as in the article's own integrals.
"""

from sympy import Abs, Function, Integral, Matrix, Symbol, cos, diff, oo, pi, sin, sqrt, symbols, tan

from xsec_sym.exact import NormalsGGX
from xsec_sym.proof import Source, interval

paper = Source("kenha2018", section="the distribution of a shape")

theta, phi = symbols("theta_m phi_m", real=True)
b, alpha, E_i, total = symbols("b alpha E_i sigma_total", real=True)
slope = Symbol("z'", real=True)  # dz/db
rate = Symbol("b'", real=True)  # db/dtheta_m

ANGLE = interval(theta, 0, pi / 2, open=True)
AROUND = interval(phi, 0, 2 * pi)
OFF_AXIS = interval(b, 0, oo, open=True)
FACETS = "per solid angle of the facets' normals, d omega_m = sin(theta_m) d theta_m d phi_m"


# --- the vectors ----------------------------------------------------------------------------------------

axis = Matrix([0, 0, 1])
outward = Matrix([cos(phi), sin(phi), 0])
circle = b * diff(outward, phi)  # the tangent d/dphi of the position (b cos phi, b sin phi, z(b))
normal = cos(theta) * axis + sin(theta) * outward
reflected = 2 * cos(theta) * normal - axis


def meridian(steepness):
    """The tangent d/db of the same position."""
    return outward + steepness * axis


def length(vector):
    return sqrt(sum(c**2 for c in vector))


def on_the_sphere(direction):
    """Solid angle per d theta_m d phi_m."""
    return length(diff(direction, theta).cross(diff(direction, phi)))


falling = meridian(-tan(theta))  # the normal of what falls away at this slope is inclined by theta_m
facet = length(falling.cross(circle))  # area per db dphi
shadow = outward.cross(circle)[2]  # the same cell seen along the axis
facet_by_angle = length((rate * falling).cross(circle))  # area per dtheta dphi
shadow_by_angle = Abs((rate * outward).cross(circle)[2])


# --- the claims -----------------------------------------------------------------------------------------

ggx = paper.claim(
    "1",
    "the GGX distribution, written with the tangent",
    left=NormalsGGX(cos(theta), alpha),
    printed=alpha**2 / (pi * cos(theta) ** 4 * (alpha**2 + tan(theta) ** 2) ** 2),
    where=[interval(theta, 0, pi / 2, open="right"), interval(alpha, 0, oo, open=True)],
    reading="the GGX of deon2016 (24): D per steradian, with unit projected area",
)
ggx.proof(lambda step: step.unfold().settle())

flux = paper.claim(
    "flux",
    "the flux on a facet, over its area",
    left=E_i * shadow / facet,
    printed=E_i * cos(theta),
    where=[ANGLE, AROUND, OFF_AXIS, interval(E_i, 0, oo)],
    reading="d Phi / d sigma_m; the light falls along the axis, so that the facet is inclined to it by theta_m",
)

inclination = paper.claim(
    "2",
    "the slope of the profile is the tangent of the normal's inclination",
    left=length((meridian(slope).cross(circle))[:2]) / meridian(slope).cross(circle)[2],
    printed=slope,
    corrected=Abs(slope),
    edit="put bars about dz/db, as (4) has them about db/d theta_m: a surface that falls away from its axis has "
    "dz/db = -tan(theta_m)",
    where=[interval(slope, -oo, oo), AROUND, OFF_AXIS],
    reading="theta_m in [0, pi/2) is the angle between normal and axis, as in the integrals over the hemisphere",
)

projected = paper.claim(
    "3",
    "the facet seen from the light",
    left=cos(theta) * facet,
    printed=b,
    where=[ANGLE, AROUND, OFF_AXIS],
    reading="per db d phi_m",
)


@flux.proof
@projected.proof
def normal_of_the_slope(step):
    """1 + tan^2 = 1 / cos^2."""


@inclination.proof
def horizontal_over_vertical(step):
    for branch in step.cases(slope):
        branch.unfold()


solid = paper.claim(
    "claim.solid-angle",
    "the normals of a cell fill the solid angle sin(theta_m) d theta_m d phi_m",
    left=on_the_sphere(normal),
    printed=sin(theta),
    where=[ANGLE, AROUND],
    reading="the solid angle of the facets' normals",
    statement=True,
)
solid.proof(lambda step: None)

paper.claim(
    "claim.reflected-solid-angle",
    "the light that a cell reflects spreads over sin(theta_m) d theta_m d phi_m",
    left=on_the_sphere(reflected),
    printed=sin(theta),
    where=[ANGLE, AROUND],
    reading="the text before (4) gives d omega_m to the reflected light; it is the solid angle of the normals",
    statement=True,
)

spread = paper.claim(
    "4.reflected",
    "the solid angle of the reflected light is 4 cos(theta_m) times that of the normals",
    left=on_the_sphere(reflected),
    corrected=4 * cos(theta) * sin(theta),
    where=[ANGLE, AROUND],
    reading="o = 2 (i . m) m - i with the light i along the axis",
)
spread.proof(lambda step: None)

by_angle = paper.claim(
    "4.1",
    "the cell seen from the light, by the angle of its normal",
    left=shadow_by_angle,
    printed=b * Abs(rate),
    where=[AROUND, OFF_AXIS, interval(rate, -oo, oo)],
    reading="per d theta_m d phi_m",
)

by_solid_angle = paper.claim(
    "4.2",
    "the cell seen from the light, over the solid angle of its normals",
    left=shadow_by_angle / on_the_sphere(normal),
    printed=b / sin(theta) * Abs(rate),
    where=[ANGLE, AROUND, OFF_AXIS, interval(rate, -oo, oo)],
    reading=FACETS,
)

paper.whole(
    "4",
    "the cell seen from the light, by the solid angle of its normals",
    ["4.1", "4.2"],
    left=shadow_by_angle / on_the_sphere(normal),
    printed=by_solid_angle.printed,
    reading=FACETS,
)

density = paper.claim(
    "5",
    "the facets' area per solid angle of their normals",
    left=facet_by_angle / on_the_sphere(normal),
    printed=1 / cos(theta) * b / sin(theta) * Abs(rate),
    where=[ANGLE, AROUND, OFF_AXIS, interval(rate, -oo, oo)],
    reading=FACETS,
)

scattering = paper.claim(
    "scattering",
    "the distribution of normals and the differential cross-section",
    left=facet_by_angle / (total * on_the_sphere(normal)) * cos(theta),
    printed=1 / total * (b / sin(theta) * Abs(rate)),
    where=[ANGLE, AROUND, OFF_AXIS, interval(rate, -oo, oo), interval(total, 0, oo, open=True)],
    reading=FACETS + "; per solid angle of the reflected light the cross-section is smaller by 4 cos(theta_m)",
)


@by_angle.proof
@by_solid_angle.proof
@density.proof
@scattering.proof
def rising_or_falling(step):
    """The radius may grow or shrink with the angle."""
    for branch in step.cases(rate):
        branch.unfold()


D = Function("D", real=True)
hemisphere = ((phi, 0, 2 * pi), (theta, 0, pi / 2))

paper.definition(
    "total",
    "the total cross-section",
    left=total,
    printed=Integral(Function("f", real=True)(theta) * cos(theta) * sin(theta), *hemisphere),
    reading="f = d sigma_m / d omega_m; it is the area of the disk that the surface covers, see sigma.1",
)

paper.definition(
    "6",
    "the distribution of normals of a shape",
    left=D(theta),
    printed=Function("f", real=True)(theta) / total,
    reading="f = d sigma_m / d omega_m; so D has unit projected area",
)

unit = paper.claim(
    "norm",
    "the projected area of all normals is 1",
    left=Integral(NormalsGGX(cos(theta), alpha) * cos(theta) * sin(theta), *hemisphere),
    printed=1,
    where=[interval(alpha, 0, oo, open=True)],
    reading="the condition on every D, tried on the GGX of (1); D of (6) meets it by the definition of sigma_total",
)


@unit.proof
def share_of_the_disk(step):
    """What is less inclined than theta_m covers a disk of the squared radius sin^2 / (sin^2 + alpha^2 cos^2)."""
    step.unfold().nest()
    step.antiderivative(phi, next(i for i in step.left.atoms(Integral) if i.limits[0][0] == phi))
    square = sin(theta) ** 2 + alpha**2 * cos(theta) ** 2
    step.fact(square, sin(theta) ** 2, alpha**2 * cos(theta) ** 2, inside=(theta, 0, pi / 2))
    step.split().antiderivative(sin(theta) ** 2 / square)


for slug, title, because in (
    (
        "shape-for-statistics",
        "the statistics of scattering by a rough surface may be replaced by the areas of a mirror's shape",
        "the view that the article takes; what follows from it has verdicts of its own",
    ),
    (
        "rutherford",
        "the reflection is treated after Rutherford's scattering",
        "it says where the idea comes from",
    ),
):
    paper.out_of_scope(f"claim.{slug}", title, because=because)

if __name__ == "__main__":
    paper.tell()
