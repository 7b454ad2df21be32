"""Lambertian spheres: the paper's equations, the coefficients of the phase function, and the H function's equation."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import cos, exp, log, mp, mpf, pi, quad, tan, workdps
from sympy import Rational, lambdify, symbols

from derivations.deon2016 import dirac_ring, spherical_gaussian  # noqa: F401  (their lemmas)
from derivations.deon2021 import characteristic, coefficients, fourier, h_equation, phase, sampling, scope
from tests.earned import earned
from xsec_sym.exact import PhaseLambertSphere
from xsec_sym.proof.claim import REGISTRY
from xsec_sym.proof.digits import value

OTHERWISE = {
    **dict.fromkeys(("deon2021:1.1", "deon2021:5", "deon2021:11", "deon2021:14", "deon2021:34"), "misprint"),
    **dict.fromkeys((f"deon2021:20.{part}" for part in ("elementary", 0, 1, 2)), "misprint"),
    **dict.fromkeys((f"deon2021:20.{order}.conservative" for order in range(3)), "misprint"),
    **dict.fromkeys(("deon2021:21", *(f"deon2021:22.{order}" for order in range(3))), "confirmed"),
    **dict.fromkeys((f"xsec:h-lambert-sphere.dispersion.{order}" for order in range(3)), "confirmed"),
    **dict.fromkeys(
        (f"deon2021:claim.{slug}" for slug in
         ("mean-cosine", "no-forward", "three-terms", "no-higher-mode", "mirror-spheres")), "claim-holds"
    ),
}  # fmt: skip
SECTIONS = (
    phase.paper,
    phase.later,
    phase.project,
    coefficients.project,
    sampling.paper,
    sampling.project,
    fourier.paper,
    characteristic.paper,
    characteristic.project,
    h_equation.paper,
    h_equation.project,
    scope.paper,
    scope.phase,
    scope.results,
    scope.conclusion,
)
ALL = [c for section in SECTIONS for c in section]
TESTED = [c for c in ALL if c.kind not in ("definition", "out-of-scope", "whole")]


@pytest.mark.parametrize("claim", TESTED, ids=lambda c: c.id)
def test_every_line_has_its_verdict(claim, deep):
    verdict = earned(claim, deep=deep)
    assert verdict.verdict == OTHERWISE.get(claim.id, "proved"), verdict.note
    assert verdict.mutants >= 8


def test_every_equation_of_these_sections_has_an_id():
    labels = {c.label for c in ALL if c.source == "deon2021"}
    printed = {*range(1, 13), *range(14, 27)} - {7}
    assert {str(n) for n in printed} | {"f_m", "H0inf", "Psi.0", "Psi.1", "Psi.2"} <= labels


def test_the_parts_of_a_whole_are_there():
    for claim in ALL:
        assert all(part in REGISTRY for part in claim.parts)


@pytest.mark.parametrize("cosine", ["-4/5", "0", "2/5"])
def test_the_phase_function_seen_with_another_pole(cosine):
    """The pole on neither direction but square to both: the sphere is then a stack of like circles."""
    x, turn = Rational(cosine), mp.acos(-mpf(Rational(cosine).p) / Rational(cosine).q)
    with workdps(20):
        circle = quad(lambda phi: cos(phi) * cos(phi - turn), [turn - pi / 2, pi / 2])
        heights = quad(lambda z: 1 - z**2, [-1, 1])
        assert abs(value(PhaseLambertSphere(x).definition(), 10) - heights * circle / pi**2) < mpf(10) ** -10


def test_the_numbers_drawn_fill_the_distribution():
    n = 64
    middles = (np.arange(n) + 0.5) / n
    a, b, c = np.meshgrid(middles, middles, middles)
    names = symbols("xi_1 xi_2 xi_3", real=True)
    drawn = np.sort(lambdify(names, sampling.drawn, "numpy")(a, b, c).ravel())
    share = lambdify(phase.mu, phase.distribution.form, "numpy")
    ranks = (np.arange(drawn.size) + 0.5) / drawn.size
    assert np.abs(share(drawn) - ranks).max() < 3e-3
    assert drawn.mean() == pytest.approx(-4 / 9, abs=1e-3)
    assert np.abs(share(-drawn[::-1]) - ranks).max() > 0.4  # the opposite sign is told apart


def test_the_legendre_series_comes_back_to_the_phase_function():
    from numpy.polynomial import Polynomial
    from numpy.polynomial.legendre import Legendre, legval

    def clamped(degree):
        return 2 * (Polynomial([0, 1]) * Legendre.basis(degree).convert(kind=Polynomial)).integ()(1.0)

    v = np.linspace(-0.9, 0.9, 19)
    coefficients = [(-1) ** k * (2 * k + 1) * clamped(k) ** 2 for k in range(25)]
    exact = lambdify(phase.mu, phase.form, "numpy")(v)
    assert np.abs(legval(v, coefficients) / (4 * np.pi) - exact).max() < 2e-6
    assert np.abs(phase.three_terms(0.5) - float(phase.form.subs(phase.mu, 0.5))) < 1e-3


@pytest.mark.parametrize("order", range(3))
def test_the_h_functions_of_the_paper_solve_the_equation_with_the_product(order):
    """What is proved on a family holds for the three functions Psi of the paper too; the printed sum does not."""
    at = {characteristic.c: Rational(7, 10)}
    psi = lambdify(characteristic.mu, characteristic.PSI[order].subs(at), "mpmath")
    dispersion = lambdify(characteristic.t, characteristic.K[order].subs(at), "mpmath")

    def logarithm(t):
        with workdps(60):  # K has t^5 below the line
            return mp.re(log(dispersion(+t)))

    def h(m):
        return exp(-quad(lambda a: logarithm(tan(a) / m), [0, pi / 8, pi / 4, 3 * pi / 8, pi / 2], maxdegree=5) / pi)

    m = mpf("0.6")
    known = {}
    product = quad(lambda x: known.setdefault(x, h(x)) * psi(x) / (m + x), [0, 1], maxdegree=4)
    total = quad(lambda x: (known.setdefault(x, h(x)) + psi(x)) / (m + x), [0, 1], maxdegree=4)
    assert abs(1 / h(m) - 1 + m * product) < 1e-9
    assert abs(1 / h(m) - 1 + m * total) > 0.1
