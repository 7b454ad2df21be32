"""How an approximation is judged: by a proved bound on its error, and by points where it is as bad as that.

The search starts at the easy end of the roughness range and moves on, panel by panel, until the error exceeds the
tolerance and the claimed range is covered. So it finds how far the claim really reaches, whether it holds or not.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from math import floor, inf, log10
from typing import Any

from flint import acb, arb
from sympy import Expr, Rational, Symbol, nsimplify

from xsec_sym.proof.accuracy import Accuracy, Chart
from xsec_sym.proof.ball_compile import NoEnclosure, compile_ball, precision
from xsec_sym.proof.claim import Claim
from xsec_sym.proof.digits import NoValue, value
from xsec_sym.proof.mutants import mutants
from xsec_sym.proof.suprema import BITS, Panel, Surface, compiled, panels
from xsec_sym.proof.verdict import Verdict
from xsec_sym.proof.zeros import Undecided

MUTANTS = 8  # altered forms that must miss the stated accuracy
LOOSE, SHARP = 0.2, 2e-5  # how wrong an interpolant may be, per tolerance: far from the end, and next to it
STEP = 1.35  # from one strip of the roughness range to the next
FARTHEST = 400  # strips


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
        with precision(4 * BITS):
            given = [_ball(point[s]) for s in self.claim.domain.symbols]
            right = self.run([acb(v) for v in given], False)
            return left_value(self.claim, given), right.real if right.imag.contains(0) else arb("nan")

    def at(self, point: Mapping[Symbol, Expr]) -> arb:
        left, right = self.sides(point)
        return abs(right - left)


def judged(claim: Claim, claims: Mapping[str, Claim], recorded: Any, seed: int = 0) -> Verdict:
    """The verdict on an approximation, or on an accuracy that is stated of one.

    With a ``recorded`` certificate the points are tried again, and the bound only next to its end.
    """
    try:
        return _judged(claim, recorded, seed)
    except (Unbounded, NoEnclosure, Undecided) as reason:
        return Verdict("inconclusive", note=str(reason))


def _judged(claim: Claim, recorded: Any, seed: int) -> Verdict:
    spec = claim.accuracy
    assert spec is not None
    found = _searched(claim, spec) if recorded is None else _replayed(claim, spec, recorded)
    tolerance = found.tolerance
    evidence = found.evidence
    witness = None
    killed = 0
    holds = found.bound <= tolerance
    if not holds and not found.worst_error > tolerance:
        raise Unbounded(f"the error is at most {found.bound:.4g}, and no point was found where it exceeds {tolerance}")
    error = Error(claim, claim.form)
    if recorded is None:
        rivals = [_tried(claim, rival, found.points, tolerance) for rival in mutants(claim.form, [])]
        killed, as_good = sum(r is True for r in rivals), sum(r is False for r in rivals)
        evidence["altered forms within the tolerance as well"] = as_good
        if _tried(claim, -claim.form, found.points, tolerance) is not True:
            raise Unbounded("the check lets the form with the opposite sign pass")
        if not found.worst_error > tolerance / 2 and not found.worst_error > found.bound / 2:
            raise Unbounded("the bound is more than twice the error found")
        if killed < MUTANTS:
            raise Unbounded(f"only {killed} altered forms miss the tolerance")
    if claim.corrected is not None and claim.printed is not None and claim.kind == "approximation":
        witness, size = _worst_of_print(claim, found.points)
        if not size > tolerance:
            raise Unbounded("a correction is offered, but the print was not seen to miss the accuracy")
        evidence["error of the print"] = _short(float(size.mid()))
    if not holds:
        left, right = error.sides(found.worst)
        witness = {"point": _shown(found.worst), "left": left.str(20), "right": right.str(20)}
    word = "claim-holds" if holds else "claim-fails"
    if claim.kind == "approximation" and witness is not None:
        word = "misprint" if holds else "inconclusive"
    return Verdict(word, witness=witness, evidence=evidence, mutants=killed, certificate=found.certificate(claim),
                   note="" if word != "inconclusive" else "the mended form misses the accuracy too")  # fmt: skip


@dataclass
class Found:
    """What a search came to: the largest error in the claimed range with a bound on it, and the reach in y."""

    tolerance: float
    worst: dict[Symbol, Expr]
    worst_error: arb
    bound: float
    holds_to: Expr
    broken: dict[Symbol, Expr] | None
    points: list[dict[Symbol, Expr]]
    evidence: dict[str, Any]
    rests_on: tuple[str, ...] = ()

    def certificate(self, claim: Claim) -> dict[str, Any]:
        from xsec_sym.proof.wire import encode

        points = [[encode(p[s]) for s in claim.domain.symbols] for p in (self.worst, self.broken) if p]
        return {
            "format": 1,
            "claim": claim.id,
            "moves": [["rests on", {"proven": name}] for name in self.rests_on],
            "accuracy": {"tolerance": self.tolerance, "bound": self.bound, "holds to": encode(self.holds_to),
                         "points": points},
        }  # fmt: skip


# --- the search ---------------------------------------------------------------------------------------


def _searched(claim: Claim, spec: Accuracy) -> Found:
    chart = spec.chart
    tolerance = float(spec.within) if spec.within is not None else inf
    surface = _surface(claim, chart)
    checks = _checks(claim, spec)
    y_end = float(spec.chart.y_of.subs(claim.domain.symbols[1], spec.end))
    ground = _limit(spec, tolerance)
    reach_x = (float(chart.reach[0]), float(chart.reach[1]))
    strips: list[tuple[tuple[float, float], list[Panel], float]] = []
    low = float(spec.start)
    first = low
    while True:
        high = low * STEP if low > 0 else 0.5
        # the end of the claim and the reach are to lie inside of a strip, not on its edge
        sharp = bool(strips) and _peak(strips[-1]) > tolerance / 8 or low <= y_end <= high
        strip = (low, high)
        made = list(panels(surface, reach_x, strip, tolerance * (SHARP if sharp else LOOSE)))
        strips.append((strip, made, _beyond(claim, spec, surface, strip, tolerance)))
        low = high
        if high > y_end and _peak(strips[-1]) > 1.02 * tolerance:
            break
        if len(strips) > FARTHEST:
            raise Unbounded("the error stays below the tolerance as far as was searched")
    reach = _crossing(strips, tolerance)
    holds_to = _rounded_down(reach * (1 - 3e-4))
    proved = max(ground, _bound(strips, float(holds_to)))
    if not proved <= tolerance:
        raise Unbounded(f"up to {holds_to} the error is bounded by {proved:.5g} only")
    bound = proved if float(y_end) <= float(holds_to) else max(ground, _bound(strips, y_end))
    error = Error(claim, claim.form)
    worst = _witness(claim, chart, strips, y_end, error)
    broken = _witness(claim, chart, strips, float(_rounded_up(reach * (1 + 1e-4))), error, at_end=True)
    if not error.at(broken) > tolerance:
        raise Unbounded("no point was found that breaks the tolerance")
    m = claim.domain.symbols[1]
    size = error.at(worst)
    rests_on = tuple(getattr(getattr(type(claim.left), "fast", None), "RESTS_ON", ()))
    r_hold, r_break = _rough(chart, holds_to), broken[m]
    words = [part.because for part in (spec.tail, spec.limit) if part] + [chart.even] * bool(chart.even)
    evidence = {
        "within": str(spec.within),
        "largest error": _short(float(size.mid())),
        "where": _shown(worst),
        "proved bound": _ceiling(bound),
        "reach": f"{float(_rough(chart, nsimplify(reach))):.4g}",
        "holds up to": {str(m): _decimal(r_hold)},
        "broken at": {**_shown(broken), "error": error.at(broken).mid().str(6, radius=False)},
        "panels": sum(len(made) for _, made, _ in strips),
        "bounded by intervals": f"{m} from {_decimal(_rough(chart, nsimplify(first)))}" if first > 0 else f"all {m}",
        "in words": words,
        **checks,
    }
    points = [worst, broken, *_spread(claim, chart, first, min(y_end, float(holds_to)))]
    del r_break
    return Found(tolerance, worst, size, bound, holds_to, broken, points, evidence, rests_on)


def _peak(strip: tuple[tuple[float, float], list[Panel], float]) -> float:
    return max(p.peak(p.y)[0] for p in strip[1])


def _bound(strips: list[Any], end: float) -> float:
    """A bound on the error over all strips, the last one cut off at ``end``."""
    largest = 0.0
    for (low, _), made, beyond in strips:
        if low >= end:
            break
        for p in made:
            if p.y[0] >= end:
                continue
            top = min(p.y[1], end)
            here = p.bound((p.y[0], top), 24)
            # many points where it matters; the loss falls with the square of their number
            largest = max(largest, p.bound((p.y[0], top), 160) if here > 0.9 * largest else here)
        largest = max(largest, beyond)
    return largest


def _crossing(strips: list[Any], tolerance: float) -> float:
    """Where the largest error first reaches the tolerance, by bisection on the interpolants."""
    for (low, high), made, _ in strips:
        if max(p.peak(p.y)[0] for p in made) <= tolerance:
            continue

        def excess(y: float, made: list[Panel] = made) -> bool:
            return max(p.largest(y)[0] for p in made if p.y[0] <= y <= p.y[1]) > tolerance

        if excess(low):
            return low
        while high - low > 1e-7 * high:
            middle = (low + high) / 2
            low, high = (low, middle) if excess(middle) else (middle, high)
        return low
    raise Unbounded("the tolerance is never reached")


def _beyond(claim: Claim, spec: Accuracy, f: Surface, strip: tuple[float, float], tolerance: float) -> float:
    """The tail's bound on a strip: the error on the chart's edge, and what is added to it."""
    if spec.tail is None:
        return 0.0
    edge = float(spec.tail.edge)
    on_edge = max(p.bound() for p in panels(f, (edge, edge), strip, tolerance * LOOSE / 20))
    run = compile_ball(spec.tail.extra, (spec.chart.y,))
    extra = 0.0
    with precision(BITS):
        for i in range(200):
            step = (strip[1] - strip[0]) / 200
            here = run((acb(arb(strip[0] + i * step).union(arb(strip[0] + (i + 1) * step))),), False)
            extra = max(extra, float(here.real.upper()))
    if not extra < inf:
        raise Unbounded("the tail has no finite bound")
    return (on_edge + extra) * (1 + 1e-12)


def _limit(spec: Accuracy, tolerance: float) -> float:
    if spec.limit is None:
        return 0.0
    with precision(BITS):
        size = compile_ball(spec.limit.bound.subs(spec.chart.y, spec.limit.y), ())((), False).real
    if not size < tolerance or float(spec.start) > float(spec.limit.y):
        raise Unbounded("the limit's bound does not meet the first strip below the tolerance")
    return float(size.upper())


def left_value(claim: Claim, given: list[arb]) -> arb:
    """The left side at narrow balls: by its own fast evaluation where it has one."""
    fast = getattr(type(claim.left), "fast", None)
    if fast is None:
        out = compile_ball(claim.left, claim.domain.symbols)([acb(v) for v in given], False)
        return out.real if out.imag.contains(0) else arb("nan")
    if claim.left.args != claim.domain.symbols:
        raise Unbounded("the left side's variables are not the claim's")
    return fast.value(*given)


def _surface(claim: Claim, chart: Chart) -> Surface:
    xy = (chart.x, chart.y)
    value, majorant = compiled(compile_ball(chart.form, xy))
    across, rough = (compile_ball(e, xy) for e in (chart.across, chart.rough))
    fast = getattr(type(claim.left), "fast", None)
    if fast is None:
        u, m = claim.domain.symbols
        there = claim.left.subs({u: chart.across, m: chart.rough}, simultaneous=True)
        left, left_majorant = compiled(compile_ball(there, xy))
    else:

        def left(x: arb, y: arb) -> arb:
            given = (acb(x), acb(y))
            return fast.value(across(given, False).real, rough(given, False).real)

        def left_majorant(x: acb, y: acb) -> arb:
            u, m = across((x, y), True), rough((x, y), True)
            return fast.majorant(u, m) if u.is_finite() and m.is_finite() else arb("nan")

    return Surface(
        lambda x, y: value(x, y) - left(x, y),
        lambda x, y: majorant(x, y) + left_majorant(x, y),
        chart.removable,
    )


# --- the checks on what the claim's author gave -------------------------------------------------------


def _checks(claim: Claim, spec: Accuracy) -> dict[str, Any]:
    """The chart's form equals the claim's, the fast left side the definition's, and the words hold at points."""
    chart = spec.chart
    points = list(_grid(spec))
    error = Error(claim, claim.form)
    run, across, rough = (compile_ball(e, (chart.x, chart.y)) for e in (chart.form, chart.across, chart.rough))
    on_chart = compile_ball(claim.form.subs(_onto(claim, chart), simultaneous=True), (chart.x, chart.y))
    del across, rough
    with precision(4 * BITS):
        for x, y in points:
            given = (acb(_ball(x)), acb(_ball(y)))
            gap = run(given, False) - on_chart(given, False)
            if not (gap.is_finite() and gap.contains(0) and abs(gap) < arb(10) ** -30):
                raise Unbounded(f"the chart's form is not the claim's at x = {x}, y = {y}")
    m = claim.domain.symbols[1]
    u = claim.domain.symbols[0]
    if chart.even or spec.tail:
        for r in sorted({_rational(_rough(chart, y)) for _, y in points[::5]}):
            for share in (Rational(1, 3), Rational(9, 10), Rational(1)):
                if chart.even and abs(error.at({u: share, m: r}) - error.at({u: -share, m: r})) > arb(10) ** -30:
                    raise Unbounded("the error is not even")
    _tail_holds(claim, spec, error)
    return {"chart compared at": len(points), "left side compared at": _definition_agrees(claim, spec, points)}


