"""What an expression tends to at an end of a range: at infinity, or where it is singular.

With d > 0 the distance to the end, or 1 / |x| at an infinite one, each part is followed as (c + o(1)) d^p with c free
of d, or as something that vanishes faster than every power of d. Nothing here oscillates, and nothing is guessed: a
part without a rule is refused.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

from sympy import (
    Add,
    Dummy,
    Expr,
    Integer,
    Mul,
    Poly,
    PolynomialError,
    Pow,
    Rational,
    S,
    Symbol,
    atan,
    erf,
    exp,
    fraction,
    log,
    oo,
    pi,
    together,
)

from xsec_sym.proof.piece import Piece
from xsec_sym.proof.regular import Refused, continuous_at, demand
from xsec_sym.proof.say import said


@dataclass(frozen=True)
class Trend:
    """(factor + o(1)) d^order as d goes to 0; without an order, less than every power of d."""

    factor: Expr
    order: Rational | None = S.Zero

    @property
    def vanishes(self) -> bool:
        return self.order is None or self.order > 0


FLAT = Trend(S.Zero, None)


def end_value(e: Expr, x: Symbol, end: Expr, side: str, outer: Piece) -> Expr:
    """The value of e at an end of a range, or the one that it tends to.

    ``side`` names the end, low or high; without one, which is so where the ends' order is not known, e must be
    continuous there.
    """
    if end not in (oo, -oo):
        with suppress(Refused):
            continuous_at(e, x, end, outer)
            return e.subs(x, end)
    found = trend(e, x, end, side, outer)
    demand(found.vanishes or found.order == 0, lambda: f"{said(e)} is not shown to stay finite at {x} = {end}")
    return S.Zero if found.vanishes else found.factor


def tends_to(e: Expr, x: Symbol, end: Expr, side: str, value: Expr, outer: Piece) -> bool:
    """Whether e is shown to tend to a value, which may be infinite."""
    if value not in (oo, -oo):
        return outer.is_zero(end_value(e, x, end, side, outer) - value)
    found = trend(e, x, end, side, outer)
    falls = found.order is not None and found.order < 0
    return falls and outer.sign(found.factor) == ("+" if value == oo else "-")


def trend(e: Expr, x: Symbol, end: Expr, side: str, outer: Piece) -> Trend:
    demand(side in ("low", "high"), lambda: f"from which side {end} is approached is not known")
    demand((end == oo) <= (side == "high") and (end == -oo) <= (side == "low"), "a range does not end there")
    d = Dummy("d", positive=True)
    infinite = {oo: 1 / d, -oo: -1 / d}
    return _trend(e.xreplace({x: infinite.get(end, end + d if side == "low" else end - d)}), d, outer)


def _trend(e: Expr, d: Symbol, outer: Piece) -> Trend:
    if not e.has(d):
        return Trend(e)
    if e == d:
        return Trend(S.One, Integer(1))
    if isinstance(e, Add):
        return _quotient(e, d, outer) or _sum(e, d, outer)
    if isinstance(e, Mul):
        parts = [_trend(a, d, outer) for a in e.args]
        if any(p.order is None for p in parts):
            return FLAT
        return Trend(Mul(*(p.factor for p in parts)), Add(*(p.order for p in parts)))
    if isinstance(e, Pow) and e.exp.is_Rational:
        return _power(_trend(e.base, d, outer), e, outer)
    if isinstance(e, exp | erf | atan | log):
        return _transcendental(e, _trend(e.args[0], d, outer), outer)
    raise Refused(f"nothing is known of {said(e)} near the end")


def _quotient(e: Expr, d: Symbol, outer: Piece) -> Trend | None:
    """A quotient of polynomials in d, by the lowest terms that are not zero."""
    lowest = []
    for part in fraction(together(e)):
        try:
            terms = sorted(Poly(part, d).terms())
        except PolynomialError:
            return None
        if any(c.has(d) for _, c in terms):
            return None
        kept = [(powers[0], c) for powers, c in terms if not outer.is_zero(c)]
        lowest.append(kept[0] if kept else (0, S.Zero))
    (above, top), (below, bottom) = lowest
    return Trend(top / bottom, Integer(above - below)) if outer.sign(bottom) in ("+", "-") else None


def _sum(e: Expr, d: Symbol, outer: Piece) -> Trend:
    """The lowest order counts. Where its factors cancel, 0 is left: still true, only weaker."""
    parts = [(p.order, p.factor) for p in (_trend(a, d, outer) for a in e.args) if p.order is not None]
    if not parts:
        return FLAT
    least = min(order for order, _ in parts)
    return Trend(Add(*(factor for order, factor in parts if order == least)), least)


def _power(base: Trend, e: Expr, outer: Piece) -> Trend:
    k = e.exp
    if k > 0 and (base.order is None or k.is_Integer):
        return FLAT if base.order is None else Trend(base.factor**k, base.order * k)
    demand(base.order is not None, lambda: f"{said(e.base)} may vanish too fast")
    here = outer.sign(base.factor)
    demand(
        here == "+" or (here == "-" and k.is_Integer), lambda: f"the sign of {said(e.base)} near the end is not known"
    )
    return Trend(base.factor**k, base.order * k)


def _transcendental(e: Expr, inner: Trend, outer: Piece) -> Trend:
    """exp, erf, atan or log of what vanishes, of what has a limit, or of what grows with a known sign."""
    c = S.Zero if inner.vanishes else inner.factor
    if inner.vanishes or inner.order == 0:
        demand(not isinstance(e, log) or outer.sign(c) == "+", lambda: f"{said(e)} may be infinite")
        return Trend(e.func(c))
    rising = outer.sign(c)
    demand(rising in ("+", "-") and not isinstance(e, log), lambda: f"the sign of {said(e.args[0])} is not known")
    if isinstance(e, exp):
        demand(rising == "-", lambda: f"{said(e)} grows faster than every power")
        return FLAT
    limit = S.One if isinstance(e, erf) else pi / 2
    return Trend(limit if rising == "+" else -limit)


__all__ = ["Trend", "end_value", "tends_to", "trend"]
