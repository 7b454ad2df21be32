"""The numeric half of a verdict: does an equation hold at exact points, by balls, and by digits on another route?"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

from mpmath import workdps
from sympy import Abs, Add, Expr, Integral, Sum, Symbol, Wild, cos, lambdify, oo, preorder_traversal, symbols, sympify

from xsec_sym.proof.balls import NoEnclosure, NotReal, enclose
from xsec_sym.proof.claim import Claim
from xsec_sym.proof.digits import NoValue, value
from xsec_sym.proof.domain import Domain
from xsec_sym.proof.magnitude import Magnitude
from xsec_sym.proof.rules import unfolded
from xsec_sym.proof.witnesses import Point
from xsec_sym.proof.zeros import Undecided

PATIENCE = 2.0  # seconds for one enclosure: a witness that wants more is not effective
ARGUMENTS = 12  # of a free function, at most
UNDEFINED = (NoEnclosure, Undecided, ZeroDivisionError, ValueError, TypeError)


@dataclass
class Trial:
    """One witness: the left side's ball there, kept so that every rival right side can be held against it."""

    point: Point
    left: Any
    exact_left: Expr


@dataclass
class Outcome:
    trials: list[Trial] = field(default_factory=list)
    held: int = 0
    refuted_at: Trial | None = None
    refuting: Any = None
    unreached: list[str] = field(default_factory=list)


def reduced(e: Expr, lemmas: Iterable[Claim]) -> Expr:
    """Defined objects written by the equations that were proved for them, so that one integration is left."""
    lemmas = list(lemmas)
    heads = tuple(lemma.left.func for lemma in lemmas)
    for node in [n for n in preorder_traversal(e) if hasattr(n, "definition") and not isinstance(n, heads)]:
        if node.definition().has(*heads):
            e = e.xreplace({node: node.definition()})
    for lemma in lemmas:
        head, names = lemma.left.func, lemma.left.args
        if head is Integral:
            e = unfolded(e)
            e = e.xreplace({i: value for i in e.atoms(Integral) if (value := _inner_value(i, lemma)) is not None})
            continue
        for node in [n for n in preorder_traversal(e) if isinstance(n, head)]:
            form = lemma.form.subs(dict(zip(names, node.args, strict=True)), simultaneous=True)
            rewritten = e.xreplace({node: form})
            if rewritten.free_symbols <= e.free_symbols:  # else SymPy has folded branches out of a nested integral
                e = distributed(rewritten)
    return distributed(e)


def _inner_value(integral: Integral, lemma: Claim) -> Expr | None:
    """The inner integral of a nested one, where it has the form of the lemma's left side, by the lemma."""
    (y, *ends), *outer = integral.limits
    model, (z, *expected) = lemma.left.function, lemma.left.limits[0]
    if not outer or ends != expected:
        return None
    outside, inside = integral.function.as_independent(y, as_Add=False)
    unknown = {s: Wild(s.name, exclude=[y]) for s in model.free_symbols - {z}}
    waves = [wave.subs(z, y) for wave in model.atoms(cos)]
    found = (1 / inside).expand().collect(waves).match((1 / model).subs({z: y, **unknown}))
    if found is None:
        return None
    form = lemma.form.subs({s: found[w] for s, w in unknown.items()}, simultaneous=True)
    return Integral(outside * form, *outer)


def distributed(e: Expr) -> Expr:
    """Integrals of sums as sums of integrals: each is enclosed faster on its own."""
    for node in [n for n in preorder_traversal(e) if isinstance(n, Integral) and len(n.limits) == 1]:
        body = node.function.expand(deep=False) if node.function.is_Mul else node.function
        if body.is_Add and not body.has(Integral):
            e = e.xreplace({node: Add(*(Integral(term, *node.limits) for term in body.args))})
    return e


def at(e: Expr, point: Point) -> Expr:
    """The expression at an exact point; a free function is replaced by an instance of it."""
    functions = {k: v for k, v in point.items() if not isinstance(v, Expr)}
    for name, instance in functions.items():
        e = e.replace(name, instance)
    return sympify(e).subs({k: v for k, v in point.items() if isinstance(v, Expr)})


def with_instances(points: list[Point], domain: Domain) -> list[Point]:
    """Give each point an instance of every free function, in turn."""
    names = list(domain.instances)
    return [
        {**p, **{f: domain.instances[f][i % len(domain.instances[f])] for f in names}} for i, p in enumerate(points)
    ]


def try_at(left: Expr, points: list[Point], digits: int) -> tuple[list[Trial], list[str]]:
    trials, unreached = [], []
    for point in points:
        here = at(left, point)
        try:
            trials.append(Trial(point, enclose(here, digits + 3, PATIENCE), here))
        except UNDEFINED as reason:
            unreached.append(str(reason))
    return trials, unreached


