"""Series, sums and inductions: what is true passes, what is nearly true does not, and no attack does."""

from __future__ import annotations

from sympy import (
    Abs,
    Heaviside,
    Integral,
    Max,
    Rational,
    Sum,
    Symbol,
    cos,
    exp,
    factorial,
    oo,
    pi,
    sin,
    sqrt,
)

from tests.proof.goals import (
    CIRCLE_OF,
    LATE,
    POSITIVE,
    a,
    b,
    claim,
    j,
    l,
    m,
    n,
    on,
    refused,
    series,
    step_on,
    t,
    x,
    y,
    z,
)
from xsec_sym.proof import integers, interval
from xsec_sym.proof.magnitude import Magnitude
from xsec_sym.proof.piece import Piece

# --- series ---------------------------------------------------------------------------------------------


def test_an_integral_by_a_taylor_series():
    left, value = Integral(exp(y**2), (y, 0, 1)), 1 / (factorial(j) * (2 * j + 1))
    script = {"weight": 1, "inner_map": y**2, "z": z, "index": j, "family": exp(z), "moment": y ** (2 * j + 1)}
    right = {**script, "moment": y ** (2 * j + 1) / (2 * j + 1)}
    step_on(left, series(value)).taylor(**right).close()
    refused(step_on(left, series(2 * value)).taylor(**right).close)
    refused(step_on(left, series(value)).taylor, **script, match="derivative of")
    for wrong in (exp(2 * z), exp(z) + j, exp(-z)):
        refused(step_on(left, 0).taylor, **{**right, "family": wrong})
    refused(step_on(Integral(1 / (1 + y**2), (y, 0, 1)), 0).taylor,
            **{**right, "family": (-1) ** j * factorial(j) / (1 + z) ** (j + 1)}, match="entire")  # fmt: skip
    refused(step_on(left, 0).taylor, **{**right, "inner_map": sqrt(y)}, match="polynomials")
    infinite = Integral(exp(-y), (y, 0, oo))
    refused(step_on(infinite, 0).taylor, **{**right, "inner_map": -y}, match="bounded")


def test_a_taylor_series_goes_on_from_its_first_member():
    """From 1 on the family is right; but its first member has another derivative."""
    first = exp(z) + z * Heaviside(Rational(1, 2) - LATE)
    data = {"weight": 1, "inner_map": y, "z": z, "index": LATE, "family": first, "moment": y ** (LATE + 1) / (LATE + 1)}
    left = Integral(exp(y) + y, (y, 0, 1))
    refused(step_on(left, 0).taylor, **data, match="0, 1, 2")
    index = integers(Symbol("i")).index
    late = exp(z) + z * Heaviside(Rational(1, 2) - index)
    data |= {"index": index, "family": late, "moment": y ** (index + 1) / (index + 1)}
    refused(step_on(left, 0, index > 2).taylor, **data, match="known of")


def test_an_even_wave_by_its_fourier_series():
    wave = Integral(exp(z * cos(t) ** 2) * cos(t) * cos((2 * j + 1) * t), CIRCLE_OF(t))
    given = claim("fourier", wave, exp(z) * (2 * j + 1))  # the value is of no matter here
    left = Integral(exp(z * cos(x) ** 2) * cos(x), (x, 0, a))
    right = series(exp(z) / pi * sin((2 * j + 1) * a))
    step_on(left, right, claims=[given]).harmonics(j, given).close()
    refused(step_on(left, 2 * right, claims=[given]).harmonics(j, given).close)
    refused(step_on(Integral(cos(x) ** 2, (x, 0, a)), 0, claims=[given]).harmonics, j, given, match="pi - x")
    refused(step_on(Integral(sin(x), (x, 0, a)), 0, claims=[given]).harmonics, j, given, match="even")
    refused(step_on(Integral(1 / cos(x), (x, 0, a)), 0, claims=[given]).harmonics, j, given, match="vanish")
    refused(step_on(Integral(cos(x), (x, 0, a)), 0, claims=[given]).harmonics, j, given, match="coefficient")
    refused(step_on(Integral(cos(x) * exp(z * cos(x) ** 2), (x, 1, a)), 0, claims=[given]).harmonics, j, given)


def test_a_coefficient_captures_no_parameter():
    """The parameter t of the wave t cos(x) is not the variable t of the lemma."""
    given = claim("capture", Integral(t * cos(t) * cos((2 * j + 1) * t), CIRCLE_OF(t)), pi)
    left = Integral(t * cos(x), (x, 0, a))
    refused(step_on(left, 0, interval(t, 0, 1), claims=[given]).harmonics, j, given, match="twice")


def test_the_first_terms_of_a_sum():
    whole = series(a**j / factorial(j))
    step_on(whole, 1 + series(a ** (j + 1) / factorial(j + 1))).peel().close()
    refused(step_on(whole, series(a ** (j + 1) / factorial(j + 1))).peel().close)
    refused(step_on(Sum(a**j, (j, 1, oo)), 0).peel, 1, Sum(a**j, (j, 1, oo)), match="from 0")
    refused(step_on(whole, 0).peel, Rational(1, 2), match="number of terms")
    inner = series(b**j * Sum(a ** (j * m), (m, 0, 3)))
    refused(step_on(m * inner, 0).peel, m, inner, match="captured")


