"""What might compute a material: every measured method, and tables made for it; with errors and costs.

Errors are the stored ones, over the cells that the material's ranges meet, or are found on points of those ranges.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from xsec_sym.kernels._support import BLOCK
from xsec_sym.planner import tables
from xsec_sym.planner.scene import Material
from xsec_sym.planner.tables import Table
from xsec_sym.study.errors import deviations
from xsec_sym.study.measure import label
from xsec_sym.study.method import Columns, Field, Function, Method, Quantity, registered
from xsec_sym.study.points import TINY, Points, right, within

# What is left of a tolerance for errors between the points that were tried.
MARGIN = 2.0
PROBES, FRESH, IN_TROUBLE = 160, 240, 12
PROBE_SEED, FRESH_SEED = 11, 1213
# Seconds for the right values of a material, and points between two looks at the clock.
SECONDS, BATCH = 4.0, 4
# Half a place of a float32, where a double is rounded to one.
ROUNDED = 6e-8
# Kernels that give the logarithm where the quantity itself underflows.
LOGARITHMS = {"sigma_spherical_gaussian": "log_sigma_spherical_gaussian"}


class Stale(ValueError):
    """The measurements do not fit the methods as they are now."""


@dataclass(frozen=True)
class Candidate:
    """A way to compute a material, `ns` nanoseconds a value and `setup` seconds at first.

    error: the largest stored one over the ranges, infinite for a failure, None where nothing was stored; least: the
    largest found between a table and its kernel.
    method and parameters, or a table, or a number where nothing is left to vary.
    """

    material: Material
    name: str
    source: str
    model: str
    ns: float
    setup: float = 0.0
    error: float | None = None
    method: Method | None = None
    parameters: Mapping[str, Any] | None = None
    table: Table | None = None
    number: float | None = None
    least: float = 0.0

    @property
    def cost(self) -> float:
        """With the set-up spread over all evaluations of a frame."""
        return self.ns + 1e9 * self.setup / self.material.evaluations

    @property
    def plain(self) -> bool:
        """A general kernel of ours, which sees to types, shapes and its domain itself."""
        return self.method is not None and self.method.ours and self.method.single and not self.method.folds

    @cached_property
    def made(self) -> Function:
        """The method's function of the running arguments if it folds, of all otherwise."""
        assert self.method is not None and self.parameters is not None
        return self.method.function(self.parameters, (self.material.folded or ()) if self.method.folds else ())

    def values(self, columns: Columns) -> np.ndarray:
        """What it returns at points with all arguments of the quantity, in float64."""
        with np.errstate(all="ignore"):
            if self.number is not None:
                found = np.full(columns[0].shape, self.number)
            elif self.table is not None:
                (place,) = (k for k, a in enumerate(self.material.quantity.arguments) if a.name in self.material.ranges)
                found = self.table(columns[place])
            else:
                found = self._by_method(columns)
        return found.astype(self.material.dtype).astype(float)

    def _by_method(self, columns: Columns) -> np.ndarray:
        assert self.method is not None
        kind = self.material.dtype if self.plain else "float64"
        running, others = self.material.quantity.given(columns, kind)
        if self.method.folds:
            others = ()
        elif self.material.folded and not self.plain:
            others = self.material.folded  # type: ignore[assignment]
        return np.broadcast_to(np.asarray(self.made(*running, *others), float), columns[0].shape)


# --- points ------------------------------------------------------------------------------------------------


def points(material: Material, seed: int, n: int) -> Points:
    """n points of the material's ranges and some of every neighbourhood of trouble, with the right values."""
    quantity = material.quantity
    rng = np.random.default_rng(seed)
    parts = [within(quantity, material.spans, rng, n)]
    for draw in quantity.trouble.values():
        drawn = [np.asarray(c, float) for c in draw(rng, 8 * IN_TROUBLE)]
        inside = np.ones(drawn[0].shape, bool)
        for k, argument in enumerate(quantity.arguments):
            low, high = material.spans[argument.name]
            if low == high:
                drawn[k] = np.full_like(drawn[k], low)
            inside &= (drawn[k] >= low) & (drawn[k] <= high)
        parts.append(tuple(c[inside][:IN_TROUBLE] for c in drawn))
    columns = [np.concatenate(c) for c in zip(*parts, strict=True)]
    for k, argument in enumerate(quantity.arguments):
        low, high = material.spans[argument.name]
        # a float32 may round to what is outside; a constant is no argument, and is not rounded
        if low != high:
            columns[k] = _rounded_inward(columns[k], low, high, material.dtype)
    order = rng.permutation(columns[0].size)
    return _as_far_as_time_allows(quantity, tuple(c[order] for c in columns))


