"""The squared spheroidal and ellipsoidal lobes, in forms without a difference of nearly equal numbers."""

from __future__ import annotations

import numpy as np

from xsec_sym.kernels._support import elementwise, split, two_sum

# A vector's length may differ from 1 by that much: unit vectors in singles do by some 2e-7.
LENGTH = 1e-6
# Below this roughness `ssl` is 0 in doubles wherever the cosine is below 1, and residues of `sel` may underflow.
SMALLEST = 1e-150
# A power of 2, which changes no quotient.
UP = 2.0**200


def _ssl(m: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    square = alpha * alpha
    # On the axis, 0/0 otherwise
    np.maximum(square, SMALLEST * SMALLEST, out=square)
    below = 1.0 + m
    below *= square
    below += 1.0 - m
    square += square
    square /= below
    square *= square
    square[~((np.abs(m) <= 1.0) & (alpha > 0.0) & (alpha <= 1.0))] = np.nan
    return square


def _square_of_quotient(x: np.ndarray, alpha: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(x/alpha)^2 as the sum of an exact square and of the rest, less than 2^-24 as large.

    The lobe has the fourth power of the quotient, whose rounding alone would cost it 4 ulp.
    """
    quotient = x / alpha
    high, low = split(quotient)
    alpha_high, alpha_low = split(alpha)
    # x - quotient alpha, which is exact but for its last term
    rest = x - high * alpha_high
    rest -= high * alpha_low
    rest -= low * alpha
    rest /= alpha
    # (high + low + rest)^2
    rest *= quotient + quotient
    low *= quotient + high
    low += rest
    high *= high
    return high, low


def _sel(x: np.ndarray, y: np.ndarray, z: np.ndarray, alpha_x: np.ndarray, alpha_y: np.ndarray) -> np.ndarray:
    larger, smaller = np.maximum(alpha_x, alpha_y), np.minimum(alpha_x, alpha_y)
    pairs = [(x, alpha_x), (y, alpha_y)]
    if not smaller.min() > SMALLEST:
        pairs = [(part * UP, alpha * UP) for part, alpha in pairs]
    # P = (x/alpha_x)^2 + (y/alpha_y)^2, S = alpha_max^2 P, U^2 = S + z^2, W = U + |z|, W^2 = S + 2 |z| W
    (slope, rest), (across, rest_across) = (_square_of_quotient(*pair) for pair in pairs)
    slope, lost = two_sum(slope, across)
    rest += rest_across
    rest += lost
    slope += rest
    square = larger * larger
    stretched, height, lift = square * slope, z * z, np.abs(z)
    reach = stretched + height
    np.sqrt(reach, out=reach)
    reach += lift
    reach *= lift
    reach += reach
    reach += stretched
    # The lobe is (2 c W/(W^2 + c^2 P))^2 with c = 1 in front and alpha_max^2 behind, for (U - |z|) W = S
    weight = np.maximum(square, z >= 0.0)
    weight *= weight
    slope *= weight
    across = slope / reach
    across *= slope
    slope += slope
    reach += slope
    reach += across
    weight *= 4.0
    lobe = weight / reach
    if not reach.max() < np.inf:
        far = np.flatnonzero(~(reach < np.inf))
        lobe[far] = _far(x[far], y[far], z[far], alpha_x[far], alpha_y[far])
    height += x * x
    height += y * y
    height -= 1.0
    np.abs(height, out=height)
    lobe[~((height <= 2.0 * LENGTH) & (smaller > 0.0) & (larger <= 1.0))] = np.nan
    return lobe


def _far(x: np.ndarray, y: np.ndarray, z: np.ndarray, alpha_x: np.ndarray, alpha_y: np.ndarray) -> np.ndarray:
    """The lobe where it is a subnormal number or 0, and its inverse overflows."""
    larger = np.maximum(alpha_x, alpha_y)
    slope = np.hypot(x / alpha_x, y / alpha_y)
    reach = np.hypot(larger * slope, z) + np.abs(z)
    weight = np.where(z < 0.0, larger * larger, 1.0)
    slope *= weight
    distance = 2.0 * weight / (reach + slope * (slope / reach))
    distance[np.isinf(reach)] = 0.0
    return distance * distance


def ssl(cos_theta: np.typing.ArrayLike, alpha: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """The squared spheroidal lobe of roughness `alpha`, at the angle of cosine `cos_theta` from its axis.

    The GGX distribution at half the angle, over its value on the axis: 1 for cos_theta = 1, falling to alpha^4 for
    cos_theta = -1, without unit. Its integral over the sphere is 4 pi alpha^2; alpha = 1 is the constant 1.

    cos_theta: cosine in [-1, 1]. alpha: roughness in (0, 1], without unit. Shapes broadcast; anything else, NaN
    included, gives NaN. float32 for float32 arguments, float64 otherwise. TypeError for arguments that are no real
    numbers, ValueError for shapes that do not broadcast.

    The value is right for the very cosine given. Next to 1, though, doubles are 1.1e-16 apart, which is an angle of
    1.5e-8, and singles 3.5e-4 in angle: a lobe as narrow as that needs `sel`, which takes the direction itself.

    `tokuyoshi_harada:ssl`, 4 alpha^4/((1 - m) + alpha^2 (1 + m))^2, as the square of its root. Largest error found:
    6.4 ulp in float64, 0.5 ulp in float32.

    >>> ssl([-1, 0, 0.5, 1], 0.5)
    array([0.0625    , 0.16      , 0.32653061, 1.        ])
    """
    return elementwise(_ssl, cos_theta=cos_theta, alpha=alpha)


def sel(
    x: np.typing.ArrayLike,
    y: np.typing.ArrayLike,
    z: np.typing.ArrayLike,
    alpha_x: np.typing.ArrayLike,
    alpha_y: np.typing.ArrayLike,
) -> np.ndarray | np.floating:
    """The squared ellipsoidal lobe of the roughnesses `alpha_x` and `alpha_y`, in the direction (x, y, z).

    The squared distance from the origin, in this direction, to the ellipsoid with the semi-axes alpha_x, alpha_y and
    (1 + a^2)/2 about the point (0, 0, (1 - a^2)/2), where a is the larger roughness. It is 1 along the axis, z = 1, and
    a^4 in the opposite direction, without unit; where both roughnesses are alike it is `ssl` at cos_theta = z.

    x, y, z: components of a unit vector in the frame of the lobe. alpha_x, alpha_y: roughness in (0, 1], without unit.
    Shapes broadcast; anything else, NaN included, gives NaN, and so does a length that differs from 1 by more than
    1e-6, ten roundings of singles. Within that the vector is taken as it is, neither scaled nor with one component made
    from the others: the value is the square of the t for which t (x, y, z) lies on the ellipsoid, so that a length
    longer by the relative e gives a value smaller by 2 e. float32 for float32 arguments, float64 otherwise. TypeError
    for arguments that are no real numbers, ValueError for shapes that do not broadcast.

    `tokuyoshi_harada:K.U`, with U - |z| = (U^2 - z^2)/(U + |z|), where U^2 - z^2 is a sum of squares. Largest error
    found: 6.5 ulp in float64, 0.5 ulp in float32.

    >>> sel([0, 0.6, 0, 0.6, 0], [0, 0, 0.6, 0, 0], [1, 0.8, 0.8, -0.8, -1], 0.5, 0.25)
    array([1.        , 0.59171598, 0.17281075, 0.07304602, 0.0625    ])
    """
    return elementwise(_sel, x=x, y=y, z=z, alpha_x=alpha_x, alpha_y=alpha_y)
