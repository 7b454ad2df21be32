"""The move that acts on an integral over the whole plane: polar coordinates."""

from __future__ import annotations

from sympy import Integral, Sum, Symbol, cos, oo, pi, sin

from xsec_sym.proof.calculus import outer_names, parts_of
from xsec_sym.proof.rules import Goal, demand


def polar(goal: Goal, integral: Integral, radius: Symbol, azimuth: Symbol) -> list[Goal]:
    """The integral over q and p, both from -oo to oo, over the radius and the azimuth: p + i q = r e^(i phi).

    The integrand keeps one sign (Tonelli), so that neither the order nor the shape of growing domains matters.
    """
    f, q, low, high, _, inner = parts_of(goal, integral)
    outside, rest = f.as_independent(Integral, as_Add=False)
    demand(
        isinstance(rest, Integral) and len(rest.limits) == 1 and len(rest.limits[0]) == 3,
        lambda: f"{f} is not a factor times one inner integral",
    )
    p, a, b = rest.limits[0]
    demand((low, high, a, b) == (-oo, oo, -oo, oo), "the integral is not over the whole plane")
    demand(not outside.has(p), lambda: f"{p} is used twice in {integral}")
    integrand = outside * rest.function
    demand(not integrand.has(Integral, Sum), "an integral or a sum is left in the integrand")
    used = integral.atoms(Symbol) | outer_names(goal, integral) | goal.right.free_symbols
    demand(radius != azimuth and not {radius, azimuth} & used, "the new variables already stand for something else")
    demand(bool(radius.is_real and azimuth.is_real), "the new variables are not known to be real")
    shown = inner.inside(p, a, b).sign(integrand)
    demand(shown in ("+", ">=", "-", "<=", "0"), "the integrand is not shown to keep one sign")
    turned = radius * integrand.xreplace({p: radius * cos(azimuth), q: radius * sin(azimuth)})
    fixed, moving = turned.as_independent(azimuth, as_Add=False)
    swept = Integral(fixed * Integral(moving, (azimuth, 0, 2 * pi)), (radius, 0, oo))
    return [goal.with_left(goal.left.xreplace({integral: swept}))]


__all__ = ["polar"]
