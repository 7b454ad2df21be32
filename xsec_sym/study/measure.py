"""All methods of a quantity, measured: errors against the references, times on this machine, as data."""

from __future__ import annotations

import os
import platform
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from xsec_sym.study import times as clock
from xsec_sym.study.errors import by_cell, summary, values
from xsec_sym.study.method import Method, Quantity, registered
from xsec_sym.study.points import BULK, Points, bulk, condition, right

TROUBLE, CONDITIONED = 200, 200
DTYPES = ("float64", "float32")
Tick = Callable[[str], None]


def measure(name: str, seed: int = 1, jobs: int = 1, tick: Tick = lambda said: None, only: Iterable[str] = ()) -> dict:
    """Errors and times of every method of the quantity that can run here; of those named, if any are.

    ``tick`` is called with what is begun; `steps` tells how often.
    """
    field = registered(name)
    chosen = set(only)
    unknown = chosen - {m.name for m in field.methods}
    if unknown:
        raise KeyError(f"{name} has no method {', '.join(sorted(unknown))}")
    tried = {dtype: _points(field.quantity, dtype, seed, jobs, tick) for dtype in DTYPES}
    tick("how far rounded arguments change the value")
    cond = _conditioned(field.quantity, tried["float64"][0], seed, jobs)
    tick("the machine")
    yardsticks = {n: clock.yardsticks(n) for n in clock.SIZES}
    rows: list[dict[str, Any]] = []
    for method, parameters in field.variants():
        if chosen and method.name not in chosen:
            continue
        for dtype in DTYPES if method.single else DTYPES[:1]:
            tick(f"{method.name} {label(parameters)} {dtype}")
            rows += _measured(field.quantity, method, parameters, dtype, tried[dtype], seed)
    data = {
        "quantity": name,
        "title": field.quantity.title,
        "machine": machine(),
        "seed": seed,
        "arguments": [
            {"name": a.name, "edges": list(a.edges), "scale": a.scale, "set": a in field.quantity.set}
            for a in field.quantity.arguments
        ],
        "usual": {key: list(ends) for key, ends in field.quantity.usual.items()},
        "condition": cond,
        "yardsticks": yardsticks[clock.SIZES[-1]],
        "yardsticks_by_size": {str(n): found for n, found in yardsticks.items()},
        "missing": sorted({m.name for m in field.methods if not m.available}),
        "points": rows,
    }
    mark_pareto(rows)
    return data


def steps(name: str) -> int:
    """How often `measure` says what it begins."""
    field = registered(name)
    return len(DTYPES) * (1 + len(field.quantity.trouble)) + 2 + variants(name)


def variants(name: str) -> int:
    """How many methods, parameters and dtypes there are to measure."""
    return sum(2 if method.single else 1 for method, _ in registered(name).variants())


def label(parameters: Mapping[str, Any]) -> str:
    """
    >>> label({"n": 4, "tol": 1e-07})
    'n = 4, tol = 1e-07'
    """
    return ", ".join(
        f"{key} = {value:g}" if isinstance(value, float) else f"{key} = {value}" for key, value in parameters.items()
    )


def _points(quantity: Quantity, dtype: str, seed: int, jobs: int, tick: Tick) -> list[Points]:
    rng = np.random.default_rng([seed, DTYPES.index(dtype)])
    tick(f"references, {BULK}, {dtype}")
    found = [right(quantity, BULK, bulk(quantity, rng), dtype, jobs)]
    for name, draw in quantity.trouble.items():
        tick(f"references, {name}, {dtype}")
        found.append(right(quantity, name, draw(rng, TROUBLE), dtype, jobs))
    return found


def _conditioned(quantity: Quantity, points: Points, seed: int, jobs: int) -> dict[str, float]:
    rng = np.random.default_rng(seed)
    chosen = rng.choice(len(points), min(CONDITIONED, len(points)), replace=False)
    found = condition(quantity, points.taken(chosen).columns, jobs)
    return {"median": float(f"{np.median(found):.3g}"), "p99": float(f"{np.quantile(found, 0.99):.3g}")}


