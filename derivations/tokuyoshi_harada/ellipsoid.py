"""Section 2: the line through the origin, the ellipsoid made a unit sphere, and the distance in five equal forms.

The semi-axes are a choice of the paper's. What follows from them holds for every vector (x, y, z) other than 0, of unit
length or not, so the claims ask for no more than that.
"""

from sympy import Heaviside, Integral, Matrix, Max, cos, oo, sin, sqrt, symbols

from xsec_sym.proof import Source, interval

paper = Source("tokuyoshi_harada", section="2")

x, y, z, t = symbols("x y z t", real=True)
alpha_x, alpha_y = symbols("alpha_x alpha_y", real=True)
ROUGH = [interval(alpha_x, 0, 1, open="left"), interval(alpha_y, 0, 1, open="left")]
SPACE = [*(interval(v, -oo, oo) for v in (x, y, z)), x**2 + y**2 + z**2 > 0]
DISTANCE = interval(t, 0, oo)
SCALED = "(x, y, z) is any vector but 0: unit length is not needed"

alpha_max = Max(alpha_x, alpha_y)
square = alpha_max**2


# --- the ellipsoid and the line -------------------------------------------------------------------------

semi_axes = (alpha_x, alpha_y, (1 + square) / 2)
centre = (0, 0, (1 - square) / 2)
omega = (x, y, z)

paper.definition(
    "r.aniso",
    "the semi-axes for two roughness parameters",
    left=Matrix([symbols("r_x r_y r_z", real=True)]),
    printed=Matrix([semi_axes]),
    reading="in lobe space; alpha_max is the larger of alpha_x and alpha_y",
)

peak = paper.claim(
    "c.aniso",
    "the centre of the ellipsoid, along the axis",
    left=1 - semi_axes[2],
    printed=(1 - square) / 2,
    where=ROUGH,
    reading="the component along the axis: as for the spheroid, the lobe is 1 there. The other two are 0 by choice",
)

paper.definition(
    "p",
    "a position on the line",
    left=Matrix([symbols("p_x p_y p_z", real=True)]),
    printed=Matrix([[t * x, t * y, t * z]]),
    reading="t is the distance from the origin for a direction of unit length",
)


def by_cases(step):
    """Where either parameter is the larger one, and where both are alike."""
    for branch in step.cases(alpha_x - alpha_y, alpha_x, alpha_y):
        branch.settle()


peak.proof(lambda step: None)


# --- the ellipsoid as a unit sphere ---------------------------------------------------------------------


def to_the_sphere(position):
    """Shift the centre to the origin, and divide by the semi-axes."""
    return tuple((p - c) / r for p, c, r in zip(position, centre, semi_axes, strict=True))


moved = to_the_sphere([t * w for w in omega])
start = to_the_sphere([0, 0, 0])
direction = tuple(a - b for a, b in zip(to_the_sphere(omega), start, strict=True))

d = (x / alpha_x, y / alpha_y, 2 * z / (1 + square))  # (1)
s = (0, 0, -(1 - square) / (1 + square))  # (2)
AXES = ("x", "y", "z")
BESIDE = "component by component: "
UNTOUCHED = BESIDE + "the left side shifts the centre of the ellipsoid to the origin and divides by its semi-axes"

shift_and_scale = (t * x / alpha_x, t * y / alpha_y, (t * z - centre[2]) * z / (1 + square))
mended = (*shift_and_scale[:2], (t * z - centre[2]) * 2 / (1 + square))
for axis, left, matrix, right in zip(AXES, moved, shift_and_scale, mended, strict=True):
    slip = {"corrected": right, "edit": "the last entry of the matrix is 2 / (1 + alpha_max^2), not z over that"}
    paper.claim(f"p.prime.matrix.{axis}", f"the transformed position by the matrix, along {axis}", left=left,
                printed=matrix, where=[*SPACE, *ROUGH, DISTANCE], reading=UNTOUCHED,
                **(slip if axis == "z" else {})).proof(lambda step: None)  # fmt: skip
for i, axis in enumerate(AXES):
    paper.claim(f"p.prime.line.{axis}", f"the transformed position as t d + s, along {axis}", left=moved[i],
                printed=t * d[i] + s[i], where=[*SPACE, *ROUGH, DISTANCE], reading=UNTOUCHED
                ).proof(lambda step: None)  # fmt: skip
paper.whole("p.prime", "the transformed line", [f"p.prime.{how}.{axis}" for how in ("matrix", "line") for axis in AXES],
            left=Matrix([symbols("p'_x p'_y p'_z", real=True)]), printed=Matrix([shift_and_scale]),
            reading="the product with the printed matrix; its second form is t d + s")  # fmt: skip

for number, vector, images, name in (("1", d, direction, "direction"), ("2", s, start, "starting point")):
    for axis, image, printed in zip(AXES, images, vector, strict=True):
        if number == "1" or axis == "z":
            paper.claim(f"{number}.{axis}", f"the {name} of the transformed line, along {axis}", left=image,
                        printed=printed, where=[*SPACE, *ROUGH], reading=UNTOUCHED
                        ).proof(lambda step: None)  # fmt: skip
paper.whole("1", "the direction of the transformed line", [f"1.{axis}" for axis in AXES],
            left=Matrix([symbols("d_x d_y d_z", real=True)]), printed=Matrix([d]))  # fmt: skip
