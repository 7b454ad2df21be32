"""Decimal values of constant expressions by mpmath alone: the route that shares no arithmetic with the enclosures.

Every value is computed at two working precisions and with two sets of nodes.  The outermost terms of an
integral must be negligible, which those of a divergent one never are.
"""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import mpmath
from mpmath import mp, mpf

from xsec_sym.proof.branches import settle, unfold
from xsec_sym.proof.digits_compile import Run, compile_mp
from xsec_sym.proof.digits_integrals import Points, Rule, setting
from xsec_sym.proof.quadrature import NoValue
from xsec_sym.proof.say import said
from xsec_sym.proof.zeros import Undecided

__all__ = ["NoValue", "value"]


def _evaluate(run: Run, places: int, name: str) -> mpf:
    with mp.workdps(places):
        try:
            out = run([])
        except (ZeroDivisionError, OverflowError, ValueError, mpmath.libmp.NoConvergence) as error:
            raise NoValue(f"{name} cannot be evaluated: {error}") from error
        if mp.im(out) and abs(mp.im(out)) > abs(out) * mpf(10) ** (-places // 2):
            raise NoValue(f"{name} is not real")
        if not mp.isfinite(out):
            raise NoValue(f"{name} is not finite")
        return mpf(mp.re(out))


def value(expr: Any, digits: int = 30, points: Points | None = None) -> mpf:
    """The value of a real constant, to ``digits`` relative (absolute about zero), on two agreeing evaluations.

    ``points`` names further points where the integral over a variable is to be split.

    >>> from sympy import Integral, log, symbols
    >>> x = symbols("x")
    >>> mpmath.nstr(value(Integral(log(x), (x, 0, 1)), 20), 20)
    '-1.0'
    """
    expr = unfold(expr)
    with suppress(Undecided):
        expr = settle(expr)
    tol, outs, failure = mpf(10) ** -digits, [], None
    with setting(Rule(digits), points):
        run = compile_mp(expr, {})
    for step, places in enumerate((digits + 15, digits + 25, 2 * digits + 35, 2 * digits + 50)):
        try:
            with setting(Rule(digits + step, step % 2), points):
                outs.append(_evaluate(run, places, said(expr)))
        except NoValue as error:
            failure = error
            continue
        with mp.workdps(places):
            if len(outs) > 1 and abs(outs[-1] - outs[-2]) <= tol * abs(outs[-1]):
                return outs[-1]
    if len(outs) > 1 and max(map(abs, outs[-2:])) < tol:
        return outs[-1]
    raise failure or NoValue(f"two evaluations of {said(expr)} disagree")
