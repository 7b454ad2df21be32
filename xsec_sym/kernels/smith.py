"""Smith's masking and shadowing functions of Lambda, from 0 to infinity, in forms that cannot overflow."""

from __future__ import annotations

import numpy as np

from xsec_sym.kernels._support import elementwise


def _g1(lam: np.ndarray) -> np.ndarray:
    value = 1.0 / (1.0 + lam)
    value[~(lam >= 0.0)] = np.nan
    return value


def _g2(lam_i: np.ndarray, lam_o: np.ndarray) -> np.ndarray:
    # Halves, since two doubles may have a sum that is none
    value = 0.5 * lam_i
    value += 0.5 * lam_o
    value += 0.5
    np.divide(0.5, value, out=value)
    value[~((lam_i >= 0.0) & (lam_o >= 0.0))] = np.nan
    return value


def _g2_given_g1(lam_i: np.ndarray, lam_o: np.ndarray) -> np.ndarray:
    # Above 1, no sum is infinite unless a term is; inf/inf is NaN, as it should be
    value = lam_o / (1.0 + lam_i)
    value += 1.0
    np.divide(1.0, value, out=value)
    value[~((lam_i >= 0.0) & (lam_o >= 0.0))] = np.nan
    return value


def smith_g1(lam: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """Smith's masking function for the Lambda of a direction: the part of the surface's projection that is visible.

    A probability, 1 for Lambda = 0 and 0 for Lambda = infinity, which a rough surface has at grazing.

    lam: Lambda in [0, inf], without unit, as from `lambda_ggx` or `lambda_beckmann`. A negative one and NaN give NaN.
    float32 for float32 arguments, float64 otherwise. TypeError for an argument that is no real number.

    `dupuy2016:20`, 1/(1 + Lambda). The error is at most 1.5 ulp in float64, and 0.5 ulp in float32.

    >>> smith_g1([0, 0.25, 3, np.inf])
    array([1.  , 0.8 , 0.25, 0.  ])
    """
    return elementwise(_g1, lam=lam)


def smith_g2(lam_i: np.typing.ArrayLike, lam_o: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """Smith's masking and shadowing for the Lambdas of two directions: the probability to be visible from both.

    Heights count, so that it is more than the product of the two maskings. It is symmetric, 0 where either Lambda is
    infinite, and the masking of one direction where the other's Lambda is 0.

    lam_i, lam_o: Lambda in [0, inf] of the incident and the outgoing direction, without unit. Shapes broadcast; a
    negative one and NaN give NaN. float32 for float32 arguments, float64 otherwise. TypeError for arguments that are
    no real numbers, ValueError for shapes that do not broadcast.

    `dupuy2016:21`, 1/(1 + Lambda_i + Lambda_o), also where the sum is no double. The error is at most 2.5 ulp in
    float64, and 0.5 ulp in float32.

    >>> smith_g2(1, [0, 2, 1.5e308, np.inf])
    array([5.00000000e-001, 2.50000000e-001, 6.66666667e-309, 0.00000000e+000])
    """
    return elementwise(_g2, lam_i=lam_i, lam_o=lam_o)


def smith_g2_given_g1(lam_i: np.typing.ArrayLike, lam_o: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """Smith's shadowing for `lam_o` of what is visible for `lam_i`: the conditional probability, and G2/G1.

    It is 1 for Lambda_o = 0, and 0 for Lambda_o = infinity. For Lambda_i = infinity and a finite Lambda_o it is the
    limit, 1, where G2/G1 is 0/0. With both infinite there is no limit, for Lambda_i = k Lambda_o tends to k/(1 + k),
    any number between 0 and 1: NaN.

    lam_i, lam_o: Lambda in [0, inf] of the incident and the outgoing direction, without unit. Shapes broadcast; a
    negative one and NaN give NaN. float32 for float32 arguments, float64 otherwise. TypeError for arguments that are
    no real numbers, ValueError for shapes that do not broadcast.

    `dupuy2016:22`, (1 + Lambda_i)/(1 + Lambda_i + Lambda_o), as 1/(1 + Lambda_o/(1 + Lambda_i)). The error is at
    most 3.5 ulp in float64, and 0.5 ulp in float32.

    >>> smith_g2_given_g1([1, 3, np.inf, 0], [2, 1, 2, np.inf])
    array([0.5, 0.8, 1. , 0. ])
    >>> smith_g2_given_g1(np.inf, np.inf)
    np.float64(nan)
    """
    return elementwise(_g2_given_g1, lam_i=lam_i, lam_o=lam_o)
