"""Symmetries, series and inductions: what is true passes, what is nearly true does not, and no attack does."""

from __future__ import annotations

import pytest
from sympy import (
    Abs,
    Function,
    Heaviside,
    I,
    Integral,
    Limit,
    Max,
    Mul,
    Rational,
    S,
    Sum,
    Symbol,
    acos,
    acosh,
    atan,
    besseli,
    cos,
    exp,
    factorial,
    gamma,
    hyper,
    legendre,
    log,
    oo,
    pi,
    sin,
    sqrt,
    symbols,
    sympify,
)

from xsec_sym.proof import Refused, Source, integers, interval, parity
from xsec_sym.proof.calculus import bounded
from xsec_sym.proof.domain import domain
from xsec_sym.proof.magnitude import Magnitude
from xsec_sym.proof.piece import Piece
from xsec_sym.proof.rules import start as opening
from xsec_sym.proof.steps import Step

a, b, t, u, w, x, y, z, phi = symbols("a b t u w x y z varphi", real=True)
j, l, m, n = symbols("j l m n", integer=True, nonnegative=True)
LATE = Symbol("late", integer=True, positive=True)  # counts from 1, whatever a sum over it says
SIGNED = Symbol("signed", positive=True)  # positive, whatever a range says
POSITIVE = interval(a, 0, oo, open=True)
CIRCLE = (0, 2 * pi)


def on(*ranges):
    return Piece.of(domain(ranges))


def claim(label, left, form, *where):
    return Source("sphere").claim(label, "a lemma", left=left, corrected=form, where=where, statement=True)


def step_on(left, right, *ranges, claims=()):
    goal = opening(sympify(left), sympify(right), domain(ranges))
    return Step(goal, {one.id: one for one in claims}, [])


def refused(attack, *args, match=None, **rest):
    with pytest.raises(Refused, match=match):
        attack(*args, **rest)


def over(step, symbol):
    """The integral over a symbol, wherever it stands on the left."""
    return next(i for i in step.left.atoms(Integral) if i.limits[-1][0] == symbol)


# --- the circle -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("high", [pi, 2 * pi])
def test_a_bessel_function_is_an_integral_over_the_angle(high):
    wave = Integral(exp(z * cos(t)) * cos(n * t), (t, 0, high))
    step_on(wave, high * besseli(n, z)).bessel(n, z).close()
    step_on(3 * wave, 3 * high * besseli(n, z)).bessel(n, z).close()
    refused(step_on(wave, 2 * high * besseli(n, z)).bessel(n, z).close)
    refused(step_on(wave, high * besseli(n, -z)).bessel(n, z).close)
    refused(step_on(wave, high * besseli(n + 1, z)).bessel(n, z).close)
    refused(step_on(wave, high * besseli(n, z)).bessel, n, -z, match="is not")
    refused(step_on(wave, high * besseli(n, z)).bessel, n + 1, z, match="is not")


def test_such_an_integral_wants_a_whole_order_and_a_whole_range():
    for low, high in ((0, pi / 2), (-pi, 0), (0, 4 * pi), (pi, 2 * pi)):
        refused(step_on(Integral(exp(z * cos(t)), (t, low, high)), 0).bessel, 0, z, match="once nor half")
    refused(step_on(Integral(exp(z * cos(t)) * cos(t / 2), CIRCLE_OF(t)), 0).bessel, S.Half, z, match="integer")
    refused(step_on(Integral(exp(z * cos(t)) * cos(a * t), CIRCLE_OF(t)), 0).bessel, a, z, match="integer")
    refused(step_on(Integral(exp(t * cos(t)), CIRCLE_OF(t)), 0).bessel, 0, t, match="variable of integration")
    refused(step_on(Integral(t * exp(cos(t)), CIRCLE_OF(t)), 0).bessel, 0, 1, t, match="variable of integration")


def CIRCLE_OF(angle):
    return (angle, *CIRCLE)