def hold_against(trials: list[Trial], form: Expr, digits: int) -> Outcome:
    """Compare a right side with the left side's balls: held, refuted (a ball excludes 0), or out of reach."""
    outcome = Outcome(trials)
    for trial in trials:
        try:
            right = enclose(at(form, trial.point), digits + 3, PATIENCE)
        except NotReal as found:
            outcome.refuted_at, outcome.refuting = trial, found.value
            return outcome
        except UNDEFINED as reason:
            outcome.unreached.append(str(reason))
            continue
        gap = trial.left - right
        if not gap.contains(0):
            outcome.refuted_at, outcome.refuting = trial, right
            return outcome
        scale = max(abs(trial.left.mid()), abs(right.mid()))
        width = gap.rad() if scale < 10 ** (-digits) else gap.rad() / scale
        if width < _power(digits):
            outcome.held += 1
    return outcome


def _power(digits: int) -> Any:
    from flint import arb

    return arb(10) ** (-digits)


def rejects(trials: list[Trial], mutant: Expr) -> bool | None:
    """Whether the same check turns a mutant down: somewhere the ball of the difference excludes 0.

    None where it is out of reach at some witness and wrong at none: not accepted, but not refuted either.
    """
    defined = True
    for trial in trials:
        try:
            if not (trial.left - enclose(at(mutant, trial.point), 12, PATIENCE)).contains(0):
                return True
        except UNDEFINED:
            defined = False
    return False if defined else None


def told_apart(mutant: Expr, form: Expr, points: list[Point]) -> Point | None:
    """A further point where a mutant differs from the form; None where it seems to be the form written anew."""
    for point in points:
        try:
            if not (enclose(at(mutant, point), 12, PATIENCE) - enclose(at(form, point), 12, PATIENCE)).contains(0):
                return point
        except UNDEFINED:
            continue
    return None


def agree_by_digits(claim: Claim, form: Expr, points: list[Point], digits: int) -> tuple[int, str]:
    """mpmath on the unreduced left side, straight from the definitions.

    Returns at how many points both sides have the same digits, and the first disagreement as a sentence.
    """
    agreed = 0
    for point in points:
        try:
            left = digits_of(claim, claim.left, point, digits)
            right = digits_of(claim, form, point, digits)
        except (NoValue, Undecided):
            continue
        scale = max(abs(left), abs(right))
        if abs(left - right) > 10 ** (1 - digits) * (scale if scale > 10 ** (-digits) else 1):
            return agreed, f"mpmath finds {left} against {right} at {shown(point)}"
        agreed += 1
    return agreed, ""


@lru_cache(maxsize=4000)
def _integral_value(integral: Expr, digits: int, cuts: tuple[Any, ...]) -> Any:
    return value(integral, digits, points={x: list(where) for x, where in cuts})


def digits_of(claim: Claim, e: Expr, point: Point, digits: int) -> Any:
    """mpmath's value of an expression at a point; an integral that returns in a mutant is not done again."""
    cuts = tuple((x, tuple(at(sympify(c), point) for c in where)) for x, where in claim.points.items())
    here = unfolded(at(e, point))
    found: dict[Expr, Symbol] = {}
    walk = preorder_traversal(here)
    for node in walk:
        if isinstance(node, Integral) or (isinstance(node, Sum) and node.has(Integral)):
            walk.skip()
            found.setdefault(node, Symbol(f"I{len(found)}"))
    if not found:
        return value(here, digits)
    values = [_integral_value(node, digits + 2, cuts) for node in found]
    with workdps(digits + 10):
        return lambdify(list(found.values()), here.xreplace(found).replace(Magnitude, Abs), "mpmath")(*values)


def rejected_by_digits(claim: Claim, rivals: list[Expr], point: Point, wanted: int) -> int:
    """The second route's turn where nested integrals leave no ball: how many rivals have other digits than the left."""
    try:
        left = digits_of(claim, claim.left, point, 8)
    except (NoValue, *UNDEFINED):
        return 0
    found = 0
    for rival in rivals:
        try:
            right = digits_of(claim, rival, point, 8)
        except (NoValue, *UNDEFINED):
            continue
        found += bool(abs(left - right) > 1e-6 * max(abs(left), abs(right), 1e-6))
        if found == wanted:
            break
    return found


def shown(point: Point) -> dict[str, str]:
    """A point in words: the values of its variables, and the terms of its instances."""
    return {str(k): str(v) if isinstance(v, Expr) else _name(v) for k, v in point.items()}


def _name(instance: Any) -> str:
    """An instance of a free function, at as many variables as it looks at."""
    for count in range(1, ARGUMENTS + 1):
        names = [Symbol("x")] if count == 1 else symbols(f"x_1:{count + 1}")
        try:
            return str(instance(*names))
        except (TypeError, IndexError):  # too few, for a plain function or for one of any number of arguments
            continue
    return str(instance)


def is_infinite(form: Expr) -> bool:
    return form in (oo, -oo)
