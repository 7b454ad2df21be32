"""The cross-section of the spherical Gaussian, region by region of the plane of u and alpha.

kappa = 2/alpha^2, v = |u|, s = sqrt(1 - v^2), w = kappa (1 - s). `xsec_sym.export.spherical_gaussian_functions` defines
the functions that stand in `_spherical_gaussian_tables` as polynomials, and says why these.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from xsec_sym.kernels import _spherical_gaussian_tables as tables
from xsec_sym.kernels._pairs import quotient
from xsec_sym.kernels._patches import Joined, Patches
from xsec_sym.kernels._support import horner, quick_two_sum, two_prod, two_square

# The bounds on kappa of the first two regions, and on kappa s of the two of the rim.
PALE, STEEP, RIM = tables.EVEN_Y[-1] ** 0.5, tables.ROUND_Y[-1], tables.RIM_X[-1]
NAMES = ("EVEN", "ROUND", "LAYER", "RIM", "EDGE")
# What EVEN's polynomials leave out in float32: the odd part is subtracted from it, and would show its rounding.
EVEN_MIDDLE = 0.25


class Points(NamedTuple):
    """Cosines and roughnesses, and v = |u|, s, a = alpha^2 and kappa of them: arrays, or numbers."""

    u: Any
    alpha: Any
    v: Any
    s: Any
    a: Any
    kappa: Any

    def at(self, chosen: np.ndarray | slice) -> "Points":
        return Points(*(part[chosen] for part in self))


def points(u: np.ndarray, alpha: np.ndarray, dtype: type[np.floating] = np.float64) -> Points:
    u, alpha = np.asarray(u, dtype), np.asarray(alpha, dtype)
    v, a = np.abs(u), alpha * alpha
    return Points(u, alpha, v, sine(v), a, 2.0 / a)


class Grid:
    """The polynomials of all regions, in the order of REGIONS, with their cells numbered through."""

    def __init__(self, parts: list[Patches]) -> None:
        self.parts, self.joined = parts, Joined(parts)
        # The number of the first cell of each part, and that of cells.
        self.firsts = np.cumsum([0, *map(len, parts)]).tolist()
        self.own = [(part, cell) for part in parts for cell in range(len(part))]

    def __call__(self, x: np.ndarray, y: np.ndarray, cell: int | np.ndarray) -> np.ndarray:
        """At points of one cell, or each with the number of its own, in the precision of the tables."""
        x, y = np.asarray(x, self.joined.dtype), np.asarray(y, self.joined.dtype)
        if isinstance(cell, int):
            patches, number = self.own[cell]
            return patches(x, y, number)
        return self.joined(x, y, cell)


class Kit(NamedTuple):
    """The tables of one accuracy, and where sigma is simple to it."""

    grid: Grid
    half_layer: list[float]
    mean_cosine: list[float]
    # Of the polynomials, and of what is done at once.
    dtype: type[np.floating]
    # Exponents are formed to twice the digits, and the mean cosine.
    pairs: bool
    # Up to here on kappa a Taylor series of three terms is enough.
    faint: float
    # From here on w the dark side is nothing beside the lit one: sigma(-v)/v was below exp(-w)/w wherever it was tried.
    lit_ends: float
    # exp(-w) is 0 from here on.
    dark_ends: float
    # Below it sigma(u, alpha) = alpha f(u/alpha) to all digits, since corrections are of the order of alpha^2.
    smallest: float


def grid(module: object, prefix: str, dtype: type[np.floating] = np.float64) -> Grid:
    """From tables whose names begin so."""
    made = {name: getattr(module, prefix + name) for name in NAMES}
    if dtype is np.float32:
        made["EVEN"] = [[[row[0] - EVEN_MIDDLE, *row[1:]], *rest] for row, *rest in made["EVEN"]]
    return Grid(
        [Patches(getattr(tables, f"{name}_X"), getattr(tables, f"{name}_Y"), made[name], dtype) for name in NAMES]
    )


def _lines(prefix: str) -> tuple[list[float], list[float]]:
    half_layer, mean = (getattr(tables, prefix + name)[0][::-1] for name in ("HALF_LAYER", "MEAN_COSINE"))
    return half_layer, mean


PRECISE = Kit(grid(tables, ""), *_lines(""), np.float64, True, 0.006, 37.0, 746.0, 1e-100)
FAST = Kit(grid(tables, "FAST_"), *_lines("FAST_"), np.float64, False, 0.15, 16.0, 746.0, 1e-100)
SINGLE = Kit(grid(tables, "FAST_", np.float32), *_lines("FAST_"), np.float32, False, 0.15, 16.0, 104.0, 1e-15)


def sine(v: np.ndarray) -> np.ndarray:
    return np.sqrt((1.0 - v) * (1.0 + v))


def mean_cosine(kit: Kit, kappa: np.ndarray, pale: bool = False) -> np.ndarray:
    """coth kappa - 1/kappa, for kappa below PALE or above."""
    if pale:
        return kappa * horner(kit.mean_cosine, kappa * kappa * (2.0 / tables.EVEN_Y[-1]) - 1.0)
    return (1.0 - 1.0 / kappa) + 2.0 / np.expm1(2.0 * kappa)


class Inverse(NamedTuple):
    """alpha^2 and kappa as pairs."""

    a: Any
    a_low: Any
    kappa: Any
    kappa_low: Any

    def at(self, chosen: slice) -> "Inverse":
        return Inverse(*(part[chosen] for part in self))


def inverse(alpha: Any) -> Inverse:
    a, a_low = two_square(alpha)
    return Inverse(a, a_low, *quotient(2.0, 0.0, a, a_low))


def pale_cosine(kit: Kit, alpha: Any, known: Inverse | None = None) -> Any:
    """The same for kappa < PALE, with pairs rounded once: else sigma's odd part might be a place further off."""
    if not kit.pairs:
        return mean_cosine(kit, 2.0 / (alpha * alpha), pale=True)
    _, _, kappa, kappa_low = known or inverse(alpha)
    x = kappa * kappa * (2.0 / tables.EVEN_Y[-1]) - 1.0
    *rest, first = kit.mean_cosine
    ratio, ratio_low = quick_two_sum(first, x * horner(rest, x))
    mean, low = two_prod(kappa, ratio)
    # c is as kappa^(1 - kappa^2/10), about.
    return mean + (low + kappa * ratio_low + ratio * kappa_low * (1.0 - 0.1 * kappa * kappa))


