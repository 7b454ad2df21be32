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
from xsec_sym.kernels._patches import Patches
from xsec_sym.kernels._spherical_gaussian_regions import PALE, PRECISE, Cell, sine
from xsec_sym.kernels._support import horner

ERFCX, FADING = slopes.ERFCX[::-1], slopes.FADING[::-1]
NAMES = ("EVEN", "ROUND", "LAYER", "RIM", "EDGE")

Dark = Callable[[Patches, np.ndarray, np.ndarray, Cell], np.ndarray]


class Slope(NamedTuple):
    """Region by region the derivative on the side turned away, of v and alpha; and that facing, of it, u and alpha."""

    patches: list[Patches]
    dark: tuple[Dark, ...]
    facing: Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
    # Of alpha = 0 at u = 0, where it jumps.
    flat: float


def _patches(prefix: str) -> list[Patches]:
    return [
        Patches(getattr(tables, f"{name}_X"), getattr(tables, f"{name}_Y"), getattr(slopes, prefix + name))
        for name in NAMES
    ]


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


def _fall(v: np.ndarray, alpha: np.ndarray, x: np.ndarray, along: bool = False) -> np.ndarray:
    """exp(-x), x = kappa v where `along` and w elsewhere."""
    fall = np.exp(-x)
    return fall - fall * regions.round_off(v, alpha, x, along)


