"""Where a claim is tried: exact points in the bulk, on and near the boundary, and on and near every branch."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import product
from random import Random
from typing import Any

from sympy import (
    Abs,
    Expr,
    Heaviside,
    Integral,
    Max,
    Min,
    Piecewise,
    Rational,
    Sum,
    oo,
    preorder_traversal,
    sign,
    sympify,
)
from sympy.core.relational import Relational

from xsec_sym.proof.domain import Choices, Domain, EmptyDomain, Integers, Interval
from xsec_sym.proof.magnitude import Magnitude

Point = dict[Any, Expr]
# Exact values on which the joins of this field lie: poles, the equator, and Pythagorean pairs for u^2 + v^2 = 1.
SPECIAL = tuple(Rational(a, b) for a, b in ((0, 1), (1, 1), (3, 5), (4, 5), (5, 13), (1, 2)))


def witnesses(domain: Domain, sides: Iterable[Expr], count: int, seed: int = 0) -> list[Point]:
    """At least ``count`` distinct points of the domain where it has that many; EmptyDomain where there is none.

    >>> from sympy import Symbol
    >>> from xsec_sym.proof.domain import domain, interval
    >>> u = Symbol("u", real=True)
    >>> len(witnesses(domain([interval(u, -1, 1)]), [abs(u)], 20)) >= 20
    True
    """
    random = Random(seed)
    found: dict[tuple[Expr, ...], Point] = {}

    def add(point: Point | None) -> None:
        if point is not None and domain.holds_at(point):
            found.setdefault(tuple(point[s] for s in domain.symbols), point)

    if not domain.symbols:
        return [{}]
    for _ in range(50 * count):
        add(_random_point(domain, random))
        if len(found) >= max(count // 2, 4):
            break
    bulk = list(found.values())
    if len(found) < count:
        for point in _special_points(domain, random, 4 * count):
            add(point)
    if not found:
        raise EmptyDomain(f"no point satisfies {domain.text()}")
    near: list[Point] = []
    for point in bulk:
        near += _towards_the_ends(domain, point)
    # a handful of points is asked for to check a proof once more: those are taken from the bulk
    for point in bulk[: 4 if count >= 8 else 0]:
        near += _around_switches(domain, switches(sides), point)
    random.shuffle(near)
    special = list(_special_points(domain, random, 2 * count))
    for point in [*near[: 2 * count], *special]:
        if len(found) >= 2 * count:
            break
        add(point)
    for _ in range(20 * count):
        if len(found) >= count:
            break
        add(_random_point(domain, random))
    chosen = list(found.values())
    head, tail = chosen[: len(bulk)], chosen[len(bulk) :]
    random.shuffle(tail)
    return _interleaved(head, tail)[: max(count, 1)]


def _interleaved(a: list[Point], b: list[Point]) -> list[Point]:
    mixed = [p for pair in zip(a, b, strict=False) for p in pair]
    shorter = min(len(a), len(b))
    return mixed + a[shorter:] + b[shorter:]


def switches(sides: Iterable[Expr]) -> list[Expr]:
    """Expressions whose zero is the edge of a branch."""
    found: dict[Expr, None] = {}
    for side in sides:
        for node in preorder_traversal(sympify(side)):
            if isinstance(node, Abs | Heaviside | sign) and not isinstance(node, Magnitude):
                found[node.args[0]] = None
            elif isinstance(node, Max | Min):
                found[node.args[0] - node.args[1]] = None
            elif isinstance(node, Piecewise):
                for _, condition in node.args:
                    for relation in condition.atoms(Relational):
                        found[relation.lhs - relation.rhs] = None
    return [edge for edge in found if not edge.has(Integral, Sum)]  # whose zeros would be too dear to find


def _random_point(domain: Domain, random: Random) -> Point:
    point: Point = {}
    for variable in domain.variables:
        if isinstance(variable, Choices):
            point[variable.symbol] = random.choice(variable.values)
        elif isinstance(variable, Integers):
            most = 12 if variable.high is None else (variable.high - variable.low) // variable.step
            point[variable.symbol] = sympify(variable.member(random.randint(0, most)))
        else:
            share = Rational(random.randint(1, 996), 997)
            point[variable.symbol] = _between(variable, point, share)
    return point


def _between(variable: Interval, point: Point, share: Rational) -> Expr:
    """The point that divides a range in a given proportion; an infinite range is folded into (0, 1) first."""
    low, high = sympify(variable.low).subs(point), sympify(variable.high).subs(point)
    if low == -oo and high == oo:
        return (2 * share - 1) / (share * (1 - share))
    if high == oo:
        return low + share / (1 - share)
    if low == -oo:
        return high - (1 - share) / share
    return low + share * (high - low)


def _special_points(domain: Domain, random: Random, most: int) -> Iterator[Point]:
    choices: list[tuple[Expr, ...]] = []
    for variable in domain.variables:
        if isinstance(variable, Choices):
            choices.append(variable.values)
        elif isinstance(variable, Integers):
            choices.append(tuple(variable.member(i) for i in range(3)))
        else:
            ends = [e for e in (variable.low, variable.high) if sympify(e).is_Rational]
            choices.append(tuple(dict.fromkeys([*ends, *SPECIAL, *(-s for s in SPECIAL)])))
    grid = list(product(*choices)) if _size(choices) <= 20000 else []
    random.shuffle(grid)
    kept = 0
    for values in grid:
        point = dict(zip(domain.symbols, values, strict=True))
        if domain.holds_at(point):
            yield point
            kept += 1
            if kept == most:
                return


def _size(choices: list[tuple[Expr, ...]]) -> int:
    size = 1
    for c in choices:
        size *= len(c)
    return size


def _towards_the_ends(domain: Domain, point: Point) -> list[Point]:
    near = []
    for variable in domain.variables:
        if isinstance(variable, Interval):
            for share in (Rational(1, 10**3), Rational(1, 10**6)):
                near += [{**point, variable.symbol: _between(variable, point, s)} for s in (share, 1 - share)]
    return near


def _around_switches(domain: Domain, edges: list[Expr], point: Point) -> list[Point]:
    """Points on both sides of an edge, found by bisection along one variable."""
    near: list[Point] = []
    for edge in edges:
        for variable in domain.variables:
            if isinstance(variable, Interval) and variable.symbol in edge.free_symbols:
                near += _both_sides(variable, edge, point)
    return near


def _both_sides(variable: Interval, edge: Expr, point: Point) -> list[Point]:
    rest = {k: v for k, v in point.items() if k != variable.symbol}
    along = edge.subs(rest)
    if along.free_symbols != {variable.symbol}:
        return []

    def side(share: Rational) -> int:
        value = along.subs(variable.symbol, _between(variable, point, share)).evalf(15)
        return 0 if not value.is_real else 1 if value > 0 else -1 if value < 0 else 0

    grid = [Rational(i, 8) + Rational(1, 1001) * (1 if i == 0 else -1 if i == 8 else 0) for i in range(9)]
    signs = [side(s) for s in grid]
    near = []
    for a, b, sa, sb in zip(grid, grid[1:], signs, signs[1:], strict=False):
        if sa * sb < 0:
            low, high = a, b
            for _ in range(24):
                middle = (low + high) / 2
                low, high = (middle, high) if side(middle) == sa else (low, middle)
            for step in (Rational(1, 100), Rational(1, 10**4)):
                for share in (low - step, high + step):
                    if 0 < share < 1:
                        rounded = Rational(round(share * 10**6), 10**6)
                        near.append({**point, variable.symbol: _between(variable, point, rounded)})
    return near


def distance_from_bulk(domain: Domain, point: Point) -> float:
    """How far a point lies from the easy middle of each half range: small where quadrature has little trouble."""
    total = 0.0
    point = {k: v for k, v in point.items() if isinstance(v, Expr)}
    for variable in domain.variables:
        if isinstance(variable, Interval):
            low, high = sympify(variable.low).subs(point), sympify(variable.high).subs(point)
            if low.is_finite and high.is_finite:
                share = float((point[variable.symbol] - low) / (high - low))
                total += abs(abs(share - 0.5) - 0.25)
        elif isinstance(variable, Integers):
            total += float(point[variable.symbol]) / 100
    return total
