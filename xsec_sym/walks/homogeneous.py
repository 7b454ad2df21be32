"""Light in a homogeneous half-space z <= 0 of one-sided microflakes: exponential free paths (`dupuy2016` section 2)."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from xsec_sym.kernels import sample_visible_ggx, sigma_ggx
from xsec_sym.walks.paths import Emerged, Paths, Told, Vector, require, require_cosine

CHUNK = 1 << 16

# The numbers of the paths under way, where they stand, where they head for, and which of them leave.
Flight = tuple[np.ndarray, Vector, Vector, np.ndarray]


@dataclass(frozen=True)
class HomogeneousMedium:
    """A half-space z <= 0 of constant density, whose flakes have GGX normals of roughness `alpha` and albedo 1.

    Light that travels along omega meets flakes at the rate sigma(omega) = sigma_ggx(-omega_z, alpha) per unit length
    (`dupuy2016:4`, `dupuy2016:9`), and is mirrored or spread diffusely about a normal that is visible from -omega
    (`dupuy2016:5`, `dupuy2016:6`). alpha: positive, without unit. flakes: "mirror" or "diffuse"; ValueError otherwise.

    Directions of view and of light are given by the cosine to the z-axis, in (0, 1]; light comes from the azimuth 0.

    >>> medium = HomogeneousMedium(0.5)
    >>> emerged = medium.walk(0.5, 20000, np.random.default_rng(1))
    >>> emerged.inside, bool((emerged.directions[:, 2] > 0).all()), round(float(emerged.orders.mean()), 1)
    (0, True, 1.4)
    """

    alpha: float
    flakes: str = "mirror"

    def __post_init__(self) -> None:
        require(self.alpha, self.flakes)

    def rate(self, rise: np.typing.ArrayLike) -> np.ndarray:
        """Collisions per unit length along directions of travel of the cosine `rise`: the cross-section sigma."""
        return np.asarray(sigma_ggx(-np.asarray(rise), self.alpha))

    def random_points(self, n: int, rng: np.random.Generator) -> np.ndarray:
        """Depths z <= 0 of n random points (`dupuy2016:16`)."""
        return -rng.standard_exponential(n)

    def first_hits(self, cosine: float, n: int, rng: np.random.Generator) -> np.ndarray:
        """Depths of the first collisions of light that comes from the direction of this cosine."""
        require_cosine(cosine)
        return -cosine * rng.standard_exponential(n) / self.rate(-cosine)

    def leaves(self, points: np.ndarray, cosine: float, rng: np.random.Generator) -> np.ndarray:
        """Whether light that starts at these depths in the direction of this cosine leaves without a collision."""
        require_cosine(cosine)
        with np.errstate(divide="ignore"):
            free_path = rng.standard_exponential(points.shape) / self.rate(cosine)
        return points + cosine * free_path > 0.0

    def walk(
        self, cosine: float, n: int, rng: np.random.Generator, most: int = 256, told: Told | None = None
    ) -> Emerged:
        """Follow n paths of light from the direction of this cosine until they leave, or have had `most` collisions."""
        directions, orders = np.full((n, 3), np.nan), np.zeros(n, np.int64)
        for start in range(0, n, CHUNK):
            size = min(CHUNK, n - start)
            for order, (number, _, toward, out) in enumerate(self._flights(cosine, size, rng, most)):
                gone = start + number[out]
                directions[gone] = np.stack(toward, axis=1)[out]
                orders[gone] = order
            if told:
                told(size)
        return Emerged(directions, orders)

    def trace(self, cosine: float, n: int, rng: np.random.Generator, most: int = 64) -> Paths:
        """As `walk`, with all points of each path. It enters at the origin and leaves at z = 0.

        >>> paths = HomogeneousMedium(0.5).trace(0.5, 3, np.random.default_rng(1))
        >>> paths.orders, paths.positions.shape
        (array([1, 1, 2]), (3, 4, 3))
        """
        positions, orders = np.full((n, most + 2, 3), np.nan), np.zeros(n, np.int64)
        for order, (number, point, toward, out) in enumerate(self._flights(cosine, n, rng, most)):
            at, heading = np.stack(point, axis=1), np.stack(toward, axis=1)
            positions[number, order] = at
            positions[number[out], order + 1] = (at - at[:, 2:] / heading[:, 2:] * heading)[out]
            orders[number[out]] = order
        longest = int((~np.isnan(positions[:, :, 0])).sum(axis=1).max(initial=0))
        return Paths(positions[:, :longest], orders)

    def _flights(self, cosine: float, n: int, rng: np.random.Generator, most: int) -> Iterator[Flight]:
        require_cosine(cosine)
        number = np.arange(n)
        x, y, z = np.zeros((3, n))
        toward: Vector = (np.full(n, -np.sqrt((1.0 - cosine) * (1.0 + cosine))), np.zeros(n), np.full(n, -cosine))
        for order in range(most + 1):
            with np.errstate(divide="ignore"):
                free_path = rng.standard_exponential(number.size) / self.rate(toward[2])
            below = z + free_path * toward[2]
            # Every path enters: its first collision is below the top whatever the rounding.
            out = below > 0.0 if order else np.zeros(n, bool)
            yield number, (x, y, z), toward, out
            on = ~out
            if order == most or not on.any():
                return
            number, free_path, z = number[on], free_path[on], below[on]
            toward = (toward[0][on], toward[1][on], toward[2][on])
            x, y = x[on] + free_path * toward[0], y[on] + free_path * toward[1]
            toward = self._scattered(toward, rng)

    def _scattered(self, toward: Vector, rng: np.random.Generator) -> Vector:
        x, y, z = toward
        across = np.hypot(x, y)
        # The azimuth of the viewer, who looks back along the light.
        upright = across == 0.0
        c = np.where(upright, 1.0, -x / np.where(upright, 1.0, across))
        s = np.where(upright, 0.0, -y / np.where(upright, 1.0, across))
        n = x.size
        a, b, m_z = sample_visible_ggx(-z, self.alpha, rng.random(n), rng.random(n))
        m_x, m_y = c * a - s * b, s * a + c * b
        if self.flakes == "mirror":
            twice = 2.0 * (x * m_x + y * m_y + z * m_z)
            x, y, z = x - twice * m_x, y - twice * m_y, z - twice * m_z
        else:
            # The normal plus a point of the unit sphere: the cosine law.
            height, turn = 2.0 * rng.random(n) - 1.0, 2.0 * np.pi * rng.random(n)
            radius = np.sqrt(1.0 - height * height)
            x, y, z = m_x + radius * np.cos(turn), m_y + radius * np.sin(turn), m_z + height
        length = np.sqrt(x * x + y * y + z * z)
        return x / length, y / length, np.clip(z / length, -1.0, 1.0)


@dataclass(frozen=True)
class TwoSidedMedium(HomogeneousMedium):
    """A control: the same flakes, met at the same rate along a direction as against it, which no surface does.

    The rate is the mean of both, that of the symmetrised distribution of normals; collisions are as they were.

    >>> rise = np.array([-0.5, 0.5])
    >>> HomogeneousMedium(0.5).rate(rise), TwoSidedMedium(0.5).rate(rise)
    (array([0.58071891, 0.08071891]), array([0.33071891, 0.33071891]))
    """

    def rate(self, rise: np.typing.ArrayLike) -> np.ndarray:
        return 0.5 * (super().rate(rise) + super().rate(-np.asarray(rise)))
