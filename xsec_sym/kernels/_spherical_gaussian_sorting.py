"""Points of the plane of u and alpha brought together by region, and by cell where they are many."""

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from xsec_sym.kernels import _spherical_gaussian_regions as regions
from xsec_sym.kernels._spherical_gaussian_regions import Grid, Points, Region

# From so many on points are evaluated cell by cell, while fewer gather the coefficients of their cells: so many at once
# of those, and of one region.
MANY, FEW, CHUNK = 8192, 2048, 2**14


class Group(NamedTuple):
    """Points of one region, with their places; the cell of each, or what is in each cell; and the polynomials there."""

    region: Region
    places: np.ndarray
    points: Points
    cells: np.ndarray | list[tuple[int, slice]]
    found: np.ndarray

    def of(self, grid: Grid) -> np.ndarray:
        """The polynomials of another grid."""
        return _found(grid, *self.region.variables(self.points), self.cells)


class Joint(NamedTuple):
    """Points of all regions, each in its slice, with their places, their cells, and the polynomials there."""

    places: np.ndarray
    points: Points
    cells: np.ndarray
    found: np.ndarray
    inside: list[slice]

    def groups(self) -> Iterator[Group]:
        for region, part in zip(regions.REGIONS, self.inside, strict=True):
            if part.start < part.stop:
                yield Group(region, self.places[part], self.points.at(part), self.cells[part], self.found[part])


def _found(grid: Grid, x: np.ndarray, y: np.ndarray, cells: np.ndarray | list[tuple[int, slice]]) -> np.ndarray:
    if isinstance(cells, np.ndarray):
        return grid(x, y, cells)
    return np.concatenate([grid(x[inside], y[inside], cell) for cell, inside in cells])


class Left:
    """The places of u and alpha that are left to the polynomials of `grid`."""

    def __init__(self, grid: Grid, u: np.ndarray, alpha: np.ndarray) -> None:
        self.grid, self.u, self.alpha = grid, u, alpha
        self.places: list[np.ndarray] = []
        self.numbers: list[np.ndarray] = []
        self.few = False

    def add(self, start: int, chosen: np.ndarray, p: Points) -> None:
        """Those chosen of points from the place `start` on; with the numbers of their regions if they are all and few,
        else of their cells.
        """
        if chosen.size:
            self.few = p.v.size == self.u.size and chosen.size < MANY
            some = p.v[chosen], p.s[chosen], p.a[chosen], p.kappa[chosen]
            self.places.append(chosen + start)
            self.numbers.append(regions.numbers(*some) if self.few else regions.cells(self.grid, *some))

    def joint(self) -> Iterator[Joint]:
        """Where they are few."""
        for start in range(0, self.places[0].size, FEW):
            part = slice(start, start + FEW)
            numbers = self.numbers[0][part]
            places = self.places[0][part][np.argsort(numbers, kind="stable")]
            ends = np.cumsum(np.bincount(numbers, minlength=len(regions.REGIONS))).tolist()
            inside = [slice(*ends) for ends in pairwise([0, *ends])]
            p = regions.points(self.u[places], self.alpha[places])
            x, y, cells = np.empty_like(p.v), np.empty_like(p.v), np.empty(p.v.size, np.uint8)
            # Cells are told apart in the precision that they are where points are many.
            dtype = self.grid.joined.dtype.type
            rounded = None if dtype is np.float64 else regions.points(p.u, p.alpha, dtype)
            for region, patches, first, own in zip(
                regions.REGIONS, self.grid.parts, self.grid.firsts, inside, strict=False
            ):
                if own.start < own.stop:
                    x[own], y[own] = region.variables(p.at(own))
                    variables = (x[own], y[own]) if rounded is None else region.variables(rounded.at(own))
                    cells[own] = patches.cell(*variables)
                    cells[own] += first
            yield Joint(places, p, cells, self.grid(x, y, cells), inside)

    def groups(self) -> Iterator[Group]:
        if self.few:
            for joint in self.joint():
                yield from joint.groups()
        elif self.places:
            places, cells = np.concatenate(self.places), np.concatenate(self.numbers)
            places = places[np.argsort(cells, kind="stable")]
            ends = [0, *np.cumsum(np.bincount(cells, minlength=self.grid.firsts[-1])).tolist()]
            for region, (first, last) in zip(regions.REGIONS, pairwise(self.grid.firsts), strict=True):
                for start in range(ends[first], ends[last], CHUNK):
                    stop = min(start + CHUNK, ends[last])
                    chosen = places[start:stop]
                    p = regions.points(self.u[chosen], self.alpha[chosen])
                    cut = np.clip(ends[first : last + 1], start, stop) - start
                    inside = [
                        (first + i, slice(*pair)) for i, pair in enumerate(pairwise(cut.tolist())) if pair[0] < pair[1]
                    ]
                    yield Group(region, chosen, p, inside, _found(self.grid, *region.variables(p), inside))
