"""A connected piece of a domain, and the exact facts that hold on it.

A piece answers two questions, and answers "unknown" rather than guess: which sign has this expression here,
and is this expression zero here? Both work on the normal form of `field.py`: a polynomial in atoms.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from sympy import (
    And,
    Eq,
    Expr,
    Integral,
    Max,
    Ne,
    Not,
    Or,
    Piecewise,
    S,
    Symbol,
    besseli,
    oo,
    pi,
    sympify,
)

from xsec_sym.proof.domain import Choices, Domain, Integers, Interval
from xsec_sym.proof.facts import Fact, Facts, Terms, terms_of
from xsec_sym.proof.field import Field, Unsettled
from xsec_sym.proof.signs import FLIP, Sign, both_sides, difference_of_exponentials, relation_facts, times


class Piece(Facts):
    """Facts about real variables: each an expression with the knowledge that it is > 0 (strict) or >= 0."""

    def __init__(
        self,
        facts: Iterable[Fact] = (),
        ranges: Iterable[Interval] = (),
        local: Iterable[tuple[tuple[Any, ...], Fact]] = (),
        parent: Piece | None = None,
        shown: Iterable[Fact] = (),
    ) -> None:
        self.facts: tuple[Fact, ...] = tuple((sympify(e), strict) for e, strict in facts)
        self.ranges = tuple(ranges)
        self.local = tuple(local)  # facts that hold between the limits of one integral only: ((x, low, high), fact)
        # facts that follow from the others: of a name of which those say nothing, they hold whatever it stands for
        self.shown: frozenset[Fact] = frozenset(shown) | (parent.shown if parent else frozenset())
        self.field: Field = Field(self, parent.field if parent else None)
        self.known: list[tuple[Terms, bool]] = list(parent.known) if parent else []
        self._signs: dict[Expr, Sign] = dict(parent._signs) if parent else {}
        self._polynomial_signs: dict[frozenset[Any], Sign] = dict(parent._polynomial_signs) if parent else {}
        self._products: list[tuple[Terms, bool]] | None = None
        self._pending: list[Fact] = []
        self._inner: dict[Any, Piece] = {}
        waiting, self._pending = (list(parent._pending) if parent else []), []
        for expression, strict in [*self.facts[len(parent.facts) if parent else 0 :], *waiting]:
            self._learn(expression, strict)

    @classmethod
    def of(cls, domain: Domain) -> Piece:
        """The whole domain as a piece; an integer variable must already be written by its index."""
        facts: list[tuple[Expr, bool]] = []
        for variable in domain.variables:
            if isinstance(variable, Interval):
                facts += variable.facts()
            elif isinstance(variable, Integers | Choices):
                continue
        for condition in domain.conditions:
            facts += relation_facts(condition)
        return cls(facts, [v for v in domain.variables if isinstance(v, Interval)])

    def extended(self, facts: Iterable[Fact], ranges: Iterable[Interval] = ()) -> Piece:
        return Piece((*self.facts, *facts), (*self.ranges, *ranges), self.local, self)

    def showing(self, facts: Iterable[Fact]) -> Piece:
        """The piece with facts that were shown on it, not assumed."""
        new = [fact for fact in facts if fact not in self.facts]
        return Piece((*self.facts, *new), self.ranges, self.local, self, new)

    def inside(self, x: Symbol, low: Expr, high: Expr) -> Piece:
        """The piece with an integration variable strictly between its limits."""
        inner = Interval(x, sympify(low), sympify(high), True, True)
        limits = (x, inner.low, inner.high)
        if limits not in self._inner:
            self._inner[limits] = self._between(inner, limits)
        return self._inner[limits]

    def _between(self, inner: Interval, limits: tuple[Any, ...]) -> Piece:
        x, low, high = limits
        local = tuple((where, fact) for where, fact in self.local if not _speaks_of(x, where, fact))
        if len(local) < len(self.local) or any(e.has(x) for e, _ in self.facts):
            # the bound variable only shares its name with one that is free here: nothing known of that one holds
            apart = [fact for fact in self.facts if not fact[0].has(x)]
            ranges = [r for r in self.ranges if r.symbol != x]
            return Piece(apart, ranges, local, shown=self.shown & {*apart})._between(inner, limits)
        if low.has(x) or high.has(x):
            return self  # the limits speak of another variable of that name
        order = self.order(low, high)
        if order == "-":
            inner = Interval(x, high, low, True, True)
        elif order is None or order == "<=":
            return self  # which of the limits is the lower one is not known, so nothing is known of x
        known = [fact for where, fact in self.local if where == limits]
        return self.extended([*inner.facts(), *known], [inner])

    def noting(self, limits: tuple[Any, ...], fact: tuple[Expr, bool]) -> Piece:
        """The piece with a fact that holds between the given limits of an integral."""
        return Piece(self.facts, self.ranges, (*self.local, (limits, fact)), self)

    def substituted(self, symbol: Symbol, value: Expr) -> Piece:
        facts = [(e.subs(symbol, value), strict) for e, strict in self.facts]
        here = [
            (tuple(a.subs(symbol, value) for a in limits), (f[0].subs(symbol, value), f[1]))
            for limits, f in self.local
            if symbol not in limits and not value.has(limits[0])
        ]
        return Piece(
            [f for f in facts if f[0].free_symbols or not f[0].is_positive],
            [r for r in self.ranges if r.symbol != symbol],
            here,
        )

    def without(self, index: int) -> Piece:
        """The piece without one of its facts, to ask whether the others contradict it."""
        return Piece(self.facts[:index] + self.facts[index + 1 :], self.ranges, self.local)

    def facts_about(self, symbol: Symbol) -> bool:
        """Whether something is assumed of a symbol."""
        return any(fact[0].has(symbol) for fact in self.facts if fact not in self.shown)

    # --- zero --------------------------------------------------------------------------------------

    def is_zero(self, expression: Expr) -> bool:
        """True only where the normal form is exactly zero; False means "not shown"."""
        try:
            numerator, _ = self.field.fraction(expression)
        except Unsettled:
            return False
        return numerator.is_zero

    def normal(self, expression: Expr) -> Expr:
        return self.field.expression(expression)

    # --- signs -------------------------------------------------------------------------------------

    def order(self, low: Expr, high: Expr) -> Sign:
        """The sign of high - low, where either may be infinite."""
        if low == high:
            return "0"
        if low == -oo or high == oo:
            return "+"
        if low == oo or high == -oo:
            return "-"
        return self.sign(high - low)

    def sign(self, expression: Expr) -> Sign:
        expression = sympify(expression)
        if expression not in self._signs:
            self._signs[expression] = None  # a question that comes back to itself has no answer
            self._signs[expression] = self._sign(expression)
        return self._signs[expression]

    def _sign(self, expression: Expr) -> Sign:
        if expression.is_Rational:
            return "+" if expression > 0 else "-" if expression < 0 else "0"
        if expression.is_Mul:
            product: Sign = "+"
            for factor in expression.args:
                product = times(product, self.sign(factor))
            if product is not None:
                return product
        if not expression.free_symbols:
            return _constant_sign(expression)
        if isinstance(expression, Max):
            above = {self.sign(a) for a in expression.args}
            if above & {"+", ">=", "0"} and all(self._real(a) for a in expression.args):
                return "+" if "+" in above else ">="
        if isinstance(expression, Piecewise):
            return self._sign_of_branches(expression)
        if expression.is_Add and len(expression.args) == 2:
            powers = difference_of_exponentials(*expression.args)
            if powers is not None and self._real(expression) and self.sign(powers[0] - powers[1]) is not None:
                return self.sign(powers[0] - powers[1])  # the exponential is increasing
        if isinstance(expression, besseli) and expression.args[0].is_integer and self._real(expression.args[1]):
            known = self.field.sign_of_bessel(*expression.args)  # before it is written by its neighbours
            if known is not None:
                return known
        if isinstance(expression, Integral) and len(expression.limits) == 1 and len(expression.limits[0]) == 3:
            # by the name that its variable has here, under which facts about the integrand may be noted
            x, low, high = expression.limits[0]
            if self.sign(high - low) in ("+", ">=", "0"):
                here = self.inside(x, low, high).sign(expression.function)
                if here in ("+", ">="):
                    return ">="
        try:
            numerator, denominator = self.field.fraction(expression)
        except Unsettled:
            return None
        if numerator.is_zero:
            return "0"
        found = times(self.sign_of_factors(numerator), self.sign_of_factors(denominator))
        if found is None and expression.is_Pow and expression.exp.is_Integer and expression.exp.is_even:
            return ">="  # whatever has a normal form is real, and its even powers are not negative
        return found

    def _real(self, expression: Expr) -> bool:
        """Whatever has a normal form is real."""
        try:
            self.field.fraction(expression)
        except Unsettled:
            return False
        return True

    def _sign_of_branches(self, e: Piecewise) -> Sign:
        """The sign that all branches share, each judged where its condition holds."""
        found: set[Sign] = set()
        for value, condition in e.args:
            facts = relation_facts(condition)
            for (gap, strict), (big, small) in zip(facts, both_sides(condition), strict=True):
                if self.sign(big) in ("+", ">=") and self.sign(small) in ("+", ">="):
                    facts = [*facts, (gap * (big + small), strict)]
            found.add(self.extended([(f.expand(), strict) for f, strict in facts]).sign(value))
        if found <= {"+", ">=", "0"}:
            return "+" if found == {"+"} else ">="
        return ("-" if found == {"-"} else "<=") if found <= {"-", "<=", "0"} else None

    def _learn(self, expression: Expr, strict: bool) -> None:
        """Write a fact in atoms. One that has no normal form yet, for want of another fact, is tried again later."""
        try:
            numerator, denominator = self.field.fraction(expression)
        except Unsettled:
            self._pending.append((expression, strict))
            return
        below = self.sign_of_factors(denominator)
        if below in ("+", "-") and not numerator.is_zero:
            new = (terms_of(numerator if below == "+" else -numerator), strict)
            if new not in self.known:
                self.known.append(new)
                self._forget()

    def _forget(self) -> None:
        """A new fact may answer what was unknown; what is known stays known."""
        strict = ("+", "-", "0")
        self._signs = {k: v for k, v in self._signs.items() if v in strict}
        self._polynomial_signs = {k: v for k, v in self._polynomial_signs.items() if v in strict}
        self._products = None
        self.field.forget()

    def _sign_by_squares(self, gap: Expr, left: Expr, right: Expr) -> Sign:
        """The sign of left - right (or of right - left, whichever gap is) where both lie on one side of 0."""
        signs = {self.sign(left), self.sign(right)}
        squares = self.sign(left**2 - right**2)
        turned = FLIP[squares] if gap != left - right else squares
        if signs <= {"+", ">=", "0"}:
            return turned
        return FLIP[turned] if signs <= {"-", "<=", "0"} else None

    def decide(self, condition: Expr) -> bool | None:
        """A condition's truth value on the whole piece, or None."""

        if condition in (S.true, S.false):
            return bool(condition)
        if isinstance(condition, Not):
            inner = self.decide(condition.args[0])
            return None if inner is None else not inner
        if isinstance(condition, And | Or):
            parts = [self.decide(c) for c in condition.args]
            decisive = isinstance(condition, Or)
            if decisive in parts:
                return decisive
            return None if None in parts else not decisive
        if isinstance(condition, Eq | Ne):
            sign = self.sign(condition.lhs - condition.rhs)
            equal = True if sign == "0" else False if sign in ("+", "-") else None
            return equal if isinstance(condition, Eq) or equal is None else not equal
        facts = relation_facts(condition)
        if not facts:
            return None
        ((expression, strict),) = facts
        sign = self.sign(expression)
        if sign not in ("+", "-"):
            sign = self._sign_by_squares(expression, condition.lhs, condition.rhs) or sign
        if sign == "+" or (not strict and sign in ("0", ">=")):
            return True
        if sign == "-" or (strict and sign in ("0", "<=")):
            return False
        return None


def _speaks_of(x: Symbol, where: tuple[Any, ...], fact: Fact) -> bool:
    """Whether a fact about an integrand over another variable says something of x, which is free in it."""
    y, low, high = where
    return low.has(x) or high.has(x) or (y != x and fact[0].has(x))


def _constant_sign(expression: Expr) -> Sign:
    """The sign of a constant, by a ball that excludes zero."""
    if expression == 0:
        return "0"
    if expression in (oo, pi):
        return "+"
    if expression == -oo:
        return "-"
    from xsec_sym.proof.balls import NoEnclosure, enclose

    try:
        ball = enclose(expression, 20)
    except NoEnclosure:
        return None
    return "+" if ball > 0 else "-" if ball < 0 else None
