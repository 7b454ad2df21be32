"""The moves of a proof. Each takes a goal and its data, checks what it must, and returns the goals that are left.

A goal is "left = right on this piece". A rule that cannot be checked raises `Refused`; none asks an oracle, none
looks at a float. Everything here is decided by `Piece.sign` and `Piece.is_zero`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, Protocol

from sympy import (
    Add,
    Derivative,
    Expr,
    Integral,
    Lambda,
    Limit,
    Subs,
    Sum,
    Symbol,
    diff,
    nan,
    oo,
    preorder_traversal,
)
from sympy.concrete.expr_with_limits import ExprWithLimits
from sympy.logic.boolalg import Boolean

from xsec_sym.proof.domain import Choices, Domain, Integers, Interval
from xsec_sym.proof.names import captured, keeps_to, natural
from xsec_sym.proof.piece import Piece
from xsec_sym.proof.regular import connected, demand, resolved, smooth
from xsec_sym.proof.signs import plus


@dataclass(frozen=True)
class Goal:
    left: Expr
    right: Expr
    piece: Piece
    conditions: tuple[Boolean, ...] = ()
    doubtful: bool = False  # a sum was split into integrals that may not exist: all must be given values
    absolute: frozenset[Sum] = frozenset()  # sums that converge absolutely, by the move that made them

    def with_left(self, left: Expr) -> Goal:
        # SymPy folds a Piecewise out of nested integrals together with the inner variable: that is not the same thing
        demand(left.free_symbols <= self.left.free_symbols, lambda: f"{left} would set a bound variable free")
        return replace(self, left=left)


class Proven(Protocol):
    """What a lemma offers: left = form on a domain."""

    id: str
    left: Expr
    domain: Domain

    @property
    def form(self) -> Expr: ...


# --- the pieces of a domain ---------------------------------------------------------------------------


def start(left: Expr, right: Expr, where: Domain) -> Goal:
    """The opening goal: integer variables written by their index, the domain's facts on the table."""
    index = {v.symbol: v.member(v.index) for v in where.variables if isinstance(v, Integers)}
    hidden = {s for side in (left, right) for s in side.atoms(Symbol) if "#" in s.name}
    demand(not hidden, lambda: f"{hidden} are names for the variables of a normal form")
    left, right = left.subs(index), right.subs(index)
    conditions = tuple(c.subs(index) for c in where.conditions)
    reals = tuple(v for v in where.variables if isinstance(v, Interval))
    return Goal(left, right, Piece.of(Domain(reals, conditions)), conditions)


def cases(goal: Goal, on: Expr, symbol: Symbol, root: Expr, slope: Expr) -> list[Goal]:
    """Three goals: on > 0, on < 0, and on = 0, which is symbol = root, since on = slope (symbol - root)."""
    above = replace(goal, piece=goal.piece.extended([(on, True)]))
    below = replace(goal, piece=goal.piece.extended([(-on, True)]))
    demand(goal.piece.is_zero(on - slope * (symbol - root)), lambda: f"{on} is not a multiple of {symbol - root}")
    demand(goal.piece.sign(slope) in ("+", "-"), lambda: f"{on} may vanish elsewhere than at {symbol} = {root}")

    sides = (goal.left, goal.right, *goal.conditions, *(e for e, _ in goal.piece.facts))
    demand(not captured(sides, root), lambda: f"{root} would be captured by an integral or a sum")

    def at_root(e: Expr) -> Expr:
        return e.subs(symbol, root)

    equal = Goal(
        at_root(goal.left),
        at_root(goal.right),
        goal.piece.substituted(symbol, root),
        tuple(at_root(c) for c in goal.conditions),
        goal.doubtful,
    )
    return [above, below, equal]


def vacuous(goal: Goal) -> list[Goal]:
    """No point of the domain lies on this piece: one of its conditions, or of its facts, is false there."""
    conditions = any(goal.piece.decide(c) is False for c in goal.conditions)

    def denied(k: int) -> bool:
        """The other facts deny this one. The latest is asked first: it is the one that emptied the piece."""
        expression, strict = goal.piece.facts[k]
        here = goal.piece.without(k).sign(expression)
        return here == "-" or (strict and here in ("0", "<="))

    facts = conditions or any(denied(k) for k in reversed(range(len(goal.piece.facts))))
    demand(conditions or facts, "nothing shows that this piece is empty")
    return []


