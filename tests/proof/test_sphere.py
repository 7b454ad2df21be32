"""Symmetries of the circle, the torus and the sphere: what is true passes, what is nearly true does not."""

from __future__ import annotations

import pytest
from sympy import (
    Abs,
    Integral,
    Max,
    Mul,
    Rational,
    S,
    Sum,
    besseli,
    cos,
    exp,
    hyper,
    legendre,
    log,
    oo,
    pi,
    sin,
    sqrt,
)

from tests.proof.goals import (
    CIRCLE,
    CIRCLE_OF,
    LATE,
    SIGNED,
    a,
    b,
    l,
    n,
    on,
    over,
    phi,
    refused,
    step_on,
    t,
    u,
    x,
    z,
)
from xsec_sym.proof import interval
from xsec_sym.proof.piece import Piece

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


def test_broken_powers_of_a_cosine_have_no_beats():
    step = step_on(Integral(sqrt(cos(x)) * cos(2 * x) * cos(x), (x, 0, 1)), 0).beats()
    assert step.integrals[0].function == cos(x) ** Rational(3, 2) * cos(2 * x)


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

INCLINED = interval(u, -1, 1)


def cosine(towards, inclination=x, azimuth=phi):
    sines = sqrt(1 - towards**2) * sqrt(1 - inclination**2)
    return towards * inclination + sines * cos(azimuth)


def sphere(f, g=1):
    """f may depend on the azimuth, g only on the inclination."""
    return Integral(g * Integral(f, (phi, *CIRCLE)), (x, -1, 1))


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
