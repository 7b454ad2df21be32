"""Section 2.5.1 of deon2016: what is printed, what holds, and by how much the misprints miss."""

from __future__ import annotations

import pytest
from sympy import Rational, erf, hyper, symbols

from derivations.deon2016 import approximations, gaussian_text
from xsec_sym.proof.claim import REGISTRY
from xsec_sym.proof.error import Error
from xsec_sym.proof.verify import verify

u, m = symbols("u m", real=True)
ACCURACIES = {
    "claim.beckmann-0.001": (Rational(44, 1000), 0.0447, Rational(1, 1000)),
    "claim.40-accuracy": (Rational(1, 4), 0.2549, Rational(1, 1000)),
    "claim.41-accuracy": (Rational(3, 10), 0.3041, Rational(1, 10000)),
}


def worst(form, roughness, left="deon2016:41"):
    error = Error(REGISTRY[left], form)
    sizes = [error.at({u: Rational(i, 40), m: roughness}) for i in range(-39, 40)]
    return max(float(s.mid()) for s in sizes if s.is_finite())


@pytest.mark.parametrize("name", ["40", "41"])
def test_a_misprinted_approximation_is_mended_by_its_edit(name):
    verdict = verify(REGISTRY[f"deon2016:{name}"], REGISTRY)
    assert verdict.verdict == "misprint", verdict.note
    assert verdict.mutants >= 8 and verdict.witness
    assert verdict.certificate["moves"][0] == ["rests on", {"proven": f"deon2016:claim.{name}-accuracy"}]


@pytest.mark.parametrize("name", ["42", "43", "44"])
def test_the_equations_of_the_section(name):
    assert verify(REGISTRY[f"deon2016:{name}"], REGISTRY).verdict == ("misprint" if name == "42" else "proved")


@pytest.mark.parametrize("name", ACCURACIES)
def test_just_below_its_reach_a_form_is_within_and_just_above_it_is_not(name):
    _, reach, within = ACCURACIES[name]
    claim = REGISTRY[f"deon2016:{name}"]
    assert claim.accuracy.within == within
    assert (
        worst(claim.form, Rational(str(round(reach * 0.99, 6))))
        < within
        < worst(claim.form, Rational(str(round(reach * 1.03, 6))))
    )


def test_high_roughness_fails_by_a_hair():
    verdict = verify(REGISTRY["deon2016:claim.44-accuracy"], REGISTRY)
    assert verdict.verdict == "claim-fails"
    assert 1 < float(verdict.witness["point"]["m"]) < 1.005
    assert float(verdict.evidence["largest error"]) == pytest.approx(1.03e-3, rel=5e-3)
    assert verdict.evidence["reach"] == "m = 1.0049"


def test_the_bracket_of_the_cubic_term_needs_its_factor():
    a, b = approximations, approximations.regular
    single = a.cubic(b(2, 1 / m**4) - b(3, 1 / m**4), a.second)
    mended = a.cubic(2 * b(2, 1 / m**4) - b(3, 1 / m**4), a.second)
    side = (u**2 - 1) * a.csch(a.kappa) * b(2, (1 - u**2) / m**4) / (2 * m**2)
    sizes = [
        worst(a.mean_cosine * (u * erf(A - a.linear) + u) / 4 - side, Rational(299, 1000)) for A in (single, mended)
    ]
    assert sizes[1] < 1e-4 < 5e-3 < sizes[0]


def test_no_form_keeps_a_function_without_parameters():
    for claim in approximations.paper:
        for side in (claim.printed, claim.corrected):
            assert side is None or all(len(h.bq) == 1 for h in side.atoms(hyper))


def test_every_sentence_has_an_id():
    labels = {c.label for s in (approximations.paper, gaussian_text.paper, gaussian_text.conclusion) for c in s}
    assert {"40", "41", "42", "43", "44", "claim.twelve-terms", "claim.sg-isotropic", *ACCURACIES} <= labels
    assert {"claim.sg-beckmann-asymptotic", "claim.compact-form", "claim.efficient", "claim.two-steps"} <= labels
