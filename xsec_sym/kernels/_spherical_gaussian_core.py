"""From the regions to the cross-section of the spherical Gaussian, its logarithm and its scaled form."""

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from xsec_sym.kernels import _spherical_gaussian_regions as regions
from xsec_sym.kernels import _spherical_gaussian_tables as tables
from xsec_sym.kernels._spherical_gaussian_regions import Dark, Kit

# Below it sigma(u, alpha) = alpha f(u/alpha) to all digits, since corrections are of the order of alpha^2.
SMALLEST = 1e-140
# exp(-w) sqrt(kappa) is nothing beside c v from the first on for kappa < MODEST, from the second on for all.
LIT_ENDS, LIT_ENDS_EVER, MODEST = 42.0, 400.0, 1e8
# exp(-w) is 0 from here on.
DARK_ENDS = 746.0
# Up to here on kappa a Taylor series of three terms has all digits; up to there EVEN has a single cell.
FAINT, DIM = 0.006, tables.EVEN_Y[1] ** 0.5
# Points that are sorted by cell together; those looked at at once before that, and those of one cell.
WHOLE, PART, CHUNK = 2**19, 16384, 8192
# From so many on they are sorted, while fewer gather the coefficients of their cells.
MANY = 8192
# Below it the exponent needs no second part.
SMALL_EXPONENT = 1.0
# From this cosine on the logarithm is formed without 1 - (1 - x).
NEARLY_FACING = 0.5


class Form(NamedTuple):
    """What is made of the parts of sigma: for kappa < PALE, beyond its layer, and within; of sigma, and of its form
    for u < 0 at arguments larger by a power of 2, where sigma is as alpha f(u/alpha).
    """

    pale: Callable[[np.ndarray, np.ndarray, np.ndarray, np.ndarray], np.ndarray]
    bare: Callable[[Kit, np.ndarray, np.ndarray], np.ndarray]
    steep: Callable[[Kit, np.ndarray, np.ndarray, Dark], np.ndarray]
    of: Callable[[np.ndarray], np.ndarray]
    shrunk: Callable[[np.ndarray, np.ndarray], np.ndarray]
    dark_ends: float


