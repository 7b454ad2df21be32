"""The spherical Gaussian's cross-section for one roughness: a table made on the spot."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from xsec_sym.kernels import _spherical_gaussian_regions as regions
from xsec_sym.kernels._pairs import Pair, quotient
from xsec_sym.kernels._spherical_gaussian_core import WHOLE
from xsec_sym.kernels._support import BLOCK, elementwise, quick_two_sum, two_prod, two_square
from xsec_sym.kernels.spherical_gaussian import scaled_sigma_spherical_gaussian, sigma_spherical_gaussian

# The least absolute error that can be asked for.
LEAST = 5e-16
# Degrees of the pieces: from each tolerance on, the one beside it.
DEGREES = ((1e-8, 2), (1e-12, 3), (0.0, 5))
RELATIVE_DEGREE = 7
FEWEST, MOST = 16, 1024
# What a Chebyshev coefficient of double values cannot be told from 0.
NOISE = 4e-16
# exp(-w) is 0 from here on.
GONE = 746.0
# Beyond this cosine exp(w) sigma(-v) falls too steeply toward the rim for its argument to be rounded.
RIM = 0.9
# From this kappa on sigma(-v) is nothing beside c v there.
FACING_ALONE = 80.0
# Between them sigma of a cosine is no limit yet, and kappa a number.
ROUGHNESSES = (1e-100, 1e100)


class FixedSphericalGaussian:
    """What `specialize_spherical_gaussian` returns: sigma as a function of the cosine `u` alone.

    u: cosine in [-1, 1], of any shape; anything else, NaN included, gives NaN.

    >>> sigma = specialize_spherical_gaussian(0.5)
    >>> sigma([-0.5, 0, 1])
    array([0.01361484, 0.13414251, 0.87504203])
    """

    def __init__(self, alpha: float, tol: float | None) -> None:
        self.alpha, self.tol = alpha, tol
        self.general = not ROUGHNESSES[0] < alpha < ROUGHNESSES[1]
        if self.general:
            return
        rough = np.array([alpha])
        kappa, low = quotient(2.0, 0.0, *two_square(rough))
        pale = kappa[0] < regions.PALE
        with np.errstate(over="ignore"):
            mean = regions.pale_cosine(regions.PRECISE, rough) if pale else regions.mean_cosine(regions.PRECISE, kappa)
        self.mean, self.kappa = mean.item(), (kappa.item(), low.item())
        self.pieces = self._relative() if tol is None else self._absolute(tol)

    def _absolute(self, tol: float) -> np.ndarray:
        """Pieces of sigma(-v) in v, up to where it is negligible."""
        self.end = self._reach(math.log(8.0 / tol))
        degree = next(degree for least, degree in DEGREES if tol >= least)
        pieces = _pieces(lambda v: np.asarray(sigma_spherical_gaussian(-v, self.alpha)), self.end, degree, tol / 4.0)
        return _ended(pieces, float(sigma_spherical_gaussian(-self.end, self.alpha)))

    def _relative(self) -> np.ndarray:
        """Pieces of exp(w) sigma(-v) in q = v/(1 + s), s = sqrt(1 - v^2), up to where exp(-w) is 0, or the rim."""
        reach = self._reach(GONE)
        self.rim = reach > RIM
        v = min(reach, RIM)
        self.end = v / (1.0 + math.sqrt((1.0 - v) * (1.0 + v)))
        least = float(scaled_sigma_spherical_gaussian(-v, self.alpha))

        def scaled(q: np.ndarray) -> np.ndarray:
            return np.asarray(scaled_sigma_spherical_gaussian(-2.0 * q / (1.0 + q * q), self.alpha))

        pieces = _pieces(scaled, self.end, RELATIVE_DEGREE, least * NOISE)
        return _ended(pieces, least)

    def _reach(self, w: float) -> float:
        """v with kappa (1 - s) = w, or 1."""
        rest = 0.5 * self.alpha * self.alpha * w
        return math.sqrt(rest * (2.0 - rest)) if rest < 1.0 else 1.0

    def _piecewise(self, x: np.ndarray) -> np.ndarray:
        count = self.pieces.shape[1] - 1
        x = np.minimum(x * (count / self.end), count)
        piece = x.astype(np.intp)
        x -= piece
        first, *rest = self.pieces
        # NaN is no index.
        total = np.take(first, piece, mode="clip")
        for row in rest:
            total *= x
            total += np.take(row, piece, mode="clip")
        return total

    def _core(self, u: np.ndarray) -> np.ndarray:
        v = np.abs(u)
        if self.tol is None:
            one, low, square = _one_plus_sine(v)
            w, w_low = quotient(*square, one, low)
            w, error = two_prod(w, np.array(self.kappa[0]))
            error += self.kappa[0] * w_low + self.kappa[1] * (w / self.kappa[0])
            fall = np.exp(-w)
            sigma = (fall - fall * error) * self._piecewise(v / one)
        else:
            sigma = self._piecewise(v)
        sigma += np.maximum(u, 0.0) * self.mean
        sigma[~(v <= 1.0)] = np.nan
        return sigma

    def _with_rim(self, u: np.ndarray) -> np.ndarray:
        """Of many cosines, those at the rim together."""
        sigma = np.concatenate([self._core(u[i : i + BLOCK]) for i in range(0, max(u.size, 1), BLOCK)])
        v = np.abs(u) if self.kappa[0] < FACING_ALONE else -u
        beyond = ((v > RIM) & (v <= 1.0)).nonzero()[0]
        sigma[beyond] = sigma_spherical_gaussian(u[beyond], self.alpha)
        return sigma

    def __call__(self, u: np.typing.ArrayLike) -> np.ndarray | np.floating:
        """sigma at the cosine `u`; NaN outside [-1, 1]."""
        if self.general:
            return sigma_spherical_gaussian(u, self.alpha)
        if self.tol is None and self.rim:
            return elementwise(self._with_rim, block=WHOLE, u=u)
        return elementwise(self._core, u=u)


def _ended(pieces: np.ndarray, value: float) -> np.ndarray:
    """One piece more, constant, for the end and all beyond."""
    last = np.zeros((len(pieces), 1))
    last[-1] = value
    return np.append(pieces, last, axis=1)


def _one_plus_sine(v: np.ndarray) -> tuple[np.ndarray, np.ndarray, Pair]:
    """1 + sqrt(1 - v^2) and v^2 as pairs."""
    n, n_low = two_square(v)
    # s is accurate where it is small, where 1 - n would not be without its second part.
    c, s = 1.0 - n, regions.sine(v)
    square, error = two_square(s)
    s_low = (((c - square) - error) + (((1.0 - c) - n) - n_low)) / np.maximum(2.0 * s, np.finfo(float).tiny)
    one, low = quick_two_sum(1.0, s)
    return one, low + s_low, (n, n_low)


def _pieces(function: Callable[[np.ndarray], np.ndarray], end: float, degree: int, left_out: float) -> np.ndarray:
    """Polynomials on equal parts of [0, end], highest power first, in variables that run from 0 to 1.

    The parts are halved until the first Chebyshev coefficient that is left out is below `left_out` or the noise.
    """
    nodes = np.polynomial.chebyshev.chebpts1(degree + 2)
    matrix = np.linalg.inv(np.polynomial.chebyshev.chebvander(nodes, degree + 1))
    to_powers = np.zeros((degree + 1, degree + 1))
    for i in range(degree + 1):
        series = np.polynomial.Chebyshev.basis(i, domain=[0, 1]).convert(kind=np.polynomial.Polynomial)
        to_powers[: i + 1, i] = series.coef
    count = FEWEST
    while True:
        places = (np.arange(count) + 0.5 * (nodes[:, np.newaxis] + 1.0)) * (end / count)
        values = function(places)
        coefficients = matrix @ values
        if count >= MOST or np.all(np.abs(coefficients[-1]) < np.maximum(left_out, NOISE * np.abs(values).max(axis=0))):
            return np.ascontiguousarray((to_powers @ coefficients[:-1])[::-1])
        count *= 2


def specialize_spherical_gaussian(alpha: float, tol: float | None = None) -> FixedSphericalGaussian:
    """The cross-section of the spherical Gaussian of roughness `alpha` as a fast function of the cosine `u`.

    The same as `sigma_spherical_gaussian(u, alpha)`, from a table that is made on the spot, in about a millisecond:
    worth it from some 10^5 cosines on.

    alpha: a roughness in [0, inf], without unit. tol: what an absolute error may be, at least 5e-16; or None for the
    relative error of 16 eps of `sigma_spherical_gaussian`, on the side turned away too. ValueError for anything else.
    The function takes u as that does: any shape; NaN outside [-1, 1]; float32 for float32.

    Tests hold it to the absolute error, and to a relative 8 eps for tol = None.

    >>> sigma = specialize_spherical_gaussian(0.5, tol=1e-7)
    >>> sigma([-0.5, 0, 0.5, 1]).round(6)
    array([0.013615, 0.134143, 0.451115, 0.875042])
    """
    alpha = float(alpha)
    if not alpha >= 0.0:
        raise ValueError(f"alpha must be a roughness in [0, inf], not {alpha}")
    if tol is not None and not LEAST <= tol < math.inf:
        raise ValueError(f"tol must be at least {LEAST}, or None, not {tol}")
    return FixedSphericalGaussian(alpha, tol)
