"""The squared spheroidal and ellipsoidal lobes: what is printed, what holds, and the lobe against GGX by numbers."""

from __future__ import annotations

from math import acos, asin, cos, pi, sin, sqrt

import pytest
from mpmath import ellipe, quad
from sympy import Rational

from derivations.extensions import ellipsoidal_integral, ellipsoidal_lobe, half_angle
from derivations.tokuyoshi_harada import ellipsoid, lobe, spheroid
from tests.earned import earned
from xsec_sym.proof.claim import REGISTRY
from xsec_sym.proof.regular import Refused
from xsec_sym.proof.rules import start
from xsec_sym.proof.say import said
from xsec_sym.proof.steps import Step, derive

PAPER = (spheroid, ellipsoid, lobe)
PROJECT = (half_angle, ellipsoidal_lobe, ellipsoidal_integral)
UNIT = dict(zip(ellipsoid.omega, (Rational(2, 7), Rational(3, 7), Rational(6, 7)), strict=True))
ROUGH = {ellipsoid.alpha_x: Rational(1, 2), ellipsoid.alpha_y: Rational(1, 5)}
GOLDEN = {
    "tokuyoshi_harada:ssl": "4*alpha**4/(1 - cos(theta) + alpha**2*(1 + cos(theta)))**2",
    "tokuyoshi_harada:c.z": "1/2 - alpha**2/2",
    "tokuyoshi_harada:r.z": "1/2 + alpha**2/2",
    "xsec:ssl-integral": "4*pi*alpha**2",
}


@pytest.mark.parametrize("name", GOLDEN)
def test_the_form_that_holds(name):
    assert said(REGISTRY[name].form) == GOLDEN[name]


def test_every_equation_has_an_id():
    wanted = {"ssl", "c", "r", "r.aniso", "c.aniso", "p", "p.prime", "sphere", "quadratic", "K.E", "K.Q", "K.U", "U"}
    wanted |= {"1", "2", "3", "claim.spheroid"} | {f"t.{line}" for line in range(1, 6)}
    assert {c.label for module in PAPER for c in module.paper} >= wanted


@pytest.mark.parametrize("name", [c.id for m in (*PAPER, *PROJECT) for c in getattr(m, "paper", None) or m.project])
def test_every_claim_with_a_form_has_a_proof(name):
    claim = REGISTRY[name]
    if claim.kind in ("definition", "whole"):
        return
    certificate, _ = derive(claim, REGISTRY)
    assert certificate["claim"] == name


@pytest.mark.parametrize("name", ["ssl", "claim.spheroid", "r.xy", "p.prime.matrix.z", "t.1", "t.4", "t.5", "3", "K.U"])
def test_verdicts(name, deep):
    words = {"p.prime.matrix.z": "misprint", "t.1": "misprint", "t.4": "misprint", "claim.spheroid": "claim-holds"}
    verdict = earned(REGISTRY[f"tokuyoshi_harada:{name}"], deep=deep)
    assert verdict.verdict == words.get(name, "proved"), verdict.note
    assert verdict.mutants >= 8 and verdict.evidence["proof"]


@pytest.mark.parametrize("line", [1, 2, 3, 4])
def test_a_root_over_too_much_fails_on_unit_vectors_too(line):
    claim = REGISTRY[f"tokuyoshi_harada:t.{line}"]
    left, printed, mended = (float(e.subs({**UNIT, **ROUGH})) for e in (claim.left, claim.printed, claim.corrected))
    assert mended == pytest.approx(left, rel=1e-14)
    assert abs(printed / left - 1) > 1e-3


def test_a_false_form_is_refused():
    claim = REGISTRY["tokuyoshi_harada:t.5"]
    for wrong in (claim.form * 2, claim.form.subs(ellipsoid.z, -ellipsoid.z), claim.form + ellipsoid.alpha_x):
        with pytest.raises(Refused):
            claim.prove(Step(start(claim.left, wrong, claim.domain), REGISTRY, []))


# --- by numbers -----------------------------------------------------------------------------------------


def sel(x, y, z, a, b):
    big = max(a, b) ** 2
    stretched = sqrt(big / a**2 * x * x + big / b**2 * y * y + z * z)
    return 4 * big**2 / ((1 + big) * stretched - z * (1 - big)) ** 2


def ggx(x, y, z, a, b):
    c = sqrt(2 * (1 + z))
    return ((x / c / a) ** 2 + (y / c / b) ** 2 + ((1 + z) / c) ** 2) ** -2


def directions():
    for i in range(1, 40):
        for j in range(24):
            angle, turn = pi * i / 41, 2 * pi * j / 24
            yield sin(angle) * cos(turn), sin(angle) * sin(turn), cos(angle)


@pytest.mark.parametrize(("a", "b"), [(0.9, 0.1), (0.5, 0.4), (0.2, 0.01), (1, 0.3)])
def test_above_outside_below_inside_and_never_under_three_quarters(a, b):
    for x, y, z in directions():
        ratio, tangent = sel(x, y, z, a, b) / ggx(x, y, z, a, b), sqrt((1 - z) / (1 + z))
        assert ratio >= 0.75
        assert tangent < a or ratio >= 1 - 1e-12
        assert tangent > b or ratio <= 1 + 1e-12


def test_three_quarters_is_reached_in_the_limit():
    b = 1e-4
    y = sqrt(2 * b * b / (1 - b * b))
    direction = (0, y, sqrt(1 - y * y))
    assert sel(*direction, 1, b) / ggx(*direction, 1, b) == pytest.approx(0.75, abs=1e-6)


@pytest.mark.parametrize(("a", "b"), [(0.9, 0.3), (0.4, 0.35), (0.5, 0.05)])
def test_the_integral_is_legendre_s_and_lies_between_its_bounds(a, b):
    g = sqrt((1 + a * a) ** 2 - 4 * b * b)
    closed = 4 * pi * a * b * (1 + a * a) / g * float(ellipe(asin(g / (1 + a * a)), ((1 - a * a) / g) ** 2))

    def latitude(z):
        s = sqrt(1 - float(z) ** 2)
        return sum(sel(s * cos(f), s * sin(f), float(z), a, b) for f in (2 * pi * k / 256 for k in range(256)))

    direct = float(quad(latitude, [-1, 0, 0.8, 0.95, 1])) * 2 * pi / 256
    assert closed == pytest.approx(direct, rel=1e-6)
    assert 4 * pi * a * b <= closed <= 4 * pi * a * a


def test_with_one_roughness_of_1_the_integral_is_elementary():
    b = 0.3
    g = 2 * sqrt(1 - b * b)
    closed = 8 * pi * b / g * float(ellipe(asin(g / 2), 0))
    assert closed == pytest.approx(4 * pi * b * acos(b) / sqrt(1 - b * b), rel=1e-14)
