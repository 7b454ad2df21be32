"""Where methods are tried, and what is right there.

The points of the bulk fill every cell of the domain; those of a neighbourhood of trouble are kept apart. All are drawn
from a seed, and none is a point that a table or a fit was made with. The right values are pairs of doubles.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from joblib import Parallel, delayed
from mpmath import mp, mpf

from xsec_sym.study.method import Argument, Columns, Function, Quantity, registered

BULK = "bulk"
TINY = {"float64": 1e-300, "float32": 1e-37}
DIGITS = 40
PARTS = 64


@dataclass(frozen=True)
class Points:
    """Points with the same `set` arguments or with various ones, as columns, and what is right there, high + low."""

    label: str
    columns: Columns
    high: np.ndarray
    low: np.ndarray

    def __len__(self) -> int:
        return int(self.high.size)

    def taken(self, chosen: np.ndarray) -> Points:
        return Points(self.label, tuple(c[chosen] for c in self.columns), self.high[chosen], self.low[chosen])


def bulk(quantity: Quantity, rng: np.random.Generator) -> Columns:
    """A few values of the set arguments in each of their cells, and with each some points in every running cell."""
    outer, inner = quantity.per_cell
    rows = []
    for cell in _cells(quantity.set):
        for fixed in zip(*_drawn(quantity.set, cell, rng, outer), strict=True) if quantity.set else [()]:
            for part in _cells(quantity.running):
                drawn = _drawn(quantity.running, part, rng, inner)
                rows.append([*drawn, *(np.full(inner, value) for value in fixed)])
    return tuple(np.concatenate(column) for column in zip(*rows, strict=True))


def within(quantity: Quantity, ranges: dict[str, tuple[float, float]], rng: np.random.Generator, n: int) -> Columns:
    """n points with every argument in its range, its ends among them."""
    columns = []
    for argument in quantity.arguments:
        low, high = ranges.get(argument.name, (argument.low, argument.high))
        drawn = argument.draw(rng, n, low, high)
        drawn[rng.random(n) < 0.06] = low
        drawn[rng.random(n) < 0.06] = high
        columns.append(drawn)
    return tuple(columns)


def _cells(arguments: Sequence[Argument]) -> product:
    return product(*(zip(a.edges, a.edges[1:], strict=False) for a in arguments))


def _drawn(
    arguments: Sequence[Argument], cell: tuple[tuple[float, float], ...], rng: np.random.Generator, n: int
) -> list[np.ndarray]:
    return [a.draw(rng, n, low, high) for a, (low, high) in zip(arguments, cell, strict=True)]


def right(quantity: Quantity, label: str, columns: Columns, dtype: str = "float64", jobs: int = 1) -> Points:
    """The points as numbers of `dtype`, with the reference's values."""
    columns = tuple(np.asarray(c, dtype).astype(np.float64) for c in columns)
    running, fixed = quantity.given(columns, dtype)
    if quantity.references is not None:
        high = np.asarray(quantity.references(*running, *fixed), float)
        return Points(label, columns, high, np.zeros_like(high))
    rows = list(zip(*running, *fixed, strict=True))
    parts = [rows[k : k + PARTS] for k in range(0, len(rows), PARTS)]
    if jobs == 1:
        done = [_values(quantity.reference, part) for part in parts]
    else:
        # by name, for a reference may hold numbers that do not travel between processes
        done = Parallel(n_jobs=jobs)(delayed(_registered_values)(quantity.name, part) for part in parts)
    pairs = np.array([pair for part in done for pair in part]).reshape(-1, 2)
    return Points(label, columns, pairs[:, 0], pairs[:, 1])


def _values(reference: Function, rows: Sequence[Sequence[float]]) -> list[tuple[float, float]]:
    with mp.workdps(DIGITS):
        return [_pair(reference(*map(float, row))) for row in rows]


def _registered_values(name: str, rows: Sequence[Sequence[float]]) -> list[tuple[float, float]]:
    return _values(registered(name).quantity.reference, rows)


def _pair(value: object) -> tuple[float, float]:
    with mp.workdps(DIGITS):
        exact = mpf(value)
        high = float(exact)
        return high, float(exact - mpf(high)) if np.isfinite(high) else 0.0


def condition(quantity: Quantity, columns: Columns, jobs: int = 1) -> np.ndarray:
    """The sum over the arguments of |x f'(x)/f(x)|, by differences of the reference: what a rounded argument costs."""
    here = right(quantity, "", columns, jobs=jobs)
    total = np.zeros(len(here))
    for k, argument in enumerate(quantity.arguments):
        if argument.integer:
            continue
        x = here.columns[k]
        middle = (argument.low + argument.high) / 2
        step = np.maximum(np.abs(x), 1e-12) * 2.0**-30
        moved = np.where(x > middle, x - step, x + step)
        there = right(quantity, "", (*here.columns[:k], moved, *here.columns[k + 1 :]), jobs=jobs)
        with np.errstate(all="ignore"):
            slope = ((there.high - here.high) + (there.low - here.low)) / (moved - x)
            share = np.abs(x * slope / here.high)
        total += np.where(np.isfinite(share), share, 0.0)
    return total
