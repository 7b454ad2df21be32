"""A mirror of revolution and its distribution of normals: from the profile z(b) to D, and back.

The profile falls away from its axis, the rim is at b = 1, and light comes along the axis. Forward: the ring of the
surface between b and b + db covers 2 b db of the unit disk, over pi, and all its normals have the cosine u(b). So the
mean of any f(u) over the disk is 2 pi times the integral of x f(x) D(x): that is what each `revolution-<shape>` says,
for a free function f, and it fixes D with its normalisation (f = 1). Backward: the normals steeper than u cover a disk,
whose squared radius is the integral of 2 pi x D(x) from u to 1, and the slope at its edge is tan(theta): the depth is
one integral over x, if that of x D(x) is known.

A cone has one inclination, so its D is a Dirac ring. The spheroid gives GGX, the paraboloid slopes spread evenly over a
disk, and Beckmann's distribution a profile with the slope alpha sqrt(-log(1 - b^2)): its depth is one integral, for
which we know no closed form. Over the slope q it is alpha times that of q^2 exp(-q^2) / sqrt(1 - exp(-q^2)).
"""

from sympy import Function, Integral, Matrix, cos, diff, exp, log, oo, pi, sin, sqrt, symbols

from derivations.kenha2018.surface import ANGLE, facet_by_angle, on_the_sphere, phi, rate, reflected
from derivations.kenha2018.surface import normal as mirror_normal
from xsec_sym.exact import RingCrossSection, beckmann, ggx
from xsec_sym.exact.revolution import X, Y, cosine, covered, depth_of
from xsec_sym.proof import Source, interval

project = Source("xsec", section="mirrors of revolution")

b, u, t, q, alpha, kappa, s, bend, u_n = symbols("b u t q alpha kappa s r u_n", real=True)
x, y = X, Y
f = Function("f", real=True)
TRIED = {f: (lambda v: v, lambda v: v**2, lambda v: exp(v), lambda v: 1 / (1 + v**2))}
AREA = "D per steradian, with unit projected area; the rim at b = 1"

ROUGH = interval(alpha, 0, oo, open=True)
STEEP = interval(s, 0, oo, open=True)
WITHIN = interval(b, 0, 1, open=True)


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
    left=(b * rate / (pi * on_the_sphere(reflected))).subs(phi, 0),
    corrected=(facet_by_angle / (pi * on_the_sphere(mirror_normal)) / 4).subs(phi, 0),
    where=[interval(b, 0, oo, open=True), interval(rate, 0, oo, open=True), ANGLE],
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
    "paraboloid",
    "the paraboloid z = -s b^2 / 2 has all slopes up to s alike",
    s * b,
    paraboloid,
    cosine(s),
    where=[STEEP],
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


# --- the cone: one inclination --------------------------------------------------------------------------

c = cosine(s)

cone = project.claim(
    "revolution-cone",
    "the cone z = -s b has one inclination: its distribution is a Dirac ring, delta(x - c) / (2 pi c)",
    left=Integral(2 * b * f(c), (b, 0, 1)),
    corrected=f(c),
    where=[STEEP],
    instances=TRIED,
    reading=AREA + ". c^2 = 1 / (1 + s^2); 2 pi times the integral of x f(x) delta(x - c) / (2 pi c) is f(c)",
)
cone.proof(lambda step: step.linear(2 * b * f(c)).antiderivative(b**2 / 2))

side = project.claim(
    "revolution-cone.sigma",
    "seen from where all of it is lit, the cone covers what its base covers",
    left=Integral(2 * b * RingCrossSection(u, x) / (2 * pi * x), (b, 0, 1)),
    corrected=u,
    where=[interval(x, 0, 1, open="left"), interval(u, 0, 1), u**2 + x**2 >= 1],
    reading=AREA + "; x is the cosine of its normals: the ring of deon2016 (8) over 2 pi x",
    reduces=("deon2016:9", "deon2016:10", "deon2016:11", "deon2016:12"),
)


@side.proof
def fully_lit(step):
    step.lemma("deon2016:8.piecewise.rest", {u: u, u_n: x}).settle()
    step.antiderivative(u * b**2)


