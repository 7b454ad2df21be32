"""A stated accuracy is bounded, not sampled: it holds, fails by a hair, or cannot be judged, and the engine knows."""

from __future__ import annotations

from dataclasses import replace
from itertools import count

import mpmath
import pytest
from flint import arb
from sympy import Rational, erf, exp, sin, symbols, tan

from xsec_sym.exact import gaussian_balls
from xsec_sym.proof import Source, interval
from xsec_sym.proof.accuracy import Accuracy, Chart, Limit, Tail
from xsec_sym.proof.ball_compile import compile_ball, precision
from xsec_sym.proof.suprema import NoBound, Surface, compiled, panels
from xsec_sym.proof.verify import verify

u, m = symbols("u m", real=True)
x, y = symbols("x y", positive=True)
numbers = count()
THOUSANDTH = Rational(1, 1000)

TAYLOR = m * u - (m * u) ** 3 / 6
# the error m^5 / 120 - m^7 / 5040 + ... at u = 1 is 0.001 here
REACH = float(mpmath.findroot(lambda t: mpmath.sin(t) - t + t**3 / 6 - mpmath.mpf("0.001"), 0.655))


def chart(form, **rest):
    return Chart(x, y, x, y, m, (0, 1), form.subs({u: x, m: y}), even="odd functions both", **rest)


def stated(form, end, within=THOUSANDTH, left=None, printed=None, edit="", **rest):
    source = Source(f"test-accuracy-{next(numbers)}")
    accuracy = Accuracy(within, chart(form), Rational(1, 10), end, limit=Limit(Rational(1, 10), y**5 / 100, "a term"))
    build = source.accuracy if printed is None else source.approximation
    sides = {"printed": form} if printed is None else {"printed": printed, "corrected": form, "edit": edit}
    return build(
        "1", "a series", left=sin(m * u) if left is None else left, **sides,
        where=[interval(u, -1, 1), interval(m, 0, end, open=True)], accuracy=replace(accuracy, **rest),
    )  # fmt: skip


def test_an_accuracy_holds_with_its_true_error_and_reach():
    verdict = verify(stated(TAYLOR, Rational(6, 10)), {})
    assert verdict.verdict == "claim-holds", verdict.note
    true = float(mpmath.sin(0.6) - 0.6 + mpmath.mpf(0.6) ** 3 / 6)
    assert float(verdict.evidence["largest error"]) == pytest.approx(true, rel=5e-3)
    assert true <= float(verdict.evidence["proved bound"]) <= true * 1.01
    assert float(verdict.evidence["holds to"].split("=")[1]) < REACH < float(verdict.evidence["broken at"]["m"])
    assert float(verdict.evidence["reach"].split("=")[1]) == pytest.approx(REACH, rel=1e-4)
    assert verdict.mutants >= 8


def test_a_claim_off_by_a_hair_fails():
    end = Rational(round(REACH * 1.0005, 5)).limit_denominator(10**5)
    verdict = verify(stated(TAYLOR, end), {})
    assert verdict.verdict == "claim-fails", verdict.note
    assert 0 < abs(float(verdict.witness["point"]["m"])) < end
    assert float(verdict.evidence["holds to"].split("=")[1]) < REACH


def test_half_the_true_error_is_refused():
    true = mpmath.sin(0.6) - 0.6 + mpmath.mpf(0.6) ** 3 / 6
    half = Rational(str(round(float(true) / 2, 8)))
    limit = Limit(Rational(1, 10), y**5 / 100, "a term")
    assert verify(stated(TAYLOR, Rational(6, 10), half, limit=limit), {}).verdict == "claim-fails"


def test_a_replay_tries_the_points_and_the_end_again():
    claim = stated(TAYLOR, Rational(6, 10))
    first = verify(claim, {})
    assert verify(claim, {}, witnesses=4, certificate=first.certificate).verdict == "claim-holds"
    spoiled = {**first.certificate, "accuracy": {**first.certificate["accuracy"], "tolerance": 2e-3}}
    assert verify(claim, {}, witnesses=4, certificate=spoiled).verdict == "inconclusive"


def test_a_flipped_sign_is_refused():
    wrong = m * u + (m * u) ** 3 / 6
    verdict = verify(stated(wrong, Rational(6, 10), limit=Limit(Rational(1, 10), y**3, "a term")), {})
    assert verdict.verdict == "claim-fails" or verdict.verdict == "inconclusive"
    verdict = verify(stated(-TAYLOR, Rational(6, 10), limit=None), {})
    assert verdict.verdict == "inconclusive"


