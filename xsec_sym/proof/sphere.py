"""Moves that rest on a symmetry: of the sphere, of the circle, of the torus, and the series that they give.

Each is a theorem that is used as it stands; what a move checks is that the goal meets its hypotheses.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import product

from sympy import (
    Add,
    Expr,
    Integral,
    Max,
    Mul,
    Pow,
    S,
    Sum,
    Symbol,
    besseli,
    cos,
    diff,
    exp,
    expand,
    factorial,
    hyper,
    legendre,
    oo,
    pi,
    sin,
    sqrt,
)

from xsec_sym.proof.calculus import bounded, difference, iterated, parts
from xsec_sym.proof.names import captured, natural, plain
from xsec_sym.proof.piece import Piece
from xsec_sym.proof.regular import demand, smooth
from xsec_sym.proof.rules import Goal, Proven, contexts, lemma, occurs
from xsec_sym.proof.signs import times

CIRCLE = (S.Zero, 2 * pi)


def turn(goal: Goal, integral: Integral, u: Expr, seen: Symbol | None = None, form: Expr | None = None) -> list[Goal]:
    """The area of the sphere does not care which axis is its pole: x and the cosine towards u change places.

    The integral of F(x, c) over azimuth phi and inclination x, with c = u x + sqrt(1 - u^2) sqrt(1 - x^2) cos(phi),
    is that of F(c, x). F is shown to keep its sign, so that nothing is asked of its size. Where c does not stand in
    the integrand as it is, ``form`` is F(x, c), c being the symbol ``seen``.
    """
    outside, rest, x, low, high, outer, inner = iterated(goal, integral)
    demand((low, high) == (-1, 1), "the inclination does not run from -1 to 1")
    azimuth, *ends = rest.limits[0]
    demand(tuple(ends) == CIRCLE, "the azimuth does not run once around")
    demand(not u.has(x, azimuth), lambda: f"{azimuth} is used twice")
    demand(outer.sign(1 - u**2) in ("+", ">=", "0"), lambda: f"{u} is not shown to be a cosine")
    facing = u * x + sqrt(1 - u**2) * sqrt(1 - x**2) * cos(azimuth)
    whole = outside * rest.function
    demand(not captured([whole], facing), lambda: f"a name of {u} is used twice")
    if form is None or seen is None:
        seen = Symbol("seen#", real=True)
        whole = whole.xreplace({facing: seen})
    else:
        demand(plain(seen) and not captured([form], facing), lambda: f"{seen} is not plain, or {u} captured")
        demand(not goal.left.has(seen) and not goal.right.has(seen), lambda: f"{seen} already stands for something")
        gap = whole - form.xreplace({seen: facing})
        demand(inner.inside(azimuth, *CIRCLE).is_zero(gap), lambda: f"{whole} is not {form} at {facing}")
        whole = form
    demand(not whole.has(azimuth), lambda: f"{integral.function} depends on azimuth otherwise than through {facing}")
    demand(_keeps_sign(whole, inner.inside(seen, -S.One, S.One)), lambda: f"{whole} is not shown to keep its sign")
    turned = whole.xreplace({x: facing, seen: x})
    drawn, kept = turned.as_independent(azimuth, as_Add=False)
    new = Integral(drawn * Integral(kept, (azimuth, *CIRCLE)), (x, -1, 1))
    return [goal.with_left(goal.left.xreplace({integral: new}))]


def _keeps_sign(e: Expr, piece: Piece) -> bool:
    total: str | None = "+"
    for factor in Mul.make_args(e):
        clamped = isinstance(factor, Max) and S.Zero in factor.args
        total = times(total, ">=" if clamped else piece.sign(factor))
    return total is not None


def funk_hecke(goal: Goal, integral: Integral, u: Expr, index: Symbol) -> list[Goal]:
    """A function of the inclination, averaged with the clamped cosine towards u, as a Legendre series.

    For bounded D, the integral of D(x) max(0, c) over azimuth and inclination, c being the cosine towards u, is the sum
    of pi (2 l + 1) P_l(u) times the moments of D and of the clamped cosine with P_l; it converges absolutely.
    """
    outside, rest, x, low, high, outer, inner = iterated(goal, integral)
    azimuth, *ends = rest.limits[0]
    demand((low, high) == (-1, 1) and tuple(ends) == CIRCLE, "the integral is not over the sphere")
    demand(not u.has(x, azimuth) and not goal.left.has(index), lambda: f"{azimuth} or {index} is used twice")
    demand(natural(index), lambda: f"{index} does not run over 0, 1, 2, ...")
    demand(outer.sign(1 - u**2) in ("+", ">=", "0"), lambda: f"{u} is not shown to be a cosine")
    seen = Symbol("seen#", real=True)
    kernel = rest.function.xreplace({u * x + sqrt(1 - u**2) * sqrt(1 - x**2) * cos(azimuth): seen})
    facing = kernel.free_symbols <= {seen} and not kernel.has(cos)
    demand(facing, lambda: f"{rest.function} depends on more than the cosine towards {u}")
    clamped = isinstance(kernel, Max) and set(kernel.args) == {S.Zero, seen}
    demand(clamped, lambda: f"{rest.function} is not the clamped cosine")
    demand(bounded(outside, x, inner), lambda: f"{outside} is not shown to be bounded")
    wave = legendre(index, x, evaluate=False)
    moments = [Integral(f * wave, (x, -1, 1)) for f in (outside, Max(0, x))]
    term = pi * (2 * index + 1) * Mul(*moments) * legendre(index, u, evaluate=False)
    found = Sum(term, (index, 0, oo))
    return [replace(goal.with_left(goal.left.xreplace({integral: found})), absolute=goal.absolute | {found})]


def parities(goal: Goal, total: Sum) -> list[Goal]:
    """An infinite sum of terms that have one sign or fall off absolutely, as its even and its odd terms.

    Where the whole converges and one half of it ends after its first term, so does the other half.
    """
    demand(occurs(total, goal.left) and len(total.limits) == 1, lambda: f"{total} does not occur")
    j, low, high = total.limits[0]
    demand(low == 0 and high == oo, "the sum does not run from 0 without end")
    demand(natural(j), lambda: f"{j} does not run over 0, 1, 2, ...")
    even, odd = (Sum(total.function.subs(j, 2 * j + i), (j, 0, oo)) for i in (0, 1))
    for piece in contexts(goal, total):
        demand(not piece.facts_about(j), lambda: f"{j} is used twice")
        ends = any(piece.is_zero(half.function.subs(j, j + 1)) for half in (even, odd))
        shown = total in goal.absolute or ends or piece.sign(total.function) is not None
        demand(shown, lambda: f"{total} is not shown to converge absolutely")
    return [goal.with_left(goal.left.xreplace({total: even + odd}))]


def bessel(goal: Goal, integral: Integral, order: Expr, argument: Expr, factor: Expr) -> list[Goal]:
    """The integral of exp(z cos t) cos(n t) once around is 2 pi I_n(z), half around pi I_n(z)."""
    f, t, low, high, _, inner = parts(goal, integral)
    demand((low, high) in (CIRCLE, (0, pi)), "the angle runs neither once nor half around")
    demand(bool(order.is_integer), lambda: f"the order {order} is not known to be an integer")
    demand(not (order.has(t) or argument.has(t) or factor.has(t)), lambda: f"{t} is the variable of integration")
    wave = factor * exp(argument * cos(t)) * cos(order * t)
    demand(inner.is_zero(f - wave), lambda: f"{f} is not {wave}")
    return [goal.with_left(goal.left.xreplace({integral: high * factor * besseli(order, argument)}))]


def wave(goal: Goal, old: Expr, t: Symbol) -> list[Goal]:
    """I_n(z) as its integral over a full circle."""
    demand(isinstance(old, besseli) and occurs(old, goal.left), lambda: f"{old} is not a Bessel function of the goal")
    order, argument = old.args
    demand(bool(order.is_integer), lambda: f"the order {order} is not known to be an integer")
    demand(plain(t), lambda: f"{t} is not a plain real variable")
    demand(not goal.left.has(t) and not goal.right.has(t), lambda: f"{t} already stands for something else")
    contexts(goal, old)
    new = Integral(exp(argument * cos(t)) * cos(order * t), (t, *CIRCLE)) / (2 * pi)
    return [goal.with_left(goal.left.xreplace({old: new}))]


def shear(goal: Goal, integral: Integral, a: Symbol, b: Symbol, new: Expr) -> list[Goal]:
    """On a torus (x, t) -> (x + t, x - t) keeps the mean, for it is a homomorphism onto; so does (x, t) -> (t, x).

    ``new`` is G(a, b), of period 2 pi in both; half of f(x, t) + f(t, x) must be G(x + t, x - t).
    """
    outside, rest, x, low, high, outer, _ = iterated(goal, integral)
    t, *ends = rest.limits[0]
    demand((low, high) == CIRCLE and tuple(ends) == CIRCLE, "the integral is not over a torus")
    demand(not goal.left.has(a, b) and not goal.right.has(a, b), lambda: f"{a} or {b} already stands for something")
    demand(plain(a, b) and a != b, lambda: f"{a} and {b} are not plain real variables")
    demand(not new.has(x, t), lambda: f"{new} depends on the old angles")
    whole = outside * rest.function
    for angle in (a, b):
        demand(_wavy(new, angle), lambda: f"{new} is not shown to have the period 2 pi in {angle}")
    for angle in (x, t):
        demand(_wavy(whole, angle), lambda: f"{whole} is not shown to be continuous on the torus")
    swapped = whole.xreplace({x: t, t: x})
    sheared = new.xreplace({a: x + t, b: x - t})
    inner = outer.inside(x, *CIRCLE).inside(t, *CIRCLE)
    gap = (_linear(whole) + _linear(swapped)) / 2 - _linear(sheared)
    demand(inner.is_zero(gap), lambda: f"{whole} is not the sheared form of {new}")
    return [goal.with_left(goal.left.xreplace({integral: Integral(Integral(new, (a, *CIRCLE)), (b, *CIRCLE))}))]


def _wavy(e: Expr, angle: Symbol) -> bool:
    """Whether the angle occurs only in cosines of integer multiples of it, and those in exponentials and products."""
    if not e.has(angle):
        return True
    if isinstance(e, cos):
        turns = diff(e.args[0], angle)
        return bool(turns.is_integer) and not (e.args[0] - turns * angle).expand().has(angle)
    if isinstance(e, Pow):
        return bool(e.exp.is_Integer and e.exp > 0) and _wavy(e.base, angle)
    return isinstance(e, Add | Mul | exp) and all(_wavy(part, angle) for part in e.args)


def _linear(e: Expr) -> Expr:
    """Products of cosines as sums: 2 cos a cos b = cos(a + b) + cos(a - b)."""
    if isinstance(e, cos):
        return cos(e.args[0].expand())
    if isinstance(e, exp):
        return exp(_linear(e.args[0]))
    if isinstance(e, Add):
        return Add(*(_linear(part) for part in e.args))
    if not (e.has(cos) and isinstance(e, Mul | Pow)):
        return e
    spread = expand(e, power_exp=False)
    if isinstance(spread, Add):
        return _linear(spread)
    waves: list[Expr] = []
    others: Expr = S.One
    for part in Mul.make_args(spread):
        base, count = part.as_base_exp()
        if isinstance(base, cos) and count.is_Integer and count > 0:
            waves += [base.args[0]] * int(count)
        else:
            others *= part if part == spread else _linear(part)
    sums = {S.Zero: S.One}
    for angle in waves:
        found: dict[Expr, Expr] = {}
        for (known, weight), side in product(sums.items(), (1, -1)):
            key = (known + side * angle).expand()
            found[key] = found.get(key, S.Zero) + weight / 2
        sums = found
    return others * Add(*(weight * cos(angle) for angle, weight in sums.items()))


def beats(goal: Goal, integral: Integral) -> list[Goal]:
    """Products of cosines in an integrand as sums: 2 cos a cos b = cos(a + b) + cos(a - b)."""
    f, *_ = parts(goal, integral)
    demand(not f.has(Integral, Sum), "an integral or a sum inside would be taken apart")
    return [goal.with_left(goal.left.xreplace({integral: Integral(_linear(f).expand(), *integral.limits)}))]


def harmonics(goal: Goal, integral: Integral, index: Symbol, proven: Proven, mapping: dict[Symbol, Expr]) -> list[Goal]:
    """The integral of an even wave from 0 to psi, by its Fourier series, which may be integrated term by term.

    The integrand h is smooth for every real x, h(-x) = h(x) and h(pi - x) = -h(x), so it consists of the cosines of
    odd multiples of x. The lemma gives the integral of h(x) cos((2 j + 1) x) once around, j being ``index``.
    """
    f, x, low, psi, outer, _ = parts(goal, integral)
    demand(low == 0 and psi.is_finite is not False, "the integral does not start from 0")
    demand(natural(index), lambda: f"{index} does not run over 0, 1, 2, ...")
    demand(not goal.left.has(index), lambda: f"{index} already stands for something else")
    anywhere = Piece([fact for fact in outer.facts if not fact[0].has(x)], outer.ranges, outer.local)
    smooth(f, x, anywhere)
    demand(anywhere.is_zero(f - f.subs(x, -x)), lambda: f"{f} is not shown to be even")
    demand(anywhere.is_zero(f + f.subs(x, pi - x)), lambda: f"{f} is not shown to change its sign from x to pi - x")
    coefficient = proven.left.subs(mapping, simultaneous=True)
    demand(isinstance(coefficient, Integral) and len(coefficient.limits) == 1, "the lemma is not about an integral")
    y, *ends = coefficient.limits[0]
    demand(tuple(ends) == CIRCLE, "the lemma's integral does not run once around")
    demand(y == x or not f.has(y), lambda: f"{y} is used twice")
    wanted = f.xreplace({x: y}) * cos((2 * index + 1) * y)
    demand(outer.inside(y, *CIRCLE).is_zero(coefficient.function - wanted), "the lemma gives no coefficient of these")
    (shown,) = lemma(Goal(coefficient, S.Zero, outer), proven, mapping)
    series = Sum(shown.left / pi * sin((2 * index + 1) * psi) / (2 * index + 1), (index, 0, oo))
    return [goal.with_left(goal.left.xreplace({integral: series}))]


def taylor(
    goal: Goal,
    integral: Integral,
    weight: Expr,
    inner_map: Expr,
    z: Symbol,
    index: Symbol,
    family: Expr,
    moment: Expr,
) -> list[Goal]:
    """The integral of w(y) f(v(y)) as a sum over the Taylor series of an entire f, which converges uniformly there.

    ``family`` is the derivative of order k, as an expression in ``index`` k and z: at k = 0 it is f, and its own
    derivative is its next member. ``moment`` is a primitive of w(y) v(y)^k.
    """
    f, y, low, high, outer, inner = parts(goal, integral)
    demand(natural(index) and plain(z), lambda: f"{index} does not run over 0, 1, 2, ..., or {z} is not plain")
    demand(not outer.facts_about(index), lambda: f"something is known of {index}")
    demand(not goal.left.has(z, index) and not goal.right.has(z), lambda: f"{z} or {index} is taken")
    demand(bool(weight.is_polynomial(y) and inner_map.is_polynomial(y)), "the weight and the map are not polynomials")
    demand(not {low, high} & {oo, -oo}, "the range is not bounded")
    function = family.subs(index, 0)
    demand(_entire(function, z), lambda: f"{function} is not shown to be entire in {z}")
    demand(inner.is_zero(f - weight * function.subs(z, inner_map)), lambda: f"{f} is not {weight} times {function}")
    between = outer.inside(z, S.Zero, S.One)
    step = diff(family, z) - family.subs(index, index + 1)
    demand(between.is_zero(step), lambda: f"{family} does not go on to its derivative")
    demand(_entire(family, z), lambda: f"{family} is not shown to be entire in {z}")
    value = difference(weight * inner_map**index, moment, y, low, high, outer)
    series = Sum(family.subs(z, 0) / factorial(index) * value, (index, 0, oo))
    return [goal.with_left(goal.left.xreplace({integral: series}))]


def _entire(e: Expr, z: Symbol) -> bool:
    """Sums and products of polynomials, exponentials and confluent functions 0F1 of polynomials."""
    if e.is_polynomial(z):
        return True
    if isinstance(e, hyper):
        above, below, argument = e.args
        natural = len(below) == 1 and bool(below[0].is_integer and below[0].is_positive)
        return len(above) == 0 and natural and not below[0].has(z) and bool(argument.is_polynomial(z))
    return isinstance(e, Add | Mul | exp) and all(_entire(part, z) for part in e.args)


def peel(goal: Goal, total: Sum, count: Expr = S.One) -> list[Goal]:
    """An infinite sum as its first terms, ``count`` of them, and the sum of the others, counted from 0 again."""
    demand(occurs(total, goal.left) and len(total.limits) == 1, lambda: f"{total} does not occur")
    j, low, high = total.limits[0]
    demand(low == 0 and high == oo, "the sum does not run from 0 without end")
    counts = bool(count.is_integer and count.is_nonnegative) and not count.has(j)
    demand(counts, lambda: f"{count} is not a number of terms")
    demand(natural(j) and not captured([total.function], count), lambda: f"{count} would be captured by {total}")
    rest = Sum(total.function.subs(j, j + count), (j, 0, oo))
    first = total.function.subs(j, 0) if count == 1 else Sum(total.function, (j, 0, count - 1))
    return [goal.with_left(goal.left.xreplace({total: first + rest}))]


__all__ = ["beats", "bessel", "funk_hecke", "harmonics", "parities", "peel", "shear", "taylor", "turn", "wave"]