def fact(
    goal: Goal,
    expression: Expr,
    terms: list[Expr],
    inner: list[Any] | None = None,
    proven: Proven | None = None,
    mapping: dict[Symbol, Expr] | None = None,
    back: bool = False,
) -> list[Goal]:
    """expression is the sum of terms whose signs show and agree; so its own sign is known from here on.

    ``inner`` = (x, low, high): a fact about an integrand, between the limits of that integral only. Where a lemma is
    named, each term shows its sign once the lemma's left side is read as its right side, or ``back``: where a lemma
    says |X| = X, the X of a term is then seen not to be negative.
    """
    piece = goal.piece.inside(*inner) if inner else goal.piece
    demand(piece.is_zero(expression - Add(*terms)), lambda: f"{expression} is not shown to be the sum of {terms}")
    here: Any = "0"
    for term in terms:
        if proven is not None and occurs(_replaced(proven, mapping or {}, back), term):
            (shown,) = lemma(Goal(term, goal.right, piece), proven, mapping or {}, back)
            term = shown.left
        here = plus(here, piece.sign(term))
    demand(here in ("+", "-", ">=", "<="), lambda: f"the signs of {terms} do not show, or differ")
    new = (expression if here in ("+", ">=") else -expression, here in ("+", "-"))
    piece = goal.piece.noting(tuple(inner), new) if inner else goal.piece.showing([new])
    return [replace(goal, piece=piece)]


# --- equations ----------------------------------------------------------------------------------------


def unfold(goal: Goal, only: str = "") -> list[Goal]:
    """Replace every defined object, or those of one name, by its definition, on both sides."""
    return [replace(goal, left=unfolded(goal.left, only), right=unfolded(goal.right, only))]


def occurs(part: Expr, whole: Expr) -> bool:
    return any(node == part for node in preorder_traversal(whole))


def swap(goal: Goal) -> list[Goal]:
    """Work on the other side: an equation may be read from right to left."""
    return [replace(goal, left=goal.right, right=goal.left)]


def nest(goal: Goal, integral: Integral) -> list[Goal]:
    """A repeated integral as an integral over an integral, factors free of the inner variables drawn out."""
    demand(
        occurs(integral, goal.left) and len(integral.limits) > 1,
        lambda: f"{integral} is not a repeated integral in the goal",
    )
    *inner, last = integral.limits
    outside, inside = integral.function.as_independent(*(limit[0] for limit in inner), as_Add=False)
    demand(
        not any(e.has(limit[0]) for limit in inner for e in last[1:]), "an outer limit depends on the inner variable"
    )
    return [goal.with_left(goal.left.xreplace({integral: Integral(outside * Integral(inside, *inner), last)}))]


def unfolded(e: Expr, only: str = "") -> Expr:
    while True:
        found = {node: opened(node) for node in set(_nodes(e)) if only in ("", node.func.__name__)}
        if not found:
            return e
        e = e.xreplace(found)


def opened(e: Expr) -> Expr:
    """A defined object written out once, provided that its definition binds no name of its arguments."""
    whole = e.definition()
    bound = {s for node in whole.atoms(Integral, Sum) for s in node.bound_symbols} & e.free_symbols
    demand(not bound, lambda: f"{bound} would be captured by {e}")
    return whole


def _nodes(e: Expr) -> Iterable[Expr]:
    return (n for n in preorder_traversal(e) if hasattr(n, "definition"))


def rewrite(goal: Goal, old: Expr, new: Expr) -> list[Goal]:
    """Replace a part by an equal one; under an integral, equal on the open interval of integration."""
    demand(occurs(old, goal.left), lambda: f"{old} does not occur")
    for piece in contexts(goal, old):
        demand(piece.is_zero(old - new), lambda: f"{old} and {new} are not shown to be equal")
        demand(_unvalued(new, piece) <= _unvalued(old, piece), lambda: f"{new} brings in what may have no value")
    return [goal.with_left(goal.left.xreplace({old: new}))]