def _tail_holds(claim: Claim, spec: Accuracy, error: Error) -> None:
    """What is said in words of the tail and of the limit, tried at points."""
    u, m = claim.domain.symbols
    chart = spec.chart
    if spec.tail:
        extra = compile_ball(spec.tail.extra, (chart.y,))
        for k in range(4):
            y = Rational(str(float(spec.start))) * Rational(3, 2) ** (3 * k)
            r = _rational(_rough(chart, y))
            edge = _edge(chart, spec.tail.edge, y)
            sign = 1 if edge >= 0 else -1
            with precision(4 * BITS):
                most = error.at({u: edge, m: r}) + extra((acb(_ball(y)),), False).real
            for part in range(5):
                here = sign * (abs(edge) + (1 - abs(edge)) * Rational(part, 4))
                both = [error.at({u: here, m: r}), error.at({u: -here, m: r})]
                if any(e > most * (1 + arb(10) ** -6) for e in both):
                    raise Unbounded(f"the tail's bound fails at {u} = {here}, {m} = {r}")
    if spec.limit:
        bound = compile_ball(spec.limit.bound, (chart.y,))
        for k in range(3):
            y = Rational(str(float(spec.limit.y))) / 3**k
            for share in (0, Rational(1, 2), 1, 2, 5):
                point = {u: min(Rational(1), share * y), m: _rational(_rough(chart, y))}
                for sign in (1, -1):
                    point[u] *= sign
                    if error.at(point) > bound((acb(_ball(y)),), False).real:
                        raise Unbounded(f"the limit's bound fails at {_shown(point)}")