def test_and_back():
    step = step_on(besseli(n, z), besseli(n, z)).wave(besseli(n, z), t)
    step.bessel(n, z).close()
    refused(step_on(besseli(a, z), 0).wave, besseli(a, z), t, match="integer")
    refused(step_on(besseli(n, z) + t, 0).wave, besseli(n, z), t, match="already")
    refused(step_on(besseli(n, z), 0).wave, besseli(n + 1, z), t, match="not a Bessel")
    refused(step_on(besseli(n, z), 0).wave, besseli(n, z), LATE, match="plain")


def test_bessel_functions_of_neighbouring_orders():
    here = on(interval(z, 0, oo, open=True))
    assert here.is_zero(besseli(n, z) - besseli(n + 2, z) - 2 * (n + 1) / z * besseli(n + 1, z))
    assert here.is_zero(besseli(3, z) - besseli(1, z) + 4 / z * besseli(2, z))
    assert not here.is_zero(besseli(n, z) - besseli(n + 2, z) - 2 * n / z * besseli(n + 1, z))
    assert here.is_zero(besseli(n, -z) - (-1) ** n * besseli(n, z))
    assert not here.is_zero(besseli(1, -z) - besseli(1, z))
    assert here.is_zero(besseli(n - 3, z) - besseli(n - 1, z) - 2 * (n - 2) / z * besseli(n - 2, z))
    assert here.is_zero(hyper((), (1,), z**2 / 4) - besseli(0, z))
    assert here.is_zero(hyper((), (2,), z**2 / 4) - 2 * besseli(1, z) / z)
    assert not here.is_zero(hyper((), (2,), z**2 / 4) - besseli(1, z) / z)
    assert here.sign(besseli(n, z)) == "+" and here.sign(besseli(1, -z)) == "-" and here.sign(besseli(n, -z)) is None
    assert here.sign(besseli(a, z)) is None


def test_a_bessel_function_off_the_real_line_has_no_sign():
    below = on(interval(z, -100, -1))
    assert below.sign(besseli(0, sqrt(z))) is None  # J_0, which oscillates
    assert below.sign(besseli(0, log(z))) is None
    assert below.sign(exp(sqrt(z) + 1) - exp(sqrt(z))) is None
    refused(step_on(Abs(besseli(0, sqrt(z))), besseli(0, sqrt(z)), interval(z, -100, -1)).settle)


def test_legendre_polynomials_of_neighbouring_degrees():
    here = Piece()
    p = [legendre(l + i, x, evaluate=False) for i in range(3)]
    assert here.is_zero((l + 2) * p[2] - (2 * l + 3) * x * p[1] + (l + 1) * p[0])
    assert not here.is_zero((l + 2) * p[2] - (2 * l + 3) * x * p[1] + (l + 2) * p[0])
    assert here.is_zero(legendre(2, x, evaluate=False) - (3 * x**2 - 1) / 2)


def test_products_of_cosines():
    step = step_on(Integral(cos(2 * x) * cos(x), (x, 0, a)), sin(3 * a) / 6 + sin(a) / 2).beats()
    assert step.integrals[0].function == cos(3 * x) / 2 + cos(x) / 2


def test_beats_split_no_integral_inside():
    """Expanding takes an inner integral of a sum apart, and its terms need not exist."""
    inner = Integral(exp(1 / t) - exp(1 / t) * cos(t), (t, 0, 1))
    refused(step_on(Integral(cos(x) ** 2 * inner, (x, 0, 1)), 0).beats, match="integral")


# --- the torus ------------------------------------------------------------------------------------------


def torus(f):
    return Integral(f, (t, *CIRCLE), (x, *CIRCLE))