def evaluate(kit: Kit, form: Form, u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """`form` at vectors of cosines and of roughnesses; NaN outside their domain."""
    if u.size == 1:
        return _alone(kit, form, u, alpha)
    value = np.full_like(u, np.nan)
    left = []
    for start in range(0, u.size, PART):
        part = slice(start, start + PART)
        rest = _simple(kit, form, u[part], alpha[part], value[part])
        if rest:
            left.append((rest[0] + start, rest[1]))
    if left:
        places, cells = left[0] if len(left) == 1 else (np.concatenate(part) for part in zip(*left, strict=True))
        waiting = []
        for region, chosen, cell in grouped(kit, places, cells):
            at, rough = u[chosen], alpha[chosen]
            found = region(kit, np.abs(at), rough, cell)
            if isinstance(found, Dark) and not found.along and places.size < MANY:
                waiting.append((chosen, found))
            else:
                value[chosen] = _made(kit, form, at, rough, found)
        if waiting:
            # Few points cost by the call.
            chosen = np.concatenate([chosen for chosen, _ in waiting])
            factor, x, s = (np.concatenate(part) for part in zip(*(found[:3] for _, found in waiting), strict=True))
            value[chosen] = form.steep(kit, u[chosen], alpha[chosen], Dark(factor, x, s))
    return value


def _made(kit: Kit, form: Form, u: np.ndarray, alpha: np.ndarray, found: Dark | np.ndarray) -> np.ndarray:
    if isinstance(found, Dark):
        return form.steep(kit, u, alpha, found)
    return form.pale(u, 2.0 / (alpha * alpha), found, 0.5 * u * regions.pale_cosine(kit, alpha))


def _alone(kit: Kit, form: Form, u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """A single point, with as few calls as there may be; the same operations as in company."""
    v, rough = abs(u.item()), alpha.item()
    value = np.full_like(u, np.nan)
    if not (v <= 1.0 and rough >= SMALLEST):
        _simple(kit, form, u, alpha, value)
        return value
    kappa = 2.0 / (rough * rough) if rough < 1e150 else 0.0
    if kappa < DIM:
        _simple(kit, form, u, alpha, value)
        return value
    s = math.sqrt((1.0 - v) * (1.0 + v))
    ends = (LIT_ENDS if kappa < MODEST else LIT_ENDS_EVER) if u.item() > 0.0 else form.dark_ends
    if kappa * (v * v) / (1.0 + s) > ends:
        return form.bare(kit, u, 2.0 / (alpha * alpha))
    region, cell = regions.place(kit, v, s, rough * rough, kappa)
    return _made(kit, form, u, alpha, region(kit, np.abs(u), alpha, cell))


def _simple(
    kit: Kit, form: Form, u: np.ndarray, alpha: np.ndarray, value: np.ndarray
) -> tuple[np.ndarray, np.ndarray] | None:
    """Fill in what is done at once; the places that are left, and the numbers of their cells."""
    v = np.abs(u)
    known = (v <= 1.0) & (alpha >= 0.0)
    tiny = alpha < SMALLEST
    tiny &= known
    chosen = tiny.nonzero()[0]
    if chosen.size:
        value[chosen] = _tiny(kit, form, u[chosen], alpha[chosen])
        known ^= tiny
    a = alpha * alpha
    kappa, s = 2.0 / a, regions.sine(v)
    w = kappa * (v * v) / (1.0 + s)
    gone = w > LIT_ENDS
    gone &= u > 0.0
    gone &= (kappa < MODEST) | (w > LIT_ENDS_EVER)
    gone |= w > form.dark_ends
    gone &= known
    chosen = gone.nonzero()[0]
    if chosen.size:
        value[chosen] = form.bare(kit, u[chosen], kappa[chosen])
    dim = kappa < DIM
    dim &= known
    faint = kappa < FAINT
    faint &= known
    chosen = faint.nonzero()[0]
    if chosen.size:
        at, k = u[chosen], kappa[chosen]
        value[chosen] = form.pale(at, k, *_faint(at, k))
    chosen = (dim ^ faint).nonzero()[0]
    if chosen.size:
        at, k = u[chosen], kappa[chosen]
        value[chosen] = form.pale(at, k, kit.even(at * at, k * k, 0), 0.5 * at * regions.mean_cosine(kit, k, pale=True))
    known ^= dim
    known ^= gone
    chosen = known.nonzero()[0]
    if not chosen.size:
        return None
    return chosen, regions.cells(kit, v[chosen], s[chosen], a[chosen], kappa[chosen])


def _faint(u: np.ndarray, kappa: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The even and the odd part of sigma as series in kappa; the next terms are 2e-4 kappa^6 and u kappa^7/9450."""
    square, k = u * u, kappa * kappa
    even = 0.25 + k * ((square - 1 / 3) / 32 - k * ((square / 2304 + 1 / 384) * square - 11 / 11520))
    return even, u * kappa * ((k / 945 - 1 / 90) * k + 1 / 6)


def _tiny(kit: Kit, form: Form, u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """Of u and alpha scaled up by a power of 2, on the side turned away; the odd part is u."""
    mantissa, power = np.frexp(alpha)
    up = -400 - power
    away, rough = -np.minimum(np.ldexp(np.abs(u), up), 1.0), np.ldexp(np.maximum(mantissa, 0.5), -400)
    sigma = np.ldexp(evaluate(kit, SIGMA, away, rough), -up) * (alpha > 0.0) + np.maximum(u, 0.0)
    return np.where((u > 0.0) | (alpha == 0.0), form.of(sigma), form.shrunk(evaluate(kit, form, away, rough), up))


def grouped(
    kit: Kit, places: np.ndarray, cells: np.ndarray
) -> Iterator[tuple[regions.Region, np.ndarray, int | np.ndarray]]:
    """The places region by region, with their cells; and cell by cell where they are many."""
    order = np.argsort(cells, kind="stable")
    places = places[order]
    counts = [len(patches) for patches in (kit.even, kit.round, kit.layer, kit.rim, kit.edge)]
    ends = [0, *np.cumsum(np.bincount(cells, minlength=sum(counts))).tolist()]
    first = 0
    for region, count in zip(regions.REGIONS, counts, strict=True):
        if places.size < MANY:
            inside = slice(ends[first], ends[first + count])
            if inside.start < inside.stop:
                yield region, places[inside], cells[order[inside]].astype(np.intp) - first
        else:
            for cell in range(count):
                end = ends[first + cell + 1]
                for start in range(ends[first + cell], end, CHUNK):
                    yield region, places[start : min(start + CHUNK, end)], cell
        first += count


def _sigma_steep(kit: Kit, u: np.ndarray, alpha: np.ndarray, dark: Dark) -> np.ndarray:
    fall = np.exp(-dark.x)
    if kit.pairs:
        deep = ((u < 0.0) & (dark.x > SMALL_EXPONENT)).nonzero()[0]
        if deep.size:
            fall[deep] -= fall[deep] * regions.round_off(-u[deep], alpha[deep], dark.x[deep], dark.along)
    return fall * dark.factor + np.maximum(u, 0.0) * regions.mean_cosine(kit, 2.0 / (alpha * alpha))


def _sigma_bare(kit: Kit, u: np.ndarray, kappa: np.ndarray) -> np.ndarray:
    # coth kappa is 1 where sigma is bare: kappa > w > LIT_ENDS.
    return np.maximum(u, 0.0) * (1.0 - 1.0 / kappa)


SIGMA = Form(
    pale=lambda u, kappa, even, odd: even + odd,
    bare=_sigma_bare,
    steep=_sigma_steep,
    of=lambda sigma: sigma,
    shrunk=lambda dark, up: np.ldexp(dark, -up),
    dark_ends=DARK_ENDS,
)


def _scaled_steep(kit: Kit, u: np.ndarray, alpha: np.ndarray, dark: Dark) -> np.ndarray:
    value = dark.factor
    if dark.along:
        # kappa v - w = 2 kappa v s/(1 + v + s)
        v = np.abs(u)
        value = value * np.exp(-2.0 * dark.x * dark.s / (1.0 + v + dark.s))
    lit = (u > 0.0).nonzero()[0]
    at = u[lit]
    value[lit] *= np.exp(-regions.least_exponent(at, dark.s[lit], alpha[lit]))
    value[lit] += at * regions.mean_cosine(kit, 2.0 / (alpha[lit] * alpha[lit]))
    return value


def _scaled_pale(u: np.ndarray, kappa: np.ndarray, even: np.ndarray, odd: np.ndarray) -> np.ndarray:
    v = np.maximum(-u, 0.0)
    return (even + odd) * np.exp(kappa * (v * v) / (1.0 + regions.sine(v)))


SCALED = Form(
    pale=_scaled_pale,
    bare=_sigma_bare,
    steep=_scaled_steep,
    of=SIGMA.of,
    shrunk=SIGMA.shrunk,
    dark_ends=np.inf,
)


def _log_bare(kit: Kit, u: np.ndarray, kappa: np.ndarray) -> np.ndarray:
    return np.log(u) + np.log1p(-1.0 / kappa)


def _log_steep(kit: Kit, u: np.ndarray, alpha: np.ndarray, dark: Dark) -> np.ndarray:
    value = np.log(dark.factor) - dark.x
    lit = (u > 0.0).nonzero()[0]
    at, kappa = u[lit], 2.0 / (alpha[lit] * alpha[lit])
    behind = np.exp(value[lit])
    less = 2.0 / np.expm1(2.0 * kappa) - 1.0 / kappa
    facing = np.log(at) + np.log1p(less + behind / at)
    value[lit] = np.where(at > NEARLY_FACING, facing, np.log((1.0 + less) * at + behind))
    return value


LOG = Form(
    pale=lambda u, kappa, even, odd: np.log(even + odd),
    bare=_log_bare,
    steep=_log_steep,
    of=np.log,
    shrunk=lambda dark, up: dark - np.log(2.0) * up,
    dark_ends=np.inf,
)
