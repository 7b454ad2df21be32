"""A measured claim holds, fails or stays open as it should, and cannot be fooled by NaN, by methods that disagree, by
tolerances that anything meets, or by a form that is garbage."""

from __future__ import annotations

import json
from itertools import count

import numpy as np
import pytest
from sympy import Float, Integral, Max, Mul, Rational, cos, exp, log, sin, sqrt, symbols

from xsec_sym.exact.solved import Solved
from xsec_sym.proof import Source, interval, wire
from xsec_sym.proof.accuracy import T
from xsec_sym.proof.values import compiled
from xsec_sym.proof.verify import verify
from xsec_sym.record.entry import Entry
from xsec_sym.record.key import statement

x, y = symbols("x y", real=True)
numbers = count()
SERIES = 1 + x + x**2 / 2 + x**3 / 6
TRUE = float(np.e - SERIES.subs(x, 1))  # at x = 1


def solved(first, second):
    return type("Made", (Solved,), {"routes": (first, second), "methods": ("one", "two"), "symbol": "M"})


Exponential = solved(np.exp, lambda v: np.cosh(v) + np.sinh(v))
Product = solved(lambda v, w: np.exp(v * w), lambda v, w: 1 / np.exp(-v * w))


def judge(left=None, low=0, high=1, variables=None, seed=0, open=False, **rest):
    source = Source(f"test-measured-{next(numbers)}")
    where = variables or [interval(x, low, high, open=open)]
    claim = source.measured("1", "a claim", left=Exponential(x) if left is None else left, where=where, **rest)
    return verify(claim, {}, seed=seed)


def test_an_accuracy_holds_with_the_largest_error_and_its_place():
    verdict = judge(printed=SERIES, within=Rational(6, 100), statement=True)
    assert verdict.verdict == "claim-holds", verdict.note
    assert float(verdict.evidence["largest error found"]) == pytest.approx(TRUE, rel=1e-2)
    assert verdict.evidence["at point"] == {"x": "1"}
    assert verdict.evidence["digits agreed on"] >= 14
    assert verdict.mutants >= 8 and verdict.witness is None and verdict.digits is None


@pytest.mark.parametrize("seed", range(5))
def test_a_worst_point_inside_is_found_whatever_the_seed(seed):
    form = SERIES + Rational(1, 10) * exp(-((300 * (x - Rational(1, 3))) ** 2))
    verdict = judge(printed=form, within=Rational(11, 100), seed=seed)
    assert float(verdict.evidence["largest error found"]) == pytest.approx(0.1 - 0.00055, rel=5e-3)
    assert float(verdict.evidence["at point"]["x"]) == pytest.approx(1 / 3, abs=1e-3)


def test_a_stated_accuracy_that_is_missed_fails_with_a_witness():
    verdict = judge(printed=SERIES, within=Rational(5, 100), statement=True)
    assert verdict.verdict == "claim-fails"
    assert float(verdict.witness["left"]) - float(verdict.witness["right"]) == pytest.approx(TRUE)
    assert 0.9 < float(verdict.evidence["share of the points within"]) < 1


def test_a_form_that_misses_and_is_not_mended_is_refuted():
    assert judge(printed=SERIES, within=Rational(5, 100)).verdict == "refuted"


def test_a_tolerance_too_near_to_tell_is_refused():
    verdict = judge(printed=exp(x) + Rational(1, 100), within=Rational(1, 100))
    assert verdict.verdict == "inconclusive" and "too near" in verdict.note


def test_relative_errors():
    verdict = judge(printed=exp(x) * Rational(101, 100), within=Rational(2, 100), relative=True)
    assert verdict.verdict == "claim-holds"
    assert float(verdict.evidence["largest error found"]) == pytest.approx(0.01)


