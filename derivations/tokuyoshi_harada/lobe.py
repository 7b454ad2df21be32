"""Section 2, the result: the squared ellipsoidal lobe K, along its axis and turned into any orientation.

K is the squared distance from the origin to the ellipsoid. Each form is tested against the positive root (3) of the
quadratic equation, with the vectors (1) and (2) put in.
"""

from sympy import Function, cos, oo, sin, sqrt, symbols

from derivations.tokuyoshi_harada.ellipsoid import (
    ROUGH,
    SCALED,
    SPACE,
    alpha_x,
    alpha_y,
    by_cases,
    distance,
    dot,
    positive_root,
    scales,
    square,
    x,
    y,
    z,
)
from xsec_sym.proof import Source, interval

paper = Source("tokuyoshi_harada", section="2")

NAMES = "the print writes I for t, and alpha for alpha_y among the arguments of K"


def stretched_length(x, y, z):
    """U of the paper's last display."""
    return sqrt(square / alpha_x**2 * x**2 + square / alpha_y**2 * y**2 + z**2)


def lobe(x, y, z):
    """K of a vector in lobe space, as the paper has it."""
    return 4 * square**2 / ((1 + square) * stretched_length(x, y, z) - z * (1 - square)) ** 2


# --- in lobe space --------------------------------------------------------------------------------------

upright = paper.claim(
    "K.E",
    "the squared ellipsoidal lobe, its axis along z",
    left=distance**2,
    printed=lobe(x, y, z),
    where=[*SPACE, *ROUGH],
    reading="the square of (3) with (1) and (2); " + NAMES + "; " + SCALED,
)
upright.proof(by_cases)


# --- turned ---------------------------------------------------------------------------------------------

a, b, c = symbols("a b c", real=True)
ANGLES = [interval(angle, -4, 4) for angle in (a, b, c)]  # more than a turn

# The rows of Q: every rotation has three such angles
Q = (
    (cos(a) * cos(c) - cos(b) * sin(a) * sin(c), sin(a) * cos(c) + cos(b) * cos(a) * sin(c), sin(b) * sin(c)),
    (-cos(a) * sin(c) - cos(b) * sin(a) * cos(c), -sin(a) * sin(c) + cos(b) * cos(a) * cos(c), sin(b) * cos(c)),
    (sin(b) * sin(a), -sin(b) * cos(a), cos(b)),
)
v = tuple(dot(row, (x, y, z)) for row in Q)
aslant = tuple(dot(row, Q[2]) for row in Q)  # the rows against the axis of the lobe: 0, 0 and 1

# the ellipsoid with its axes along the rows of Q, and its centre on the last of them
turned_d = tuple(w * k for w, k in zip(v, scales, strict=True))
turned_s = tuple(w * (square - 1) / 2 * k for w, k in zip(aslant, scales, strict=True))

turned = paper.claim(
    "K.Q",
    "the squared ellipsoidal lobe in any orientation",
    left=positive_root(turned_d, turned_s) ** 2,
    printed=lobe(*v),
    where=[*SPACE, *ROUGH, *ANGLES],
    reading="Q is written with three angles; an orthogonal matrix that reflects has -v_x for v_x, which K squares. The "
    "left side is the squared distance to the ellipsoid with its axes along the rows of Q and its centre on the last "
    "of them. What the print calls Eq. (2) here is its unnumbered K; " + NAMES,
)


@turned.proof
def orthogonal_rows(step):
    """The vectors are those of the upright lobe at v = Q omega, since the rows of Q are orthogonal."""
    for product, value in zip(aslant, (0, 0, 1), strict=True):
        step.rewrite(product, value, "the rows of Q are orthogonal, and the last has unit length")
    step.fact(dot(v, v), x**2 + y**2 + z**2)
    step.lemma(upright, dict(zip((x, y, z), v, strict=True)))


v_x, v_y, v_z = symbols("v_x v_y v_z", real=True)
IN_LOBE_SPACE = dict(zip((x, y, z), (v_x, v_y, v_z), strict=True))
UNLIT = [item.subs(IN_LOBE_SPACE) for item in SPACE[3:]]

paper.definition("U", "the length of the stretched direction", left=Function("U")(v_x, v_y, v_z),
                 printed=stretched_length(v_x, v_y, v_z), reading="in lobe space")  # fmt: skip

U = stretched_length(v_x, v_y, v_z)
paper.claim(
    "K.U",
    "the squared ellipsoidal lobe by U",
    left=distance.subs(IN_LOBE_SPACE, simultaneous=True) ** 2,
    printed=4 * square**2 / ((U - v_z) + square * (U + v_z)) ** 2,
    where=[*(interval(w, -oo, oo) for w in (v_x, v_y, v_z)), *UNLIT, *ROUGH],
    reading="the square of (3) with (1) and (2), (v_x, v_y, v_z) being the direction in lobe space; " + NAMES,
).proof(by_cases)


if __name__ == "__main__":
    paper.tell()
