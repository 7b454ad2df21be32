"""The isotropic half-space: every line with its verdict, and H against routes that share nothing with its balls."""

from __future__ import annotations

import numpy as np
import pytest
from flint import arb, ctx
from mpmath import atan, cos, cot, exp, inf, log, mp, mpf, pi, quad, sin
from sympy import Rational

from derivations.deon2016 import flat_limit, gaussian_text, table1  # noqa: F401  (their lemmas)
from derivations.dupuy2016 import half_space, spherical_ndf
from derivations.extensions import flakes, isotropic_half_space, spherical_gaussian  # noqa: F401
from tests.earned import earned
from xsec_sym.exact import HIsotropic, HMoment, HTransform
from xsec_sym.exact.half_space_balls import LEVELS, moment, transform, value
from xsec_sym.proof import digits
from xsec_sym.proof.ball_compile import precision
from xsec_sym.proof.balls import enclose

OTHERWISE = {
    "dupuy2016:25": "misprint",
    "dupuy2016:28": "misprint",
    "dupuy2016:29": "misprint",
    "dupuy2016:claim.29-gives-25.printed": "claim-fails",
    "dupuy2016:30": "confirmed",
    "dupuy2016:31.equation": "confirmed",
    "dupuy2016:31.equation.conservative": "confirmed",
}
SECTIONS = (half_space.paper, spherical_ndf.paper, flakes.project, isotropic_half_space.project)
CLAIMS = [c for s in SECTIONS for c in s if c.kind not in ("whole", "definition", "out-of-scope")]


def expected(claim):
    if claim.id in OTHERWISE:
        return OTHERWISE[claim.id]
    if claim.kind == "statement":
        return "claim-holds"
    nested = claim in isotropic_half_space.project.claims and claim is not isotropic_half_space.below
    return "confirmed" if nested else "proved"


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda c: c.id)
def test_every_line_has_its_verdict(claim, deep):
    verdict = earned(claim, deep=deep)
    assert verdict.verdict == expected(claim), verdict.note
    assert verdict.verdict != "confirmed" or verdict.digits >= 30
    assert verdict.verdict == "claim-fails" or verdict.mutants >= 8


def test_every_printed_number_has_an_id():
    labels = {c.label for c in half_space.paper}
    assert {str(k) for k in range(25, 32)} <= labels
    assert {"claim.figure-9.beckmann", "claim.figure-10", "claim.figure-11", "claim.figure-12"} <= {
        c.label for c in spherical_ndf.paper
    }


@pytest.mark.parametrize(("u", "a"), [("0.5", "0.5"), ("0.01", "0.9"), ("1", "1"), ("7", "0.999"), ("0.2", "1")])
def test_h_is_the_printed_integral(u, a):
    with mp.workdps(25):
        x, c = mpf(u), mpf(a)
        around = quad(
            lambda t: log(1 - t * c * cot(t)) / (x**2 * sin(t) ** 2 + cos(t) ** 2),
            [mpf(10) ** -10, mpf(1) / 100, mpf(1) / 2, 1, 1.4, 1.5, 1.55, pi / 2],
        )
        # what is left next to 0, where the logarithm is log(1 - a + a t^2 / 3)
        around += quad(lambda t: log((1 - c) + c * t**2 / 3), [0, mpf(10) ** -10])
        printed = exp(-x / pi * around)
    ball = enclose(HIsotropic(Rational(u), Rational(a)), 30)
    assert abs(float(printed) / float(ball.mid()) - 1) < 1e-14
    assert (
        abs(digits.value(HIsotropic(Rational(u), Rational(a)), 25) / mpf(ball.mid().str(30, radius=False)) - 1) < 1e-14
    )