def test_a_misprint_needs_a_print_that_misses_and_an_edit_that_restores():
    wrong = SERIES.subs(x**3 / 6, -(x**3) / 6)
    verdict = judge(printed=wrong, corrected=SERIES, edit="a plus")
    assert verdict.verdict == "inconclusive" and "not seen to miss" in verdict.note  # 0.33 is not ten times 0.05
    verdict = judge(printed=wrong, corrected=SERIES, edit="a plus", within=Rational(6, 100))
    assert verdict.verdict == "misprint"
    assert float(verdict.evidence["error of the print"]) == pytest.approx(TRUE + 1 / 3, rel=1e-2)
    assert verdict.witness["point"] == {"x": "1"}
    verdict = judge(printed=SERIES, corrected=wrong, edit="a minus", within=Rational(6, 100))
    assert verdict.verdict == "inconclusive"


def test_a_corrected_form_that_misses_is_no_correction():
    verdict = judge(printed=5 * SERIES, corrected=3 * SERIES, edit="3 for 5", within=Rational(6, 100))
    assert verdict.verdict == "inconclusive" and "the corrected form fails" in verdict.note


# --- what must never pass --------------------------------------------------------------------------------


@pytest.mark.parametrize("slip", [Rational(5, 2), 20, Rational(1, 3)])
def test_a_wrong_constant_does_not_pass(slip):
    wrong = SERIES.subs(x**3 / 6, x**3 / slip)
    assert judge(printed=wrong, within=Rational(6, 100)).verdict == "refuted"


def test_garbage_does_not_pass_where_no_accuracy_is_stated():
    """Ten times an error that is as large as the quantity is met by anything."""
    small = solved(lambda v: 0.06 * np.exp(v), lambda v: 0.06 / np.exp(-v))(x)
    for garbage in (2 * SERIES * Rational(6, 100), cos(7 * x) / 20, Rational(0)):
        verdict = judge(left=small, printed=garbage)
        assert verdict.verdict == "inconclusive", garbage


def test_a_tolerance_that_altered_forms_meet_is_refused():
    assert judge(printed=SERIES, within=8).verdict == "inconclusive"


@pytest.mark.parametrize("form", [log(x), 1 / (x - 1), sqrt(x - Rational(1, 2)), (x - 2) ** Float("0.5")])
def test_a_form_without_a_value_somewhere_is_refused(form):
    verdict = judge(printed=SERIES + form / 10**6, within=Rational(6, 100))
    assert verdict.verdict == "inconclusive" and "no value" in verdict.note


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_method_without_a_value_somewhere_is_refused(bad):
    broken = solved(np.exp, lambda v: np.where(v > 0.9999, bad, np.exp(v)))
    verdict = judge(left=broken(x), printed=SERIES, within=Rational(6, 100), statement=True)
    assert verdict.verdict == "inconclusive" and "no value" in verdict.note


def test_methods_that_disagree_settle_nothing():
    apart = solved(np.exp, lambda v: np.exp(v) * (1 + 3e-10 * (v > 0.5)))
    verdict = judge(left=apart(x), printed=SERIES, within=Rational(6, 100), statement=True)
    assert verdict.verdict == "inconclusive" and "agree on 9 digits" in verdict.note
    near = solved(np.exp, lambda v: np.exp(v) * (1 + 3e-11))
    assert judge(left=near(x), printed=SERIES, within=Rational(6, 100)).evidence["digits agreed on"] == 10


def test_a_quantity_with_one_method_is_no_solved_quantity():
    with pytest.raises(TypeError, match="one route"):
        solved(np.exp, np.exp)


def test_claims_that_test_nothing_are_refused():
    for rest in (
        {"left": Exponential(x), "printed": Exponential(x)},
        {"left": exp(x), "printed": SERIES},
        {"left": Exponential(x)},
        {"left": Exponential(x), "printed": SERIES, "corrected": SERIES},
        {"left": Exponential(x), "printed": SERIES, "exact": True, "relative": True},
    ):
        with pytest.raises(ValueError, match="test-measured"):
            judge(**rest)


def test_points_must_cover_the_domain():
    verdict = judge(printed=SERIES, within=Rational(6, 100), along={x: T / 2})
    assert verdict.verdict == "inconclusive" and "whole range" in verdict.note
    assert judge(printed=SERIES, within=Rational(6, 100), along={x: 1 - T**3}).verdict == "claim-holds"
    gap = judge(printed=SERIES, variables=[interval(x, 0, 1), x > Rational(1, 2)])
    assert gap.verdict == "inconclusive"


