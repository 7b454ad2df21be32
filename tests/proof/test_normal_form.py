"""The normal form, and what rests on it: what is not zero stays, and no sign is taken for granted."""

from __future__ import annotations

import pytest
from sympy import (
    Abs,
    Heaviside,
    Integral,
    Max,
    Piecewise,
    Rational,
    S,
    acos,
    acosh,
    asin,
    atan,
    besseli,
    binomial,
    cos,
    cosh,
    erf,
    erfc,
    exp,
    gamma,
    hyper,
    log,
    oo,
    pi,
    sin,
    sinh,
    sqrt,
    sympify,
)

from tests.proof.goals import (
    a,
    n,
    on,
    refused,
    step_on,
    t,
    u,
    x,
)
from xsec_sym.proof import interval
from xsec_sym.proof.calculus import bounded
from xsec_sym.proof.piece import Piece


@pytest.mark.parametrize(
    "expression",
    [
        sqrt(1 - u**2) ** 2 + u**2 - 1,
        log(2 * u / (1 + u)) - log(2) - log(u) + log(1 + u),
        exp(2 * u) - exp(u) ** 2,
        cosh(u) ** 2 - sinh(u) ** 2 - 1,
        acos(-u) + acos(u) - pi,
        erfc(-u) + erfc(u) - 2,
        erfc(u) + erf(u) - 1,
        asin(u) + acos(u) - pi / 2,
        sin(acos(u)) - sqrt(1 - u**2),
        Abs(u) - u,
        Max(0, -u),
        binomial(2 * n + 2, n + 1) * (n + 1) - binomial(2 * n, n) * 2 * (2 * n + 1),
        (u**2 - 1) ** (n + 1) * (-1) ** n + (1 - u**2) ** (n + 1),
        sqrt(8) - 2 * sqrt(2),
    ],
    ids=str,
)
def test_identities_reduce_to_zero(expression):
    assert on(interval(u, 0, 1, open=True)).is_zero(expression)


@pytest.mark.parametrize("expression", [u, sqrt(u**2 + 1) - u - 1, log(u) + u, exp(u) - 1 - u, sqrt(2) + sqrt(3)])
def test_what_is_not_zero_stays(expression):
    assert not on(interval(u, 0, 1, open=True)).is_zero(expression)


def test_no_sign_is_taken_for_granted():
    both = on(interval(u, -1, 1))
    assert both.sign(u) is None
    assert not both.is_zero(sqrt(u**2) - u)
    assert not both.is_zero(Abs(u) - u)
    assert both.sign(1 - u**2) == ">="
    assert on(interval(u, -1, 1, open=True)).sign(1 - u**2) == "+"


def test_branches_are_settled_only_by_facts():
    pieces = Piecewise((u, u > 0), (0, True))
    assert on(interval(u, 0, 1, open="left")).is_zero(pieces - u)
    assert not on(interval(u, -1, 1)).is_zero(pieces - u)
    assert on(interval(u, -1, 1)).is_zero(Max(0, u) - u * Heaviside(u))


# --- functions and their ranges -------------------------------------------------------------------------


def test_gamma_and_its_poles():
    here = Piece()
    assert here.is_zero(1 / gamma(-n)) and here.is_zero(1 / gamma(-n - 1))
    assert not here.is_zero(1 / gamma(n + 1)) and not here.is_zero(1 / gamma(1 - n))
    assert not here.is_zero(1 / gamma(Rational(1, 2) - n))
    assert not here.is_zero(gamma(-n) * 0 + gamma(1 - n) - (-n) * gamma(-n))  # both infinite


def test_an_arc_cosine_off_its_range_has_no_sign():
    here = on(interval(u, 2, 3))
    assert here.sign(acos(u)) is None and not here.is_zero(Abs(acos(u)) - acos(u))


def test_functions_that_leave_the_real_line_have_no_normal_form():
    small, large = interval(u, 0, Rational(1, 2)), interval(u, 2, 3)
    refused(step_on(Abs(acosh(u) ** 2), acosh(u) ** 2, small).close)
    refused(step_on(Abs(acos(u) ** 2), acos(u) ** 2, large).close)
    assert on(interval(u, -1, 1)).is_zero(acos(u) + acos(-u) - pi)


