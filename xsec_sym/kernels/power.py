"""Cross-sections of the powers of the cosine: the monomial basis of any polynomial NDF."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from xsec_sym.kernels._support import elementwise

MAX_POWER = 200
# With 128 cells of |u| the Taylor series about a cell's centre needs 13 terms, even for u^200.
CELLS = 128
TERMS = 13
# Fixed-point bits of the table's making: the recurrence below loses at most log2(128) of them a term.
BITS = 192


@cache
def even_power_table(n: int) -> np.ndarray:
    """Taylor coefficients of sigma(u)/pi for D = x^(2n) about the centre of each cell, as rows by rising order.

    With y = 1 - u^2, c_j = binom(2j, j)/4^j and A_n = pi c_n/(n + 1), the sum
    A_n y^n + 2 pi/(2n + 2) u^2 (c_0 + c_1 y + ... + c_{n-1} y^(n-1))
    telescopes to pi/(n + 1) S, S = 1 - c_1 y - c_2 y^2/3 - ... - c_n y^n/(2n - 1): the binomial series of
    |u| = sqrt(1 - y), cut after y^n. Its first derivative obeys u S' = S - c_n y^n, its second is 2n c_n y^(n-1).

    Integers stand for multiples of 2^-BITS, so that every coefficient is rounded to double once.
    """
    one = 1 << BITS
    cut_root = [math.comb(2 * j, j) * one // ((2 * j - 1) << (2 * j)) for j in range(1, n + 1)]
    c_n = math.comb(2 * n, n) * one >> 2 * n
    table = np.empty((TERMS, CELLS))
    for cell in range(CELLS):
        u = (2 * cell + 1) * one // (2 * CELLS)
        y = one - (u * u >> BITS)
        S = 0
        for coefficient in reversed(cut_root):
            S = (S + coefficient) * y >> BITS
        S = one - S
        slope = (S - (c_n * y**n >> BITS * n)) * one // u
        # y f' = -2 (n - 1) u f for f = S'' gives its Taylor coefficients f_m.
        f_before, f = 0, 2 * n * c_n * y ** max(n - 1, 0) >> BITS * max(n - 1, 0)
        series = [S, slope]
        for m in range(TERMS - 2):
            series.append(f // ((m + 1) * (m + 2)))
            f_after = 2 * (m + 1 - n) * (u * f >> BITS) + (m + 1 - 2 * n) * f_before
            f_before, f = f, f_after * one // ((m + 1) * y)
        table[:, cell] = [coefficient / ((n + 1) * one) for coefficient in series]
    return table


def _even_power(u: np.ndarray, n: int) -> np.ndarray:
    # Summing the powers of y directly would multiply the rounding error of y by up to n, and take n steps.
    u = np.abs(u)
    cell = np.minimum((CELLS * u).astype(np.intp), CELLS - 1)
    h = u - (cell + 0.5) / CELLS
    table = even_power_table(n)
    sigma = table[-1].take(cell)
    for coefficients in table[-2::-1]:
        sigma *= h
        sigma += coefficients.take(cell)
    sigma *= np.pi
    return sigma


def _power(u: np.ndarray, p: np.ndarray) -> np.ndarray:
    known = (np.abs(u) <= 1.0) & (p >= 0.0) & (p <= MAX_POWER) & (p == np.floor(p))
    sigma = np.full_like(u, np.nan)
    for power in np.flatnonzero(np.bincount(p[known].astype(np.intp))).tolist():
        chosen = np.flatnonzero(known & (p == power))
        cosine = u[chosen]
        sigma[chosen] = 2.0 * np.pi / (power + 2) * cosine if power % 2 else _even_power(cosine, power // 2)
    return sigma


def sigma_power(u: np.typing.ArrayLike, p: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """Cross-section of D(x) = x^p, x = cos theta, a density per steradian, seen from the direction of cosine `u`.

    sigma(u) is the integral over x in [-1, 1] of x^p sigma_dirac_ring(u, x). It is linear in D, so the cross-section of
    a polynomial NDF is the same combination of these. Odd p: 2 pi u/(p + 2), negative for u < 0 as D is negative on the
    lower hemisphere.

    u: cosine in [-1, 1]. p: an integer value from 0 to 200. Shapes broadcast; anything else, NaN included, gives NaN.
    float32 for float32 u, where p is float32 or an integer of any kind; float64 otherwise. TypeError for arguments that
    are no real numbers, ValueError for shapes that do not broadcast. The first call with an even p prepares a table
    for it.

    `deon2016:T1.even.s` and `deon2016:T1.odd.s`.

    >>> sigma_power(1, [0, 1, 2])
    array([3.14159265, 2.0943951 , 1.57079633])
    >>> float(sigma_power(0.5, 4) / np.pi)
    0.18489583333333334
    """
    return elementwise(_power, orders=("p",), u=u, p=p)
