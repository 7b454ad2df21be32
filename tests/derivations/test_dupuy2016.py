"""The half-space of one-sided flakes: sections 2 and 3 of the article, line by line, and what the project adds."""

from __future__ import annotations

import math

import pytest
from mpmath import mp, quad
from sympy import lambdify

from derivations.deon2016 import beckmann, dirac_ring, ggx  # noqa: F401  (their lemmas)
from derivations.dupuy2016 import free_path, heights, projected_area, smith, volume
from derivations.extensions import heights as project
from tests.earned import earned
from xsec_sym.proof.claim import REGISTRY
from xsec_sym.proof.verdict import worst

FAILING = ("balance", "asymmetric", "albedo", "any-free-path", "visible-from", "condition-suffices", "figure5-right")
OTHERWISE = {
    "dupuy2016:12.gaussian.peaks": "confirmed",
    **{f"dupuy2016:{n}": "misprint" for n in ("2", "22.1", "22.2")},
    **{f"dupuy2016:claim.{slug}": "claim-fails" for slug in FAILING},
}
KINDS = {"definition": "definition", "out-of-scope": "out-of-scope", "statement": "claim-holds", "equation": "proved"}
SECTIONS = (volume.paper, free_path.paper, heights.paper, projected_area.paper, smith.paper, project.project)
CLAIMS = [c for s in SECTIONS for c in s if c.kind != "whole"]
LINES = {8: 2, 9: 2, 10: 2, 11: 3, 15: 2, 16: 3, 18: 2, 19: 2, 20: 4, 21: 4, 22: 3}


def expected(claim):
    return OTHERWISE.get(claim.id, KINDS[claim.kind])


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda c: c.id)
def test_every_line_has_its_verdict(claim, deep):
    verdict = earned(claim, deep=deep)
    assert verdict.verdict == expected(claim), verdict.note
    assert claim.kind in ("definition", "out-of-scope") or verdict.verdict == "claim-fails" or verdict.mutants >= 8


def test_every_printed_line_has_an_id():
    labels = {c.label for s in SECTIONS for c in s}
    assert {str(n) for n in range(1, 23)} <= labels
    assert {f"{n}.{line}" for n, count in LINES.items() for line in range(1, count + 1)} <= labels


def test_the_wholes_carry_the_worst_of_their_lines():
    def of(claim):
        if claim.kind != "whole":
            return expected(claim)
        return worst([of(REGISTRY[part]) for part in claim.parts])

    wholes = {c.label: of(c) for s in SECTIONS for c in s if c.kind == "whole"}
    assert wholes["22"] == "misprint"
    assert wholes["20"] == wholes["21"] == "proved"
    assert wholes["claim.identical"] == "claim-holds"


# --- by another route -----------------------------------------------------------------------------------


@pytest.mark.parametrize("family", heights.FAMILIES, ids=lambda f: f.name)
def test_the_density_is_the_slope_of_the_logarithm(family):
    """No closed form on the left: C_1 by quadrature, and a difference quotient of its logarithm."""
    density = lambdify(heights.zeta, family.density(heights.zeta), "mpmath")
    ends = [-1] if family.low == -1 else [mp.ninf, -3]
    with mp.workdps(25):
        there = mp.mpf(-3) / 7
        slope = mp.diff(lambda v: mp.log(quad(lambda t: density(t) + 0 * t, [*ends, v])), there)
        closed = lambdify(heights.zeta, heights.CLOSED[family.name], "mpmath")(there)
        assert abs(slope - closed) < mp.mpf(10) ** -8


def seen_from_the_path(lam_i, lam_o, into):
    """The share of first hits of paths from omega_i that see omega_o: midpoints of the uniform number of (10)."""
    cos_i, cos_o, n = 0.6, 0.8, 20000
    lengths = [-math.log(1 - (k + 0.5) / n) / (into * cos_i) for k in range(n)]
    return sum(math.exp(-(lam_o * cos_o) * (length * cos_i) / cos_o) for length in lengths) / n


def test_paths_that_enter_decide_between_the_lines_of_equation_22():
    """They travel along -omega_i, with sigma(-omega_i) = (1 + Lambda_i) cos(theta_i), not Lambda_i cos(theta_i)."""
    lam_i, lam_o = 0.7, 1.9
    line_3, lines_1_and_2 = (1 + lam_i) / (1 + lam_i + lam_o), 1 / (1 + lam_o / lam_i)
    assert seen_from_the_path(lam_i, lam_o, 1 + lam_i) == pytest.approx(line_3, rel=1e-3)
    assert seen_from_the_path(lam_i, lam_o, lam_i) == pytest.approx(lines_1_and_2, rel=1e-3)
    assert line_3 - lines_1_and_2 > 0.2


def test_upward_faces_decide_between_the_source_terms():
    """Light that only falls onto upward faces: all that is taken is sent up again; as printed, all of it is lost."""
    n = 400
    grid = [-1 + (2 * k + 1) / n for k in range(n)]
    scattering = lambdify(
        (volume.u, volume.x), volume.scattering(volume.u, volume.x).subs({volume.up: 1, volume.down: 0})
    )
    falling = [x for x in grid if x < 0]
    weight = (2 * math.pi * 2 / n) ** 2
    taken = sum(-x for x in falling) * 2 * math.pi * 2 / n
    corrected = sum(scattering(x, u) for u in grid for x in falling) * weight
    printed = sum(scattering(u, x) for u in grid for x in falling) * weight
    assert corrected == pytest.approx(taken, rel=1e-4)
    assert printed == 0


def test_condition_17_alone_admits_a_tilted_facet():
    """A single facet: its weight 1 / cos(theta_m) meets (17), and (19) misses by sin(theta_i) times its slope."""
    tilt, theta = 0.3, 1.0
    normal = (-math.sin(tilt), math.cos(tilt))  # the surface rises towards the viewer
    viewer = (math.sin(theta), math.cos(theta))
    weight = 1 / normal[1]
    seen = weight * (normal[0] * viewer[0] + normal[1] * viewer[1])
    assert weight * normal[1] == pytest.approx(1)
    assert seen > 0  # so nothing is masked: Lambda = 0, and (19) would give cos(theta)
    assert math.cos(theta) - seen == pytest.approx(math.sin(theta) * math.tan(tilt))