def steep_cosine(kit: Kit, p: Points, along: bool | np.ndarray, known: Inverse | None = None) -> Any:
    """The same for kappa > PALE, where a pair gives 1/kappa = a/2 at once; `along` as in `Steep`."""
    if not kit.pairs:
        return mean_cosine(kit, p.kappa)
    beyond = 2.0 / np.expm1(2.0 * p.kappa)
    if along is False:
        # What is beyond is so small that the second part of kappa is nothing in it.
        a, a_low = two_square(p.alpha)
    else:
        a, a_low, _, kappa_low = known or inverse(p.alpha)
        beyond -= np.where(along, kappa_low, 0.0) * beyond * (2.0 + beyond)
    most, low = quick_two_sum(1.0, -0.5 * a)
    return most + (low - 0.5 * a_low + beyond)


def even(kit: Kit, found: np.ndarray, u: np.ndarray) -> np.ndarray:
    """EVEN from its polynomials, in the precision of u."""
    return found.astype(u.dtype) + EVEN_MIDDLE if kit.dtype is np.float32 else found


def least_exponent(p: Points) -> np.ndarray:
    """w"""
    return 2.0 * (p.v * p.v) / (p.a * (1.0 + p.s))


class Steep(NamedTuple):
    """Where sigma(-v) falls as exp(-x): x = kappa v where `along`, else w; and the mean cosine c, for kappa > PALE."""

    points: Points
    x: np.ndarray
    mean: np.ndarray
    along: bool | np.ndarray

    def at(self, chosen: np.ndarray | slice) -> "Steep":
        along = self.along if isinstance(self.along, bool) else self.along[chosen]
        return Steep(self.points.at(chosen), self.x[chosen], self.mean[chosen], along)


def round_(kit: Kit, found: np.ndarray, at: Steep) -> np.ndarray:
    kappa = at.points.kappa
    return found * kappa / -np.expm1(-2.0 * kappa)


def layer(kit: Kit, found: np.ndarray, at: Steep) -> np.ndarray:
    p, z = at.points, np.sqrt(at.x)
    flat = horner(kit.half_layer, 2.0 * tables.HALF / (tables.HALF + z) - 1.0) / ((1.0 + z) * (1.0 + z))
    flat *= 0.5 * at.mean * np.sqrt(1.0 + p.s)
    return (p.alpha * math.sqrt(0.5)) * (flat + (0.5 * p.a) * found)


