"""Visible normals: their density, and exact sampling for viewers anywhere, below the horizon included."""

from __future__ import annotations

import math
from typing import Self

import numpy as np

from xsec_sym.kernels._support import common_shape, elementwise, elementwise_tuple, real_array, result_dtype
from xsec_sym.kernels.ggx import _ndf, _sigma
from xsec_sym.kernels.spherical_gaussian import scaled_sigma_spherical_gaussian

# A normal whose squared length is further from 1 than singles allow is not a direction.
UNIT = 1e-6
# A roughness below it moves no normal by more than it, so it serves for all of them; kappa stays a number.
SMALLEST = 1e-100
# The isotropic limit to all digits.
LARGEST = 1e15
# Where 1 - I1/I0 is taken from its asymptotic series.
FAR = 100.0
# Below this concentration an azimuth is drawn from the circle, above from a normal distribution.
FLAT = 0.4
LOWEST = 1e-300
MODE_STEPS, DROP_STEPS = 40, 24

Normals = tuple[np.ndarray | np.floating, np.ndarray | np.floating, np.ndarray | np.floating]


def _facing(x: np.ndarray, y: np.ndarray, z: np.ndarray, u: np.ndarray) -> np.ndarray:
    """The clamped cosine between the viewer and the normal; NaN for what is no direction."""
    facing = np.maximum(np.sqrt((1.0 - u) * (1.0 + u)) * x + u * z, 0.0)
    facing[~(np.abs((x * x + y * y + z * z) - 1.0) < UNIT)] = np.nan
    return facing