def _definition_agrees(claim: Claim, spec: Accuracy, points: list[Any]) -> int:
    """The fast left side against mpmath's integral of the definition."""
    if getattr(type(claim.left), "fast", None) is None:
        return 0
    agreed = 0
    for share in (Rational(1, 2), Rational(-3, 10)):
        r = _rational(Rational(spec.end) * Rational(9, 10))
        point = dict(zip(claim.domain.symbols, (share * min(1, 3 * r), r), strict=True))
        with precision(2 * BITS):
            fast = left_value(claim, [_ball(v) for v in point.values()])
        try:
            slow = value(claim.left.subs(point), 8)
        except (NoValue, Undecided):
            continue
        if abs(float(slow) - float(fast.mid())) > 1e-6 * abs(float(slow)) + 1e-12:
            raise Unbounded(f"the left side's fast evaluation is wrong at {_shown(point)}")
        agreed += 1
    if not agreed:
        raise Unbounded("the left side's fast evaluation could not be compared with the definition")
    return agreed


def _tried(claim: Claim, rival: Expr, points: list[Any], tolerance: float) -> bool | None:
    """Whether an altered form misses the tolerance at one of the points; None where it has no value."""
    try:
        error = Error(claim, rival)
        sizes = [error.at(p) for p in points]
    except (NoEnclosure, ValueError, TypeError, ZeroDivisionError, Undecided):
        return None
    if not any(s.is_finite() for s in sizes):
        return None
    return any(s.is_finite() and s > tolerance for s in sizes)


