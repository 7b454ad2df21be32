"""How wrong a method is: over the points of the bulk, cell by cell, and in each neighbourhood of trouble."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from xsec_sym.study.method import Columns, Method, Quantity
from xsec_sym.study.points import TINY, Points


@dataclass(frozen=True)
class Errors:
    """The largest found, and the 99th percentile; failures are values that are NaN or infinite and should not be.

    Relative errors and errors in units of the last place count where the right value is a normal number.
    """

    points: int
    failures: int
    max_rel: float
    p99_rel: float
    max_abs: float
    max_ulp: float
    at: tuple[float, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        return {key: _short(value) for key, value in asdict(self).items()}


def values(quantity: Quantity, method: Method, parameters: Mapping[str, Any], columns: Columns, dtype: str) -> Any:
    """What the method returns there, in float64; one that folds is made anew for each choice of the set arguments."""
    running, fixed = quantity.given(columns, dtype)
    with np.errstate(all="ignore"):
        if not (method.folds and quantity.set):
            return np.asarray(method.function(parameters)(*running, *fixed), float)
        found = np.full(running[0].shape, np.nan)
        for choice in dict.fromkeys(zip(*fixed, strict=True)):
            here = np.logical_and.reduce([column == value for column, value in zip(fixed, choice, strict=True)])
            try:
                function = method.function(parameters, tuple(map(float, choice)))
                found[here] = function(*(column[here] for column in running))
            except (ArithmeticError, ValueError):
                continue
        return found


def deviations(found: np.ndarray, points: Points, dtype: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The error, absolute, relative and in ulps; infinite where the value fails, NaN where no relative one is due."""
    with np.errstate(all="ignore"):
        absolute = np.abs((found - points.high) - points.low)
        absolute[found == points.high] = np.abs(points.low[found == points.high])
        absolute[~np.isfinite(absolute)] = np.inf
        size = np.abs(points.high)
        normal = (size > TINY[dtype]) & np.isfinite(size)
        relative = np.where(normal, absolute / size, np.nan)
        place = np.spacing(size.astype(dtype)).astype(float)
        return absolute, relative, np.where(normal, absolute / place, np.nan)


def summary(found: np.ndarray, points: Points, dtype: str) -> Errors:
    absolute, relative, ulps = deviations(found, points, dtype)
    failed = ~np.isfinite(absolute)
    counted = relative[np.isfinite(relative)]
    worst = int(np.nanargmax(np.where(np.isnan(relative), -1.0, relative))) if len(points) else 0
    return Errors(
        points=len(points),
        failures=int(failed.sum()),
        max_rel=float(counted.max(initial=0.0)),
        p99_rel=float(np.quantile(counted, 0.99)) if counted.size else 0.0,
        max_abs=float(absolute[~failed].max(initial=0.0)),
        max_ulp=float(ulps[np.isfinite(ulps)].max(initial=0.0)),
        at=tuple(float(c[worst]) for c in points.columns) if len(points) else (),
    )


def by_cell(quantity: Quantity, found: np.ndarray, points: Points, dtype: str) -> dict[str, list[Any]]:
    """The largest relative and absolute error in every cell, in the order of the arguments; None: nothing was tried.

    A failure is infinite, which JSON does not have: it is the string "inf".
    """
    absolute, relative, _ = deviations(found, points, dtype)
    place = np.zeros(len(points), int)
    for argument, column in zip(quantity.arguments, points.columns, strict=True):
        inner = np.asarray(argument.edges[1:-1])
        place = place * (len(argument.edges) - 1) + np.searchsorted(inner, column, side="right")
    cells = int(np.prod(quantity.shape))
    told: dict[str, list[Any]] = {}
    for name, error in (("max_rel", relative), ("max_abs", absolute)):
        largest = np.full(cells, -1.0)
        known = ~np.isnan(error)
        np.maximum.at(largest, place[known], error[known])
        if name == "max_rel":
            # a cell in which the right value underflows everywhere has no relative error, and no failure either
            largest[np.setdiff1d(place, place[known])] = 0.0
        told[name] = [_short(float(value), 2) if value >= 0 else None for value in largest]
    return told


def _short(value: Any, digits: int = 3) -> Any:
    """So many digits, rounded up, for no error is to look smaller than it is; "inf" for what JSON cannot hold."""
    if isinstance(value, float):
        if np.isinf(value) or value <= 0.0:
            return "inf" if value > 0 else 0.0
        unit = 10.0 ** (np.floor(np.log10(value)) - digits + 1)
        rounded = np.ceil(value / unit) * unit if unit > 0 else value
        return float(f"{rounded:.{digits}g}")
    if isinstance(value, tuple):
        return [float(f"{v:.17g}") for v in value]
    return value
