"""Where an integrand switches branch, and which branch holds between two switches.

Everything here is exact: a sign is either established by ball arithmetic or proved to be zero, and when
neither succeeds the answer is ``Undecided``.  A superset of the true switch points is harmless, since a
spurious point only splits an integral once more; a missing one would be an error.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cmp_to_key
from itertools import product
from typing import Any

from sympy import (
    Abs,
    Basic,
    Expr,
    Heaviside,
    Max,
    Min,
    Piecewise,
    PolynomialError,
    Rational,
    S,
    Symbol,
    ceiling,
    floor,
    nan,
    oo,
    sign,
    sympify,
)
from sympy.core.relational import Equality, Relational, Unequality
from sympy.logic.boolalg import Boolean, BooleanFalse, BooleanTrue

from xsec_sym.proof.ball_compile import rational_near
from xsec_sym.proof.piece import Piece
from xsec_sym.proof.say import said
from xsec_sym.proof.zeros import Undecided, less, sign_of, zeros

SWITCHES = (Piecewise, Abs, Heaviside, sign, Max, Min)
_BINDERS = ("Integral", "Sum", "Product")


def unfold(expr: Any) -> Any:
    """``expr`` with every object that carries a ``definition()`` replaced by that definition."""
    expr = sympify(expr)
    for _ in range(50):
        opened = expr.replace(lambda e: hasattr(e, "definition"), lambda e: e.definition())
        if opened == expr:
            return expr
        expr = opened
    raise Undecided(f"the definitions in {said(expr)} do not come to an end")


# --- switching expressions -------------------------------------------------------------------------------------


def _relationals(condition: Basic) -> Iterable[Relational]:
    if isinstance(condition, Relational):
        yield condition
    else:
        for part in condition.args:
            yield from _relationals(part)


def switching(f: Basic, x: Symbol) -> set[Expr]:
    """Expressions whose zeros (and poles) hold every point where a switch in ``f`` may change branch."""
    found: set[Expr] = set()
    for node in f.atoms(*SWITCHES, floor, ceiling):
        if not node.has(x):
            continue
        if isinstance(node, floor | ceiling):
            raise Undecided(f"the steps of {said(node)} are not searched for")
        if isinstance(node, Piecewise):
            for _, condition in node.args:
                found.update(r.lhs - r.rhs for r in _relationals(condition))
        elif isinstance(node, Max | Min):
            found.update(p - q for i, p in enumerate(node.args) for q in node.args[:i])
        else:
            found.add(node.args[0])
    return {plain for g in found for plain in _alternatives(g) if plain.has(x)}


def _branches_of(node: Expr) -> list[Expr]:
    g = node.args[0]
    if isinstance(node, Abs):
        return [g, -g]
    if isinstance(node, sign):
        return [S.One, S.NegativeOne]
    if isinstance(node, Heaviside):
        return [S.One, S.Zero]
    if isinstance(node, Piecewise):
        return [branch for branch, _ in node.args]
    return list(node.args)


def _alternatives(g: Expr) -> set[Expr]:
    """``g`` with every choice of branch for the switches inside it."""
    inner = sorted(g.atoms(*SWITCHES), key=str)
    outermost = [n for n in inner if not any(n != m and m.has(n) for m in inner)]
    if not outermost:
        return {g}
    choices = [_branches_of(n) for n in outermost]
    if len(outermost) > 6:
        raise Undecided(f"too many nested switches in {g}")
    found: set[Expr] = set()
    for choice in product(*choices):
        found |= _alternatives(g.xreplace(dict(zip(outermost, choice, strict=True))))
    return found


def breakpoints(f: Any, x: Symbol, a: Any, b: Any) -> list[Expr]:
    """The points strictly inside (a, b) where ``f`` may switch branch, in increasing order.

    >>> from sympy import Abs, Max, cos, pi, symbols
    >>> x = symbols("x", real=True)
    >>> breakpoints(Abs(x**2 - 2), x, 0, 3)
    [sqrt(2)]
    >>> breakpoints(Max(0, 1 + 2 * cos(x)), x, 0, 2 * pi)
    [2*pi/3, 4*pi/3]
    """
    f, a, b = unfold(f), sympify(a), sympify(b)
    if f.free_symbols - {x}:
        raise Undecided(f"{said(f)} depends on more than {x}")
    points: list[Expr] = []
    for g in sorted(switching(f, x), key=str):
        try:
            roots = zeros(g, x, a, b)
        except PolynomialError as error:
            raise Undecided(f"the zeros of {g} could not be found") from error
        for r in roots:
            if _is_real(r) and r not in points and less(a, r) and less(r, b):
                points.append(r)
    points.sort(key=cmp_to_key(_order))
    return [p for i, p in enumerate(points) if i == 0 or sign_of(p - points[i - 1]) != 0]


def _order(p: Expr, q: Expr) -> int:
    return sign_of(p - q)


def _is_real(r: Expr) -> bool:
    if r.is_real is not None:
        return bool(r.is_real)
    try:
        sign_of(r)
    except Undecided as error:
        if "not real" in str(error):
            return False
        raise
    return True


# --- choosing a branch -----------------------------------------------------------------------------------------


def _truth(condition: Any, sign_at: Callable[[Expr], int]) -> bool:
    if isinstance(condition, BooleanTrue | BooleanFalse | bool):
        return bool(condition)
    if isinstance(condition, Relational):
        s = sign_at(condition.lhs - condition.rhs)
        if isinstance(condition, Equality | Unequality):
            return (s == 0) == isinstance(condition, Equality)
        greater, strict = condition.rel_op.startswith(">"), len(condition.rel_op) == 1
        return (s > 0 if greater else s < 0) or (s == 0 and not strict)
    if isinstance(condition, Boolean):
        parts = [_truth(part, sign_at) for part in condition.args]
        return bool(condition.func(*[S.true if p else S.false for p in parts]))
    raise Undecided(f"{condition} is not a condition that can be settled")


def _active(node: Expr, sign_at: Callable[[Expr], int]) -> Expr:
    """The branch of one switch, whose own arguments hold no further switch."""
    if isinstance(node, Piecewise):
        for branch, condition in node.args:
            if _truth(condition, sign_at):
                return branch
        return nan
    if isinstance(node, Max | Min):
        best = node.args[0]
        for other in node.args[1:]:
            s = sign_at(other - best)
            if (s > 0) if isinstance(node, Max) else (s < 0):
                best = other
        return best
    s = sign_at(node.args[0])
    if isinstance(node, Abs):
        return s * node.args[0]
    if isinstance(node, sign):
        return sympify(s)
    return S.One if s > 0 else S.Zero if s < 0 else node.args[1]


def choose(f: Expr, sign_at: Callable[[Expr], int], wanted: Callable[[Expr], bool]) -> Expr:
    if isinstance(f, SWITCHES) and wanted(f):
        if isinstance(f, Piecewise):
            # only the branch that is taken may be looked into: the others need not even be defined here
            for branch, condition in f.args:
                if _truth(choose(condition, sign_at, wanted), sign_at):
                    return choose(branch, sign_at, wanted)
            return nan
        return _active(f.func(*[choose(g, sign_at, wanted) for g in f.args], evaluate=False), sign_at)
    if not f.args or type(f).__name__ in _BINDERS or not f.has(*SWITCHES):
        return f
    args = [choose(g, sign_at, wanted) for g in f.args]
    return f if args == list(f.args) else f.func(*args)


def _inside(a: Expr, b: Expr) -> list[Expr]:
    """Rational points strictly between a and b."""
    if a == -oo or b == oo:
        low = S.Zero if a == -oo and b == oo else sympify(rational_near(b if a == -oo else a))
        steps = (1, Rational(7, 3), Rational(37, 5))
        return [low - 1 - s if a == -oo else low + 1 + s for s in steps]
    p, q = (rational_near(end) for end in (a, b))
    points = [p + (q - p) * w for w in (Rational(1, 2), Rational(3, 7), Rational(13, 21))]
    return [r for r in points if less(a, r) and less(r, b)]


def resolve(f: Any, x: Symbol, a: Any, b: Any) -> Expr:
    """``f`` on (a, b), which holds no switch point, with each switch replaced by its active branch.

    >>> from sympy import Abs, symbols
    >>> x = symbols("x", real=True)
    >>> resolve(Abs(x - 3) + x, x, 0, 1)
    3
    """
    f, a, b = unfold(f), sympify(a), sympify(b)
    if not f.has(*SWITCHES):
        return f
    points = _inside(a, b)

    def sign_at(g: Expr) -> int:
        for point in points:
            s = sign_of(unfold(g.subs(x, point)))
            if s:
                return s
        if Piece().is_zero(g):
            return 0
        raise Undecided(f"the sign of {said(g)} between {a} and {b} could not be established")

    return choose(f, sign_at, lambda e: True)


def settle(expr: Any) -> Expr:
    """A constant with each of its own switches replaced by the active branch; those under an integral stay.

    >>> from sympy import Abs, Piecewise, Rational, sqrt
    >>> c = Rational(3, 5)
    >>> settle(Piecewise((1, Abs(c) < sqrt(1 - Rational(4, 5)**2)), (2, True)))
    2
    """
    expr = unfold(expr)
    return choose(expr, sign_of, lambda e: not e.free_symbols) if expr.has(*SWITCHES) else expr


__all__ = ["SWITCHES", "Undecided", "breakpoints", "resolve", "settle", "sign_of", "unfold"]
