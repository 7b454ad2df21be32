"""From the regions to the cross-section of the spherical Gaussian, its logarithm and its scaled form."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from xsec_sym.kernels import _spherical_gaussian_regions as regions
from xsec_sym.kernels import _spherical_gaussian_tables as tables
from xsec_sym.kernels._spherical_gaussian_regions import Kit, Points, Region, Steep
from xsec_sym.kernels._spherical_gaussian_sorting import Joint, Left
from xsec_sym.kernels._support import scalar

# Up to here on kappa EVEN has a single cell.
DIM = tables.EVEN_Y[1] ** 0.5
# Points that are sorted by cell together; and the memory of an array of those looked at at once before that.
WHOLE, PART = 2**20, 2**19
# The power of 2 that roughnesses below the smallest are brought to.
SHRUNK = -300
# Up to here another call costs more than sorting.
FEW = 2048
# Below it the exponent needs no second part; nor from there on where what falls so is added to the odd part.
SMALL_EXPONENT, LIT_EXPONENT = 1.0, 3.0
# From this cosine on the logarithm is formed without 1 - (1 - x).
NEARLY_FACING = 0.5


class Form(NamedTuple):
    """What is made of the parts of sigma: of its even and odd one for kappa < PALE; beyond its layer; and within, from
    the factor of exp(-x). Then of sigma; of its form for u < 0 at arguments larger by a power of 2, where sigma is as
    alpha f(u/alpha); and for v = -u much larger than alpha.
    """

    pale: Callable[[Any, Any, Any, Any], Any]
    bare: Callable[[np.ndarray, np.ndarray], np.ndarray]
    steep: Callable[[np.ndarray, Steep, bool], np.ndarray]
    of: Callable[[np.ndarray], np.ndarray]
    shrunk: Callable[[np.ndarray, np.ndarray], np.ndarray]
    far: Callable[[np.ndarray, np.ndarray], np.ndarray]
    underflows: bool


def evaluate(kit: Kit, form: Form, u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """`form` at vectors of cosines and of roughnesses of the kit's type; NaN outside their domain."""
    if u.size == 1:
        return _alone(kit, form, u, alpha)
    left, size = Left(kit.grid, u, alpha), PART // u.itemsize
    if u.size <= size:
        value = np.full_like(u, np.nan)
        left.add(0, *_simple(kit, form, u, alpha, value))
        return _with_left(kit, form, left, value)
    value = np.empty_like(u)
    for start in range(0, u.size, size):
        part = slice(start, start + size)
        # Small enough for the cache, unlike `value`.
        near = np.full_like(u[part], np.nan)
        left.add(start, *_simple(kit, form, u[part], alpha[part], near))
        value[part] = near
    return _with_left(kit, form, left, value)


def _with_left(kit: Kit, form: Form, left: Left, value: np.ndarray) -> np.ndarray:
    if left.few:
        for joint in left.joint():
            _few(kit, form, joint, value)
    else:
        for group in left.groups():
            value[group.places] = _made(kit, form, group.region, group.points, group.found)
    return value


def _few(kit: Kit, form: Form, joint: Joint, value: np.ndarray) -> None:
    """The same operations, with as few calls as there may be."""
    pale, *steep = joint.inside
    known = regions.inverse(joint.points.alpha) if kit.pairs else None
    p = joint.points.at(pale)
    if p.u.size:
        odd = 0.5 * p.u * regions.pale_cosine(kit, p.alpha, known and known.at(pale))
        value[joint.places[pale]] = form.pale(p.u, p.kappa, regions.even(kit, joint.found[pale], p.u), odd)
    rest = slice(pale.stop, steep[-1].stop)
    p = joint.points.at(rest)
    if p.u.size:
        x, along = regions.least_exponent(p), np.zeros(p.u.size, bool)
        first = slice(0, steep[0].stop - rest.start)
        x[first], along[first] = p.kappa[first] * p.v[first], True
        at, factor = Steep(p, x, regions.steep_cosine(kit, p, along, known and known.at(rest)), along), np.empty_like(x)
        for region, inside in zip(regions.REGIONS[1:], steep, strict=True):
            if inside.start < inside.stop:
                own = slice(inside.start - rest.start, inside.stop - rest.start)
                assert region.factor is not None
                factor[own] = region.factor(kit, joint.found[inside], at.at(own))
        value[joint.places[rest]] = form.steep(factor, at, kit.pairs)


