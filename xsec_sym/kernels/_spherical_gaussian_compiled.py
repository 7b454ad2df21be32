"""The spherical Gaussian's cross-section as loops for Numba: the mathematics of `_spherical_gaussian_regions`.

Points are sorted by cell, so that a loop over those of one cell has no branch and its coefficients are constant: the
compiler then takes several points at a time. Edges of cells are compiled in, tables are arguments.
"""

import math

import numpy as np

from xsec_sym.kernels import _spherical_gaussian_core as core
from xsec_sym.kernels import _spherical_gaussian_regions as regions
from xsec_sym.kernels import _spherical_gaussian_tables as tables
from xsec_sym.kernels._compiled_polynomials import (
    CHUNK,
    LANES,
    STEP,
    exp,
    horner,
    jit,
    jit_inside,
    kept,
    patch,
    quotient,
    room,
    stamp,
    two_prod,
)

# Points that are sorted together.
BLOCK = 2**15
TINY = float(np.finfo(float).tiny)
SIGMA, LOG, SCALED = range(3)
# Numba's cache notices changes of this file alone.
STAMP = stamp(core, regions, tables)
EVEN, ROUND, LAYER, RIM, EDGE = 0, 3, 19, 29, 31
ODD, FAINT, BARE, BINS = 34, 35, 36, 37

SMALLEST, FAINT_ENDS = regions.PRECISE.smallest, regions.PRECISE.faint
SHRUNK = core.SHRUNK
DARK_ENDS, LIT_ENDS = regions.PRECISE.dark_ends, regions.PRECISE.lit_ends
NEARLY_FACING, LIT_EXPONENT = core.NEARLY_FACING, core.LIT_EXPONENT
PALE_ENDS, STEEP_STARTS, RIM_ENDS = regions.PALE, regions.STEEP, regions.RIM
LIT, SHIFT, HALF = tables.LIT, tables.SHIFT, tables.HALF
EVEN_SCALE = 2.0 / tables.EVEN_Y[-1]
EVEN_1, EVEN_2 = (square**0.5 for square in tables.EVEN_Y[1:-1])
ROUND_V1, ROUND_V2, ROUND_V3 = tables.ROUND_X[1:-1]
ROUND_1, ROUND_2, ROUND_3 = tables.ROUND_Y[1:-1]
LAYER_S = 1.0 / tables.LAYER_X[1] - tables.SHIFT
LAYER_1, LAYER_2, LAYER_3, LAYER_4 = tables.LAYER_Y[1:-1]
RIM_1 = tables.RIM_X[1]
EDGE_1, EDGE_2 = (1.0 / inverse for inverse in tables.EDGE_X[1:-1])


@jit_inside
def _sine(v):
    return math.sqrt((1.0 - v) * (1.0 + v))


@jit_inside
def _steep_cosine(alpha, double):
    """For kappa above PALE_ENDS; double = exp(-2 kappa)."""
    a, a_low = two_prod(alpha, alpha)
    _, kappa_low = quotient(2.0, 0.0, a, a_low)
    beyond = 2.0 * double / (1.0 - double)
    beyond -= kappa_low * beyond * (2.0 + beyond)
    most = 1.0 - 0.5 * a
    return most + (((1.0 - most) - 0.5 * a) - 0.5 * a_low + beyond)


@jit_inside
def _pale_cosine(alpha, first, rest):
    """kappa times the sum of two terms of a series, rounded once."""
    a, a_low = two_prod(alpha, alpha)
    kappa, kappa_low = quotient(2.0, 0.0, a, a_low)
    ratio = first + rest
    mean, low = two_prod(kappa, ratio)
    return mean + (low + kappa * (rest - (ratio - first)) + ratio * kappa_low * (1.0 - 0.1 * kappa * kappa))


@jit_inside
def _exponent(v, s, alpha):
    return 2.0 * (v * v) / (alpha * alpha * (1.0 + s))


@jit_inside
def _round_off_along(v, alpha, rough):
    """What the exponent kappa v lacks."""
    a, a_low = two_prod(alpha, alpha)
    x, low = quotient(2.0 * v, 0.0, a, a_low)
    return (x - rough) + low