# --- from the distribution to the profile ---------------------------------------------------------------


def backward(name, titles, ndf, low, square, depth, *, where, at=u, place=None):
    """Two claims: the area that the normals steeper than u cover, and the depth where its normal has this cosine."""
    area = project.claim(
        f"revolution-area.{name}",
        titles[0],
        left=covered(ndf, u),
        corrected=square,
        where=[interval(u, low, 1, open="left"), *where],
        reading=AREA + ": the share of the disk, which is the square of its radius",
    )
    whole = project.claim(
        f"revolution-inverse.{name}",
        titles[1],
        left=depth_of(ndf, at),
        corrected=depth,
        where=[place or interval(u, low, 1, open="left"), *where],
        reading=AREA,
    )
    return area, whole


def steeper(name):
    return f"the area that the normals of {name} steeper than u cover"


dense = 1 - (1 - alpha**2) * x**2

disk_of_sphere, to_sphere = backward(
    "sphere", (steeper("the sphere"), "the uniform distribution comes from the sphere"),
    lambda v: 1 / pi, 0, 1 - u**2, 1 - u, where=[],
)  # fmt: skip
disk_of_sphere.proof(lambda step: step.antiderivative(y**2))
to_sphere.proof(lambda step: step.lemma(disk_of_sphere, {u: x}).antiderivative(x))

disk_of_spheroid, to_spheroid = backward(
    "ggx",
    (steeper("GGX"), "GGX comes from the spheroid: the depth where its normal has the cosine u"),
    lambda v: ggx(v, alpha),
    0,
    (1 - u**2) / (1 - (1 - alpha**2) * u**2),
    alpha * (1 - alpha * u / sqrt(1 - (1 - alpha**2) * u**2)),
    where=[ROUGH],
)


def below_the_axis(step, v, *inside):
    step.fact(dense.subs(x, v), (1 - v) * (1 + v), alpha**2 * v**2, inside=inside)


@disk_of_spheroid.proof
def rational_in_the_square(step):
    below_the_axis(step, y, y, u, 1)
    below_the_axis(step, u)
    step.antiderivative(alpha**2 * y**2 / dense.subs(x, y))


@to_spheroid.proof
def spheroid_from_ggx(step):
    below_the_axis(step, x, x, u, 1)
    below_the_axis(step, u)
    step.lemma(disk_of_spheroid, {u: x}).antiderivative(alpha**2 * x / sqrt(dense))


disk_of_paraboloid, to_paraboloid = backward(
    "paraboloid",
    (steeper("the paraboloid"), "slopes spread evenly over a disk come from the paraboloid"),
    paraboloid,
    0,
    (1 / u**2 - 1) / s**2,
    s * b**2 / 2,
    where=[STEEP],
    at=cosine(s * b),
    place=WITHIN,
)
disk_of_paraboloid.proof(lambda step: step.antiderivative(-1 / (s**2 * y**2)))


def above(step, slope):
    """The cosines of a profile lie between 0 and 1."""
    secant, low = sqrt(1 + slope**2), cosine(slope)
    step.fact(1 + slope**2, 1, slope**2)
    step.fact(secant - 1, slope**2 / (secant + 1))
    step.fact(1 - low, (secant - 1) / secant)
    step.fact(x, x - low, low, inside=(x, low, 1))


@to_paraboloid.proof
def paraboloid_from_even_slopes(step):
    above(step, s * b)
    step.lemma(disk_of_paraboloid, {u: x}).antiderivative(-1 / (2 * s * x**2))


disk_of_bell, to_bell = backward(
    "beckmann",
    (steeper("Beckmann's distribution"),
     "Beckmann's distribution comes from the profile with the slope alpha sqrt(-log(1 - b^2))"),
    lambda v: beckmann(v, alpha),
    0,
    1 - exp(-(1 / u**2 - 1) / alpha**2),
    alpha * Integral(sqrt(-log(1 - t**2)), (t, 0, b)),
    where=[ROUGH],
    at=cosine(alpha * sqrt(-log(1 - b**2))),
    place=WITHIN,
)  # fmt: skip
disk_of_bell.proof(lambda step: step.antiderivative(exp(-(1 / y**2 - 1) / alpha**2)))

