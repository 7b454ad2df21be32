"""What a walk gives back. No transport: the two walks have nothing else in common."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

Vector = tuple[np.ndarray, np.ndarray, np.ndarray]
# Called with the number of paths that have ended since the last call.
Told = Callable[[int], object]
FLAKES = ("mirror", "diffuse")


@dataclass(frozen=True)
class Emerged:
    """Where paths went: `directions` (n, 3), unit vectors of travel after the last collision, and `orders` (n,).

    An order is a number of collisions, 1 or more. A path cut off inside has the order 0 and NaN for its direction.
    """

    directions: np.ndarray
    orders: np.ndarray

    @property
    def inside(self) -> int:
        """How many paths were cut off before they left."""
        return int((self.orders == 0).sum())


@dataclass(frozen=True)
class Paths:
    """The points of paths, to be drawn: `positions` (n, longest, 3) and `orders` as in `Emerged`.

    A path of the order k has k + 2 points: where it enters, k collisions, where it leaves; NaN fills the rest. A path
    cut off inside (order 0) ends with its last collision.
    """

    positions: np.ndarray
    orders: np.ndarray


def require(alpha: float, flakes: str) -> None:
    if not 0.0 < alpha < np.inf:
        raise ValueError(f"the roughness must be a positive number, not {alpha}")
    if flakes not in FLAKES:
        raise ValueError(f"flakes are mirror or diffuse, not {flakes!r}")


def require_cosine(cosine: float) -> None:
    if not 0.0 < cosine <= 1.0:
        raise ValueError(f"the cosine of a direction above the medium is in (0, 1], not {cosine}")
