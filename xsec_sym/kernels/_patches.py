"""Functions of two variables, polynomial on every cell of a grid."""

from itertools import pairwise

import numpy as np


class Patches:
    """Polynomials in x and y, each on its cell of a grid: Horner's rule for all powers of y at once, then by power.

    Plain products and sums, element by element and in one order: a value depends neither on its place in an array nor
    on the length of that.

    x, y: the edges of the cells, rising. cells: for every interval of y and every one of x within it, the rows of its
    table by powers of y, each by powers of x, lowest first, no row longer than the one before, in variables that run
    from -1 to 1 over the cell. Beyond the edges the next cell is continued.
    """

    def __init__(self, x: list[float], y: list[float], cells: list[list[list[float]]]) -> None:
        self.across = len(x) - 1
        self.x, self.y = x[1:-1], y[1:-1]
        edges = np.array([(*x[i : i + 2], *y[j : j + 2]) for j in range(len(y) - 1) for i in range(self.across)])
        self.middles = 0.5 * (edges[:, 1] + edges[:, 0]), 0.5 * (edges[:, 3] + edges[:, 2])
        self.scales = 2.0 / (edges[:, 1] - edges[:, 0]), 2.0 / (edges[:, 3] - edges[:, 2])
        # For every power of x, highest first, its coefficient in the rows that have it, which come first.
        self.columns = [
            [
                np.array([row[power] for row in table if len(row) > power])[:, np.newaxis]
                for power in reversed(range(len(table[0])))
            ]
            for table in cells
        ]
        self.lists = [[row[::-1] for row in reversed(table)] for table in cells]
        rows, powers = max(len(table) for table in cells), max(len(table[0]) for table in cells)
        padded, used = np.zeros((powers, rows, len(cells))), np.zeros(powers, int)
        for i, table in enumerate(cells):
            for j, row in enumerate(table):
                padded[powers - len(row) :, j, i] = row[::-1]
                used[powers - len(row) :] = np.maximum(used[powers - len(row) :], j + 1)
        # The same for all cells, with zeros where one has no such coefficient; a column of all powers.
        self.padded = np.concatenate([part[:count] for part, count in zip(padded, used, strict=True)])
        self.ends = np.cumsum(used).tolist()

    def __len__(self) -> int:
        return len(self.columns)

    def cell(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """The number of the cell of each point."""
        number = np.zeros(x.shape, np.uint8)
        for edge in self.y:
            number += (y > edge).view(np.uint8)
        if self.across > 1:
            number *= np.uint8(self.across)
        for edge in self.x:
            number += (x > edge).view(np.uint8)
        return number

    def cell_of_one(self, x: float, y: float) -> int:
        return self.across * sum(y > edge for edge in self.y) + sum(x > edge for edge in self.x)

    def __call__(self, x: np.ndarray, y: np.ndarray, cell: int | np.ndarray) -> np.ndarray:
        """At points of one cell, or each with the number of its own."""
        x = (x - self.middles[0][cell]) * self.scales[0][cell]
        y = (y - self.middles[1][cell]) * self.scales[1][cell]
        if y.size == 1:
            return np.full_like(y, self._one(x.item(), y.item(), cell if isinstance(cell, int) else cell.item()))
        if isinstance(cell, int):
            columns = self.columns[cell]
        else:
            own = np.take(self.padded, cell, axis=1)
            columns = [own[start:end] for start, end in pairwise([0, *self.ends])]
            # Arrays of one shape cost less than a row that is repeated, where rows are short.
            x = np.repeat(x[np.newaxis], len(columns[-1]), axis=0)
        rows = np.empty((len(columns[-1]), y.size))
        done = 0
        for column in columns:
            active, more = rows[:done], len(column)
            active *= x[:done] if x.ndim > 1 else x
            active += column[:done]
            rows[done:more] = column[done:]
            done = more
        total = rows[-1]
        for row in rows[-2::-1]:
            total *= y
            total += row
        return total

    def _one(self, x: float, y: float, cell: int) -> float:
        """The same products and sums, without a call for each."""
        total = 0.0
        for row in self.lists[cell]:
            part = 0.0
            for coefficient in row:
                part = part * x + coefficient
            total = total * y + part
        return total
