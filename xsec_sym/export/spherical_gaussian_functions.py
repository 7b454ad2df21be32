"""What the tables behind `sigma_spherical_gaussian` tabulate: the functions, their regions and cells.

With kappa = 2/alpha^2, v = |u|, s = sqrt(1 - v^2) and w = kappa (1 - s), all comes from the side turned away,

    sigma(-v) = kappa/(2 sinh kappa) int_0^1 t exp(-kappa v t) I0(kappa s sqrt(1 - t^2)) dt        (`xsec:sg-positive`)

which is positive throughout, as is the odd part sigma(v) - sigma(-v) = c v, c = coth kappa - 1/kappa. Its shape changes
from a few spherical harmonics at small kappa to a boundary layer at large kappa, which ends at v = 1 where kappa s is
of the order of 1. Five regions of the plane, each with a smooth function instead of sigma, polynomial cell by cell:

- EVEN, kappa < 1.5: (sigma(u) + sigma(-u))/2, an even function of u and of kappa, hence one of u^2 and kappa^2;
- ROUND, 1.5 < kappa < 8: exp(kappa v) sigma(-v) (1 - exp(-2 kappa))/kappa, entire in v and kappa;
- LAYER, kappa > 8, v < 0.9: C in sigma(-v) = exp(-w)/sqrt(kappa) [c/2 sqrt(1 + s) h(sqrt w) + C/kappa], where h(z) =
  1/sqrt(pi) - z erfcx(z) is the boundary layer of a flat surface (`xsec:sg-rim.layer`): C depends on s and alpha^2
  and knows no layer;
- RIM and EDGE, kappa > 8, v > 0.9: q = kappa^2 exp(-kappa s) int_0^inf t exp(-kappa v t) I0(kappa s sqrt(1 - t^2)) dt,
  whose surplus over the integral up to t = 1 is the elementary v exp(-kappa) (1 + 1/kappa)/kappa (`xsec:sg-rim`): for
  kappa s < 4 as a function of kappa s and alpha^4, beyond of 1/(kappa s) and s^2, times sqrt(kappa s).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from itertools import pairwise
from typing import NamedTuple

from flint import arb, ctx
from mpmath import mp, mpf

from xsec_sym.proof.ball_compile import precision

BITS = 160
DIGITS = 36
# Points of the rule, and where its integrand is left out as exp(-NEGLIGIBLE): 1e-26 together, 1e-31 at 120 and 80.
POINTS, NEGLIGIBLE = 96, 66
# The same where the rule's error is proved and not seen.
PROVED_POINTS, BEYOND = 64, 84
# The cells' edges, in the variables of their tables; doubles in the kernel too.
LIT = 0.9
SHIFT = 0.2
LAYER_EDGES = [1.0 / (1.0 + SHIFT), 1.0 / (0.7 + SHIFT), 1.0 / (0.435 + SHIFT)]
HALF = 3.0

Cell = tuple[float, float, float, float]
Integral = Callable[[arb, arb, arb], arb]


class Region(NamedTuple):
    """The edges of its cells in two variables, the numbers of nodes, and the function, with the scale of its errors."""

    x: Sequence[float]
    y: Sequence[float]
    nodes: tuple[int, int]
    value: Callable[..., tuple[arb, arb]]

    def cells(self) -> list[Cell]:
        """By y first: the number of a cell is that of its interval of x plus len(x) - 1 times that of y."""
        return [(*across, *along) for along in pairwise(self.y) for across in pairwise(self.x)]


@cache
def rule(points: int) -> list[tuple[arb, arb]]:
    """Gauss-Legendre's nodes and weights on [0, 1]."""
    nodes = (arb.legendre_p_root(points, k, weight=True) for k in range(points))
    return [((1 + x) / 2, weight / 2) for x, weight in nodes]


def reach(ks: arb, kv: arb, negligible: int) -> arb:
    """Where the rule ends on [0, pi/2]: the integrand has fallen like exp(-negligible), or there is no more."""
    end = 2 * negligible / (kv + (kv * kv + 2 * negligible * ks).sqrt())
    return end.mid() if end < 1.2 else arb.pi() / 2


def scaled(v: arb, s: arb, kappa: arb, points: int = POINTS, negligible: int = NEGLIGIBLE) -> arb:
    """exp(w) sigma(-v): t = sin(phi), and the exponents of I0 and of w combined."""
    ks, kv = kappa * s, kappa * v
    end = reach(ks, kv, negligible)
    total = arb(0)
    for node, weight in rule(points):
        half_sine, half_cosine = (node * end / 2).sin_cos()
        t = 2 * half_sine * half_cosine
        root = (half_cosine - half_sine) * (half_cosine + half_sine)
        rest = (-(2 * ks * half_sine * half_sine + kv * t)).exp()
        total += weight * t * root * rest * (ks * root).bessel_i(0, scaled=True)
    return end * total * kappa / (1 - (-2 * kappa).exp())


