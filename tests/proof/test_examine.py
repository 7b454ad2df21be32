"""Equations of a user's own: what is proved without an idea, and what is tried."""

import pytest
from sympy import Integer, Integral, Rational, Sum, Symbol, atan, cosh, erf, exp, factorial, oo, pi, sin, sqrt, symbols

from xsec_sym.proof import Source, interval
from xsec_sym.proof.balls import NoEnclosure, enclose
from xsec_sym.proof.examine import examine
from xsec_sym.proof.verify import verify

x, t = symbols("x t", real=True)
k = Symbol("k", integer=True)


def equation(left, right, *where):
    return Source("examined").claim("1", "a test", left=left, printed=right, where=where)


@pytest.mark.parametrize(
    ("left", "right"),
    [
        (Integral(exp(-(t**2)), (t, 0, x)), sqrt(pi) * erf(x) / 2),
        (pi / 2 - atan(x), Integral(1 / (1 + t**2), (t, x, oo))),
    ],
)
def test_an_integral_up_to_a_variable_is_proved_by_the_other_side(left, right):
    verdict = examine(equation(left, right, interval(x, -3, 4)))
    assert verdict.verdict == "proved" and any("has the derivative wanted" in said for _, said in verdict.steps)


@pytest.mark.parametrize(
    ("term", "value"),
    [(x**k, 1 / (1 - x)), (k * x**k, x / (1 - x) ** 2), (x ** (2 * k) / factorial(2 * k), cosh(x))],
)
def test_a_power_series_is_tried_at_0_as_well(term, value):
    """There all its terms but the first are 0, and no ratio of terms exists."""
    claim = equation(Sum(term, (k, 0, oo)), value, interval(x, -Rational(1, 2), Rational(1, 2)))
    assert verify(claim, {}).verdict == "confirmed"
    at_0 = enclose(Sum(term.subs(x, 0), (k, 0, oo)))
    assert at_0.contains(int(value.subs(x, 0))) and at_0.rad() < 1e-30


def test_a_series_of_zeros_and_a_pole_is_refused():
    with pytest.raises(NoEnclosure):
        enclose(Sum(Integer(0) ** k / (k - 3), (k, 0, oo)))


def test_a_tiny_difference_is_shown_with_the_digits_that_differ():
    witness = verify(equation(sin(x), sin(x) + Rational(1, 10**28), interval(x, 1, 2)), {}).witness
    assert witness["left"] != witness["right"]
