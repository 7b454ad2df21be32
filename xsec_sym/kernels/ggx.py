"""The GGX distribution: NDF, cross-section and Smith Lambda, in forms without a difference of nearly equal numbers."""

from __future__ import annotations

import numpy as np

from xsec_sym.kernels._support import elementwise

# Inside these roughnesses no square below leaves the range of doubles where it matters.
SMALLEST, LARGEST = 1e-100, 1e100


def _sigma(u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    v = np.abs(u)
    cap = (1.0 - v) * (1.0 + v)
    spread = alpha * alpha * cap
    root = np.sqrt(v * v + spread)
    # (R - v)/2 times (R + v)/(R + v)
    sigma = 0.5 * spread / (root + v)
    extreme = np.flatnonzero(~((alpha > SMALLEST) & (alpha < LARGEST)))
    if extreme.size:
        spread, v = alpha[extreme] * np.sqrt(cap[extreme]), v[extreme]
        sigma[extreme] = 0.5 * spread * (spread / (np.hypot(v, spread) + v))
        sigma[extreme[spread == 0.0]] = 0.0
    sigma += np.maximum(u, 0.0)
    sigma[~((np.abs(u) <= 1.0) & (alpha >= 0.0) & (alpha < np.inf))] = np.nan
    return sigma


def _lambda(u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    v = np.abs(u)
    cap = (1.0 - v) * (1.0 + v)
    spread = alpha * alpha * cap
    value = 0.5 * spread / (v * (np.sqrt(v * v + spread) + v))
    extreme = np.flatnonzero(~((alpha > SMALLEST) & (alpha < LARGEST) & (v > SMALLEST)))
    if extreme.size:
        spread, v = alpha[extreme] * np.sqrt(cap[extreme]), v[extreme]
        value[extreme] = 0.5 * (spread / v) * (spread / (np.hypot(v, spread) + v))
        value[extreme[spread == 0.0]] = 0.0
    value[~((u >= 0.0) & (u <= 1.0) & (alpha >= 0.0) & (alpha < np.inf))] = np.nan
    return value


def _ndf(u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    root = (1.0 - u) * (1.0 + u) / alpha + alpha * u * u
    density = 1.0 / root
    density *= density
    density *= 1.0 / np.pi
    density[u <= 0.0] = 0.0
    density[~((np.abs(u) <= 1.0) & (alpha > 0.0) & (alpha < np.inf))] = np.nan
    return density


def sigma_ggx(u: np.typing.ArrayLike, alpha: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """Cross-section of the GGX distribution of roughness `alpha`, seen from the direction of cosine `u`.

    The projected area toward the viewer, of normals in the upper hemisphere whose area projected along the axis is 1:
    sigma(1) = 1, sigma(-1) = 0, and sigma(u) - sigma(-u) = u. alpha = 0 is a plane: max(u, 0); alpha = 1 is a half
    sphere: (1 + u)/2.

    u: cosine in [-1, 1]. alpha: roughness >= 0, without unit. Shapes broadcast; anything else, an infinite alpha and
    NaN included, gives NaN. float32 for float32 arguments, float64 otherwise. TypeError for arguments that are no real
    numbers, ValueError for shapes that do not broadcast.

    `deon2016:25`, rationalised for u < 0. Largest error found: 3.5 ulp in float64, 0.5 ulp in float32.

    >>> sigma_ggx([-0.5, 0, 0.5, 1], 0.5)
    array([0.08071891, 0.25      , 0.58071891, 1.        ])
    """
    return elementwise(_sigma, u=u, alpha=alpha)


def lambda_ggx(u: np.typing.ArrayLike, alpha: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """Smith's Lambda of the GGX distribution of roughness `alpha` at the cosine `u`.

    Lambda(u) = sigma_ggx(-u, alpha)/u, so that sigma_ggx(u, alpha) = (1 + Lambda) u and the masking function is
    1/(1 + Lambda). It is infinite at u = 0 for alpha > 0, and 0 everywhere for alpha = 0.

    u: cosine in [0, 1]. alpha: roughness >= 0, without unit. Shapes broadcast; anything else, an infinite alpha and NaN
    included, gives NaN. float32 for float32 arguments, float64 otherwise. TypeError for arguments that are no real
    numbers, ValueError for shapes that do not broadcast.

    The identity `deon2016:25`: with x = alpha^2 (1/u^2 - 1), Lambda = (sqrt(1 + x) - 1)/2 = x/(2 (sqrt(1 + x) + 1)).
    Largest error found: 4.0 ulp in float64, 0.5 ulp in float32.

    >>> lambda_ggx([0, 0.5, 1], 0.5)
    array([       inf, 0.16143783, 0.        ])
    """
    return elementwise(_lambda, u=u, alpha=alpha)


def ndf_ggx(u: np.typing.ArrayLike, alpha: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """The GGX distribution of normals, of roughness `alpha`, at the cosine `u`.

    A density per steradian (1/sr) of the area of a height field, per unit of its projection: 2 pi times the integral of
    u ndf(u) over u in [0, 1] is 1. It is 0 for u <= 0, and alpha^2/pi just above.

    u: cosine in [-1, 1]. alpha: roughness > 0, without unit. Shapes broadcast; anything else, an infinite alpha and NaN
    included, gives NaN. float32 for float32 arguments, float64 otherwise. TypeError for arguments that are no real
    numbers, ValueError for shapes that do not broadcast.

    `deon2016:24`, as 1/(pi ((1 - u^2)/alpha + alpha u^2)^2), a sum of positive terms. Largest error
    found: 6.6 ulp in float64, 0.5 ulp in float32.

    >>> ndf_ggx([-0.5, 0, 0.5, 1], 0.5)
    array([0.        , 0.        , 0.12054339, 1.27323954])
    """
    return elementwise(_ndf, u=u, alpha=alpha)