def test_an_open_end_is_approached_and_not_used():
    verdict = judge(printed=SERIES + 1 / (10**9 * x), within=Rational(6, 100), open="left")
    assert verdict.verdict == "claim-holds"
    assert judge(printed=SERIES + 1 / (10**9 * x), within=Rational(6, 100)).verdict == "inconclusive"
    assert judge(printed=SERIES, within=Rational(6, 100), open=True, along={x: 1 - T}).verdict == "claim-holds"


# --- equality ---------------------------------------------------------------------------------------------

SQUARE = [interval(x, 0, 1), interval(y, 0, 2)]


def test_equality_is_confirmed_to_the_digits_agreed_on():
    verdict = judge(left=Product(x, y), printed=Exponential(x * y), variables=SQUARE, exact=True)
    assert verdict.verdict == "confirmed" and verdict.digits >= 14 and verdict.mutants >= 8
    assert verdict.evidence["enclosure"] is False


def test_nearly_equal_is_not_equal():
    near = Exponential(x * y) * (1 + x / 10**9)
    assert judge(left=Product(x, y), printed=near, variables=SQUARE, exact=True).verdict == "refuted"
    verdict = judge(left=Product(x, y), printed=near, corrected=exp(x * y), edit="a", variables=SQUARE, exact=True)
    assert verdict.verdict == "misprint" and verdict.witness["point"]["x"] == "1"


def test_a_large_value_somewhere_hides_no_error_elsewhere():
    steep = solved(lambda v: np.exp(30 * v), lambda v: 1 / np.exp(-30 * v))
    slip = exp(30 * x) + Max(0, 1 - 10 * x) / 10**4
    assert judge(left=steep(x), printed=slip, exact=True).verdict == "refuted"


def test_a_statement_of_equality_fails():
    assert judge(printed=SERIES, exact=True, statement=True).verdict == "claim-fails"


# --- integrals --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("integral", "value"),
    [
        (Integral(sqrt(y * (1 - y)), (y, 0, 1)), np.pi / 8),
        (Integral(log(y) * x, (y, 0, x)), 0.5 * (0.5 * np.log(0.5) - 0.5)),
        (Integral(Integral(sin(x * y), (y, 0, 1)), (x, 0, 2)), 0.847382016686613),
    ],
)
def test_integrals_by_two_quadratures(integral, value):
    found = [float(compiled(integral, [x], route)([np.array(0.5)])) for route in (0, 1)]
    assert found[0] == pytest.approx(found[1], rel=1e-10) != 0
    assert found[0] == pytest.approx(value, rel=1e-9)


def test_an_integral_without_a_value_is_refused():
    diverges = Integral(1 / y, (y, 0, x))
    assert judge(left=diverges, printed=SERIES, open="left").verdict == "inconclusive"
    assert judge(left=Integral(exp(-y), (y, x, symbols("oo"))), printed=SERIES).verdict == "inconclusive"


# --- the record -------------------------------------------------------------------------------------------


def test_decimals_stand_in_the_record_as_printed():
    source = Source(f"test-measured-{next(numbers)}")
    form = Float("0.0401885") * x + Float("1.01938")
    claim = source.measured("1", "a fit", left=Exponential(x), printed=form, where=[interval(x, 0, 1)])
    entry = Entry.of(claim, verify(claim, {}))
    assert "0.0401885" in entry.printed and "1.01938" in entry.printed
    assert entry.form == form
    for number in (Float("0.1") / 3, Float("1e-30"), Float(2) ** Float("0.5")):
        assert wire.decode(json.loads(json.dumps(wire.encode(number)))) == number
    as_printed = Mul(Float("0.777574"), 1 - x, evaluate=False)
    assert wire.decode(wire.encode(as_printed)) == as_printed != Float("0.777574") * (1 - x)
    wider = source.measured("2", "a fit", left=Exponential(x), printed=form, where=[interval(x, 0, 1)], within=1)
    assert statement(claim).partition(",")[2] != statement(wider).partition(",")[2]
