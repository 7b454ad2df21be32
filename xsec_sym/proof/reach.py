"""How far an accuracy really reaches: bounds on the error strip by strip, until it exceeds the tolerance.

The search starts at the easy end of the roughness range and moves on until the tolerance is exceeded and the claimed
range is covered. So it finds the reach whether the claim holds or not.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from math import inf
from typing import Any

from flint import acb, arb
from sympy import Expr, Rational

from xsec_sym.proof.accuracy import Accuracy, Chart
from xsec_sym.proof.ball_compile import compile_ball, precision
from xsec_sym.proof.claim import Claim
from xsec_sym.proof.error import (
    Error,
    Point,
    Unbounded,
    ceiling,
    decimal,
    edge,
    lemmas_of,
    roughness,
    rounded_down,
    rounded_up,
    short,
    shown,
    spread,
    surface,
)
from xsec_sym.proof.suprema import BITS, Panel, Surface, panels
from xsec_sym.proof.tried import tried

LOOSE, SHARP = 0.3, 1e-4  # how wrong an interpolant may be, per tolerance: far from the end, and next to it
STEP = 1.25  # from one strip of the roughness range to the next
FIRST = 0.5  # the first strip where the range begins at y = 0
FARTHEST = 400  # strips


@dataclass
class Found:
    """What a search came to: the largest error in the claimed range with a bound on it, and the reach in y."""

    tolerance: float
    worst: Point
    worst_error: arb
    bound: float
    holds_to: Expr
    broken: Point
    points: list[Point]
    evidence: dict[str, Any]
    rests_on: tuple[str, ...] = ()

    def certificate(self, claim: Claim) -> dict[str, Any]:
        from xsec_sym.proof.wire import encode

        points = [[encode(p[s]) for s in claim.domain.symbols] for p in (self.worst, self.broken)]
        kept = {"tolerance": self.tolerance, "bound": self.bound, "holds to": encode(self.holds_to), "points": points}
        leans = [["rests on", {"proven": name}] for name in self.rests_on]
        return {"format": 1, "claim": claim.id, "moves": leans, "accuracy": kept}


@dataclass(frozen=True)
class Beyond:
    """A bound on the error where the chart does not reach: the error on its edge, and what may be added."""

    panels: list[Panel]
    extra: Any

    def bound(self, y: tuple[float, float], enough: float = 0.0) -> float:
        """For all of a range of y; it is made sharp only where it exceeds what is ``enough``."""
        here = [p for p in self.panels if p.y[0] <= y[1] and y[0] <= p.y[1]]
        on_edge = max(p.bound((max(y[0], p.y[0]), min(y[1], p.y[1]))) for p in here)
        earlier = inf
        for count in (1,) if y[0] == y[1] else (16, 128, 1024):
            most = self._extra(y, count)
            if on_edge + most <= enough or earlier - most < 1e-4 * most:
                break
            earlier = most
        return (on_edge + most) * (1 + 1e-12)

    def _extra(self, y: tuple[float, float], count: int) -> float:
        cuts = [y[0] + (y[1] - y[0]) * i / count for i in range(count)] + [y[1]]
        with precision(BITS):
            steps = [acb(arb(a).union(arb(b))) for a, b in pairwise(cuts)]
            most = max(float(self.extra((step,), False).real.upper()) for step in steps)
        if not most < inf:
            raise Unbounded("the tail has no finite bound")
        return most


@dataclass(frozen=True)
class Strip:
    low: float
    high: float
    panels: list[Panel]
    beyond: Beyond | None

    def at(self, y: float) -> float:
        """About the largest error for one y."""
        inside = max(p.largest(y)[0] for p in self.panels if p.y[0] <= y <= p.y[1])
        return max(inside, self.beyond.bound((y, y)) if self.beyond else 0.0)

    @property
    def peak(self) -> float:
        return max(max(p.peak(p.y)[0] for p in self.panels), self.at(self.high))

    def bound(self, end: float, so_far: float) -> float:
        largest = so_far
        for p in self.panels:
            if p.y[0] < end:
                y = (p.y[0], min(p.y[1], end))
                here = p.bound(y, 24)
                # many points where it matters: the loss falls with the square of their number
                largest = max(largest, p.bound(y, 160) if here > 0.9 * largest else here)
        return max(largest, self.beyond.bound((self.low, min(self.high, end)), largest) if self.beyond else 0.0)


def searched(claim: Claim, spec: Accuracy, claims: Mapping[str, Claim]) -> Found:
    """Bound the error from the start of the range to past its reach and past the claim's end."""
    chart, tolerance = spec.chart, float(spec.within)
    checks = tried(claim, spec, claims)
    ground = _limit(spec, tolerance)
    m = claim.domain.symbols[1]
    y_end = float(chart.y_of.subs(m, spec.end))
    strips = _strips(claim, spec, tolerance, y_end)
    reach = _crossing(strips, tolerance)
    holds_to = rounded_down(reach * (1 - 3e-4))
    proved = _bound(strips, float(holds_to), ground)
    if not proved <= tolerance:
        raise Unbounded(f"up to {float(holds_to):.5g} the error is bounded by {proved:.5g} only")
    bound = _bound(strips, y_end, ground)
    error = Error(claim, claim.form)
    worst = _worst(chart, strips, y_end, error)
    broken = _candidate(chart, strips, float(rounded_up(reach * (1 + 1e-4))), error)
    if not error.at(broken) > tolerance:
        raise Unbounded("no point was found that breaks the tolerance")
    size = error.at(worst)
    words = [part.because for part in (spec.tail, spec.limit) if part] + [chart.even] * bool(chart.even)
    if chart.removable is not None:
        words.append(
            f"at {chart.y} = {chart.removable:g} the poles of the parts cancel, since the form is bounded there"
        )
    first = float(spec.start)
    evidence = {
        "within": decimal(spec.within),
        "largest error": short(size),
        "where": shown(worst),
        "proved bound": ceiling(bound),
        "reach": f"{m} = {decimal(roughness(chart, reach), 5)}",
        "holds to": f"{m} = {decimal(roughness(chart, holds_to), 5)}",
        "broken at": {**shown(broken), "error": error.at(broken).mid().str(6, radius=False)},
        "interpolants": sum(len(s.panels) for s in strips),
        "bounded by balls": f"from {m} = {decimal(roughness(chart, first))}" if first > 0 else f"to {m} = oo",
        "rests on": list(lemmas_of(claim)),
        "in words": words,
        **checks,
    }
    points = [worst, broken, *spread(claim, chart, first, min(y_end, float(holds_to)))]
    return Found(tolerance, worst, size, bound, holds_to, broken, points, evidence, lemmas_of(claim))