ROOT = sqrt(-log(1 - b**2))  # the slope at b, in units of alpha


rising = project.claim(
    "revolution-beckmann.slope",
    "the square of the slope, over alpha^2, exceeds b^2",
    left=-log(1 - b**2) - b**2,
    corrected=Integral(2 * t**3 / (1 - t**2), (t, 0, b)),
    where=[WITHIN],
)
rising.proof(lambda step: step.swap().antiderivative(-(t**2) - log(1 - t**2)))


def sloping(step):
    step.fact(-log(1 - b**2), b**2, -log(1 - b**2) - b**2, by=rising, mapping={b: b})


@to_bell.proof
def logarithm_of_the_radius(step):
    sloping(step)
    above(step, alpha * ROOT)
    step.lemma(disk_of_bell, {u: x}).substitute(q, cosine(alpha * q), ROOT, 0)
    step.swap().substitute(q, sqrt(1 - exp(-(q**2))), 0, ROOT)


by_slope = project.claim(
    "revolution-inverse.beckmann.slope",
    "the same depth over the slope, in units of alpha",
    left=Integral(sqrt(-log(1 - t**2)), (t, 0, b)),
    corrected=Integral(q**2 * exp(-(q**2)) / sqrt(1 - exp(-(q**2))), (q, 0, ROOT)),
    where=[WITHIN],
    reading="at the radius b the slope is alpha sqrt(-log(1 - b^2))",
)


@by_slope.proof
def radius_by_slope(step):
    sloping(step)
    step.substitute(q, sqrt(1 - exp(-(q**2))), 0, ROOT)


# --- the spherical Gaussian of a hemisphere -------------------------------------------------------------

peak = (kappa - 1) * exp(kappa) + 1


def left_over(v):
    """kappa^2 times the integral of y exp(kappa y) from v to 1."""
    return (kappa - 1) * exp(kappa) - (kappa * v - 1) * exp(kappa * v)


def half_gaussian(v):
    """The spherical Gaussian above the horizon, with unit projected area."""
    return kappa**2 * exp(kappa * v) / (2 * pi * peak)


SHARP = interval(kappa, 0, oo, open=True)

more = project.claim(
    "revolution-area.gaussian-excess",
    "what the spherical Gaussian covers beyond a uniform distribution, up to its scale",
    left=left_over(u) - kappa**2 * (1 - u**2) / 2,
    corrected=kappa**2 * Integral(y * (exp(kappa * y) - 1), (y, u, 1)),
    where=[interval(u, 0, 1), SHARP],
)


@more.proof
def by_parts(step):
    step.swap().antiderivative((y / kappa - 1 / kappa**2) * exp(kappa * y) - y**2 / 2)


disk_of_gaussian, to_gaussian = backward(
    "gaussian",
    (steeper("the spherical Gaussian above the horizon"),
     "the spherical Gaussian above the horizon comes from a profile whose depth is one integral"),
    half_gaussian,
    0,
    left_over(u) / peak,
    kappa**2 / 2 * Integral(sqrt(1 - x**2) * exp(kappa * x) / sqrt(peak * left_over(x)), (x, u, 1)),
    where=[SHARP],
)  # fmt: skip

unit = project.claim(
    "revolution-area.gaussian.norm",
    "the normalisation of the spherical Gaussian above the horizon",
    left=covered(half_gaussian, 0),
    corrected=1,
    where=[SHARP],
    reading=AREA,
)


def positive(step):
    step.fact(peak, kappa**2 / 2, peak - kappa**2 / 2, by=more, mapping={u: 0})


@disk_of_gaussian.proof
@unit.proof
def exponential_by_parts(step):
    positive(step)
    step.antiderivative((kappa * y - 1) * exp(kappa * y) / peak)


@to_gaussian.proof
def one_integration_less(step):
    positive(step)
    uniform = kappa**2 * (1 - x**2) / 2
    step.fact(left_over(x), uniform, left_over(x) - uniform, by=more, mapping={u: x}, inside=(x, u, 1))
    step.lemma(disk_of_gaussian, {u: x})


if __name__ == "__main__":
    project.tell()
