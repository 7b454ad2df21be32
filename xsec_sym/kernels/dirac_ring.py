"""Cross-section of a Dirac ring: the kernel from which every axisymmetric cross-section is an integral."""

from __future__ import annotations

import numpy as np

from xsec_sym.kernels._support import elementwise, horner, quick_two_sum, two_prod, two_square, two_sum

# (t - atan t)/t^3 = P(z)/Q(z) to a relative 2^-54 for z = t^2 in [0, 3]: the rational interpolant at Chebyshev nodes in
# sqrt(1 + z), the variable in which the branch point z = -1 is farthest. Highest power first; the last pair makes the
# value at 0 the exact 1/3. All coefficients are positive, so nothing cancels.
_ARC_P = (
    3.269098496819665e-08,
    0.00011693960196464007,
    0.005910135526501961,
    0.09148753432875897,
    0.614492566500987,
    2.05055685624166,
    3.5405781663694893,
    3.0164873958392686,
    1.0,
)
_ARC_Q = (
    0.0001287774880036131,
    0.007662878076059373,
    0.1420075494836378,
    1.176691068851735,
    5.056361797013691,
    12.009319575329274,
    15.845697525904923,
    10.849462187517807,
    3.0,
)
# Where t - atan t loses no more than a bit and a half to cancellation (t = sqrt 3, an arc of 120 degrees is lit).
BARELY = 3.0


def discriminant(u: np.ndarray, u_n: np.ndarray) -> np.ndarray:
    """1 - u^2 - u_n^2 to a rounding error of its own size, however much cancels; exact in sign.

    Near 0 every partial sum below is exact but the last, since there the larger argument is at least 1/2 and both
    squares are multiples of 2^-106 up to a rounding error that is summed last.
    """
    larger, smaller = np.maximum(u, u_n), np.minimum(u, u_n)
    square, square_error = two_square(larger)
    small_square, small_square_error = two_square(smaller)
    total, error = quick_two_sum(1.0, -square)
    for term in (-small_square, -square_error, -small_square_error):
        total, lost = two_sum(total, term)
        error += lost
    return total + error


def partly_lit(d: np.ndarray, a: np.ndarray) -> np.ndarray:
    """2 (sqrt d + a acos(-a/sqrt(a^2 + d))) for d > 0: a ring of which an arc is turned to the viewer.

    With acos(-a/sqrt(a^2 + d)) = pi/2 + atan(a/sqrt d) no argument can leave the domain of its function. For a < 0 the
    terms cancel as the arc shrinks: `barely_lit` takes over.
    """
    root = np.sqrt(d)
    return 2.0 * (root + a * (np.pi / 2 + np.arctan(a / root)))


def barely_lit(d: np.ndarray, a: np.ndarray, a_error: np.ndarray | float = 0.0) -> np.ndarray:
    """As `partly_lit`, as 2 |a| (t - atan t) with t = sqrt(d)/|a|, for a < 0 and d < `BARELY` a^2.

    The value varies as a^-2, so the rounding error of a, where there is one, is worth passing.
    """
    square, square_error = two_square(a)
    z = d / square
    z -= z * ((square_error + 2.0 * a * a_error) / square)
    return 2.0 * np.sqrt(d) * (z * (horner(_ARC_P, z) / horner(_ARC_Q, z)))


def _dirac_ring(u: np.ndarray, u_n: np.ndarray) -> np.ndarray:
    a = u * u_n
    d = discriminant(np.abs(u), np.abs(u_n))
    sigma = 2.0 * np.pi * np.maximum(a, 0.0)
    partly = np.flatnonzero(d > 0.0)
    sigma[partly] = partly_lit(d[partly], a[partly])
    barely = np.flatnonzero((a < 0.0) & (d > 0.0) & (d < BARELY * a * a))
    _, a_error = two_prod(u[barely], u_n[barely])
    sigma[barely] = barely_lit(d[barely], a[barely], a_error)
    sigma[~((np.abs(u) <= 1.0) & (np.abs(u_n) <= 1.0))] = np.nan
    return sigma


def sigma_dirac_ring(u: np.typing.ArrayLike, u_n: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """Cross-section of a ring of normals at polar cosine `u_n`, seen from the direction of cosine `u`.

    sigma(u, u_n) is the integral over phi in [0, 2 pi] of max(0, u u_n + sqrt(1 - u^2) sqrt(1 - u_n^2) cos phi): the
    projected area toward the viewer of D(x) = delta(x - u_n), x = cos theta, a density per steradian. The ring thus has
    the area 2 pi, sigma(u, 1) = 2 pi max(u, 0), and sigma(u) of any axisymmetric D is the integral over x in [-1, 1] of
    D(x) sigma_dirac_ring(u, x).

    u, u_n: cosines in [-1, 1], of shapes that broadcast; the value is symmetric in them. Anything else, NaN included,
    gives NaN. float32 for float32 arguments, float64 otherwise. TypeError for arguments that are no real numbers,
    ValueError for shapes that do not broadcast.

    `deon2016:8.piecewise` with `deon2016:9`, `deon2016:10`, `deon2016:11` and `deon2016:12`, in a form without the
    printed acos: its argument passes 1 by rounding where the ring turns fully away or fully toward the viewer.

    >>> sigma_dirac_ring([-1, 0, 0.5], 1)
    array([0.        , 0.        , 3.14159265])
    >>> float(sigma_dirac_ring(0, 0))
    2.0
    """
    return elementwise(_dirac_ring, u=u, u_n=u_n)
