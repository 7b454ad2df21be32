"""The share of light that a half-space of Lambertian spheres returns, with all of their phase function.

Two solvers: `three_terms.discrete`, a singular value decomposition, and `doubled`, which starts from the reflection of
a thin layer and doubles it. Only the first azimuthal mode counts, as the others return no light in the mean.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from xsec_sym.exact.three_terms import Array, discrete, legendre, nodes

LAST = 32  # of the Legendre orders; those beyond change the answer by less than 1e-12


@lru_cache(maxsize=1)
def flight() -> tuple[float, ...]:
    """A_l = (-1)^l (2 l + 1) a_l^2, by the clamped cosine's moments a_l = 2 int_0^1 mu P_l: 0 for odd l beyond 1.

    >>> [round(float(a), 12) + 0.0 for a in flight()[:5]]
    [1.0, -1.333333333333, 0.3125, 0.0, 0.015625]
    """
    mu, weight = nodes(100, 1)
    moments = 2 * legendre(0, list(range(LAST + 1)), mu) @ (weight * mu)
    return tuple(0.0 if l % 2 and l > 1 else (-1.0) ** l * (2 * l + 1) * a**2 for l, a in enumerate(moments))


def _returned(weight: Array, phi: Array) -> float:
    """1 - phi_1 / mu is the share of a beam's light that returns."""
    return 1 - 2 * float(weight @ phi)


@lru_cache(maxsize=4096)
def by_directions(c: float) -> float:
    """The Bond albedo from discrete directions.

    >>> round(by_directions(0.5), 12)
    0.193504763232
    """
    if c == 1:
        return 1.0
    orders, _, _, weight, _, phi = discrete(0, flight(), c, 64, 3)
    return _returned(weight, phi[orders.index(1)])


@lru_cache(maxsize=4096)
def by_doubling(c: float) -> float:
    """The Bond albedo from layers that are doubled until nothing more returns.

    >>> round(by_doubling(0.5), 10)
    0.1935047632
    """
    if c == 1:
        return 1.0
    # no crowding: the first layer is thin against the smallest cosine, and digits go with it
    mu, weight = nodes(72, 1)
    a = np.array(flight())
    signs, root = (-1.0) ** np.arange(a.size), np.sqrt(weight)
    rows = root * legendre(0, list(range(a.size)), mu)
    onward, back = (c / 2 * (rows.T * f) @ rows for f in (a, a * signs))
    loss, gain = (np.eye(mu.size) - onward) / mu[:, None], back / mu[:, None]
    thin = loss.diagonal().max()
    lossy = loss + thin * np.eye(mu.size)
    inverse = np.linalg.inv(lossy - gain @ np.linalg.solve(lossy, gain))
    through, reflected = np.eye(mu.size) - 2 * thin * inverse, 2 * thin * np.linalg.solve(lossy, gain) @ inverse
    for _ in range(80):
        between = through @ np.linalg.inv(np.eye(mu.size) - reflected @ reflected)
        added = between @ reflected @ through
        through, reflected = between @ through, reflected + added
        if abs(added).max() < 1e-17:
            break
    return _returned(weight, (rows[1] - rows[1] @ reflected) / root)


@lru_cache(maxsize=2)
def _table(doubling: bool) -> np.polynomial.Chebyshev:
    """The albedo in s = sqrt(1 - c), in which it is smooth."""
    albedo, degree = by_doubling if doubling else by_directions, 17
    # s = 0 is known, and next to it a solver loses digits
    s = np.r_[0, 0.05 + 0.95 * (1 - np.cos(np.pi * np.arange(25) / 24)) / 2]
    return np.polynomial.Chebyshev.fit(s, [albedo(1 - x * x) for x in s], degree, domain=[0, 1])


def returned(c: Array, doubling: bool = False) -> Array:
    """The Bond albedo at any single-scattering albedo, by way of the table: a solver loses digits near c = 1.

    >>> returned(np.array([0.0, 1.0])).round(12) + 0.0
    array([0., 1.])
    """
    c = np.asarray(c, dtype=np.float64)
    found = np.clip(_table(doubling)(np.sqrt(np.clip(1 - c, 0, 1))), 0, 1)
    return np.where((c >= 0) & (c <= 1), found, np.nan)


def particle(k_d: Array, doubling: bool = False) -> Array:
    """The single-scattering albedo at which the half-space has the Bond albedo k_d, by Newton's method in s.

    >>> bool(abs(particle(np.array([by_directions(0.7)])) - 0.7) < 1e-12)
    True
    """
    k_d = np.asarray(k_d, dtype=np.float64)
    series = _table(doubling)
    slope, s = series.deriv(), 1 - k_d
    for _ in range(30):
        s = np.clip(s - (series(s) - k_d) / slope(s), 0, 1)
    return np.where((k_d >= 0) & (k_d <= 1), 1 - s * s, np.nan)
