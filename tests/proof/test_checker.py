"""Certificates: the checker replays one against its own claim, and against no other."""

from __future__ import annotations

import copy
from pathlib import Path

import pytest
from sympy import (
    Integral,
    Symbol,
    symbols,
)

from xsec_sym.proof import Refused, Source, interval, parity
from xsec_sym.proof.checker import opening, replay
from xsec_sym.proof.steps import derive

a, u, x, t, phi = symbols("a u x t varphi", real=True)
n = Symbol("n_p", integer=True, nonnegative=True)


def equation(left, right, *where, **rest):
    return Source("certificate").claim("1", "a test", left=left, printed=right, where=where, **rest)


def half_square():
    claim = equation(Integral(x * u, (x, 0, 1)), u / 2, interval(u, -1, 1))
    claim.proof(lambda step: step.antiderivative(u * x**2 / 2))
    return claim


def test_a_certificate_replays_against_its_claim():
    claim = half_square()
    certificate, _ = derive(claim, {})
    assert replay(claim, certificate, {}) == len(certificate["moves"])


def test_a_certificate_proves_only_its_own_claim():
    certificate, _ = derive(half_square(), {})
    other = Source("certificate").claim("2", "another", left=u, printed=u, where=[interval(u, -1, 1)])
    with pytest.raises(Refused, match="not one for"):
        replay(other, certificate, {})
    wrong = equation(Integral(x * u, (x, 0, 1)), u / 3, interval(u, -1, 1))
    with pytest.raises(Refused):
        replay(wrong, certificate, {})


def test_a_tampered_certificate_is_refused():
    claim = half_square()
    certificate, _ = derive(claim, {})
    for broken in (
        {**certificate, "moves": certificate["moves"][:-1]},
        {**certificate, "moves": [*certificate["moves"], certificate["moves"][-1]]},
        {**certificate, "moves": [["believe", {}]]},
    ):
        with pytest.raises(Refused):
            replay(claim, broken, {})
    changed = copy.deepcopy(certificate)
    changed["moves"][0][1]["primitive"] = ["int", "1"]
    with pytest.raises(Refused):
        replay(claim, changed, {})


def test_the_checker_does_not_know_how_proofs_are_found():
    import sys

    import xsec_sym.proof.checker as checker

    names = {m.__name__ for m in vars(checker).values() if type(m) is type(sys)}
    assert "xsec_sym.proof.steps" not in names
    source = Path(checker.__file__).read_text()
    assert "steps" not in source.split('"""', 2)[2].split("def ", 1)[0] and "import derivations" not in source


def test_opening_rebuilds_the_goal_from_the_claim():
    p = Symbol("p", integer=True, nonnegative=True)
    goal = opening(equation(u**p, u**p, interval(u, -1, 1), parity(p, odd=True)))
    assert goal.left == u ** (2 * n + 1)
