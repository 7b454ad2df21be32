"""What the squared lobes of tokuyoshi_harada integrate to over the sphere.

For one roughness an elementary antiderivative does. For two, the sphere is given its poles on the y axis, the one of
the smaller roughness: then stretching the directions along y moves them along the meridians only. The circles of
latitude integrate in closed form, and what is left is an incomplete elliptic integral of the second kind.
"""

from sympy import Integral, atan, cos, oo, pi, sin, sqrt, symbols

from derivations.tokuyoshi_harada.ellipsoid import alpha_max, alpha_x, alpha_y
from derivations.tokuyoshi_harada.lobe import lobe
from derivations.tokuyoshi_harada.spheroid import AREA, ROUGH, alpha, m
from xsec_sym.exact import LobeGGX
from xsec_sym.proof import Source, interval

project = Source("xsec", section="ellipsoidal lobe, integral")

y, h, t, w, A, B = symbols("y h t w A B", real=True)
EITHER = [interval(alpha_x, 0, 1, open="left"), interval(alpha_y, 0, alpha_x, open="left")]
LARGER = "alpha_x >= alpha_y; where it is the other way round, they change places"

whole = project.claim(
    "ssl-integral",
    "the integral of the squared spheroidal lobe over the sphere",
    left=Integral(2 * pi * LobeGGX(m, alpha), (m, -1, 1)),
    corrected=4 * pi * alpha**2,
    where=[ROUGH],
    reading=AREA,
)


@whole.proof
def rational(step):
    below = 1 - m + alpha**2 * (1 + m)
    step.unfold().fact(below, (1 - m) * (1 - alpha**2), 2 * alpha**2, inside=(m, -1, 1))
    step.antiderivative(4 * pi * alpha**4 * (1 + m) / below)


# --- circles of latitude --------------------------------------------------------------------------------

circle = project.claim(
    "mean-over-a-circle.square",
    "the mean of 1 / (A - B cos)^2 over a circle",
    left=Integral(1 / (A - B * cos(2 * pi * t)) ** 2, (t, 0, 1)),
    corrected=A / sqrt(A**2 - B**2) ** 3,
    where=[interval(A, 0, oo, open=True), interval(B, 0, A, open="right")],
)


@circle.proof
def continuous_primitive(step):
    """That of the first power, and a quotient that is the same at both ends."""
    step.fact(A**2 - B**2, (A - B) * (A + B))
    root = sqrt(A**2 - B**2)
    wave = cos(2 * pi * t)
    step.fact(A - B * wave, A - B, B * (1 - wave), inside=(t, 0, 1))
    first = (t + atan(B * sin(2 * pi * t) / (A + root - B * wave)) / pi) / root
    step.antiderivative(A * first / root**2 + B * sin(2 * pi * t) / (2 * pi * root**2 * (A - B * wave)))


# --- the sphere with its poles on the y axis ------------------------------------------------------------

across = sqrt(1 - y**2)
K = lobe(across * sin(2 * pi * t), y, across * cos(2 * pi * t)).subs(alpha_max, alpha_x)
stretch = alpha_x**2 - (alpha_x**2 - alpha_y**2) * h**2
flat = 4 * alpha_x**2 + (1 - alpha_x**2) ** 2 * h**2

scale = 4 * alpha_x**4 * alpha_y * (1 + alpha_x**2)

single = project.claim(
    "sel-integral.single",
    "the integral of the squared ellipsoidal lobe over the sphere, as an integral over one variable",
    left=2 * pi * Integral(K, (t, 0, 1), (y, -1, 1)),
    corrected=8 * pi * alpha_x**4 * alpha_y * (1 + alpha_x**2)
    * Integral(1 / (sqrt(flat) ** 3 * sqrt(stretch)), (h, -1, 1)),
    where=EITHER,
    reading=LARGER + "; (x, y, z) = (sqrt(1 - y^2) sin(2 pi t), y, sqrt(1 - y^2) cos(2 pi t))",
)  # fmt: skip


@single.proof
def along_the_meridians(step):
    """y = alpha_y h / sqrt(alpha_x^2 (1 - h^2) + alpha_y^2 h^2): h belongs to the stretched direction."""
    step.nest()
    widest = (alpha_x - alpha_y) * (alpha_x + alpha_y)
    step.fact(stretch, alpha_y**2, widest * (1 - h) * (1 + h), inside=(h, -1, 1))
    step.substitute(h, alpha_y * h / sqrt(stretch), -1, 1)
    inner = next(i for i in step.left.atoms(Integral) if i.limits[0][0] == t)
    A_here, B_here = 1 + alpha_x**2, sqrt(1 - h**2) * (1 - alpha_x**2)
    step.rewrite(inner.function, stretch / alpha_x**2 / (A_here - B_here * cos(2 * pi * t)) ** 2)
    inner = next(i for i in step.left.atoms(Integral) if i.limits[0][0] == t)
    step.linear(inner.function, integral=inner)
    apart = (1 - alpha_x**2) * h**2 / (1 + sqrt(1 - h**2))
    step.fact(A_here - B_here, 2 * alpha_x**2, apart, inside=(h, -1, 1))
    step.lemma(circle, {A: A_here, B: B_here})
    step.fact(flat, 4 * alpha_x**2, (1 - alpha_x**2) ** 2 * h**2, inside=(h, -1, 1))
    step.rewrite(step.integrals[0].function, scale / (sqrt(flat) ** 3 * sqrt(stretch)))
    step.linear(step.integrals[0].function)


