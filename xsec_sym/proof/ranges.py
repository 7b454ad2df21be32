"""Where an equation should hold, as users type it: ranges and conditions in one line."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import sympy
from sympy import Expr, Integer, S, Symbol, oo
from sympy.core.relational import Relational
from sympy.logic.boolalg import Boolean

from xsec_sym.proof.claim import Claim
from xsec_sym.proof.domain import Choices, Domain, EmptyDomain, Integers, Interval, domain, interval
from xsec_sym.proof.parse import CONSTANTS, LONGEST, ParseError, condition, demand_name, expression, short, unbound


def equation(lhs: Any, rhs: Any, where: Any = "") -> Claim:
    """The claim that two sides, typed or SymPy expressions, are equal. Raises `ParseError` and `EmptyDomain`.

    >>> equation("2*u", "u + u", where="u in [0, 1)").domain.text()
    'u in [0, 1)'
    """
    place = ranges(where) if isinstance(where, str) else domain(where)
    symbols = {s.name: s for s in place.symbols}
    left, right = (_side(s, symbols) for s in (lhs, rhs))
    return Claim(id="user:check", source="user", section="", label="check", title="an equation of your own",
                 kind="equation", left=left, printed=right, corrected=None, domain=place)  # fmt: skip


def _side(side: Any, symbols: Mapping[str, Symbol]) -> Expr:
    if isinstance(side, str):
        return expression(side, symbols)
    if isinstance(side, int):
        return Integer(side)
    if not isinstance(side, Expr):
        raise ParseError(f"{short(str(side))} is neither a text nor a SymPy expression")
    for symbol in sorted(side.free_symbols, key=str):
        if str(symbol) not in symbols:
            raise ParseError(unbound(str(symbol)))
    return side.xreplace({s: symbols[str(s)] for s in side.free_symbols})


_RANGE = re.compile(r"\s*(\w+)\s+in\b\s*(.*)", re.DOTALL)
_COMPARISON = re.compile(r"<=?|>=?")
_TOKEN = re.compile(r"[(\[{]|[)\]}]|,|;|\band\b")


def ranges(text: str) -> Domain:
    """The domain that a text describes: ranges and conditions, separated by commas, semicolons or ``and``.

    A variable may be bounded by comparisons alone. Raises `ParseError` for what cannot be read, `EmptyDomain` where
    nothing is left.

    >>> ranges("u in (-1, 1], n in {0, 1, 2}, x in [0, oo), u*x < 1").text()
    'u in (-1, 1]; n in {0, 1, 2}; x in [0, oo); u*x < 1'
    >>> ranges("0 < a <= 1, b > a").text()
    'a in (0, 1]; b in (a, oo)'
    """
    if len(text) > LONGEST:
        raise ParseError(f"a domain of {len(text)} characters is too long; the limit is {LONGEST}")
    symbols: dict[str, Symbol] = {}
    found: list[Any] = []
    conditions = []
    for clause in _clauses(text):
        if match := _RANGE.match(clause):
            name, rest = match.groups()
            demand_name(name)
            if name in symbols:
                raise ParseError(f"{name} is given two ranges")
            found.append(_variable(name, rest.strip(), symbols))
            symbols[name] = found[-1].symbol
        else:
            conditions.append(clause)
    compared, conditions = _compared(conditions, symbols)
    place = domain([*found, *compared, *(condition(c, symbols) for c in conditions)])
    return _inhabited(place)


def _compared(clauses: list[str], symbols: dict[str, Symbol]) -> tuple[list[Interval | Choices], list[str]]:
    """Ranges of variables that only comparisons bound, as in 0 < x <= 1; and the clauses that are left."""
    ends: dict[str, dict[bool, tuple[Expr, bool]]] = {}
    left = []
    for clause in (part for c in clauses for part in ([c] if re.search(r"\bor\b", c) else _split(c, "and"))):
        sides, signs = [side.strip() for side in _COMPARISON.split(clause)], _COMPARISON.findall(clause)
        pairs = list(zip(sides, signs, sides[1:], strict=False))
        names = {s for s in sides if s.isidentifier() and s not in symbols and s not in CONSTANTS}
        names = names - ends.keys() or names
        if len(names) != 1 or not pairs or not all(names & {a, b} for a, _, b in pairs):
            left.append(clause)
            continue
        (name,) = names
        demand_name(name)
        known = {**symbols, **{other: Symbol(other, real=True) for other in ends if other != name}}
        bounds = {(a == name) == (sign[0] == ">"): (expression(b if a == name else a, known), len(sign) == 1)
                  for a, sign, b in pairs}  # fmt: skip
        if len(bounds) < len(pairs) or bounds.keys() & ends.get(name, {}).keys():
            left.append(clause)  # a second bound on one side narrows the range as a condition
        else:
            ends.setdefault(name, {}).update(bounds)
    found = []
    for name, bounds in ends.items():
        (low, after), (high, before) = bounds.get(True, (-oo, True)), bounds.get(False, (oo, True))
        found.append(_between(name, low, high, after, before))
        symbols[name] = found[-1].symbol
    return found, left


def _clauses(text: str) -> Iterator[str]:
    for piece in _split(text, ",;"):
        clause, *words = _split(piece, "and")
        for word in words:
            if _RANGE.match(clause) or _RANGE.match(word):
                yield clause
                clause = word
            else:
                clause += f" and {word}"
        if clause.strip():
            yield clause
        elif piece.strip() or text.strip():
            raise ParseError(f"{short(text)} has an empty part")


def _split(text: str, at: str) -> list[str]:
    """Cut at separators outside all brackets; (a, b] closes as well as it opens."""
    parts, start, depth = [], 0, 0
    for token in _TOKEN.finditer(text):
        word = token.group()
        if word in "([{":
            depth += 1
        elif word in ")]}":
            depth -= 1
        elif depth == 0 and word in at:
            parts.append(text[start : token.start()])
            start = token.end()
        if depth < 0:
            break
    if depth:
        raise ParseError(f"{short(text)} has a bracket that does not match")
    return [*parts, text[start:]]


def _variable(name: str, text: str, symbols: Mapping[str, Symbol]) -> Interval | Choices | Integers:
    if len(text) < 2 or text[0] not in "([{" or text[-1] not in ")]}" or (text[0] == "{") != (text[-1] == "}"):
        raise ParseError(f"{short(f'{name} in {text}')} is no range: write (a, b), [a, b] or {{a, b, c}}")
    try:
        items = _split(text[1:-1], ",")
    except ParseError:
        raise ParseError(f"{short(f'{name} in {text}')} is no range; a comma or 'and' may be missing") from None
    if text[0] == "{":
        return _choices(name, items, text)
    if len(items) != 2:
        raise ParseError(
            f"{short(f'{name} in {text}')} is no interval: it has {len(items)} bound{'s' * (len(items) != 1)}, not 2"
        )
    low, high = (expression(i, symbols) for i in items)
    return _between(name, low, high, text[0] == "(", text[-1] == ")")


def _between(name: str, low: Expr, high: Expr, after: bool, before: bool) -> Interval | Choices:
    """The range from low to high, without low if it begins ``after``, without high if it ends ``before``."""
    for bound in (low, high):
        if bound.is_extended_real is False:
            raise ParseError(f"{bound} is not real, so it cannot bound {name}")
    if low == high and low.is_real and not (after or before):
        return Choices(Symbol(name, real=True), (low,))
    try:
        made = interval(Symbol(name, real=True), low, high, open=True)
    except TypeError:
        raise ParseError(
            f"{name} from {short(str(low))} to {short(str(high))} has bounds that cannot be compared"
        ) from None
    return replace(made, low_open=after or low == -oo, high_open=before or high == oo)


def _choices(name: str, items: list[str], text: str) -> Choices | Integers:
    if not "".join(items).strip():
        raise EmptyDomain(f"the set for {name} is empty")
    if any(i.strip() == "..." for i in items):
        return _progression(name, items, text)
    values = tuple(dict.fromkeys(expression(i) for i in items))
    for value in values:
        if not value.is_real:
            raise ParseError(f"{short(str(value))} in the set for {name} is not a real number")
    assumed = {"integer": True} if all(isinstance(v, Integer) for v in values) else {"real": True}
    return Choices(Symbol(name, **assumed), values)


def _progression(name: str, items: list[str], text: str) -> Integers:
    numbers = [expression(i) for i in items if i.strip() != "..."]
    if len(items) not in (3, 4) or items[2].strip() != "..." or not all(isinstance(n, Integer) for n in numbers):
        raise ParseError(f"{short(f'{name} in {text}')} is no progression: write {{0, 2, ...}} or {{0, 2, ..., 10}}")
    low, second, *last = (int(n) for n in numbers)
    if second <= low or (last and last[0] < second):
        raise EmptyDomain(f"the progression for {name} does not rise")
    return Integers(Symbol(name, integer=True), low, second - low, last[0] if last else None)


def _inhabited(place: Domain) -> Domain:
    """Refuse what is visibly empty: conditions on one variable that leave nothing of its range."""
    for variable in place.variables:
        here = [c for c in place.conditions if c.free_symbols == {variable.symbol}]
        if here and _empty(variable, here):
            raise EmptyDomain(f"no {variable.text()} satisfies {' and '.join(map(str, here))}")
    return place


def _empty(variable: Any, conditions: Iterable[Boolean]) -> bool:
    if isinstance(variable, Choices):
        return all(any(c.subs(variable.symbol, v) == False for c in conditions) for v in variable.values)  # noqa: E712
    if not isinstance(variable, Interval) or not (variable.low.is_number and variable.high.is_number):
        return False
    # beyond polynomials SymPy may search for a long time; whoever samples the domain finds out about those
    relations = [r for c in conditions for r in c.atoms(Relational)]
    if not all((r.lhs - r.rhs).is_polynomial(variable.symbol) for r in relations):
        return False
    left = sympy.Interval(variable.low, variable.high, variable.low_open, variable.high_open)
    try:
        for c in conditions:
            left = left.intersect(c.as_set())
    except (NotImplementedError, TypeError, ValueError, AttributeError):
        return False
    return left is S.EmptySet