def test_what_is_not_defined_has_no_sign_and_no_equal():
    below = on(interval(u, -2, -1))
    assert below.sign(Max(0, sqrt(u))) is None and below.sign(Integral(Max(0, x * sqrt(u)), (x, 0, 1))) is None
    refused(step_on(S.NaN, S.NaN).close, match="not defined")


# --- integrals ------------------------------------------------------------------------------------------


def test_limits_that_share_the_variable():
    gap = Integral(Abs(x**2 - x) - (x**2 - x), (x, -1 - x**2, x**2))
    assert not Piece().is_zero(gap)


def test_an_infinite_range_is_not_taken_apart():
    """The terms 1 and H(x - 1) have no integral there, though their difference has."""
    whole = Integral(1 - Heaviside(x - 1), (x, 0, oo))
    assert not Piece().is_zero(whole - Integral(1, (x, 0, oo)) + Integral(Heaviside(x - 1), (x, 0, oo)))


def test_a_magnitude_may_be_unbounded():
    f, g = Abs(exp(1 / x) - 3), Abs(exp(1 / x) - 4)
    apart = Integral(f, (x, 0, 1)) - Integral(g, (x, 0, 1))
    assert not Piece().is_zero(Integral(f - g, (x, 0, 1)) - apart)


def test_a_root_of_one_less_a_square_of_a_cosine():
    first, third = on(interval(t, 0, pi, open=True)), on(interval(t, pi, 2 * pi, open=True))
    assert first.is_zero(sqrt(1 - cos(t) ** 2) - sin(t)) and not third.is_zero(sqrt(1 - cos(t) ** 2) - sin(t))
    assert not on(interval(t, -pi, pi)).is_zero(sqrt(1 - cos(t) ** 2) - sin(t))
    assert not first.is_zero(sqrt(1 - cos(2 * t) ** 2) - sin(2 * t))


def test_signs_of_cosines_and_sines():
    assert on(interval(t, -pi / 2, pi / 2, open=True)).sign(cos(t)) == "+"
    assert on(interval(t, -pi / 2, pi / 2)).sign(cos(t)) == ">="
    assert on(interval(t, -pi / 2, pi)).sign(cos(t)) is None
    assert on(interval(t, 0, 2 * pi)).sign(sin(t)) is None and on(interval(t, 0, 4)).sign(sin(t)) is None
    assert Piece().sign(1 - cos(t)) == ">=" and Piece().sign(1 + sin(t)) == ">=" and Piece().sign(cos(t)) is None


def test_what_is_bounded():
    def shown(e, low=0, high=1):
        return bounded(e, x, Piece().inside(x, sympify(low), sympify(high)))

    assert shown(besseli(n, x) * exp(x) / (1 + x)) and shown(hyper((), (2,), x))
    assert not shown(1 / x) and not shown(exp(1 / x)) and not shown(x, 0, oo) and not shown(besseli(a, x))
    assert not shown(hyper((), (x,), 1)) and not shown(hyper((), (-1,), x)) and not shown(log(x))
    assert not shown(Abs(1 / x)) and not shown(hyper((1,), (2,), x))


def test_an_integral_goes_on_beyond_its_end():
    left = Integral(exp(x), (x, 0, 1))
    step_on(left, Integral(exp(x), (x, 0, 2)) - Integral(exp(x), (x, 1, 2))).extend(2).close()
    refused(step_on(left, Integral(exp(x), (x, 0, 2))).extend(2).close)
    refused(step_on(left, 0).extend, -1, match="to lie above")
    refused(step_on(left, 0).extend, a, match="to lie above")
    refused(step_on(left, 0).extend, oo, match="bounded")
    refused(step_on(Integral(1 / (2 - x), (x, 0, 1)), 0).extend, 3, match="bounded")


def test_a_switch_is_settled_by_the_slope_of_what_does_not_jump():
    """x - atan(2) + atan(1 / (1/2 - x)) is 0 at 0 and rises, but falls by pi on the way."""
    jumps = atan(1 / (Rational(1, 2) - x)) + x - atan(2)
    refused(step_on(Integral(Abs(jumps), (x, 0, 1)), 0).split, match="vanish in a denominator")
    rises = atan(x) - atan(Rational(1, 3))
    step = step_on(Integral(Abs(rises), (x, Rational(1, 3), 1)), Integral(rises, (x, Rational(1, 3), 1)))
    step.split().close()
