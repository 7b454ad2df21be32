"""Enclosures of one-dimensional integrals and of series.

An integral is split where its integrand switches branch.  At an end where the integrand is singular, or at
infinity, the distance y to that end (or 1/|x|) becomes a power of a new variable t, and powers of y, log y
and exp(-c/y^m) are gathered into single factors that stay bounded as t -> 0.  Nothing is bounded by guess: a
divergent integral leaves an unbounded factor, and so has no enclosure.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import suppress
from itertools import pairwise
from math import inf, lcm
from types import SimpleNamespace

import flint
import sympy as sp
from flint import acb, arb
from sympy import Dummy, Expr, Rational, S, Symbol

from xsec_sym.proof.ball_compile import HANDLERS, NoEnclosure, compile_ball, rational_near
from xsec_sym.proof.ball_edges import gather, lead, singular, singular_inside, vanishing_divisor
from xsec_sym.proof.ball_functions import NAN
from xsec_sym.proof.branches import SWITCHES, breakpoints, resolve
from xsec_sym.proof.say import said
from xsec_sym.proof.zeros import Undecided, less

_PLAIN = 6_000  # evaluations spent before an end is looked at more closely
clock = SimpleNamespace(until=inf)  # by the processor's time, so that a verdict does not depend on what else runs
Piece = Callable[[], acb]


# --- integrals up to an end ---------------------------------------------------------------------------------------


def _end(f: Expr, x: Symbol, at: Expr, inward: int, reach: Expr) -> Piece | None:
    """The integral over the ``reach`` next to an end; None where the integrand is smooth there."""
    y, t = Dummy("y", positive=True), Dummy("t", positive=True)
    infinite = at in (sp.oo, -sp.oo)
    if infinite and f.has(sp.sinh, sp.cosh):
        f = sp.powsimp(
            sp.expand_mul(
                f.replace(sp.cosh, lambda z: (sp.exp(z) + sp.exp(-z)) / 2).replace(
                    sp.sinh, lambda z: (sp.exp(z) - sp.exp(-z)) / 2
                )
            )
        )
    local = f.subs(x, -inward / y if infinite else at + inward * y)
    r, g = lead(local, y)
    removed = not infinite and (r.is_negative or g.has(sp.log(y)) or vanishing_divisor(g, y))
    if removed:
        r, g = lead(local, y, True)
    if infinite:
        r -= 2
    whole = y**r * g
    if not (infinite or removed or singular(whole, y) or singular_inside(local, y)):
        return None
    k = lcm(*[p.exp.q for p in whole.atoms(sp.Pow) if p.base == y and p.exp.is_Rational and p.exp.q < 13], 1)
    low = r if r.is_Rational else rational_near(r)
    if -1 < low < 0:
        k *= -(-1 // (k * (1 + low)).limit_denominator(1000)) if k * (1 + low) < 1 else 1
    if whole.has(sp.log(y)):
        k *= 2  # t log t is bounded, log t is not
    moved = sp.powdenest(whole.subs(y, t**k) * k * t ** (k - 1))
    moved = moved.replace(sp.log(t**k), k * sp.log(t)) if k > 1 else moved
    run, last = compile_ball(gather(moved, t), (t,), True), compile_ball(reach ** Rational(1, k), ())
    return lambda: _integrate(lambda z, a: run((z,), a), acb(0), last((), False))


def _integrate(f: Callable[[acb, bool], acb], low: acb, high: acb, limit: int = 60_000) -> acb:
    failures: list[Exception] = []

    def guarded(z: acb, a: bool) -> acb:
        # an exception must not cross the C code that calls this
        if failures:
            return NAN
        try:
            if time.process_time() > clock.until:
                raise NoEnclosure("the time for an integral ran out")
            return f(z, a)
        except Exception as error:
            failures.append(error)
            return NAN

    out = acb.integral(guarded, low, high, eval_limit=limit)
    if failures:
        raise failures[0]
    return out


# --- integrals ---------------------------------------------------------------------------------------------------


def _pieces(f: Expr, x: Symbol, a: Expr, b: Expr) -> list[Piece]:
    if a == -sp.oo or b == sp.oo:
        finite = b if a == -sp.oo else a
        cut = S.Zero if finite in (sp.oo, -sp.oo) else sp.floor(rational_near(finite))
        cut = cut + 2 if b == sp.oo else cut - 1
        cut = max(cut, S.One) if b == sp.oo else min(cut, S.NegativeOne)
        far, inward = (sp.oo, -1) if b == sp.oo else (-sp.oo, 1)
        tail = _end(f, x, far, inward, 1 / abs(cut))
        assert tail is not None
        return [tail, *(_pieces(f, x, a, cut) if b == sp.oo else _pieces(f, x, cut, b))]
    return [_plain_first(f, x, a, b)]


def _plain_first(f: Expr, x: Symbol, a: Expr, b: Expr) -> Piece:
    """Bisection alone often masters a mild end, and costs less than looking at the end symbolically."""
    run = compile_ball(f, (x,), True)
    start, stop = compile_ball(a, ()), compile_ball(b, ())
    with_ends: list[Piece] = []

    def piece() -> acb:
        if not with_ends:
            out = _integrate(lambda z, an: run((z,), an), start((), False), stop((), False), _PLAIN)
            if out.is_finite() and out.real.rel_accuracy_bits() >= flint.ctx.prec - 24:
                return out
            with_ends.extend(_with_ends(f, x, a, b))
        return sum((p() for p in with_ends), acb(0))

    return piece


def _with_ends(f: Expr, x: Symbol, a: Expr, b: Expr) -> list[Piece]:
    half = (b - a) / 2
    left, right = _end(f, x, a, 1, half), _end(f, x, b, -1, half)
    run = compile_ball(f, (x,), True)
    start, stop = (compile_ball(p, ()) for p in (a if left is None else a + half, b if right is None else b - half))
    found = [p for p in (left, right) if p is not None]
    if len(found) < 2:
        found.append(lambda: _integrate(lambda z, an: run((z,), an), start((), False), stop((), False)))
    return found


def _split(f: Expr, x: Symbol, a: Expr, b: Expr) -> list[tuple[Expr, Expr, Expr]]:
    delicate = {p.base for p in f.atoms(sp.Pow) if not (p.exp.is_Integer and p.exp > 0)}
    delicate |= {p.args[0] for p in f.atoms(sp.log)}
    marks: list[Expr] = []
    for g in delicate:
        # poles and branch points inside are only better off as ends: where they cannot be found, nothing is lost
        if g.has(x) and not g.has(*SWITCHES):
            with suppress(Undecided):
                marks += breakpoints(sp.sign(g), x, a, b)
    if not f.has(*SWITCHES) and not marks:
        return [(f, a, b)]
    marker = sp.Add(*[sp.Abs(x - p) for p in marks]) if marks else S.Zero
    ends = [a, *breakpoints(f + marker, x, a, b), b]
    return [(resolve(f, x, p, q), p, q) for p, q in pairwise(ends)]


def integral(e: sp.Integral) -> Piece:
    """A recipe for the ball of an integral at the current precision."""
    x = e.limits[0][0]
    if len(e.limits) != 1 or len(e.limits[0]) != 3 or any(x in i.free_symbols for i in e.function.atoms(sp.Integral)):
        raise NoEnclosure(f"nested integral or missing limits: {said(e)}")
    a, b = e.limits[0][1:]
    f = e.function
    try:
        if a == b:
            return lambda: acb(0)
        if less(b, a):
            backwards = integral(sp.Integral(f, (x, b, a)))
            return lambda: -backwards()
        u = Dummy("x", real=True)
        pieces = [piece for g, p, q in _split(f.subs(x, u), u, a, b) if g != 0 for piece in _pieces(g, u, p, q)]
    except Undecided as error:
        raise NoEnclosure(f"{said(e)} has no enclosure: {error}") from error

    def total() -> acb:
        out = acb(0)
        for piece in pieces:
            out += piece()
            if not out.is_finite():
                raise NoEnclosure(f"{said(e)} diverges, or has a singularity not removed here")
        return out

    return total


# --- series ------------------------------------------------------------------------------------------------------


def _all_zero_after(term: Expr, n: Symbol, first: Expr) -> Expr | None:
    """The last index before a factor 0^(a n + b), a > 0, makes all terms 0, if the other factors are finite there."""
    factors = list(sp.Mul.make_args(term))
    zero = next((p for p in factors if isinstance(p, sp.Pow) and p.base == 0 and p.exp.has(n)), None)
    if zero is None:
        return None
    factors.remove(zero)
    slope, start = sp.diff(zero.exp, n), zero.exp.subs(n, 0)
    rest = sp.Mul(*factors)
    ratio = rest if rest.is_rational_function(n) else sp.hypersimp(rest, n)
    if (
        not (slope.is_Rational and slope > 0 and start.is_Rational)
        or ratio is None
        or not ratio.is_rational_function(n)
    ):
        return None
    end = max(sp.floor(-start / slope), first - 1)
    poles = sp.Poly(sp.denom(sp.cancel(ratio)), n).ground_roots()
    return None if any(root >= end for root in poles) else end


def series(e: sp.Sum) -> Piece:
    """A recipe for the ball of a finite sum, or of a series whose ratio of terms is bounded below 1."""
    if len(e.limits) != 1:
        raise NoEnclosure(f"nested sum: {said(e)}")
    n, first, last = e.limits[0]
    term = compile_ball(e.function, (n,))
    if first.is_Integer and last.is_Integer:
        if last < first - 1:
            raise NoEnclosure(f"the sum {said(e)} runs backwards, and there are two conventions for that")
        span = range(int(first), int(last) + 1)
        if len(span) > 200_000:
            raise NoEnclosure(f"{said(e)} has too many terms to be added one by one")

        def finite() -> acb:
            out = acb(0)
            for i in span:
                out += term((acb(i),), False)
            return out

        return finite
    if not (first.is_Integer and last == sp.oo):
        raise NoEnclosure(f"the limits of {said(e)} are not integers or infinity")
    if (end := _all_zero_after(e.function, n, first)) is not None:
        return series(sp.Sum(e.function, (n, first, end)))
    ratio = sp.hypersimp(e.function, n)
    if ratio is None or not ratio.is_rational_function(n):
        raise NoEnclosure(f"{said(e)} has no proved bound on its tail")
    s = Dummy("s")
    bound = compile_ball(sp.cancel(ratio.subs(n, 1 / s)), (s,))

    def infinite() -> acb:
        out, i = acb(0), int(first)
        for _ in range(200):
            step = max(8, abs(i) // 2)
            for j in range(i, i + step):
                out += term((acb(j),), False)
            i += step
            if i < 1:
                continue
            reach = abs(bound((acb(arb(0).union(arb(1) / i)),), False))
            if not (reach.is_finite() and reach < 1):
                if i > 4096:
                    break
                continue
            tail = abs(term((acb(i),), False)) / (1 - reach)
            if tail < arb(2) ** (-flint.ctx.prec - 5) or tail < abs(out) * arb(2) ** (-flint.ctx.prec - 5):
                edge = tail.upper()
                return out + acb(arb(0, 1) * edge, arb(0, 1) * edge)
            if i > 100_000:
                break
        raise NoEnclosure(f"{said(e)} converges too slowly, or not at all, for a bound on its tail")

    return infinite


HANDLERS[sp.Integral] = integral
HANDLERS[sp.Sum] = series
