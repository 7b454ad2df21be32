"""White Lambertian spheres: their phase function, how to sample it, and the half-space that is full of them."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence

import numpy as np

from xsec_sym.kernels._lambert_sphere_table import ALBEDO_OVER_C, LOSS_OVER_ROOT
from xsec_sym.kernels._support import common_shape, elementwise, horner, real_array
from xsec_sym.kernels.half_space import HalfSpace
from xsec_sym.kernels.half_space_table import LOWEST, HalfSpaceTable

# One half-space is solved for each distinct albedo, in a second or less, and this many are kept.
MOST_ALBEDOS = 64
# The cuts of brdf_lambert_sphere: the highest order for each mode. Where both directions graze the surface, forward,
# nearly all light has been scattered twice, by p's kinks; what the orders left out keep of it falls as a power only.
MODES, CORE = 33, 32
HIGHEST = {0: 200, 1: 200, 2: 200, 3: 96, 4: 128, 5: 96, 6: 96, 7: 64, 9: 64}
HIGHEST_GRAZING = {0: 480, 1: 480, 2: 480, 4: 400, 6: 320, 8: 280, 10: 240, 12: 200, 14: 160}
HIGHEST |= {mode: CORE if mode % 2 else 64 for mode in range(MODES) if mode not in HIGHEST}
HIGHEST_GRAZING |= {mode: 96 if mode % 2 else 128 for mode in range(MODES) if mode not in HIGHEST_GRAZING}
GRAZING = 0.1
# A call with so many values for each c, on the average, gets tables: they take as long as these without, and a
# hundredth of the time for all others.
MANY = 4000

# On this side of 1 or of -1 the integrals of acos are summed as series about there.
TAIL = 0.7
MIDDLE = 1.0 - TAIL


def _arc_series(n: int) -> list[float]:
    """acos(1 - t) = sqrt(2 t) sum of a_k t^k, lowest power first."""
    return [math.comb(2 * k, k) / 8.0**k / (2 * k + 1) for k in range(n)]


# f(mu) = sqrt(1 - mu^2) - mu acos mu, whose derivative is -acos mu: f(1 - t) = t^(3/2) times the first of these, its
# integral from there to 1 is t^(5/2) times the second; highest power first.
ONCE = [math.sqrt(2.0) * a / (k + 1.5) for k, a in enumerate(_arc_series(34))][::-1]
TWICE = [math.sqrt(2.0) * a / ((k + 1.5) * (k + 2.5)) for k, a in enumerate(_arc_series(34))][::-1]
# f(mu) = 1 - pi mu/2 + mu^2 (...): the bracket, and that of its integral mu - pi mu^2/4 + mu^3 (...), in mu^2
BULGE = [math.comb(2 * k, k) / 4.0**k / ((2 * k + 1) * (2 * k + 2)) for k in range(18)][::-1]
BULGE_INTEGRAL = [b / (2 * k + 3) for k, b in enumerate(BULGE[::-1])][::-1]


def lambert_sphere_coefficients(order: int) -> np.ndarray:
    """A_0 to A_order of the phase function 1/(4 pi) sum A_l P_l: (-1)^l (2 l + 1) a_l^2, a_l those of max(cos, 0)/pi.

    They are 0 for odd l above 1 and fall as 4/l^4. `deon2021:4` prints the first six. ValueError for an order below 0.

    >>> lambert_sphere_coefficients(4).tolist()
    [1.0, -1.3333333333333333, 0.3125, 0.0, 0.015625]
    """
    if order < 0:
        raise ValueError("the order of a Legendre series is at least 0")
    a = np.zeros(max(order, 2) + 1)
    a[:3] = 1.0, 2.0 / 3.0, 0.25
    for l in range(4, order + 1, 2):
        a[l] = -a[l - 2] * (l - 3) / (l + 2)
    orders = np.arange(a.size)
    signs = np.where(orders == 1, -1.0, 1.0)
    return (signs * (2 * orders + 1) * a**2)[: order + 1]


def _phase_at(t: np.ndarray) -> np.ndarray:
    """The phase function at the cosine 1 - t: near t = 0 it is t^(3/2), which no function of a rounded cosine knows."""
    mu = 1.0 - t
    near = t < TAIL
    value = np.sqrt(t * (2.0 - t)) - mu * 2.0 * np.arctan2(np.sqrt(t), np.sqrt(2.0 - t))
    value[near] = t[near] * np.sqrt(t[near]) * horner(ONCE, t[near])
    return value * (2.0 / (3.0 * np.pi**2))


def _phase(mu: np.ndarray) -> np.ndarray:
    # Away from 1 the rounding of 1 - mu would be seen.
    far = mu <= MIDDLE
    value = _phase_at(np.where(far, 1.0, 1.0 - mu))
    x = mu[far]
    angle = 2.0 * np.arctan2(np.sqrt(1.0 - x), np.sqrt(1.0 + x))
    value[far] = (np.sqrt((1.0 - x) * (1.0 + x)) - x * angle) * (2.0 / (3.0 * np.pi**2))
    value[~(np.abs(mu) <= 1.0)] = np.nan
    return value


def phase_lambert_sphere(mu: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """The phase function of a white sphere with a Lambertian surface, small against its distance and not transparent.

    A density per steradian (1/sr) of the direction of light that a sphere has scattered: 2 pi times its integral over
    mu in [-1, 1] is 1, its mean cosine is -4/9, its value straight back is 2/(3 pi) and straight on 0.

    mu: cosine between the directions of travel before and after, in [-1, 1]; anything else, NaN included, gives NaN.
    float32 for float32, float64 otherwise. TypeError for arguments that are no real numbers.

    `deon2021:1`, whose first form prints 2 pi^2 for 3 pi^2, as 2/(3 pi^2) (sqrt(1 - mu^2) - mu acos mu), and as a
    series in 1 - mu above 0.3. Largest error found: 3.8 ulp in float64, 0.5 ulp in float32.

    >>> phase_lambert_sphere([-1, 0, 0.5, 1])
    array([0.21220659, 0.06754746, 0.02313005, 0.        ])
    """
    return elementwise(_phase, mu=mu)


# 5/6, which is xi at mu = 0, as a sum of two doubles
FIVE_SIXTHS = (5.0 / 6.0, -3.700743415417188e-17)


def _integral_from_0(mu: np.ndarray) -> np.ndarray:
    square = mu * mu
    return mu * (1.0 - (np.pi / 4.0) * mu + square * horner(BULGE_INTEGRAL, square))


def _sample_above(xi: np.ndarray) -> np.ndarray:
    """t = 1 - mu, with t (series)^(2/5) = (3 pi/4 (1 - xi))^(2/5): nearly linear, where xi itself is flat."""
    goal = (0.75 * np.pi * (1.0 - xi)) ** 0.4
    t = goal * (1.0 / TWICE[-1]) ** 0.4
    t /= 1.0 + 0.4 * TWICE[-2] / TWICE[-1] * t
    for _ in range(3):
        series = horner(TWICE, t)
        value = t * series**0.4
        # d log value/dt = 2/5 f/integral of f
        slope = value * 0.4 * horner(ONCE, t) / (t * series)
        t -= np.where(t > 0.0, (value - goal) / slope, 0.0)
    return 1.0 - t


def _sample_middle(xi: np.ndarray) -> np.ndarray:
    goal = 0.75 * np.pi * ((xi - FIVE_SIXTHS[0]) - FIVE_SIXTHS[1])
    mu = 2.0 * goal / (1.0 + np.sqrt(np.maximum(1.0 - np.pi * goal, 0.0)))
    for _ in range(4):
        square = mu * mu
        slope = 1.0 - (np.pi / 2.0) * mu + square * horner(BULGE, square)
        mu -= (_integral_from_0(mu) - goal) / slope
    return mu


def _sample_below(xi: np.ndarray) -> np.ndarray:
    """v = 1 + mu, with f(-1 + v) = f(1 - v) + pi (1 - v)."""
    goal = 0.75 * xi
    v = goal
    for _ in range(5):
        root = np.sqrt(v)
        value = v * (1.0 - 0.5 * v + v * root * horner(TWICE, v) / np.pi)
        slope = 1.0 - v + v * root * horner(ONCE, v) / np.pi
        v = v - (value - goal) / slope
    return v - 1.0


def _sample(xi: np.ndarray) -> np.ndarray:
    low, high = (5.0 / 6.0 + float(_integral_from_0(np.array(mu))) / (0.75 * np.pi) for mu in (-MIDDLE, MIDDLE))
    mu = np.full_like(xi, np.nan)
    for inside, method in (
        ((xi >= 0.0) & (xi < low), _sample_below),
        ((xi >= low) & (xi <= high), _sample_middle),
        ((xi > high) & (xi <= 1.0), _sample_above),
    ):
        mu[inside] = method(xi[inside])
    return mu


def sample_lambert_sphere(xi: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """The cosine of deviation of light that a white Lambertian sphere scatters, from a uniform random number.

    The exact inverse of the distribution function xi = 2 pi times the integral of `phase_lambert_sphere` from -1 to mu,
    so that xi = 0, 5/6, 1 gives -1, 0, 1. It is increasing, and keeps the order of stratified and quasi-random numbers.

    xi: in [0, 1]; anything else, NaN included, gives NaN. float32 for float32, float64 otherwise. TypeError for
    arguments that are no real numbers.

    What `deon2021:7` approximates to 0.0005 and `deon2021:6` has from three random numbers. With theta = acos mu,
    1 - xi = (2 theta (2 + cos 2 theta) - 3 sin 2 theta)/(6 pi); solved by Newton's method on series about -1, 0 and 1,
    the one about 0 with 5/6 in two parts. Largest error found: 5.6 ulp in float64, 0.5 ulp in float32, of mu itself,
    for xi as the number that it is: near 5/6, where mu is small, too.

    >>> sample_lambert_sphere([0, 0.5, 5 / 6, 1]).round(8).tolist()
    [-1.0, -0.53484179, 0.0, 1.0]
    """
    return elementwise(_sample, xi=xi)


@functools.lru_cache(maxsize=2 * MOST_ALBEDOS)
def _half_space(c: float, grazing: bool) -> HalfSpace:
    highest = HIGHEST_GRAZING if grazing else HIGHEST
    coefficients = lambert_sphere_coefficients(max(highest.values()))
    return HalfSpace(coefficients, c, modes=MODES, core=CORE, nodes=60, highest=highest.__getitem__)


@functools.lru_cache(maxsize=MOST_ALBEDOS)
def _table(c: float) -> HalfSpaceTable:
    return HalfSpaceTable(_half_space(c, True))


def _multiple(mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray, c: float, many: bool) -> np.ndarray:
    value = np.empty_like(mu_i)
    tabled = np.minimum(mu_i, mu_o) >= (LOWEST if many else np.inf)
    grazing = mu_i + mu_o < GRAZING
    if tabled.any():
        value[tabled] = _table(c).multiple(mu_i[tabled], mu_o[tabled], phi[tabled])
    for here in (~tabled & ~grazing, ~tabled & grazing):
        if here.any():
            value[here] = _half_space(c, bool(grazing[here][0])).multiple(mu_i[here], mu_o[here], phi[here])
    return value


def _brdf(many: bool, mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray, c: np.ndarray) -> np.ndarray:
    inside = (mu_i >= 0.0) & (mu_i <= 1.0) & (mu_o >= 0.0) & (mu_o <= 1.0) & np.isfinite(phi) & (c >= 0.0) & (c <= 1.0)
    value = np.where(inside, np.where(mu_i + mu_o > 0.0, 0.0, np.inf), np.nan)
    some = np.flatnonzero(inside & (c > 0.0) & (mu_i + mu_o > 0.0))
    mu_i, mu_o, phi, c = mu_i[some], mu_o[some], phi[some], c[some]

    sines = np.sqrt((1.0 - mu_i) * (1.0 + mu_i) * (1.0 - mu_o) * (1.0 + mu_o))
    total = mu_i + mu_o
    # 1 + w_i . w_o as a sum of positive terms
    t = total * total / (1.0 + mu_i * mu_o + sines) + 2.0 * sines * np.cos(phi / 2.0) ** 2
    result = c * _phase_at(np.minimum(t, 2.0)) / total
    for albedo in np.unique(c):
        here = c == albedo
        result[here] += _multiple(mu_i[here], mu_o[here], phi[here], float(albedo), many)
    value[some] = result
    return value


def brdf_lambert_sphere(
    mu_i: np.typing.ArrayLike, mu_o: np.typing.ArrayLike, phi: np.typing.ArrayLike, c: np.typing.ArrayLike
) -> np.ndarray | np.floating:
    """The BRDF of a half-space sparsely filled with Lambertian spheres of diffuse albedo c, exact in every order.

    Per steradian (1/sr): the radiance that leaves at cosine mu_o, over the irradiance of a beam that arrives at cosine
    mu_i. It is symmetric in the two; for c = 1 its projected integral over mu_o and phi is 1. It is 0 for c = 0,
    except where both cosines are 0: there it is infinite for every c.

    mu_i, mu_o: cosines in [0, 1]. phi: azimuth in radians between the two directions, both pointing outward, so that
    phi = 0 is backscattering. c: in [0, 1]. Shapes broadcast; anything else, NaN and infinities included, gives NaN.
    float32 for float32 arguments, float64 otherwise. TypeError for arguments that are no real numbers, ValueError for
    shapes that do not broadcast, and for more than 64 distinct c in a call: each has a half-space of its own, which is
    solved at its first use (0.2 s; 1 s where cosines add up to less than 0.1) and kept until 64 others have been. A
    call with 4000 values or more for each c has tables made (1.2 s in all), which give them in 2 us each instead of
    0.3 ms.

    The quantity that `deon2021:18` fits: `deon2021:17` with the full phase function, and all further orders by
    `HalfSpace`. Largest relative error found: 8e-12 forward where the cosines add up to less than 0.1, and elsewhere
    1.2e-12, or 6e-12 from the tables.

    >>> brdf_lambert_sphere(0.5, [0.5, 1.0], 0.0, 1.0).round(9).tolist()
    [0.414348324, 0.305954912]
    """
    arrays = {name: real_array(name, value) for name, value in (("mu_i", mu_i), ("mu_o", mu_o), ("phi", phi), ("c", c))}
    albedos = np.unique(arrays["c"])
    distinct = np.count_nonzero((albedos >= 0.0) & (albedos <= 1.0))
    if distinct > MOST_ALBEDOS:
        raise ValueError(
            f"{distinct} distinct values of c in a call, of which at most {MOST_ALBEDOS} can be solved for"
        )
    many = math.prod(common_shape(arrays)) >= MANY * int(distinct)
    return elementwise(functools.partial(_brdf, many), mu_i=mu_i, mu_o=mu_o, phi=phi, c=c)


def _series(coefficients: Sequence[float] | np.ndarray, s: np.ndarray, low: float) -> np.ndarray:
    return np.polynomial.chebyshev.chebval((2.0 * s - (1.0 + low)) / (1.0 - low), np.asarray(coefficients))


HALF = math.sqrt(0.5)
LOSS_SLOPE = 2.0 * np.polynomial.chebyshev.chebder(LOSS_OVER_ROOT)
ALBEDO_SLOPE = 2.0 / (1.0 - HALF) * np.polynomial.chebyshev.chebder(ALBEDO_OVER_C)
ALBEDO_AT_HALF = 0.5 * float(_series(np.array(ALBEDO_OVER_C), np.array(HALF), HALF))


def _albedo(c: np.ndarray) -> np.ndarray:
    s = np.sqrt(1.0 - c)
    value = np.where(c < 0.5, c * _series(ALBEDO_OVER_C, s, HALF), 1.0 - s * _series(LOSS_OVER_ROOT, s, 0.0))
    value[~((c >= 0.0) & (c <= 1.0))] = np.nan
    return value


def albedo_lambert_sphere(c: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """The Bond (spherical) albedo of a half-space of Lambertian spheres of diffuse albedo c: the diffuse colour k_d.

    The part of the power of light arriving evenly from all directions that returns; increasing from 0 to 1, with an
    infinite slope at c = 1, where 1 - k_d approaches 1.92154 sqrt(1 - c).

    c: in [0, 1]; anything else, NaN included, gives NaN. float32 for float32, float64 otherwise. TypeError for
    arguments that are no real numbers.

    What `deon2021:47` fits. Chebyshev series of k_d/c for c < 1/2 and of (1 - k_d)/sqrt(1 - c) above, both in
    sqrt(1 - c), of the albedo that `HalfSpace` computes.

    >>> albedo_lambert_sphere([0, 0.5, 0.9, 1]).round(9).tolist()
    [0.0, 0.193504763, 0.539278896, 1.0]
    """
    return elementwise(_albedo, c=c)


def _inverse(k_d: np.ndarray) -> np.ndarray:
    low = k_d < ALBEDO_AT_HALF
    c = np.where(low, k_d / 0.2, 0.25)
    for _ in range(6):
        s = np.sqrt(1.0 - c)
        ratio = _series(ALBEDO_OVER_C, s, HALF)
        slope = ratio - c * _series(ALBEDO_SLOPE, s, HALF) / (2.0 * s)
        c = np.clip(c - (c * ratio - k_d) / slope, 0.0, 0.6)
    s = np.where(low, 0.5, (1.0 - k_d) / (1.0 + 1.3 * k_d))
    for _ in range(6):
        ratio = _series(LOSS_OVER_ROOT, s, 0.0)
        s = np.clip(s - (s * ratio - (1.0 - k_d)) / (ratio + s * _series(LOSS_SLOPE, s, 0.0)), 0.0, 1.0)
    value = np.where(low, c, 1.0 - s * s)
    value[~((k_d >= 0.0) & (k_d <= 1.0))] = np.nan
    return value


def albedo_lambert_sphere_inverse(k_d: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """The diffuse albedo c of Lambertian spheres that give their half-space the Bond albedo k_d.

    The inverse of `albedo_lambert_sphere`, by Newton's method: increasing from 0 to 1, 0 at 0 and 1 at 1.

    k_d: in [0, 1]; anything else, NaN included, gives NaN. float32 for float32, float64 otherwise. TypeError for
    arguments that are no real numbers.

    What `deon2021:46` fits.

    >>> albedo_lambert_sphere_inverse(albedo_lambert_sphere([0, 0.3, 0.9, 1])).round(12).tolist()
    [0.0, 0.3, 0.9, 1.0]
    """
    return elementwise(_inverse, k_d=k_d)