def _unvalued(e: Expr, piece: Piece) -> set[Symbol]:
    """The atoms of the integrals and sums in an expression, those that cancel in it included."""
    found: set[Symbol] = set()
    walk = preorder_traversal(e)
    for node in walk:
        if isinstance(node, Integral | Sum):
            walk.skip()
            atoms = piece.field.atomise(node).free_symbols
            found |= {a for a in atoms if piece.field.meaning.get(a, a).has(Integral, Sum)}
    return found


def settle(goal: Goal) -> list[Goal]:
    """Take the branch of each switch outside the integrals that the facts select, on both sides."""
    return [replace(goal, left=resolved(goal.left, goal.piece), right=resolved(goal.right, goal.piece))]


def close(goal: Goal) -> list[Goal]:
    left_over = goal.left.has(Integral) or goal.right.has(Integral)
    demand(not (goal.doubtful and left_over), "an integral that may not exist has been given no value")
    demand(not goal.left.has(nan), "the left side is not defined")
    demand(
        goal.left == goal.right or goal.piece.is_zero(goal.left - goal.right),
        lambda: f"{goal.left} and {goal.right} are not shown to be equal",
    )
    return []


def lemma(goal: Goal, proven: Proven, mapping: dict[Symbol, Expr], back: bool = False) -> list[Goal]:
    """Replace the left side of an equation that holds by its right side, inside the lemma's own domain; or ``back``."""
    demand(all(isinstance(key, Symbol) for key in mapping), "only a name can be mapped")
    mapping = _filled(proven, mapping)
    for v in proven.domain.variables:
        if isinstance(v, Integers):
            demand(v.high is None, lambda: f"{v.text()} ends, so no symbolic member of it can be taken")
            count = (mapping[v.symbol] - v.low) / v.step
            same = (mapping[v.index] - count).expand() == 0
            demand(same, lambda: f"{v.index} counts the members of {v.text()}, so it is {count}")
            demand(bool(count.is_integer and count.is_nonnegative), lambda: f"{mapping[v.symbol]} is not in {v.text()}")
    bound = {
        limit[0]
        for side in (proven.left, proven.form)
        for node in preorder_traversal(side)
        if isinstance(node, Integral | Sum)
        for limit in node.limits
    }
    taken = {s for value in mapping.values() for s in value.free_symbols}
    demand(not bound & taken, lambda: f"{bound & taken} would be captured by {proven.id}")
    old = proven.left.subs(mapping, simultaneous=True)
    new = proven.form.subs(mapping, simultaneous=True)
    if back:
        old, new = new, old
    elif not occurs(old, goal.left) and hasattr(old, "definition"):
        old = opened(old)
    demand(not {old, new} & {oo, -oo} or goal.left == old, "nothing is reckoned with what is infinite")
    demand(occurs(old, goal.left), lambda: f"the side of {proven.id} that is to be replaced, {old}, does not occur")
    for piece in contexts(goal, old):
        for key, value in mapping.items():
            demand(keeps_to(key, value, piece), lambda: f"{value} is not shown to be one of what {key} stands for")
        for variable in proven.domain.variables:
            if isinstance(variable, Choices):
                demand(mapping.get(variable.symbol) in variable.values, lambda: f"{variable.text()} is not met")
            elif isinstance(variable, Interval):
                for bound, strict in variable.facts():
                    here = piece.sign(bound.subs(mapping, simultaneous=True))
                    demand(
                        here == "+" or (not strict and here in (">=", "0")), lambda: f"{variable.text()} is not shown"
                    )
        for condition in proven.domain.conditions:
            held = piece.decide(condition.subs(mapping, simultaneous=True))
            demand(held is True, lambda: f"{proven.id} assumes {condition}, which is not shown here")
    return [goal.with_left(goal.left.xreplace({old: new}))]


