"""Sections 3.2-3.4: the modes of the BRDF in terms of H functions, and how the constants of a mode hang together.

The left sides come from the transport equation in discrete directions, which knows no H function, and again from H and
its moments (`xsec_sym/exact/solved.py`).
"""

from sympy import Rational, cos, pi, sqrt, symbols

from xsec_sym.exact.solved import HLambertSphere, ModeConstant, ModeLambertSphere
from xsec_sym.proof import Source, interval
from xsec_sym.proof.accuracy import T

second = Source("deon2021", section="3.2")
first = Source("deon2021", section="3.3")
zeroth = Source("deon2021", section="3.4")
project = Source("xsec", section="Lambertian spheres")

mu_i, mu_o, c = symbols("mu_i mu_o c", real=True)
OUTSIDE = [interval(mu_i, 0, 1, open="left"), interval(mu_o, 0, 1, open="left")]
ALBEDO = interval(c, 0, 1)
CROWDED = {mu_i: T**2, mu_o: T**2, c: 1 - T**2}
THREE_TERMS = "for the three-term phase function of (5)"
H = HLambertSphere


# --- the modes ------------------------------------------------------------------------------------------

l, m = (ModeConstant(1, index, c) for index in range(2))
A, B, C, D, E, F = (ModeConstant(0, index, c) for index in range(6))
product, total = mu_i * mu_o, mu_i + mu_o


def of_order_one(factor):
    """(27)."""
    both = c * H(1, mu_i, c) * H(1, mu_o, c) / (factor * pi * total)
    return both * sqrt((1 - mu_i**2) * (1 - mu_o**2)) * (1 + (l**2 + 45 * m / 64) * product + l * total)


first.measured(
    "27",
    "the mode of order 1",
    left=ModeLambertSphere(1, mu_i, mu_o, c),
    printed=of_order_one(6),
    corrected=of_order_one(3),
    edit="3 for 6 in front of pi",
    where=[*OUTSIDE, ALBEDO],
    exact=True,
    along=CROWDED,
    reading="the coefficient of cos(phi) in (16), per steradian, phi = 0 sending light back; H of order 1, l and m "
    "from moments of H; with 6 it would be half of the mode that (16) asks for, as in (34); " + THREE_TERMS,
)

zeroth.measured(
    "36",
    "the mode of order 0",
    left=ModeLambertSphere(0, mu_i, mu_o, c),
    printed=H(0, mu_i, c) * H(0, mu_o, c) / (2 * pi * total)
    * (A + B * total + C * product + D * product * total + E * mu_i**2 * mu_o**2 + F * (mu_i**2 + mu_o**2)),
    where=[*OUTSIDE, ALBEDO],
    exact=True,
    along=CROWDED,
    reading="the mean over the azimuth, per steradian; H of order 0, and A to F from moments of H; " + THREE_TERMS,
)  # fmt: skip

MIRRORED = (
    "the bracket of the mode at mu_o = -mu_i is the characteristic function, for order 1 up to a factor: what is "
    "infinite there must cancel; this gives A and E of (38) as well. The method by moments of H takes that for "
    "granted, the one by transport knows nothing of it; "
)

project.measured(
    "lambert-sphere.relation-0",
    "what C and F have to do with each other",
    left=2 * F - C,
    corrected=c * (20 * c**2 + 281 * c - 346) / 384,
    where=[ALBEDO],
    exact=True,
    along={c: 1 - T**2},
    reading=MIRRORED + THREE_TERMS,
)
project.measured(
    "lambert-sphere.relation-1",
    "what l and m have to do with each other",
    left=l**2 + 45 * m / 64,
    corrected=5 * (4 * c + 9) / 64,
    where=[ALBEDO],
    exact=True,
    along={c: 1 - T**2},
    reading=MIRRORED + THREE_TERMS,
)

# --- the mode of order 2 --------------------------------------------------------------------------------

LEAST = Rational(1, 100)
single = 15 * c * (1 - mu_i**2) * (1 - mu_o**2) / (256 * pi * total)

second.measured(
    "claim.second-order",
    "of what is scattered more than once, the mode of order 2 is at most 0.5 percent of the BRDF's mode of order 0",
    left=(ModeLambertSphere(2, mu_i, mu_o, c) - single) / ModeLambertSphere(0, mu_i, mu_o, c),
    printed=0,
    where=[*OUTSIDE, interval(c, 0, 1, open="left")],
    within=Rational(1, 200),
    along=CROWDED,
    statement=True,
    reading="the text says very weak, without a number; the mode of order 1, which it says not to be negligible, "
    "reaches 10 percent; " + THREE_TERMS,
)

bracket = 207 + 135 * product**2 - 45 * (mu_i**2 + mu_o**2) + 256 * product
second.measured(
    "claim.second-order.multiple",
    "of what is scattered more than once, the mode of order 2 is at most 2.2 percent of the mode of order 0",
    left=(ModeLambertSphere(2, mu_i, mu_o, c) - single)
    / (ModeLambertSphere(0, mu_i, mu_o, c) - c * bracket / (768 * pi * total)),
    printed=0,
    where=[interval(mu_i, LEAST, 1), interval(mu_o, LEAST, 1), interval(c, 5 * LEAST, 1)],
    within=Rational(22, 1000),
    along={**{v: LEAST + (1 - LEAST) * T**2 for v in (mu_i, mu_o)}, c: 1 - (1 - 5 * LEAST) * T**2},
    statement=True,
    reading="the text says very weak of this share as well. With a cosine below 0.01 or c below 0.05, too little "
    "light is scattered more than once to leave ten digits of it; " + THREE_TERMS,
)

# --- reciprocity ----------------------------------------------------------------------------------------

NAMES = symbols("A B C D E F l m", real=True)
h_i, h_o, g_i, g_o, phi = symbols("h_i h_o g_i g_o phi", real=True)


def model(mu_i, mu_o, h_i, h_o, g_i, g_o):
    """(18) less single scattering, h and g being H of order 0 and 1."""
    a, b, c_, d, e, f, l, m = NAMES
    product, total, sines = mu_i * mu_o, mu_i + mu_o, sqrt((1 - mu_i**2) * (1 - mu_o**2))
    level = a + b * total + c_ * product + d * product * total + e * product**2 + f * (mu_i**2 + mu_o**2)
    tilt = c * g_i * g_o / (3 * pi * total) * sines * (1 + (l**2 + 45 * m / 64) * product + l * total)
    once = c * (207 + 135 * product**2 - 45 * (mu_i**2 + mu_o**2) + 256 * product) / (768 * pi * total)
    tilted_once = c * (45 * product + 64) * sines / (192 * pi * total)
    return h_i * h_o / (2 * pi * total) * level - once + (tilt - tilted_once) * cos(phi)


reciprocal = zeroth.claim(
    "claim.reciprocal",
    "the model is reciprocal, whatever its H functions and constants are",
    left=model(mu_o, mu_i, h_o, h_i, g_o, g_i),
    printed=model(mu_i, mu_o, h_i, h_o, g_i, g_o),
    where=[*OUTSIDE, ALBEDO, interval(phi, 0, pi), *(interval(v, 0, 4) for v in (h_i, h_o, g_i, g_o)),
           *(interval(v, -2, 2) for v in NAMES)],
    statement=True,
    reading="what is scattered more than once, by (27) as mended, (34), (36) and (44); what is scattered once depends "
    "on both cosines by their sum and by the deviation (9), which is the same with both exchanged",
)  # fmt: skip
reciprocal.proof(lambda step: step.close())

if __name__ == "__main__":
    for section in (second, first, zeroth, project):
        section.tell()
