"""Speed against accuracy: measured nanoseconds a value against the largest error found, one curve a method."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from xsec_sym.study.measure import label

# The palette of Okabe and Ito, which the colour-blind can tell apart; markers tell the methods apart in grey.
PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8C6D00")
MARKERS = "osD^vP<>*hpX8dH"
STYLE: Any = {
    "svg.fonttype": "none",
    "svg.hashsalt": "xsec_sym",
    "font.size": 8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "figure.facecolor": "white",
    "figure.constrained_layout.use": False,
}
# Of the foot, in an inch of width: a viewer's own letters may be wider than those it was planned with.
LETTERS = 18
FLOOR, CEILING = 1e-17, 10.0
ERRORS = {"usual_rel": "largest relative error found", "usual_abs": "largest absolute error found"}


@dataclass(frozen=True)
class Spot:
    """A method at one point of its curve: the time, with quartiles, and the error."""

    method: str
    parameters: Mapping[str, Any]
    dtype: str
    ours: bool
    ns: float
    quartiles: tuple[float, float]
    error: float
    p99: float
    failures: int

    @property
    def shown(self) -> float:
        """The error within the frame; what has no digit right, or fails, lies on its upper edge."""
        return CEILING if not self.error < CEILING else max(self.error, FLOOR)

    @property
    def lost(self) -> bool:
        return self.failures > 0 or not self.error < 1.0


def spots(data: Mapping[str, Any], error: str = "usual_rel", constant: bool = False) -> list[Spot]:
    """A spot a method, parameters and dtype: at the largest array timed; the median over set arguments if constant."""
    groups: dict[tuple[str, str, str], list[Mapping[str, Any]]] = {}
    for row in data["points"]:
        if bool(row["fixed"]) == constant:
            groups.setdefault((row["method"], label(row["parameters"]), row["dtype"]), []).append(row)
    found = []
    for (method, _, dtype), rows in groups.items():
        size = max(row["n"] for row in rows)
        alike = [row for row in rows if row["n"] == size]
        ns, q1, q3 = (float(np.median([row[key] for row in alike])) for key in ("ns_median", "ns_q1", "ns_q3"))
        row = alike[0]
        p99 = float(row["p99_rel"]) if error.endswith("_rel") else float("nan")
        found.append(
            Spot(method, row["parameters"], dtype, row["ours"], ns, (q1, q3), float(row[error]), p99, row["failures"])
        )
    return found


def front(found: Iterable[Spot]) -> list[Spot]:
    """Those that no other beats in both, from the fastest to the most accurate.

    >>> a, b, c = (Spot("", {}, "", False, ns, (ns, ns), e, e, 0) for ns, e in ((1, 0.1), (2, 0.01), (3, 0.02)))
    >>> [s.ns for s in front([c, b, a])]
    [1, 2]
    """
    best: list[Spot] = []
    for spot in sorted(found, key=lambda s: (s.ns, s.error)):
        if not best or spot.error < best[-1].error:
            best.append(spot)
    return best


def draw(data: Mapping[str, Any], path: str | Path) -> None:
    """Write the chart as SVG or PNG, as the file's name says."""
    save(figure(data), path)


def figure(data: Mapping[str, Any]) -> Figure:
    """The chart: a column for each kind of call, a row for each kind of error."""
    set_arguments = [a["name"] for a in data["arguments"] if a["set"]]
    calls = [False, True] if set_arguments else [False]
    with rc_context(STYLE):
        made = Figure(figsize=(4.4 * len(calls) + 3.0, 6.4))
        frames = made.subplots(len(ERRORS), len(calls), squeeze=False, sharey="row", sharex="col")
        looks = _looks(data)
        for across, error in zip(frames, ERRORS, strict=True):
            for frame, constant in zip(across, calls, strict=True):
                _panel(frame, data, spots(data, error, constant), looks)
            across[0].set_ylabel(ERRORS[error])
        for frame, constant in zip(frames[0], calls, strict=True):
            frame.set_title(f"constant {', '.join(set_arguments)}" if constant else "all arguments as arrays")
        for frame in frames[-1]:
            frame.set_xlabel("ns a value (median, quartiles as bars)")
        handles = [
            Line2D([], [], color=colour, marker=marker, ls="-" if ours else ":", lw=1.6 if ours else 0.8, ms=4)
            for colour, marker, ours in looks.values()
        ]
        made.suptitle(f"{data['quantity']}: {data['title']}")
        made.legend(handles, list(looks), loc="center right", frameon=False, fontsize=7)
        foot = fill(_foot(data), int(LETTERS * made.get_figwidth()))
        made.text(0.01, 0.005, foot, fontsize=6.5, color="0.35", linespacing=1.3)
        _set_out(made, foot.count("\n") + 1)
    return made