def test_a_torus_may_be_sheared():
    whole = torus(exp(z * cos(x) * cos(t)))
    step = step_on(whole, 4 * pi**2 * besseli(0, z / 2) ** 2).shear(a, b, exp(z / 2 * cos(a) + z / 2 * cos(b)))
    assert step.left == Integral(exp(z / 2 * cos(a) + z / 2 * cos(b)), (a, *CIRCLE), (b, *CIRCLE))
    refused(step_on(whole, 0).shear, a, b, exp(z * cos(a) + z * cos(b)), match="sheared form")
    refused(step_on(whole, 0).shear, a, b, exp(z / 2 * cos(a) - z / 2 * cos(b)), match="sheared form")
    refused(step_on(torus(exp(cos(x / 2))), 0).shear, a, b, exp(cos(a / 2 + b / 2)), match="period|continuous")
    refused(step_on(torus(cos(x) ** 2 + x), 0).shear, a, b, cos(a), match="continuous")
    half = Integral(cos(x) * cos(t), (t, *CIRCLE), (x, 0, pi))
    refused(step_on(half, 0).shear, a, b, cos(a) / 2 + cos(b) / 2, match="torus")


def test_the_sheared_form_knows_nothing_of_the_old_angles():
    whole = t * torus(cos(t) ** 2)
    refused(step_on(whole, 0).shear, a, b, (cos(t) ** 2 + cos(a - t) ** 2) / 2)


def test_new_variables_are_plain():
    """A symbol that SymPy takes for positive or whole simplifies what it replaces."""
    refused(step_on(Integral(Abs(x), (x, -1, 1)), 0).substitute, SIGNED, SIGNED, -1, 1, match="plain")
    refused(step_on(torus(cos(x + t)), 0).shear, LATE, b, cos(LATE), match="plain")
    bell = Integral(exp(-(x**2) - t**2), (x, -oo, oo), (t, -oo, oo))
    refused(step_on(bell, 0).polar, a, LATE, match="plain")


# --- the sphere -----------------------------------------------------------------------------------------


def cosine(towards, inclination=x, azimuth=phi):
    sines = sqrt(1 - towards**2) * sqrt(1 - inclination**2)
    return towards * inclination + sines * cos(azimuth)


def sphere(f, g=1):
    """f may depend on the azimuth, g only on the inclination."""
    return Integral(g * Integral(f, (phi, *CIRCLE)), (x, -1, 1))


INCLINED = interval(u, -1, 1)


def test_a_turn_of_the_sphere():
    step = step_on(sphere(exp(cosine(u))), 2 * pi * (exp(1) - exp(-1)), INCLINED).turn(u)
    step.antiderivative(phi, over(step, phi)).antiderivative(2 * pi * exp(x)).close()
    refused(step_on(sphere(exp(cosine(u))), 0, interval(u, -2, 2)).turn, u, match="to be a cosine")
    refused(step_on(sphere(exp(cosine(u))), 0, INCLINED).turn, -u, match="otherwise")
    refused(step_on(sphere(cosine(u)), 0, INCLINED).turn, u, match="keep its sign")
    refused(step_on(sphere(exp(cosine(u) * cos(phi))), 0, INCLINED).turn, u, match="otherwise")
    half = Integral(exp(x) * Integral(exp(cosine(u)), (phi, 0, pi)), (x, -1, 1))
    refused(step_on(half, 0, INCLINED).turn, u, match="once around")
    upper = Integral(exp(x) * Integral(exp(cosine(u)), (phi, *CIRCLE)), (x, 0, 1))
    refused(step_on(upper, 0, INCLINED).turn, u, match="from -1 to 1")


def test_a_turn_captures_no_name():
    """F(x, c) holds an integral over u, and the direction is called u too."""
    inner = Integral(exp(u * x), (u, 0, 1))
    refused(step_on(sphere(exp(cosine(u)) + inner), 0, INCLINED).turn, u, match="twice|captured")
    mixed = Integral(exp(cosine(u)), (u, 0, 1))
    refused(step_on(sphere(exp(cosine(u)) + mixed), 0, INCLINED).turn, u, match="twice|captured")