def _worst_of_print(claim: Claim, points: list[Any]) -> tuple[dict[str, Any] | None, arb]:
    assert claim.printed is not None
    error = Error(claim, claim.printed)
    best, size = None, arb(0)
    for point in points:
        here = error.at(point)
        if here.is_finite() and here > size:
            best, size = point, here
    if best is None:
        return None, size
    left, right = error.sides(best)
    return {"point": _shown(best), "left": left.str(20), "right": right.str(20)}, size


# --- points -------------------------------------------------------------------------------------------


def _onto(claim: Claim, chart: Chart) -> dict[Symbol, Expr]:
    u, m = claim.domain.symbols
    return {u: chart.across, m: chart.rough}


def _grid(spec: Accuracy) -> Iterator[tuple[Rational, Rational]]:
    low, high = (Rational(v) for v in spec.chart.reach)
    start = Rational(str(float(spec.start))) or Rational(1, 7)
    for i in range(5):
        for j in range(5):
            yield low + (high - low) * Rational(2 * i + 1, 11), start * Rational(8, 5) ** (2 * j + 1)


def _spread(claim: Claim, chart: Chart, first: float, last: float) -> list[dict[Symbol, Expr]]:
    """Points all over the claimed range, for the print and for altered forms."""
    u, m = claim.domain.symbols
    found = []
    for share in (Rational(1, 10), Rational(6, 10), Rational(1)):
        y = Rational(str(first)) + (Rational(str(round(last, 6))) - Rational(str(first))) * share
        r = _rational(_rough(chart, y))
        for part in (Rational(-1), Rational(-1, 3), Rational(1, 8), Rational(1, 2), Rational(9, 10), Rational(1)):
            found.append({u: part, m: r})
        for part in (Rational(-1, 2), Rational(1, 5), Rational(3, 4), Rational(3, 2)):
            found.append({u: max(Rational(-1), min(Rational(1), part * r)), m: r})
    return [p for p in found if p[m] > 0]


