"""Functions of two variables, polynomial on every cell of a grid."""

from itertools import pairwise

import numpy as np

from xsec_sym.kernels._support import scalar


class Patches:
    """Polynomials in x and y, each on its cell of a grid: Horner's rule for all powers of y at once, then by power.

    Plain products and sums, element by element and in one order: a value depends neither on its place in an array nor
    on the length of that.

    x, y: the edges of the cells, rising. cells: for every interval of y and every one of x within it, the rows of its
    table by powers of y, each by powers of x, lowest first, no row longer than the one before, in variables that run
    from -1 to 1 over the cell. Beyond the edges the next cell is continued. dtype: that of the arithmetic.
    """

    def __init__(
        self,
        x: list[float],
        y: list[float],
        cells: list[list[list[float]]],
        dtype: type[np.floating] = np.float64,
    ) -> None:
        self.across = len(x) - 1
        self.x, self.y = x[1:-1], y[1:-1]
        edges = np.array([(*x[i : i + 2], *y[j : j + 2]) for j in range(len(y) - 1) for i in range(self.across)])
        middles = 0.5 * (edges[:, 1] + edges[:, 0]), 0.5 * (edges[:, 3] + edges[:, 2])
        scales = 2.0 / (edges[:, 1] - edges[:, 0]), 2.0 / (edges[:, 3] - edges[:, 2])
        self.middles, self.scales = np.array(middles, dtype), np.array(scales, dtype)
        # By cell, of either variable.
        self.places = np.stack([self.middles, self.scales]).transpose(2, 1, 0).tolist()
        # For every power of x, highest first, its coefficient in the rows that have it, which come first.
        self.columns = [
            [
                np.array([row[power] for row in table if len(row) > power], dtype)[:, np.newaxis]
                for power in reversed(range(len(table[0])))
            ]
            for table in cells
        ]
        self.lists = [[np.array(row[::-1], dtype).tolist() for row in reversed(table)] for table in cells]

    def __len__(self) -> int:
        return len(self.columns)

    def cell(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """The number of the cell of each point."""
        number = _passed(self.y, y)
        if self.across > 1:
            number *= np.uint8(self.across)
            number += _passed(self.x, x)
        return number

    def cell_of_one(self, x: float, y: float) -> int:
        return int(self.across * sum(y > edge for edge in self.y) + sum(x > edge for edge in self.x))

    def __call__(self, x: np.ndarray, y: np.ndarray, cell: int) -> np.ndarray:
        """At points of one cell."""
        if y.size == 1:
            return np.full_like(y, self.one(scalar(x), scalar(y), cell))
        x = (x - self.middles[0, cell]) * self.scales[0, cell]
        y = (y - self.middles[1, cell]) * self.scales[1, cell]
        columns = self.columns[cell]
        rows = np.empty((len(columns[-1]), y.size), y.dtype)
        done = 0
        for column in columns:
            active, more = rows[:done], len(column)
            active *= x
            active += column[:done]
            rows[done:more] = column[done:]
            done = more
        return _sum(rows, y)

    def one(self, x: float, y: float, cell: int) -> float:
        """The same products and sums at a single point, without a call for each."""
        (middle, scale), (centre, height) = self.places[cell]
        x, y = (x - middle) * scale, (y - centre) * height
        total = 0.0
        for row in self.lists[cell]:
            part = 0.0
            for coefficient in row:
                part = part * x + coefficient
            total = total * y + part
        return total


class Joined:
    """The polynomials of several `Patches`, for points that are few in each cell: all in as many calls as for one.

    Cells are numbered through. A shorter table has zeros before its coefficients, so that values are the same.
    """

    def __init__(self, parts: list[Patches]) -> None:
        tables = [table for part in parts for table in part.lists]
        self.middles = np.concatenate([part.middles for part in parts], axis=1)
        self.scales = np.concatenate([part.scales for part in parts], axis=1)
        rows, powers = max(map(len, tables)), max(len(table[-1]) for table in tables)
        self.dtype = self.middles.dtype
        padded, used = np.zeros((powers, rows, len(tables)), self.dtype), np.zeros(powers, int)
        for i, table in enumerate(tables):
            for j, row in enumerate(reversed(table)):
                padded[powers - len(row) :, j, i] = row
                used[powers - len(row) :] = np.maximum(used[powers - len(row) :], j + 1)
        # By power of x, highest first, the coefficients of each power of y that any cell has.
        self.padded = np.concatenate([part[:count] for part, count in zip(padded, used, strict=True)])
        self.ends = np.cumsum(used).tolist()

    def __call__(self, x: np.ndarray, y: np.ndarray, cells: np.ndarray) -> np.ndarray:
        """At points each with the number of its own cell."""
        order = np.argsort(cells, kind="stable")
        x, y = x[order], y[order]
        # What is repeated in runs costs less than half of what is gathered point by point.
        many = np.bincount(cells, minlength=self.padded.shape[1])
        middles, scales = np.repeat(self.middles, many, axis=1), np.repeat(self.scales, many, axis=1)
        x, y = (x - middles[0]) * scales[0], (y - middles[1]) * scales[1]
        own = np.repeat(self.padded, many, axis=1)
        rows = np.zeros((self.ends[-1] - self.ends[-2], y.size), self.dtype)
        # Arrays of one shape cost less than a row that is repeated, where rows are short.
        x = np.repeat(x[np.newaxis], len(rows), axis=0)
        for start, end in pairwise([0, *self.ends]):
            active = rows[: end - start]
            active *= x[: end - start]
            active += own[start:end]
        found = np.empty_like(y)
        found[order] = _sum(rows, y)
        return found


def _passed(edges: list[float], x: np.ndarray) -> np.ndarray:
    """How many of the edges x is beyond."""
    if not edges:
        return np.zeros(x.shape, np.uint8)
    first, *rest = edges
    number = (x > first).view(np.uint8)
    for edge in rest:
        number += (x > edge).view(np.uint8)
    return number


def _sum(rows: np.ndarray, y: np.ndarray) -> np.ndarray:
    """By powers of y, in the last row."""
    total = rows[-1]
    for row in rows[-2::-1]:
        total *= y
        total += row
    return total
