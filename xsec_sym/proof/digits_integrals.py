"""Integrals, nested ones included, and sums of mpmath numbers.

The inner integral of a nested one is split anew for each value of the outer variable, where its switches are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import Any

import sympy as sp
from mpmath import mp, mpf
from sympy import Dummy, Expr, S, Symbol

from xsec_sym.proof.branches import SWITCHES, breakpoints, choose, switching
from xsec_sym.proof.digits_compile import HANDLERS, Run, Slots, compile_mp
from xsec_sym.proof.quadrature import Memory, NoValue, legendre, tanh_sinh
from xsec_sym.proof.say import said
from xsec_sym.proof.zeros import Undecided, zeros

Points = Mapping[Symbol, Sequence[Any]]


@dataclass(frozen=True)
class Rule:
    """How many digits an integral should have, and which of two independent sets of nodes to use."""

    goal: int = 30
    stride: int = 0


_rule = ContextVar("rule", default=Rule())  # noqa: B039  (a frozen dataclass)
_marks: ContextVar[Points | None] = ContextVar("marks", default=None)


@contextmanager
def setting(rule: Rule, points: Points | None) -> Iterator[None]:
    rule_token, marks = _rule.set(rule), _marks.set(points)
    try:
        yield
    finally:
        _rule.reset(rule_token)
        _marks.reset(marks)


def _hoist(f: Expr, x: Symbol, found: dict[Expr, Symbol]) -> Expr:
    """``f`` with its largest parts free of ``x`` named, so that they are computed once for all nodes."""
    if not f.has(x):
        return f if f.is_Number else found.setdefault(f, Dummy("c"))
    if isinstance(f, sp.Integral | sp.Sum | sp.Piecewise) or not f.args or f == x:
        return f
    if isinstance(f, sp.Add | sp.Mul):
        still, moving = f.as_independent(x, as_Add=isinstance(f, sp.Add))
        if isinstance(f, sp.Mul) and still != 1 and len(f.args) > 2:
            return sp.Mul(_hoist(still, x, found), _hoist(moving, x, found), evaluate=False)
        if isinstance(f, sp.Add) and still != 0 and len(f.args) > 2:
            return sp.Add(_hoist(still, x, found), _hoist(moving, x, found), evaluate=False)
    if isinstance(f, sp.exp) and f.args[0].has(x):
        # exp(-p^2 - q^2) as a product: where q is huge, p would be lost in the sum
        still, moving = f.args[0].expand().as_independent(x, as_Add=True)
        if still != 0:
            return sp.Mul(_hoist(sp.exp(still), x, found), _hoist(sp.exp(moving), x, found), evaluate=False)
    return f.func(*[_hoist(p, x, found) for p in f.args], **({"evaluate": False} if isinstance(f, SWITCHES) else {}))


def _integral(e: sp.Integral, slots: Slots) -> Run:
    *inner, (x, *ends) = e.limits
    if len(ends) != 2:
        raise NoValue(f"{said(e)} has no limits")
    f = sp.Integral(e.function, *inner) if inner else e.function
    nested = bool(e.free_symbols & set(slots))
    named: dict[Expr, Symbol] = {}
    body = _hoist(f, x, named) if nested else f
    inside = {**slots}
    for s in [x, *named.values()]:
        inside[s] = len(inside)
    if len(inside) != len(slots) + 1 + len(named):
        raise NoValue(f"{x} is used twice in {said(e)}")
    constants = [compile_mp(c, slots) for c in named]
    run = compile_mp(body, inside)
    place, width = inside[x], len(inside)
    ends, copies = _halved(body, x, ends)
    low, high = (compile_mp(p, slots) for p in ends)
    settled = _settler(body, x, inside, run) if nested else None
    cuts = _numeric_cuts(body, x, inside) if nested else _exact_cuts(f, x, *ends)
    marks = [compile_mp(sp.sympify(p), {}) for p in (_marks.get() or {}).get(x, ())]
    seen = Memory()

    def total(v: list[Any]) -> Any:
        w = v + [None] * (width - len(v))
        w[place + 1 :] = [c(v) for c in constants]

        def g(z: mpf) -> Any:
            w[place] = z
            return run(w)

        a, b = mpf(low(v)), mpf(high(v))
        if a == b:
            return mpf(0)
        mids = {mpf(p) for p in [*cuts(w, a, b), *(m(v) for m in marks)] if min(a, b) < p < max(a, b)}
        nodes = [a, *sorted(mids, reverse=a > b), b]
        rule = _rule.get()
        if settled is None or (mp.isinf(a) and mp.isinf(b) and len(nodes) == 2):
            return copies * _in_turn(g, list(pairwise(nodes)), rule)
        out = mpf(0)
        for p, q in pairwise(nodes):
            finite = mp.isfinite(q - p)
            w[place] = (p + q) / 2 if finite else q - 1 if mp.isfinite(q) else p + 1
            if (here := settled(w)) is not None:
                inside = partial(_at, here, w, place)
                if finite:
                    out += copies * legendre(inside, p, q, rule.goal + 4, seen, rule.stride)
                else:
                    out += copies * tanh_sinh(inside, p, q, rule.goal + 4, rule.stride, seen)
        return out

    return total


def _halved(f: Expr, x: Symbol, ends: list[Expr]) -> tuple[list[Expr], int]:
    """Half the range, twice, for an integrand that SymPy knows to be even about the middle."""
    a, b = ends
    if a.is_finite and b.is_finite and not f.has(sp.Integral) and f.has(x) and f.xreplace({x: a + b - x}) == f:
        return [a, (a + b) / 2], 2
    if (a, b) == (-sp.oo, sp.oo) and f.has(x) and f.xreplace({x: -x}) == f:
        return [S.Zero, b], 2
    return ends, 1


def _in_turn(g: Callable[[mpf], Any], pieces: list[tuple[Any, Any]], rule: Rule) -> Any:
    # a piece on which the integrand is all rounding waits until the others have shown how large they are
    out, seen, waiting = mpf(0), Memory(), []
    for p, q in pieces:
        try:
            out += tanh_sinh(g, p, q, rule.goal + 2, rule.stride, seen)
        except NoValue:
            if len(pieces) == 1:
                raise
            waiting.append((p, q))
    return out + mp.fsum(tanh_sinh(g, p, q, rule.goal + 2, rule.stride, seen) for p, q in waiting)


def _at(run: Run, w: list[Any], place: int, z: mpf) -> Any:
    w[place] = z
    return run(w)


def _settler(f: Expr, x: Symbol, slots: Slots, plain: Run) -> Callable[[list[Any]], Run | None]:
    """From a point between two switches, the integrand without switches there; None where it is 0.

    Deciding once for each piece, not at each node, keeps rounding near a switch point from undoing the choice.
    """
    gaps = sorted(switching(_masked(f), x), key=str)
    if not gaps:
        return lambda w: plain
    runs = [compile_mp(g, slots) for g in gaps]
    known: dict[tuple[int, ...], Run | None] = {}

    def settled(w: list[Any]) -> Run | None:
        signs = tuple(int(mp.sign(r(w))) for r in runs)
        if signs not in known:
            table = dict(zip(gaps, signs, strict=True))
            chosen = choose(f, lambda g: table[g] if g in table else -table[-g], lambda e: e.has(x))
            known[signs] = None if chosen == 0 else compile_mp(chosen, slots)
        return known[signs]

    return settled


Cuts = Callable[[list[Any], Any, Any], list[Any]]


def _masked(f: Expr) -> Expr:
    return f.xreplace({i: Dummy() for i in f.atoms(sp.Integral)})


def _exact_cuts(f: Expr, x: Symbol, a: Expr, b: Expr) -> Cuts:
    masked = _masked(f)
    u = Dummy("x", real=True)
    try:
        points = breakpoints(masked.subs(x, u).xreplace({s: S.One for s in masked.free_symbols - {x}}), u, a, b)
        for i in f.atoms(sp.Integral):
            points += _edges(i, x, a, b)
    except Undecided as error:
        raise NoValue(str(error)) from error
    runs = [compile_mp(p, {}) for p in dict.fromkeys(points)]
    return lambda v, low, high: [r(v) for r in runs]


def _edges(inner: sp.Integral, x: Symbol, a: Expr, b: Expr) -> list[Expr]:
    """Where the inner switch points A + B cos(y) = 0 appear or vanish: |A| = |B|."""
    y = inner.limits[-1][0]
    found: list[Expr] = []
    for g in switching(inner.function, y):
        for wave in [s for s in g.atoms(sp.cos, sp.sin) if s.has(y)]:
            A, B = g.coeff(wave, 0), g.coeff(wave, 1)
            if not (A.has(y) or B.has(y)) and (A.has(x) or B.has(x)):
                u = Dummy("x", real=True)
                found += [p for p in zeros(sp.expand(A**2 - B**2).subs(x, u), u, a, b)]
    return found


def _numeric_cuts(f: Expr, x: Symbol, slots: Slots) -> Cuts:
    """Switch points found anew for each value of the outer variables."""
    finders = [_numeric_zeros(g, x, slots) for g in switching(_masked(f), x)]
    return lambda v, a, b: [p for find in finders for p in find(v, a, b)]


def _numeric_zeros(g: Expr, x: Symbol, slots: Slots) -> Cuts:
    t = Dummy("t")
    gens = [s for s in sp.Poly(g).gens if s.has(x)] if g != x else [x]
    if len(gens) != 1 or not (gens[0] == x or isinstance(gens[0], sp.cos | sp.sin)):
        raise NoValue(f"the switch points of {g} in {x} are not searched for")
    coefficients = [compile_mp(c, slots) for c in sp.Poly(g.subs(gens[0], t), t).all_coeffs()]
    if gens[0] == x:
        return lambda v, a, b: _real_roots([c(v) for c in coefficients])
    line = sp.Poly(gens[0].args[0], x)
    if line.degree() != 1:
        raise NoValue(f"the switch points of {g} in {x} are not searched for")
    slope, offset = (compile_mp(c, slots) for c in line.all_coeffs())
    is_cos = isinstance(gens[0], sp.cos)

    def waves(v: list[Any], a: Any, b: Any) -> list[Any]:
        found = []
        p, q, turn = slope(v), offset(v), 2 * mp.pi
        for c in _real_roots([k(v) for k in coefficients]):
            if abs(c) <= 1:
                angle = mp.acos(c) if is_cos else mp.asin(c)
                for start in (angle, -angle if is_cos else mp.pi - angle):
                    first, last = sorted((p * end + q - start) / turn for end in (a, b))
                    found += [(start + turn * n - q) / p for n in range(int(mp.ceil(first)), int(mp.floor(last)) + 1)]
        return found

    return waves


def _real_roots(coefficients: list[Any]) -> list[Any]:
    while coefficients and coefficients[0] == 0:
        coefficients = coefficients[1:]
    if len(coefficients) < 2:
        return []
    if len(coefficients) == 2:
        return [-mpf(coefficients[1]) / coefficients[0]]
    if len(coefficients) == 3:
        p, q, r = (mpf(c) for c in coefficients)
        inner = q * q - 4 * p * r
        return [(-q + s * mp.sqrt(inner)) / (2 * p) for s in (-1, 1)] if inner >= 0 else []
    tiny = mpf(2) ** (-mp.prec // 3)
    return [mp.re(z) for z in mp.polyroots(coefficients, maxsteps=200, extraprec=200) if abs(mp.im(z)) < tiny]


def _sum(e: sp.Sum, slots: Slots) -> Run:
    if len(e.limits) != 1:
        raise NoValue(f"nested sum: {said(e)}")
    n, first, last = e.limits[0]
    inside = {**slots, n: len(slots)}
    term, (low, high) = compile_mp(e.function, inside), (compile_mp(p, slots) for p in (first, last))

    def total(v: list[Any]) -> Any:
        a, b = low(v), high(v)
        if not mp.isinf(b):
            if b < a - 1:
                raise NoValue("a sum runs backwards, and there are two conventions for that")
            return mp.fsum(term([*v, k]) for k in range(int(a), int(b) + 1))
        return _series(lambda k: term([*v, int(k)]), int(a), str(e))

    return total


def _series(term: Callable[[Any], Any], first: int, name: str) -> Any:
    total, tiny = mpf(0), mpf(2) ** -mp.prec
    for k in range(first, first + 4000):
        t = term(k)
        total += t
        # a run of terms this small, each at most 0.95 of the one before, leaves nothing
        if abs(t) <= tiny * abs(total) / 100 and abs(term(k + 1)) <= abs(t) * mpf("0.95") and k > first + 8:
            return total
    if abs(term(10**6)) * 10**6 > mpf("0.01"):
        raise NoValue(f"the terms of {name} do not decrease fast enough")
    one, two = (mp.nsum(term, [first, mp.inf], method=m) for m in ("richardson+shanks", "levin"))
    if abs(one - two) > abs(one) * mpf(10) ** -_rule.get().goal:
        raise NoValue(f"two ways of summing {name} disagree")
    return one


HANDLERS[sp.Integral] = _integral
HANDLERS[sp.Sum] = _sum