def rim(kit: Kit, found: np.ndarray, at: Steep) -> np.ndarray:
    """The half-line's integral q/kappa^2 without what lies beyond t = 1."""
    p = at.points
    surplus = p.v * (1.0 + 0.5 * p.a) * np.exp(-p.kappa * (1.0 + p.s))
    return (0.5 * p.a * found - surplus) / -np.expm1(-2.0 * p.kappa)


def edge(kit: Kit, found: np.ndarray, at: Steep) -> np.ndarray:
    p = at.points
    return rim(kit, found * np.sqrt(0.5 * p.a / p.s), at)


class Region(NamedTuple):
    """What its polynomials are in; and the factor of exp(-x) that they make of sigma(-v), x = kappa v where `along`,
    else w. Without a factor they are half of sigma(v) + sigma(-v) themselves.
    """

    variables: Callable[[Points], tuple[Any, Any]]
    factor: Callable[[Kit, Any, Steep], Any] | None = None
    along: bool = False

    def steep(self, kit: Kit, p: Points) -> Steep:
        x = p.kappa * p.v if self.along else least_exponent(p)
        return Steep(p, x, steep_cosine(kit, p, self.along), self.along)


def _at_the_edge(p: Points) -> tuple[np.ndarray, np.ndarray]:
    return 0.5 * p.a / p.s, p.s * p.s


EVEN = Region(lambda p: (p.v * p.v, p.kappa * p.kappa))
ROUND = Region(lambda p: (p.v, p.kappa), round_, along=True)
LAYER = Region(lambda p: (1.0 / (p.s + tables.SHIFT), p.a), layer)
NEAR = Region(lambda p: (p.kappa * p.s, p.a * p.a), rim)
FAR = Region(_at_the_edge, edge)
# EVEN is kappa < PALE, ROUND PALE < kappa < STEEP. Beyond, LAYER is v < LIT, a boundary layer and what the curvature of
# the sphere adds to it; and of v > LIT, NEAR is kappa s < RIM.
REGIONS = (EVEN, ROUND, LAYER, NEAR, FAR)


def round_off(at: Steep) -> np.ndarray:
    """What the exponent x lacks: exp(-x) has the relative error x eps if x is rounded once."""
    v, along = at.points.v, at.along
    d, d_low = two_square(at.points.alpha)
    n: Any = v
    n_low: Any = 0.0
    if along is not True:
        # 2 v^2/(alpha^2 (1 + s)), where s is a pair as well: 1 - v^2 is exact to 106 bits of 1.
        w, w_low = two_square(v)
        c = 1.0 - w
        s = np.sqrt(c)
        square, error = two_square(s)
        s_low = (((c - square) - error) + (((1.0 - c) - w) - w_low)) / np.maximum(2.0 * s, np.finfo(float).tiny)
        one = 1.0 + s
        e, e_low = two_prod(d, one)
        e_low += d * ((s - (one - 1.0)) + s_low) + d_low * one
        if along is False:
            n, n_low, d, d_low = w, w_low, e, e_low
        else:
            n, n_low = np.where(along, n, w), np.where(along, n_low, w_low)
            d, d_low = np.where(along, d, e), np.where(along, d_low, e_low)
    x, low = quotient(2.0 * n, 2.0 * n_low, d, d_low)
    return (x - at.x) + low


def region_of_one(p: Points) -> int:
    """The number of the region of a single point."""
    if p.kappa < PALE:
        return 0
    if p.kappa <= STEEP:
        return 1
    if p.v <= tables.LIT:
        return 2
    return 3 if p.kappa * p.s < RIM else 4


def numbers(v: np.ndarray, s: np.ndarray, a: np.ndarray, kappa: np.ndarray) -> np.ndarray:
    """The number of each point's region."""
    steep = kappa > STEEP
    high = v > tables.LIT
    high &= steep
    far = kappa * s >= RIM
    far &= high
    number = (kappa >= PALE).view(np.uint8)
    for beyond in (steep, high, far):
        number += beyond.view(np.uint8)
    return number


def cells(grid: Grid, v: np.ndarray, s: np.ndarray, a: np.ndarray, kappa: np.ndarray) -> np.ndarray:
    """The number of each point's cell, counted through all regions."""
    cell, own = np.zeros(v.shape, np.uint8), numbers(v, s, a, kappa)
    p = Points(v, a, v, s, a, kappa)
    for i, (region, patches, first) in enumerate(zip(REGIONS, grid.parts, grid.firsts, strict=False)):
        number = patches.cell(*region.variables(p))
        number += np.uint8(first)
        number *= (own == i).view(np.uint8)
        cell += number
    return cell
