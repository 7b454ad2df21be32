"""Sections 2.2 and 3.3-3.4: the azimuthal modes of the three-term phase function, and of what is scattered once.

mu_i and mu_o are the cosines of the directions; mu is the cosine of the deviation (9). A BRDF has both directions point
away from the surface, so that single scattering takes the phase function at - mu.
"""

from sympy import Function, Integral, Rational, Symbol, cos, exp, legendre, oo, pi, sin, sqrt, symbols

from xsec_sym.proof import Source, integers, interval

paper = Source("deon2021", section="2.2")

mu, mu_i, mu_o, phi, x, c = symbols("mu mu_i mu_o phi x c", real=True)
k = Symbol("k", integer=True)
n = Symbol("n", integer=True, nonnegative=True)
INSIDE = [interval(mu_i, -1, 1), interval(mu_o, -1, 1)]
OUTSIDE = [interval(mu_i, 0, 1, open="left"), interval(mu_o, 0, 1, open="left")]
ALBEDO = interval(c, 0, 1)

sine_i, sine_o = sqrt(1 - mu_i**2), sqrt(1 - mu_o**2)
DEVIATION = mu_i * mu_o + sine_i * sine_o * cos(phi)


def three_terms(v):
    """The phase function cut after A_2 P_2, per steradian."""
    return (1 - Rational(4, 3) * v + Rational(5, 16) * legendre(2, v)) / (4 * pi)


# --- the phase function's modes -------------------------------------------------------------------------

short = paper.claim(
    "5",
    "the phase function cut after the third term",
    left=three_terms(mu),
    printed=(Rational(27, 32) - 4 * pi / 3 + 15 * mu**2 / 32) / (4 * pi),
    corrected=(Rational(27, 32) - 4 * mu / 3 + 15 * mu**2 / 32) / (4 * pi),
    edit="mu for pi in the second term",
    where=[interval(mu, -1, 1)],
    reading="A_0, A_1 and A_2 of (4), with the Legendre polynomials; per steradian",
)
short.proof(lambda step: None)

p = Function("p", real=True)
paper.definition(
    "8",
    "the Fourier modes of the phase function",
    left=Symbol("p_l", real=True),
    printed=(2 - Symbol("delta_0l", integer=True)) / pi * Integral(p(mu_i, mu_o, phi) * cos(k * phi), (phi, 0, pi)),
    reading="k is the print's l; so p = p_0 + p_1 cos(phi) + p_2 cos(2 phi)",
)
paper.definition("9", "the cosine of the deviation", left=mu, printed=DEVIATION)


def mode(order):
    """(8) for the three-term phase function at (9)."""
    factor = (1 if order == 0 else 2) / pi
    return factor * Integral(three_terms(DEVIATION) * cos(order * phi), (phi, 0, pi))


def harmonics(order, sign=1):
    """An antiderivative in phi of three_terms(sign * (9)) cos(order phi), for a number or a symbol beyond 2."""
    product, radius = mu_i * mu_o, sine_i * sine_o
    a, b, d = Rational(27, 32), -Rational(4, 3) * sign, Rational(15, 32)
    amplitudes = {0: a + b * product + d * (product**2 + radius**2 / 2), 1: b * radius + 2 * d * product * radius,
                  2: d * radius**2 / 2}  # fmt: skip

    def integral(n):
        return phi if n == 0 else sin((n * phi).expand()) / n

    return sum(f * (integral(order - j) + integral(order + j)) / 2 for j, f in amplitudes.items()) / (4 * pi)


MODES = (
    (45 * mu_i**2 * (3 * mu_o**2 - 1) - 256 * mu_i * mu_o - 45 * mu_o**2 + 207) / (768 * pi),
    (45 * mu_i * mu_o - 64) * sqrt((mu_i**2 - 1) * (mu_o - 2 - 1)) / (192 * pi),
    15 * (mu_i**2 - 1) * (mu_o**2 - 1) / (256 * pi),
)
MENDED = (45 * mu_i * mu_o - 64) * sqrt((mu_i**2 - 1) * (mu_o**2 - 1)) / (192 * pi)

for order, (printed, corrected, edit) in enumerate(
    zip(MODES, (None, MENDED, None), ("", "mu_o^2 for mu_o - 2: the exponent has slipped", ""), strict=True)
):
    paper.claim(
        str(10 + order),
        f"the mode {order} of the three-term phase function",
        left=mode(order),
        printed=printed,
        **({"corrected": corrected, "edit": edit} if edit else {}),
        where=INSIDE,
        reading="(8) with (5) as mended, at (9)",
    ).proof(lambda step, order=order: step.beats().antiderivative(harmonics(order)))

