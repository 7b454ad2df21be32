"""Exponents as unevaluated sums of two doubles: exp(-x) has the relative error x eps if x is rounded once."""

import numpy as np

from xsec_sym.kernels._support import quick_two_sum, two_prod, two_square

Pair = tuple[np.ndarray, np.ndarray]

# From this exponent on its rounding error costs more than half an ulp.
STEEP = 0.5
# exp(-x) is a normal number up to here.
SHIFT = 700.0
# exp(-x) y is 0 from here on for any factor y of this project, x^2 alpha^2 included.
GONE = 3000.0


def complement(u: np.ndarray) -> Pair:
    """1 - u^2 for |u| <= 1, to about 106 bits of 1: relatively accurate as far as |u| < 1 - eps/2."""
    square, error = two_square(u)
    high, low = quick_two_sum(1.0, -square)
    return quick_two_sum(high, low - error)


def square(high: np.ndarray, low: np.ndarray) -> Pair:
    """The square of a pair."""
    total, error = two_square(high)
    return total, error + 2.0 * high * low


def quotient(n: np.ndarray | float, n_low: np.ndarray | float, d: np.ndarray, d_low: np.ndarray | float) -> Pair:
    """(n + n_low)/(d + d_low), to a relative error of a few eps^2."""
    high = n / d
    product, error = two_prod(high, d)
    return high, (((n - product) - error) + n_low - high * d_low) / d


def exp_minus(x: np.ndarray, x_low: np.ndarray | float = 0.0) -> np.ndarray:
    """exp(-x - x_low), where |x_low| is at most an ulp of x."""
    value = np.exp(-x)
    return value - value * x_low


def exp_minus_times(x: np.ndarray, x_low: np.ndarray | float, factor: np.ndarray) -> np.ndarray:
    """exp(-x - x_low) times a large factor, which is applied before the exponential underflows.

    x - SHIFT is exact where it is taken, as SHIFT is a multiple of an ulp of x there.
    """
    shift = np.where(x > SHIFT, SHIFT, 0.0)
    return exp_minus(x - shift, x_low) * factor * np.exp(-shift)