paper.whole("2", "the starting point of the transformed line", ["2.z"],
            left=Matrix([symbols("s_x s_y s_z", real=True)]), printed=Matrix([s]),
            reading="the other two components are those of the centre, 0")  # fmt: skip

beta, gamma = symbols("beta gamma", real=True)
unit = (sin(beta) * cos(gamma), sin(beta) * sin(gamma), cos(beta))
on_ellipsoid = tuple(c + r * n for c, r, n in zip(centre, semi_axes, unit, strict=True))
scales = (1 / alpha_x, 1 / alpha_y, 2 / (1 + square))

paper.claim(
    "sphere",
    "the transformed ellipsoid is the unit sphere",
    left=sum(((p - c) * k) ** 2 for p, c, k in zip(on_ellipsoid, centre, scales, strict=True)),
    printed=1,
    where=[interval(beta, 0, oo), interval(gamma, 0, oo), *ROUGH],
    reading="beta and gamma run over the ellipsoid, whose points the mended matrix moves",
).proof(lambda step: None)


# --- the quadratic equation -----------------------------------------------------------------------------


def dot(a, b):
    return sum(p * q for p, q in zip(a, b, strict=True))


def positive_root(d, s):
    """Equation (3)."""
    return (sqrt(dot(d, s) ** 2 - dot(d, d) * (dot(s, s) - 1)) - dot(d, s)) / dot(d, d)


paper.claim(
    "quadratic",
    "the intersection as a quadratic equation for the distance",
    left=sum(p**2 for p in moved) - 1,
    printed=dot(d, d) * t**2 + 2 * dot(d, s) * t + dot(s, s) - 1,
    where=[*SPACE, *ROUGH, DISTANCE],
    reading="the left side is |p'|^2 - 1, which vanishes on the ellipsoid; so does the right",
).proof(by_cases)

dd, ds, ss = symbols("dd ds ss", real=True)
wide = sqrt(ds**2 - dd * (ss - 1))

root = paper.claim(
    "3",
    "the positive solution",
    left=Integral(Heaviside(1 - (dd * t**2 + 2 * ds * t + ss)), (t, 0, oo)),
    printed=(wide - ds) / dd,
    where=[interval(dd, 0, oo, open=True), interval(ds, -oo, oo), interval(ss, 0, 1, open="right")],
    reading="dd = |d|^2, ds = d.s and ss = |s|^2 < 1, since the origin lies inside the ellipsoid; the left side is the "
    "length of the ray inside",
    points={t: [(wide - ds) / dd]},
)


@root.proof
def inside_until_the_root(step):
    """1 - |p'|^2 is dd (t_1 - t) (t + t_2) with t_1, t_2 > 0."""
    step.fact(wide**2, ds**2, dd * (1 - ss))
    for branch in step.cases(ds):
        known = branch.goal.piece.sign(ds)
        here = {ds: ds if known in ("+", "-") else 0}
        ahead, behind, depth = (e.subs(here) for e in ((wide - ds) / dd, (wide + ds) / dd, root.left.function.args[0]))
        if known == "+":
            branch.fact(ahead, (1 - ss) / (wide + ds))
        elif known == "-":
            branch.fact(behind, (1 - ss) / (wide - ds))
        branch.fact(depth, dd * (ahead - t) * (t + behind), inside=(t, 0, ahead))
        branch.fact(depth, -dd * (t - ahead) * (t + behind), inside=(t, ahead, oo))
        branch.split(ahead).antiderivative(t)


# --- the distance in five forms -------------------------------------------------------------------------

ratio_x, ratio_y = square / alpha_x**2, square / alpha_y**2
stretched = ratio_x * x**2 + ratio_y * y**2
U = sqrt(stretched + z**2)
under_one_root = (1 + square) * sqrt(stretched + z**2 + z * (1 - square))
numerator = (1 + square) * U + z * (1 - square)

below_1 = (1 + square) ** 2 * (x**2 / alpha_x**2 + y**2 / alpha_y**2 + 4 * z**2 / (1 + square) ** 2)
below_2 = (1 + square) ** 2 * stretched + 4 * z**2 * square
below_3 = (1 + square) ** 2 * (stretched + z**2) - z**2 * (1 + square) ** 2 + 4 * z**2 * square
below_4 = (1 + square) ** 2 * (stretched + z**2) - z**2 * (1 - square) ** 2

distance = positive_root(d, s)
LINES = (
    ("with the vectors put in", 2, below_1),
    ("with alpha_max^2 below", 2 * square, below_2),
    ("with z^2 added and taken off", 2 * square, below_3),
    ("as a difference of squares below", 2 * square, below_4),
)


for i, (what, scale, below) in enumerate(LINES, 1):
    paper.claim(
        f"t.{i}",
        f"the distance {what}",
        left=distance,
        printed=scale * under_one_root / below,
        corrected=scale * numerator / below,
        edit="draw the root over the three squares only: z (1 - alpha_max^2) stands outside",
        where=[*SPACE, *ROUGH],
        reading="the left side is (3) with (1) and (2); " + SCALED + ". The print fails on unit vectors as well",
    ).proof(by_cases)

paper.claim(
    "t.5",
    "the distance with the common factor cancelled",
    left=distance,
    printed=2 * square / ((1 + square) * U - z * (1 - square)),
    where=[*SPACE, *ROUGH],
    reading="the left side is (3) with (1) and (2); " + SCALED,
).proof(by_cases)


if __name__ == "__main__":
    paper.tell()