def _set_out(made: Figure, lines: int) -> None:
    """Margins in inches, for they are the same in every chart: to have them measured takes as long as to draw."""
    wide, high = made.get_size_inches()
    made.subplots_adjust(
        left=0.7 / wide, right=1 - 2.0 / wide, bottom=(0.55 + 0.12 * lines) / high, top=1 - 0.58 / high,
        wspace=0.16 / 4.2, hspace=0.18 / 2.5,
    )  # fmt: skip


def save(made: Figure, path: str | Path) -> None:
    """Without a date, so that the same data give the same file."""
    kind = Path(path).suffix.lstrip(".") or "svg"
    with rc_context(STYLE):
        made.savefig(path, format=kind, dpi=100, metadata={"Date": None} if kind == "svg" else {})


def _looks(data: Mapping[str, Any]) -> dict[str, tuple[str, str, bool]]:
    names = dict.fromkeys((row["method"], row["ours"]) for row in data["points"])
    return {name: (PALETTE[k % len(PALETTE)], MARKERS[k % len(MARKERS)], ours) for k, (name, ours) in enumerate(names)}


def _panel(frame: Any, data: Mapping[str, Any], found: list[Spot], looks: Mapping[str, tuple[str, str, bool]]) -> None:
    for dtype in ("float64", "float32"):
        for name, (colour, marker, ours) in looks.items():
            curve = [s for s in found if s.method == name and s.dtype == dtype]
            if not curve:
                continue
            x, y = [s.ns for s in curve], [s.shown for s in curve]
            filled = colour if dtype == "float64" else "white"
            frame.plot(
                x, y, color=colour, marker=marker, mfc=filled, ms=5 if ours else 4,
                lw=1.6 if ours else 0.8, ls="-" if ours else ":", zorder=3 if ours else 2,
            )  # fmt: skip
            for spot in curve:
                frame.plot(spot.quartiles, [spot.shown] * 2, color=colour, lw=0.8)
                if spot.p99 > 0 and spot.shown < CEILING:
                    frame.plot([spot.ns] * 2, [max(spot.p99, FLOOR), spot.shown], color=colour, lw=0.5, alpha=0.6)
                if spot.lost:
                    frame.plot(spot.ns, spot.shown, marker="x", color="0.25", ms=6, mew=0.7, zorder=4)
    best = front([s for s in found if s.dtype == "float64" and not s.lost])
    if best:
        frame.step([s.ns for s in best], [s.shown for s in best], where="post", color="0.6", lw=3, alpha=0.4, zorder=1)
        frame.annotate("Pareto front", (best[0].ns, best[0].shown), (-4, 4), textcoords="offset points", ha="right",
                       color="0.4", fontsize=6)  # fmt: skip
    for name in ("copy", "np.exp"):
        frame.axvline(data["yardsticks"][name], color="0.5", lw=0.7, ls="--")
        frame.text(data["yardsticks"][name], 2 * FLOOR, f" {name}", rotation=90, color="0.4", va="bottom", fontsize=6)
    for dtype in ("float64", "float32"):
        floor = float(np.finfo(dtype).eps) / 2
        frame.axhline(floor, color="0.5", lw=0.7, ls="-.")
        frame.text(0.995, floor, f"{dtype} rounds ", transform=frame.get_yaxis_transform(), ha="right", va="bottom",
                   color="0.4", fontsize=6)  # fmt: skip
    frame.set(xscale="log", yscale="log", ylim=(FLOOR, 3 * CEILING))
    frame.grid(alpha=0.15)


def _foot(data: Mapping[str, Any]) -> str:
    machine, n = data["machine"], max(row["n"] for row in data["points"])
    return (
        f"{machine['processor']}, one thread, Python {machine['python']}, NumPy {machine['numpy']}, SciPy "
        f"{machine['scipy']}; arrays of up to {n} values. Hollow: float32. Thin line down: 99th percentile. Cross: no "
        f"digit right or no number somewhere{_where(data)}. xsec chart {data['quantity']}"
    )


def _where(data: Mapping[str, Any]) -> str:
    told = [f"{name} in [{low:g}, {high:g}]" for name, (low, high) in data["usual"].items()]
    return f"; errors for {', '.join(told)}" if told else " in the domain"


def table(data: Mapping[str, Any]) -> list[str]:
    """The chart as lines of text: what a terminal shows."""
    rows = [("method", "call", "ns", "max rel", "p99 rel", "max abs", "failures")]
    for constant in (False, True):
        absolute = {(s.method, label(s.parameters), s.dtype): s.error for s in spots(data, "max_abs", constant)}
        for s in sorted(spots(data, "max_rel", constant), key=lambda s: (s.dtype, s.ns)):
            name = f"{s.method} {label(s.parameters)} {'float32' if s.dtype == 'float32' else ''}".strip()
            call = "constant" if constant else "arrays"
            away = absolute[s.method, label(s.parameters), s.dtype]
            rows.append((name, call, f"{s.ns:.3g}", f"{s.error:.1e}", f"{s.p99:.1e}", f"{away:.1e}", str(s.failures)))
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return ["  ".join(cell.ljust(w) for cell, w in zip(row, widths, strict=True)).rstrip() for row in rows]
