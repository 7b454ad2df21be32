"""Chandrasekhar's H function for isotropic scattering, and the half-space BRDF that it makes."""

from __future__ import annotations

import numpy as np

from xsec_sym.kernels import _isotropic_tables as tables
from xsec_sym.kernels._support import elementwise, horner

PALE_ROOT = float(np.sqrt(1.0 - tables.PALE))
# c/(mu_i + mu_o) overflows only for cosines below it and albedos above.
GRAZING = 1e-100


class Surface:
    """A polynomial in a variable of mu and one of c: Horner's rule for all rows of its table at once, then by row.

    Plain products and sums, element by element: a value depends neither on its place in an array nor on whether c is
    one number or many.
    """

    def __init__(self, table: list[list[float]]) -> None:
        self.rows = len(table)
        # For every power of c's variable, highest first, its coefficient in the rows that have it, which come first.
        self.columns = [
            np.array([row[power] for row in table if len(row) > power])[:, np.newaxis]
            for power in reversed(range(len(table[0])))
        ]

    def __call__(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """At x, the variable of c, of the length of y or 1, and at y, that of mu."""
        rows = np.zeros((self.rows, x.size))
        for column in self.columns:
            active = rows[: len(column)]
            active *= x
            active += column
        total = np.zeros_like(y)
        for row in rows[::-1]:
            total *= y
            total += row
        return total


NEAR_PALE, FAR_PALE = Surface(tables.NEAR_PALE), Surface(tables.FAR_PALE)
NEAR_BRIGHT, FAR_BRIGHT = Surface(tables.NEAR_BRIGHT), Surface(tables.FAR_BRIGHT)
WAVENUMBER = tables.WAVENUMBER[0][::-1]


def _cut(mu: np.ndarray, c: np.ndarray) -> np.ndarray:
    """-(a/pi) log mu, a = arg(1 - c mu artanh mu + i pi c mu/2): what is not analytic in H at mu = 0."""
    angle = np.arctan(0.5 * np.pi * c * mu / (1.0 - c * mu * np.arctanh(mu)))
    return angle * np.log(np.maximum(mu, np.finfo(float).tiny)) * (-1.0 / np.pi)


def _near(mu: np.ndarray) -> np.ndarray:
    return mu * (2.0 / tables.NEAR) - 1.0


def _far(mu: np.ndarray) -> np.ndarray:
    return 2.0 * (tables.NEAR + tables.SHIFT) / (mu + tables.SHIFT) - 1.0


def _pale(mu: np.ndarray, c: np.ndarray, near: bool) -> np.ndarray:
    x = (np.sqrt(1.0 - c) - PALE_ROOT) * (2.0 / (1.0 - PALE_ROOT)) - 1.0
    if near:
        return np.exp(_cut(mu, c) + c * mu * NEAR_PALE(x, _near(mu)))
    return np.exp(c * FAR_PALE(x, _far(mu)))


def _bright(mu: np.ndarray, c: np.ndarray, near: bool) -> np.ndarray:
    # 1 - c is exact here, so H keeps its digits however near c is to 1.
    rest = 1.0 - c
    x = 1.0 - rest * (2.0 / (1.0 - tables.PALE))
    k = np.sqrt(rest) * horner(WAVENUMBER, x)
    if near:
        smooth = _cut(mu, c) + mu * NEAR_BRIGHT(x, _near(mu))
        return (1.0 + mu) / (1.0 + k * mu) * np.exp(smooth)
    smooth = FAR_BRIGHT(x, _far(mu))
    finite = np.minimum(mu, np.finfo(float).max)
    value = (1.0 + finite) / (1.0 + k * finite) * np.exp(smooth)
    value[(mu == np.inf) & (c == 1.0)] = np.inf
    return value


def _h(mu: np.ndarray, c: np.ndarray) -> np.ndarray:
    value = np.full_like(mu, np.nan)
    known = (mu >= 0.0) & (c >= 0.0) & (c <= 1.0)
    near, pale = mu < tables.NEAR, c < tables.PALE
    single = bool((c == c[:1]).all())
    for close in (True, False):
        for low in (True, False):
            chosen = np.flatnonzero(known & (near == close) & (pale == low))
            if chosen.size:
                value[chosen] = (_pale if low else _bright)(mu[chosen], c[:1] if single else c[chosen], close)
    return value


def _brdf(mu_i: np.ndarray, mu_o: np.ndarray, c: np.ndarray) -> np.ndarray:
    h_i, h_o = np.split(_h(np.concatenate([mu_i, mu_o]), np.concatenate([c, c])), 2)
    cosines = mu_i + mu_o
    # Scaled down where it might overflow before the result does, and up where it might lose bits to underflow.
    steep = (cosines < GRAZING) & (c > GRAZING)
    up, down = np.where(steep, 2.0**-4, 2.0**64), np.where(steep, 2.0**4, 2.0**-64)
    value = c * up / cosines * (h_i * h_o * (0.25 / np.pi)) * down
    value[cosines == 0.0] = np.inf
    value[~((mu_i >= 0.0) & (mu_i <= 1.0) & (mu_o >= 0.0) & (mu_o <= 1.0) & (c >= 0.0) & (c <= 1.0))] = np.nan
    return value


def h_isotropic(mu: np.typing.ArrayLike, c: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """Chandrasekhar's H function of isotropic scattering with the single-scattering albedo `c`, at the cosine `mu`.

    The solution of 1/H(mu) = sqrt(1 - c) + (c/2) times the integral of v H(v)/(mu + v) over v in [0, 1], without unit.
    It rises from H(0) = 1 to H(inf) = 1/sqrt(1 - c), and for c = 1 as sqrt(3) mu; c = 0 gives 1. Its integral over
    [0, 1] is 2 (1 - sqrt(1 - c))/c.

    mu: any number >= 0, infinity included; a cosine where it is at most 1. c: albedo in [0, 1]. Shapes broadcast;
    anything else, NaN included, gives NaN. float32 for float32 arguments, float64 otherwise. TypeError for arguments
    that are no real numbers, ValueError for shapes that do not broadcast.

    `dupuy2016:31`, by polynomials for what is left of it without its pole and without mu log mu. Largest error found: a
    relative 4.9e-16 in float64, 0.5 ulp in float32.

    >>> h_isotropic([0, 0.5, 1, 100], [[0.5], [1]])
    array([[  1.        ,   1.18773513,   1.25125956,   1.41122268],
           [  1.        ,   2.01277877,   2.90781053, 174.43478892]])
    """
    return elementwise(_h, mu=mu, c=c)


def brdf_isotropic(
    mu_i: np.typing.ArrayLike, mu_o: np.typing.ArrayLike, c: np.typing.ArrayLike
) -> np.ndarray | np.floating:
    """BRDF of a half-space that scatters isotropically with the single-scattering albedo `c`.

    c/(4 pi) H(mu_i) H(mu_o)/(mu_i + mu_o), in 1/sr, the same for every azimuth and with the cosines exchanged. 2 pi
    times the integral of mu_o brdf over mu_o in [0, 1] is the albedo 1 - sqrt(1 - c) H(mu_i): 1 for c = 1. It is
    infinite where both cosines are 0, whatever c.

    mu_i, mu_o: cosines in [0, 1]. c: albedo in [0, 1]. Shapes broadcast; anything else, NaN included, gives NaN.
    float32 for float32 arguments, float64 otherwise. TypeError for arguments that are no real numbers, ValueError for
    shapes that do not broadcast.

    `dupuy2016:30`, with `h_isotropic`. Largest error found: a relative 8.2e-16 in float64, 0.5 ulp in float32.

    >>> brdf_isotropic([0, 0.5, 1], 1, [[0.5], [1]])
    array([[0.04978604, 0.03942175, 0.03114763],
           [0.23139621, 0.31049959, 0.33642817]])
    """
    return elementwise(_brdf, mu_i=mu_i, mu_o=mu_o, c=c)
