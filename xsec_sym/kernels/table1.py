"""Cross-sections of the rational distributions of Table 1.

Generated from the record of verified equations by `python -m xsec_sym.export`: do not edit.
"""

from __future__ import annotations

import numpy as np

from xsec_sym.kernels._support import elementwise


def _sigma_inv1p_pos(u: np.ndarray) -> np.ndarray:
    return 2.0 * np.pi * (1.0 - u * (np.log1p(u) - np.log(u)))


def _sigma_inv1p(u: np.ndarray) -> np.ndarray:
    value = np.full_like(u, np.nan)
    here = (u >= -1.0) & (u < 0.0)
    value[here] = np.inf
    here = u == 0.0
    value[here] = 2.0 * np.pi
    here = (u > 0.0) & (u <= 1.0)
    value[here] = _sigma_inv1p_pos(u[here])
    return value


def sigma_inv1p(u: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """Cross-section of D(x) = 1/(1 + x), x = cos theta, a density per steradian, for a viewer at cosine `u`.

    sigma(u) is the integral over x in [-1, 1] of D(x) sigma_dirac_ring(u, x), with rings of area 2 pi. It is infinite
    for u < 0, where the pole x = -1 of D is in view, and 2 pi at u = 0.

    u: cosine in [-1, 1], of any shape. Anything else, NaN included, gives NaN. float32 for float32 arguments, float64
    otherwise. TypeError for arguments that are no real numbers.

    `deon2016:T1.inv1p.s.neg` (divergent), `deon2016:T1.inv1p.s.zero` (proved), `deon2016:T1.inv1p.s.pos` (proved).
    Largest error found: 4.4 ulp in float64, 0.5 ulp in float32.

    >>> sigma_inv1p([-0.5, 0, 1])
    array([       inf, 6.28318531, 1.92801313])
    """
    return elementwise(_sigma_inv1p, u=u)


def _sigma_inv1m_neg(u: np.ndarray) -> np.ndarray:
    abs_u = -u
    return 2.0 * np.pi * (1.0 - abs_u * (np.log1p(abs_u) - np.log(abs_u)))


def _sigma_inv1m(u: np.ndarray) -> np.ndarray:
    value = np.full_like(u, np.nan)
    here = (u >= -1.0) & (u < 0.0)
    value[here] = _sigma_inv1m_neg(u[here])
    here = u == 0.0
    value[here] = 2.0 * np.pi
    here = (u > 0.0) & (u <= 1.0)
    value[here] = np.inf
    return value


def sigma_inv1m(u: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """Cross-section of D(x) = 1/(1 - x), x = cos theta, a density per steradian, for a viewer at cosine `u`.

    sigma(u) is the integral over x in [-1, 1] of D(x) sigma_dirac_ring(u, x), with rings of area 2 pi. It is infinite
    for u > 0, where the pole x = 1 of D is in view, and 2 pi at u = 0.

    u: cosine in [-1, 1], of any shape. Anything else, NaN included, gives NaN. float32 for float32 arguments, float64
    otherwise. TypeError for arguments that are no real numbers.

    `deon2016:T1.inv1m.s.neg` (proved), `deon2016:T1.inv1m.s.zero` (proved), `deon2016:T1.inv1m.s.pos` (divergent).
    Largest error found: 3.9 ulp in float64, 0.5 ulp in float32.

    >>> sigma_inv1m([-1, 0, 0.5])
    array([1.92801313, 6.28318531,        inf])
    """
    return elementwise(_sigma_inv1m, u=u)


def _sigma_inv1m2_neg(u: np.ndarray) -> np.ndarray:
    abs_u = -u
    a = 1.0 / abs_u
    b = 2.0 * abs_u
    return -np.pi * (a * (b - 1.0) - b * np.log1p(a))


def _sigma_inv1m2(u: np.ndarray) -> np.ndarray:
    value = np.full_like(u, np.nan)
    here = (u >= -1.0) & (u < 0.0)
    value[here] = _sigma_inv1m2_neg(u[here])
    here = u == 0.0
    value[here] = np.inf
    here = (u > 0.0) & (u <= 1.0)
    value[here] = np.inf
    return value


def sigma_inv1m2(u: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """Cross-section of D(x) = 1/(1 - x)^2, x = cos theta, a density per steradian, for a viewer at cosine `u`.

    sigma(u) is the integral over x in [-1, 1] of D(x) sigma_dirac_ring(u, x), with rings of area 2 pi. It is infinite
    for u >= 0, and grows like pi/|u| below.

    u: cosine in [-1, 1], of any shape. Anything else, NaN included, gives NaN. float32 for float32 arguments, float64
    otherwise. TypeError for arguments that are no real numbers.

    `deon2016:T1.inv1m2.s.neg` (proved), `deon2016:T1.inv1m2.s.zero` (divergent), `deon2016:T1.inv1m2.s.pos`
    (divergent). Largest error found: 3.6 ulp in float64, 0.5 ulp in float32.

    >>> sigma_inv1m2([-1, -0.5, 0])
    array([1.21357953, 3.4513923 ,        inf])
    """
    return elementwise(_sigma_inv1m2, u=u)


def _sigma_inv1pu2_inside(u: np.ndarray) -> np.ndarray:
    abs_u = np.abs(u)
    abs_u_2 = abs_u * abs_u
    a = np.sqrt(2.0 - abs_u_2)
    return 2.0 * np.pi * (a + abs_u * np.log(1.4142135623730951 * (abs_u + 1.0) / (a + abs_u)) - 1.0)


def _sigma_inv1pu2(u: np.ndarray) -> np.ndarray:
    inside = (u >= -1.0) & (u <= 1.0)
    return np.where(inside, _sigma_inv1pu2_inside(u), np.nan)


def sigma_inv1pu2(u: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """Cross-section of D(x) = 1/(1 + x^2), x = cos theta, a density per steradian, for a viewer at cosine `u`.

    sigma(u) is the integral over x in [-1, 1] of D(x) sigma_dirac_ring(u, x), with rings of area 2 pi. It is finite and
    even in u.

    u: cosine in [-1, 1], of any shape. Anything else, NaN included, gives NaN. float32 for float32 arguments, float64
    otherwise. TypeError for arguments that are no real numbers.

    `deon2016:T1.inv1pu2.s` (proved). Largest error found: 5.1 ulp in float64, 0.5 ulp in float32.

    >>> sigma_inv1pu2([-1, 0, 1])
    array([2.17758609, 2.60258057, 2.17758609])
    """
    return elementwise(_sigma_inv1pu2, u=u)
