"""Derivatives of the spherical Gaussian's cross-section, by the cosine and by the roughness.

`xsec_sym.export.spherical_gaussian_slopes` defines T and K, the derivatives on the side turned away, and the functions
that stand for them in `_spherical_gaussian_slopes_tables`. Both are positive, and so is what is added facing.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from xsec_sym.kernels import _spherical_gaussian_core as core
from xsec_sym.kernels import _spherical_gaussian_regions as regions
from xsec_sym.kernels import _spherical_gaussian_slopes_tables as slopes
from xsec_sym.kernels import _spherical_gaussian_tables as tables
from xsec_sym.kernels._spherical_gaussian_regions import PALE, PRECISE, Grid, Points
from xsec_sym.kernels._spherical_gaussian_sorting import Group, Left
from xsec_sym.kernels._support import horner

# Points looked at at once.
PART = core.PART // 8
ERFCX, FADING = slopes.ERFCX[::-1], slopes.FADING[::-1]


class Slope(NamedTuple):
    """Region by region the derivative on the side turned away; and that facing, of it."""

    grid: Grid
    dark: tuple[Callable[[Group], np.ndarray], ...]
    facing: Callable[[np.ndarray, Points], np.ndarray]
    # Of alpha = 0 at u = 0, where it jumps.
    flat: float


def _mean(kappa: np.ndarray) -> np.ndarray:
    """c = coth kappa - 1/kappa."""
    pale = regions.mean_cosine(PRECISE, np.minimum(kappa, PALE), pale=True)
    return np.where(kappa < PALE, pale, regions.mean_cosine(PRECISE, kappa))


def _fading(kappa: np.ndarray) -> np.ndarray:
    """kappa c'."""
    few, fall = np.minimum(kappa, PALE), np.exp(-2.0 * kappa)
    pale = few * horner(FADING, few * few * (2.0 / tables.EVEN_Y[-1]) - 1.0)
    less = np.minimum(kappa, 1e3) * 4.0 * fall / ((1.0 - fall) * (1.0 - fall))
    return np.where(kappa < PALE, pale, 1.0 / kappa - less)


def _fall(group: Group) -> np.ndarray:
    """exp(-x) of the region's exponent."""
    at = group.region.steep(PRECISE, group.points)
    fall = np.exp(-at.x)
    return fall - fall * regions.round_off(at)


def _rest(p: Points) -> np.ndarray:
    """1 - exp(-2 kappa)"""
    return -np.expm1(-2.0 * p.kappa)


def _half_layer(z: np.ndarray) -> np.ndarray:
    return horner(PRECISE.half_layer, 2.0 * tables.HALF / (tables.HALF + z) - 1.0) / ((1.0 + z) * (1.0 + z))


def _even_u(group: Group) -> np.ndarray:
    p = group.points
    return 0.5 * regions.mean_cosine(PRECISE, p.kappa, pale=True) - p.kappa * p.kappa * p.v * group.found


def _round(group: Group) -> np.ndarray:
    p = group.points
    return group.found * (p.kappa * p.kappa) / _rest(p) * _fall(group)


def _layer_u(group: Group) -> np.ndarray:
    p = group.points
    z, c = np.sqrt(regions.least_exponent(p)), regions.mean_cosine(PRECISE, p.kappa)
    flat = c * (1.0 + p.s) * horner(ERFCX, 2.0 * tables.HALF / (tables.HALF + z) - 1.0) / (4.0 * p.s * (1.0 + z))
    bent = group.found + c * _half_layer(z) / (4.0 * np.sqrt(1.0 + p.s))
    return _fall(group) * (flat + p.alpha * math.sqrt(0.5) * p.v / p.s * bent)


def _rim_u(group: Group) -> np.ndarray:
    p = group.points
    found = group.found
    if group.region is regions.FAR:
        inverse = 0.5 * p.a / p.s
        found = found * inverse * np.sqrt(inverse)
    beyond = np.exp(-p.kappa * (1.0 + p.s)) / p.kappa
    return _fall(group) * p.kappa / _rest(p) * (found + beyond * (1.0 + 1.0 / p.kappa))