def test_the_series_of_funk_and_hecke():
    bell = exp(x)
    step = step_on(sphere(Max(0, cosine(u)), bell), 0, INCLINED).funk_hecke(u, l)
    term = pi * (2 * l + 1) * legendre(l, u, evaluate=False)
    moments = [Integral(f * legendre(l, x, evaluate=False), (x, -1, 1)) for f in (bell, Max(0, x))]
    assert step.left == Sum(term * Mul(*moments), (l, 0, oo))
    refused(step_on(sphere(Max(0, cosine(u)), 1 / (1 - x)), 0, INCLINED).funk_hecke, u, l, match="bounded")
    refused(step_on(sphere(Max(1, cosine(u)), bell), 0, INCLINED).funk_hecke, u, l, match="clamped")
    refused(step_on(sphere(Max(0, cosine(u)), bell), 0, INCLINED).funk_hecke, -u, l, match="cosine")
    refused(step_on(sphere(Max(0, cosine(u)), bell), 0, INCLINED).funk_hecke, u, LATE, match="0, 1, 2")


def test_the_azimuth_is_no_cosine():
    refused(step_on(sphere(Max(0, phi), exp(x)), 0, INCLINED).funk_hecke, u, l, match="cosine")


# --- series ---------------------------------------------------------------------------------------------


def series(f, index=j):
    return Sum(f, (index, 0, oo))


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


def test_gamma_and_its_poles():
    here = Piece()
    assert here.is_zero(1 / gamma(-n)) and here.is_zero(1 / gamma(-n - 1))
    assert not here.is_zero(1 / gamma(n + 1)) and not here.is_zero(1 / gamma(1 - n))
    assert not here.is_zero(1 / gamma(Rational(1, 2) - n))
    assert not here.is_zero(gamma(-n) * 0 + gamma(1 - n) - (-n) * gamma(-n))  # both infinite


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


def test_what_is_known_of_a_name_is_not_known_of_a_bound_one():
    """Telescoping inside an integral over y < 0, where the claim's own y is positive."""
    total = Sum(Abs(y) * j, (j, 0, n))
    left = y + Integral(total, (y, -1, 0))
    refused(step_on(left, 0, interval(y, 0, 1, open=True)).telescope, y * j * (j + 1) / 2, total)


# --- integrals in the normal form -----------------------------------------------------------------------


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


# --- names, contexts, lemmas ----------------------------------------------------------------------------


def test_one_integral_in_two_places():
    """On the left y is positive, on the right negative; the same inner integral stands on both sides."""
    inner = Integral(Abs(y) * x, (x, 0, 1))
    left = Integral((1 + y) * inner, (y, 0, 1)) + Integral((1 + y) * inner, (y, -1, 0))
    refused(step_on(left, 0).antiderivative, y * x**2 / 2, inner, match="two places")
    free = inner + Integral((1 + y) * inner, (y, -1, 0))
    refused(step_on(free, 0, interval(y, 0, 1, open=True)).antiderivative, y * x**2 / 2, inner, match="two places")
    twice = inner + inner**2
    step_on(twice, 0, interval(y, 0, 1, open=True)).antiderivative(y * x**2 / 2, inner)


def test_what_is_noted_of_an_integrand_speaks_of_no_other_variable():
    """Noted between x = 0 and 1 where y > 0, it is not so where y runs from -1 to 0."""
    inner = Integral(Abs(y) * x, (x, 0, 1))
    left = y + Integral((2 + y) * inner, (y, -1, 0))
    step = step_on(left, 0, interval(y, 0, 1, open=True)).fact(y * x, inside=(x, 0, 1))
    refused(step.rewrite, Abs(y) * x, y * x)
    limits = Integral(Abs(x) + x, (x, 0, y))
    left = y + Integral((2 + y) * limits, (y, -1, 0))
    step = step_on(left, 0, interval(y, 0, 1, open=True)).fact(x, inside=(x, 0, y))
    refused(step.rewrite, Abs(x), x)


def test_a_case_captures_no_name():
    """x is also the name of a variable of integration."""
    left = Integral(x * y, (x, 0, 1)) + x
    on_y = step_on(left, 0, interval(x, 0, 1), interval(y, 0, 1))
    refused(lambda: next(on_y.cases(y - x, y, x)), match="captured")


def test_a_substitution_captures_no_name():
    inner = Integral(x * y, (y, 0, 1))
    left = y + Integral(exp(x) * inner, (x, 0, 1))
    bent = t + y * t * (1 - t) / 2
    refused(step_on(left, 0, interval(y, 0, 1)).substitute, t, bent, 0, 1, match="captured")


