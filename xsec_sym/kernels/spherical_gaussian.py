"""The spherical Gaussian (von Mises-Fisher distribution): NDF and cross-section, kappa = 2/alpha^2."""

from __future__ import annotations

import numpy as np

from xsec_sym.kernels import _spherical_gaussian_core as core
from xsec_sym.kernels._pairs import GONE, STEEP, exp_minus_times, quotient
from xsec_sym.kernels._spherical_gaussian_regions import FAST, PRECISE, SINGLE
from xsec_sym.kernels._support import elementwise, quick_two_sum, result_dtype, two_square

LARGEST = 1e15


def _evaluated(
    form: core.Form, u: np.typing.ArrayLike, alpha: np.typing.ArrayLike, accuracy: str
) -> np.ndarray | np.floating:
    if accuracy not in ("full", "fast"):
        raise ValueError(f"accuracy must be 'full' or 'fast', not {accuracy!r}")
    single = result_dtype({"u": u, "alpha": alpha}) is np.float32
    kit = SINGLE if single else FAST if accuracy == "fast" else PRECISE
    return elementwise(
        lambda u, alpha: core.evaluate(kit, form, u, alpha), block=core.WHOLE, dtype=kit.dtype, u=u, alpha=alpha
    )


def _ndf(u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    known = (np.abs(u) <= 1.0) & (alpha > 0.0)
    alpha = np.minimum(alpha, LARGEST)
    kappa = 2.0 / alpha / alpha
    x = 2.0 * (1.0 - u) / alpha / alpha
    x_low = np.zeros_like(x)
    chosen = np.flatnonzero((x > STEEP) & (x < GONE))
    height, height_low = quick_two_sum(1.0, -u[chosen])
    x[chosen], x_low[chosen] = quotient(2.0 * height, 2.0 * height_low, *two_square(alpha[chosen]))
    density = exp_minus_times(x, x_low, -kappa / np.expm1(-2.0 * kappa) / (2.0 * np.pi))
    density[x > GONE] = 0.0
    density[~known] = np.nan
    return density


def sigma_spherical_gaussian(
    u: np.typing.ArrayLike, alpha: np.typing.ArrayLike, accuracy: str = "full"
) -> np.ndarray | np.floating:
    """Cross-section of the spherical Gaussian of roughness `alpha`, seen from the direction of cosine `u`.

    The projected area toward the viewer of normals on the whole sphere whose area is 1: the distribution has the
    integral 1 over solid angle, and sigma(u) - sigma(-u) = (coth kappa - 1/kappa) u. alpha = inf is isotropic, 1/4;
    alpha = 0 is a flat surface, max(u, 0).

    u: cosine in [-1, 1]. alpha: roughness in [0, inf], without unit. Shapes broadcast; anything else, NaN included,
    gives NaN. accuracy: "full", or "fast" for a relative error below 1e-7. float32 for float32 arguments, float64
    otherwise. TypeError for arguments that are no real numbers, ValueError for shapes that do not broadcast or another
    accuracy.

    `deon2016:29`, by polynomials for what is smooth in it. Largest error found: a relative 4.2 eps = 9.4e-16 for alpha
    in [1e-4, 1e4] wherever sigma > 1e-300, and 3e-8 if fast; 7.1 ulp in float32.

    >>> sigma_spherical_gaussian([-0.5, 0, 0.5, 1], 0.5)
    array([0.01361484, 0.13414251, 0.45111495, 0.87504203])
    """
    return _evaluated(core.SIGMA, u, alpha, accuracy)


def log_sigma_spherical_gaussian(
    u: np.typing.ArrayLike, alpha: np.typing.ArrayLike, accuracy: str = "full"
) -> np.ndarray | np.floating:
    """Natural logarithm of `sigma_spherical_gaussian`, finite where that underflows.

    On the side turned away sigma falls like exp(-w), w = kappa (1 - sqrt(1 - u^2)), kappa = 2/alpha^2; near u = 1 of a
    smooth surface the logarithm is small and keeps its digits. -inf for alpha = 0 and u <= 0.

    u: cosine in [-1, 1]. alpha: roughness in [0, inf], without unit. Shapes broadcast; anything else, NaN included,
    gives NaN. accuracy: "full", or "fast" for an error of sigma below 1e-7. float32 for float32 arguments, float64
    otherwise. TypeError for arguments that are no real numbers, ValueError for shapes that do not broadcast or another
    accuracy.

    Largest error found: a relative 1.9 eps = 4.1e-16 for alpha in [1e-4, 1e4]; 4 ulp in float32.

    >>> log_sigma_spherical_gaussian([-1, -0.5, 0, 1], 0.01)
    array([-2.00099035e+04, -2.69380839e+03, -5.87070106e+00, -5.00012500e-05])
    """
    return _evaluated(core.LOG, u, alpha, accuracy)


def scaled_sigma_spherical_gaussian(
    u: np.typing.ArrayLike, alpha: np.typing.ArrayLike, accuracy: str = "full"
) -> np.ndarray | np.floating:
    """exp(w) sigma for u < 0, w = kappa (1 - sqrt(1 - u^2)), kappa = 2/alpha^2; sigma itself for u >= 0.

    What is left of `sigma_spherical_gaussian` without its exponential decay on the side turned away: it never
    underflows for alpha > 1e-100, and ratios of two such values keep their digits where sigma is 0.

    u: cosine in [-1, 1]. alpha: roughness in [0, inf], without unit. Shapes broadcast; anything else, NaN included,
    gives NaN. accuracy: "full", or "fast" for a relative error below 1e-7. float32 for float32 arguments, float64
    otherwise. TypeError for arguments that are no real numbers, ValueError for shapes that do not broadcast or another
    accuracy.

    Largest error found: a relative 6 eps = 1.4e-15 for alpha in [1e-4, 1e4]; 7 ulp in float32.

    >>> scaled_sigma_spherical_gaussian([-1, -0.5, 0, 1], 0.01)
    array([5.00000000e-05, 6.05950795e-07, 2.82089502e-03, 9.99950000e-01])
    """
    return _evaluated(core.SCALED, u, alpha, accuracy)


def ndf_spherical_gaussian(u: np.typing.ArrayLike, alpha: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """The spherical Gaussian distribution of normals, of roughness `alpha`, at the cosine `u`.

    A density per steradian (1/sr) on the whole sphere, with the integral 1: 2 pi times the integral of ndf(u) over u in
    [-1, 1] is 1. alpha = inf is isotropic, 1/(4 pi). It is the von Mises-Fisher density of kappa = 2/alpha^2.

    u: cosine in [-1, 1]. alpha: roughness in (0, inf], without unit. Shapes broadcast; anything else, NaN included,
    gives NaN. float32 for float32 arguments, float64 otherwise. TypeError for arguments that are no real numbers,
    ValueError for shapes that do not broadcast.

    `deon2016:28`, as kappa exp(-kappa (1 - u))/(2 pi (1 - exp(-2 kappa))), which neither overflows nor underflows
    before the density does. Largest error found: 3.6 ulp in float64, 0.5 ulp in float32.

    >>> ndf_spherical_gaussian([-1, 0, 1], 0.5)
    array([1.43284251e-07, 4.27124332e-04, 1.27323969e+00])
    """
    return elementwise(_ndf, u=u, alpha=alpha)
