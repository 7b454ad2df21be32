"""Judge walks: against the closed forms of Smith's theory, and against each other."""

from dataclasses import dataclass
from math import erfc, sqrt
from typing import Protocol

import numpy as np
from scipy.special import chdtrc

from xsec_sym.kernels import lambda_ggx, ndf_ggx
from xsec_sym.walks.paths import Emerged

# A cell with fewer expected paths is joined with others of its kind.
FEWEST = 25
SIDES = 16


class Medium(Protocol):
    """What both media offer."""

    @property
    def alpha(self) -> float: ...
    def random_points(self, n: int, rng: np.random.Generator) -> np.ndarray: ...
    def first_hits(self, cosine: float, n: int, rng: np.random.Generator) -> np.ndarray: ...
    def leaves(self, points: np.ndarray, cosine: float, rng: np.random.Generator) -> np.ndarray: ...


@dataclass(frozen=True)
class Check:
    """One test: its p-value, and for a probability the closed form, the estimate and its standard error."""

    quantity: str
    p_value: float
    exact: float | None = None
    estimate: float | None = None
    error: float | None = None
    # chi-squared and its degrees of freedom
    statistic: float | None = None
    freedom: int | None = None

    @property
    def score(self) -> float | None:
        """The distance from the closed form in standard errors."""
        if self.exact is None or self.estimate is None or self.error is None:
            return None
        return (self.estimate - self.exact) / self.error


def share(quantity: str, exact: float, hits: int, n: int) -> Check:
    """Test that `hits` of `n` are of the probability `exact`; its standard error is that of the closed form.

    >>> check = share("heads", 0.5, 5100, 10000)
    >>> round(check.score, 2), round(check.p_value, 4)
    (2.0, 0.0455)
    """
    error = sqrt(exact * (1.0 - exact) / n)
    score = (hits / n - exact) / error
    return Check(quantity, erfc(abs(score) / sqrt(2.0)), exact, hits / n, error)


def visibility(medium: Medium, cosine_i: float, cosine_o: float, n: int, rng: np.random.Generator) -> list[Check]:
    """Smith's functions as frequencies: `dupuy2016:20`, `dupuy2016:21` and the last line of `dupuy2016:22`.

    >>> from xsec_sym.walks.homogeneous import HomogeneousMedium
    >>> checks = visibility(HomogeneousMedium(0.5), 0.3, 0.7, 10000, np.random.default_rng(2))
    >>> [check.quantity for check in checks], all(check.p_value > 1e-3 for check in checks)
    (['G1', 'G2', 'G2 / G1'], True)
    """
    lam_i, lam_o = (float(lambda_ggx(cosine, medium.alpha)) for cosine in (cosine_i, cosine_o))
    points = medium.random_points(n, rng)
    seen = medium.leaves(points, cosine_i, rng)
    both = seen & medium.leaves(points, cosine_o, rng)
    again = medium.leaves(medium.first_hits(cosine_i, n, rng), cosine_o, rng)
    return [
        share("G1", 1.0 / (1.0 + lam_i), int(seen.sum()), n),
        share("G2", 1.0 / (1.0 + lam_i + lam_o), int(both.sum()), n),
        share("G2 / G1", (1.0 + lam_i) / (1.0 + lam_i + lam_o), int(again.sum()), n),
    ]


def single_bounce(cosine: np.ndarray | float, azimuth: np.ndarray | float, cosine_i: float, alpha: float) -> np.ndarray:
    """The density (1/sr) of light that leaves after one mirror flake: D(h) G2/(4 cos theta_i), for albedo 1.

    cosine, azimuth: of the direction in which it leaves; it came from the azimuth 0.

    >>> at_mirror = single_bounce(0.8, np.pi, 0.8, 0.1)
    >>> bool(at_mirror > 50 * single_bounce(0.8, 0.0, 0.8, 0.1))
    True
    """
    s_i, s_o = (np.sqrt((1.0 - c) * (1.0 + c)) for c in (cosine_i, cosine))
    h_x, h_y, h_z = s_i + s_o * np.cos(azimuth), s_o * np.sin(azimuth), cosine_i + cosine
    h = np.minimum(h_z / np.sqrt(h_x * h_x + h_y * h_y + h_z * h_z), 1.0)
    g2 = 1.0 / (1.0 + lambda_ggx(cosine_i, alpha) + lambda_ggx(cosine, alpha))
    return np.asarray(ndf_ggx(h, alpha) * g2 / (4.0 * cosine_i))


