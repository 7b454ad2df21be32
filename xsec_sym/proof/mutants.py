"""Wrong formulas that look right: what misprints and slips make of an expression. A sound check rejects them all."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from sympy import (
    Abs,
    Add,
    Expr,
    I,
    Integral,
    Mul,
    Pow,
    Rational,
    Sum,
    Symbol,
    nan,
    pi,
    preorder_traversal,
    sqrt,
    sympify,
    zoo,
)

MOST = 24


def mutants(form: Expr, variables: list[Symbol]) -> list[Expr]:
    """Mutants of an expression, each once, most telling kinds first; never the expression itself.

    >>> from sympy import Symbol
    >>> u = Symbol("u", real=True)
    >>> -u**2 in mutants(u**2, [u]) and 2 * u**2 in mutants(u**2, [u])
    True
    """
    found: dict[Expr, None] = {}
    for mutant in _all(form, variables):
        if mutant != form and not mutant.has(I, nan, zoo):
            found.setdefault(mutant, None)
    return list(found)[:MOST]


def _all(form: Expr, variables: list[Symbol]) -> Iterator[Expr]:
    yield from _in_turn(_scaled(form), _terms(form), _exponents(form), _arguments(form, variables), _bars(form))
    grains = (sympify(1), sympify(-1), Rational(1, 7), Rational(1, 10**6), pi)
    for extra in (*variables, *(v**k for v in variables for k in (2, 3)), *grains):
        yield form + extra
        yield form - extra
    for factor in (3, Rational(1, 3), sqrt(2)):
        yield form * factor


def _in_turn(*kinds: Iterator[Expr]) -> Iterator[Expr]:
    """One of each kind, then another of each: no kind crowds the others out."""
    left = list(kinds)
    while left:
        for kind in list(left):
            mutant = next(kind, None)
            if mutant is None:
                left.remove(kind)
            else:
                yield mutant


def _scaled(form: Expr) -> Iterator[Expr]:
    yield -form
    yield 2 * form
    yield form / 2


def _replaced(form: Expr, old: Expr, new: Expr) -> Expr:
    try:
        return form.xreplace({old: new})
    except TypeError:  # a condition that compares a number which is not real: no mutant at all
        return form


def _terms(form: Expr) -> Iterator[Expr]:
    """Each term of each sum dropped, and its sign flipped."""
    for node in _places(form, Add):
        for term in node.args:
            rest = Add(*(a for a in node.args if a is not term))
            yield _replaced(form, node, rest - term)
            if rest != 0:
                yield _replaced(form, node, rest)


def _exponents(form: Expr) -> Iterator[Expr]:
    for node in _places(form, Pow):
        for change in (1, -1):
            yield _replaced(form, node, Pow(node.base, node.exp + change))
    for node in _places(form, Mul):
        coefficient, rest = node.as_coeff_Mul()
        if coefficient not in (1, -1):
            yield _replaced(form, node, rest)


def _arguments(form: Expr, variables: list[Symbol]) -> Iterator[Expr]:
    for v in variables:
        yield form.subs(v, -v)
    for v, w in pairwise(variables):
        yield form.subs({v: w, w: v}, simultaneous=True)


def _bars(form: Expr) -> Iterator[Expr]:
    for node in _places(form, Abs):
        yield _replaced(form, node, node.args[0])


def _places(form: Expr, kind: type) -> list[Expr]:
    """The parts of a kind, outermost first; the limits of sums and integrals are left alone."""
    found: dict[Expr, None] = {}
    walk = preorder_traversal(form)
    for node in walk:
        if isinstance(node, kind):
            found.setdefault(node, None)
        if isinstance(node, Integral | Sum):
            walk.skip()
    return list(found)