def test_a_chart_of_another_form_is_refused():
    claim = stated(TAYLOR, Rational(6, 10), chart=chart(TAYLOR + u**3 / 10**12))
    assert "chart" in verify(claim, {}).note


def test_words_that_are_false_at_a_point_are_refused():
    low = verify(stated(TAYLOR, Rational(6, 10), limit=Limit(Rational(1, 10), y**5 / 10**6, "too small")), {})
    assert low.verdict == "inconclusive" and "limit" in low.note
    tail = Tail(Rational(1, 2), y**5 / 10**6, "too small")
    cut = replace(chart(TAYLOR), reach=(0, Rational(1, 2)))
    assert "tail" in verify(stated(TAYLOR, Rational(6, 10), chart=cut, tail=tail), {}).note


def test_what_has_no_bound_is_inconclusive():
    """tan has a pole inside of the range, and neither a value nor a bound there."""
    verdict = verify(stated(TAYLOR, Rational(3), Rational(10), left=tan(m * u)), {})
    assert verdict.verdict == "inconclusive"


def test_a_misprinted_approximation_shows_both_errors():
    claim = stated(TAYLOR, Rational(6, 10), printed=m * u + (m * u) ** 3 / 6, edit="the cubic term is subtracted")
    verdict = verify(claim, {})
    assert verdict.verdict == "misprint", verdict.note
    assert float(verdict.evidence["error of the print"]) > 1e-3 > float(verdict.evidence["largest error"])
    assert verdict.witness["point"]


def test_a_print_that_is_near_enough_is_no_misprint():
    near = m * u - (m * u) ** 3 / 6 + (m * u) ** 5 / 120
    verdict = verify(stated(TAYLOR, Rational(6, 10), printed=near, edit="drop a term"), {})
    assert verdict.verdict == "inconclusive"


# --- bounds by interpolation ----------------------------------------------------------------------------


@pytest.mark.parametrize("form", [sin(5 * x) * exp(-y), erf(4 * x - 2 * y), 1 / (1 + 9 * x**2 + y)])
def test_a_bound_is_never_below_a_value_and_hardly_above(form):
    surface = Surface(*compiled(compile_ball(form, (x, y))))
    top = max(p.bound(sharp=100) for p in panels(surface, (0.0, 1.0), (0.5, 1.0), 1e-7))
    grid = [(i / 50, 0.5 + j / 100) for i in range(51) for j in range(51)]
    seen = max(abs(float(form.subs({x: a, y: b}))) for a, b in grid)
    assert seen <= top <= seen * 1.002


def test_a_pole_has_no_bound():
    surface = Surface(*compiled(compile_ball(1 / (x - y), (x, y))))
    with pytest.raises(NoBound):
        list(panels(surface, (0.0, 1.0), (0.4, 0.6), 1e-3, depth=2))


# --- the fast evaluation of the spherical Gaussian -------------------------------------------------------


@pytest.mark.parametrize("alpha", ["0.002", "0.03", "0.05", "0.3", "1", "7"])
@pytest.mark.parametrize("cosine", ["-0.9", "-0.01", "0", "0.02", "0.6"])
def test_the_fast_cross_section_is_that_of_the_disk_of_rays(alpha, cosine):
    with mpmath.workdps(30):
        k, c = 2 / mpmath.mpf(alpha) ** 2, mpmath.mpf(cosine)

        def ray(t):
            z = k * mpmath.sqrt((1 - c**2) * (1 - t**2))
            return t * mpmath.besseli(0, z) * mpmath.exp(k * (c * t - 1))

        width = mpmath.mpf(alpha)
        peak = max(c, mpmath.mpf(0))
        cuts = sorted({min(max(peak + j * width, mpmath.mpf(0)), mpmath.mpf(1)) for j in range(-6, 7)} | {0, 1})
        true = k / (1 - mpmath.exp(-2 * k)) * mpmath.quad(ray, cuts)
    with precision(96):
        found = gaussian_balls.value(arb(cosine), arb(alpha))
    assert abs(float(found.mid()) - float(true)) < 1e-12 and found.rad() < 1e-10