@jit_inside
def _round_off(v, alpha, rough):
    """What the exponent w lacks."""
    a, a_low = two_prod(alpha, alpha)
    n, n_low = two_prod(v, v)
    c = 1.0 - n
    s = math.sqrt(c)
    square, error = two_prod(s, s)
    s_low = (((c - square) - error) + (((1.0 - c) - n) - n_low)) / (2.0 * s + TINY)
    one = 1.0 + s
    d, d_low = two_prod(a, one)
    d_low += a * ((s - (one - 1.0)) + s_low) + a_low * one
    w, low = quotient(2.0 * n, 2.0 * n_low, d, d_low)
    return (w - rough) + low


@jit
def _of_pale(form, u, alpha, sigma):
    if form == LOG:
        return math.log(sigma)
    if form == SCALED and u < 0.0:
        return sigma * math.exp(_exponent(u, _sine(-u), alpha))
    return sigma


@jit_inside
def _faint(u, kappa):
    square, k = u * u, kappa * kappa
    even = 0.25 + k * ((square - 1 / 3) / 32 - k * ((square / 2304 + 1 / 384) * square - 11 / 11520))
    return even + u * kappa * ((k / 945 - 1 / 90) * k + 1 / 6)


@jit
def _pale(kit, form, cell, u, alpha, n, work, value):
    x, y, part, _, _ = work
    for i in range(n):
        kappa = 2.0 / (alpha[i] * alpha[i])
        x[i], y[i] = u[i] * u[i], kappa * kappa
    patch(kit, cell, x, y, n, part, value)
    for i in range(n):
        kappa = 2.0 / (alpha[i] * alpha[i])
        x[i] = kappa * kappa * EVEN_SCALE - 1.0
    horner(kit.mean_cosine, 0, len(kit.mean_cosine) // STEP, x, n, part)
    for i in range(n):
        value[i] += 0.5 * u[i] * _pale_cosine(alpha[i], kit.mean_first, x[i] * part[i])
    if form != SIGMA:
        for i in range(n):
            value[i] = _of_pale(form, u[i], alpha[i], value[i])


@jit
def _dark(kit, cell, u, alpha, n, work, factor):
    """sigma(-v) as a factor of exp(-kappa v) in the cells of ROUND, of exp(-w) elsewhere; and exp(-2 kappa)."""
    x, y, part, double, powers = work
    for i in range(n):
        v, a = abs(u[i]), alpha[i] * alpha[i]
        kappa, s = 2.0 / a, _sine(v)
        part[i] = -2.0 * kappa
        if cell < LAYER:
            x[i], y[i] = v, kappa
        elif cell < RIM:
            x[i], y[i] = 1.0 / (s + SHIFT), a
        elif cell < EDGE:
            x[i], y[i] = kappa * s, a * a
        else:
            x[i], y[i] = 0.5 * a / s, s * s
    exp(part, n, powers, double)
    patch(kit, cell, x, y, n, part, factor)
    if cell < LAYER:
        for i in range(n):
            kappa = 2.0 / (alpha[i] * alpha[i])
            factor[i] = factor[i] * kappa / (1.0 - double[i])
    elif cell < RIM:
        for i in range(n):
            v = abs(u[i])
            y[i] = math.sqrt(_exponent(v, _sine(v), alpha[i]))
            x[i] = 2.0 * HALF / (HALF + y[i]) - 1.0
        horner(kit.half_layer, 0, len(kit.half_layer) // STEP, x, n, part)
        for i in range(n):
            a, z = alpha[i] * alpha[i], y[i]
            mean, one = _steep_cosine(alpha[i], double[i]), 1.0 + z
            flat = part[i] / (one * one) * (0.5 * mean * math.sqrt(1.0 + _sine(abs(u[i]))))
            factor[i] = (alpha[i] * math.sqrt(0.5)) * (flat + (0.5 * a) * factor[i])
    else:
        # The half-line's integral q/kappa^2 without what lies beyond t = 1.
        for i in range(n):
            x[i] = -2.0 / (alpha[i] * alpha[i]) * (1.0 + _sine(abs(u[i])))
        exp(x, n, powers, part)
        for i in range(n):
            v, a = abs(u[i]), alpha[i] * alpha[i]
            root = math.sqrt(0.5 * a / _sine(v)) if cell >= EDGE else 1.0
            factor[i] = (0.5 * a * (factor[i] * root) - v * (1.0 + 0.5 * a) * part[i]) / (1.0 - double[i])


@jit
def _steep(kit, along, u, alpha, n, work, value):
    """sigma from the factor of exp(-x)."""
    x, y, part, double, powers = work
    for i in range(n):
        v = abs(u[i])
        y[i] = 2.0 / (alpha[i] * alpha[i]) * v if along else _exponent(v, _sine(v), alpha[i])
        x[i] = -y[i]
    exp(x, n, powers, part)
    if kit.pairs:
        for i in range(n):
            v = abs(u[i])
            x[i] = _round_off_along(v, alpha[i], y[i]) if along else _round_off(v, alpha[i], y[i])
        for i in range(n):
            part[i] -= part[i] * (x[i] if (u[i] < 0.0) | (y[i] < LIT_EXPONENT) else 0.0)
    for i in range(n):
        value[i] = part[i] * value[i] + max(u[i], 0.0) * _steep_cosine(alpha[i], double[i])


@jit
def _scaled_steep(along, u, alpha, n, double, value):
    for i in range(n):
        v, kappa = abs(u[i]), 2.0 / (alpha[i] * alpha[i])
        s = _sine(v)
        if along:
            # kappa v - w = 2 kappa v s/(1 + v + s)
            value[i] *= math.exp(-2.0 * kappa * v * s / (1.0 + v + s))
        if u[i] > 0.0:
            value[i] = value[i] * math.exp(-_exponent(v, s, alpha[i])) + u[i] * _steep_cosine(alpha[i], double[i])


@jit
def _log_steep(along, u, alpha, n, double, value):
    for i in range(n):
        v, kappa = abs(u[i]), 2.0 / (alpha[i] * alpha[i])
        value[i] = math.log(value[i]) - (kappa * v if along else _exponent(v, _sine(v), alpha[i]))
        if u[i] > 0.0:
            behind, less = math.exp(value[i]), 2.0 * double[i] / (1.0 - double[i]) - 1.0 / kappa
            if u[i] > NEARLY_FACING:
                value[i] = math.log(u[i]) + math.log1p(less + behind / u[i])
            else:
                value[i] = math.log((1.0 + less) * u[i] + behind)


@jit
def _cells(form, u, alpha, number):
    """The bin of each point."""
    dark_ends = DARK_ENDS if form == SIGMA else np.inf
    for i in range(len(u)):
        v, a = abs(u[i]), alpha[i] * alpha[i]
        kappa, s = 2.0 / a, _sine(v)
        ks = kappa * s
        even = (kappa > EVEN_1) + (kappa > EVEN_2)
        across = (v > ROUND_V1) + (v > ROUND_V2) + (v > ROUND_V3)
        round_ = ROUND + 4 * ((kappa > ROUND_1) + (kappa > ROUND_2) + (kappa > ROUND_3)) + across
        bent = (a > LAYER_1) + (a > LAYER_2) + (a > LAYER_3) + (a > LAYER_4)
        layer = LAYER + 2 * bent + (s < LAYER_S)
        edge = EDGE + (ks < EDGE_1) + (ks < EDGE_2)
        rim = RIM + (ks > RIM_1)
        high = rim if ks < RIM_ENDS else edge
        steep = layer if v <= LIT else high
        bin_ = round_ if kappa <= STEEP_STARTS else steep
        bin_ = even if kappa < PALE_ENDS else bin_
        bin_ = BARE if kappa * (v * v) > (LIT_ENDS if u[i] > 0.0 else dark_ends) * (1.0 + s) else bin_
        bin_ = FAINT if kappa < FAINT_ENDS else bin_
        number[i] = bin_ if (v <= 1.0) & (alpha[i] >= SMALLEST) else ODD


@jit
def _chunk(kit, form, cell, u, alpha, n, work, value):
    """At points of one bin, which is not ODD."""
    if cell == FAINT:
        for i in range(n):
            value[i] = _of_pale(form, u[i], alpha[i], _faint(u[i], 2.0 / (alpha[i] * alpha[i])))
    elif cell == BARE:
        for i in range(n):
            less = -0.5 * alpha[i] * alpha[i]
            value[i] = math.log(u[i]) + math.log1p(less) if form == LOG else max(u[i], 0.0) * (1.0 + less)
    elif cell < ROUND:
        _pale(kit, form, cell, u, alpha, n, work, value)
    else:
        _dark(kit, cell, u, alpha, n, work, value)
        if form == SIGMA:
            _steep(kit, cell < LAYER, u, alpha, n, work, value)
        elif form == SCALED:
            _scaled_steep(cell < LAYER, u, alpha, n, work[3], value)
        else:
            _log_steep(cell < LAYER, u, alpha, n, work[3], value)


@jit
def _odd(kit, form, u, alpha, n, work, value):
    """Outside the domain; and where alpha^2 underflows, by a power of 2, since sigma is as alpha f(u/alpha) there."""
    away, rough, number = np.empty(1), np.empty(1), np.empty(1, np.uint8)
    for i in range(n):
        value[i] = np.nan
        if abs(u[i]) <= 1.0 and alpha[i] >= 0.0:
            mantissa, power = math.frexp(alpha[i])
            up, v = SHRUNK - power, abs(u[i])
            away[0] = -min(math.ldexp(v, up), 1.0)
            rough[0] = math.ldexp(max(mantissa, 0.5), SHRUNK)
            lit = u[i] > 0.0 or alpha[i] == 0.0
            inner = SIGMA if lit else form
            _cells(inner, away, rough, number)
            _chunk(kit, inner, number[0], away, rough, 1, work, value[i : i + 1])
            if lit:
                sigma = max(u[i], 0.0) + (math.ldexp(value[i], -up) if alpha[i] > 0.0 else 0.0)
                value[i] = math.log(sigma) if form == LOG else sigma
                if form == LOG and away[0] == -1.0:
                    value[i] = math.log(u[i]) + math.log1p(-0.5 * alpha[i] * alpha[i])
            elif away[0] == -1.0:
                if form == LOG:
                    value[i] = -2.0 * (v / alpha[i]) ** 2 / (1.0 + _sine(v))
                else:
                    value[i] = 0.5 * alpha[i] * alpha[i] if form == SCALED and v == 1.0 else 0.0
            else:
                value[i] = value[i] - math.log(2.0) * up if form == LOG else math.ldexp(value[i], -up)


@jit
def _at_once(u, alpha, number, value):
    """sigma where it is FAINT or BARE, and anything elsewhere: not worth sorting."""
    for i in range(len(u)):
        kappa = 2.0 / (alpha[i] * alpha[i])
        bare = max(u[i], 0.0) * (1.0 - 1.0 / kappa)
        value[i] = _faint(u[i], kappa) if number[i] == FAINT else bare


@jit
def _sorted(number, least, counts, left, order):
    """The places of the points of each bin below `least`, and where each bin ends."""
    size = 0
    for i in range(len(number)):
        left[size] = i
        size += number[i] < least
    counts[:] = 0
    for i in range(size):
        counts[number[left[i]] + 1] += 1
    for i in range(BINS):
        counts[i + 1] += counts[i]
    for i in range(size):
        order[counts[number[left[i]]]] = left[i]
        counts[number[left[i]]] += 1


@kept
def fill(kit, form, u, alpha, value):
    """`value` at the points u, alpha, in the form that is asked for; and the stamp of what it was compiled from."""
    most = min(BLOCK, len(u))
    number, counts = np.empty(most, np.uint8), np.empty(BINS + 1, np.int64)
    left, order = np.empty(most + 1, np.int64), np.empty(most, np.int64)
    at, rough, found, work = np.empty(CHUNK), np.empty(CHUNK), np.empty(CHUNK), room()
    for start in range(0, len(u), BLOCK):
        part = slice(start, min(start + BLOCK, len(u)))
        block, roughness, result = u[part], alpha[part], value[part]
        _cells(form, block, roughness, number)
        if form == SIGMA:
            _at_once(block, roughness, number, result)
        _sorted(number[: len(block)], FAINT if form == SIGMA else BINS, counts, left, order)
        first = 0
        for cell in range(BINS):
            while first < counts[cell]:
                n = min(CHUNK, counts[cell] - first)
                whole = min(CHUNK, -(-n // LANES) * LANES)
                for i in range(whole):
                    place = order[first + min(i, n - 1)]
                    at[i], rough[i] = block[place], roughness[place]
                if cell == ODD:
                    _odd(kit, form, at, rough, n, work, found)
                else:
                    _chunk(kit, form, cell, at, rough, whole, work, found)
                for i in range(n):
                    result[order[first + i]] = found[i]
                first += n
    return STAMP