def _as_far_as_time_allows(quantity: Quantity, columns: Columns) -> Points:
    """The right values at the first of the points: at all of them, unless a reference takes seconds for a few."""
    start, parts = time.process_time(), []
    for first in range(0, columns[0].size, BATCH):
        parts.append(right(quantity, "scene", tuple(c[first : first + BATCH] for c in columns)))
        if time.process_time() - start > SECONDS:
            break
    merged = tuple(np.concatenate(c) for c in zip(*(p.columns for p in parts), strict=True))
    return Points("scene", merged, np.concatenate([p.high for p in parts]), np.concatenate([p.low for p in parts]))


def _rounded_inward(x: np.ndarray, low: float, high: float, dtype: str) -> np.ndarray:
    typed = x.astype(dtype)
    typed = np.where(typed.astype(float) < low, np.nextafter(typed, np.array(np.inf, dtype)), typed)
    typed = np.where(typed.astype(float) > high, np.nextafter(typed, np.array(-np.inf, dtype)), typed)
    return typed.astype(float)


def largest(material: Material, found: np.ndarray, at: Points) -> float:
    """The largest error of the kind that the material limits; infinite where a value fails."""
    absolute, relative, _ = deviations(np.asarray(found, float), at, material.dtype)
    if material.error == "absolute":
        # where the right value is infinite, only that is right
        return float(absolute.max(initial=0.0))
    counted = np.where(np.isnan(relative), np.where(np.isfinite(absolute), 0.0, np.inf), relative)
    # what is too small for a relative error has to be as small
    small = np.isnan(relative) & np.isfinite(at.high) & (np.abs(found) > 2 * TINY[material.dtype])
    return float(np.where(small, np.inf, counted).max(initial=0.0))


# --- candidates ----------------------------------------------------------------------------------------------


def candidates(material: Material, data: Mapping[str, Any], costs: Mapping[str, Any] | None = None) -> list[Candidate]:
    """All there are, the cheapest first; those that cannot be written or measured are among them."""
    field = registered(material.quantity.name)
    _fits(material.quantity, data)
    found = [
        _candidate(material, method, parameters, data)
        for method, parameters in field.variants()
        if _rows(data, method, parameters, "float64")
    ]
    kernel = general(field, material, data)
    found += _tabled(material, kernel, costs)
    return sorted(found, key=lambda c: (c.cost, c.name))


def general(field: Field, material: Material, data: Mapping[str, Any]) -> Candidate:
    """The kernel for everything: of ours the most accurate that is made for nothing in particular."""
    ours = [
        (not method.name.startswith("kernel"), method.folds, float(rows[0]["max_rel"]), method, parameters)
        for method, parameters in field.variants()
        if method.ours and not method.serial and not method.needs and not method.model
        for rows in [_rows(data, method, parameters, "float64")]
        if rows
    ]
    if not ours:
        raise Stale(f"{field.quantity.name}: no kernel of it is measured")
    *_, method, parameters = min(ours, key=lambda row: row[:3])
    return _candidate(material, method, parameters, data, general=True)


def _fits(quantity: Quantity, data: Mapping[str, Any]) -> None:
    edges = {a["name"]: [float(e) for e in a["edges"]] for a in data["arguments"]}
    if edges != {a.name: list(a.edges) for a in quantity.arguments}:
        raise Stale(f"{quantity.name}: the stored measurements are of other cells; measure anew")


def _rows(data: Mapping[str, Any], method: Method, parameters: Mapping[str, Any], dtype: str) -> list[dict[str, Any]]:
    return [
        r
        for r in data["points"]
        if r["method"] == method.name and r["parameters"] == dict(parameters) and r["dtype"] == dtype
    ]


def _candidate(
    material: Material, method: Method, parameters: Mapping[str, Any], data: Mapping[str, Any], general: bool = False
) -> Candidate:
    """A measured method; `general`: for itself, as it is timed, even where the material's arguments do not fit it."""
    native = method.ours and method.single and not method.folds
    rows = _rows(data, method, parameters, material.dtype if native else "float64")
    said = label(parameters)
    if method.folds and material.folded is None and not general:
        ns, setup = math.nan, 0.0
    else:
        # what stands in `elementwise` runs on its blocks, however many values there are
        ns, setup = _time(material, rows, material.evaluations if native else min(material.evaluations, BLOCK))
    error = _cells(material, rows)
    if error is not None and not native and material.dtype == "float32":
        error += ROUNDED
    return Candidate(
        material,
        f"{method.name} ({said})" if said else method.name,
        method.source,
        method.model or material.quantity.name,
        ns + (0.0 if native or general else tables.guard(len(material.ranges))),
        setup if method.folds else 0.0,
        error,
        method,
        parameters,
    )


