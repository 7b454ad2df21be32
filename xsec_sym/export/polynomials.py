"""Polynomials in one or two variables from values at Chebyshev nodes, as tables of doubles for a kernel."""

from __future__ import annotations

from functools import lru_cache
from textwrap import fill

from mpmath import mp, mpf

Matrix = list[list[mpf]]


def chebyshev_nodes(count: int) -> list[mpf]:
    return [mp.cos(mp.pi * (2 * j + 1) / (2 * count)) for j in range(count)]


@lru_cache
def _turn(count: int, precision: int) -> list[mpf]:
    """cos(pi j/(2 count)) for a full turn, at the working precision."""
    return [mp.cos(mp.pi * j / (2 * count)) for j in range(4 * count)]


def coefficients(values: list[mpf]) -> list[mpf]:
    """Of the Chebyshev polynomials, for the interpolant of these values at the nodes."""
    count = len(values)
    cosines = _turn(count, mp.prec)
    return [
        mp.fdot((cosines[i * (2 * j + 1) % (4 * count)], value) for j, value in enumerate(values))
        * (1 if i == 0 else 2)
        / count
        for i in range(count)
    ]


def powers(series: list[mpf]) -> list[mpf]:
    """A sum of Chebyshev polynomials as one of powers, lowest first."""
    before, now = [mpf(1)], [mpf(0), mpf(1)]
    total = [mpf(0)] * len(series)
    for coefficient in series:
        for i, part in enumerate(before):
            total[i] += coefficient * part
        after = [mpf(0)] + [2 * part for part in now]
        for i, part in enumerate(before):
            after[i] -= part
        before, now = now, after
    return total


def shortened(table: Matrix, left_out: mpf) -> Matrix:
    """`table` with its smallest entries set to 0, of the sum `left_out` at most."""
    entries = sorted((abs(entry), i, j) for i, row in enumerate(table) for j, entry in enumerate(row))
    short, total = [list(row) for row in table], mpf(0)
    for size, i, j in entries:
        total += size
        if total > left_out:
            break
        short[i][j] = mpf(0)
    return short


def transposed(table: Matrix) -> Matrix:
    return [list(column) for column in zip(*table, strict=True)]


def polynomial(values: Matrix, left_out: mpf) -> list[list[float]]:
    """values[i][j] at the i-th node of x and the j-th of y: rows by the power of y, none longer than that before.

    `left_out` is what the terms left out of the sum of products of Chebyshev polynomials may add up to.
    """
    series = transposed([coefficients(column) for column in transposed([coefficients(row) for row in values])])
    short = shortened(series, left_out)
    # What is 0 among the series, toward the highest powers, is 0 among the powers.
    rows = [powers(row) for row in transposed([powers(row) for row in short])]
    table: list[list[float]] = []
    for row in reversed(rows):
        used = max((i + 1 for i, entry in enumerate(row) if entry), default=0)
        length = max(used, len(table[0]) if table else 0)
        if length:
            table.insert(0, [float(entry) for entry in row[:length]])
    return table


def written(row: list[float]) -> str:
    """The numbers of a row, indented, in lines of four."""
    lines = [", ".join(map(repr, row[i : i + 4])) for i in range(0, len(row), 4)]
    return "".join(f"        {line},\n" for line in lines)


def packed(row: list[float], indent: int) -> str:
    """The numbers of a row as a list, in lines as full as they go."""
    return fill(", ".join(map(repr, row)), 117, initial_indent=" " * indent + "[", subsequent_indent=" " * indent + " ")
