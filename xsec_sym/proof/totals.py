"""Integrals and sums in the normal form: atoms, once their terms and their constant factors stand apart."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sympy import Add, Expr, Integral, Mul, Rational, S, Sum, Symbol, default_sort_key, oo

from xsec_sym.proof.atoms import Unsettled
from xsec_sym.proof.names import captured
from xsec_sym.proof.shapes import bounded, hidden_name, split_exponent

if TYPE_CHECKING:
    from xsec_sym.proof.field import Field


def integral(field: Field, e: Integral) -> Expr:
    """An integral as a sum of atoms: term by term where each term is sure to exist, and without factors free of x."""
    if len(e.limits) != 1 or len(e.limits[0]) != 3:
        raise Unsettled("only an integral over one variable between two limits is an atom")
    x, low, high = e.limits[0]
    if field.piece.is_zero(high - low):
        return S.Zero
    order = field.piece.sign(high - low)
    if order in ("-", "<=") or (order is None and default_sort_key(low) > default_sort_key(high)):
        return -field.atomise(Integral(e.function, (x, high, low)))
    inner = field.piece.inside(x, low, high).field
    top, bottom = inner.fraction(e.function)
    if top.is_zero:
        return S.Zero
    if bottom.total_degree():
        top, bottom = top.cancel(bottom, include=True)  # squares of roots may have left a common factor
    moving = {a for a in top.free_symbols | bottom.free_symbols if inner.meaning.get(a, a).has(x)}
    constant, factors = bottom.factor_list()
    outside = Mul(constant, *(f.as_expr() ** k for f, k in factors if not f.free_symbols & moving))
    inside = Mul(*(f.as_expr() ** k for f, k in factors if f.free_symbols & moving))
    hidden = Symbol(hidden_name("x", e), real=True)
    limits = (hidden, *(end if end in (oo, -oo) else field._argument(end) for end in (low, high)))
    tame = not {low, high} & {oo, -oo} and all(bounded(inner.meaning.get(a, a)) for a in moving)
    if (len(top.terms()) > 1 and not tame) or inside != 1:
        # term by term the integral might not exist: such an integrand stays whole, but for factors without x
        drawn, factors = top.factor_list()
        whole = Mul(*(f.as_expr() ** k for f, k in factors if f.free_symbols & moving))
        outside /= Mul(drawn, *(f.as_expr() ** k for f, k in factors if not f.free_symbols & moving))
        body = inner._meant(whole / inside)
        return field.atomise(inner._meant(1 / outside)) * field._atom(
            "int", Integral(body.xreplace({x: hidden}), limits)
        )
    coefficients: dict[Expr, Expr] = {}
    for powers, coefficient in top.terms():
        parts = [g**k for g, k in zip(top.gens, powers, strict=True)]
        body = Mul(*(p for p, g in zip(parts, top.gens, strict=True) if g in moving))
        rest = Mul(coefficient, *(p for p, g in zip(parts, top.gens, strict=True) if g not in moving))
        coefficients[body] = coefficients.get(body, S.Zero) + rest
    total: Expr = S.Zero
    for body, coefficient in coefficients.items():
        meaning = Integral(inner._meant(body / inside).xreplace({x: hidden}), limits)
        total += field.atomise(inner._meant(coefficient / outside)) * field._atom("int", meaning)
    return total


def series(field: Field, e: Sum) -> Expr:
    """A sum up to n + k becomes the sum up to n and k single terms."""
    if len(e.limits) != 1:
        raise Unsettled("only a single sum is an atom")
    j, low, high = e.limits[0]
    if captured([e.function], low, high) or low.has(j) or high.has(j) or {low, high} & {-oo}:
        raise Unsettled(f"the limits of {e} share a name with its terms, or it has no beginning")
    if not (high == oo or (high - low + 1).is_nonnegative):
        raise Unsettled(f"{e} may run backwards")
    plain = Symbol(hidden_name("i", e), integer=True, nonnegative=True if low.is_nonnegative else None)
    function = e.function.subs(j, plain)  # of the index nothing else is known, whatever its name is
    e, j = Sum(function, (plain, low, high)), plain
    if high == oo:
        return _summed(field, e.function.subs(j, j + low), j, S.Zero, oo)
    if (high - low).is_Integer and high - low >= -1:
        return Add(*(field.atomise(e.function.subs(j, low + i)) for i in range(int(high - low) + 1)))
    fixed, moving = split_exponent(high)
    if not moving or not fixed.is_Integer or not low.is_Integer:
        raise Unsettled(f"the limits of {e} are not integers with one moving end")
    top = high - fixed
    atom = _summed(field, e.function, j, low, top)
    extra = [e.function.xreplace({j: top + i}) for i in (range(1, fixed + 1) if fixed > 0 else range(fixed + 1, 1))]
    tail = Add(*(field.atomise(t) for t in extra))
    return atom + tail if fixed > 0 else atom - tail


def _summed(field: Field, term: Expr, j: Symbol, low: Expr, high: Expr) -> Expr:
    """A sum is an atom, but for factors that do not depend on the index."""
    top, bottom = field.fraction(term)
    if top.is_zero:
        return S.Zero
    moving = {a for a in top.free_symbols | bottom.free_symbols if field.meaning.get(a, a).has(j)}
    fixed, kept = S.One, S.One
    for polynomial, side in ((top, 1), (bottom, -1)):
        constant, factors = polynomial.factor_list()
        fixed *= Rational(constant) ** side
        for f, k in factors:
            if f.free_symbols & moving:
                kept *= f.as_expr() ** (side * k)
            else:
                fixed *= f.as_expr() ** (side * k)
    name = hidden_name("j", Sum(term, (j, low, high)))
    hidden = Symbol(name, integer=True, nonnegative=True if low >= 0 else None)
    return fixed * field._atom("sum", Sum(field._meant(kept).xreplace({j: hidden}), (hidden, low, high)))
