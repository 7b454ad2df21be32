"""Section 3.6: the fast variant of the model.

It stands for the model of the sections before, (18): the truth here is that model without its fits. What is scattered
once is the same in both, so that the errors are those of what is scattered more often. Over the azimuth they are
integrated in closed form; where c >= 1/4, what is added to single scattering is positive and (48) needs no maximum.
"""

from sympy import Abs, Float, Integral, Max, Poly, Rational, Symbol, acos, cos, integrate, pi, sqrt, symbols

from derivations.deon2021.fourier import three_terms
from xsec_sym.exact.solved import AlbedoLambertSphere, ModeLambertSphere
from xsec_sym.proof import Source, interval
from xsec_sym.proof.accuracy import T

paper = Source("deon2021", section="3.6")

mu_i, mu_o, phi, c = symbols("mu_i mu_o phi c", real=True)
d = Float

S = sqrt(1 - mu_i**2) * sqrt(1 - mu_o**2)
total = mu_i + mu_o
deviation = -mu_i * mu_o - S * cos(phi)
seen = Max(deviation, -1)  # against rounding
single = c * 2 * (sqrt(1 - seen**2) - seen * acos(seen)) / (3 * pi**2 * total)
orders = [ModeLambertSphere(order, mu_i, mu_o, c) for order in range(3)]
modes = sum(mode * cos(order * phi) for order, mode in enumerate(orders))

k_d = AlbedoLambertSphere(c)
spread = acos(S) / S + d("0.113706")
multiple = d("0.234459") * k_d ** d("1.85432") + d("0.0151829") * (
    (c - d("0.249978")) * (Abs(phi) + sqrt(mu_i * mu_o)) / spread
)
printed = Max(0, single + multiple)

SMALLEST = Rational(1, 20)
AWAY = {v: SMALLEST + (1 - SMALLEST) * T**2 for v in (mu_i, mu_o)}
TRUTH = (
    "The text states no accuracy. The truth is (18) without fits: what is scattered once has the whole phase function, "
    "what is scattered more often has three terms of it; k_d is the Bond albedo that belongs to c"
)

# --- the error, by its parts in the azimuth -------------------------------------------------------------

turned = Symbol("x", real=True)  # cos(phi)
constant, linear, square = Poly(three_terms(-mu_i * mu_o - S * turned), turned).all_coeffs()[::-1]
often = [
    mode - c * part / total for mode, part in zip(orders, (constant + square / 2, linear, square / 2), strict=True)
]

level, slope, first, second = symbols("level slope first second", real=True)
slope_of = d("0.0151829") * (c - d("0.249978")) / spread
level_of = d("0.234459") * k_d ** d("1.85432") + slope_of * sqrt(mu_i * mu_o)
PARTS = {level: level_of - often[0], slope: slope_of, first: -often[1], second: -often[2]}
gap = level + slope * phi + first * cos(phi) + second * cos(2 * phi)


def around(e):
    """The mean over the azimuth."""
    return integrate(e.expand(), (phi, 0, pi)) / pi


mean_square = around(gap**2).expand().subs(PARTS)
mean = around(level + slope * phi).subs({level: level_of, slope: slope_of})
EVERY_PAIR = ((mu_i, 0, 1), (mu_o, 0, 1))

# --- the verdicts ---------------------------------------------------------------------------------------

paper.measured(
    "48.maximum",
    "the whole BRDF in one formula, where it is worst",
    left=single + modes - c * three_terms(deviation) / total,
    printed=printed,
    where=[interval(mu_i, SMALLEST, 1), interval(mu_o, SMALLEST, 1), interval(phi, 0, pi), interval(c, 0, 1)],
    within=Rational(11, 100),
    along={**AWAY, c: 1 - T**2},
    reading="per steradian, phi = 0 sending light back. " + TRUTH + ". 0.11 is what was found, a third of what is "
    "scattered more than once there; where both cosines are below 0.002 the error grows like a logarithm",
)
paper.measured(
    "48.rms",
    "the root mean square of the fast variant's error over all directions",
    left=sqrt(Integral(4 * mu_i * mu_o * mean_square, *EVERY_PAIR)),
    printed=0,
    where=[interval(c, 0, 1)],
    within=Rational(8, 250),
    along={c: 1 - T**2},
    reading="per steradian, the mean over both directions, each weighed with its cosine. " + TRUTH + ". 0.032 is what "
    "was found, at c = 1; up to c = 0.95 it is at most 0.0052. Below c = 1/4 the maximum with 0 is left out, which "
    "makes the error no smaller, as the truth is positive",
)
paper.measured(
    "48.energy",
    "the light that the fast variant returns after more than one collision, of light from everywhere",
    left=Integral(4 * pi * mu_i * mu_o * often[0], *EVERY_PAIR),
    printed=Integral(4 * pi * mu_i * mu_o * mean, *EVERY_PAIR),
    where=[interval(c, Rational(1, 4), 1)],
    within=Rational(83, 1000),
    along={c: 1 - Rational(3, 4) * T**2},
    reading="as a share of the light that comes in: the error of the Bond albedo, since single scattering is the same. "
    + TRUTH + ". 0.083 is what was found, at c = 1, where 8 percent more light returns than comes in; at c = 0.5 it "
    "is 4 percent of the albedo too much. Towards c = 0 it is ever less than the truth, at c = 0.1 by 18 percent",
)  # fmt: skip
paper.measured(
    "48.grazing",
    "the same, of light from one direction",
    left=Integral(2 * pi * mu_o * often[0], (mu_o, 0, 1)),
    printed=Integral(2 * pi * mu_o * mean, (mu_o, 0, 1)),
    where=[interval(mu_i, 0, 1), interval(c, Rational(1, 4), 1)],
    within=Rational(3, 10),
    along={mu_i: T**2, c: 1 - Rational(3, 4) * T**2},
    reading="as a share of the light that comes in. " + TRUTH + ". 0.3 is what was found, at grazing incidence and "
    "c = 1, where the truth is 0.5: half of the light returns after one collision, and 0.8 after more of them. At "
    "normal incidence the error is a tenth of that",
)
paper.whole(
    "48",
    "the whole BRDF in one formula",
    [f"48.{part}" for part in ("maximum", "rms", "energy", "grazing")],
    left=Symbol("f_r", real=True),
    printed=printed,
    reading="near to the model's own on the whole; without absorption it gains light, most at grazing incidence",
)

if __name__ == "__main__":
    paper.tell()
