"""The cross-section of the spherical Gaussian, region by region of the plane of u and alpha.

kappa = 2/alpha^2, v = |u|, s = sqrt(1 - v^2), w = kappa (1 - s). `xsec_sym.export.spherical_gaussian` defines the
functions that stand in `_spherical_gaussian_tables` as polynomials, and says why these.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from xsec_sym.kernels import _spherical_gaussian_tables as tables
from xsec_sym.kernels._pairs import quotient
from xsec_sym.kernels._patches import Patches
from xsec_sym.kernels._support import horner, quick_two_sum, two_prod, two_square

Cell = int | np.ndarray

# The bounds on kappa of the first two regions, and on kappa s of the two of the rim.
PALE, STEEP, RIM = tables.EVEN_Y[-1] ** 0.5, tables.ROUND_Y[-1], tables.RIM_X[-1]


class Kit(NamedTuple):
    """The tables of one accuracy; with pairs, exponents are formed to twice the digits."""

    even: Patches
    round: Patches
    layer: Patches
    rim: Patches
    edge: Patches
    half_layer: list[float]
    mean_cosine: list[float]
    pairs: bool


def _kit(prefix: str) -> Kit:
    even, round_, layer, rim, edge = (
        Patches(getattr(tables, f"{name}_X"), getattr(tables, f"{name}_Y"), getattr(tables, prefix + name))
        for name in ("EVEN", "ROUND", "LAYER", "RIM", "EDGE")
    )
    half_layer, mean = (getattr(tables, prefix + name)[0][::-1] for name in ("HALF_LAYER", "MEAN_COSINE"))
    return Kit(even, round_, layer, rim, edge, half_layer, mean, pairs=not prefix)


PRECISE, FAST = _kit(""), _kit("FAST_")


def sine(v: np.ndarray) -> np.ndarray:
    return np.sqrt((1.0 - v) * (1.0 + v))


def mean_cosine(kit: Kit, kappa: np.ndarray, pale: bool = False) -> np.ndarray:
    """coth kappa - 1/kappa, for kappa below PALE or above."""
    if pale:
        return kappa * horner(kit.mean_cosine, kappa * kappa * (2.0 / tables.EVEN_Y[-1]) - 1.0)
    return (1.0 - 1.0 / kappa) + 2.0 / np.expm1(2.0 * kappa)


def pale_cosine(kit: Kit, alpha: np.ndarray) -> np.ndarray:
    """The same for kappa < PALE, rounded once: else sigma's odd part might be a place further off."""
    kappa, kappa_low = quotient(2.0, 0.0, *two_square(alpha))
    x = kappa * kappa * (2.0 / tables.EVEN_Y[-1]) - 1.0
    *rest, first = kit.mean_cosine
    ratio, ratio_low = quick_two_sum(first, x * horner(rest, x))
    mean, low = two_prod(kappa, ratio)
    # c is as kappa^(1 - kappa^2/10), about.
    return mean + (low + kappa * ratio_low + ratio * kappa_low * (1.0 - 0.1 * kappa * kappa))