def _visible_ggx(x: np.ndarray, y: np.ndarray, z: np.ndarray, u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    density = _facing(x, y, z, u) * _ndf(np.clip(z, -1.0, 1.0), alpha) / _sigma(u, alpha)
    density[np.isinf(density)] = np.nan
    return density


def _visible_gaussian(x: np.ndarray, y: np.ndarray, z: np.ndarray, u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    # One viewer for all normals needs its cross-section once.
    first = slice(0, 1 if (u == u[0]).all() and (alpha == alpha[0]).all() else u.size)
    every, u, alpha = u, u[first], alpha[first]
    alpha = np.where(alpha > LARGEST, LARGEST, alpha)
    kappa = 2.0 / alpha / alpha
    s = np.sqrt((1.0 - u) * (1.0 + u))
    # The factor exp(-kappa (1 - s)) of both the distribution and the cross-section cancels before it underflows.
    area = np.asarray(scaled_sigma_spherical_gaussian(u, alpha))
    area = np.where((np.abs(u) <= 1.0) & (alpha >= SMALLEST), area, np.nan)
    # No visible normal is higher than top; 1 - s = u^2/(1 + s).
    lit = u >= 0.0
    top = np.where(lit, 1.0, s)
    scale = -kappa / np.expm1(-2.0 * kappa) / (2.0 * np.pi)
    return _facing(x, y, z, every) * np.exp(kappa * np.minimum(z - top, 0.0)) * (scale / area)


def visible_ggx(
    x: np.typing.ArrayLike,
    y: np.typing.ArrayLike,
    z: np.typing.ArrayLike,
    u: np.typing.ArrayLike,
    alpha: np.typing.ArrayLike,
) -> np.ndarray | np.floating:
    """The density of visible normals (x, y, z) of the GGX distribution, for the viewer (sqrt(1 - u^2), 0, u).

    A density per steradian (1/sr) on the sphere, with the integral 1: the clamped cosine between viewer and normal,
    times ndf_ggx(z, alpha), over sigma_ggx(u, alpha). It is 0 for normals that look away.

    (x, y, z): of unit length to rounding. u: cosine in (-1, 1]. alpha: roughness > 0, without unit. Shapes broadcast;
    anything else, an infinite alpha and NaN included, gives NaN, as does a viewer that sees nothing, u = -1. float32
    for float32 arguments, float64 otherwise. TypeError for arguments that are no real numbers, ValueError for shapes
    that do not broadcast.

    `dupuy2016:6`, where the viewer is -omega_1.

    >>> visible_ggx(0, 0, 1, [-0.5, 0, 0.5, 1], 0.5)
    array([0.        , 0.        , 1.09626147, 1.27323954])
    """
    return elementwise(_visible_ggx, x=x, y=y, z=z, u=u, alpha=alpha)


def visible_spherical_gaussian(
    x: np.typing.ArrayLike,
    y: np.typing.ArrayLike,
    z: np.typing.ArrayLike,
    u: np.typing.ArrayLike,
    alpha: np.typing.ArrayLike,
) -> np.ndarray | np.floating:
    """The density of visible normals (x, y, z) of the spherical Gaussian, for the viewer (sqrt(1 - u^2), 0, u).

    A density per steradian (1/sr) on the sphere, with the integral 1: the clamped cosine between viewer and normal,
    times ndf_spherical_gaussian(z, alpha), over sigma_spherical_gaussian(u, alpha). It is a number on the dark side
    too, where both of these underflow.

    (x, y, z): of unit length to rounding. u: cosine in [-1, 1]. alpha: roughness in [1e-100, inf], without unit. Shapes
    broadcast; anything else, NaN included, gives NaN. float32 for float32 arguments, float64 otherwise. TypeError for
    arguments that are no real numbers, ValueError for shapes that do not broadcast. The relative error is that of
    exp(kappa (z - sqrt(1 - u^2))), kappa = 2/alpha^2, or of exp(kappa (z - 1)) for u > 0: some 1e-16 kappa.

    `dupuy2016:6`, where the viewer is -omega_1.

    >>> visible_spherical_gaussian(0.6, 0, 0.8, [-0.5, 0, 0.5, 1], 0.5)
    array([2.25846328, 1.14980402, 0.52403216, 0.23501743])
    """
    return elementwise(_visible_gaussian, x=x, y=y, z=z, u=u, alpha=alpha)


def _sample_ggx(u: np.ndarray, alpha: np.ndarray, xi_1: np.ndarray, xi_2: np.ndarray) -> tuple[np.ndarray, ...]:
    s = np.sqrt((1.0 - u) * (1.0 + u))
    stretched = alpha * s
    length = np.hypot(stretched, u)
    v_x, v_z = stretched / length, u / length
    cosine, sine = np.cos(2.0 * np.pi * xi_2), np.sin(2.0 * np.pi * xi_2)
    dark = u < 0.0
    # The cap's height 1 + v_z, without the cancellation of a viewer below the horizon.
    cap = np.where(dark, v_x * v_x / (1.0 - v_z), 1.0 + v_z)
    # The point of the cap plus the viewer; on the dark side in units of v_x, in which nothing underflows.
    ring = np.sqrt(xi_1 * (2.0 - xi_1 * cap) * np.where(dark, 1.0 / (1.0 - v_z), cap))
    x, y = np.where(dark, 1.0, v_x) + ring * cosine, ring * sine
    wide = np.maximum(alpha, 1.0)
    across = np.where(dark, 1.0, alpha / wide)
    along = (1.0 - xi_1) * np.where(dark, s / (length * (1.0 - v_z)), cap / wide)
    x, y = across * x, across * y
    norm = np.sqrt(x * x + y * y + along * along)
    # The point opposite to the viewer, by the limit from above.
    opposite = norm == 0.0
    x, y, norm = np.where(opposite, cosine, x), np.where(opposite, sine, y), np.where(opposite, 1.0, norm)
    known = (np.abs(u) <= 1.0) & (alpha >= 0.0) & (alpha < np.inf) & (np.maximum(u, stretched) > 0.0)
    known &= (xi_1 >= 0.0) & (xi_1 <= 1.0) & (xi_2 >= 0.0) & (xi_2 <= 1.0)
    norm[~known] = np.nan
    return x / norm, y / norm, along / norm


def sample_visible_ggx(
    u: np.typing.ArrayLike, alpha: np.typing.ArrayLike, xi_1: np.typing.ArrayLike, xi_2: np.typing.ArrayLike
) -> Normals:
    """A visible normal (x, y, z) of the GGX distribution, for the viewer (sqrt(1 - u^2), 0, u).

    For independent uniform xi_1 and xi_2 its density is `visible_ggx`. The distribution is that of an ellipsoid's upper
    half; stretched to a sphere, light that comes from the viewer and is mirrored there leaves uniformly into the cap
    z > -v_z, whatever the viewer, so a point of the cap plus the viewer points along the normal (Dupuy and Benyoub,
    2023). alpha = 0 gives (0, 0, 1).

    u: cosine in (-1, 1]. alpha: roughness >= 0, without unit. xi_1, xi_2: in [0, 1]. Shapes broadcast; anything else,
    an infinite alpha and NaN included, gives NaN, as does a viewer that sees nothing: u = -1, and u <= 0 for alpha = 0.
    float32 for float32 arguments, float64 otherwise. TypeError for arguments that are no real numbers, ValueError for
    shapes that do not broadcast. Largest error of a component found in float64: 2e-14; the median is 1e-16.

    >>> x, y, z = sample_visible_ggx([-0.5, 0, 0.5, 1], 0.5, 0.3, 0.1)
    >>> z
    array([0.32815171, 0.65095107, 0.85947127, 0.95038193])
    """
    x, y, z = elementwise_tuple(_sample_ggx, 3, u=u, alpha=alpha, xi_1=xi_1, xi_2=xi_2)
    return x, y, z


def _bessel_deficit(z: np.ndarray) -> np.ndarray:
    """1 - I1(z)/I0(z)."""
    from scipy.special import i0e, i1e

    near = np.minimum(z, FAR)
    v = 1.0 / np.maximum(z, FAR)
    series = v * (1 / 2 + v * (1 / 8 + v * (1 / 8 + v * (25 / 128 + v * (13 / 32 + v * 1073 / 1024)))))
    return np.where(z < FAR, 1.0 - i1e(near) / i0e(near), series)


class _Cosines:
    """The cosine t between viewer and visible normal: its density, and a hat above it to draw from.

    About the viewer the density of t is t exp(kappa u t) I0(kappa s r), r = sqrt(1 - t^2), on [0, 1]. Its logarithm is
    concave for every u and kappa: I0 has imaginary zeros only, so that log I0(sqrt(w)) is concave in w, and it grows;
    w = (kappa s)^2 (1 - t^2) is concave in t. So a tangent lies above it everywhere. The hat is flat about the mode and
    has exponential flanks: the tangents where the density has fallen to 1/e of the flat top (none on the right where
    it does not fall so far). Between the mode and such a point at the distance d the hat and its flank have the area
    d, the density at least that of a chord, (1 - 1/e) d: at least 63 of 100 trials succeed, for every u and kappa.

    The variable is x = t - max(u, 0): with it every difference of nearly equal numbers is a sum of positive terms.
    """

    def __init__(self, u: np.ndarray, alpha: np.ndarray):
        self.u, self.s = u, np.sqrt((1.0 - u) * (1.0 + u))
        alpha = np.maximum(alpha, SMALLEST)
        self.kappa = 2.0 / alpha / alpha
        self.lit = u > 0.0
        self.start = np.maximum(u, 0.0)
        self.far = np.where(self.lit, self.s * self.s / (1.0 + self.start), 1.0)
        self._build()

    def at(self, chosen: np.ndarray) -> Self:
        part = object.__new__(type(self))
        part.__dict__.update({name: value[chosen] for name, value in self.__dict__.items()})
        return part

    def radius(self, x: np.ndarray) -> np.ndarray:
        first = np.where(self.lit, self.s, 1.0)
        return np.sqrt(np.maximum(first * first - x * (2.0 * self.start + x), 0.0))

    def lean(self, x: np.ndarray, r: np.ndarray) -> np.ndarray:
        """t s - u r for u > 0, which is x times this."""
        return self.s + self.u * (2.0 * self.u + x) / np.maximum(self.s + r, LOWEST)

    def log(self, x: np.ndarray) -> np.ndarray:
        """The logarithm of the density, up to a constant."""
        from scipy.special import i0e

        r = self.radius(x)
        steep = np.where(
            self.lit, x * self.lean(x, r) / np.maximum(self.s + r, LOWEST), self.s * x / (1.0 + r) - self.u
        )
        return np.log(np.maximum(self.start + x, 0.0)) - self.kappa * x * steep + np.log(i0e(self.kappa * self.s * r))

    def slope(self, x: np.ndarray) -> np.ndarray:
        """The derivative of `log`."""
        from scipy.special import i0e, i1e

        t, r = self.start + x, self.radius(x)
        z = self.kappa * self.s * r
        plain = self.kappa * self.u - self.kappa * self.s * t / r * (i1e(z) / i0e(z))
        split = self.kappa * (self.s * t / r * _bessel_deficit(z) - x * self.lean(x, r) / r)
        return 1.0 / t + np.where(self.lit & (z > 1.0), split, plain)

    def _build(self) -> None:
        low, high = np.minimum(LOWEST, self.far), self.far
        for _ in range(MODE_STEPS):
            middle = np.sqrt(low) * np.sqrt(high)
            rising = self.slope(middle) > 0.0
            low, high = np.where(rising, middle, low), np.where(rising, high, middle)
        self.mode = low
        # The tangent at one end of the bracket, followed to the other, is above the mode.
        self.top = self.log(low) + np.where(high > low, self.slope(low) * (high - low), 0.0)
        left = self.mode - self._drop(-1.0, self.mode + self.start)
        self.left_rate = self.slope(left)
        self.left = left + (self.top - self.log(left)) / self.left_rate
        ends_high = self.log(self.far) > self.top - 1.0
        right = self.mode + self._drop(1.0, self.far - self.mode)
        self.right_rate = np.where(ends_high, np.inf, -self.slope(right))
        self.right = np.where(ends_high, self.far, right - (self.top - self.log(right)) / self.right_rate)

    def _drop(self, sign: float, longest: np.ndarray) -> np.ndarray:
        """How far from the mode the density has fallen to 1/e of the top."""
        low, high = np.minimum(LOWEST, longest), longest
        for _ in range(DROP_STEPS):
            middle = np.sqrt(low) * np.sqrt(high)
            above = self.log(self.mode + sign * middle) > self.top - 1.0
            low, high = np.where(above, middle, low), np.where(above, high, middle)
        return low

    def hat_area(self) -> np.ndarray:
        """The area below the hat, whose top has the height 1."""
        return 1.0 / self.left_rate + (self.right - self.left) + 1.0 / self.right_rate

    def trial(self, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
        """A draw from the hat for each, and whether it is accepted."""
        n = self.u.size
        pick, decay, level = rng.random(n) * self.hat_area(), rng.standard_exponential(n), rng.standard_exponential(n)
        pick -= 1.0 / self.left_rate
        flat = self.right - self.left
        x = np.where(
            pick < 0.0,
            self.left - decay / self.left_rate,
            np.where(pick < flat, self.left + pick, self.right + decay / self.right_rate),
        )
        hat = self.top - np.where((pick < 0.0) | (pick >= flat), decay, 0.0)
        inside = (self.start + x > 0.0) & (x <= self.far)
        return x, inside & (self.log(np.where(inside, x, self.mode)) - hat >= -level)


def _azimuths(concentration: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """von Mises: the density of phi is exp(-2 z sin^2(phi/2)), up to a constant.

    Since sin(phi/2) >= phi/pi on [0, pi], a normal distribution of variance pi^2/(4 z) lies above it: 2/pi or more of
    the trials succeed for z >= 0.4, and for smaller ones 0.69 of those from the whole circle.
    """
    phi = np.empty_like(concentration)
    open_ = np.arange(phi.size)
    while open_.size:
        z = concentration[open_]
        flat = z < FLAT
        with np.errstate(all="ignore"):
            trial = np.where(
                flat,
                np.pi * (2.0 * rng.random(open_.size) - 1.0),
                rng.standard_normal(open_.size) * (0.5 * np.pi / np.sqrt(z)),
            )
            sine = np.sin(0.5 * trial)
            hat = np.where(flat, 0.0, 2.0 * z * (trial / np.pi) ** 2)
            above = 2.0 * z * sine * sine - hat
        done = (np.abs(trial) <= np.pi) & (above <= rng.standard_exponential(open_.size))
        phi[open_[done]] = trial[done]
        open_ = open_[~done]
    return phi


def _sample_gaussian(table: _Cosines, rows: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """One visible normal for each of `rows` of the table, as three rows."""
    x = np.empty(rows.size)
    open_ = np.arange(rows.size)
    while open_.size:
        trial, done = table.at(rows[open_]).trial(rng)
        x[open_[done]] = trial[done]
        open_ = open_[~done]
    of = table.at(rows)
    r = of.radius(x)
    t = of.start + x
    phi = _azimuths(of.kappa * of.s * r, rng)
    half = np.sin(0.5 * phi)
    back = 2.0 * r * half * half
    # t s - u r cos(phi)
    aside = np.where(of.lit, x * of.lean(x, r), t * of.s - of.u * r)
    return np.stack([aside + of.u * back, r * np.sin(phi), t * of.u + of.s * (r - back)])


def sample_visible_spherical_gaussian(
    u: np.typing.ArrayLike,
    alpha: np.typing.ArrayLike,
    rng: np.random.Generator,
    size: int | tuple[int, ...] | None = None,
) -> Normals:
    """Visible normals (x, y, z) of the spherical Gaussian, for the viewer (sqrt(1 - u^2), 0, u).

    Their density is `visible_spherical_gaussian`. The method is exact, by rejection, and its cost is bounded: at least
    63 of 100 trials succeed, for the cosine between viewer and normal as for the azimuth about the viewer, for every u
    and alpha, the dark side included. alpha = inf is isotropic, alpha = 0 gives (0, 0, 1). A table of numbers is made
    for each pair (u, alpha), so many normals of few pairs, by `size`, are cheaper than one of each of many.

    u: cosine in [-1, 1]. alpha: roughness in [0, inf], without unit; below 1e-100 it counts as that. `rng`: NumPy's
    generator, whose numbers are used up. `size`: the shape of the answer, to which u and alpha broadcast; without it,
    their common shape. Anything else, NaN included, gives NaN, as does a viewer that sees nothing: u <= 0 for
    alpha = 0. float32 for float32 arguments, float64 otherwise. TypeError for a generator that is none and for
    arguments that are no real numbers, ValueError for shapes that do not broadcast.

    The step that `dupuy2016` section 4.3 leaves open. Components are rounded to a few 1e-16.

    >>> rng = np.random.default_rng(1)
    >>> x, y, z = sample_visible_spherical_gaussian(-0.5, 0.1, rng, size=100000)
    >>> bool((z - 0.5 * np.sqrt(3)).std() < 0.01), bool((np.sqrt(0.75) * x - 0.5 * z > 0).all())
    (True, True)
    """
    if not isinstance(rng, np.random.Generator):
        raise TypeError(f"rng must be a numpy.random.Generator, not {type(rng).__name__}")
    arrays = {"u": real_array("u", u), "alpha": real_array("alpha", alpha)}
    dtype = result_dtype({"u": u, "alpha": alpha})
    pairs = common_shape(arrays)
    shape = pairs if size is None else tuple(np.atleast_1d(size).tolist())
    try:
        fits = np.broadcast_shapes(pairs, shape) == shape
    except ValueError:
        fits = False
    if not fits:
        raise ValueError(f"u and alpha of the common shape {pairs} do not broadcast to the size {shape}")
    u, alpha = (np.broadcast_to(array, pairs).astype(np.float64).ravel() for array in arrays.values())
    rows = np.broadcast_to(np.arange(math.prod(pairs)).reshape(pairs), shape).ravel()
    known = (np.abs(u) <= 1.0) & (alpha >= 0.0) & ((alpha > 0.0) | (u > 0.0))
    normals = np.full((3, rows.size), np.nan)
    chosen = known[rows]
    with np.errstate(all="ignore"):
        table = _Cosines(u[known], alpha[known])
        normals[:, chosen] = _sample_gaussian(table, (np.cumsum(known) - 1)[rows[chosen]], rng)
    normals[:, (alpha == 0.0)[rows] & chosen] = [[0.0], [0.0], [1.0]]
    x, y, z = (part.reshape(shape).astype(dtype)[()] for part in normals)
    return x, y, z
