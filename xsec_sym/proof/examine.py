"""A user's own equation: the proofs that need no ideas are tried, then the witnesses decide."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from sympy import Expr, Integer, Integral, Rational, S, Symbol, oo, sympify

from xsec_sym.proof.claim import Claim
from xsec_sym.proof.domain import Interval
from xsec_sym.proof.regular import Refused
from xsec_sym.proof.steps import Step, derive
from xsec_sym.proof.verdict import Verdict
from xsec_sym.proof.verify import verify

Script = Callable[[Step], None]


def examine(claim: Claim, *, digits: int = 30, seed: int = 0) -> Verdict:
    """proved, confirmed, refuted (with a witness), inconclusive or timeout.

    >>> from sympy import Symbol, cos, sin
    >>> from xsec_sym.proof import Source, interval
    >>> a = Symbol("a", real=True)
    >>> same = Source("of-a-user").claim("1", "", left=sin(a) ** 2 + cos(a) ** 2, printed=1, where=[interval(a, 0, 1)])
    >>> examine(same).verdict
    'proved'
    """
    claim.prove = None
    for script in _scripts(claim):
        claim.prove = script
        try:
            derive(claim, {})
        except Refused:
            claim.prove = None
            continue
        break
    return verify(claim, {claim.id: claim}, digits=digits, seed=seed)


def _scripts(claim: Claim) -> Iterator[Script]:
    yield lambda step: None
    reals = [v for v in claim.domain.variables if isinstance(v, Interval)]
    if len(reals) <= 3:
        yield lambda step: _each_sign(step, [v.symbol for v in reals])
    yield from _primitives(claim)
    for variable in reals:
        for at in _inside(variable):
            yield _one_value(variable.symbol, at)


def _each_sign(step: Step, symbols: list[Symbol]) -> None:
    if not symbols:
        if step.is_empty:
            step.vacuous()
        return
    for branch in step.cases(symbols[0]):
        _each_sign(branch, symbols[1:])


def _primitives(claim: Claim) -> Iterator[Script]:
    """Of an integral up to a variable, or from one, the other side may be an antiderivative."""
    for side, other, swapped in ((claim.left, claim.form, False), (claim.form, claim.left, True)):
        if not isinstance(side, Integral) or len(side.limits) != 1 or len(side.limits[0]) != 3 or other.has(Integral):
            continue
        t, *ends = side.limits[0]
        for sign, end in zip((-1, 1), ends, strict=True):
            if isinstance(end, Symbol) and not other.has(t):
                yield _primitive(sign * other.xreplace({end: t}), swapped)


def _primitive(primitive: Expr, swapped: bool) -> Script:
    def script(step: Step) -> None:
        if swapped:
            step.swap()
        step.antiderivative(primitive)

    return script


def _one_value(symbol: Symbol, at: Rational) -> Script:
    """Both sides have the same derivative on one interval, and the same value somewhere in it."""

    def script(step: Step) -> None:
        step.ode(symbol, [0, 1], at)

    return script


def _inside(variable: Interval) -> list[Rational]:
    """Points at which closed forms tend to be simple, inside the range."""
    low, high = sympify(variable.low), sympify(variable.high)
    found = [Integer(0), Integer(1), Integer(-1), Rational(1, 2)]
    if low.is_Rational and high.is_Rational:
        found.append((low + high) / 2)
    ends = (low if low.is_number else -oo, high if high.is_number else oo)
    return [p for p in dict.fromkeys(found) if (ends[0] < p) is S.true and (p < ends[1]) is S.true]