ends = 1 / (1 + alpha_x**2)
squared = (1 + alpha_x**2) ** 2 - 4 * alpha_y**2

legendre = project.claim(
    "sel-integral",
    "the integral of the squared ellipsoidal lobe over the sphere, as an elliptic integral",
    left=8 * pi * alpha_x**4 * alpha_y * (1 + alpha_x**2)
    * Integral(1 / (sqrt(flat) ** 3 * sqrt(stretch)), (h, -1, 1)),
    corrected=2 * pi * alpha_x * alpha_y * (1 + alpha_x**2)
    * Integral(sqrt((1 - (1 - alpha_x**2) ** 2 * w**2) / (1 - squared * w**2)), (w, -ends, ends)),
    where=EITHER,
    reading=LARGER + "; the left side is that of sel-integral.single. With g^2 = (1 + alpha_x^2)^2 - 4 alpha_y^2 and "
    "k = (1 - alpha_x^2) / g the right side is 4 pi alpha_x alpha_y (1 + alpha_x^2) / g times Legendre's "
    "E(arcsin(g / (1 + alpha_x^2)), k), the argument of whose sine is g w",
)  # fmt: skip


@legendre.proof
def towards_legendre(step):
    """h = 2 alpha_x w / sqrt(1 - (1 - alpha_x^2)^2 w^2)."""
    bend = (1 - alpha_x**2) ** 2
    for side in (w, -w):
        left_over = (1 - alpha_x**2) * (ends - side), 2 * alpha_x**2 * ends
        step.fact(1 - (1 - alpha_x**2) * side, *left_over, inside=(w, -ends, ends))
    step.substitute(w, 2 * alpha_x * w / sqrt(1 - bend * w**2), -ends, ends)


# --- bounds ---------------------------------------------------------------------------------------------

rise = sqrt((1 - (1 - alpha_x**2) ** 2 * w**2) / (1 - squared * w**2))  # from 1 at w = 0 to alpha_x / alpha_y
above = legendre.form - 4 * pi * alpha_x * alpha_y
beneath = 4 * pi * alpha_x**2 - legendre.form
factor = 2 * pi * alpha_x * alpha_y * (1 + alpha_x**2)


def between_the_ends(step):
    """Both polynomials under the root are positive, and their quotient lies between its values at 0 and at the ends."""
    for side in (w, -w):
        step.fact(1 - (1 - alpha_x**2) * side, (1 - alpha_x**2) * (ends - side), 2 * alpha_x**2 * ends,
                  inside=(w, -ends, ends))  # fmt: skip
    gap = 4 * (alpha_x - alpha_y) * (alpha_x + alpha_y)
    bottom = 1 - squared * w**2
    middle = (ends - w) * (ends + w)
    step.fact(bottom, 4 * alpha_y**2 * ends**2, (1 - alpha_x**2) ** 2 * middle, gap * middle, inside=(w, -ends, ends))
    step.fact(rise - 1, gap * w**2 / bottom / (rise + 1), inside=(w, -ends, ends))
    share = gap * (1 + alpha_x**2) ** 2 * middle / (4 * alpha_y**2 * bottom)
    step.fact(alpha_x / alpha_y - rise, share / (alpha_x / alpha_y + rise), inside=(w, -ends, ends))


for name, more, form, constant, sign in (
    ("least", rise - 1, above, 1, 1),
    ("most", alpha_x / alpha_y - rise, beneath, alpha_x / alpha_y, -1),
):
    excess = project.claim(
        f"sel-integral.{name}.excess",
        "the integral of the squared ellipsoidal lobe against its bound",
        left=factor * Integral(more, (w, -ends, ends)),
        corrected=form,
        where=EITHER,
        reading=LARGER,
    )
    bound = project.inequality(
        f"sel-integral.{name}",
        f"the integral of the squared ellipsoidal lobe is at {name} 4 pi alpha_x "
        + ("alpha_y" if sign == 1 else "times alpha_x"),
        form, where=EITHER, reading=LARGER,
    )  # fmt: skip

    @excess.proof
    def apart(step, constant=constant, sign=sign):
        between_the_ends(step)
        step.linear(sign * rise, -sign * constant)
        step.antiderivative(w, next(i for i in step.integrals if not i.function.has(w)))

    @bound.proof
    def one_sign(step, excess=excess):
        between_the_ends(step)
        step.fact(step.right, by=excess, back=True).settle()


if __name__ == "__main__":
    project.tell()