def first_order(emerged: Emerged, cosine_i: float, alpha: float) -> list[Check]:
    """Mirror flakes: how much light leaves after one bounce, and into which directions, against the closed form."""
    n = emerged.orders.size
    once = emerged.directions[emerged.orders == 1]
    heights, azimuths = np.linspace(0.0, 1.0, SIDES + 1), np.linspace(-np.pi, np.pi, SIDES + 1)
    nodes, weights = np.polynomial.legendre.leggauss(32)
    at = [edges[:-1, None] + np.diff(edges)[:, None] * (nodes + 1.0) / 2.0 for edges in (heights, azimuths)]
    density = single_bounce(at[0][:, :, None, None], at[1][None, None], cosine_i, alpha)
    cell = (heights[1] - heights[0]) * (azimuths[1] - azimuths[0]) / 4.0
    expected = n * cell * np.einsum("aibj,i,j->ab", density, weights, weights)
    counts = np.histogram2d(once[:, 2], np.arctan2(once[:, 1], once[:, 0]), [heights, azimuths])[0]
    total = expected.sum() / n
    # Paths of higher orders are a cell of their own.
    table = [np.append(part.ravel(), n - part.sum()) for part in (counts, expected)]
    return [share("one bounce", float(total), len(once), n), _fits("directions, one bounce", *table)]


def same_directions(one: Emerged, other: Emerged) -> Check:
    """The chi-squared test that two walks send light into the same directions.

    Cells have edges at quantiles of the cosine and of the azimuth of both walks' directions taken together, which are
    the same when the walks are exchanged; a path cut off inside is a cell of its own.
    """
    walks = (one, other)
    parts = [walk.directions[walk.orders > 0] for walk in walks]
    both = np.concatenate(parts)
    steps = np.linspace(0.0, 1.0, SIDES + 1)
    edges = [np.quantile(both[:, 2], steps), np.quantile(np.arctan2(both[:, 1], both[:, 0]), steps)]
    tables = [
        np.append(np.histogram2d(part[:, 2], np.arctan2(part[:, 1], part[:, 0]), edges)[0].ravel(), walk.inside)
        for part, walk in zip(parts, walks, strict=True)
    ]
    return _homogeneous("directions", *tables)


def same_orders(one: Emerged, other: Emerged) -> Check:
    """The chi-squared test that two walks have the same orders of scattering; a path cut off inside has its own."""
    longest = int(max(one.orders.max(initial=0), other.orders.max(initial=0)))
    return _homogeneous("orders", *(np.bincount(walk.orders, minlength=longest + 1) for walk in (one, other)))


def _fits(quantity: str, counts: np.ndarray, expected: np.ndarray) -> Check:
    counts, expected = _joined(expected, counts, expected)
    statistic = float(((counts - expected) ** 2 / expected).sum())
    freedom = counts.size - 1
    return Check(quantity, float(chdtrc(freedom, statistic)), statistic=statistic, freedom=freedom)


def _homogeneous(quantity: str, one: np.ndarray, other: np.ndarray) -> Check:
    """Two samples of any sizes, cell by cell."""
    one, other = _joined(np.minimum(one.sum(), other.sum()) / (one.sum() + other.sum()) * (one + other), one, other)
    n, m = one.sum(), other.sum()
    statistic = float(((one * np.sqrt(m / n) - other * np.sqrt(n / m)) ** 2 / (one + other)).sum())
    freedom = one.size - 1
    return Check(quantity, float(chdtrc(freedom, statistic)), statistic=statistic, freedom=freedom)


def _joined(expected: np.ndarray, *tables: np.ndarray) -> list[np.ndarray]:
    """The tables with all cells in which few are expected as one, which joins the smallest of the others if it must."""
    rare = expected < FEWEST
    if rare.any() and expected[rare].sum() < FEWEST and not rare.all():
        rare |= expected == expected[~rare].min()
    return [np.append(table[~rare], table[rare].sum()) if rare.any() else table for table in tables]


def holds(checks: list[Check], level: float = 1e-4) -> list[bool]:
    """Whether each p-value is above `level` shared equally among all (Bonferroni's correction).

    >>> holds([Check("a", 0.3), Check("b", 6e-5), Check("c", 4e-5)], level=1.5e-4)
    [True, True, False]
    """
    return [check.p_value >= level / len(checks) for check in checks]
