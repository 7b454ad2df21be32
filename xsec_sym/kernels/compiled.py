"""The spherical Gaussian's cross-section compiled by Numba, which is an extra: `pip install numba`.

The same functions as in `xsec_sym.kernels`, from the same tables, several times faster on large arrays. Import this
module itself, `from xsec_sym.kernels import compiled`: the package does without Numba. The first call of a machine
compiles for some 10 s, and keeps the result in a cache where there is a folder that can be written; from then on the
first call of a process takes 0.3 s.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import cache

import numpy as np

try:
    from xsec_sym.kernels import _spherical_gaussian_compiled as loops
    from xsec_sym.kernels._compiled_polynomials import Kit, compiled_kit, renew
except ModuleNotFoundError as error:
    if error.name != "numba":
        raise
    raise ImportError("xsec_sym.kernels.compiled needs Numba: pip install numba") from error

from xsec_sym.kernels import _spherical_gaussian_regions as regions
from xsec_sym.kernels._support import elementwise, result_dtype

# The values that a thread computes at a time. Arrays much larger than this are given back to the system each time.
SHARE = 2**17


@cache
def _kit(fast: bool) -> Kit:
    return compiled_kit(regions.FAST if fast else regions.PRECISE)


@cache
def _renew() -> None:
    point = np.array([0.5])
    renew(loops.fill, loops.STAMP, _kit(False), loops.SIGMA, point, point.copy(), point.copy())


def _evaluated(form: int, u: np.typing.ArrayLike, alpha: np.typing.ArrayLike, threads: int) -> np.ndarray | np.floating:
    if threads < 1:
        raise ValueError(f"threads must be at least 1, not {threads}")
    kit = _kit(result_dtype({"u": u, "alpha": alpha}) is np.float32)
    _renew()

    def fill(u: np.ndarray, alpha: np.ndarray, value: np.ndarray) -> None:
        # Copies are of a single type, whatever the arguments are, so that there is a single compilation.
        loops.fill(kit, form, np.array(u), np.array(alpha), value)

    def block(u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
        value = np.empty(u.size)
        share = max(-(-u.size // threads), loops.BLOCK)
        parts = [slice(start, start + share) for start in range(0, u.size, share)]
        if len(parts) > 1:
            list(pool.map(lambda part: fill(u[part], alpha[part], value[part]), parts))
        else:
            fill(u, alpha, value)
        return value

    # No thread is started before it has work.
    with ThreadPoolExecutor(threads) as pool:
        return elementwise(block, block=threads * SHARE, u=u, alpha=alpha)


def sigma_spherical_gaussian(
    u: np.typing.ArrayLike, alpha: np.typing.ArrayLike, threads: int = 1
) -> np.ndarray | np.floating:
    """`xsec_sym.kernels.sigma_spherical_gaussian`, compiled: cross-section of the spherical Gaussian.

    The projected area toward the viewer of normals on the whole sphere whose area is 1; alpha = inf is isotropic, 1/4,
    and alpha = 0 a flat surface, max(u, 0).

    u: cosine in [-1, 1]. alpha: roughness in [0, inf], without unit. Shapes broadcast; anything else, NaN included,
    gives NaN. threads: how many share the values. float32 for float32 arguments, float64 otherwise. TypeError for
    arguments that are no real numbers, ValueError for shapes that do not broadcast or for no thread.

    `deon2016:29`. Within 4 ulp of the kernel that is not compiled.

    >>> from xsec_sym.kernels import compiled
    >>> compiled.sigma_spherical_gaussian([-0.5, 0, 0.5, 1], 0.5)
    array([0.01361484, 0.13414251, 0.45111495, 0.87504203])
    """
    return _evaluated(loops.SIGMA, u, alpha, threads)


def log_sigma_spherical_gaussian(
    u: np.typing.ArrayLike, alpha: np.typing.ArrayLike, threads: int = 1
) -> np.ndarray | np.floating:
    """`xsec_sym.kernels.log_sigma_spherical_gaussian`, compiled: natural logarithm of sigma, where that underflows too.

    u: cosine in [-1, 1]. alpha: roughness in [0, inf], without unit. Shapes broadcast; anything else, NaN included,
    gives NaN. threads: how many share the values. float32 for float32 arguments, float64 otherwise. TypeError for
    arguments that are no real numbers, ValueError for shapes that do not broadcast or for no thread.

    Within 4 ulp of the kernel that is not compiled.

    >>> from xsec_sym.kernels import compiled
    >>> compiled.log_sigma_spherical_gaussian([-1, -0.5, 0, 1], 0.01)
    array([-2.00099035e+04, -2.69380839e+03, -5.87070106e+00, -5.00012500e-05])
    """
    return _evaluated(loops.LOG, u, alpha, threads)


def scaled_sigma_spherical_gaussian(
    u: np.typing.ArrayLike, alpha: np.typing.ArrayLike, threads: int = 1
) -> np.ndarray | np.floating:
    """`xsec_sym.kernels.scaled_sigma_spherical_gaussian`, compiled: exp(w) sigma for u < 0, else sigma.

    w = kappa (1 - sqrt(1 - u^2)), kappa = 2/alpha^2: without its exponential decay on the side turned away.

    u: cosine in [-1, 1]. alpha: roughness in [0, inf], without unit. Shapes broadcast; anything else, NaN included,
    gives NaN. threads: how many share the values. float32 for float32 arguments, float64 otherwise. TypeError for
    arguments that are no real numbers, ValueError for shapes that do not broadcast or for no thread.

    Within 4 ulp of the kernel that is not compiled.

    >>> from xsec_sym.kernels import compiled
    >>> compiled.scaled_sigma_spherical_gaussian([-1, -0.5, 0, 1], 0.01)
    array([5.00000000e-05, 6.05950795e-07, 2.82089502e-03, 9.99950000e-01])
    """
    return _evaluated(loops.SCALED, u, alpha, threads)
