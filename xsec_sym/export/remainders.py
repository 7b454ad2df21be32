"""Proved bounds on the error of a table of powers: an interpolant of the error itself, whose remainder ellipses bound.

What a table T misses of a function f, e = f - T, is analytic where f is. On [-1, 1]^2 it is a sum of products of
Chebyshev polynomials, and if |e| <= M on the product of the ellipses with foci -1 and 1 whose semi-axes add up to rho
and sigma, the coefficient of T_j(x) T_k(y) is at most 4 M rho^-j sigma^-k (Cauchy's estimate, x = (z + 1/z)/2). At the
zeros of T_n and T_m, a product with j >= n or k >= m equals one of lower degrees up to its sign, or 0. So the
interpolant there has lost each of these products and gained another instead, and is off by at most

    2 sum over j >= n or k >= m of 4 M rho^-j sigma^-k  <=  8 M (rho^-n + sigma^-m)/((1 - 1/rho) (1 - 1/sigma)),

in one variable by 4 M rho^-n/(1 - 1/rho). The interpolant itself is bounded box by box, together with what errors are
relative to: balls enclose its coefficients as soon as they enclose f at the nodes, and T is exact. M may be crude: a
factor of 10 is paid with a node or two. And since e is interpolated and not f, any analytic chart does: toward an end
where f is singular, that is the logarithm of the variable, in which e stays analytic in a strip.

An analytic function is largest on the product of the ellipses' boundaries, so that M is sought there, over boxes that
cover each. They cover the upper half only: what is bounded depends on moduli, real parts and the sizes of angles.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from math import ceil
from typing import NamedTuple, TypeVar

from flint import acb, arb, arb_mat

Table = Sequence[Sequence[float]]
Known = tuple[arb, ...]
Number = TypeVar("Number", arb, acb)
# How finely the boundary of an ellipse is cut, and which ellipses are tried, by the sum of their semi-axes.
ARCS = 48
ELLIPSES = [arb(1.25 * 1.18**k) for k in range(24)]


class Span(NamedTuple):
    """An interval of a table's variable, a part of `cell`: it is linear in [-1, 1], or its logarithm is."""

    low: float
    high: float
    cell: tuple[float, float]
    logarithmic: bool = False

    def place(self, unit: Number) -> Number:
        low, high = arb(self.low), arb(self.high)
        if self.logarithmic:
            low, high = low.log(), high.log()
        found = unit * ((high - low) / 2) + (low + high) / 2
        return found.exp() if self.logarithmic else found

    def nodes(self, count: int) -> list[arb]:
        return [self.place((arb(2 * j + 1) / (2 * count)).cos_pi()) for j in range(count)]

    def arcs(self, rho: arb) -> list[acb]:
        """Boxes that cover the image of the upper half of an ellipse."""
        long, short = (rho + 1 / rho) / 2, (rho - 1 / rho) / 2
        return [self.place(acb(long * turn.cos_pi(), short * turn.sin_pi())) for turn in half_turn(ARCS)]

    def unit(self, place: Number) -> Number:
        """The variable of the cell's table, in [-1, 1]."""
        low, high = map(arb, self.cell)
        return (place - (low + high) / 2) * (2 / (high - low))


def boxes(count: int) -> list[arb]:
    """Balls that cover [-1, 1], narrow toward its ends, where polynomials turn."""
    edges = [(arb(k) / count).cos_pi() for k in range(count + 1)]
    return [low.union(high) for low, high in pairwise(edges)]


def half_turn(count: int) -> list[arb]:
    """Balls that cover [0, 1]."""
    return [arb(arb(2 * k + 1) / (2 * count), arb(1) / (2 * count)) for k in range(count)]


def decades(low: float, high: float) -> list[tuple[float, float]]:
    """[low, high] cut where it has grown tenfold."""
    edges = [low]
    while edges[-1] * 20 < high:
        edges.append(edges[-1] * 10)
    return list(pairwise([*edges, high]))


class Majorant(NamedTuple):
    """A bound on |f| on the product of two boundaries: what must be known of either; None where there is no bound."""

    x: Callable[[list[acb]], Known | None]
    y: Callable[[list[acb]], Known | None]
    size: Callable[[Known, Known], arb | None]


class Plan(NamedTuple):
    """How many nodes either variable gets, and the remainder of the interpolant."""

    nodes: tuple[int, int]
    remainder: arb


def greatest(balls: Sequence[arb]) -> arb:
    """An upper bound, as a point."""
    found = balls[0].upper()
    for ball in balls[1:]:
        found = found.max(ball.upper())
    return found


def least(balls: Sequence[arb]) -> arb:
    return -greatest([-ball for ball in balls])


def coefficients(values: arb_mat) -> arb_mat:
    """Of the products of Chebyshev polynomials, for the interpolant of these values at the nodes."""
    return _transform(values.nrows()) * values * _transform(values.ncols()).transpose()


