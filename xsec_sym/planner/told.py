"""A plan as lines of a terminal, and as a table of a notebook."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from xsec_sym.planner.planning import Plan, PlannedMaterial, Rejected

HEAD = ("function", "method", "model", "expected error", "found error", "ns a value", "general kernel")
# Of what was turned down, so many are told, the nearest to the choice first.
MOST = 4


def cells(planned: PlannedMaterial) -> list[str]:
    return [
        planned.function,
        planned.method,
        planned.model,
        f"{planned.expected_error:.2g} of {planned.material.tolerance:g} {planned.material.error}",
        f"{planned.found_error:.2g}",
        f"{planned.ns_per_value:.3g}",
        f"{planned.ns_general:.3g}",
    ]


def lines(plan: Plan) -> list[str]:
    """The choices as a table, and below it what came nearest for each."""
    rows = [list(HEAD), *(cells(m) for m in plan.materials)]
    wide = [max(len(row[k]) for row in rows) for k in range(len(HEAD))]
    said = ["  ".join(cell.ljust(w) for cell, w in zip(row, wide, strict=True)).rstrip() for row in rows]
    for planned in plan.materials:
        said += ["", f"{planned.function}: {planned.material.wanted()}; turned down, of {len(planned.rejected)}:"]
        said += [f"  {turned(r)}" for r in nearest(planned)]
    return said


def nearest(planned: PlannedMaterial) -> list[Rejected]:
    """The cheaper ones with the least errors, and the next dearer ones."""
    known = [r for r in planned.rejected if r.error is not None and r.ns_per_value is not None]
    cheaper = sorted((r for r in known if not r.reason.startswith("slower")), key=lambda r: r.error or 0.0)
    dearer = sorted((r for r in known if r.reason.startswith("slower")), key=lambda r: r.ns_per_value or 0.0)
    return [*cheaper[:MOST], *dearer[: MOST // 2]]


def turned(rejected: Rejected) -> str:
    error = "" if rejected.error is None else f" (error {rejected.error:.2g}"
    error += f", {rejected.ns_per_value:.3g} ns)" if rejected.ns_per_value is not None else ")" if error else ""
    return f"{rejected.method}{error}: {rejected.reason}"


def html(plan: Plan) -> str:
    head = "".join(f"<th>{escape(h)}</th>" for h in HEAD)
    body = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells(m)) + "</tr>" for m in plan.materials)
    down = "".join(
        f"<p>{escape(m.function)}, turned down: "
        + "; ".join(escape(turned(r)) for r in nearest(m))
        + f"; {len(m.rejected)} in all</p>"
        for m in plan.materials
    )
    return f"<table><caption>{escape(plan.scene.name)}</caption><tr>{head}</tr>{body}</table>{down}"