def _witness(
    claim: Claim, chart: Chart, strips: list[Any], y: float, error: Error, at_end: bool = False
) -> dict[Symbol, Expr]:
    """An exact point where the error is about as large as it gets for this y, or up to it."""
    u, m = claim.domain.symbols
    made = [p for (low, high), ps, _ in strips for p in ps]
    if not at_end:
        _, x, y = max((p.peak((p.y[0], min(p.y[1], y))) for p in made if p.y[0] < y), key=lambda found: found[0])
    else:
        x = max((p.largest(y) for p in made if p.y[0] <= y <= p.y[1]), key=lambda found: found[0])[1]
    r = _rational(_rough(chart, nsimplify(y, rational=True)))
    edge = _edge(chart, nsimplify(round(x, 6), rational=True), nsimplify(y, rational=True))
    ends = [{u: v, m: r} for v in (edge, Rational(1), Rational(-1)) if -1 <= v <= 1]
    return max(ends, key=lambda p: float(error.at(p).mid()) if error.at(p).is_finite() else -1.0)


def _edge(chart: Chart, x: Expr, y: Expr) -> Rational:
    """The first variable on the line x, rounded to six digits."""
    here = float(chart.across.subs({chart.x: x, chart.y: y}))
    return Rational(f"{max(-1.0, min(1.0, here)):.6g}")