def _facing_u(dark: np.ndarray, p: Points) -> np.ndarray:
    return np.where(p.u > 0.0, _mean(p.kappa) - dark, dark)


# As d sigma/d alpha = -2 kappa/alpha d sigma/d kappa, what follows is kappa K.


def _even_kappa(group: Group) -> np.ndarray:
    p = group.points
    return 0.5 * p.v * _fading(p.kappa) - p.kappa * p.kappa * group.found


def _layer_kappa(group: Group) -> np.ndarray:
    p = group.points
    bent = 0.5 * _fading(p.kappa) * np.sqrt(1.0 + p.s) * _half_layer(np.sqrt(regions.least_exponent(p)))
    return _fall(group) * (p.alpha * math.sqrt(0.5)) * (group.found - bent)


def _rim_kappa(group: Group) -> np.ndarray:
    p = group.points
    found = group.found
    if group.region is regions.FAR:
        found = found / np.sqrt(0.5 * p.a / p.s)
    beyond = p.v * np.exp(-p.kappa * (1.0 + p.s)) * (1.0 + p.a + 0.5 * p.a * p.a)
    factor = group.region.factor
    assert factor is not None
    at = group.region.steep(PRECISE, p)
    sigma = factor(PRECISE, group.of(PRECISE.grid), at)
    return _fall(group) * p.kappa * (at.mean * sigma - (0.25 * p.a * p.a * found + beyond) / _rest(p))


def _facing_kappa(dark: np.ndarray, p: Points) -> np.ndarray:
    return 2.0 / p.alpha * (dark - np.maximum(p.u, 0.0) * _fading(p.kappa))


BY_U = Slope(regions.grid(slopes, "U_"), (_even_u, _round, _layer_u, _rim_u, _rim_u), _facing_u, 0.5)
BY_ALPHA = Slope(
    regions.grid(slopes, "KAPPA_"),
    (_even_kappa, _round, _layer_kappa, _rim_kappa, _rim_kappa),
    _facing_kappa,
    0.5 / math.sqrt(math.pi),
)


def evaluate(slope: Slope, u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    dark = np.zeros_like(u)
    parts = [slice(start, start + PART) for start in range(0, u.size, PART)]
    left = Left(slope.grid, u, alpha)
    for part in parts:
        p = regions.points(u[part], alpha[part])
        # Where the side turned away has not underflowed.
        known = (p.v <= 1.0) & (p.alpha >= PRECISE.smallest) & (regions.least_exponent(p) <= PRECISE.dark_ends)
        left.add(part.start, known.nonzero()[0], p)
    for group in left.groups():
        dark[group.places] = slope.dark[regions.REGIONS.index(group.region)](group)
    for part in parts:
        dark[part] = slope.facing(dark[part], regions.points(u[part], alpha[part]))
    known = (np.abs(u) <= 1.0) & (alpha >= 0.0)
    dark[~known] = np.nan
    tiny = (known & (alpha < PRECISE.smallest)).nonzero()[0]
    if tiny.size:
        dark[tiny] = _tiny(slope, u[tiny], alpha[tiny])
    return dark


def _tiny(slope: Slope, u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """Of u and alpha scaled up by a power of 2: on the side turned away the derivatives depend on u/alpha alone."""
    mantissa, power = np.frexp(alpha)
    away = -np.minimum(np.ldexp(np.abs(u), core.SHRUNK - power), 1.0)
    dark = evaluate(slope, away, np.ldexp(np.maximum(mantissa, 0.5), core.SHRUNK))
    dark = np.where(alpha > 0.0, dark, np.where(u == 0.0, slope.flat, 0.0))
    if slope is BY_U:
        return np.where(u > 0.0, 1.0 - dark, dark)
    return dark - np.maximum(u, 0.0) * alpha
