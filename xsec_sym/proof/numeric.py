"""The numeric half of a verdict: does an equation hold at exact points, by balls, and by digits on another route?"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from sympy import Add, Expr, Integral, oo, preorder_traversal, sympify

from xsec_sym.proof.balls import NoEnclosure, enclose
from xsec_sym.proof.claim import Claim
from xsec_sym.proof.digits import NoValue, value
from xsec_sym.proof.domain import Domain
from xsec_sym.proof.witnesses import Point
from xsec_sym.proof.zeros import Undecided

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
    for lemma in lemmas:
        head, names = lemma.left.func, lemma.left.args
        for node in [n for n in preorder_traversal(e) if isinstance(n, head)]:
            form = lemma.form.subs(dict(zip(names, node.args, strict=True)), simultaneous=True)
            rewritten = e.xreplace({node: form})
            if rewritten.free_symbols <= e.free_symbols:  # else SymPy has folded branches out of a nested integral
                e = distributed(rewritten)
    return distributed(e)


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
    return [{**p, **{f: domain.instances[f][i % len(domain.instances[f])] for f in names}} for i, p in enumerate(points)]


def try_at(left: Expr, points: list[Point], digits: int) -> tuple[list[Trial], list[str]]:
    trials, unreached = [], []
    for point in points:
        here = at(left, point)
        try:
            trials.append(Trial(point, enclose(here, digits + 3), here))
        except UNDEFINED as reason:
            unreached.append(str(reason))
    return trials, unreached


def hold_against(trials: list[Trial], form: Expr, digits: int) -> Outcome:
    """Compare a right side with the left side's balls: held, refuted (a ball excludes 0), or out of reach."""
    outcome = Outcome(trials)
    for trial in trials:
        try:
            right = enclose(at(form, trial.point), digits + 3)
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
            if not (trial.left - enclose(at(mutant, trial.point), 12)).contains(0):
                return True
        except UNDEFINED:
            defined = False
    return False if defined else None


def told_apart(mutant: Expr, form: Expr, points: list[Point]) -> Point | None:
    """A further point where a mutant differs from the form; None where it seems to be the form written anew."""
    for point in points:
        try:
            if not (enclose(at(mutant, point), 12) - enclose(at(form, point), 12)).contains(0):
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
        cuts: Mapping[Any, Any] = {x: [at(sympify(c), point) for c in where] for x, where in claim.points.items()}
        try:
            left = value(at(claim.left, point), digits, points=cuts)
            right = value(at(form, point), digits, points=cuts)
        except (NoValue, Undecided):
            continue
        scale = max(abs(left), abs(right))
        if abs(left - right) > 10 ** (1 - digits) * (scale if scale > 10 ** (-digits) else 1):
            return agreed, f"mpmath finds {left} against {right} at {shown(point)}"
        agreed += 1
    return agreed, ""


def shown(point: Point) -> dict[str, str]:
    return {str(k): str(v) if isinstance(v, Expr) else _name(v) for k, v in point.items()}


def _name(instance: Any) -> str:
    from sympy import Symbol

    return str(instance(Symbol("x")))


def is_infinite(form: Expr) -> bool:
    return form in (oo, -oo)
