"""The moves that act on an integral: split it, change its variable, evaluate it, or show that it is infinite."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

from sympy import (
    Abs,
    Add,
    Expr,
    Heaviside,
    Integral,
    Mul,
    Poly,
    Pow,
    S,
    Sum,
    Symbol,
    acos,
    atan,
    besseli,
    cos,
    cosh,
    diff,
    erf,
    exp,
    fraction,
    hyper,
    log,
    oo,
    preorder_traversal,
    sin,
    sinh,
    together,
)
from sympy.core.function import AppliedUndef

from xsec_sym.proof.ends import end_value, tends_to
from xsec_sym.proof.names import captured, natural, plain
from xsec_sym.proof.piece import Piece
from xsec_sym.proof.regular import SWITCHES, Refused, continuous_at, demand, resolved, smooth
from xsec_sym.proof.rules import Goal, Proven, contexts, lemma, occurs
from xsec_sym.proof.signs import times

BINDERS = (Integral, Sum)
TAME = (Symbol, Add, Mul, sin, cos, acos, atan, exp, sinh, cosh, erf, Abs, Heaviside, AppliedUndef)


def parts(goal: Goal, integral: Integral) -> tuple[Expr, Symbol, Expr, Expr, Piece, Piece]:
    demand(occurs(integral, goal.left), lambda: f"{integral} does not occur")
    demand(len(integral.limits) == 1 and len(integral.limits[0]) == 3, lambda: f"{integral} is not over one interval")
    x, low, high = integral.limits[0]
    outer = context(goal, integral)
    inside = {
        limit[0] for node in preorder_traversal(integral.function) if isinstance(node, BINDERS) for limit in node.limits
    }
    demand(x not in inside | outer_names(goal, integral), lambda: f"{x} is bound or used twice in {integral}")
    return integral.function, x, low, high, outer, outer.inside(x, low, high)


def context(goal: Goal, part: Expr) -> Piece:
    """The one piece on which a part of the left side stands, however often it stands there."""
    outer, *others = contexts(goal, part)
    same = all((p.facts, p.ranges, p.local) == (outer.facts, outer.ranges, outer.local) for p in others)
    demand(same, lambda: f"{part} stands in two places of which different things are known")
    return outer


def iterated(goal: Goal, integral: Integral) -> tuple[Expr, Integral, Symbol, Expr, Expr, Piece, Piece]:
    """An integral over an integral as factor, inner integral, and what `parts` says of the outer one.

    SymPy writes one integral over another without a factor between them as a single integral over two variables.
    """
    if len(integral.limits) == 2:
        demand(occurs(integral, goal.left), lambda: f"{integral} does not occur")
        first, (x, low, high) = integral.limits
        outside, rest = S.One, Integral(integral.function, first)
        outer = context(goal, integral)
        demand(x not in outer_names(goal, integral) | {first[0]}, lambda: f"{x} is bound or used twice in {integral}")
        inner = outer.inside(x, low, high)
    else:
        f, x, low, high, outer, inner = parts(goal, integral)
        outside, rest = f.as_independent(Integral, as_Add=False)
    demand(isinstance(rest, Integral) and len(rest.limits) == 1, lambda: f"{integral} is not a double integral")
    y = rest.limits[0][0]
    demand(not outside.has(y) and not low.has(y) and not high.has(y), lambda: f"{y} is used twice in {integral}")
    return outside, rest, x, low, high, outer, inner


def outer_names(goal: Goal, integral: Integral) -> set[Symbol]:
    """What is free where an integral stands, its limits included."""
    found = goal.left.free_symbols | {s for e, _ in goal.piece.facts for s in e.free_symbols}
    return found | {s for end in integral.limits[0][1:] for s in end.free_symbols}


def split(goal: Goal, integral: Integral, points: list[Expr]) -> list[Goal]:
    """One integral as several, cut at ordered points; on each part every switch takes its one branch."""
    f, x, low, high, outer, _ = parts(goal, integral)
    ends = [low, *points, high]
    total = []
    for a, b in pairwise(ends):
        demand(outer.order(a, b) in ("+", ">=", "0"), lambda: f"the cut {b} is not shown to lie above {a}")
        body = branch(f, x, a, b, outer)
        total.append(Integral(body, (x, a, b)) if body != 0 else 0)
    return [goal.with_left(goal.left.xreplace({integral: Add(*total)}))]


def extend(goal: Goal, integral: Integral, end: Expr) -> list[Goal]:
    """The integral up to ``end``, less what lies beyond its own upper limit; bounded, so that all of them exist."""
    f, x, low, high, outer, _ = parts(goal, integral)
    for a, b in ((low, high), (high, end)):
        demand(outer.sign(b - a) in ("+", ">=", "0"), lambda: f"{b} is not shown to lie above {a}")
    demand(bounded(f, x, outer.inside(x, low, end)), lambda: f"{f} is not shown to be bounded")
    new = Integral(f, (x, low, end)) - Integral(f, (x, high, end))
    return [goal.with_left(goal.left.xreplace({integral: new}))]


def branch(f: Expr, x: Symbol, a: Expr, b: Expr, outer: Piece) -> Expr:
    """f on (a, b) without switches. A switch whose argument vanishes at an end is settled by its slope."""
    inner = outer.inside(x, a, b)
    try:
        return resolved(f, inner)
    except Refused:
        learned = []
        for node in f.atoms(*SWITCHES):
            for g in node.atoms(Expr) & set(_arguments(node)):
                if g.has(x) and inner.sign(g) not in ("+", "-"):
                    smooth(g, x, inner)  # or it may jump, and its slope tells nothing
                    slope = inner.sign(diff(g, x))
                    for end, rises in ((a, "+"), (b, "-")):
                        if slope in ("+", "-") and outer.is_zero(g.subs(x, end)):
                            continuous_at(g, x, end, outer)
                            learned.append((g if slope == rises else -g, True))
                            break
        if not learned:
            raise
        return resolved(f, inner.extended(learned))


def _arguments(node: Expr) -> list[Expr]:
    return [a for a in node.args if isinstance(a, Expr)]


def linear(goal: Goal, integral: Integral, terms: list[Expr]) -> list[Goal]:
    """The integral of a sum as the sum of integrals, factors free of the variable drawn out.

    Where more than one term is not plainly integrable, each of those must be given a value before the goal is closed.
    """
    f, x, low, high, _, inner = parts(goal, integral)
    demand(inner.is_zero(f - Add(*terms)), lambda: f"the terms do not add up to {f}")
    drawn, doubtful = [], 0
    for term in terms:
        outside, inside = term.as_independent(x, as_Add=False)
        drawn.append(outside * Integral(inside, (x, low, high)))
        doubtful += not bounded(inside, x, inner)
    new = goal.with_left(goal.left.xreplace({integral: Add(*drawn)}))
    return [replace(new, doubtful=True)] if doubtful > 1 else [new]


def bounded(e: Expr, x: Symbol, inner: Piece) -> bool:
    """Whether e is bounded between finite limits, or integrable by hypothesis (a free function, times what is)."""
    if any(not end.is_finite for r in inner.ranges if r.symbol == x for end in (r.low, r.high) if end.is_number):
        return False
    for node in preorder_traversal(e):
        if not node.has(x) or isinstance(node, TAME) or hasattr(node, "definition"):
            continue
        if isinstance(node, Pow) and node.exp.is_nonnegative:
            continue
        if isinstance(node, besseli) and node.args[0].is_integer:
            continue
        if isinstance(node, hyper) and len(node.args[0]) == 0:
            if all(b.is_integer and b.is_positive for b in node.args[1]):
                continue
            return False
        if isinstance(node, Pow) and node.exp.is_integer and inner.sign(node.base - 1) in ("+", ">="):
            continue
        return False
    return True


def exchange(
    goal: Goal, integral: Integral, proven: Proven | None = None, mapping: dict[Symbol, Expr] | None = None
) -> list[Goal]:
    """Swap the two integrations of an iterated integral whose integrand has one sign (Tonelli).

    The sign may rest on a lemma: its left side is then read as its right side.
    """
    outside, rest, x, low, high, outer, inner = iterated(goal, integral)
    y, a, b = rest.limits[0]
    demand(not (a.has(x) or b.has(x)), "the limits depend on the other variable")
    ordered = outer.order(low, high), inner.order(a, b)
    demand(set(ordered) <= {"+", ">=", "0"}, "the limits are not shown to be in order")
    deepest = inner.inside(y, a, b)
    integrand = outside * rest.function
    if proven is not None:
        (shown,) = lemma(Goal(integrand, goal.right, deepest), proven, mapping or {})
        integrand = shown.left
    demand(deepest.sign(integrand) in ("+", ">=", "-", "<=", "0"), "the integrand is not shown to keep one sign")
    fixed, moving = outside.as_independent(x, as_Add=False)
    drawn, kept = rest.function.as_independent(x, as_Add=False)
    swapped = fixed * Integral(drawn * Integral(moving * kept, (x, low, high)), (y, a, b))
    return [goal.with_left(goal.left.xreplace({integral: swapped}))]


def substitute(goal: Goal, integral: Integral, new: Symbol, g: Expr, low: Expr, high: Expr) -> list[Goal]:
    """x = g(new) with g strictly monotone between low and high, which it maps to the limits."""
    f, x, a, b, outer, _ = parts(goal, integral)
    used = integral.atoms(Symbol) | outer_names(goal, integral) | goal.right.free_symbols
    demand(new not in used, lambda: f"{new} already stands for something else")
    demand(plain(new), lambda: f"{new} is not a plain real variable")
    demand(not captured([f], g), lambda: f"{g} would be captured by {f}")
    rising = outer.order(low, high) in ("+", ">=", "0")
    inner = outer.inside(new, *((low, high) if rising else (high, low)))
    smooth(g, new, inner)
    for near, far, side in ((low, a, "low" if rising else "high"), (high, b, "high" if rising else "low")):
        if {near, far} & {oo, -oo}:
            demand(outer.order(low, high) in ("+", "-"), "the new limits are not shown to be in order")
            demand(tends_to(g, new, near, side, far, outer), lambda: f"{g} is not shown to tend to {far}")
        else:
            demand(outer.is_zero(g.subs(new, near) - far), "the limits do not match")
    slope = diff(g, new)
    demand(inner.sign(slope) in ("+", "-"), lambda: f"{g} is not shown to be monotone")
    body = f.xreplace({x: g}) * slope
    if not rising:
        low, high, body = high, low, -body
    return [goal.with_left(goal.left.xreplace({integral: Integral(body, (new, low, high))}))]


def antiderivative(goal: Goal, integral: Integral, primitive: Expr, flat: str = "") -> list[Goal]:
    """The integral as the difference of a primitive's end values.

    ``flat`` names an end, low or high, where the primitive is not defined but vanishes faster than any power.
    """
    f, x, low, high, outer, _ = parts(goal, integral)
    demand(flat in ("", "low", "high"), "an end is low or high")
    value = difference(f, primitive, x, low, high, outer, flat)
    return [goal.with_left(goal.left.xreplace({integral: value}))]


def difference(f: Expr, primitive: Expr, x: Symbol, low: Expr, high: Expr, outer: Piece, flat: str = "") -> Expr:
    inner = outer.inside(x, low, high)
    f = resolved(f, inner)
    smooth(primitive, x, inner)
    demand(inner.is_zero(diff(primitive, x) - f), lambda: f"the derivative of {primitive} is not {f}")
    values = {"low": S.Zero, "high": S.Zero}
    sides = {"+": ("low", "high"), "-": ("high", "low")}.get(outer.order(low, high) or "", ("", ""))
    for name, end, side in zip(values, (low, high), sides, strict=True):
        if name == flat:
            vanishes_at(primitive, x, end, inner, outer)
        else:
            values[name] = end_value(primitive, x, end, side, outer)
    return values["high"] - values["low"]


def vanishes_at(primitive: Expr, x: Symbol, end: Expr, inner: Piece, outer: Piece) -> None:
    """Each term is a power of the distance to the end times exp(A), with A going to -oo like a power of it."""
    for term in Add.make_args(primitive.expand()):
        flats = [a for a in Mul.make_args(term) if isinstance(a, exp)]
        others = Mul(*(a for a in Mul.make_args(term) if not isinstance(a, exp)))
        demand(not others.has(exp), lambda: f"{term} is not a power times exponentials")
        _, below = fraction(together(others))
        denominator = Poly(below, x)
        pole = Poly(denominator.LC() * (x - end) ** denominator.degree(), x)
        demand((denominator - pole).is_zero, lambda: f"{others} may have a pole elsewhere than at {end}")
        top, bottom = fraction(together(Add(*(e.args[0] for e in flats))))
        demand(outer.is_zero(bottom.subs(x, end)), lambda: f"the exponent of {term} stays finite at {end}")
        falling = times(outer.sign(top.subs(x, end)), inner.sign(bottom))
        demand(falling == "-", lambda: f"the exponent of {term} is not shown to go to -oo")


def recurrence(
    goal: Goal,
    integral: Integral,
    index: Symbol,
    closed: Expr,
    base: Expr,
    primitive: Expr,
    following: Expr,
    present: Expr,
) -> list[Goal]:
    """Integral = closed for index 0, 1, 2, ... by induction.

    ``base`` is a primitive of the integrand at index 0. ``following`` f(index + 1) + ``present`` f(index) is the
    derivative of ``primitive``, and ``closed`` satisfies the recurrence that this gives.
    """
    f, x, low, high, outer, inner = parts(goal, integral)
    demand(natural(index), lambda: f"{index} does not run over 0, 1, 2, ...")
    demand(not (low.has(index) or high.has(index)), "the limits depend on the index")
    demand(not any(e.has(index) for e, _ in outer.facts), "what is known of the index need not hold for the next one")
    first = difference(f.subs(index, 0), base, x, low, high, outer)
    demand(outer.is_zero(first - closed.subs(index, 0)), lambda: f"the closed form is wrong at {index} = 0")
    demand(outer.sign(following) in ("+", "-"), lambda: f"{following} may vanish")
    smooth(primitive, x, inner)
    continuous_at(primitive, x, low, outer)
    continuous_at(primitive, x, high, outer)
    stepped = following * f.subs(index, index + 1) + present * f
    demand(inner.is_zero(diff(primitive, x) - stepped), "the step is not the derivative of its primitive")
    ends = primitive.subs(x, high) - primitive.subs(x, low)
    gap = following * closed.subs(index, index + 1) + present * closed - ends
    demand(outer.is_zero(gap), "the closed form does not satisfy the recurrence")
    return [goal.with_left(goal.left.xreplace({integral: closed}))]


def telescope(goal: Goal, total: Sum, primitive: Expr) -> list[Goal]:
    """A sum whose terms are differences of neighbours: the sum from a to b of F(j) - F(j - 1) is F(b) - F(a - 1)."""
    demand(occurs(total, goal.left), lambda: f"{total} does not occur")
    demand(len(total.limits) == 1, lambda: f"{total} is not over one index")
    j, low, high = total.limits[0]
    demand(bool((high - low + 1).is_nonnegative), lambda: f"{total} may run backwards")
    gap = total.function - (primitive - primitive.subs(j, j - 1))
    demand(not {low, high} & {oo, -oo}, "a sum without an end has no last term")
    demand(not captured([primitive], low, high), lambda: f"{primitive} would capture an end of the sum")
    for piece in contexts(goal, total):
        demand(not piece.facts_about(j), lambda: f"{j} is used twice")
        here = piece.extended([(j - low, False)])
        demand(here.is_zero(gap), lambda: f"{total.function} is not the difference of {primitive}")
    value = primitive.subs(j, high) - primitive.subs(j, low - 1)
    return [goal.with_left(goal.left.xreplace({total: value}))]


def diverges(goal: Goal, integral: Integral, minorant: Expr, strength: Expr, order: int, end: str) -> list[Goal]:
    """The left side is +oo: a term's integrand lies above ``minorant``, whose own integral is infinite.

    With d the distance to the end in question, the minorant is strength d^(-1 - order), strength > 0: its primitive
    is unbounded. Every other term is an integral of something not negative, or finite.
    """
    f, x, low, high, outer, inner = parts(goal, integral)
    demand(goal.right == oo, "the claim is not that the quantity is infinite")
    demand(end in ("low", "high"), "the end is either low or high")
    demand(order >= 0, "an integrable minorant proves nothing")
    demand(not {low, high} & {oo, -oo}, "an infinite end needs a change of variables first")
    demand(not inner.is_zero(minorant), "a minorant of 0 proves nothing")
    distance = x - low if end == "low" else high - x
    demand(outer.sign(high - low) == "+", "the interval may be empty")
    demand(not strength.has(x) and outer.sign(strength) == "+", lambda: f"{strength} is not shown to be positive")
    primitive = log(distance) if order == 0 else -(distance ** (-order)) / order
    growth = strength * diff(primitive, x) * (1 if end == "low" else -1)
    demand(inner.is_zero(growth - minorant), lambda: f"{minorant} is not {strength} times a power of the distance")
    f = branch(f, x, low, high, outer)
    demand(inner.sign(f - minorant) in ("+", ">=", "0"), lambda: f"{f} is not shown to lie above {minorant}")
    for term in Add.make_args(goal.left):
        factor, rest = term.as_independent(Integral, as_Add=False)
        demand(outer.sign(factor) in ("+", ">=", "0") or not term.has(Integral), lambda: f"{factor} may be negative")
        if rest == integral:
            demand(outer.sign(factor) == "+", lambda: f"{factor} may vanish")
        elif term.has(Integral):
            other = Goal(rest, goal.right, goal.piece)
            g, y, a, b, around, _ = parts(other, rest)
            demand(around.sign(b - a) in ("+", ">=", "0"), lambda: f"the limits of {rest} are not in order")
            demand(
                around.inside(y, a, b).sign(branch(g, y, a, b, around)) in ("+", ">=", "0"),
                lambda: f"{rest} may be negative",
            )
        else:
            continuous_at(term, x, x, goal.piece)
    return []


__all__ = [
    "antiderivative",
    "diverges",
    "exchange",
    "extend",
    "linear",
    "recurrence",
    "split",
    "substitute",
    "telescope",
]
