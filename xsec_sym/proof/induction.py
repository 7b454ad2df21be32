"""Moves that go from one natural number to the next: induction, and a geometric bound for a series."""

from __future__ import annotations

from dataclasses import replace

from sympy import Expr, Sum, Symbol, oo

from xsec_sym.proof.magnitude import Magnitude
from xsec_sym.proof.names import natural
from xsec_sym.proof.regular import demand
from xsec_sym.proof.rules import Goal, Proven, fact


def induct(
    goal: Goal,
    index: Symbol,
    factor: Expr,
    terms: list[Expr],
    proven: Proven | None = None,
    mapping: dict[Symbol, Expr] | None = None,
) -> list[Goal]:
    """X(0) >= 0, and X(n + 1) is a factor that is not negative times X(n), plus terms that show they are not negative.

    A lemma |Y| = Y may show it of a Y in them.
    """
    x = goal.right
    demand(goal.left == Magnitude(x), lambda: f"{goal.left} = {x} does not say that {x} is not negative")
    demand(natural(index), lambda: f"{index} does not run over 0, 1, 2, ...")
    demand(not goal.piece.facts_about(index), "what is known of the index need not hold for the next one")
    for part in (x.subs(index, 0), factor):
        demand(goal.piece.sign(part) in ("+", ">=", "0"), lambda: f"{part} is not shown to be at least 0")
    added = x.subs(index, index + 1) - factor * x
    (shown,) = fact(goal, added, terms, None, proven, mapping, back=proven is not None)
    demand(any(e == added for e, _ in shown.piece.facts), lambda: f"{added} is not shown to be at least 0")
    return []


def dominate(goal: Goal, total: Sum, first: Expr, ratio: Expr) -> list[Goal]:
    """|sum of f_j| <= first / (1 - ratio), noted as two facts, where |f_j| <= first ratio^j and 0 <= ratio < 1."""
    demand(
        len(total.limits) == 1 and total.limits[0][1:] == (0, oo), lambda: f"{total} does not run from 0 without end"
    )
    j = total.limits[0][0]
    demand(natural(j), lambda: f"{j} does not run over 0, 1, 2, ...")
    demand(not goal.piece.facts_about(j), lambda: f"what is known of {j} is not known of the index")
    demand(not first.has(j) and not ratio.has(j), "the bound depends on j")
    sign_of = goal.piece.sign
    shrinks = sign_of(ratio) in ("+", ">=", "0") and sign_of(1 - ratio) == "+"
    demand(shrinks, lambda: f"{ratio} is not shown to be in [0, 1)")
    bound = first * ratio**j
    for gap in (bound - total.function, bound + total.function):
        demand(sign_of(gap) in ("+", ">=", "0"), lambda: f"{gap} is not shown to be at least 0")
    whole = first / (1 - ratio)
    return [replace(goal, piece=goal.piece.showing([(whole - total, False), (whole + total, False)]))]


__all__ = ["dominate", "induct"]
