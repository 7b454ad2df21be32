"""A function of one argument on a range as polynomials, as many and as short as the tolerance asks for.

The values are those of the verified kernel, or their logarithms where small ones have to keep their digits. What such a
table takes was measured once: `python -m xsec_sym.planner.tables` writes `data/tables.json` anew.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from xsec_sym.planner import runtime

DATA = Path(__file__).parent / "data" / "tables.json"
WHOLE_DEGREES = (1, 2, 3, 4, 6, 8, 11, 14, 18, 23)
DEGREES = (1, 2, 3, 5)
COUNTS = (4, 8, 16, 32, 64, 128, 256, 512, 1024)
# Where a polynomial is compared with what it stands for, between its nodes, in a piece and in the whole.
PROBES, PROBES_OF_ALL = 5, 200
FORMS = ("value", "logarithm")
VARIABLES = ("x", "half angle")
Function = Callable[[np.ndarray], np.ndarray]


class NoTable(ValueError):
    """The function is not finite, or too rough for tables of this size."""


@dataclass(frozen=True)
class Table:
    """rows: the coefficients, highest power first; in columns where there are several pieces.

    variable: "x", the argument; or "half angle", tan of half the angle whose sine it is, in which the roots are smooth
    that a lobe has at grazing cosines. low, scale: where that begins, and how fast it runs.
    """

    form: str
    variable: str
    low: float
    scale: float
    rows: np.ndarray
    # the largest deviation from the kernel that was found while it was made, as a part of what is allowed
    part: float = 1.0

    @property
    def degree(self) -> int:
        return len(self.rows) - 1

    @property
    def pieces(self) -> int:
        return self.rows.shape[1] - 1 if self.rows.ndim == 2 else 1

    @property
    def name(self) -> str:
        said = f"{self.pieces} pieces of degree {self.degree}" if self.pieces > 1 else f"degree {self.degree}"
        said += " in the half angle" * (self.variable == "half angle")
        return f"polynomial of {said}" if self.form == "value" else f"exponential of a polynomial of {said}"

    def __call__(self, x: np.ndarray) -> np.ndarray:
        evaluate = runtime.piecewise if self.pieces > 1 else runtime.polynomial
        x = runtime.half_angle(x) if self.variable == "half angle" else x
        total = evaluate(x, self.low, self.scale, self.rows)
        return np.exp(total) if self.form == "logarithm" else total


@dataclass(frozen=True)
class Need:
    """The largest error, relative or absolute; values below `tiny` only have to be as small."""

    error: str
    tolerance: float
    tiny: float = 1e-300

    def allowed(self, form: str, values: np.ndarray) -> np.ndarray:
        """What the polynomial may be off by, where its right values are these; more than 0."""
        flat = np.full_like(values, self.tolerance)
        if form == "logarithm" and self.error == "relative":
            return flat + np.maximum(np.log(self.tiny) - values, 0.0)
        if self.error == "relative":
            flat = self.tolerance * np.maximum(np.abs(values), self.tiny)
        elif form == "logarithm":
            with np.errstate(over="ignore"):
                flat = self.tolerance * np.exp(-values)
        return np.maximum(flat, np.finfo(float).tiny)


def tables(function: Function, log: Function, low: float, high: float, need: Need) -> Iterator[Table]:
    """Tables that keep to the tolerance: of each form the shortest polynomial, and for each degree the fewest pieces.

    function, log: the values of the kernel and their logarithms, of vectors.
    """
    if not low < high:
        return
    for variable in VARIABLES:
        ends = np.array([low, high])
        if variable == "half angle":
            if not -1 <= low < high <= 1:
                continue
            ends = runtime.half_angle(ends)
        for form in FORMS:
            of = _in_variable(function if form == "value" else log, variable, low, high)
            start, end = ends.tolist()
            yield from _whole(form, variable, of, start, end, need)
            for degree in DEGREES:
                yield from _pieces(form, variable, of, start, end, need, degree)


def _in_variable(of: Function, variable: str, low: float, high: float) -> Function:
    """The function of another variable, kept within its range where that is rounded."""
    if variable == "x":
        return lambda x: of(np.clip(x, low, high))
    return lambda q: of(np.clip(2 * q / (1 + q * q), low, high))


def _whole(form: str, variable: str, of: Function, low: float, high: float, need: Need) -> Iterator[Table]:
    x = low + (high - low) * 0.5 * (1 - np.cos(np.linspace(0, np.pi, PROBES_OF_ALL)))
    right = of(x)
    if not np.isfinite(right).all():
        return
    scale = 2 / (high - low)
    for degree in WHOLE_DEGREES:
        nodes = np.polynomial.chebyshev.chebpts1(degree + 1)
        series = np.polynomial.chebyshev.chebfit(nodes, of(low + (nodes + 1) / scale), degree)
        table = Table(form, variable, low, scale, np.polynomial.chebyshev.cheb2poly(series)[::-1])
        good = _judged(table, x, right, need) if len(table.rows) == degree + 1 else None
        if good:
            yield good
            return


def _judged(table: Table, x: np.ndarray, right: np.ndarray, need: Need) -> Table | None:
    """The table with its deviation at points between the nodes, if that is allowed."""
    evaluate = runtime.piecewise if table.pieces > 1 else runtime.polynomial
    found = evaluate(x, table.low, table.scale, table.rows)
    part = float(np.max(np.abs(found - right) / need.allowed(table.form, right)))
    return replace(table, part=part) if part <= 1 else None


def _pieces(
    form: str, variable: str, of: Function, low: float, high: float, need: Need, degree: int
) -> Iterator[Table]:
    nodes = np.polynomial.chebyshev.chebpts1(degree + 1)
    matrix = np.linalg.inv(np.polynomial.chebyshev.chebvander(nodes, degree))
    to_powers = np.zeros((degree + 1, degree + 1))
    for i in range(degree + 1):
        series = np.polynomial.Chebyshev.basis(i, domain=[0, 1]).convert(kind=np.polynomial.Polynomial)
        to_powers[: i + 1, i] = series.coef
    between = np.linspace(0, 1, PROBES + 2)[1:-1, np.newaxis]
    for count in COUNTS:
        scale = count / (high - low)
        places = low + (np.arange(count) + 0.5 * (nodes[:, np.newaxis] + 1)) / scale
        values = of(places.ravel()).reshape(places.shape)
        if not np.isfinite(values).all():
            return
        rows = (to_powers @ (matrix @ values))[::-1]
        last = np.zeros((degree + 1, 1))
        last[-1] = of(np.array([high]))
        table = Table(form, variable, low, scale, np.ascontiguousarray(np.append(rows, last, axis=1)))
        x = np.append(low, (low + (np.arange(count) + between) / scale).ravel())
        right = of(x)
        good = _judged(table, x, right, need) if np.isfinite(right).all() else None
        if good:
            yield good
            return


# --- what they take ---------------------------------------------------------------------------------------


@cache
def _stored() -> dict[str, Any]:
    return json.loads(DATA.read_text(encoding="utf-8"))


def cost(table: Table, n: int, stored: dict[str, Any] | None = None) -> tuple[float, float]:
    """Nanoseconds a value in arrays of n, and seconds to import it."""
    data = stored or _stored()
    kind = "pieces" if table.pieces > 1 else "whole"
    rows = [r for r in data["rows"] if r["kind"] == kind and r["form"] == table.form]
    sizes = sorted({r["n"] for r in rows}, key=lambda size: abs(np.log(size / n)))
    known = sorted((r["degree"], r["ns"]) for r in rows if r["n"] == sizes[0])
    degrees, times = zip(*known, strict=True)
    more = data["half_angle_ns"] * (table.variable == "half angle")
    return float(np.interp(table.degree, degrees, times)) + more, table.rows.size * data["seconds_per_coefficient"]


def guard(arguments: int, stored: dict[str, Any] | None = None) -> float:
    """Nanoseconds a value to see that so many arguments are in their ranges, and to broadcast them."""
    return arguments * float((stored or _stored())["guard_ns"])


def measured() -> dict[str, Any]:
    """The times of tables of all kinds on this machine."""
    from xsec_sym.kernels._support import elementwise
    from xsec_sym.study import times
    from xsec_sym.study.measure import machine

    rng = np.random.default_rng(0)
    rows = []
    sizes = (10**3, 10**5, 10**6)
    for n in sizes:
        x = rng.uniform(0.0, 1.0, n)

        def run(core: Callable[[np.ndarray], np.ndarray], x: np.ndarray = x) -> float:
            return times.timed(lambda: elementwise(core, x=x), x.size, budget=0.3).median

        for form in FORMS:
            for kind, degrees in (("whole", (1, 4, 11, 23)), ("pieces", DEGREES)):
                for degree in degrees:
                    shape = (degree + 1, 257) if kind == "pieces" else (degree + 1,)
                    scale = 256.0 if kind == "pieces" else 2.0
                    table = Table(form, "x", 0.0, scale, rng.uniform(-0.1, 0.1, shape))
                    ns = run(lambda x, table=table: runtime.within(table(x), (x, 0.0, 1.0)))  # type: ignore[misc]
                    rows.append({"form": form, "kind": kind, "degree": degree, "n": n, "ns": float(f"{ns:.3g}")})
    x = rng.uniform(0.0, 1.0, 10**5)
    turned = times.timed(lambda: elementwise(lambda x: runtime.half_angle(x), x=x), x.size, budget=0.5).median
    bare = times.timed(lambda: elementwise(lambda x: x, x=x), x.size, budget=0.5).median
    guarded = times.timed(lambda: elementwise(lambda x: runtime.within(x, (x, 0.0, 1.0)), x=x), x.size, budget=0.5)
    numbers = ", ".join(map(repr, rng.uniform(-1, 1, 10**4).tolist()))
    # as from a file of bytecode
    code = compile(f"np.array([{numbers}])", "", "exec")
    read = times.timed(lambda: exec(code, {"np": np}), 10**4, budget=0.5)
    return {
        "machine": machine(),
        "guard_ns": float(f"{guarded.median:.3g}"),
        "half_angle_ns": float(f"{turned - bare:.3g}"),
        "seconds_per_coefficient": float(f"{read.median * 1e-9:.3g}"),
        "rows": rows,
    }


if __name__ == "__main__":
    from xsec_sym.record.files import layout, writing

    with writing(DATA) as out:
        out.write(layout(measured()) + "\n")
