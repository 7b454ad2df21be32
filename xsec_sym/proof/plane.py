"""The move that acts on an integral over the whole plane: polar coordinates."""

from __future__ import annotations

from sympy import Integral, Sum, Symbol, cos, oo, pi, sin

from xsec_sym.proof.calculus import iterated, outer_names
from xsec_sym.proof.names import plain
from xsec_sym.proof.regular import demand
from xsec_sym.proof.rules import Goal


def polar(goal: Goal, integral: Integral, radius: Symbol, azimuth: Symbol) -> list[Goal]:
    """The integral over q and p, both from -oo to oo, over the radius and the azimuth: p + i q = r e^(i phi).

    The integrand keeps one sign (Tonelli), so that neither the order nor the shape of growing domains matters.
    """
    outside, rest, q, low, high, _, inner = iterated(goal, integral)
    p, a, b = rest.limits[0]
    demand((low, high, a, b) == (-oo, oo, -oo, oo), "the integral is not over the whole plane")
    integrand = outside * rest.function
    demand(not integrand.has(Integral, Sum), "an integral or a sum is left in the integrand")
    used = integral.atoms(Symbol) | outer_names(goal, integral) | goal.right.free_symbols
    demand(radius != azimuth and not {radius, azimuth} & used, "the new variables already stand for something else")
    demand(plain(radius, azimuth), "the new variables are not plain real ones")
    shown = inner.inside(p, a, b).sign(integrand)
    demand(shown in ("+", ">=", "-", "<=", "0"), "the integrand is not shown to keep one sign")
    turned = radius * integrand.xreplace({p: radius * cos(azimuth), q: radius * sin(azimuth)})
    fixed, moving = turned.as_independent(azimuth, as_Add=False)
    swept = Integral(fixed * Integral(moving, (azimuth, 0, 2 * pi)), (radius, 0, oo))
    return [goal.with_left(goal.left.xreplace({integral: swept}))]


__all__ = ["polar"]