def _time(material: Material, rows: list[dict[str, Any]], n: int) -> tuple[float, float]:
    """Nanoseconds a value with the set arguments as the material has them, in arrays of about n; seconds of set-up."""
    arrays = [r for r in rows if not r["fixed"]]
    constant = [r for r in rows if r["fixed"]]
    folded = material.folded if material.quantity.set else None
    if folded is not None and constant:
        near = min(_apart(material, r["fixed"]) for r in constant)
        chosen = [r for r in constant if _apart(material, r["fixed"]) == near]
    else:
        chosen = arrays or constant[-1:]
    row = min(chosen, key=lambda r: abs(math.log(r["n"] / n)))
    ns = float(row["ns_median"])
    # a method with constants is timed at one size: what a call costs by itself is known from the other rows
    by_size = {r["n"]: float(r["ns_median"]) for r in arrays}
    if len({r["n"] for r in chosen}) == 1 and row["n"] in by_size and len(by_size) > 1:
        size = min(by_size, key=lambda s: abs(math.log(s / n)))
        ns += max(0.0, by_size[size] - by_size[row["n"]])
    return ns, float(row["setup_s"])


def _apart(material: Material, fixed: Mapping[str, float]) -> float:
    total = 0.0
    for argument in material.quantity.set:
        x, y = fixed[argument.name], material.constants[argument.name]
        if argument.scale == "log" and x > 0 and y > 0:
            total += abs(math.log(x / y))
        else:
            total += abs(x - y) / (argument.high - argument.low)
    return total


def _cells(material: Material, rows: list[dict[str, Any]]) -> float | None:
    """The largest error stored for the cells that the ranges meet; None where one of them was not tried."""
    cells = next((r["cells"] for r in rows if r.get("cells")), None)
    if cells is None:
        return None
    kept = np.array(
        [np.nan if e is None else float(e) for e in cells["max_rel" if material.error == "relative" else "max_abs"]]
    ).reshape(material.quantity.shape)
    spans = material.spans
    inside = kept[np.ix_(*(list(a.cells(*spans[a.name])) for a in material.quantity.arguments))]
    return None if np.isnan(inside).any() else float(inside.max())


def _tabled(material: Material, kernel: Candidate, costs: Mapping[str, Any] | None) -> Iterator[Candidate]:
    """Tables of the kernel's values, where a single argument is left."""
    quantity = material.quantity
    names = [a.name for a in quantity.arguments]
    point = [material.constants.get(name, 0.0) for name in names]
    if quantity.embed or not (kernel.plain or material.folded is not None):
        return
    if kernel.method is not None and kernel.method.folds:
        names, point = names[: len(quantity.running)], point[: len(quantity.running)]
    if not material.ranges:
        number = float(np.asarray(kernel.made(*map(np.array, point))))
        yield Candidate(material, "number", kernel.source, kernel.model, 0.0, number=number)
        return
    if len(material.ranges) > 1:
        return
    (name,) = material.ranges
    if name not in names:
        return
    if next(a for a in quantity.arguments if a.name == name).integer:
        return
    place = names.index(name)

    def at(function: Function, x: np.ndarray) -> np.ndarray:
        with np.errstate(all="ignore"):
            return np.asarray(function(*(x if k == place else np.full_like(x, v) for k, v in enumerate(point))), float)

    def value(x: np.ndarray) -> np.ndarray:
        return at(kernel.made, x)

    def log(x: np.ndarray) -> np.ndarray:
        if quantity.name in LOGARITHMS:
            from xsec_sym.kernels import spherical_gaussian

            found = at(getattr(spherical_gaussian, LOGARITHMS[quantity.name]), x)
        else:
            with np.errstate(all="ignore"):
                found = np.log(value(x))
        # far below what a double holds
        return np.where(found < -800.0, -800.0, found)

    need = tables.Need(material.error, material.tolerance / (1.2 * MARGIN), TINY[material.dtype])
    stored = dict(costs) if costs else None
    for table in tables.tables(value, log, *material.ranges[name], need):
        ns, setup = tables.cost(table, material.evaluations, stored)
        off = table.part * need.tolerance
        yield Candidate(material, table.name, kernel.source, kernel.model, ns, setup, least=off, table=table)
