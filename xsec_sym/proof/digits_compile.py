"""From SymPy expressions to nested closures over mpmath numbers.

Branches are evaluated lazily: only the one that is taken is looked into.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp
from mpmath import mp, mpf
from sympy import Expr, S, Symbol

from xsec_sym.proof.magnitude import Magnitude
from xsec_sym.proof.quadrature import NoValue
from xsec_sym.proof.say import said

Run = Callable[[list[Any]], Any]
Slots = dict[Symbol, int]
# filled by the module that knows how to integrate and to sum, which needs this one
HANDLERS: dict[type, Callable[[Any, Slots], Run]] = {}

_SAME_NAME = (
    "exp log sin cos tan cot sec csc sinh cosh tanh coth sech csch asin acos atan acot asinh acosh atanh atan2 "
    "erf erfc erfi gamma loggamma factorial binomial rf ff polylog zeta legendre expint sign floor digamma re im"
)
_FUNCTIONS: dict[Any, Callable[..., Any]] = {
    **{getattr(sp, name): getattr(mp, name) for name in _SAME_NAME.split()},
    **{
        getattr(sp, name): getattr(mp, name)
        for name in ("besselj", "bessely", "besseli", "besselk", "airyai", "airybi")
    },
    sp.Abs: abs,
    Magnitude: abs,
    sp.ceiling: mp.ceil,
    sp.Ei: mp.ei,
    sp.polygamma: mp.psi,
    sp.chebyshevt: mp.chebyt,
    sp.chebyshevu: mp.chebyu,
    sp.elliptic_k: mp.ellipk,
    sp.elliptic_e: mp.ellipe,
    sp.elliptic_f: mp.ellipf,
    sp.LambertW: mp.lambertw,
    sp.lowergamma: lambda s, z: mp.gammainc(s, 0, z),
    sp.uppergamma: lambda s, z: mp.gammainc(s, z),
    sp.Max: max,
    sp.Min: min,
}
_CONSTANTS = {S.Pi: "pi", S.Exp1: "e", S.EulerGamma: "euler", S.Catalan: "catalan", S.GoldenRatio: "phi"}
_ORDER: dict[str, Callable[[Any, Any], bool]] = {
    "<": lambda p, q: p < q,
    "<=": lambda p, q: p <= q,
    ">": lambda p, q: p > q,
    ">=": lambda p, q: p >= q,
    "==": lambda p, q: p == q,
    "!=": lambda p, q: p != q,
}


# --- compilation --------------------------------------------------------------------------------------------------


def _constant(make: Callable[[], Any]) -> Run:
    kept: dict[int, Any] = {}

    def f(v: list[Any]) -> Any:
        if mp.prec not in kept:
            kept[mp.prec] = make()
        return kept[mp.prec]

    return f


def compile_mp(e: Any, slots: Slots) -> Run:
    if e.is_Symbol:
        if e not in slots:
            raise NoValue(f"{said(e)} has no value")
        i = slots[e]
        return lambda v: v[i]
    if isinstance(e, sp.Float):
        raise NoValue(f"the floating-point number {said(e)} is not exact")
    if e.is_Integer:
        n = int(e)
        return lambda v: n
    if e.is_Rational:
        return _constant(lambda: mpf(int(e.p)) / int(e.q))
    if e in _CONSTANTS:
        return _constant(lambda: +getattr(mp, _CONSTANTS[e]))
    if e in (S.Infinity, S.NegativeInfinity):
        return lambda v: mpf("inf") if e is S.Infinity else mpf("-inf")
    if e is S.ImaginaryUnit:
        return lambda v: mp.j
    if slots and e.args and not e.free_symbols & set(slots):
        whole = compile_mp(e, {})
        return _constant(lambda: whole([]))
    return _node(e, slots)


def _node(e: Any, slots: Slots) -> Run:
    if type(e) in HANDLERS:
        return HANDLERS[type(e)](e, slots)
    if isinstance(e, sp.Piecewise):
        return _piecewise([(compile_mp(f, slots), _condition(c, slots)) for f, c in e.args])
    if isinstance(e, sp.Heaviside):
        inner, at_zero = compile_mp(e.args[0], slots), compile_mp(e.args[1], slots)
        return lambda v: 1 if (s := inner(v)) > 0 else 0 if s < 0 else at_zero(v)
    if isinstance(e, sp.CRootOf):
        return _constant(lambda: e.evalf(mp.dps + 5)._to_mpmath(mp.prec))
    if isinstance(e, sp.hyper):
        top, low = ([compile_mp(p, slots) for p in ps] for ps in (e.ap, e.bq))
        z = compile_mp(e.argument, slots)
        return lambda v: mp.hyper([p(v) for p in top], [p(v) for p in low], z(v))
    if isinstance(e, sp.exp):
        inner = compile_mp(e.args[0], slots)
        return lambda v: mp.exp(inner(v))
    if isinstance(e, sp.Pow) and isinstance(e.base, sp.gamma) and e.exp == -1:
        at = compile_mp(e.base.args[0], slots)
        return lambda v: mp.rgamma(at(v))  # 0 at the poles
    if isinstance(e, sp.Pow):
        return _power(compile_mp(e.base, slots), e.exp, slots)
    parts = [compile_mp(p, slots) for p in e.args]
    if isinstance(e, sp.Add | sp.Mul):
        return _fold(parts, isinstance(e, sp.Add))
    call = _FUNCTIONS.get(type(e))
    if call is None:
        raise NoValue(f"{type(e).__name__} is not evaluated here")
    if len(parts) == 1:
        (p,) = parts
        return lambda v: call(p(v))
    return lambda v: call(*[p(v) for p in parts])


def _fold(parts: list[Run], adding: bool) -> Run:
    if len(parts) == 2:
        p, q = parts
        return (lambda v: p(v) + q(v)) if adding else (lambda v: p(v) * q(v))
    first, rest = parts[0], _fold(parts[1:], adding)
    return (lambda v: first(v) + rest(v)) if adding else (lambda v: first(v) * rest(v))


def _power(base: Run, e: Expr, slots: Slots) -> Run:
    if e == S.Half:
        return lambda v: mp.sqrt(base(v))
    if e == -S.Half:
        return lambda v: 1 / mp.sqrt(base(v))
    if e.is_Integer:
        n = int(e)
        return lambda v: mpf(base(v)) ** n if isinstance(base(v), int) else base(v) ** n
    w = compile_mp(e, slots)
    return lambda v: mp.power(base(v), w(v))


def _piecewise(pieces: list[tuple[Run, Run]]) -> Run:
    def f(v: list[Any]) -> Any:
        for branch, holds in pieces:
            if holds(v):
                return branch(v)
        raise NoValue("no branch of a Piecewise applies")

    return f


def _condition(c: Any, slots: Slots) -> Run:
    if c in (S.true, S.false):
        return lambda v: bool(c)
    if isinstance(c, sp.core.relational.Relational):
        left, right, order = compile_mp(c.lhs, slots), compile_mp(c.rhs, slots), _ORDER[c.rel_op]
        return lambda v: order(left(v), right(v))
    parts = [_condition(p, slots) for p in c.args]
    if isinstance(c, sp.Not):
        return lambda v: not parts[0](v)
    if isinstance(c, sp.And | sp.Or):
        every = all if isinstance(c, sp.And) else any
        return lambda v: every(p(v) for p in parts)
    raise NoValue(f"the condition {c} is not evaluated here")