higher = paper.claim(
    "claim.no-higher-mode",
    "the three-term phase function has no modes beyond the second",
    left=2 / pi * Integral(three_terms(DEVIATION) * cos((n + 3) * phi), (phi, 0, pi)),
    printed=0,
    where=[*INSIDE, integers(n, 0, 200)],
    reading="(8) with (5) as mended, at (9); the mode is n + 3",
    statement=True,
)


@higher.proof
def whole_turns(step):
    (count,) = (symbol for symbol in step.left.free_symbols if symbol.is_integer)
    step.beats().antiderivative(harmonics(count + 3))


# --- scattered once -------------------------------------------------------------------------------------

p_mu = Symbol("p", real=True)
f, f_1, f_m = (Function(name, real=True) for name in ("f", "f_1", "f_m"))

paper.definition(
    "16",
    "the modes of the BRDF",
    left=f(mu_i, mu_o, phi),
    printed=sum(Function(f"f^({n})", real=True)(mu_i, mu_o) * cos(n * phi) for n in range(3)),
    reading="for the three-term phase function; phi = 0 sends light back",
)

once = paper.claim(
    "17",
    "the light that is scattered once",
    left=Integral(c * p_mu * exp(-x / mu_i) * exp(-x / mu_o) / (mu_i * mu_o), (x, 0, oo)),
    printed=c * p_mu / (mu_i + mu_o),
    where=[*OUTSIDE, ALBEDO, interval(p_mu, 0, oo)],
    reading="p is the phase function per steradian, at minus the cosine between the outward directions; x is the "
    "optical depth",
)


@once.proof
def two_attenuations(step):
    both = 1 / mu_i + 1 / mu_o
    step.antiderivative(-c * p_mu * exp(-x * both) / (mu_i * mu_o * both))


paper.definition(
    "18",
    "the BRDF as what is scattered once and more than once",
    left=f(mu_i, mu_o, phi),
    printed=f_1(mu_i, mu_o, phi) + f_m(mu_i, mu_o, phi),
)
paper.definition(
    "f_m",
    "the modes of what is scattered more than once",
    left=f_m(mu_i, mu_o, phi),
    printed=sum(Function(f"f_m^({n})", real=True)(mu_i, mu_o) * cos(n * phi) for n in range(3)),
)


def scattered_once(order):
    """(43) and (33): the mode of (17) with the three-term phase function."""
    factor = (Rational(1, 2) if order == 0 else 1) / pi
    return factor * Integral(c / (mu_i + mu_o) * three_terms(-DEVIATION) * cos(order * phi), (phi, -pi, pi))


for label, order, printed, corrected in (
    (
        "33",
        1,
        c * (45 * mu_i * mu_o + 64) * sqrt((mu_i**2 - 1) * (mu_o**2 - 1)) / (384 * pi * (mu_i + mu_o)),
        c * (45 * mu_i * mu_o + 64) * sqrt((mu_i**2 - 1) * (mu_o**2 - 1)) / (192 * pi * (mu_i + mu_o)),
    ),
    (
        "43",
        0,
        c * (207 + 135 * mu_i**2 * mu_o**2 - 45 * (mu_i**2 + mu_o**2) + 256 * mu_i * mu_o)
        / (768 * pi * (mu_i + mu_o)),
        None,
    ),
):  # fmt: skip
    paper.definition(
        label,
        f"the mode {order} of what is scattered once",
        left=Symbol(f"f_1^({order})", real=True),
        printed=scattered_once(order),
        reading="by (16), the coefficient of cos(l phi) of (17); with (5) as mended",
    )
    paper.claim(
        str(int(label) + 1),
        f"the mode {order} of what is scattered once, in closed form",
        left=scattered_once(order),
        printed=printed,
        **({"corrected": corrected, "edit": "192 for 384"} if corrected else {}),
        where=[*OUTSIDE, ALBEDO],
        reading="the integral printed before it, with (5) as mended",
    ).proof(lambda step, order=order: step.beats().antiderivative(c / (mu_i + mu_o) * harmonics(order, -1)))

for label, order in (("35", 1), ("45", 0)):
    whole, single = (Function(f"f{which}^({order})", real=True)(mu_i, mu_o) for which in ("", "_1"))
    paper.definition(
        label,
        f"the mode {order} of what is scattered more than once",
        left=Function(f"f_m^({order})", real=True)(mu_i, mu_o),
        printed=whole - single,
    )

if __name__ == "__main__":
    paper.tell()
