"""Rigorous, narrow enclosures of constant expressions.

The truth lies in every ball returned, and no ball is wide: what cannot be enclosed narrowly is refused.
"""

from __future__ import annotations

import time
from contextlib import suppress
from math import ceil, inf, log2
from typing import Any

from flint import acb, arb
from sympy import Float

from xsec_sym.proof import ball_integrals
from xsec_sym.proof.ball_compile import Closure, NoEnclosure, compile_ball, precision, rational_near
from xsec_sym.proof.branches import settle, unfold
from xsec_sym.proof.say import said
from xsec_sym.proof.zeros import Undecided

__all__ = ["NoEnclosure", "NotReal", "compile_ball", "enclose", "precision", "rational_near"]

_MOST_BITS = 20_000


class NotReal(NoEnclosure):
    """The value is a complex number: its enclosure, which excludes every real one, comes with the refusal."""

    def __init__(self, name: str, value: acb) -> None:
        super().__init__(f"{name} is not real")
        self.value = value


def enclose(expr: Any, digits: int = 30, seconds: float | None = None) -> arb:
    """A ball that holds the value of a real constant, with relative radius 10^-digits (absolute about zero).

    >>> from sympy import Integral, pi, sqrt, symbols
    >>> x = symbols("x")
    >>> enclose(Integral(1 / sqrt(1 - x**2), (x, -1, 1)) - pi).contains(0)
    True
    >>> enclose(Integral(1 / x, (x, -1, 1)))
    Traceback (most recent call last):
    ...
    xsec_sym.proof.ball_compile.NoEnclosure: Integral(1/x, (x, -1, 1)) diverges, or has a singularity not removed here
    """
    ball_integrals.clock.until = inf if seconds is None else time.process_time() + seconds
    try:
        expr = unfold(expr)
        if expr.atoms(Float):
            raise NoEnclosure(f"the floating-point number {min(expr.atoms(Float))} is not exact")
        # where a tie cannot be settled exactly, the balls join the branches, which is narrow if they agree
        with suppress(Undecided):
            expr = settle(expr)
        return _narrow(compile_ball(expr, ()), digits, said(expr))
    finally:
        ball_integrals.clock.until = inf


def _narrow(run: Closure, digits: int, name: str) -> arb:
    goal = ceil(digits * log2(10))
    bits, tries, out = goal + 24, 0, acb(0)
    while tries < 8 and bits < _MOST_BITS:
        if time.process_time() > ball_integrals.clock.until:
            raise NoEnclosure(f"the time for {name} ran out")
        with precision(bits):
            out = run((), False)
            if out.is_finite():
                if not out.imag.contains(0):
                    raise NotReal(name, out)
                size = arb(1) if out.real.contains(0) else arb(out.real.abs_lower())
                allowed = size * arb(10) ** -digits
                if out.real.rad() <= allowed and out.imag.abs_upper() <= allowed:
                    return out.real
                missing = (arb(max(out.real.rad(), out.imag.abs_upper())) / allowed).log() / arb(2).log()
                bits += max(16, min(int(float(missing.mid())) + 16, 2 * bits))
            else:
                bits *= 2
        tries += 1
    if not out.is_finite():
        raise NoEnclosure(f"{name} has no finite enclosure")
    raise NoEnclosure(f"the enclosure of {name} stays wider than {digits} digits")