def solved(a, nodes=160):
    """H at nodes of [0, 1] from the integral equation alone, in the form that converges for a = 1 too."""
    x, w = np.polynomial.legendre.leggauss(nodes)
    x, w = (x + 1) / 2, w / 2
    v, w = x**3, 3 * x**2 * w  # H has a logarithm at v = 0
    h = np.ones_like(v)
    kernel = w * v / (v[:, None] + v)
    for _ in range(400):
        h = (h + 1 / (np.sqrt(1 - a) + a / 2 * kernel @ h)) / 2
    return v, w, h


@pytest.mark.parametrize("a", [0.3, 0.9, 1.0])
def test_h_solves_the_equation_as_iteration_does(a):
    v, w, h = solved(a)
    c = arb(a)
    for k in (10, 80, 150):
        assert abs(float(value(arb(v[k]), c).mid()) / h[k] - 1) < 1e-9
    assert abs(float(transform(arb(0.5), c).mid()) - np.sum(w * h / (0.5 + v))) < 1e-9
    assert abs(float(moment(arb(1), c).mid()) - np.sum(w * h * v)) < 1e-9


@pytest.mark.parametrize(
    "e", [HTransform(Rational(1, 3), 1), HTransform(5, Rational(4, 5)), HMoment(1, Rational(1, 2))]
)
def test_the_two_routes_agree(e):
    ball = enclose(e, 30)
    with mp.workdps(40):
        assert abs(digits.value(e, 30) / mpf(ball.mid().str(38, radius=False)) - 1) < mpf(10) ** -29


def test_coarse_balls_hold_the_fine_ones():
    for a in (arb(1), arb(0.5), arb(2) ** -20):
        for f, x in ((value, arb(0.25)), (value, arb(40)), (transform, arb(3)), (moment, arb(2))):
            found = []
            for bits in LEVELS[:2]:
                with precision(bits):
                    found.append(f(x, a))
            assert found[0].overlaps(found[1])
            assert found[1].rad() < found[0].rad() < 1e-15 * found[0]


def test_outside_the_domain_there_is_no_ball():
    for f, x, a in ((value, -1, 0.5), (value, 1, 1.5), (transform, 0, 0.5), (moment, 0.5, 0.5), (moment, -1, 0.5)):
        assert f(arb(x), arb(a)).is_nan()
    with precision(LEVELS[-1] + 1):
        assert value(arb(1), arb(1)).is_nan()
    assert ctx.prec <= LEVELS[-1]


def test_the_mean_of_the_conditional_visibility_by_sampling_depths():
    """(28): steep light goes deep, so that a flat way out is long; the print has it the other way round."""
    mu_i, mu_o = 0.9, 0.2
    depth = -mu_i * np.log((np.arange(200_000) + 0.5) / 200_000)
    seen = np.exp(-depth / mu_o).mean()
    assert seen == pytest.approx(1 / (1 + mu_i / mu_o), rel=1e-4)
    assert abs(seen - 1 / (1 + mu_o / mu_i)) > 0.5


def test_diffuse_flakes_by_brute_force():
    x, w = np.polynomial.legendre.leggauss(600)
    phi = (np.arange(1200) + 0.5) * 2 * np.pi / 1200
    root = np.sqrt(1 - x**2)[:, None]
    for mu in (-1.0, -0.3, 0.6):
        to_light, out = x[:, None] + 0 * phi, -mu * x[:, None] + np.sqrt(1 - mu**2) * root * np.cos(phi)
        total = (w[:, None] * np.maximum(0, to_light) * np.maximum(0, out)).sum() * 2 * np.pi / 1200 / np.pi**2
        assert total == pytest.approx(float(flakes.diffuse.corrected.subs(flakes.mu, mu)), rel=1e-4)


def test_h_by_focks_integral_beyond_one():
    with mp.workdps(20):
        fock = exp(-12 / pi * quad(lambda t: log(1 - mpf("0.7") * atan(t) / t) / (1 + 144 * t**2), [0, 0.05, 1, inf]))
    assert abs(float(fock) / float(value(arb(12), arb(7) / 10).mid()) - 1) < 1e-13
