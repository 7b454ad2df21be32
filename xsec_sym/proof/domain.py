"""Where a claim should hold: variables with their ranges, and conditions on them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from sympy import And, Expr, Ge, Gt, Le, Lt, S, Symbol, oo, sympify
from sympy.core.relational import Relational
from sympy.logic.boolalg import Boolean

from xsec_sym.proof.typeset import latex


class EmptyDomain(ValueError):
    """No point satisfies what a claim assumes, so the claim would hold vacuously.

    >>> from sympy import Symbol
    >>> interval(Symbol("u", real=True), 1, 0)
    Traceback (most recent call last):
    ...
    xsec_sym.proof.domain.EmptyDomain: the interval from 1 to 0 for u is empty: the lower bound comes first
    """


@dataclass(frozen=True)
class Interval:
    """A real variable between two bounds that may depend on the variables named before it."""

    symbol: Symbol
    low: Expr
    high: Expr
    low_open: bool = False
    high_open: bool = False

    def facts(self) -> list[tuple[Expr, bool]]:
        """The bounds as pairs (expression, strict): expression > 0, or >= 0 where not strict."""
        found = []
        if self.low != -oo:
            found.append((self.symbol - self.low, self.low_open))
        if self.high != oo:
            found.append((self.high - self.symbol, self.high_open))
        return found

    def latex(self) -> str:
        left = "(" if self.low_open or self.low == -oo else "["
        right = ")" if self.high_open or self.high == oo else "]"
        return rf"{latex(self.symbol)} \in {left}{latex(self.low)}, {latex(self.high)}{right}"

    def text(self) -> str:
        left = "(" if self.low_open or self.low == -oo else "["
        right = ")" if self.high_open or self.high == oo else "]"
        return f"{self.symbol} in {left}{self.low}, {self.high}{right}"


@dataclass(frozen=True)
class Integers:
    """An integer variable low, low + step, low + 2 step, ...: written low + step * index with index = 0, 1, 2, ..."""

    symbol: Symbol
    low: int = 0
    step: int = 1
    high: int | None = None

    @property
    def index(self) -> Symbol:
        return Symbol(f"n_{self.symbol}", integer=True, nonnegative=True)

    def member(self, index: Any) -> Expr:
        return sympify(self.low + self.step * index)

    def text(self) -> str:
        last = "" if self.high is None else f", {self.high}"
        return f"{self.symbol} in {{{self.low}, {self.low + self.step}, ...{last}}}"

    def latex(self) -> str:
        last = "" if self.high is None else f", {self.high}"
        return rf"{latex(self.symbol)} \in \{{{self.low}, {self.low + self.step}, \dots{last}\}}"


@dataclass(frozen=True)
class Choices:
    """A variable that takes one of finitely many exact values."""

    symbol: Symbol
    values: tuple[Expr, ...]

    def text(self) -> str:
        return f"{self.symbol} in {{{', '.join(map(str, self.values))}}}"

    def latex(self) -> str:
        return rf"{latex(self.symbol)} \in \{{{', '.join(map(latex, self.values))}\}}"


Variable = Interval | Integers | Choices


@dataclass(frozen=True)
class Domain:
    """The variables of a claim in order, and the conditions that tie them together."""

    variables: tuple[Variable, ...] = ()
    conditions: tuple[Boolean, ...] = ()
    instances: Mapping[Any, tuple[Any, ...]] = field(default_factory=dict)

    @property
    def symbols(self) -> tuple[Symbol, ...]:
        return tuple(v.symbol for v in self.variables)

    def text(self) -> str:
        return "; ".join([v.text() for v in self.variables] + [str(c) for c in self.conditions])

    def latex(self) -> str:
        return r",\; ".join([v.latex() for v in self.variables] + [latex(c) for c in self.conditions])

    def holds_at(self, point: Mapping[Symbol, Expr]) -> bool:
        """Whether an exact point lies in the domain; a condition that SymPy cannot settle counts as outside."""
        for variable in self.variables:
            here = point[variable.symbol]
            if isinstance(variable, Interval):
                low, high = sympify(variable.low).subs(point), sympify(variable.high).subs(point)
                above = Gt(here, low) if variable.low_open else Ge(here, low)
                below = Lt(here, high) if variable.high_open else Le(here, high)
                if above != True or below != True:  # noqa: E712  (SymPy booleans)
                    return False
            elif isinstance(variable, Choices):
                if here not in variable.values:
                    return False
            elif here < variable.low or (here - variable.low) % variable.step or (variable.high or here) < here:
                return False
        return all(c.subs(point) == True for c in self.conditions)  # noqa: E712


def interval(symbol: Symbol, low: Any, high: Any, *, open: str | bool = False) -> Interval:
    """``symbol`` between ``low`` and ``high``; ``open`` is True, "left", "right" or False.

    >>> from sympy import Symbol
    >>> interval(Symbol("u", real=True), -1, 1, open="left").text()
    'u in (-1, 1]'
    """
    low, high = sympify(low), sympify(high)
    if low.is_number and low == high and not open:
        raise EmptyDomain(f"the interval [{low}, {high}] for {symbol} is one point: put {low} for {symbol} instead")
    if low.is_number and high.is_number and not low < high:
        why = "it has no point" if low == high else "the lower bound comes first"
        raise EmptyDomain(f"the interval from {low} to {high} for {symbol} is empty: {why}")
    return Interval(symbol, low, high, open in (True, "left"), open in (True, "right"))


def integers(symbol: Symbol, low: int = 0, high: int | None = None) -> Integers:
    """The whole numbers from `low` on, up to `high` if it is given.

    >>> from sympy import Symbol
    >>> integers(Symbol("n"), 1).text(), integers(Symbol("n"), 0, 3).text()
    ('n in {1, 2, ...}', 'n in {0, 1, ..., 3}')
    """
    return Integers(symbol, low, 1, high)


def parity(symbol: Symbol, *, odd: bool = False, even: bool = False) -> Integers:
    """The natural numbers of one parity.

    >>> from sympy import Symbol
    >>> parity(Symbol("p"), odd=True).text()
    'p in {1, 3, ...}'
    """
    if odd == even:
        raise ValueError(f"parity of {symbol}: say either odd=True or even=True")
    return Integers(symbol, 1 if odd else 0, 2)


def domain(where: Iterable[Any] = (), instances: Mapping[Any, Iterable[Any]] | None = None) -> Domain:
    """Sort what a claim assumes into variables and conditions."""
    variables, conditions = [], []
    for item in where:
        if isinstance(item, Interval | Integers | Choices):
            variables.append(item)
        elif item is S.false or item is False:
            raise EmptyDomain("a condition of the domain is false everywhere")
        elif isinstance(item, And):
            conditions.extend(item.args)
        elif item is S.true or item is True:
            continue
        elif isinstance(item, Relational | Boolean):
            conditions.append(item)
        else:
            raise TypeError(f"{item!r} is neither a range nor a condition")
    chosen = {k: tuple(v) for k, v in (instances or {}).items()}
    return Domain(tuple(variables), tuple(conditions), chosen)
