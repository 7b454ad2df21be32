"""A mirror of revolution and its distribution of normals: from the profile z(b) to D, and back.

The profile falls away from its axis, the rim is at b = 1, and light comes along the axis. Forward: the ring of the
surface between b and b + db covers 2 b db of the unit disk, over pi, and all its normals have the cosine u(b). So the mean
of any f(u) over the disk is 2 pi times the integral of x f(x) D(x): that is what each `revolution-<shape>` says, for a
free function f, and it fixes D with its normalisation (f = 1). Backward: the normals steeper than u cover a disk, whose
squared radius is the integral of 2 pi x D(x) from u to 1, and the slope at its edge is tan(theta): the depth is one
integral over x, if that of x D(x) is known.

A cone has one inclination, so its D is a Dirac ring. The spheroid gives GGX, the paraboloid slopes spread evenly over a
disk, and Beckmann's distribution a profile with the slope alpha sqrt(-log(1 - b^2)): its depth is one integral, for
which we know no closed form. Over the slope q it is alpha times that of q^2 exp(-q^2) / sqrt(1 - exp(-q^2)).
"""

from sympy import Function, Integral, Matrix, cos, diff, exp, log, oo, pi, sin, sqrt, symbols

from derivations.kenha2018.surface import ANGLE, facet_by_angle, on_the_sphere, phi, rate, reflected
from derivations.kenha2018.surface import normal as mirror_normal
from xsec_sym.exact import beckmann, ggx
from xsec_sym.exact.revolution import X, Y, cosine
from xsec_sym.proof import Source, interval

project = Source("xsec", section="mirrors of revolution")

b, u, t, q, alpha, kappa, s, bend = symbols("b u t q alpha kappa s r", real=True)
x, y = X, Y
f = Function("f", real=True)
TRIED = {f: (lambda v: v, lambda v: v**2, lambda v: exp(v), lambda v: 1 / (1 + v**2))}
AREA = "D per steradian, with unit projected area; the rim at b = 1"

ROUGH = interval(alpha, 0, oo, open=True)
STEEP = interval(s, 0, oo, open=True)


# --- any profile ----------------------------------------------------------------------------------------

outward = Matrix([cos(phi), sin(phi), 0])
down = Matrix([0, 0, -1])
along, around = outward + s * down, b * diff(outward, phi)  # the tangents, s = -dz/db
normal = along.cross(around)  # not of unit length


def curvature():
    """Gauss's, from the two fundamental forms: the second derivatives seen along the normal."""
    second = (bend * down).dot(normal), diff(outward, phi).dot(normal), (b * diff(outward, phi, 2)).dot(normal)
    first = along.dot(along), along.dot(around), around.dot(around)
    whole = (second[0] * second[2] - second[1] ** 2) / (normal.dot(normal) * (first[0] * first[2] - first[1] ** 2))
    return whole.subs(phi, 0)  # by symmetry one meridian is enough


curved = project.claim(
    "revolution-curvature",
    "the distribution of normals of any profile is 1 / (pi K), K its Gaussian curvature",
    left=1 / (pi * curvature()),
    corrected=b / (pi * cosine(s) * sqrt((diff(cosine(s), s) * bend) ** 2)),
    where=[interval(b, 0, oo, open=True), STEEP, interval(bend, 0, oo, open=True)],
    reading=AREA + "; s = -dz/db and r = ds/db. The right side is b / (pi u |du/db|), from 2 pi u D |du| = 2 b db",
)
curved.proof(lambda step: None)

mirror = project.claim(
    "revolution-scattering",
    "a mirror of revolution scatters light along its axis into D / 4 per steradian",
    left=b * rate / (pi * on_the_sphere(reflected)),
    corrected=facet_by_angle / (pi * on_the_sphere(mirror_normal)) / 4,
    where=[interval(b, 0, oo, open=True), interval(rate, 0, oo, open=True), ANGLE, interval(phi, 0, 2 * pi)],
    reading=AREA + ". The left side is per solid angle of the reflected light, over the disk's area",
)
mirror.proof(lambda step: None)


# --- from the profile to the distribution ---------------------------------------------------------------


def forward(name, title, slope, ndf, low=0, *, where, reading=AREA):
    """The mean over the disk against the mean over the distribution."""
    claim = project.claim(
        f"revolution-{name}",
        title,
        left=Integral(2 * b * f(cosine(slope)), (b, 0, 1)),
        corrected=Integral(2 * pi * x * ndf(x) * f(x), (x, low, 1)),
        where=where,
        instances=TRIED,
        reading=reading,
    )
    return claim


def paraboloid(v):
    """Slopes spread evenly over a disk of the radius s."""
    return 1 / (pi * s**2 * v**4)


spheroid = forward("spheroid", "the spheroid has the GGX distribution", alpha * b / sqrt(1 - b**2),
                   lambda v: ggx(v, alpha), where=[ROUGH])  # fmt: skip
sphere = forward("sphere", "the sphere has the uniform distribution", b / sqrt(1 - b**2), lambda v: 1 / pi, where=[])
bowl = forward(
    "paraboloid", "the paraboloid z = -s b^2 / 2 has all slopes up to s alike", s * b, paraboloid, cosine(s), where=[STEEP]
)
bell = forward(
    "beckmann", "the profile with the slope alpha sqrt(-log(1 - b^2)) has Beckmann's distribution",
    alpha * sqrt(-log(1 - b**2)), lambda v: beckmann(v, alpha), where=[ROUGH],
)  # fmt: skip


@spheroid.proof
def spheroid_by_cosine(step):
    step.substitute(x, sqrt((1 - x**2) / (1 - (1 - alpha**2) * x**2)), 1, 0)


@sphere.proof
def sphere_by_cosine(step):
    step.substitute(x, sqrt(1 - x**2), 1, 0)


@bowl.proof
def paraboloid_by_cosine(step):
    step.swap().substitute(b, cosine(s * b), 1, 0)


@bell.proof
def both_by_slope(step):
    step.substitute(q, sqrt(1 - exp(-(q**2))), 0, oo)
    step.swap().substitute(q, cosine(alpha * q), oo, 0)


if __name__ == "__main__":
    project.tell()