def enclosed(v: arb, s: arb, kappa: arb) -> arb:
    """The same as a ball that holds the integral, for 0 <= v <= 1 and kappa > 0: the rule, and what it leaves out.

    On [0, end] the integrand g is entire in phi, and since |exp(-z) I0(z)| <= exp(|Re z| - Re z),

        |g(a + ib)| <= cosh(b)^2 exp(ks (cosh b - 1) - kv sin(a) cosh(b)),        -sin(a) <= d for a in [-d, end + d].

    With M, what this makes on the ellipse about [0, end] whose semi-axes are end/2 times (r +- 1/r)/2, the Chebyshev
    coefficient k of g is at most 2 M r^-k; a rule of n points with positive weights has the integral exactly up to
    degree 2n - 1, and of any other polynomial of Chebyshev's both sum and integral are at most 2: those of odd degree
    vanish, and end/2 * 8 M r^(-2n)/(1 - r^-2) is left. Beyond `end` the exponent is convex in t, with the slope p there
    at least, and exp(-z) I0(z) <= 1 leaves exp(-kv t - ks (1 - sqrt(1 - t^2))) (t/p + 1/p^2) at most.
    """
    ks, kv = kappa * s, kappa * v
    end, r = reach(ks, kv, BEYOND), arb(3)
    d, b = end / 4 * (r + 1 / r) - end / 2, end / 4 * (r - 1 / r)
    growth = b.cosh() ** 2 * (ks * (b.cosh() - 1) + kv * d * b.cosh()).exp()
    missed = 4 * end * growth * r ** (-2 * PROVED_POINTS) / (1 - r**-2)
    if end < 1.2:
        t, root = end.sin_cos()
        slope = kv + ks * t / root
        missed += (-(kv * t + ks * t * t / (1 + root))).exp() * (t / slope + 1 / slope**2)
    missed *= kappa / (1 - (-2 * kappa).exp())
    return scaled(v, s, kappa, PROVED_POINTS, BEYOND) + arb(0, missed.upper())


def half_layer(z: arb) -> arb:
    """h(z) = 1/sqrt(pi) - z erfcx(z)."""
    with precision(3 * ctx.prec):
        value = 1 / arb.pi().sqrt() - z * (z * z).exp() * z.erfc()
    return value


def far_half_layer(t: arb) -> arb:
    """h(z) (1 + z)^2, tabulated in t = HALF/(HALF + z)."""
    z = HALF / t - HALF
    return half_layer(z) * (1 + z) ** 2


def mean_cosine(kappa: arb) -> arb:
    return kappa.coth() - 1 / kappa


def pale_cosine(kappa_square: arb) -> arb:
    """c/kappa, tabulated in kappa^2."""
    return mean_cosine(kappa_square.sqrt()) / kappa_square.sqrt()


def even(square: arb, kappa_square: arb, integral: Integral = scaled) -> tuple[arb, arb]:
    u, kappa, s = square.sqrt(), kappa_square.sqrt(), (1 - square).sqrt()
    dark = integral(u, s, kappa) * (-kappa * (1 - s)).exp()
    # The table is subtracted from, and its error counts relative to the difference.
    return dark + mean_cosine(kappa) * u / 2, dark


def round_(v: arb, kappa: arb, integral: Integral = scaled) -> tuple[arb, arb]:
    s = ((1 - v) * (1 + v)).sqrt()
    value = integral(v, s, kappa) * (kappa * (v - (1 - s))).exp() * (1 - (-2 * kappa).exp()) / kappa
    return value, value


def layer(shifted: arb, alpha_square: arb, integral: Integral = scaled) -> tuple[arb, arb]:
    s, kappa = 1 / shifted - SHIFT, 2 / alpha_square
    whole = integral(((1 - s) * (1 + s)).sqrt(), s, kappa) * kappa.sqrt()
    flat = mean_cosine(kappa) / 2 * (1 + s).sqrt() * half_layer((kappa * (1 - s)).sqrt())
    return (whole - flat) * kappa, whole * kappa


def rim(s: arb, kappa: arb, integral: Integral) -> arb:
    v = ((1 - s) * (1 + s)).sqrt()
    surplus = v * (1 + 1 / kappa) * (-kappa * (1 + s)).exp()
    return kappa * (integral(v, s, kappa) * (1 - (-2 * kappa).exp()) + surplus)


def near_rim(ks: arb, alpha_fourth: arb, integral: Integral = scaled) -> tuple[arb, arb]:
    kappa = 2 / alpha_fourth.sqrt()
    value = rim(ks / kappa, kappa, integral)
    return value, value


def far_rim(inverse: arb, s_square: arb, integral: Integral = scaled) -> tuple[arb, arb]:
    s = s_square.sqrt()
    value = rim(s, 1 / (inverse * s), integral) / inverse.sqrt()
    return value, value


REGIONS = {
    "EVEN": Region([0.0, 1.0], [0.0, 0.25, 1.0, 2.25], (16, 20), even),
    "ROUND": Region([0.0, 0.25, 0.5, 0.75, 1.0], [1.5, 2.3, 3.5, 5.3, 8.0], (22, 22), round_),
    "LAYER": Region(LAYER_EDGES, [0.0, 0.025, 0.0625, 0.1, 1.0 / 6.0, 0.25], (24, 22), layer),
    "RIM": Region([0.0, 2.0, 4.0], [0.0, 0.0625], (26, 18), near_rim),
    "EDGE": Region([0.0, 1.0 / 12.0, 1.0 / 7.0, 0.25], [0.0, 0.19], (26, 20), far_rim),
}


def number(ball: arb) -> mpf:
    """The middle of a ball that is narrow enough for every table."""
    if ball.rad() > abs(ball.mid()) * arb("1e-24") + arb("1e-30"):
        raise ArithmeticError(f"{ball} is too wide")
    mantissa, exponent = ball.mid().man_exp()
    return mp.ldexp(int(mantissa), int(exponent))


def between(low: float, high: float, node: mpf) -> arb:
    """The place of a node of [-1, 1] in a cell: a binary number of 100 bits, so that balls start as points."""
    with mp.workprec(100):
        place = mpf(low) + (mpf(high) - mpf(low)) * (1 + node) / 2
    return arb((int(place.man), int(place.exp)))