def _strips(claim: Claim, spec: Accuracy, tolerance: float, y_end: float) -> list[Strip]:
    f = surface(claim, spec.chart)
    strips: list[Strip] = []
    low = float(spec.start)
    while True:
        high = low * STEP if low > 0 else FIRST
        sharp = (bool(strips) and strips[-1].peak > tolerance / 3) or low <= y_end <= high
        strip = _strip(spec, f, (low, high), tolerance * (SHARP if sharp else LOOSE))
        if not sharp and strip.peak > tolerance / 2:
            strip = _strip(spec, f, (low, high), tolerance * SHARP)
        strips.append(strip)
        low = high
        if high > y_end and strips[-1].peak > 1.02 * tolerance:
            return strips
        if len(strips) > FARTHEST:
            raise Unbounded("the error stays below the tolerance as far as was searched")


def _strip(spec: Accuracy, f: Surface, y: tuple[float, float], error: float) -> Strip:
    reach = (float(spec.chart.reach[0]), float(spec.chart.reach[1]))
    return Strip(*y, list(panels(f, reach, y, error)), _beyond(spec, f, y, error))


def _beyond(spec: Accuracy, f: Surface, y: tuple[float, float], error: float) -> Beyond | None:
    if spec.tail is None:
        return None
    at = float(spec.tail.edge)
    return Beyond(list(panels(f, (at, at), y, error)), compile_ball(spec.tail.extra, (spec.chart.y,)))


def _limit(spec: Accuracy, tolerance: float) -> float:
    """The error's bound between y = 0 and the start of the strips."""
    if spec.limit is None:
        return 0.0
    with precision(BITS):
        size = compile_ball(spec.limit.bound.subs(spec.chart.y, spec.limit.y), ())((), False).real
    if not size < tolerance or float(spec.start) > float(spec.limit.y):
        raise Unbounded("the limit's bound does not meet the first strip below the tolerance")
    return float(size.upper())


def _bound(strips: list[Strip], end: float, ground: float) -> float:
    """A bound on the error for all y up to ``end``. The hardest strips come first, so that easy ones cost little."""
    largest = 0.0
    for strip in reversed(strips):
        if strip.low < end:
            largest = strip.bound(end, largest)
    return max(largest, ground)


def _crossing(strips: list[Strip], tolerance: float) -> float:
    """Where the largest error first reaches the tolerance, by bisection on the interpolants."""
    for strip in strips:
        if strip.peak <= tolerance:
            continue
        low, high = strip.low, strip.high
        if strip.at(low) > tolerance:
            raise Unbounded("the tolerance is exceeded from the start")
        while high - low > 1e-7 * high:
            middle = (low + high) / 2
            low, high = (low, middle) if strip.at(middle) > tolerance else (middle, high)
        return low
    raise Unbounded("the tolerance is never reached")


def _worst(chart: Chart, strips: list[Strip], y_end: float, error: Error) -> Point:
    """About the worst point of the claimed range."""
    found = [_candidate(chart, strips, y_end, error)]
    for p in (p for s in strips for p in s.panels if p.y[0] < y_end):
        size, _, y = p.peak((p.y[0], min(p.y[1], y_end)))
        if size > float(error.at(found[0]).mid()) * (1 + 1e-6):
            found.insert(0, _candidate(chart, strips, y, error))
    return max(found, key=lambda p: float(error.at(p).mid()))


def _candidate(chart: Chart, strips: list[Strip], y: float, error: Error) -> Point:
    """An exact point where the error is about as large as it gets for this y."""
    u, m = error.claim.domain.symbols
    lines = [p.largest(y) for s in strips for p in s.panels if p.y[0] <= y <= p.y[1]]
    x = max(lines)[1]
    r = roughness(chart, Rational(f"{y:.9g}"))
    last = 1 - Rational(1, 10**6)  # where a form is undefined at the pole itself
    places = (edge(chart, x, y), Rational(1), Rational(-1), last, -last)
    sizes = [({u: v, m: r}, error.at({u: v, m: r})) for v in places]
    return max((float(size.mid()), i, p) for i, (p, size) in enumerate(sizes) if size.is_finite())[2]
