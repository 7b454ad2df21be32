"""How an integrand behaves at an end of its range, written so that balls can follow it there.

Powers of the distance y > 0, of its logarithm and decaying exponentials exp(-c/y^m) are gathered into single
factors that vanish, or stay bounded, as y -> 0; singularities that only seem to be there are divided out.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp
from flint import acb, arb
from sympy import Expr, Rational, S, Symbol

from xsec_sym.proof.ball_compile import SPECIAL, Closure
from xsec_sym.proof.ball_functions import NAN
from xsec_sym.proof.zeros import Undecided, sign_of


class Edge(sp.Function):
    """y^r log(y)^n exp(g y^-m) for y > 0, with arguments (y, r, n, m, g); it vanishes as y -> 0."""

    nargs = 5


def _edge(e: Any, build: Callable[[Any], Closure]) -> Closure:
    y, r, m, g = (build(e.args[i]) for i in (0, 1, 3, 4))
    power, times, depth = e.args[1], int(e.args[2]), e.args[3]
    whole = int(power) if power.is_Integer else None

    def f(v: Any, a: bool) -> acb:
        z = y(v, a)
        if z.real > 0:
            out = z**whole if whole is not None else z.pow(r(v, a), analytic=a)
            if times:
                out *= z.log(analytic=a) ** times
            return out * (g(v, a) * z.pow(-m(v, a), analytic=a)).exp() if depth else out
        if a or not z.imag.is_zero():
            return NAN
        # only y >= 0 matters on the path, so the ball is replaced by [0, top]
        top, p, q = z.real.upper(), r(v, a), -g(v, a)
        if not (top > 0 and top < 1 and p.imag.is_zero() and q.imag.is_zero()):
            return NAN
        if depth:
            # |log y| <= 1/y, after which y^s exp(-q/y^m) increases up to its turning point
            s, low = p.real - times, arb(q.real.lower()) if q.is_finite() else arb(0)
            d = m(v, a).real
            if not (low > 0 and (s >= 0 or top**d < -low * d / s)):
                return NAN
            reach = top**s * (-low * top ** (-d)).exp()
        else:
            if not (p.real > 0 and (times == 0 or top.log() < -times / p.real)):
                return NAN
            reach = top**p.real * abs(top.log()) ** times
        reach = reach.upper()
        return acb(arb(0).union(reach) if not times % 2 else arb(0).union(-reach))

    return f


class Erfcx(sp.Function):
    """exp(z^2) erfc(z) for z = g y^-m > 0, with arguments (y, m, g); it lies between 0 and 1."""

    nargs = 3


def _erfcx(e: Any, build: Callable[[Any], Closure]) -> Closure:
    y, m, g = (build(p) for p in e.args)

    def f(v: Any, a: bool) -> acb:
        z, c = y(v, a), g(v, a)
        if z.real > 0:
            w = c * z.pow(-m(v, a), analytic=a)
            return (w * w).hypgeom_u(acb(0.5), acb(0.5)) / acb.pi().sqrt() if w.real > 0 else NAN
        return acb(arb(0).union(arb(1))) if not a and z.imag.is_zero() and c.imag.is_zero() and c.real > 0 else NAN

    return f


SPECIAL[Edge], SPECIAL[Erfcx] = _edge, _erfcx


def _is_zero(c: Expr) -> bool:
    try:
        return not c.free_symbols and sign_of(c) == 0
    except Undecided:
        return False


def lead(e: Expr, y: Symbol, open_up: bool = False) -> tuple[Expr, Expr]:
    """(r, g) with e = y^r g for y > 0, where g should tend to a finite limit other than 0 as y -> 0.

    ``open_up`` writes sin(z), log(1 + z), exp(z) - 1, ... with z -> 0 as z times an entire function.
    """
    if not e.has(y):
        return S.Zero, e
    if e == y:
        return S.One, S.One
    if isinstance(e, sp.Mul):
        parts = [lead(p, y, open_up) for p in e.args]
        return sp.Add(*[r for r, _ in parts]), sp.Mul(*[g for _, g in parts])
    if isinstance(e, sp.Pow):
        if e.exp.has(y):
            return lead(sp.exp(e.exp * sp.log(e.base)), y, open_up)
        r, g = lead(e.base, y, open_up)
        return (r * e.exp, g**e.exp) if r.is_real and e.exp.is_real else (S.Zero, e)
    if isinstance(e, sp.Add):
        return _lead_sum(e, y, open_up)
    r, g = lead(e.args[0], y, open_up)
    if isinstance(e, sp.exp):
        return S.Zero, sp.exp(y**r * g)
    if isinstance(e, sp.log):
        if open_up and r == 0 and _at_zero(g, y) == 1:
            s, h = lead(g - 1, y, True)
            return s, h * sp.hyper((1, 1), (2,), 1 - g)
        return S.Zero, r * sp.log(y) + sp.log(g)
    if isinstance(e, sp.erfc) and r.is_negative and _sign_at_zero(g, y) > 0:
        return S.Zero, sp.exp(-(y ** (2 * r)) * (g**2).expand()) * Erfcx(y, -r, g)
    if open_up and r.is_positive and type(e) in _VANISHING:
        return r, g * _VANISHING[type(e)](y**r * g)
    return S.Zero, e.func(*[y**q * h for q, h in (lead(p, y, open_up) for p in e.args)])


_VANISHING: dict[Any, Callable[[Expr], Expr]] = {
    sp.sin: sp.sinc,
    sp.sinh: lambda z: sp.sinc(S.ImaginaryUnit * z, evaluate=False),
    sp.tan: lambda z: sp.sinc(z) / sp.cos(z),
    sp.atan: lambda z: sp.hyper((S.Half, 1), (Rational(3, 2),), -(z**2)),
    sp.asin: lambda z: sp.hyper((S.Half, S.Half), (Rational(3, 2),), z**2),
    sp.atanh: lambda z: sp.hyper((S.Half, 1), (Rational(3, 2),), z**2),
    sp.asinh: lambda z: sp.hyper((S.Half, S.Half), (Rational(3, 2),), -(z**2)),
    sp.erf: lambda z: 2 / sp.sqrt(sp.pi) * sp.hyper((S.Half,), (Rational(3, 2),), -(z**2)),
}


def _at_zero(g: Expr, y: Symbol) -> Expr:
    return g.subs(y, 0) if not g.has(sp.log(y)) else S.NaN


def _sign_at_zero(g: Expr, y: Symbol) -> int:
    try:
        return sign_of(_at_zero(g, y))
    except Undecided:
        return 0


def _growing(term: Expr, y: Symbol) -> Expr | None:
    for p in sp.Mul.make_args(term):
        if isinstance(p, sp.exp):
            r, g = lead(p.args[0], y)
            if r.is_negative and _sign_at_zero(g, y) > 0:
                return p.args[0]
    return None


def _lead_sum(e: Expr, y: Symbol, open_up: bool) -> tuple[Expr, Expr]:
    terms = sp.Add.make_args(sp.expand(e, log=False, power_base=False, power_exp=False, basic=False))
    largest = next((big for term in terms if (big := _growing(term, y)) is not None), None)
    if largest is not None:
        rest = sp.Add(*[term * sp.exp(-largest) for term in terms])
        if all(_growing(term, y) is None for term in sp.Add.make_args(rest)):
            r, g = lead(rest, y, open_up)
            return r, sp.exp(largest) * g
    groups: dict[Expr, Expr] = {}
    for term in terms:
        for part in _opened(term, y) if open_up else [term]:
            r, g = lead(part, y, open_up)
            groups[r] = groups.get(r, S.Zero) + g
    if not all(r.is_Rational for r in groups):
        return S.Zero, sp.Add(*[y**r * g for r, g in groups.items()])
    order = sorted(r for r, g in groups.items() if g != 0)
    while len(order) > 1 and _is_zero(groups[order[0]]):
        order.pop(0)
    if not order:
        return S.Zero, S.Zero
    return order[0], sp.Add(*[y ** (r - order[0]) * groups[r] for r in order])


def _opened(term: Expr, y: Symbol) -> list[Expr]:
    """c exp(z) as c + c z M(1, 2, z), and c cos(z), c cosh(z) likewise, where z -> 0."""
    c, rest = term.as_independent(y, as_Add=False)
    if isinstance(rest, sp.exp | sp.cos | sp.cosh) and lead(rest.args[0], y)[0].is_positive:
        z = rest.args[0]
        if isinstance(rest, sp.exp):
            return [c, c * z * sp.hyper((1,), (2,), z)]
        half = z / 2 if isinstance(rest, sp.cos) else S.ImaginaryUnit * z / 2
        return [c, -c * z**2 * (1 if isinstance(rest, sp.cos) else -1) * sp.sinc(half, evaluate=False) ** 2 / 2]
    return [term]


def _has_log_factor(term: Expr, t: Symbol) -> bool:
    return any(p.as_base_exp()[0] == sp.log(t) for p in sp.Mul.make_args(term))


def gather(e: Expr, t: Symbol) -> Expr:
    """Products of powers, logarithms and decaying exponentials of ``t`` as single ``Edge`` factors."""
    if not e.has(t) or not e.args:
        return e
    if isinstance(e, sp.Pow) and e.base == t:
        return e if e.exp.is_Integer else Edge(t, e.exp, 0, 0, 0)
    if isinstance(e, sp.Mul | sp.exp):
        logs = any(isinstance(p, sp.Add) and any(_has_log_factor(q, t) for q in p.args) for p in e.args)
        depth = sp.Add(*[p.as_base_exp()[1] for p in sp.Mul.make_args(e) if p.as_base_exp()[0] == t])
        if logs or (depth.is_negative and any(isinstance(p, sp.Add) for p in e.args)):
            return sp.Add(*[gather(p, t) for p in sp.Add.make_args(sp.expand_mul(e, deep=False))])
        r, n, m, g, rest = S.Zero, 0, S.Zero, S.Zero, []
        for p in sp.Mul.make_args(e):
            base, power = p.as_base_exp() if not isinstance(p, sp.exp) else (p, S.One)
            if base == t:
                r += power
            elif base == sp.log(t) and power.is_Integer and power > 0:
                n += int(power)
            elif isinstance(p, sp.exp) and m == 0 and (pair := lead(p.args[0], t))[0].is_negative:
                m, g = -pair[0], pair[1]
            else:
                rest.append(p)
        if m or n or not r.is_Integer:
            return sp.Mul(Edge(t, r, n, m, gather(g, t)), *[gather(p, t) for p in rest])
        if isinstance(e, sp.exp):
            return sp.exp(gather(e.args[0], t))
        return sp.Mul(t**r, *[gather(p, t) for p in rest])
    return e.func(*[gather(p, t) for p in e.args])


def singular(e: Expr, y: Symbol) -> bool:
    """Whether an expression in normal form is anything but smooth at y = 0, as far as its powers of y tell."""
    if e.has(sp.log(y)):
        return True
    return any(p.base == y and not (p.exp.is_Integer and p.exp > 0) for p in e.atoms(sp.Pow)) or any(
        p.args[0].subs(y, 0) in (S.Zero, S.NaN, S.ComplexInfinity) for p in e.atoms(sp.log) if p.has(y)
    )


def vanishing_divisor(e: Expr, y: Symbol) -> bool:
    return any(
        p.exp.is_negative and p.base.has(y) and not p.base.has(sp.log(y)) and _sign_at_zero(p.base, y) == 0
        for p in e.atoms(sp.Pow)
    )


def singular_inside(e: Expr, y: Symbol) -> bool:
    """Whether a root of something that vanishes at y = 0 stands in ``e``, as in sqrt(y^2), however smooth the whole."""
    roots = {p.base for p in e.atoms(sp.Pow) if not p.exp.is_Integer and p.base.has(y)}
    return any(lead(base, y)[0] != 0 for base in roots)
