"""A ring of normals, and the powers of the cosine: what every other cross-section can be summed from."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from mpmath import mp
from scipy import integrate, ndimage, special

from xsec_sym import kernels
from xsec_sym.kernels import dirac_ring
from xsec_sym.study.method import Argument, Columns, Field, Method, Quantity, along
from xsec_sym.study.methods.common import NODES, blocked, cosine, facing, loop, near, quadratures
from xsec_sym.study.references import ring as reference

# --- the ring ---------------------------------------------------------------------------------------------

EDGES = (0.0, 0.01, 0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95, 1.0)
COSINES = tuple(-x for x in reversed(EDGES[1:])) + EDGES


def beside_the_lit_cap(sign: float) -> Callable[[np.random.Generator, int], Columns]:
    """|u| next to sqrt(1 - u_n^2), where the ring begins or ceases to be fully lit."""

    def draw(rng: np.random.Generator, n: int) -> Columns:
        x = rng.uniform(-1, 1, n)
        u = np.sqrt((1 - x) * (1 + x)) * (1 + rng.choice([-1.0, 1.0], n) * 10 ** rng.uniform(-17, -3, n))
        return np.copysign(np.clip(u, 0, 1), sign * x), x

    return draw


def on_the_edge(rng: np.random.Generator, n: int) -> Columns:
    """|u| at the rounded sqrt(1 - u_n^2), or one place beside."""
    x = rng.uniform(-1, 1, n)
    edge = np.sqrt(1 - x * x)
    return rng.choice([-1.0, 1.0], n) * np.clip(edge + rng.integers(-1, 2, n) * np.spacing(edge), 0, 1), x


RING = Quantity(
    "sigma_dirac_ring",
    "cross-section of a ring of normals",
    running=(Argument("u", COSINES), Argument("u_n", COSINES)),
    set=(),
    reference=reference.sigma_dirac_ring,
    trouble={
        "nearly all lit": beside_the_lit_cap(1.0),
        "barely lit": beside_the_lit_cap(-1.0),
        "edge": on_the_edge,
        "pole": lambda rng, n: (near(rng, n, -1.0, 1.0), rng.uniform(-1, 1, n)),
        "both near the pole": lambda rng, n: (near(rng, n, -1.0, 1.0), near(rng, n, -1.0, 1.0)),
        "grazing": lambda rng, n: (near(rng, n, 0.0, reach=20), rng.uniform(-1, 1, n)),
    },
    per_cell=(1, 4),
)


def height(u: Any, x: Any) -> Any:
    return np.sqrt(1 - u * u) * np.sqrt(1 - x * x)


def printed_ring(u: np.ndarray, x: np.ndarray) -> np.ndarray:
    """`deon2016:8.piecewise`, as it stands."""
    edge = np.sqrt(1 - x * x)
    lit = ((x > 0) & (u > edge)) | ((x < 0) & (u < -edge))
    partly = (u < edge) & (u > -edge)
    arc = 2 * u * x * np.arccos(-u * x / height(u, x)) + 2 * np.sqrt(1 - u * u - x * x)
    return np.where(lit, 2 * np.pi * u * x, np.where(partly, arc, 0.0))


def edge_included(u: np.ndarray, x: np.ndarray) -> np.ndarray:
    """The printed cases with one inequality, which is not strict: no place is without a case."""
    arc = 2 * u * x * np.arccos(-u * x / height(u, x)) + 2 * np.sqrt(1 - u * u - x * x)
    return np.where(np.abs(u) <= np.sqrt(1 - x * x), arc, 2 * np.pi * np.maximum(u * x, 0))


def three_terms(u: np.ndarray, x: np.ndarray) -> np.ndarray:
    """`deon2016:9`: the sum of `deon2016:10`, `deon2016:11` and `deon2016:12`."""
    a = u * x
    inside = np.abs(u) < np.sqrt(1 - x * x)
    mean = 2 * np.pi * np.where(a > 0, a, 0.0)
    spread = np.where(inside, 2 * np.sqrt(1 - u * u - x * x), 0.0)
    tilt = np.where(inside, 2 * a * np.arccos(-a / height(u, x)) - 2 * np.pi * a * np.heaviside(a, 0.5), 0.0)
    return mean + spread + tilt


def clamped(u: np.ndarray, x: np.ndarray) -> np.ndarray:
    """No test at all: the arguments of acos and of the root are clamped, as shaders do."""
    a = u * x
    arc = np.arccos(np.clip(-a / np.maximum(height(u, x), 1e-300), -1, 1))
    return 2 * (a * arc + np.sqrt(np.maximum(0, 1 - u * u - x * x)))


def two_argument_arctangent(u: np.ndarray, x: np.ndarray) -> np.ndarray:
    a, root = u * x, np.sqrt(np.maximum(0, 1 - u * u - x * x))
    return 2 * (root + a * np.arctan2(root, -a))


def over_azimuth(n: int) -> Callable[..., np.ndarray]:
    """The clamped integrand at n equidistant azimuths of the half circle."""
    cosines = np.cos((np.arange(n) + 0.5) * np.pi / n)

    def sigma(u: np.ndarray, x: np.ndarray) -> np.ndarray:
        a, b = u * x, height(u, x)
        return np.maximum(0, a[:, np.newaxis] + b[:, np.newaxis] * cosines).sum(axis=1) * (2 * np.pi / n)

    return blocked(sigma)


def adaptive_over_azimuth(u: float, x: float) -> float:
    a, b = u * x, float(height(u, x))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", integrate.IntegrationWarning)
        return 2 * integrate.quad(lambda phi: max(0.0, a + b * math.cos(phi)), 0, math.pi)[0]


def arbitrary_over_azimuth(digits: int) -> Callable[[float, float], float]:
    def sigma(u: float, x: float) -> float:
        with mp.workdps(digits):
            return float(reference.ring_from_definition(u, x))

    return sigma


def clamped_cosine(orders: np.ndarray) -> np.ndarray:
    """The coefficients a_l of max(0, mu) in Legendre polynomials, of the orders 1 and all even ones."""
    rest = special.gamma(orders / 2 + 2) / special.rgamma(1.5 - orders / 2)
    return np.sqrt(np.pi) * (2 * orders + 1) / 8 / rest


def even_orders(n: int) -> np.ndarray:
    return np.array([l for l in range(n + 1) if l % 2 == 0 or l == 1])


def ring_in_legendre(n: int) -> Callable[..., np.ndarray]:
    """2 pi sum a_l P_l(u) P_l(u_n) up to l = n, by the addition theorem."""
    orders = even_orders(n)

    def sigma(u: np.ndarray, x: np.ndarray) -> np.ndarray:
        terms = zip(orders, clamped_cosine(orders), strict=True)
        return 2 * np.pi * sum(a * special.eval_legendre(l, u) * special.eval_legendre(l, x) for l, a in terms)

    return sigma


def table(n: int) -> Callable[..., np.ndarray]:
    """A table of n by n values over the square, between which it is linear."""
    points = np.linspace(-1, 1, n)
    values = kernels.sigma_dirac_ring(points[:, np.newaxis], points)

    def sigma(u: np.ndarray, x: np.ndarray) -> np.ndarray:
        places = [(np.asarray(c, float) + 1) * (n - 1) / 2 for c in (u, x)]
        return ndimage.map_coordinates(values, places, order=1, mode="nearest")

    return sigma


def compiled_ring(u: float, x: float) -> float:
    a, d = u * x, 1.0 - u * u - x * x
    if d <= 0.0:
        return 2.0 * np.pi * a if a > 0.0 else 0.0
    return 2.0 * (np.sqrt(d) + a * (0.5 * np.pi + np.arctan(a / np.sqrt(d))))


P, Q = dirac_ring._ARC_P, dirac_ring._ARC_Q


def compiled_stable_ring(u: float, x: float) -> float:
    """As the kernel, without the rounding error of a: 1 - u^2 - u_n^2 with both squares in two doubles."""
    large, small = max(abs(u), abs(x)), min(abs(u), abs(x))
    rest = 0.0
    total = 1.0
    for value in (large, small):
        square = value * value
        c = 134217729.0 * value
        high = c - (c - value)
        low = value - high
        rest -= ((high * high - square) + 2.0 * high * low) + low * low
        before = total
        total = before - square
        shadow = total - before
        rest += (before - (total - shadow)) + (-square - shadow)
    d, a = total + rest, u * x
    if d <= 0.0:
        return 2.0 * np.pi * a if a > 0.0 else 0.0
    root = np.sqrt(d)
    if a >= 0.0 or d >= 3.0 * a * a:
        return 2.0 * (root + a * (0.5 * np.pi + np.arctan(a / root)))
    z = d / (a * a)
    top, bottom = 0.0, 0.0
    for coefficient in P:
        top = top * z + coefficient
    for coefficient in Q:
        bottom = bottom * z + coefficient
    return 2.0 * root * (z * (top / bottom))


RING_METHODS = (
    Method("kernel", "deon2016:8.piecewise", lambda: kernels.sigma_dirac_ring, single=True, ours=True),
    Method("as printed", "deon2016:8.piecewise", lambda: printed_ring),
    Method("edge included", "deon2016:8.piecewise with the edge itself", lambda: edge_included),
    Method("three terms", "deon2016:9", lambda: three_terms),
    Method("clamped arccosine", "deon2016:8.piecewise with clamped arguments", lambda: clamped),
    Method("two-argument arctangent", "acos(-a/b) = atan2(sqrt d, -a)", lambda: two_argument_arctangent),
    Method("Legendre series", "addition theorem", ring_in_legendre, kind="series", curve=along(n=(4, 8, 16, 32, 64))),
    Method(
        "equidistant azimuths",
        "quadrature of the definition",
        over_azimuth,
        kind="quadrature",
        curve=along(n=(8, 32, 128)),
    ),
    Method(
        "scipy.integrate.quad",
        "quadrature of the definition",
        lambda: adaptive_over_azimuth,
        kind="quadrature",
        serial=True,
        most=500,
    ),
    Method(
        "mpmath.quad",
        "quadrature of the definition",
        arbitrary_over_azimuth,
        kind="arbitrary precision",
        curve=along(digits=(15, 30)),
        serial=True,
        most=30,
    ),
    Method("table", "bilinear interpolation", table, kind="table", curve=along(n=(33, 129, 513))),
    Method("compiled", "the arctangent's form in a loop", loop(compiled_ring), needs="numba"),
    Method("compiled, stable", "the kernel's form in a loop", loop(compiled_stable_ring), needs="numba", ours=True),
)

# --- powers -----------------------------------------------------------------------------------------------

ORDERS = (0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 100, 150, 200)


def high_power(rng: np.random.Generator, n: int) -> Columns:
    return rng.uniform(-1, 1, n), 2.0 * rng.integers(50, 100, n, endpoint=True)


P_ORDER = Argument("p", tuple(map(float, ORDERS)), integer=True)
POWER = Quantity(
    "sigma_power",
    "cross-section of a power of the cosine",
    running=(cosine(),),
    set=(P_ORDER,),
    reference=reference.sigma_power,
    trouble={
        "grazing": lambda rng, n: (near(rng, n, 0.0, reach=20), 2.0 * rng.integers(0, 100, n, endpoint=True)),
        "facing": facing(P_ORDER),
        "high even powers": high_power,
    },
    typical=((2.0,), (20.0,), (200.0,)),
    per_cell=(2, 2),
)


def by_order(even: Callable[[np.ndarray, int], np.ndarray]) -> Callable[..., np.ndarray]:
    """A formula for even powers p = 2n, with the one for odd powers."""

    def sigma(u: Any, p: Any) -> np.ndarray:
        u, p = np.broadcast_arrays(np.asarray(u, float), p)
        found = 2 * np.pi * u / (p + 2)
        for order in np.unique(p[p % 2 == 0]):
            chosen = p == order
            found[chosen] = even(u[chosen], int(order) // 2)
        return found

    return sigma


@cache
def central(n: int) -> np.ndarray:
    """binom(2j, j)/4^j for j = 0, ..., n."""
    return np.cumprod(np.concatenate([[1.0], 1 - 0.5 / np.arange(1, n + 1)]))


def alternating(u: np.ndarray, n: int) -> np.ndarray:
    """A_n 2F1(-1/2, -n; 1/2; u^2), summed as it stands."""
    k = np.arange(n + 1)
    terms = special.binom(n, k) * (-1.0) ** k / (1 - 2 * k)
    return np.pi * central(n)[n] / (n + 1) * np.polynomial.polynomial.polyval(u * u, terms)


def hypergeometric(u: np.ndarray, n: int) -> np.ndarray:
    return np.pi * central(n)[n] / (n + 1) * special.hyp2f1(-0.5, -n, 0.5, u * u)


def binomial_series(u: np.ndarray, n: int) -> np.ndarray:
    """`deon2016:T1.even.s`: the series of |u| in y = 1 - u^2, cut."""
    coefficients = central(n) / (1 - 2 * np.arange(n + 1))
    return np.pi / (n + 1) * np.polynomial.polynomial.polyval((1 - u) * (1 + u), coefficients)


def three_components(u: np.ndarray, n: int) -> np.ndarray:
    """`deon2016:T1.even.s1`, mended, `deon2016:T1.even.s2` and `deon2016:T1.even.s3`."""
    y, v = 1 - u * u, np.abs(u)
    j = np.arange(1, n + 1)
    first = np.pi / (n + 1) * v
    second = (-1.0) ** (n + 1) * np.pi * (u * u - 1) ** (n + 1) * central(n)[n] / (n + 1)
    sums = sum((c * y**k for k, c in zip(j, central(n)[1:] / (1 - 2 * j), strict=True)), np.zeros_like(u))
    third = np.pi / (n + 1) * (1 - v + sums) - np.pi * central(n)[n] / (n + 1) * y ** (n + 1)
    return first + second + third


def power_in_legendre(n: int) -> Callable[..., np.ndarray]:
    """2 pi sum a_l m_l P_l(u) up to l = n, with the moments m_l of x^p, which end at l = p."""

    def even(u: np.ndarray, half: int) -> np.ndarray:
        p = 2 * half
        orders = np.arange(0, min(n, p) + 1, 2)
        logarithm = (orders + 1) * np.log(2) + special.gammaln(p + 1) + special.gammaln((p + orders) / 2 + 1)
        moments = np.exp(logarithm - special.gammaln((p - orders) / 2 + 1) - special.gammaln(p + orders + 2))
        terms = zip(orders, clamped_cosine(orders) * moments, strict=True)
        return 2 * np.pi * sum(c * special.eval_legendre(l, u) for l, c in terms)

    return by_order(even)


def chebyshev_interpolant(p: float, n: int) -> Callable[[np.ndarray], np.ndarray]:
    """The polynomial in u^2 through n values of the kernel."""
    if p % 2:
        return lambda u: 2 * np.pi / (p + 2) * u
    interpolate: Callable[..., Any] = np.polynomial.chebyshev.chebinterpolate
    series = interpolate(lambda t: kernels.sigma_power(np.sqrt((1 + t) / 2), p), n - 1)
    return lambda u: np.polynomial.chebyshev.chebval(2 * u * u - 1, series)


def compiled_power(u: float, p: float) -> float:
    """The binomial series, from its first term to its last."""
    if p % 2.0 != 0.0:
        return 2.0 * np.pi * u / (p + 2.0)
    y = (1.0 - u) * (1.0 + u)
    term, total = 1.0, 1.0
    for j in range(1, int(p) // 2 + 1):
        term *= y * (1.0 - 0.5 / j)
        total -= term / (2.0 * j - 1.0)
    return 2.0 * np.pi / (p + 2.0) * total


POWER_METHODS = (
    Method("kernel", "deon2016:T1.even.s", lambda: kernels.sigma_power, single=True, ours=True),
    Method("binomial series", "deon2016:T1.even.s", lambda: by_order(binomial_series), kind="series"),
    Method("three components", "deon2016:T1.even.s3", lambda: by_order(three_components)),
    Method("powers of u", "a terminating hypergeometric series", lambda: by_order(alternating), kind="series"),
    Method("scipy.special.hyp2f1", "a terminating hypergeometric series", lambda: by_order(hypergeometric)),
    Method(
        "two plates",
        "deon2016:17",
        lambda: by_order(lambda u, n: np.pi * np.abs(u) / (n + 1)),
        kind="approximation",
    ),
    Method("Legendre series", "addition theorem", power_in_legendre, kind="series", curve=along(n=(4, 16, 64, 200))),
    Method(
        "Chebyshev interpolant",
        "interpolation of the kernel",
        chebyshev_interpolant,
        kind="table",
        curve=along(n=(4, 16, 64, 101)),
        folds=True,
    ),
    Method("compiled series", "deon2016:T1.even.s in a loop", loop(compiled_power), kind="series", needs="numba"),
    *quadratures(lambda x, p: x**p, lambda x, p: x ** int(p), most=(30, 10), nodes=NODES),
)

FIELDS = (Field(RING, RING_METHODS), Field(POWER, POWER_METHODS))
