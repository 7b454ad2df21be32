"""What the tests of moves share: names, goals, and refusals."""

from __future__ import annotations

import pytest
from sympy import (
    Integral,
    Sum,
    Symbol,
    oo,
    pi,
    symbols,
    sympify,
)

from xsec_sym.proof import Refused, Source, interval
from xsec_sym.proof.domain import domain
from xsec_sym.proof.piece import Piece
from xsec_sym.proof.rules import start as opening
from xsec_sym.proof.steps import Step

a, b, t, u, w, x, y, z, phi = symbols("a b t u w x y z varphi", real=True)
j, l, m, n = symbols("j l m n", integer=True, nonnegative=True)
LATE = Symbol("late", integer=True, positive=True)  # counts from 1, whatever a sum over it says
SIGNED = Symbol("signed", positive=True)  # positive, whatever a range says
POSITIVE = interval(a, 0, oo, open=True)
CIRCLE = (0, 2 * pi)


def on(*ranges):
    return Piece.of(domain(ranges))


def claim(label, left, form, *where):
    return Source("sphere").claim(label, "a lemma", left=left, corrected=form, where=where, statement=True)


def step_on(left, right, *ranges, claims=()):
    goal = opening(sympify(left), sympify(right), domain(ranges))
    return Step(goal, {one.id: one for one in claims}, [])


def refused(attack, *args, match=None, **rest):
    with pytest.raises(Refused, match=match):
        attack(*args, **rest)


def over(step, symbol):
    """The integral over a symbol, wherever it stands on the left."""
    return next(i for i in step.left.atoms(Integral) if i.limits[-1][0] == symbol)


def CIRCLE_OF(angle):
    return (angle, *CIRCLE)


def series(f, index=j):
    return Sum(f, (index, 0, oo))
