"""What the author of an accuracy claim says of its chart, tail and limit, tried at exact points."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import Any

from flint import acb, arb
from sympy import Rational, sympify

from xsec_sym.proof.accuracy import Accuracy
from xsec_sym.proof.ball_compile import NoEnclosure, compile_ball, precision
from xsec_sym.proof.balls import enclose
from xsec_sym.proof.claim import Claim
from xsec_sym.proof.digits import NoValue, value
from xsec_sym.proof.error import Error, Unbounded, ball, edge, fast_of, left_value, on_chart, onto, roughness, shown
from xsec_sym.proof.suprema import BITS
from xsec_sym.proof.zeros import Undecided

DIGITS = 30
LAST = 1 - Rational(1, 10**9)  # the forms of this field are undefined at the poles, and continuous there


def tried(claim: Claim, spec: Accuracy, claims: Mapping[str, Claim]) -> dict[str, Any]:
    """How many comparisons went well. Raises `Unbounded` at the first that does not."""
    found = {"chart compared at": _chart(claim, spec), "left side compared at": _left(claim, spec, claims)}
    error = Error(claim, claim.form)
    words = _even(claim, spec, error) + _tail(claim, spec, error) + _limit(claim, spec, error)
    return {**found, "words tried at": words}


def _heights(spec: Accuracy) -> list[Rational]:
    """Values of y from the easy end to past the claim's."""
    start = Rational(str(float(spec.start))) or Rational(1, 7)
    return [start * Rational(8, 5) ** k for k in (1, 3, 5, 7, 9)]


def _chart(claim: Claim, spec: Accuracy) -> int:
    """The chart's form is the claim's."""
    chart = spec.chart
    low, high = (sympify(v) for v in chart.reach)
    run = on_chart(chart)
    own = compile_ball(claim.form.subs(onto(claim, chart), simultaneous=True), (chart.x, chart.y))
    across = [low + (high - low) * Rational(2 * i + 1, 11) for i in range(5)]
    with precision(8 * BITS):
        for x, y in product(across, _heights(spec)):
            given = (acb(ball(x)), acb(ball(y)))
            gap = run(given, False) - own(given, False)
            if not (gap.is_finite() and gap.contains(0) and abs(gap) < arb(10) ** -DIGITS):
                raise Unbounded(f"the chart's form is not the claim's at {chart.x} = {x}, {chart.y} = {y}")
    return len(across) * len(_heights(spec))


def _left(claim: Claim, spec: Accuracy, claims: Mapping[str, Claim]) -> int:
    """The fast left side is the definition: by mpmath on the definition, and by balls on what is proved of it."""
    from xsec_sym.proof.numeric import reduced

    fast = fast_of(claim)
    if fast is None:
        return 0
    agreed = 0
    helper = next((claims[name] for name in fast.CHECKED_BY if name in claims), None)
    for share, part in ((Rational(1, 2), 1), (Rational(-3, 10), 1), (Rational(9, 10), Rational(3, 4))):
        r = roughness(spec.chart, spec.chart.y_of.subs(claim.domain.symbols[1], spec.end) * part)
        r = Rational(str(round(float(r), 4)))
        point = dict(zip(claim.domain.symbols, (share * min(Rational(1), 3 * r), r), strict=True))
        with precision(2 * BITS):
            quick = left_value(claim, [ball(v) for v in point.values()])
        try:
            if helper is not None:
                slow = enclose(reduced(claim.left, [helper]).subs(point), DIGITS - 6, 5.0)
                agrees = bool((slow - quick).contains(0))
            else:
                agrees = abs(float(value(claim.left.subs(point), 8)) - float(quick.mid())) < 1e-7 * float(quick.mid())
        except (NoValue, NoEnclosure, Undecided):
            continue
        if not agrees:
            raise Unbounded(f"the left side's fast evaluation is wrong at {shown(point)}")
        agreed += 1
    if not agreed:
        raise Unbounded("the left side's fast evaluation could not be compared with the definition")
    return agreed


def _even(claim: Claim, spec: Accuracy, error: Error) -> int:
    u, m = claim.domain.symbols
    if not spec.chart.even:
        return 0
    shares = (Rational(1, 3), Rational(9, 10), Rational(1))
    for y, share in product(_heights(spec)[:3], shares):
        r = roughness(spec.chart, y)
        share = min(share, LAST)
        gap = error.at({u: share, m: r}) - error.at({u: -share, m: r})
        if not (gap.contains(0) and abs(gap) < arb(10) ** -12):
            raise Unbounded("the error is not even")
    return 3 * len(shares)


def _tail(claim: Claim, spec: Accuracy, error: Error) -> int:
    u, m = claim.domain.symbols
    chart, tail = spec.chart, spec.tail
    if tail is None:
        return 0
    extra = compile_ball(tail.extra, (chart.y,))
    heights = _heights(spec)[:4]
    for y in heights:
        r = roughness(chart, y)
        at = edge(chart, float(tail.edge), float(y))
        with precision(4 * BITS):
            most = error.at({u: at, m: r}) + extra((acb(ball(y)),), False).real
        for part in range(5):
            here = abs(at) + (1 - abs(at)) * Rational(part, 4)
            for v in (here, -here):
                # the edge is rounded to six digits
                v = max(-LAST, min(v, LAST))
                if not error.at({u: v, m: r}) <= most * (1 + arb(10) ** -3) + arb(10) ** -9:
                    raise Unbounded(f"the tail's bound fails at {shown({u: v, m: r})}")
    return 10 * len(heights)


def _limit(claim: Claim, spec: Accuracy, error: Error) -> int:
    u, m = claim.domain.symbols
    if spec.limit is None:
        return 0
    bound = compile_ball(spec.limit.bound, (spec.chart.y,))
    shares = (0, Rational(1, 2), 1, 2, 5, 10**9)
    for k, share in product(range(3), shares):
        y = Rational(str(float(spec.limit.y))) / 3**k
        for sign in (1, -1):
            point = {u: sign * min(LAST, share * y), m: roughness(spec.chart, y)}
            if not error.at(point) <= bound((acb(ball(y)),), False).real:
                raise Unbounded(f"the limit's bound fails at {shown(point)}")
    return 6 * len(shares)
