"""Where each method loses digits: a map over a running and a set argument, the shipped kernel's first."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from xsec_sym.study.chart import STYLE, save
from xsec_sym.study.measure import label

COLUMNS = 4
NOTHING_RIGHT = 1.0
EPS = float(np.finfo(float).eps)


def lost_digits(data: Mapping[str, Any], row: Mapping[str, Any]) -> np.ndarray:
    """log10 of the largest relative error over the rounding of its dtype, in the cells of the first running and the
    first set argument, the largest over all others; NaN where nothing was tried, infinite where a value failed.
    """
    shape = [len(a["edges"]) - 1 for a in data["arguments"]]
    error = np.array([np.nan if e is None else float(e) for e in row["cells"]["max_rel"]]).reshape(shape)
    kept = axes(data)
    others = tuple(k for k in range(len(shape)) if k not in kept)
    if others:
        known = np.where(np.isnan(error), -1.0, error).max(axis=others)
        error = np.where(known < 0, np.nan, known)
    with np.errstate(divide="ignore", over="ignore"):
        digits = np.log10(error / (np.finfo(row["dtype"]).eps / 2))
    return np.maximum(digits, 0.0) if len(kept) == 2 else np.maximum(digits, 0.0)[:, np.newaxis]


def axes(data: Mapping[str, Any]) -> list[int]:
    """The arguments of the map: the first of the running ones, and of the set ones, or else the second running one."""
    names = data["arguments"]
    running = [k for k, a in enumerate(names) if not a["set"]]
    chosen = [k for k, a in enumerate(names) if a["set"] and len(a["edges"]) > 2]
    return [running[0], *(chosen[:1] or running[1:2])]


def maps(data: Mapping[str, Any], dtype: str = "float64") -> dict[str, np.ndarray]:
    """A map a method, at its most accurate parameters; the project's own first."""
    best: dict[str, Mapping[str, Any]] = {}
    for row in data["points"]:
        if row["dtype"] != dtype or "cells" not in row:
            continue
        kept = best.get(row["method"])
        if kept is None or _typical(row) < _typical(kept):
            best[row["method"]] = row
    ordered = sorted(best.values(), key=lambda row: not row["ours"])
    return {f"{row['method']} {label(row['parameters'])}".strip(): lost_digits(data, row) for row in ordered}


def _typical(row: Mapping[str, Any]) -> float:
    errors = [np.inf if e == "inf" else e for e in row["cells"]["max_rel"] if e is not None]
    return float(np.mean(np.log10(np.clip(errors, 1e-17, 1e3)))) if errors else np.inf


def draw(data: Mapping[str, Any], path: str | Path) -> None:
    """Write the maps as SVG or PNG, as the file's name says."""
    save(figure(data), path)


def figure(data: Mapping[str, Any]) -> Figure:
    """A map a method."""
    found = maps(data)
    across, *down = (data["arguments"][k] for k in axes(data))
    rows = -(-len(found) // COLUMNS)
    height = (2.3 if down else 1.0) * rows + 0.9
    with rc_context({**STYLE, "font.size": 7}):
        made = Figure(figsize=(11, height))
        frames = made.subplots(rows, COLUMNS, squeeze=False, sharex=True, sharey=True)
        for frame in frames.flat[len(found) :]:
            frame.set_visible(False)
        for frame, (name, digits) in zip(frames.flat, found.items(), strict=False):
            mesh = _map(frame, digits)
            frame.set_title(name, fontsize=7)
            _ticks(frame.xaxis, across)
            frame.yaxis.set_ticks([])
            for argument in down:
                _ticks(frame.yaxis, argument)
        for frame in frames.flat[max(0, len(found) - COLUMNS) : len(found)]:
            # the lowest of its column, though its row may not be the last
            frame.tick_params(axis="x", labelbottom=True)
            frame.set_xlabel(across["name"])
        for frame in frames[:, 0]:
            frame.set_ylabel(down[0]["name"] if down else "")
        made.suptitle(f"{data['quantity']}: decimal digits lost, largest in each cell")
        made.tight_layout(rect=(0, 0.25 / height, 0.93, 1 - 0.15 / height))
        made.colorbar(mesh, cax=made.add_axes((0.945, 0.2, 0.012, 0.6)), label="digits lost of 16")
        foot = (
            "Red outline: no digit right, or no number. Grey: not tried. Where the value underflows nothing counts. "
            f"Condition number x eps: median {data['condition']['median'] * EPS:.1e}, 99th percentile "
            f"{data['condition']['p99'] * EPS:.1e}. xsec chart {data['quantity']} --stability"
        )
        made.text(0.01, 0.05 / height, foot, fontsize=6.5, color="0.35")
    return made


def _map(frame: Any, digits: np.ndarray) -> Any:
    frame.set_facecolor("0.8")
    capped = np.ma.masked_invalid(np.where(np.isinf(digits), 16.0, digits)).T
    mesh = frame.pcolormesh(capped, cmap="cividis", vmin=0, vmax=16, rasterized=True)
    failing = np.where(np.isnan(digits), False, digits >= -np.log10(np.finfo(float).eps / 2) + np.log10(NOTHING_RIGHT))
    outline = []
    for i, j in np.argwhere(failing):
        for di, dj, line in ((-1, 0, ((i, j), (i, j + 1))), (1, 0, ((i + 1, j), (i + 1, j + 1))),
                             (0, -1, ((i, j), (i + 1, j))), (0, 1, ((i, j + 1), (i + 1, j + 1)))):  # fmt: skip
            k, l = i + di, j + dj
            inside = 0 <= k < failing.shape[0] and 0 <= l < failing.shape[1]
            if not (inside and failing[k, l]):
                outline.append(line)
    frame.add_collection(LineCollection(outline, colors="#D7191C", linewidths=0.8))
    if failing.any():
        i, j = np.argwhere(failing).mean(axis=0) + 0.5
        said = "no number" if np.isinf(digits[failing]).any() else "no digit right"
        label_ = frame.text(i, j, said, color="black", ha="center", va="center", fontsize=6)
        label_.set_path_effects([withStroke(linewidth=1.5, foreground="white")])
    return mesh


def _ticks(axis: Any, argument: Mapping[str, Any]) -> None:
    edges = argument["edges"]
    step = max(1, len(edges) // 6)
    places = list(range(0, len(edges), step))
    axis.set_ticks(places, [f"{edges[k]:.3g}" for k in places], rotation=90 if axis.axis_name == "x" else 0)
