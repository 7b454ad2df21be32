"""A mirror of revolution and its distribution of normals: the article's lines, and the project's way there and back."""

from __future__ import annotations

import pytest
from mpmath import mp, quad, sqrt
from sympy import Symbol, cos, pi, sin, symbols, tan

from derivations.deon2016 import dirac_ring  # noqa: F401  (its lemmas)
from derivations.extensions import revolution
from derivations.kenha2018 import ellipsoid, surface
from tests.earned import earned
from xsec_sym.exact.revolution import normals_of
from xsec_sym.proof.domain import Domain, interval
from xsec_sym.proof.piece import Piece

OTHERWISE = {
    "kenha2018:2": "misprint",
    "kenha2018:dzdb.2": "misprint",
    "kenha2018:total": "definition",
    "kenha2018:6": "definition",
    "kenha2018:ellipsoid": "definition",
    "kenha2018:claim.solid-angle": "claim-holds",
    "kenha2018:claim.ggx": "claim-holds",
    "kenha2018:claim.reflected-solid-angle": "claim-fails",
    "kenha2018:claim.shape-for-statistics": "out-of-scope",
    "kenha2018:claim.rutherford": "out-of-scope",
}
CLAIMS = [c for s in (surface.paper, ellipsoid.paper, revolution.project) for c in s if c.kind != "whole"]


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda c: c.id)
def test_every_line_has_its_verdict(claim, deep):
    verdict = earned(claim, deep=deep)
    assert verdict.verdict == OTHERWISE.get(claim.id, "proved"), verdict.note
    assert claim.kind in ("definition", "out-of-scope") or verdict.verdict == "claim-fails" or verdict.mutants >= 8


def test_every_printed_line_has_an_id():
    labels = {c.label for s in (surface.paper, ellipsoid.paper) for c in s}
    assert {
        *"123456",
        "flux",
        "norm",
        "total",
        "ellipsoid",
        "z",
        "dzdb",
        "b2",
        "dbdtheta",
        "ggx",
        "scattering",
    } <= labels
    assert {f"{line}.{i}" for line in ("dsigma", "sigma") for i in (1, 2, 3)} <= labels


def test_the_tangent_is_the_sine_over_the_cosine_and_nothing_else():
    theta = Symbol("theta", real=True)
    piece = Piece.of(Domain((interval(theta, 0, pi / 2, open=True),)))
    assert piece.is_zero(tan(theta) - sin(theta) / cos(theta))
    assert piece.is_zero(1 + tan(theta) ** 2 - 1 / cos(theta) ** 2)
    for wrong in (tan(theta) + sin(theta) / cos(theta), tan(theta) - cos(theta) / sin(theta), tan(theta) - sin(theta)):
        assert not piece.is_zero(wrong)


def test_the_normals_of_a_profile_have_unit_projected_area():
    b = Symbol("b", positive=True)
    alpha = symbols("alpha", positive=True)
    u, density = normals_of(alpha * (1 - b**2) ** 2 / 3, b)
    place = {alpha: 1, b: 0.3}
    slope = 4 * 0.3 * (1 - 0.09) / 3
    assert float(u.subs(place)) == pytest.approx(float(1 / sqrt(1 + mp.mpf(slope) ** 2)), rel=1e-12)
    # up to b = 1/2 the slope of this one grows: the normals met there cover a quarter of the disk
    integrand = (2 * pi * u * density * abs(u.diff(b))).subs(alpha, 1)
    assert float(quad(lambda v: float(integrand.subs(b, float(v))), [0.01, 0.5])) == pytest.approx(
        0.25 - 1e-4, rel=1e-8
    )
