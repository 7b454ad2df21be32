import numpy as np
import pytest
from mpmath import mpf
from sympy import Abs, Max, Piecewise, Rational, Symbol, acos, cos, exp, log, pi, sqrt, symbols
from sympy.codegen.cfunctions import expm1, log1p

from xsec_sym.export import NotShown, floats, rules, search
from xsec_sym.export.printer import Printer, Unprintable, WithinOne, lines
from xsec_sym.export.rules import checked, rewritten
from xsec_sym.export.search import Search, one_sided
from xsec_sym.proof.domain import domain, interval
from xsec_sym.proof.piece import Piece

u, v = symbols("u v", real=True)
UNIT = domain([interval(u, 0, 1, open="left")])
WHOLE = domain([interval(u, -1, 1)])
HERE = Piece.of(UNIT)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (log(1 + u), log1p(u)),
        (log(1 + 1 / u), log1p(u) - log(u)),
        (exp(u) - 1, expm1(u)),
        (1 - u**2, (1 - u) * (1 + u)),
        (sqrt(2 - u**2) - 1, (1 - u) * (1 + u) / (sqrt(2 - u**2) + 1)),
        (1 / u - 2, (1 - 2 * u) / u),
    ],
)
def test_equal_forms_are_found_and_shown(old, new):
    assert checked(old, new, HERE) == new
    found = [whole for whole, _, _ in rewritten(old, HERE)]
    assert any(HERE.is_zero(rules.plain(whole - new)) for whole in found)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (log(1 + 1 / u), log1p(u) + log(u)),
        (1 - u**2, (1 - u) ** 2),
        (sqrt(u**2 - 2 * u + 1), u - 1),
        (sqrt(2 - u**2) - 1, (1 - u) * (1 + u) / (sqrt(2 - u**2) - 1)),
    ],
)
def test_wrong_rewrites_are_refused(old, new):
    with pytest.raises(NotShown):
        checked(old, new, HERE)


def test_a_rewrite_holds_on_its_domain_only():
    assert checked(sqrt(u**2), u, HERE) == u
    with pytest.raises(NotShown):
        checked(sqrt(u**2), u, Piece.of(WHOLE))


def test_a_wrong_rule_changes_nothing(monkeypatch):
    """It would make the function look exact, were it not refused."""
    tempting = 1 - u * log(1 + 1 / u)
    monkeypatch.setattr(rules, "RULES", (lambda e, piece: iter([u * 0 + Rational(1, 2)] if e == tempting else []),))
    assert Search(tempting, UNIT).best().expression == tempting


@pytest.mark.parametrize(
    ("form", "where"),
    [
        (1 - u * log(1 + 1 / u), UNIT),
        (sqrt(2 - u**2) - 1, WHOLE),
        (exp(u) - 1, WHOLE),
        (pi * (u**2 - Abs(u)), WHOLE),
        (1 / u - 2 + 2 * u * log(1 + 1 / u), UNIT),
    ],
)
def test_the_search_repairs_cancellation(form, where):
    form, where, _ = one_sided(form, where)
    tried = Search(form, where)
    assert tried.form(form).error > 5
    assert tried.best().error <= search.GOOD


def test_a_good_form_stays():
    assert Search(1 + u, UNIT).best().expression == 1 + u


def test_one_sided():
    assert one_sided(u**2 + Abs(u), WHOLE)[0] == Symbol("abs_u", real=True) ** 2 + Symbol("abs_u", real=True)
    assert one_sided(u + Abs(u), WHOLE)[0] == u + Abs(u)
    assert str(one_sided(log(1 - 1 / u), domain([interval(u, -1, 0, open="right")]))[0]) == "log(1 + 1/abs_u)"


# --- the printer -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("e", "golden"),
    [
        (2 * pi * (1 - u * (log1p(u) - log(u))), ["return 2.0 * np.pi * (1.0 - u * (np.log1p(u) - np.log(u)))"]),
        (
            u**5 / (1 + u**2) ** 2 - 1 / (3 * sqrt(2) * u),
            [
                "u_2 = u * u",
                "u_5 = u_2 * u_2 * u",
                "a = u_2 + 1.0",
                "a_2 = a * a",
                "return u_5 / a_2 - 0.23570226039551584 / u",
            ],
        ),
        (Max(0, u, v) + Abs(u), ["return np.abs(u) + np.maximum(np.maximum(0.0, u), v)"]),
    ],
)
def test_golden_source(e, golden):
    assert lines(e) == golden


@pytest.mark.parametrize(
    "e",
    [u / (1 + v), u / (v * u + 1) / v, -u * (v - 1) ** 3, (u - v) - (v - u * v), u ** Rational(-3, 2), -sqrt(u) / 3],
)
def test_printed_source_means_what_it_says(e):
    points = [(0.3, 0.7), (0.9, 0.2)]
    got = floats.values(lines(e), (u, v), points)
    assert np.allclose(got, [float(e.subs({u: a, v: b})) for a, b in points], rtol=1e-14)


def test_constants_are_rounded_once():
    said = ["np.pi", "0.25 * np.pi", "1.0471975511965979", "0.6931471805599453", "0.3333333333333333", "-np.pi"]
    assert [Printer().constant(c) for c in (pi, pi / 4, pi / 3, log(2), Rational(1, 3), -pi)] == said


def test_long_lines_are_broken():
    long = sum(cos(k * u + v) / (k + u) for k in range(1, 20))
    assert max(map(len, lines(long))) <= 116


def test_no_function_no_source():
    from sympy import zeta

    with pytest.raises(Unprintable, match="zeta"):
        lines(zeta(u))


def test_arguments_past_one_are_held_back():
    where = domain([interval(u, -1, 1), interval(v, -1, 1)], {})
    form = Search(acos(u * v), where).form(acos(u * v))
    assert "np.minimum(1.0, u * v)" in form.body[-1] and WithinOne.__name__ not in form.body[-1]


# --- points and errors ---------------------------------------------------------------------------------


def test_points_reach_the_bounds_and_zero():
    found = [p[0] for p in floats.points(WHOLE, 300)]
    assert {1.0, -1.0, 0.0, 5e-324, -1e-300} <= set(found) and max(map(abs, found)) == 1.0
    assert found == [p[0] for p in floats.points(WHOLE, 300)]
    assert len(floats.points(domain([interval(u, 0, 1), interval(v, 0, u)]), 50)) == 50


def test_values_see_the_smallest_arguments():
    assert abs(floats.exact(log(1 + u), (u,), (5e-324,)) / mpf(5e-324) - 1) < 1e-15
    assert floats.exact(Piecewise((1 / u, u > 0), (0, True)), (u,), (0.0,)) == 0


def test_ulps():
    assert floats.ulps(1 - 2.0**-53, mpf(1)) == 0.5
    assert floats.ulps(float("nan"), mpf(1)) == float("inf")
    assert floats.ulps(float(np.float32(0.1)), mpf(0.1), np.float32) <= 0.5