def test_a_geometric_bound():
    terms = series(Rational(1, 3) ** j / (j + 1))
    step_on(Abs(2 - terms), 2 - terms).dominate(1, Rational(1, 3), terms).close()
    refused(step_on(Abs(1 - terms), 1 - terms).dominate(1, Rational(1, 3), terms).close)
    refused(step_on(terms, 0).dominate, 1, Rational(1, 4), terms, match="at least 0")
    refused(step_on(terms, 0).dominate, Rational(1, 2), Rational(1, 3), terms, match="at least 0")
    refused(step_on(terms, 0).dominate, 1, 1, terms, match="0, 1")
    refused(step_on(terms, 0).dominate, 1, a, terms, match="0, 1")
    refused(step_on(terms, 0).dominate, j + 1, Rational(1, 3), terms, match="depends on j")


def test_the_index_of_a_bound_is_any_natural_number():
    """Of the claim's own index it is known that it is at least 3; of the sum's, only its name is the same."""
    index = integers(Symbol("i")).index
    terms = series(Max(0, 3 - index) * 100 * Rational(1, 3) ** index, index)
    refused(step_on(terms + index, 0, index > 2).dominate, 1, Rational(1, 3), terms, match="known of")
    from_one = series(Max(0, 1 - LATE) * 100 + Rational(1, 3) ** LATE, LATE)
    refused(step_on(from_one, 0).dominate, 1, Rational(1, 3), from_one)


def test_an_induction():
    square = n**2 + n
    step_on(Magnitude(square), square).induct(n, 1, 2 * n + 2)
    refused(step_on(Magnitude(square - 1), square - 1).induct, n, 1, 2 * n + 2, match="at least 0")
    refused(step_on(Magnitude(square), square).induct, n, -1, 2 * n + 2)
    refused(step_on(Magnitude(square), square).induct, n, 1, 2 * n + 1, match="sum of")
    refused(step_on(Magnitude(-square), -square).induct, n, 1, -2 * n - 2, match="at least 0")
    refused(step_on(square, square).induct, n, 1, 2 * n + 2, match="does not say")


def test_an_induction_starts_at_its_base():
    """At 0 the expression is 1/2, at 1 it is -1/2, and from 1 on it grows."""
    skips = (LATE - 1) ** 2 - Rational(1, 2)
    refused(step_on(Magnitude(skips), skips).induct, LATE, 1, 2 * LATE - 1, match="0, 1, 2")
    index = integers(Symbol("i")).index
    late = (index - 1) ** 2 - Rational(1, 2)
    refused(step_on(Magnitude(late), late, index > 2).induct, index, 1, 2 * index - 1, match="known of")


# --- sums in the normal form ----------------------------------------------------------------------------


def test_sums_by_their_terms():
    here = Piece()
    assert here.is_zero(series(3 * a * Rational(1, 2) ** j) - 3 * a * series(Rational(1, 2) ** m, m))
    assert here.is_zero(Sum(a**j, (j, 1, oo)) - a * series(a**j))
    assert not here.is_zero(Sum(a**j, (j, 1, oo)) - series(a**j))
    assert here.is_zero(Sum(a**j, (j, 0, n + 1)) - Sum(a**j, (j, 0, n)) - a ** (n + 1))


def test_the_index_of_a_sum_is_its_own():
    index = integers(Symbol("i")).index
    here = on(index > 2)
    gap = Sum((Abs(index - 2) - index + 2) * a**index, (index, 0, oo))
    assert not here.is_zero(gap)
    finite = Sum((Abs(index - 2) - index + 2) * a**index, (index, 0, n))
    assert not here.is_zero(finite)
    refused(step_on(index + gap, index, index > 2).settle().close)


def test_an_index_that_is_taken_for_positive():
    assert not Piece().is_zero(Sum(Heaviside(LATE - 1) * a**LATE, (LATE, 1, oo)) - Sum(a**j, (j, 1, oo)))


def test_a_sum_without_a_beginning_has_no_normal_form():
    assert not Piece().is_zero(Sum(1 / (j**2 + 1), (j, -oo, oo)))


def test_an_end_that_the_terms_bind():
    nested = Sum(Sum(j * n * a**n, (n, 0, m)), (j, 0, n + 1))
    step = Sum(Sum(j * n * a**n, (n, 0, m)), (j, 0, n)) + Sum((n + 1) * n * a**n, (n, 0, m))
    assert not Piece().is_zero(nested - step)


def test_halves_of_a_sum_that_only_just_converges():
    """log(2) = 1 - 1/2 + 1/3 - ... has two halves that do not converge, and their difference may be anything."""
    whole = series((-1) ** j / (j + 1))
    refused(step_on(whole, series(1 / (2 * j + 1)) - series(1 / (j + 1)) / 2).parities, match="converge absolutely")
    step_on(series(a**j), series(a ** (2 * j)) + a * series(a ** (2 * j)), POSITIVE).parities().close()
    refused(step_on(series(a**j), 2 * series(a ** (2 * j)), POSITIVE).parities().close)


def test_a_sum_without_an_end_does_not_telescope():
    """The primitive is 1 wherever the index goes, but not at infinity."""
    zero = series(Heaviside(1 / (j + 1)) - 1)
    refused(step_on(zero, -Rational(1, 2)).telescope, Heaviside(1 / (j + 2)), zero)


def test_sums_inside_sums_keep_their_indices_apart():
    assert not Piece().is_zero(series(b**j * series((j - m) * a**m, m)))
    assert Piece().is_zero(series(b**j * series((j - m) * a**m, m)) - series(b**n * series((n - l) * a**l, l), n))


def test_a_sum_does_not_run_backwards():
    """By the usual convention it stands for terms of negative index, of which nothing is known."""
    backwards = Sum(Max(-j - 3, 0) * a**j, (j, 0, -5 - n))
    assert not Piece().is_zero(backwards)
    refused(step_on(backwards, 0).rewrite, Max(-j - 3, 0), 0, match="backwards")
    refused(step_on(backwards, 0).telescope, 0, backwards, match="backwards")
