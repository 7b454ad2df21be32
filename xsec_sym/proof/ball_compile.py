"""From SymPy expressions to ball arithmetic.

An expression is compiled once to nested closures ``f(values, analytic) -> acb``.  Under an integral, Arb
asks with ``analytic=True`` for values that hold only if the integrand is holomorphic on the whole ball;
every function with a branch cut answers "not a number" there when the ball may touch its cut.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache
from itertools import pairwise
from typing import Any

import flint
import sympy as sp
from flint import acb, arb
from sympy import Expr, S, Symbol

from xsec_sym.proof.ball_functions import CONSTANTS, NAN, TABLE, hyper, real_only
from xsec_sym.proof.say import said

Closure = Callable[[Sequence[acb], bool], acb]
# filled by the modules that know how to integrate and to sum, which need this one
HANDLERS: dict[type, Callable[[Any], Callable[[], acb]]] = {}
SPECIAL: dict[type, Callable[[Any, Callable[[Any], Closure]], Closure]] = {}
BOUNDED = (sp.sin, sp.cos, sp.tanh, sp.erf, sp.erfc, sp.atan)


class NoEnclosure(ArithmeticError):
    """No narrow rigorous enclosure could be computed; the message says why in one sentence."""


@contextmanager
def precision(bits: int) -> Iterator[None]:
    before = flint.ctx.prec
    flint.ctx.prec = bits
    try:
        yield
    finally:
        flint.ctx.prec = before


# --- compilation --------------------------------------------------------------------------------------------------


def _at_precision(make: Callable[[], acb]) -> Closure:
    kept: dict[int, acb] = {}

    def f(v: Sequence[acb], a: bool) -> acb:
        bits = flint.ctx.prec
        if bits not in kept:
            kept[bits] = make()
        return kept[bits]

    return f


def _power(base: Closure, e: Expr, index: dict[Symbol, int], inside: bool) -> Closure:
    if e.is_Integer:
        n = int(e)
        if n == -1:
            return lambda v, a: 1 / base(v, a)
        if n == 2:
            return lambda v, a: (lambda z: z * z)(base(v, a))
        return lambda v, a: base(v, a) ** n
    if e == S.Half:
        return lambda v, a: base(v, a).sqrt(analytic=a)
    if e == -S.Half:
        return lambda v, a: base(v, a).rsqrt(analytic=a)
    if e.is_Rational and e.q == 2:
        n = int(e.p)
        return lambda v, a: base(v, a).sqrt(analytic=a) ** n
    w = _build(e, index, inside)

    def f(v: Sequence[acb], a: bool) -> acb:
        z, p = base(v, a), w(v, a)
        if not a and z.contains(0) and p.real > 0 and p.imag.is_zero() and not z.is_zero():
            reach = (abs(z).upper() ** p.real).upper()
            return acb((-reach).union(reach), (-reach).union(reach))
        return acb(0) if z.is_zero() and p.real > 0 else z.pow(p, analytic=a)

    return f


def _switch(pieces: list[tuple[Closure, Callable[..., bool | None]]]) -> Closure:
    def f(v: Sequence[acb], a: bool) -> acb:
        out = None
        for branch, condition in pieces:
            truth = condition(v, a)
            if truth is False:
                continue
            if truth is None and a:
                return NAN
            here = branch(v, a)
            out = here if out is None else out.union(here)
            if truth:
                return out
        return NAN

    return f


def _condition(c: Any, index: dict[Symbol, int], inside: bool) -> Callable[..., bool | None]:
    """Three-valued truth on a ball: None where the ball holds points of both kinds."""
    if c in (S.true, S.false):
        return lambda v, a: bool(c)
    if isinstance(c, sp.Not):
        inner = _condition(c.args[0], index, inside)
        return lambda v, a: None if (t := inner(v, a)) is None else not t
    if isinstance(c, sp.And | sp.Or):
        parts = [_condition(p, index, inside) for p in c.args]
        decisive = isinstance(c, sp.Or)

        def many(v: Sequence[acb], a: bool) -> bool | None:
            truths = [p(v, a) for p in parts]
            return decisive if decisive in truths else None if None in truths else not decisive

        return many
    if not isinstance(c, sp.core.relational.Relational):
        raise NoEnclosure(f"the condition {c} has no enclosure here")
    gap, op = _build(c.lhs - c.rhs, index, inside), c.rel_op

    def relation(v: Sequence[acb], a: bool) -> bool | None:
        z = gap(v, a)
        if not a and not z.imag.contains(0):
            return None
        d = z.real
        if op in ("==", "!="):
            return (op == "!=") if not d.contains(0) else (op == "==") if d.is_zero() else None
        if op[0] == "<":
            d = -d
        return True if (d > 0 if len(op) == 1 else d >= 0) else False if (d <= 0 if len(op) == 1 else d < 0) else None

    return relation


def _build(e: Any, index: dict[Symbol, int], inside: bool) -> Closure:
    if e.is_Symbol:
        if e not in index:
            raise NoEnclosure(f"{said(e)} has no value")
        i = index[e]
        return lambda v, a: v[i]
    if isinstance(e, sp.Float):
        raise NoEnclosure(f"the floating-point number {said(e)} is not exact")
    if e.is_Integer:
        return _at_precision(lambda: acb(int(e)))
    if e.is_Rational:
        return _at_precision(lambda: acb(flint.fmpq(int(e.p), int(e.q))))
    if e in CONSTANTS:
        return _at_precision(CONSTANTS[e])
    if isinstance(e, sp.Integral | sp.Sum):
        outer = e.free_symbols
        if outer:
            raise NoEnclosure(f"nested integral or sum: {said(e)} depends on {', '.join(sorted(map(str, outer)))}")
        if type(e) not in HANDLERS:
            raise NoEnclosure(f"{said(e)} has no enclosure here")
        return _at_precision(HANDLERS[type(e)](e))
    if index and not e.free_symbols and e.args:
        whole = _build(e, {}, False)
        return _at_precision(lambda: whole((), False))
    return _node(e, index, inside)


def _node(e: Any, index: dict[Symbol, int], inside: bool) -> Closure:
    if isinstance(e, sp.Piecewise):
        return _switch([(_build(branch, index, inside), _condition(c, index, inside)) for branch, c in e.args])
    if isinstance(e, sp.CRootOf):
        return _at_precision(lambda: _root(e))
    if isinstance(e, sp.hyper):
        return _hyper_node(e, index, inside)
    if isinstance(e, sp.Pow):
        if e.base == S.Exp1:
            exponent = _build(e.exp, index, inside)
            return lambda v, a: exponent(v, a).exp()
        return _power(_build(e.base, index, inside), e.exp, index, inside)
    if type(e) in SPECIAL:
        return SPECIAL[type(e)](e, lambda part: _build(part, index, inside))
    parts = [_build(p, index, inside) for p in e.args]
    if isinstance(e, sp.Add):
        return _fold(parts, acb.__add__)
    if isinstance(e, sp.Mul):
        return _fold(parts, acb.__mul__)
    if isinstance(e, sp.Max):
        return _fold(parts, None, acb.real_max)
    if isinstance(e, sp.Min):
        return _fold(parts, None, acb.real_min)
    call = TABLE.get(type(e))
    if call is None:
        raise NoEnclosure(f"{type(e).__name__} has no enclosure here")
    if isinstance(e, sp.Abs) and inside:
        # under an integral |z| continues as +-z, which is wrong for a z that is not real on the path
        call = real_only(lambda z, a: z.real_abs(analytic=a))
    if isinstance(e, BOUNDED) and inside and e.args[0].is_extended_real:
        return _bounded(call, parts[0])
    if isinstance(e, sp.besselj) and inside and e.args[0].is_integer:
        doubtful = [p for p in sp.Mul.make_args(e.args[1]) if not p.is_extended_real]
        return _wave(call, parts[0], parts[1], [_build(p, index, inside) for p in doubtful])
    if len(parts) == 1:
        (p,) = parts
        return lambda v, a: call(a, p(v, a))
    return lambda v, a: call(a, *[p(v, a) for p in parts])


def _bounded(call: Callable[..., acb], argument: Closure) -> Closure:
    # keeps sin(1/y), erf(1/y), ... finite on a real ball that reaches an infinite argument
    box = acb(arb(0, 2))

    def f(v: Sequence[acb], a: bool) -> acb:
        out = call(a, argument(v, a))
        return out if a or out.is_finite() else box

    return f


def _wave(call: Callable[..., acb], order: Closure, argument: Closure, doubtful: list[Closure]) -> Closure:
    # likewise J_n of whole order, never above 1, where every factor of its argument is real on the ball
    box = acb(arb(0, 1))

    def f(v: Sequence[acb], a: bool) -> acb:
        out = call(a, order(v, a), argument(v, a))
        if a or (out.is_finite() and abs(out) < 2):
            return out
        real = all(p.imag.is_zero() and p.is_finite() for p in (g(v, a) for g in doubtful))
        return box if real and all(z.imag.is_zero() for z in v) else out

    return f


def _fold(parts: list[Closure], op: Any, switch: Any = None) -> Closure:
    first, rest = parts[0], parts[1:]
    if switch is None and len(rest) == 1:
        (second,) = rest
        if op is acb.__add__:
            return lambda v, a: first(v, a) + second(v, a)
        return lambda v, a: first(v, a) * second(v, a)

    def f(v: Sequence[acb], a: bool) -> acb:
        total = first(v, a)
        for part in rest:
            value = part(v, a)
            if switch is None:
                total = op(total, value)
            elif not a and not (total.imag.contains(0) and value.imag.contains(0)):
                return NAN
            else:
                total = switch(total, value, analytic=a)
        return total

    return f


def _root(e: sp.CRootOf) -> acb:
    coefficients = [int(c) for c in reversed(e.poly.all_coeffs())]
    found: Any = flint.fmpz_poly(coefficients).complex_roots()
    roots = [z for z, _ in found]
    real = sorted((z for z in roots if z.imag.is_zero()), key=lambda z: float(z.real.mid()))
    if e.index >= len(real) or any(not p.real < q.real for p, q in pairwise(real)):
        return NAN
    return real[e.index]


def _hyper_node(e: sp.hyper, index: dict[Symbol, int], inside: bool) -> Closure:
    top = [_build(p, index, inside) for p in e.ap]
    low = [_build(p, index, inside) for p in e.bq]
    z = _build(e.argument, index, inside)
    return lambda v, a: hyper(a, z(v, a), [p(v, a) for p in top], [p(v, a) for p in low])


@lru_cache(maxsize=5_000)
def compile_ball(expr: Expr, symbols: tuple[Symbol, ...], inside: bool = False) -> Closure:
    """``expr`` as a function of balls for ``symbols``; ``inside`` for use under an integral.

    >>> from sympy import sqrt, symbols
    >>> x = symbols("x")
    >>> compile_ball(sqrt(x), (x,))([acb(-1)], False)
    1.00000000000000j
    >>> compile_ball(sqrt(x), (x,))([acb(-1)], True).is_finite()
    False
    """
    return _build(expr, {s: i for i, s in enumerate(symbols)}, inside)


def rational_near(c: Expr) -> sp.Rational:
    """A rational close to a real constant, for choosing sample points: nothing is claimed about its distance."""
    with precision(96):
        ball = compile_ball(c, ())((), False)
        if not ball.is_finite():
            raise NoEnclosure(f"{c} could not be located")
        man, exponent = ball.real.mid().man_exp()
    return sp.Rational(int(man)) * sp.Integer(2) ** int(exponent)