def _rough(chart: Chart, y: Expr) -> Expr:
    return chart.rough.subs(chart.y, y)


def _rational(e: Expr) -> Rational:
    return e if e.is_Rational else Rational(f"{float(e):.9g}")


def _ball(e: Expr) -> arb:
    return compile_ball(e, ())((), False).real if not e.is_Rational else arb(int(e.p)) / int(e.q)


# --- numbers in words ---------------------------------------------------------------------------------


def _rounded_down(y: float, digits: int = 4) -> Rational:
    unit = Rational(10) ** (floor(log10(y)) + 1 - digits)
    return unit * floor(y / float(unit) + 1e-9)


def _rounded_up(y: float, digits: int = 4) -> Rational:
    return _rounded_down(y, digits) + Rational(10) ** (floor(log10(y)) + 1 - digits)


def _decimal(e: Expr) -> str:
    return f"{float(e):.4g}"


def _short(x: float) -> str:
    return f"{x:.2e}"


def _ceiling(x: float) -> str:
    power = floor(log10(x)) - 2
    return f"{-floor(-x / 10**power - 1e-9) * 10**power:.2e}"


def _shown(point: Mapping[Symbol, Expr]) -> dict[str, str]:
    return {str(k): f"{float(v):.9g}" for k, v in point.items()}


def _replayed(claim: Claim, spec: Accuracy, recorded: Mapping[str, Any]) -> Found:
    """The recorded points once more, and the bound on the last piece before the recorded end."""
    from xsec_sym.proof.wire import decode

    if recorded.get("claim") != claim.id or "accuracy" not in recorded:
        raise Unbounded("the recorded certificate is not one for this claim")
    kept = recorded["accuracy"]
    chart, tolerance = spec.chart, kept["tolerance"]
    points = [dict(zip(claim.domain.symbols, map(decode, p), strict=True)) for p in kept["points"]]
    worst, broken = points
    error = Error(claim, claim.form)
    holds_to = decode(kept["holds to"])
    if not error.at(broken) > tolerance:
        raise Unbounded("the recorded point no longer breaks the tolerance")
    end = float(holds_to)
    near = (0.99 * end, end)
    reach_x = (float(chart.reach[0]), float(chart.reach[1]))
    made = list(panels(_surface(claim, chart), reach_x, near, tolerance * SHARP * 2))
    if not max(p.bound(None, 160) for p in made) <= tolerance:
        raise Unbounded("the bound next to the recorded end no longer holds")
    size = error.at(worst)
    evidence = {"within": str(spec.within), "largest error": _short(float(size.mid())), "where": _shown(worst),
                "proved bound": _ceiling(kept["bound"])}  # fmt: skip
    rests_on = tuple(getattr(getattr(type(claim.left), "fast", None), "RESTS_ON", ()))
    spread = _spread(claim, chart, float(spec.start), end)
    return Found(tolerance, worst, size, kept["bound"], holds_to, broken, [*points, *spread], evidence, rests_on)
