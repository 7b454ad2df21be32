"""What compiled kernels share: polynomials on cells, the exponential, and error-free products, for Numba.

Functions of vectors take room for their results, and how many values there are.
"""

import math
import sys
import zlib
from pathlib import Path
from typing import NamedTuple

import numba
import numpy as np

from xsec_sym.kernels import _spherical_gaussian_regions as regions
from xsec_sym.kernels._patches import Patches

# Points of one cell, and what their number is rounded up to, for whole vectors.
CHUNK, LANES = 256, 32
# Coefficients that one pass over the points takes.
STEP = 4
LOWEST, LOG2_E = -800.0, 1.0 / math.log(2.0)
LN2_HIGH, LN2_LOW = float.fromhex("0x1.62e42feep-1"), float.fromhex("0x1.a39ef35793c76p-33")

jit = numba.njit(error_model="numpy", nogil=True)
# What is called at each point; a loop with a call in it takes one point at a time.
jit_inside = numba.njit(error_model="numpy", forceinline=True)


def stamp(*modules):
    """A number that changes with the sources of these modules and of this one."""
    return sum(zlib.crc32(Path(module.__file__).read_bytes()) for module in (*modules, sys.modules[__name__]))


def kept(function):
    """Compiled once and for all, or once a process where no cache can be written."""
    try:
        return numba.njit(error_model="numpy", nogil=True, cache=True)(function)
    except RuntimeError:
        return jit(function)


def renew(function, expected, *arguments):
    """Compile `function`, which returns a stamp, anew if what the cache holds is of other sources."""
    if function(*arguments) != expected:
        function.recompile()


@jit
def room():
    """For the functions of a chunk: x, y, a polynomial's part, exp(-2 kappa), and powers of 2."""
    return np.empty(CHUNK), np.empty(CHUNK), np.empty(CHUNK), np.empty(CHUNK), np.empty((2, CHUNK))


@jit
def horner(row, first, passes, x, n, total):
    """The polynomial whose coefficients start at `first`, highest power first; a pass takes STEP of them."""
    for i in range(n):
        total[i] = row[first]
    a, b, c = row[first + 1], row[first + 2], row[first + 3]
    for i in range(n):
        total[i] = ((total[i] * x[i] + a) * x[i] + b) * x[i] + c
    for k in range(first + STEP, first + STEP * passes, STEP):
        a, b, c, d = row[k], row[k + 1], row[k + 2], row[k + 3]
        for i in range(n):
            total[i] = (((total[i] * x[i] + a) * x[i] + b) * x[i] + c) * x[i] + d


@jit
def patch(kit, cell, x, y, n, part, total):
    """The polynomial of a cell at n points; x and y are changed."""
    middle, centre, scale, height = kit.place[cell, 0], kit.place[cell, 1], kit.place[cell, 2], kit.place[cell, 3]
    for i in range(n):
        x[i] = (x[i] - middle) * scale
        y[i] = (y[i] - centre) * height
        total[i] = 0.0
    row, first = kit.coefficients[cell], 0
    for j in range(kit.passes.shape[1]):
        passes = kit.passes[cell, j]
        if passes:
            horner(row, first, passes, x, n, part)
            first += STEP * passes
            for i in range(n):
                total[i] = total[i] * y[i] + part[i]


@jit
def exp(x, n, powers, value):
    """exp(x) for x <= 0, to an ulp: a polynomial times two powers of 2, as one might underflow too soon."""
    first, second = powers[0].view(np.int64), powers[1].view(np.int64)
    for i in range(n):
        low = max(x[i], LOWEST)
        power = np.int64(low * LOG2_E - 0.5)
        r = (low - power * LN2_HIGH) - power * LN2_LOW
        square = r * r
        fourth = square * square
        a = (1 / 6 + r * (1 / 24)) + square * (1 / 120 + r * (1 / 720))
        b = (1 / 5040 + r * (1 / 40320)) + square * (1 / 362880 + r * (1 / 3628800))
        c = (1 / 39916800 + r * (1 / 479001600)) + square * (1 / 6227020800)
        value[i] = 1.0 + (r + square * (0.5 + r * (a + fourth * (b + fourth * c))))
        half = power >> 1
        first[i], second[i] = (half + 1023) << 52, (power - half + 1023) << 52
    for i in range(n):
        value[i] = (value[i] * powers[1, i]) * powers[0, i]


@jit_inside
def two_prod(a, b):
    product = a * b
    scaled = 134217729.0 * a
    a_high = scaled - (scaled - a)
    scaled = 134217729.0 * b
    b_high = scaled - (scaled - b)
    a_low, b_low = a - a_high, b - b_high
    return product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low


@jit_inside
def quotient(n, n_low, d, d_low):
    high = n / d
    product, error = two_prod(high, d)
    return high, (((n - product) - error) + n_low - high * d_low) / d


class Kit(NamedTuple):
    """The cells of all regions: middles and scales, the passes of each row, and coefficients, highest powers first."""

    place: np.ndarray
    passes: np.ndarray
    coefficients: np.ndarray
    half_layer: np.ndarray
    mean_cosine: np.ndarray
    mean_first: float
    pairs: bool


def compiled_kit(source: regions.Kit) -> Kit:
    patches: list[Patches] = source.grid.parts
    lists = [table for part in patches for table in part.lists]
    most = max(map(len, lists))
    place = np.concatenate([np.column_stack([*part.middles, *part.scales]) for part in patches])
    passes = np.zeros((len(lists), most), np.int64)
    rows = []
    for number, table in enumerate(lists):
        for j, row in enumerate(table):
            passes[number, most - len(table) + j] = -(-len(row) // STEP)
        rows.append(np.concatenate([whole_passes(row) for row in table]))
    longest = max(map(len, rows))
    coefficients = np.array([np.append(row, np.zeros(longest - len(row))) for row in rows])
    return Kit(
        place,
        passes,
        coefficients,
        whole_passes(source.half_layer),
        whole_passes(source.mean_cosine[:-1]),
        source.mean_cosine[-1],
        source.pairs,
    )


def whole_passes(row):
    """With zeros before it, for whole passes."""
    return np.append(np.zeros(-len(row) % STEP), row)