def _measured(
    quantity: Quantity, method: Method, parameters: Mapping[str, Any], dtype: str, tried: list[Points], seed: int
) -> list[dict[str, Any]]:
    """One row for each size of arrays, with all arguments as arrays or with the set ones constant."""
    reports: dict[str, Any] = {}
    cells: dict[str, Any] = {}
    rng = np.random.default_rng(seed)
    for points in tried:
        if method.most is not None and len(points) > method.most:
            points = points.taken(np.sort(rng.choice(len(points), method.most, replace=False)))
        found = values(quantity, method, parameters, points.columns, dtype)
        reports[points.label] = summary(found, points, dtype).as_dict()
        if points.label == BULK:
            cells = by_cell(quantity, found, points, dtype)
    usual = quantity.box(quantity.usual)
    whole = {
        **{f"usual_{key[4:]}": _largest(cells[key], usual) for key in ("max_rel", "max_abs")},
        "points": sum(r["points"] for r in reports.values()),
        "failures": sum(r["failures"] for r in reports.values()),
        **{key: worst(r[key] for r in reports.values()) for key in ("max_rel", "max_abs", "max_ulp")},
        "p99_rel": reports[BULK]["p99_rel"],
    }
    rows = []
    for fixed in [*([()] if not (method.folds and quantity.set) else []), *(quantity.typical if quantity.set else [])]:
        sizes = clock.SIZES if not fixed or method.folds else clock.SIZES[1:2]
        for lap in clock.times(quantity, method, parameters, fixed, dtype, sizes, seed):
            rows.append(
                {
                    "method": method.name,
                    "source": method.source,
                    "kind": method.kind,
                    "ours": method.ours,
                    "model": method.model,
                    "folds": method.folds,
                    "parameters": dict(parameters),
                    "dtype": dtype,
                    "n": lap.n,
                    "fixed": dict(zip((a.name for a in quantity.set), fixed, strict=False)),
                    "ns_median": _three(lap.median),
                    "ns_q1": _three(lap.q1),
                    "ns_q3": _three(lap.q3),
                    "setup_s": _three(lap.setup),
                    **whole,
                    "by_label": reports,
                    "cells": cells,
                }
            )
    # what is the same for every size is kept once
    for row in rows[1:]:
        del row["cells"], row["by_label"]
    return rows


def _largest(cells: list[Any], where: np.ndarray) -> Any:
    return worst(error for error, inside in zip(cells, where, strict=True) if inside and error is not None)


def worst(found: Iterable[Any]) -> Any:
    """The largest of numbers among which "inf" may be."""
    found = list(found)
    return "inf" if "inf" in found else max(found, default=0.0)


def _three(value: float) -> float:
    return float(f"{value:.3g}")


def mark_pareto(rows: list[dict[str, Any]]) -> None:
    """Mark what nothing else in the same kind of call beats in both the time and the largest relative error."""
    for row in rows:
        mine = (float(row["max_rel"]), row["ns_median"])
        theirs = [(float(r["max_rel"]), r["ns_median"]) for r in rows if _alike(r, row)]
        row["pareto"] = not any(e <= mine[0] and t <= mine[1] and (e, t) != mine for e, t in theirs)


def _alike(a: dict[str, Any], b: dict[str, Any]) -> bool:
    return all(a[key] == b[key] for key in ("fixed", "dtype", "n"))


def machine() -> dict[str, Any]:
    """What the times belong to."""
    import scipy

    name = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        models = [line.partition(":")[2].strip() for line in cpuinfo.read_text().splitlines() if "model name" in line]
        name = models[0] if models else name
    return {
        "processor": name,
        "cores": os.cpu_count(),
        "system": platform.system(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "scipy": scipy.__version__,
    }