def test_nothing_comes_from_nothing():
    """Two sums, or integrals, without a value cancel; brought in from nowhere, they would prove anything."""
    ones = series(1) - series(S.One, m)
    refused(step_on(0, 1).rewrite, 0, ones, match="brings in")
    pole = Integral(1 / x, (x, 0, 1)) - Integral(1 / y, (y, 0, 1))
    refused(step_on(0, log(2)).rewrite, 0, pole, match="brings in")


def test_a_mapping_maps_names():
    square = claim("square", (w + 1) ** 2, w**2 + 2 * w + 1)
    refused(step_on((w + 1) ** 2, 2 * w + 6, claims=[square]).lemma, square, {w**2: 5}, match="name")


def test_a_mapping_keeps_to_what_a_name_stands_for():
    real = claim("real", Abs(w) ** 2, w**2, interval(w, -oo, oo))
    refused(step_on(1, -1, claims=[real]).lemma, real, {w: I})
    above = claim("step", Heaviside(1 / w), 1, interval(w, 0, oo, open=True))
    refused(step_on(Rational(1, 2), 1, claims=[above]).lemma, above, {w: oo})
    order = claim("order", Integral(exp(z * cos(t)) * cos(n * t), CIRCLE_OF(t)), 2 * pi * besseli(n, z))
    half = order.left.subs(n, Rational(1, 2))
    refused(step_on(half, 2 * pi * besseli(S.Half, z), claims=[order]).lemma, order, {n: S.Half})
    refused(step_on(half.subs(S.Half, a), 0, claims=[order]).lemma, order, {n: a})
    step_on(order.left.subs(n, m + 1), 2 * pi * besseli(m + 1, z), claims=[order]).lemma(order, {n: m + 1}).close()


def test_a_lemma_read_backwards_keeps_to_its_domain():
    one = claim("one", w / Abs(w), 1, interval(w, 0, 1, open=True))
    refused(step_on(y, 0, claims=[one]).lemma, one, {w: y}, back=True, match="does not occur")
    refused(step_on(1 + y, 0, interval(y, -1, 0), claims=[one]).lemma, one, {w: y}, back=True, match="not shown")
    refused(step_on(S.One, 0, claims=[one]).lemma, one, back=True)
    step_on(1 + y, 1 + y, interval(y, 0, 1, open=True), claims=[one]).lemma(one, {w: y}, back=True).close()


def test_a_lemma_holds_inside_a_sum():
    square = claim("inside", Abs(w), w, interval(w, 0, oo))
    shifted = series(Abs(j + a, evaluate=False) * b**j)
    step_on(shifted, series((j + a) * b**j), POSITIVE, claims=[square]).lemma(square, {w: j + a}).close()
    index = integers(Symbol("i")).index
    bad = series(Abs(index - 2) * b**index, index) + index
    refused(step_on(bad, 0, index > 2, claims=[square]).lemma, square, {w: index - 2}, match="natural")
    early = Sum(Abs(LATE - 1) * b**LATE, (LATE, 0, oo))
    if early.has(Abs):
        refused(step_on(early, 0, claims=[square]).lemma, square, {w: LATE - 1}, match="natural")


def test_nothing_is_rewritten_under_another_binder():
    under = Limit(Heaviside(x), x, 0) + x
    refused(step_on(under, 0, interval(x, 0, 1, open=True)).rewrite, Heaviside(x), 1)


def test_a_sign_noted_with_a_lemma_read_backwards():
    f = Function("f")(w)
    given = claim("sign", Magnitude(f), f, interval(w, 0, 1))
    step = step_on(Abs(f), f, interval(w, 0, 1), claims=[given]).fact(f, by=given, back=True)
    step.close()
    refused(step_on(Abs(f), f, interval(w, 0, 2), claims=[given]).fact, f, by=given, back=True, match="not shown")
    refused(step_on(Abs(f), f, interval(w, 0, 1), claims=[given]).fact, f, by=given)


