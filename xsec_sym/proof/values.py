"""Expressions as NumPy functions of many points at once, in two ways: by the first and by the second route of each
solved quantity, and each integral by a quadrature of its own.

Double precision. What has no value is NaN; what no rule covers raises `NoValues`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import beta, betainc
from sympy import Dummy, Expr, Integral, Symbol, lambdify

from xsec_sym.exact.solved import Solved, heads

Array = NDArray[np.float64]
Run = Callable[[Sequence[Array]], Array]
ROUTES = (0, 1)


class NoValues(ValueError):
    """The expression cannot be evaluated at points; the message says why."""


def compiled(e: Expr, symbols: Sequence[Symbol], route: int) -> Run:
    """A function of arrays of one shape, one for each symbol."""
    inner = {i: Dummy(f"integral_{n}") for n, i in enumerate(_outermost(e))}
    parts = [_integral(i, symbols, route) for i in inner]
    body = e.xreplace(inner)
    if unknown := body.free_symbols - {*symbols, *inner.values()}:
        raise NoValues(f"{', '.join(sorted(map(str, unknown)))} has no value")
    table: dict[str, Any] = {head.__name__: head.routes[route] for head in heads(e)}
    try:
        run = lambdify([*symbols, *inner.values()], body, modules=[table, "numpy"], cse=True)
    except (NotImplementedError, TypeError, KeyError) as reason:
        raise NoValues(f"no NumPy code for it: {reason}") from None

    def at(given: Sequence[Array]) -> Array:
        shape = np.broadcast_shapes(*(np.shape(g) for g in given)) if given else ()
        with np.errstate(all="ignore"):
            try:
                found = run(*given, *(part(given) for part in parts))
            except (NameError, TypeError) as reason:
                raise NoValues(f"no NumPy code for it: {reason}") from None
            if np.iscomplexobj(found):
                found = np.where(np.imag(found) == 0, np.real(found), np.nan)
            return np.broadcast_to(np.asarray(found, dtype=np.float64), shape)

    return at


def _outermost(e: Expr) -> list[Integral]:
    found: dict[Integral, None] = {}

    def walk(node: Any) -> None:
        if isinstance(node, Integral):
            found.setdefault(node, None)
        else:
            for arg in node.args:
                walk(arg)

    walk(e)
    return list(found)


def _integral(i: Integral, symbols: Sequence[Symbol], route: int) -> Run:
    """Between finite ends, with nodes crowded at both of them; the last variable is the outermost."""
    *others, last = i.limits
    if len(last) != 3 or any(end.is_infinite for end in last[1:]):
        raise NoValues("only integrals between finite ends are evaluated")
    variable, *ends = last
    dummy = Dummy(variable.name)  # a variable of the claim may have its name
    low, high = (compiled(end, symbols, route) for end in ends)
    body = Integral(i.function, *others) if others else i.function
    inner = compiled(body.subs(variable, dummy), [*symbols, dummy], route)
    x, weight = _rule(route)

    def at(given: Sequence[Array]) -> Array:
        columns = [np.asarray(g, dtype=np.float64)[..., None] for g in given]
        a, b = low(columns), high(columns)
        found = inner([*columns, a + (b - a) * x]) * weight
        return found.sum(-1) * (b - a)[..., 0]

    return at


@cache
def _rule(route: int) -> tuple[Array, Array]:
    """Nodes and weights on (0, 1): Gauss-Legendre in a variable that crowds them, or the doubly exponential rule."""
    if route == 0:
        t, weight = np.polynomial.legendre.leggauss(64)
        t = (1 + t) / 2
        return betainc(6, 6, t), weight / 2 * (t * (1 - t)) ** 5 / beta(6, 6)
    u = np.linspace(-3.7, 3.7, 121)
    e = np.exp(np.pi / 2 * np.sinh(u))
    return e / (1 + e), (u[1] - u[0]) * np.pi / 2 * np.cosh(u) * e / (1 + e) ** 2


__all__ = ["ROUTES", "NoValues", "Solved", "compiled"]