def even(kit: Kit, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> np.ndarray:
    """kappa < PALE: half of sigma(v) + sigma(-v)."""
    kappa = 2.0 / (alpha * alpha)
    return kit.even(v * v, kappa * kappa, cell)


class Dark(NamedTuple):
    """sigma(-v) as factor exp(-x), with s; x is kappa v where `along`, else w."""

    factor: np.ndarray
    x: np.ndarray
    s: np.ndarray
    along: bool = False


def round_(kit: Kit, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> Dark:
    """PALE < kappa < STEEP: sigma(-v) = kappa/(1 - exp(-2 kappa)) exp(-kappa v) times an entire function."""
    kappa = 2.0 / (alpha * alpha)
    return Dark(kit.round(v, kappa, cell) * kappa / -np.expm1(-2.0 * kappa), kappa * v, sine(v), True)


def least_exponent(v: np.ndarray, s: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    return 2.0 * (v * v) / (alpha * alpha * (1.0 + s))


def layer(kit: Kit, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> Dark:
    """kappa > STEEP and v < LIT: a boundary layer, and what the curvature of the sphere adds to it."""
    s, a = sine(v), alpha * alpha
    w = least_exponent(v, s, alpha)
    z = np.sqrt(w)
    flat = horner(kit.half_layer, 2.0 * tables.HALF / (tables.HALF + z) - 1.0) / ((1.0 + z) * (1.0 + z))
    bent = kit.layer(1.0 / (s + tables.SHIFT), a, cell)
    flat *= 0.5 * mean_cosine(kit, 2.0 / a) * np.sqrt(1.0 + s)
    return Dark((alpha * np.sqrt(0.5)) * (flat + (0.5 * a) * bent), w, s)


def _rim(q: np.ndarray, v: np.ndarray, s: np.ndarray, alpha: np.ndarray) -> Dark:
    """kappa > STEEP and v > LIT: the half-line's integral q/kappa^2 without what lies beyond t = 1."""
    a = alpha * alpha
    kappa = 2.0 / a
    surplus = v * (1.0 + 0.5 * a) * np.exp(-kappa * (1.0 + s))
    return Dark((0.5 * a * q - surplus) / -np.expm1(-2.0 * kappa), least_exponent(v, s, alpha), s)


def rim(kit: Kit, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> Dark:
    s, a = sine(v), alpha * alpha
    return _rim(kit.rim(2.0 / a * s, a * a, cell), v, s, alpha)


def edge(kit: Kit, v: np.ndarray, alpha: np.ndarray, cell: Cell) -> Dark:
    s = sine(v)
    inverse = 0.5 * (alpha * alpha) / s
    return _rim(kit.edge(inverse, s * s, cell) * np.sqrt(inverse), v, s, alpha)


def round_off(v: np.ndarray, alpha: np.ndarray, rough: np.ndarray, along: bool) -> np.ndarray:
    """What the exponent `rough` of a `Dark` lacks: exp(-x) has the relative error x eps if x is rounded once."""
    a, a_low = two_square(alpha)
    if along:
        kappa, kappa_low = quotient(2.0, 0.0, a, a_low)
        x, low = two_prod(kappa, v)
        return (x - rough) + (low + kappa_low * v)
    # 2 v^2/(alpha^2 (1 + s)), where s is a pair as well: 1 - v^2 is exact to 106 bits of 1.
    n, n_low = two_square(v)
    c = 1.0 - n
    s = np.sqrt(c)
    square, error = two_square(s)
    s_low = (((c - square) - error) + (((1.0 - c) - n) - n_low)) / np.maximum(2.0 * s, np.finfo(float).tiny)
    one = 1.0 + s
    d, d_low = two_prod(a, one)
    d_low += a * ((s - (one - 1.0)) + s_low) + a_low * one
    w, low = quotient(2.0 * n, 2.0 * n_low, d, d_low)
    return (w - rough) + low


Region = Callable[[Kit, np.ndarray, np.ndarray, Cell], np.ndarray | Dark]
# In the order in which the cells of all regions are numbered, that of a kit.
REGIONS: tuple[Region, ...] = (even, round_, layer, rim, edge)


def place(kit: Kit, v: float, s: float, a: float, kappa: float) -> tuple[Region, int]:
    """The region of a single point, and its cell there."""
    if kappa < PALE:
        return even, kit.even.cell_of_one(v, kappa * kappa)
    if kappa <= STEEP:
        return round_, kit.round.cell_of_one(v, kappa)
    if v <= tables.LIT:
        return layer, kit.layer.cell_of_one(1.0 / (s + tables.SHIFT), a)
    ks = kappa * s
    return (rim, kit.rim.cell_of_one(ks, ks)) if ks < RIM else (edge, kit.edge.cell_of_one(1.0 / ks, ks))


def cells(kit: Kit, v: np.ndarray, s: np.ndarray, a: np.ndarray, kappa: np.ndarray) -> np.ndarray:
    """The number of each point's cell, counted through all regions; a = alpha^2."""
    number = np.empty(v.shape, np.uint8)
    pale, steep, high = kappa < PALE, kappa > STEEP, v > tables.LIT
    beyond = steep & high
    steep ^= beyond
    first = 0

    def fill(patches: Patches, inside: np.ndarray, x: np.ndarray, y: np.ndarray) -> None:
        nonlocal first
        chosen = inside.nonzero()[0]
        if chosen.size:
            number[chosen] = patches.cell(x[chosen], y[chosen]) + np.uint8(first)
        first += len(patches)

    fill(kit.even, pale, v, kappa * kappa)
    fill(kit.round, ~(pale | beyond | steep), v, kappa)
    fill(kit.layer, steep, 1.0 / (s + tables.SHIFT), a)
    ks = kappa * s
    near = ks < RIM
    fill(kit.rim, beyond & near, ks, ks)
    fill(kit.edge, beyond & ~near, 1.0 / ks, ks)
    return number