def test_an_arc_cosine_off_its_range_has_no_sign():
    here = on(interval(u, 2, 3))
    assert here.sign(acos(u)) is None and not here.is_zero(Abs(acos(u)) - acos(u))


def test_sums_inside_sums_keep_their_indices_apart():
    assert not Piece().is_zero(series(b**j * series((j - m) * a**m, m)))
    assert Piece().is_zero(series(b**j * series((j - m) * a**m, m)) - series(b**n * series((n - l) * a**l, l), n))


def test_a_sum_does_not_run_backwards():
    """By the usual convention it stands for terms of negative index, of which nothing is known."""
    backwards = Sum(Max(-j - 3, 0) * a**j, (j, 0, -5 - n))
    assert not Piece().is_zero(backwards)
    refused(step_on(backwards, 0).rewrite, Max(-j - 3, 0), 0, match="backwards")
    refused(step_on(backwards, 0).telescope, 0, backwards, match="backwards")


def test_a_member_and_its_index_belong_together():
    """The lemma speaks of f at p = 2 n + 1, in p on the left and in n on the right."""
    odd = parity(Symbol("p", integer=True), odd=True)
    f, index, member = Function("f"), odd.index, odd.symbol
    given = claim("member", f(member), f(2 * index + 1), odd)
    false = step_on(f(2 * m + 1) + index, f(2 * index + 1) + index, claims=[given])
    refused(lambda: false.lemma(given, {member: 2 * m + 1}).close())
    false = step_on(f(2 * index + 1) + m, f(2 * m + 1) + m, claims=[given])
    refused(false.lemma, given, {index: m}, match="does not occur")
    refused(false.lemma, given, {member: 2 * index + 1, index: m}, match="counts")
    step_on(f(2 * m + 1), f(2 * m + 1), claims=[given]).lemma(given, {index: m}).close()


def test_functions_that_leave_the_real_line_have_no_normal_form():
    small, large = interval(u, 0, Rational(1, 2)), interval(u, 2, 3)
    refused(step_on(Abs(acosh(u) ** 2), acosh(u) ** 2, small).close)
    refused(step_on(Abs(acos(u) ** 2), acos(u) ** 2, large).close)
    assert on(interval(u, -1, 1)).is_zero(acos(u) + acos(-u) - pi)


def test_a_switch_is_settled_by_the_slope_of_what_does_not_jump():
    """x - atan(2) + atan(1 / (1/2 - x)) is 0 at 0 and rises, but falls by pi on the way."""
    jumps = atan(1 / (Rational(1, 2) - x)) + x - atan(2)
    refused(step_on(Integral(Abs(jumps), (x, 0, 1)), 0).split, match="vanish in a denominator")
    rises = atan(x) - atan(Rational(1, 3))
    step = step_on(Integral(Abs(rises), (x, Rational(1, 3), 1)), Integral(rises, (x, Rational(1, 3), 1)))
    step.split().close()


def test_broken_powers_of_a_cosine_have_no_beats():
    step = step_on(Integral(sqrt(cos(x)) * cos(2 * x) * cos(x), (x, 0, 1)), 0).beats()
    assert step.integrals[0].function == cos(x) ** Rational(3, 2) * cos(2 * x)


def test_what_is_not_defined_has_no_sign_and_no_equal():
    below = on(interval(u, -2, -1))
    assert below.sign(Max(0, sqrt(u))) is None and below.sign(Integral(Max(0, x * sqrt(u)), (x, 0, 1))) is None
    refused(step_on(S.NaN, S.NaN).close, match="not defined")


def test_nothing_is_reckoned_with_what_is_infinite():
    pole = Integral(1 / x, (x, 0, 1))
    given = claim("infinite", pole, oo)
    f = Function("f")
    refused(step_on(f(1 / pole), f(0), claims=[given]).lemma, given, match="infinite")
    step_on(pole, oo, claims=[given]).lemma(given).close()


def test_the_names_of_a_normal_form_are_its_own():
    typed = Symbol("i#1", integer=True, nonnegative=True)
    refused(step_on, series((typed - m) * a**m, m), 0, match="names")
