"""The error of an approximation: at exact points as balls, and in the claim's chart as a surface to be bounded."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import reduce
from itertools import pairwise
from math import floor, log10
from typing import Any

from flint import acb, arb, ctx
from sympy import Expr, Rational, Symbol

from xsec_sym.proof.accuracy import Chart
from xsec_sym.proof.ball_compile import compile_ball, precision
from xsec_sym.proof.claim import Claim
from xsec_sym.proof.suprema import BITS, Surface, compiled

PIECES = 4  # each way
Point = dict[Symbol, Expr]


class Unbounded(ArithmeticError):
    """The claim cannot be judged; the message says why in one sentence."""


@dataclass
class Error:
    """The error of a form, as balls at exact points of the claim's own variables."""

    claim: Claim
    form: Expr
    run: Any = field(init=False)

    def __post_init__(self) -> None:
        self.run = compile_ball(self.form, self.claim.domain.symbols)

    def sides(self, point: Mapping[Symbol, Expr]) -> tuple[arb, arb]:
        """The left side and the form."""
        with precision(4 * BITS):
            given = [ball(point[s]) for s in self.claim.domain.symbols]
            right = self.run([acb(v) for v in given], False)
            return left_value(self.claim, given), right.real if right.imag.contains(0) else arb("nan")

    def at(self, point: Mapping[Symbol, Expr]) -> arb:
        """The modulus of the difference."""
        left, right = self.sides(point)
        return abs(right - left)


def fast_of(claim: Claim) -> Any:
    """The left side's own evaluation for searches: `value`, `majorant` (of the second argument's square),
    `RESTS_ON` and `CHECKED_BY`; None where it has none."""
    return getattr(type(claim.left), "fast", None)


def lemmas_of(claim: Claim) -> tuple[str, ...]:
    fast = fast_of(claim)
    return () if fast is None else tuple(fast.RESTS_ON)


def left_value(claim: Claim, given: list[arb]) -> arb:
    """The left side at narrow balls: by its own fast evaluation where it has one."""
    fast = fast_of(claim)
    if fast is None:
        out = compile_ball(claim.left, claim.domain.symbols)([acb(v) for v in given], False)
        return out.real if out.imag.contains(0) else arb("nan")
    if claim.left.args != claim.domain.symbols:
        raise Unbounded("the left side's variables are not the claim's")
    return fast.value(*given)


def surface(claim: Claim, chart: Chart) -> Surface:
    """The error in the coordinates of the chart."""
    xy = (chart.x, chart.y)
    value, majorant = compiled(on_chart(chart))
    across, rough = (compile_ball(e, xy) for e in (chart.across, chart.rough))
    square = compile_ball(chart.rough**2, xy)
    fast = fast_of(claim)
    if fast is None:
        left, left_majorant = compiled(compile_ball(claim.left.subs(onto(claim, chart), simultaneous=True), xy))
    else:

        def left(x: arb, y: arb) -> arb:
            given = (acb(x), acb(y))
            return fast.value(across(given, False).real, rough(given, False).real)

        def left_majorant(x: acb, y: acb) -> arb:
            u, m = across((x, y), True), square((x, y), True)
            return fast.majorant(u, m) if u.is_finite() and m.is_finite() else arb("nan")

    return Surface(
        lambda x, y: value(x, y) - left(x, y),
        lambda x, y: majorant(x, y) + left_majorant(x, y),
        chart.removable,
    )


def on_chart(chart: Chart) -> Any:
    """The chart's form as a closure, its fine parts filled in."""
    form = compile_ball(chart.form, (chart.x, chart.y, *(name for name, _ in chart.fine)))
    parts = [_finely(compile_ball(e, (chart.y,))) for _, e in chart.fine]

    def run(given: Any, analytic: bool) -> acb:
        return form((*given, *(part(given[1], analytic) for part in parts)), analytic)

    return run


def _finely(run: Any) -> Any:
    """The hull of a function over the pieces of a wide box."""
    kept: dict[Any, acb] = {}

    def at(z: acb, analytic: bool) -> acb:
        key = (ctx.prec, z.real.mid(), z.real.rad(), z.imag.mid(), z.imag.rad(), analytic)
        if key not in kept and z.real.rad() < 1e-9 and z.imag.rad() < 1e-9:
            kept[key] = run((z,), analytic)
        if key not in kept:
            across, up = (_cut(part) for part in (z.real, z.imag))
            pieces = [run((acb(a, b),), analytic) for a in across for b in up]
            kept[key] = reduce(acb.union, pieces)
        return kept[key]

    return at


def _cut(part: arb) -> list[arb]:
    if part.is_exact():
        return [part]
    ends = [part.lower() + (part.upper() - part.lower()) * i / PIECES for i in range(PIECES + 1)]
    return [a.union(b) for a, b in pairwise(ends)]


def onto(claim: Claim, chart: Chart) -> dict[Symbol, Expr]:
    u, m = claim.domain.symbols
    return {u: chart.across, m: chart.rough}


# --- points -------------------------------------------------------------------------------------------


def spread(claim: Claim, chart: Chart, first: float, last: float) -> list[Point]:
    """Points all over a range of y, for the print and for altered forms."""
    u, m = claim.domain.symbols
    found = []
    for share in (0.1, 0.6, 1.0):
        r = roughness(chart, first + (last - first) * share)
        for part in (Rational(-1), Rational(-1, 3), Rational(1, 8), Rational(1, 2), Rational(9, 10), Rational(1)):
            found.append({u: part, m: r})
        for part in (Rational(-1, 2), Rational(1, 5), Rational(3, 4), Rational(3, 2)):
            found.append({u: max(Rational(-1), min(Rational(1), part * r)), m: r})
    return found


def edge(chart: Chart, x: float, y: float) -> Rational:
    """The first variable on the line x, rounded to six digits."""
    here = float(chart.across.subs({chart.x: x, chart.y: y}))
    return Rational(f"{max(-1.0, min(1.0, here)):.6g}")


def roughness(chart: Chart, y: Any) -> Rational:
    """The second variable at y: exact where it is rational, else rounded."""
    here = chart.rough.subs(chart.y, y)
    return here if here.is_Rational else Rational(f"{float(here):.9g}")


def ball(e: Expr) -> arb:
    return compile_ball(e, ())((), False).real


# --- numbers in words ---------------------------------------------------------------------------------


def rounded_down(y: float, digits: int = 4) -> Rational:
    unit = Rational(10) ** (floor(log10(y)) + 1 - digits)
    return unit * floor(y / float(unit) + 1e-9)


def rounded_up(y: float, digits: int = 4) -> Rational:
    return rounded_down(y, digits) + Rational(10) ** (floor(log10(y)) + 1 - digits)


def decimal(e: Any, digits: int = 4) -> str:
    return f"{float(e):.{digits}g}"


def short(size: Any) -> str:
    near = float(size.mid())
    return f"{near:.2e}" if near < 1e300 else str(size.mid().str(3, radius=False))


def ceiling(x: float) -> str:
    """To three digits, upwards."""
    power = floor(log10(x)) - 2
    return f"{-floor(-x / 10.0**power) * 10.0**power:.2e}"


def shown(point: Mapping[Symbol, Expr]) -> dict[str, str]:
    return {str(k): f"{float(v):.9g}" for k, v in point.items()}
