"""What written modules are made of: tables of polynomials, and the range that a function keeps to.

All on vectors of float64, as `elementwise` hands them over.
"""

import numpy as np

from xsec_sym.kernels._support import horner, real_array


def polynomial(x: np.ndarray, low: float, scale: float, rows: np.ndarray) -> np.ndarray:
    """The polynomial with coefficients `rows`, highest power first, in (x - low) scale - 1."""
    x = x - low
    x *= scale
    x -= 1.0
    return horner(rows, x)


def piecewise(x: np.ndarray, low: float, scale: float, rows: np.ndarray) -> np.ndarray:
    """Polynomials on equal pieces from `low` on, `scale` of them to the unit; each runs from 0 to 1 in its variable.

    rows: the coefficients, highest power first, a column for each piece and one more for the end.
    """
    x = x - low
    x *= scale
    piece = x.astype(np.intp)
    x -= piece
    first, *rest = rows
    # NaN is no index, and what lies outside is not looked at afterwards.
    total = np.take(first, piece, mode="clip")
    for row in rest:
        total *= x
        total += np.take(row, piece, mode="clip")
    return total


def half_angle(x: np.ndarray) -> np.ndarray:
    """tan(a/2) where x is sin a: x/(1 + sqrt(1 - x^2))."""
    return x / (1.0 + np.sqrt((1.0 - x) * (1.0 + x)))


def within(value: np.ndarray, *limits: tuple[np.ndarray, float, float]) -> np.ndarray:
    """The values where every argument is in its range, (argument, low, high); NaN elsewhere."""
    (x, low, high), *rest = limits
    inside = (x >= low) & (x <= high)
    for x, low, high in rest:
        inside &= x >= low
        inside &= x <= high
    return value if inside.all() else np.where(inside, value, np.nan)


def single(name: str, value: np.typing.ArrayLike) -> np.ndarray:
    """The argument as float32."""
    return real_array(name, value).astype(np.float32)