def _made(kit: Kit, form: Form, region: Region, p: Points, found: np.ndarray) -> np.ndarray:
    if region.factor:
        at = region.steep(kit, p)
        return form.steep(region.factor(kit, found, at), at, kit.pairs)
    return form.pale(p.u, p.kappa, regions.even(kit, found, p.u), 0.5 * p.u * regions.pale_cosine(kit, p.alpha))


def _alone(kit: Kit, form: Form, u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """A single point, with as few calls as there may be; the same operations as in company."""
    value = np.full_like(u, np.nan)
    v, rough = abs(scalar(u)), scalar(alpha)
    if v <= 1.0 and kit.smallest <= rough < 1e18:
        a = rough * rough
        s = type(v)(math.sqrt((1.0 - v) * (1.0 + v)))
        one = Points(scalar(u), rough, v, s, a, 2.0 / a)
        if one.kappa >= (DIM if kit.dtype is np.float32 else kit.faint):
            w = one.kappa * (v * v) / (1.0 + s)
            if w > (kit.lit_ends if one.u > 0.0 else _dark_ends(kit, form)):
                return form.bare(u, np.full_like(u, one.kappa))
            i = regions.region_of_one(one)
            region, (x, y) = regions.REGIONS[i], regions.REGIONS[i].variables(one)
            cell = kit.grid.parts[i].cell_of_one(x, y)
            if kit.dtype is np.float32:
                p = regions.points(u, alpha)
                return _made(kit, form, region, p, kit.grid(*region.variables(p), kit.grid.firsts[i] + cell))
            return _made_of_numbers(kit, form, region, one, kit.grid.parts[i].one(x, y, cell), u, alpha)
    _simple(kit, form, u, alpha, value)
    return value


def _made_of_numbers(
    kit: Kit, form: Form, region: Region, one: Points, found: float, u: np.ndarray, alpha: np.ndarray
) -> np.ndarray:
    """Python's numbers are much faster than arrays of one."""
    if not region.factor:
        return np.full_like(u, form.pale(one.u, one.kappa, found, 0.5 * one.u * regions.pale_cosine(kit, one.alpha)))
    at = region.steep(kit, one)
    factor = region.factor(kit, found, at)
    if form is SIGMA:
        return np.full_like(u, _sigma_steep(factor, at, kit.pairs))
    x, mean = np.full_like(u, at.x), np.full_like(u, at.mean)
    return form.steep(np.full_like(u, factor), Steep(regions.points(u, alpha), x, mean, at.along), kit.pairs)


def _dark_ends(kit: Kit, form: Form) -> float:
    return kit.dark_ends if form.underflows else np.inf


def _simple(kit: Kit, form: Form, u: np.ndarray, alpha: np.ndarray, value: np.ndarray) -> tuple[np.ndarray, Points]:
    """Fill in what is done at once; the places that are left, among all points."""
    p = regions.points(u, alpha, kit.dtype)
    known = (p.v <= 1.0) & (alpha >= 0.0)
    tiny = alpha < kit.smallest
    tiny &= known
    chosen = tiny.nonzero()[0]
    if chosen.size:
        value[chosen] = _tiny(kit, form, u[chosen], alpha[chosen])
        known ^= tiny
    w = p.kappa * (p.v * p.v) / (1.0 + p.s)
    bare = w > kit.lit_ends
    bare &= u > 0.0
    bare |= w > _dark_ends(kit, form)
    bare &= known
    chosen = bare.nonzero()[0]
    if chosen.size:
        value[chosen] = form.bare(u[chosen], p.kappa[chosen])
    faint = p.kappa < kit.faint
    faint &= known
    chosen = faint.nonzero()[0]
    if chosen.size:
        at, k = u[chosen], p.kappa[chosen]
        value[chosen] = form.pale(at, k, *_faint(at, k))
    known ^= bare
    known ^= faint
    if u.size > FEW or kit.dtype is np.float32:
        # Not worth sorting; and in float32 what is sorted is of more digits.
        dim = p.kappa < DIM
        dim &= known
        chosen = dim.nonzero()[0]
        at, k = u[chosen], p.kappa[chosen]
        even = regions.even(kit, kit.grid(at * at, k * k, 0), at)
        value[chosen] = form.pale(at, k, even, 0.5 * at * regions.pale_cosine(kit, alpha[chosen]))
        known ^= dim
    return known.nonzero()[0], p


def _faint(u: np.ndarray, kappa: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The even and the odd part of sigma as series in kappa; the next terms are 2e-4 kappa^6 and u kappa^7/9450."""
    square, k = u * u, kappa * kappa
    even = 0.25 + k * ((square - 1 / 3) / 32 - k * ((square / 2304 + 1 / 384) * square - 11 / 11520))
    return even, u * kappa * ((k / 945 - 1 / 90) * k + 1 / 6)


def _tiny(kit: Kit, form: Form, u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """Of u and alpha scaled up by a power of 2, on the side turned away; the odd part is u."""
    if kit.dtype is np.float32:
        return evaluate(regions.FAST, form, u.astype(np.float64), alpha.astype(np.float64))
    mantissa, power = np.frexp(alpha)
    up, v = SHRUNK - power, np.abs(u)
    away, rough = -np.minimum(np.ldexp(v, up), 1.0), np.ldexp(np.maximum(mantissa, 0.5), SHRUNK)
    sigma = np.ldexp(evaluate(kit, SIGMA, away, rough), -up) * (alpha > 0.0) + np.maximum(u, 0.0)
    near = away > -1.0
    dark = np.where(near, form.shrunk(evaluate(kit, form, away, rough), up), form.far(v, alpha))
    lit = np.where(near, form.of(sigma), form.bare(u, 2.0 / (alpha * alpha)))
    return np.where((u > 0.0) | (alpha == 0.0), lit, dark)


def _sigma_steep(factor: Any, at: Steep, pairs: bool) -> Any:
    fall = np.exp(-at.x)
    if pairs:
        due = (at.x > SMALL_EXPONENT) & ((at.points.u < 0.0) | (at.x < LIT_EXPONENT))
        if not isinstance(fall, np.ndarray):
            fall -= fall * regions.round_off(at) if due else 0.0
        elif due.any():
            deep = due.nonzero()[0]
            fall[deep] -= fall[deep] * regions.round_off(at.at(deep))
    return fall * factor + np.maximum(at.points.u, 0.0) * at.mean


def _bare(u: np.ndarray, kappa: np.ndarray) -> np.ndarray:
    # coth kappa is 1 where sigma is bare: kappa > w, which is large.
    return np.maximum(u, 0.0) * (1.0 - 1.0 / kappa)


SIGMA = Form(
    pale=lambda u, kappa, even, odd: even + odd,
    bare=_bare,
    steep=_sigma_steep,
    of=lambda sigma: sigma,
    shrunk=lambda dark, up: np.ldexp(dark, -up),
    far=lambda v, alpha: np.zeros_like(v),
    underflows=True,
)


def _scaled_steep(factor: np.ndarray, at: Steep, pairs: bool) -> np.ndarray:
    value, p = factor, at.points
    if np.any(at.along):
        # kappa v - w = 2 kappa v s/(1 + v + s)
        value = value * np.exp(-2.0 * np.where(at.along, at.x, 0.0) * p.s / (1.0 + p.v + p.s))
    lit = (p.u > 0.0).nonzero()[0]
    value[lit] *= np.exp(-regions.least_exponent(p.at(lit)))
    value[lit] += p.u[lit] * at.mean[lit]
    return value


def _scaled_pale(u: np.ndarray, kappa: np.ndarray, even: np.ndarray, odd: np.ndarray) -> np.ndarray:
    v = np.maximum(-u, 0.0)
    return (even + odd) * np.exp(kappa * (v * v) / (1.0 + regions.sine(v)))


SCALED = Form(
    pale=_scaled_pale,
    bare=_bare,
    steep=_scaled_steep,
    of=SIGMA.of,
    shrunk=SIGMA.shrunk,
    # Of the order of alpha^3, unless s is 0.
    far=lambda v, alpha: np.where(v == 1.0, 0.5 * alpha * alpha, 0.0),
    underflows=False,
)


def _log_bare(u: np.ndarray, kappa: np.ndarray) -> np.ndarray:
    return np.log(u) + np.log1p(-1.0 / kappa)


def _log_steep(factor: np.ndarray, at: Steep, pairs: bool) -> np.ndarray:
    value = np.log(factor) - at.x
    lit = (at.points.u > 0.0).nonzero()[0]
    u, kappa = at.points.u[lit], at.points.kappa[lit]
    behind = np.exp(value[lit])
    less = 2.0 / np.expm1(2.0 * kappa) - 1.0 / kappa
    facing = np.log(u) + np.log1p(less + behind / u)
    value[lit] = np.where(u > NEARLY_FACING, facing, np.log((1.0 + less) * u + behind))
    return value


LOG = Form(
    pale=lambda u, kappa, even, odd: np.log(even + odd),
    bare=_log_bare,
    steep=_log_steep,
    of=np.log,
    shrunk=lambda dark, up: dark - math.log(2.0) * up,
    far=lambda v, alpha: -2.0 * (v / alpha) ** 2 / (1.0 + regions.sine(v)),
    underflows=False,
)
