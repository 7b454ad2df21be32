"""What exported modules carry with them where neither NumPy nor SciPy has a function that keeps its digits."""

import numpy as np
import scipy.special

from xsec_sym.kernels.beckmann import scaled_ierfc

# Past this slope exp(-a^2) is 0.
LAST_SLOPE = 28.0
# Below 2 the continued fraction of I_3/2 / I_1/2 has converged by this denominator; above, nothing cancels.
LAST_ODD = 29
# Up to here three terms of the series of I_2 are enough, and from there on its recurrence loses nothing.
SMALL, LARGE = 1e-2, 1e4


def langevin(z: np.ndarray) -> np.ndarray:
    """coth z - 1/z for real z, by its continued fraction where the two terms cancel.

    >>> langevin(np.array([0.0, 1e-9, 1.0, np.inf]))
    array([0.00000000e+00, 3.33333333e-10, 3.13035285e-01, 1.00000000e+00])
    """
    small = np.clip(z, -2.0, 2.0)
    square = small * small
    below = np.full_like(small, LAST_ODD)
    for odd in range(LAST_ODD - 2, 1, -2):
        below = odd + square / below
    large = np.where(np.abs(z) < 2.0, 2.0, z)
    return np.where(np.abs(z) < 2.0, small / below, 1.0 / np.tanh(large) - 1.0 / large)


def i2e(z: np.ndarray) -> np.ndarray:
    """exp(-z) I_2(z) for z >= 0; SciPy's own answers NaN from about 10^9 on, and has fewer digits for small z.

    >>> i2e(np.array([0.0, 1.0, 1e20]))
    array([0.00000000e+00, 4.99387769e-02, 3.98942280e-11])
    """
    small, large = np.minimum(z, SMALL), np.maximum(z, LARGE)
    square = small * small
    series = 0.125 * square * np.exp(-small) * (1.0 + square / 12.0 * (1.0 + square / 32.0))
    recurrence = scipy.special.i0e(large) - 2.0 * scipy.special.i1e(large) / large
    beyond = np.where(z < LARGE, scipy.special.ive(2, np.clip(z, SMALL, LARGE)), recurrence)
    return np.where(z < SMALL, series, beyond)


def ierfc(a: np.ndarray) -> np.ndarray:
    """exp(-a^2)/sqrt(pi) - a erfc a for a >= 0.

    >>> ierfc(np.array([0.0, 1.0, 10.0]))
    array([5.64189584e-01, 5.02545417e-02, 1.03405319e-46])
    """
    near = np.minimum(a, LAST_SLOPE)
    return np.exp(-near * near) * scaled_ierfc(near)
