"""Reciprocity of a half-space of flakes: the section's statements, and the answer to its open question."""

from __future__ import annotations

import numpy as np
import pytest
from sympy import Rational, pi

from derivations.deon2016 import dirac_ring, ggx, table1  # noqa: F401  (their lemmas)
from derivations.dupuy2016 import reciprocity as section
from derivations.extensions import reciprocity, reciprocity_examples, spherical_gaussian  # noqa: F401
from tests.earned import earned
from xsec_sym.exact import reciprocity as exact
from xsec_sym.proof.claim import REGISTRY

FAILS = {"figure-6.non-symmetric", "equal-heights", "height-field"}
ASKED = {"open-question", "other-interpretation", "information", "surface-like", "voxels"}
HOLDS = {"xsec:reciprocity-symmetric.if", "xsec:reciprocity-proviso.down"}
CLAIMS = [c for s in (section.paper, reciprocity.project, reciprocity_examples.project) for c in s if c.kind != "whole"]


def expected(claim):
    slug = claim.label.removeprefix("claim.")
    if claim.source == "xsec":
        return "claim-holds" if claim.id in HOLDS else "proved"
    if slug == claim.label:
        return "proved"
    return "claim-fails" if slug in FAILS else "out-of-scope" if slug in ASKED else "claim-holds"


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda c: c.id)
def test_every_statement_has_its_verdict(claim, deep):
    verdict = earned(claim, deep=deep)
    assert verdict.verdict == expected(claim), verdict.note
    if verdict.verdict == "claim-holds":
        assert verdict.evidence["statement"] == "proved"
    assert verdict.verdict in ("claim-fails", "out-of-scope") or verdict.mutants >= 8


def test_the_printed_inequality_is_set_as_such():
    whole = REGISTRY["dupuy2016:23"]
    assert r"\neq" in whole.latex()
    assert {REGISTRY[p].id for p in whole.parts} == {"dupuy2016:23.ratio", "dupuy2016:23.witness"}


def test_a_micro_bsdf_that_is_not_reciprocal_spoils_the_vertex(monkeypatch):
    g, flat, steep = reciprocity.g, (Rational(1, 2), 0, -1), (0, Rational(1, 3), 1)
    uneven = reciprocity.BSDF[g][0]

    def both_ways():
        there = reciprocity.vertex(flat, steep)
        back = reciprocity.vertex(exact.opposite(steep), exact.opposite(flat))
        return [e.replace(g, uneven) for e in (there, back)]

    assert both_ways()[0] == both_ways()[1] != 0
    monkeypatch.setattr(reciprocity, "micro", lambda i, o: g(*i, *o))
    assert both_ways()[0] != both_ways()[1]


def test_the_tilted_facets_numbers():
    """(3/5, 0, 4/5): 5 a / (4 pi) from the axis to the normal, 4 a / (5 pi) back."""
    tilt, tangent = (Rational(3, 5), 0, Rational(4, 5)), Rational(3, 4)
    a = reciprocity_examples.albedo
    assert reciprocity_examples.facet_brdf(tilt, (0, 0), (tangent, 0)) == 5 * a / (4 * pi)
    assert reciprocity_examples.facet_brdf(tilt, (tangent, 0), (0, 0)) == 4 * a / (5 * pi)


# --- the whole answer, tried on media of a few flakes -----------------------------------------------------


def sphere(n=24):
    """Directions in opposite pairs with weights, none of them horizontal."""
    x, w = np.polynomial.legendre.leggauss(n)
    phi = 2 * np.pi * (np.arange(2 * n) + 0.3) / (2 * n)
    s = np.sqrt(1 - x**2)[:, None]
    up = np.stack([s * np.cos(phi), s * np.sin(phi), np.broadcast_to(x[:, None], (n, 2 * n))], -1)
    return up.reshape(-1, 3), np.repeat(w * np.pi / n, 2 * n)


def brdfs(normals, areas, i, o):
    """Single and double scattering by diffuse flakes of albedo 1, from the depth integrals, straight from (4)-(6)."""

    def sigma(w):
        return np.maximum(0, -w @ normals.T) @ areas

    def scattering(before, after):
        return (np.maximum(0, -before @ normals.T) * np.maximum(0, after @ normals.T)) @ areas / np.pi

    into, out = sigma(-i) / i[2], sigma(o) / o[2]
    once = scattering(-i, o) / (i[2] * o[2]) / (into + out)
    between, weight = sphere()
    rise = np.abs(between[:, 2])
    along = sigma(between) / rise
    # from depth z_1 to z_2, exp(-into z_1 - along |z_1 - z_2| - out z_2) over both: up where z_2 < z_1
    depths = 1 / ((into + out) * (np.where(between[:, 2] > 0, into, out) + along))
    twice = (scattering(-i, between) * scattering(between, o) * depths / rise) @ weight / (i[2] * o[2])
    return np.array([once, twice])


def unit(*v):
    return np.array(v) / np.linalg.norm(v)


LEVEL = np.array([unit(3, 0, 1), unit(-1, 2, 2), unit(-1, -2, 2), unit(1, 1, -3)])
PAIRS = [(unit(1, 0, 2), unit(-1, 1, 1)), (unit(0.2, 3, 1), unit(0.1, -0.5, 1)), (unit(2, 1, 0.3), unit(0, 0, 1))]


def balanced():
    """Areas for which the lateral part of M is 0: neither symmetric, nor about the axis, nor a height field."""
    fixed = LEVEL[3, :2] * 0.7
    areas = np.linalg.lstsq(LEVEL[:3, :2].T, -fixed, rcond=None)[0]
    shift = np.linalg.svd(LEVEL[:3, :2].T)[2][2]
    return np.append(areas + 3 * shift * np.sign(shift[0]), 0.7)


@pytest.mark.parametrize(("i", "o"), PAIRS)
def test_reciprocal_where_the_mean_normal_is_the_macroscopic_one(i, o):
    areas = balanced()
    mean = areas @ LEVEL
    assert (areas > 0).all() and np.abs(mean[:2]).max() < 1e-12 and abs(mean[2]) > 0.1
    there, back = brdfs(LEVEL, areas, i, o), brdfs(LEVEL, areas, o, i)
    assert (there > 1e-3).all()
    np.testing.assert_allclose(there, back, rtol=1e-12)


@pytest.mark.parametrize(("i", "o"), PAIRS)
def test_not_reciprocal_where_it_leans(i, o):
    areas = balanced() * [1.3, 1, 0.8, 1]
    there, back = brdfs(LEVEL, areas, i, o), brdfs(LEVEL, areas, o, i)
    assert np.abs(there / back - 1).min() > 1e-3
    lean = (areas @ LEVEL)[:2]
    assert np.sign(back[0] - there[0]) == np.sign(lean @ (i[:2] / i[2] - o[:2] / o[2]))


def test_single_scattering_ignores_a_lean_at_right_angles():
    areas = balanced() * [1.3, 1, 0.8, 1]
    lean = (areas @ LEVEL)[:2]
    aside = np.array([-lean[1], lean[0]]) / np.linalg.norm(lean)
    i, o = unit(0.3, 0.2, 1), unit(*(np.array([0.3, 0.2]) + 0.6 * aside), 1)
    there, back = brdfs(LEVEL, areas, i, o), brdfs(LEVEL, areas, o, i)
    assert there[0] == pytest.approx(back[0], rel=1e-13)
    assert abs(there[1] / back[1] - 1) > 1e-6