def _transform(count: int) -> arb_mat:
    turns = [(arb(k) / (2 * count)).cos_pi() / count for k in range(4 * count)]
    return arb_mat(
        [[turns[i * (2 * j + 1) % (4 * count)] * (2 if i else 1) for j in range(count)] for i in range(count)]
    )


def table_at(table: Table, x: Sequence[arb], y: Sequence[arb]) -> arb_mat:
    """The table's polynomial at all pairs of places in [-1, 1]."""
    width = max(map(len, table))
    columns = arb_mat([[row[i] if i < len(row) else 0 for row in table] for i in range(width)])
    return _powers(x, width) * columns * _powers(y, len(table)).transpose()


def _powers(places: Sequence[arb], count: int) -> arb_mat:
    return arb_mat([[place**i for i in range(count)] for place in places])


def _size(row: Sequence[float | arb], at: arb) -> arb:
    """What the polynomial does not exceed for variables of that size."""
    found = arb(0)
    for coefficient in reversed(row):
        found = found * at + abs(arb(coefficient))
    return found


def _enough(scale: arb, base: arb, goal: arb) -> int:
    """The least power of 1/base that brings `scale` to half the goal, or one more."""
    return max(1, ceil(float((2 * scale / goal).log() / base.log())))


def planned(x: Span, y: Span, majorant: Majorant, tables: Sequence[Table], goal: arb) -> Plan:
    """The fewest nodes whose remainder is about `goal`; ArithmeticError where no ellipses bound the function."""
    best: Plan | None = None
    along = [(rho, known, arcs) for rho in ELLIPSES if (known := majorant.x(arcs := x.arcs(rho)))]
    across = [(rho, known, arcs) for rho in ELLIPSES if (known := majorant.y(arcs := y.arcs(rho)))]
    high = [greatest([abs(y.unit(arc)) for arc in arcs]) for _, _, arcs in across]
    for rho, of_x, arcs in along:
        wide = greatest([abs(x.unit(arc)) for arc in arcs])
        rows = [[_size(row, wide) for row in table] for table in tables]
        for (sigma, of_y, _), at in zip(across, high, strict=True):
            size = majorant.size(of_x, of_y)
            if size is None or not size.is_finite():
                continue
            size += greatest([_size(row, at) for row in rows])
            scale = 8 * size / ((1 - 1 / rho) * (1 - 1 / sigma))
            n, m = _enough(scale, rho, goal), _enough(scale, sigma, goal)
            if best is None or n * m < best.nodes[0] * best.nodes[1]:
                best = Plan((n, m), (scale * (rho**-n + sigma**-m)).upper())
    if best is None:
        raise ArithmeticError(f"no ellipses about {x.low}..{x.high} and {y.low}..{y.high} bound the function")
    return best


class Missed(NamedTuple):
    """What a table misses: an interpolant, by Chebyshev's polynomials, and its remainder."""

    series: arb_mat
    remainder: arb

    def on(self, x: int, y: int) -> list[list[arb]]:
        """A bound for all pairs of so many `boxes`."""
        across, along = _chebyshev(x, self.series.nrows()), _chebyshev(y, self.series.ncols())
        found = across * self.series * along.transpose()
        return [[abs(found[i, j]) + self.remainder for j in range(y)] for i in range(x)]


def _chebyshev(count: int, terms: int) -> arb_mat:
    """The polynomials on `boxes`, never beyond their range."""
    rows = [[(j * turn).cos_pi() for j in range(terms)] for turn in half_turn(count)]
    return arb_mat([[value.max(arb(-1)).min(arb(1)) for value in row] for row in rows])


def missed(x: Span, y: Span, plan: Plan, f: Callable[[arb, arb], arb], tables: Sequence[Table]) -> list[Missed]:
    """What each table misses of f, anywhere in the two spans."""
    across, along = x.nodes(plan.nodes[0]), y.nodes(plan.nodes[1])
    exact = arb_mat([[f(here, there) for there in along] for here in across])
    places = [x.unit(here) for here in across], [y.unit(there) for there in along]
    return [Missed(coefficients(exact - table_at(table, *places)), plan.remainder) for table in tables]


def missed_on_line(
    span: Span, size: Callable[[list[acb]], arb | None], f: Callable[[arb], arb], row: Sequence[float], goal: arb
) -> Missed:
    """What a polynomial in one variable misses of f, anywhere in the span; |f| is `size` at most on arcs."""
    best: tuple[int, arb] | None = None
    for rho in ELLIPSES:
        arcs = span.arcs(rho)
        known = size(arcs)
        if known is not None and known.is_finite():
            scale = 4 * (known + _size(row, greatest([abs(span.unit(arc)) for arc in arcs]))) / (1 - 1 / rho)
            n = _enough(scale, rho, goal)
            if best is None or n < best[0]:
                best = n, (scale * rho**-n).upper()
    if best is None:
        raise ArithmeticError(f"no ellipse about {span.low}..{span.high} bounds the function")
    nodes = span.nodes(best[0])
    values = arb_mat([[f(node)] for node in nodes]) - table_at([row], [span.unit(node) for node in nodes], [arb(0)])
    return Missed(_transform(best[0]) * values, best[1])