def _shrinking(v: np.ndarray, alpha: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """s, w, exp(-w), 1 - exp(-2 kappa)."""
    s = sine(v)
    w = regions.least_exponent(v, s, alpha)
    return s, w, _fall(v, alpha, w), -np.expm1(-4.0 / (alpha * alpha))


def _half_layer(z: np.ndarray) -> np.ndarray:
    return horner(PRECISE.half_layer, 2.0 * tables.HALF / (tables.HALF + z) - 1.0) / ((1.0 + z) * (1.0 + z))


def _even_u(patches: Patches, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> np.ndarray:
    kappa = 2.0 / (alpha * alpha)
    k = kappa * kappa
    return 0.5 * regions.mean_cosine(PRECISE, kappa, pale=True) - k * v * patches(v * v, k, cell)


def _round_u(patches: Patches, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> np.ndarray:
    kappa = 2.0 / (alpha * alpha)
    return patches(v, kappa, cell) * (kappa * kappa) / -np.expm1(-2.0 * kappa) * _fall(v, alpha, kappa * v, True)


def _layer_u(patches: Patches, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> np.ndarray:
    a = alpha * alpha
    s, w, fall, _ = _shrinking(v, alpha)
    z, c = np.sqrt(w), regions.mean_cosine(PRECISE, 2.0 / a)
    flat = c * (1.0 + s) * horner(ERFCX, 2.0 * tables.HALF / (tables.HALF + z) - 1.0) / (4.0 * s * (1.0 + z))
    bent = patches(1.0 / (s + tables.SHIFT), a, cell) + c * _half_layer(z) / (4.0 * np.sqrt(1.0 + s))
    return fall * (flat + alpha * math.sqrt(0.5) * v / s * bent)


def _rim_u(found: np.ndarray, v: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    kappa = 2.0 / (alpha * alpha)
    s, _, fall, rest = _shrinking(v, alpha)
    beyond = np.exp(-kappa * (1.0 + s)) / kappa
    return fall * kappa / rest * (found + beyond * (1.0 + 1.0 / kappa))


def _near_rim_u(patches: Patches, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> np.ndarray:
    a = alpha * alpha
    return _rim_u(patches(2.0 / a * sine(v), a * a, cell), v, alpha)


def _far_rim_u(patches: Patches, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> np.ndarray:
    s = sine(v)
    inverse = 0.5 * (alpha * alpha) / s
    return _rim_u(patches(inverse, s * s, cell) * inverse * np.sqrt(inverse), v, alpha)


def _facing_u(dark: np.ndarray, u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    return np.where(u > 0.0, _mean(2.0 / (alpha * alpha)) - dark, dark)


# As d sigma/d alpha = -2 kappa/alpha d sigma/d kappa, what follows is kappa K.


def _even_kappa(patches: Patches, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> np.ndarray:
    kappa = 2.0 / (alpha * alpha)
    k = kappa * kappa
    return 0.5 * v * _fading(kappa) - k * patches(v * v, k, cell)


def _round_kappa(patches: Patches, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> np.ndarray:
    return _round_u(patches, v, alpha, cell)


def _layer_kappa(patches: Patches, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> np.ndarray:
    a = alpha * alpha
    s, w, fall, _ = _shrinking(v, alpha)
    bent = 0.5 * _fading(2.0 / a) * np.sqrt(1.0 + s) * _half_layer(np.sqrt(w))
    return fall * (alpha * math.sqrt(0.5)) * (patches(1.0 / (s + tables.SHIFT), a, cell) - bent)


def _rim_kappa(rim: regions.Region, found: np.ndarray, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> np.ndarray:
    a = alpha * alpha
    kappa = 2.0 / a
    s, _, fall, rest = _shrinking(v, alpha)
    beyond = v * np.exp(-kappa * (1.0 + s)) * (1.0 + a + 0.5 * a * a)
    sigma = rim(PRECISE, v, alpha, cell)
    assert isinstance(sigma, regions.Dark)
    return fall * kappa * (regions.mean_cosine(PRECISE, kappa) * sigma.factor - (0.25 * a * a * found + beyond) / rest)


def _near_rim_kappa(patches: Patches, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> np.ndarray:
    a = alpha * alpha
    return _rim_kappa(regions.rim, patches(2.0 / a * sine(v), a * a, cell), v, alpha, cell)


def _far_rim_kappa(patches: Patches, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> np.ndarray:
    s = sine(v)
    inverse = 0.5 * (alpha * alpha) / s
    return _rim_kappa(regions.edge, patches(inverse, s * s, cell) / np.sqrt(inverse), v, alpha, cell)


def _facing_kappa(dark: np.ndarray, u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    return 2.0 / alpha * (dark - np.maximum(u, 0.0) * _fading(2.0 / (alpha * alpha)))


BY_U = Slope(_patches("U_"), (_even_u, _round_u, _layer_u, _near_rim_u, _far_rim_u), _facing_u, 0.5)
BY_ALPHA = Slope(
    _patches("KAPPA_"),
    (_even_kappa, _round_kappa, _layer_kappa, _near_rim_kappa, _far_rim_kappa),
    _facing_kappa,
    0.5 / math.sqrt(math.pi),
)


def evaluate(slope: Slope, u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    dark, v = np.zeros_like(u), np.abs(u)
    parts = [slice(start, start + core.PART) for start in range(0, max(u.size, 1), core.PART)]
    found = [_left(v[part], alpha[part]) for part in parts]
    places = np.concatenate([left + part.start for (left, _), part in zip(found, parts, strict=True)])
    for region, chosen, cell in core.grouped(PRECISE, places, np.concatenate([cells for _, cells in found])):
        i = regions.REGIONS.index(region)
        dark[chosen] = slope.dark[i](slope.patches[i], v[chosen], alpha[chosen], cell)
    for part in parts:
        dark[part] = slope.facing(dark[part], u[part], alpha[part])
    dark[~((v <= 1.0) & (alpha >= 0.0))] = np.nan
    tiny = ((v <= 1.0) & (alpha >= 0.0) & (alpha < core.SMALLEST)).nonzero()[0]
    if tiny.size:
        dark[tiny] = _tiny(slope, u[tiny], alpha[tiny])
    return dark


def _left(v: np.ndarray, alpha: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The places where the side turned away has not underflowed, and the numbers of their cells."""
    s = sine(v)
    known = (v <= 1.0) & (alpha >= core.SMALLEST) & (regions.least_exponent(v, s, alpha) <= core.DARK_ENDS)
    left = known.nonzero()[0]
    a = alpha[left] * alpha[left]
    return left, regions.cells(PRECISE, v[left], s[left], a, 2.0 / a)


def _tiny(slope: Slope, u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """Of u and alpha scaled up by a power of 2: on the side turned away the derivatives depend on u/alpha alone."""
    mantissa, power = np.frexp(alpha)
    away = -np.minimum(np.ldexp(np.abs(u), -400 - power), 1.0)
    dark = evaluate(slope, away, np.ldexp(np.maximum(mantissa, 0.5), -400))
    dark = np.where(alpha > 0.0, dark, np.where(u == 0.0, slope.flat, 0.0))
    if slope is BY_U:
        return np.where(u > 0.0, 1.0 - dark, dark)
    return dark - np.maximum(u, 0.0) * alpha
