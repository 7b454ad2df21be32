"""What an expression is like on a piece: analytic, continuous up to an end, free of switches. How a step is refused."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sympy import (
    Abs,
    Add,
    Expr,
    Heaviside,
    Integral,
    Max,
    Min,
    Mul,
    Number,
    NumberSymbol,
    Piecewise,
    Pow,
    Sum,
    Symbol,
    Tuple,
    acos,
    asin,
    atan,
    atanh,
    besseli,
    binomial,
    cos,
    cosh,
    coth,
    csch,
    diff,
    erf,
    exp,
    factorial,
    gamma,
    hyper,
    legendre,
    log,
    oo,
    preorder_traversal,
    sign,
    sin,
    sinh,
    tanh,
)

from xsec_sym.proof.field import Unsettled
from xsec_sym.proof.piece import Piece
from xsec_sym.proof.say import said

ENTIRE = (Add, Mul, Pow, Symbol, Number, NumberSymbol, exp, sin, cos, sinh, cosh, tanh, atan, erf)
SWITCHES = (Abs, Heaviside, Max, Min, Piecewise, sign)


class Refused(Exception):
    """A step that does not follow, with the reason as a sentence.

    >>> demand(1 + 1 == 3, "1 + 1 is not 3")
    Traceback (most recent call last):
    ...
    xsec_sym.proof.regular.Refused: 1 + 1 is not 3
    """


def demand(truth: bool, sentence: str | Callable[[], str]) -> None:
    """The sentence may wait until it is needed: writing out an expression costs more than most checks."""
    if not truth:
        raise Refused(sentence if isinstance(sentence, str) else sentence())


def connected(piece: Piece, x: Symbol) -> None:
    """Whatever the piece says about x must describe an interval: bounds, each linear in x."""
    for e, _ in piece.facts:
        if e.has(x):
            demand(diff(e, x, 2) == 0, lambda: f"the condition {e} > 0 may cut the range of {x} into several pieces")


def resolved(e: Expr, piece: Piece) -> Expr:
    """Every switch outside the integrands replaced by the branch that the facts select."""
    if not e.has(*SWITCHES):
        return e
    if isinstance(e, Integral | Sum):
        return e.func(e.function, *((x, *(resolved(end, piece) for end in ends)) for x, *ends in e.limits))
    if isinstance(e, SWITCHES):
        try:
            return resolved(piece.field.settled(e), piece)
        except Unsettled as reason:
            raise Refused(str(reason)) from reason
    return e.func(*(resolved(a, piece) for a in e.args))


def smooth(e: Expr, x: Symbol, piece: Piece) -> None:
    """e is analytic in x on the open piece: no root or logarithm of what may vanish, no quotient by it."""
    _critical(e, x, lambda a: piece.sign(a), lambda a: a.has(x))


def continuous_at(e: Expr, x: Symbol, end: Expr, outer: Piece) -> None:
    """e is continuous up to x = end."""
    demand(end not in (oo, -oo), "an infinite end needs a change of variables first")
    _critical(e, x, lambda a: outer.sign(a.subs(x, end)), lambda _: False)


def _critical(e: Expr, x: Symbol, sign_of: Callable[[Expr], Any], strict: Callable[[Expr], bool]) -> None:
    for node in preorder_traversal(e):
        allowed = ("+",) if strict(node) else ("+", ">=", "0")
        if isinstance(node, Pow) and not node.exp.is_nonnegative:
            demand(sign_of(node.base) in ("+", "-"), lambda: f"{node.base} may vanish in a denominator")
            if not node.exp.is_integer:
                demand(sign_of(node.base) == "+", lambda: f"{node.base} may be negative under a root")
        elif isinstance(node, Pow) and not node.exp.is_integer and node.base.free_symbols:
            demand(sign_of(node.base) in allowed, lambda: f"{node.base} may be negative under a root")
        elif isinstance(node, log):
            demand(sign_of(node.args[0]) == "+", lambda: f"the logarithm of {node.args[0]} may not be real")
        elif isinstance(node, csch | coth):
            demand(sign_of(node.args[0]) in ("+", "-"), lambda: f"{node} may be infinite")
        elif isinstance(node, acos | asin):
            z = node.args[0]
            inside = sign_of(1 - z**2) in allowed or all(sign_of(gap) in allowed for gap in (1 - z, 1 + z))
            demand(inside, lambda: f"{node} may leave the range of the inverse")
        elif isinstance(node, atanh):
            for gap in (1 - node.args[0], 1 + node.args[0]):
                demand(sign_of(gap) == "+", lambda: f"{node} may be infinite")
        elif isinstance(node, gamma | factorial | binomial):
            free = [a for a in node.args if not a.is_integer]
            demand(not free, lambda: f"{node} is not known to be smooth")
        elif isinstance(node, besseli):
            demand(bool(node.args[0].is_integer), lambda: f"{said(node)} is not of integer order")
        elif isinstance(node, hyper):
            above, below, _ = node.args
            natural = len(above) == 0 and all(b.is_integer and b.is_positive for b in below)
            demand(natural, lambda: f"{said(node)} is not known to be smooth")
        elif isinstance(node, legendre):
            demand(bool(node.args[0].is_integer), lambda: f"{said(node)} is not of integer degree")
        elif isinstance(node, Tuple) or (isinstance(node, SWITCHES) and not node.has(x)):
            continue  # which way a switch stands that does not depend on x is of no matter
        elif not isinstance(node, ENTIRE):
            # a list of what is smooth, since a list of what is not would always miss one
            raise Refused(f"{said(node)} is not known to be smooth")