def _filled(proven: Proven, mapping: dict[Symbol, Expr]) -> dict[Symbol, Expr]:
    """A mapping with what it leaves out: an integer variable and the index that counts its values belong together."""
    filled = dict(mapping)
    for v in proven.domain.variables:
        if isinstance(v, Integers):
            value = filled.setdefault(v.symbol, v.member(filled.get(v.index, v.index)))
            filled.setdefault(v.index, (value - v.low) / v.step)
    return filled


def contexts(goal: Goal, part: Expr) -> list[Piece]:
    """The pieces in which a part of the left side stands: the goal's own, inside the integrals around it."""
    found: list[Piece] = []

    def visit(e: Expr, piece: Piece) -> None:
        if e == part:
            found.append(piece)
            return
        if not occurs(part, e):
            return
        if isinstance(e, Sum):
            runs = all(natural(j, a) for j, a, _ in e.limits)
            apart = not any(piece.facts_about(j) for j, *_ in e.limits)
            demand(runs and apart, lambda: f"{part} stands in a sum whose index is not known to be natural")
            onward = all(b == oo or (b - a + 1).is_nonnegative for _, a, b in e.limits)
            demand(onward, lambda: f"{e} may run backwards")
            fixed = not any(occurs(part, end) for _, *ends in e.limits for end in ends)
            demand(fixed, "a limit of a sum stays as it is")
            visit(e.function, piece)
            return
        if isinstance(e, Integral):
            for x, low, high in reversed(e.limits):
                visit(low, piece)
                visit(high, piece)
                piece = piece.inside(x, low, high)
            visit(e.function, piece)
            return
        binds = isinstance(e, ExprWithLimits | Limit | Subs | Derivative | Lambda)
        demand(not binds, lambda: f"{part} stands in {e}, of whose variable nothing is known")
        for a in e.args:
            visit(a, piece)

    visit(goal.left, goal.piece)
    return found


# --- differential equations ---------------------------------------------------------------------------


def ode(goal: Goal, x: Symbol, coefficients: list[Expr], at: Expr) -> list[Goal]:
    """y = left - right satisfies sum c_i y^(i) = 0 on an interval and vanishes with its derivatives at one point."""
    gap = resolved(goal.left, goal.piece) - resolved(goal.right, goal.piece)
    demand(not gap.has(Integral), "an equation under an integral sign cannot be differentiated here")
    connected(goal.piece, x)
    for part in (gap, *coefficients):
        smooth(part, x, goal.piece)
    demand(goal.piece.sign(coefficients[-1]) in ("+", "-"), "the leading coefficient may vanish")
    total = Add(*(c * diff(gap, x, k) for k, c in enumerate(coefficients)))
    demand(goal.piece.is_zero(total), "the difference of the two sides does not satisfy the equation")
    here = Piece([f for f in goal.piece.facts if not f[0].has(x)], [r for r in goal.piece.ranges if r.symbol != x])
    for bound, _ in (f for f in goal.piece.facts if f[0].has(x)):
        demand(here.sign(bound.subs(x, at)) == "+", lambda: f"{x} = {at} is not inside the interval")
    demand(here.sign(coefficients[-1].subs(x, at)) in ("+", "-"), "the equation is singular where the values are given")
    for k in range(len(coefficients) - 1):
        demand(
            here.is_zero(diff(gap, x, k).subs(x, at)),
            lambda: f"derivative {k} of the difference at {x} = {at} is not 0",
        )
    return []


# --- inequalities: X >= 0 is the equation |X| = X -------------------------------------------------------


def _replaced(proven: Proven, mapping: dict[Symbol, Expr], back: bool) -> Expr:
    return (proven.form if back else proven.left).subs(_filled(proven, mapping), simultaneous=True)


__all__ = [
    "Goal",
    "Proven",
    "cases",
    "close",
    "contexts",
    "fact",
    "lemma",
    "nest",
    "occurs",
    "ode",
    "rewrite",
    "settle",
    "start",
    "swap",
    "unfold",
    "unfolded",
    "vacuous",
]
