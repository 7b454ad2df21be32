"""Light on a Smith microsurface, as a walk in heights: the heterogeneous medium of density P1/C1 (`dupuy2016:12`)."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from scipy import special

from xsec_sym.kernels import lambda_ggx
from xsec_sym.walks.paths import Emerged, Paths, Told, require, require_cosine

CHUNK = 1 << 16
LOG_2 = np.log(2.0)


@dataclass(frozen=True)
class Heights:
    """A distribution of heights: the logarithm of its cumulative distribution C1, the inverse, and where to draw a top.

    The logarithm keeps what C1 loses: next to 1 for heights far up, and below the smallest double for heights far down.
    """

    log_cdf: Callable[[np.ndarray], np.ndarray]
    inverse: Callable[[np.ndarray], np.ndarray]
    top: float


def _log_of_rest(log: np.ndarray) -> np.ndarray:
    """log(1 - exp(log)) for log <= 0: the way from log C1 to the logarithm of what is left above, and back."""
    near, far = np.maximum(log, -LOG_2), np.minimum(log, -LOG_2)
    return np.where(log > -LOG_2, np.log(-np.expm1(near)), np.log1p(-np.exp(far)))


def _exponential_log_cdf(height: np.ndarray) -> np.ndarray:
    return _log_of_rest(-height)


def _exponential_inverse(log: np.ndarray) -> np.ndarray:
    return -_log_of_rest(log)


def _logistic_inverse(log: np.ndarray) -> np.ndarray:
    # -log(exp(-log) - 1), which does not overflow far down
    return log - _log_of_rest(log)


HEIGHTS = {
    "gaussian": Heights(special.log_ndtr, special.ndtri_exp, 3.0),
    # on [0, 1], where doubles resolve the lowest heights
    "uniform": Heights(lambda height: np.log(np.minimum(height, 1.0)), np.exp, 1.0),
    "logistic": Heights(special.log_expit, _logistic_inverse, 5.0),
    "exponential": Heights(_exponential_log_cdf, _exponential_inverse, 5.0),
}

# The numbers of the paths under way, their points (3, n), their directions (3, n), and which of them leave.
Step = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]


@dataclass(frozen=True)
class SmithMedium:
    """A Smith microsurface of GGX slopes of roughness `alpha`, whose heights follow one of HEIGHTS.

    From the height h along omega the optical depth to h' is sigma(omega)/|omega_z| times |log C1(h')/C1(h)|, as the
    density P1/C1 is the derivative of log C1. Upward sigma/omega_z is Lambda, so that for a uniform U the next height
    has C1(h') = C1(h) U^(-1/Lambda), and light leaves where that is above 1; downward it is 1 + Lambda, and
    C1(h') = C1(h) U^(1/(1 + Lambda)). alpha: positive, without unit. flakes: "mirror" or "diffuse", of albedo 1.
    ValueError for anything else.

    Directions of view and of light are given by the cosine to the z-axis, in (0, 1]; light comes from the azimuth 0.

    >>> medium = SmithMedium(0.5, heights="uniform")
    >>> emerged = medium.walk(0.5, 20000, np.random.default_rng(1))
    >>> emerged.inside, bool((emerged.directions[:, 2] > 0).all()), round(float(emerged.orders.mean()), 1)
    (0, True, 1.4)
    """

    alpha: float
    flakes: str = "mirror"
    heights: str = "gaussian"

    def __post_init__(self) -> None:
        require(self.alpha, self.flakes)
        if self.heights not in HEIGHTS:
            raise ValueError(f"heights are {', '.join(HEIGHTS)}, not {self.heights!r}")

    def random_points(self, n: int, rng: np.random.Generator) -> np.ndarray:
        """Heights of n random points of the surface."""
        return HEIGHTS[self.heights].inverse(np.log1p(-rng.random(n)))

    def first_hits(self, cosine: float, n: int, rng: np.random.Generator) -> np.ndarray:
        """Heights of the first collisions of light that comes from the direction of this cosine."""
        require_cosine(cosine)
        return self._next_heights(np.full(n, np.inf), np.full(n, -cosine), rng)

    def leaves(self, points: np.ndarray, cosine: float, rng: np.random.Generator) -> np.ndarray:
        """Whether light that starts at these heights in the direction of this cosine leaves without a collision."""
        require_cosine(cosine)
        return np.isinf(self._next_heights(points, np.full(points.shape, cosine), rng))

    def walk(
        self, cosine: float, n: int, rng: np.random.Generator, most: int = 256, told: Told | None = None
    ) -> Emerged:
        """Follow n paths of light from the direction of this cosine until they leave, or have had `most` collisions."""
        directions, orders = np.full((n, 3), np.nan), np.zeros(n, np.int64)
        for start in range(0, n, CHUNK):
            size = min(CHUNK, n - start)
            for order, (number, _, toward, out) in enumerate(self._steps(cosine, size, rng, most)):
                gone = start + number[out]
                directions[gone] = toward[:, out].T
                orders[gone] = order
            if told:
                told(size)
        return Emerged(directions, orders)

    def trace(self, cosine: float, n: int, rng: np.random.Generator, most: int = 64) -> Paths:
        """As `walk`, with all points of each path. It enters and leaves at the top; it first collides above the origin.

        The top is where little of the surface is left (1 for uniform heights, 3 standard deviations for Gaussian ones),
        or the last point if that is higher.

        >>> paths = SmithMedium(0.5).trace(0.5, 3, np.random.default_rng(5))
        >>> paths.orders, paths.positions.shape
        (array([1, 2, 1]), (3, 4, 3))
        """
        top = HEIGHTS[self.heights].top
        positions, orders = np.full((n, most + 2, 3), np.nan), np.zeros(n, np.int64)
        for order, (number, points, toward, out) in enumerate(self._steps(cosine, n, rng, most)):
            if order == 0:
                entering = toward
                continue
            positions[number, order] = points.T
            beyond = np.maximum(top - points[2], 0.0) / toward[2] * toward + points
            positions[number[out], order + 1] = beyond[:, out].T
            orders[number[out]] = order
        first = positions[:, 1].T
        positions[:, 0] = (np.maximum(top - first[2], 0.0) / entering[2] * entering + first).T
        longest = int((~np.isnan(positions[:, :, 0])).sum(axis=1).max(initial=0))
        return Paths(positions[:, :longest], orders)

    def _next_heights(self, height: np.ndarray, rise: np.ndarray, rng: np.random.Generator) -> np.ndarray:
        """The heights of the next collisions along directions of the cosine `rise`; infinite for light that leaves."""
        heights = HEIGHTS[self.heights]
        shadow = lambda_ggx(np.abs(rise), self.alpha)
        depth = rng.standard_exponential(height.shape)
        with np.errstate(divide="ignore", invalid="ignore"):
            log = heights.log_cdf(height) + np.where(rise > 0.0, depth / shadow, -depth / (1.0 + shadow))
            return np.where(log < 0.0, heights.inverse(np.minimum(log, -1e-300)), np.inf)

    def _steps(self, cosine: float, n: int, rng: np.random.Generator, most: int) -> Iterator[Step]:
        require_cosine(cosine)
        number = np.arange(n)
        points = np.zeros((3, n))
        points[2] = np.inf
        toward = np.zeros((3, n))
        toward[0], toward[2] = -np.sin(np.arccos(cosine)), -cosine
        for order in range(most + 1):
            height = self._next_heights(points[2], toward[2], rng)
            out = np.isinf(height)
            yield number, points, toward, out
            on = ~out
            if order == most or not on.any():
                return
            number, toward, height, points = number[on], toward[:, on], height[on], points[:, on]
            if order:
                # level light, of infinite Lambda, collides where it is
                run = (height - points[2]) / np.where(toward[2] == 0.0, 1.0, toward[2])
                points = points + run * toward
            points[2] = height
            toward = self._scattered(toward, rng)

    def _scattered(self, toward: np.ndarray, rng: np.random.Generator) -> np.ndarray:
        viewer = -toward
        normal = self._normals(viewer, rng)
        if self.flakes == "mirror":
            away = 2.0 * (viewer * normal).sum(axis=0) * normal - viewer
        else:
            # A disc across the normal, lifted to the hemisphere: the cosine law. Normals of a height field point up.
            x, y, z = normal
            radius = np.sqrt(rng.random(x.size))
            turn = rng.uniform(0.0, 2.0 * np.pi, x.size)
            p, q, r = radius * np.cos(turn), radius * np.sin(turn), np.sqrt((1.0 - radius) * (1.0 + radius))
            k = (p * x + q * y) / (1.0 + z)
            away = np.stack([p - k * x + r * x, q - k * y + r * y, r * z - p * x - q * y])
        away /= np.linalg.norm(away, axis=0)
        return np.clip(away, -1.0, 1.0)

    def _normals(self, viewer: np.ndarray, rng: np.random.Generator) -> np.ndarray:
        """Visible normals, by the slopes: first the one toward the viewer, then the one across (Heitz and d'Eon, 2014).

        For roughness 1, the visible slope p = tan(b) toward a viewer of polar angle t has the cumulative distribution
        (sin(t + b) + cos t)/(1 + cos t), and given p the slope across is sqrt(1 + p^2) times a variable of the density
        2/(pi (1 + q^2)^2): Student's, of three degrees of freedom, over sqrt(3).
        """
        x, y, z = viewer
        across = np.hypot(x, y)
        upright = across < 1e-300
        c = np.divide(x, across, out=np.ones_like(x), where=~upright)
        s = np.divide(y, across, out=np.zeros_like(y), where=~upright)
        angle = np.arctan2(self.alpha * across, z)
        share = rng.random(z.size)
        rise = np.cos(angle)
        p = np.tan(np.arcsin(np.clip(share * (1.0 + rise) - rise, -1.0, 1.0)) - angle)
        q = np.sqrt(1.0 + p * p) * rng.standard_t(3.0, z.size) / np.sqrt(3.0)
        p, q = self.alpha * p, self.alpha * q
        return np.stack([s * q - c * p, -(s * p + c * q), np.ones_like(p)]) / np.sqrt(1.0 + p * p + q * q)
