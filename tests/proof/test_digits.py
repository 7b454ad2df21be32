"""Decimal values agree with known ones and with the enclosures, and a divergent integral has none."""

import time

import mpmath
import pytest
import sympy as sp
from flint import arb
from mpmath import mp, mpf
from sympy import Abs, Heaviside, Integral, Max, Piecewise, Rational, S, Sum, cos, exp, log, oo, pi, sin, sqrt, symbols

from xsec_sym.proof.balls import enclose, precision
from xsec_sym.proof.digits import NoValue, value
from xsec_sym.proof.quadrature import tanh_sinh

x, y, n, phi = symbols("x y n phi")
tau, u = sqrt(91) / 10, Rational(3, 10)


def over(f, a, b):
    return Integral(f, (x, a, b))


ZOO = [
    sqrt(2) + pi ** Rational(1, 3) + S.EulerGamma * S.Catalan,
    sp.erf(Rational(1, 3)) * sp.gamma(Rational(2, 7)) + sp.erfc(3) / sp.erfi(1),
    sp.besselk(Rational(1, 3), 2) + sp.besseli(0, 1) - sp.besselj(2, 5) * sp.bessely(1, 3),
    sp.polylog(2, Rational(1, 3)) - sp.zeta(3) + sp.Ei(-1) + sp.expint(3, 2),
    sp.hyper((1, Rational(1, 2)), (Rational(3, 2),), -Rational(1, 4)) + sp.hyper((), (2,), 3),
    sp.legendre(7, Rational(1, 3), evaluate=False) + sp.chebyshevu(5, Rational(2, 3), evaluate=False),
    sp.elliptic_k(Rational(1, 3)) + sp.elliptic_e(Rational(1, 3)) + sp.elliptic_e(Rational(1, 2), Rational(1, 3)),
    sp.atan2(-1, -3) + sp.asin(Rational(1, 3)) + sp.acosh(3) + sp.asinh(-2) + sp.atanh(Rational(1, 3)),
    sp.binomial(Rational(7, 2), 2) + sp.rf(Rational(1, 3), 4) + sp.ff(Rational(7, 2), 3) + sp.loggamma(5),
    sp.CRootOf(x**5 - x - 1, 0),
    Max(pi, 3 + Rational(1, 7), evaluate=False) * sp.sign(sqrt(2) - Rational(3, 2)) + sp.floor(exp(2), evaluate=False),
    Piecewise((exp(1), Abs(Rational(3, 5)) < sqrt(1 - Rational(4, 5) ** 2)), (exp(2), True), evaluate=False),
    Sum(Rational(1, 3) ** n / n**2, (n, 1, oo)),
    Sum(1 / n, (n, 1, 50)),
    over(2 * sqrt(tau**2 - x**2) / (1 + x), -tau, tau),
    over(1 / sqrt(x), 0, 1),
    over(1 / sqrt(1 - x**2), -1, 1),
    over(log(x), 0, 1),
    over(x**x, 0, 1),
    over(exp(-(x**2)), -oo, oo),
    over(exp(-x) * log(x), 0, oo),
    over((1 + x**2) ** Rational(-3, 2), 1, oo),
    over(x**2 / (exp(x) - 1), 0, oo),
    over(sp.acos(x) / (2 + x), -1, 1),
    over(Max(0, 1 + 2 * cos(x)), 0, 2 * pi),
    over(Piecewise((x, Abs(x) < Rational(1, 2)), (exp(x), True)), -1, 1),
    over(Heaviside(sin(x)) * x, 0, 7),
    over(log(1 - x) / x, 0, 1),
]


@pytest.mark.parametrize("expr", ZOO)
def test_the_two_routes_agree(expr):
    ball, digits = enclose(expr, 30), value(expr, 30)
    with precision(300), mp.workdps(60):
        near = arb(mp.nstr(digits, 50))
        assert abs(ball - near) < 2 * arb(10) ** -30 * max(1, abs(ball).upper())
        assert abs(ball - near) < 2 * arb(10) ** -30 * abs(ball)


@pytest.mark.parametrize("digits", [15, 30, 60])
def test_digits_asked_for_are_delivered(digits):
    with mp.workdps(digits + 20):
        assert abs(value(over(sqrt(1 - x**2), -1, 1), digits) / (mp.pi / 2) - 1) < mpf(10) ** -digits
        assert abs(value(sp.erfc(5), digits) / mp.erfc(5) - 1) < mpf(10) ** -digits


@pytest.mark.parametrize(
    "expr",
    [
        over(1 / x, 0, 1),
        over(1 / x**2, 0, 1),
        over(1 / x, -1, 1),
        over(1 / x, 1, oo),
        over(sin(x), 0, oo),
        over(x / (x**2 - Rational(1, 4)), -1, 1),
        over(1 / (x * log(x)), 0, Rational(1, 2)),
        over(exp(x), 0, oo),
        over(1 / Abs(x), -1, 2),
        Sum(1 / n, (n, 1, oo)),
        Sum(2**n, (n, 0, oo)),
        Sum((-1) ** n, (n, 0, oo)),
        Integral(Integral(1 / x, (y, 0, 1)), (x, 0, 1)),
    ],
)
def test_what_diverges_has_no_value(expr):
    with pytest.raises(NoValue):
        value(expr, 20)


@pytest.mark.parametrize(
    "expr", [x + 1, sp.Float("0.5") * pi, sqrt(-2) + 1, sp.Function("f")(1), 1 / (pi - pi + S.Zero)]
)
def test_what_is_no_real_constant_has_no_value(expr):
    with pytest.raises(NoValue):
        value(expr)


def test_the_inverse_sine_with_a_kink():
    f = sp.asin(2 * x / (1 + x**2))
    truth = 3 * pi - 6 * sp.atan(3) + log(10) - 2 * log(2)
    halves = over(f, 0, 1) + over(f, 1, 3)
    with mp.workdps(40):
        assert abs(value(halves, 20) - mpf(sp.N(truth, 40))) < mpf(10) ** -20


def facing(f):
    return Integral(f, (phi, 0, 2 * pi))


LIT = u * x + sqrt(1 - u**2) * sqrt(1 - x**2) * cos(phi)


def lit_area(c):
    """The integral of max(0, LIT) over phi, from the switch angle in closed form."""
    a, b = mpf(3) / 10 * c, mp.sqrt(mpf(91) / 100 * (1 - c * c))
    if abs(a) >= b:
        return 2 * mp.pi * max(a, 0)
    return 2 * (a * mp.acos(-a / b) + mp.sqrt(b * b - a * a))


def lit_moment(c):
    """The integral of H(LIT) sqrt(1 - c^2) cos(phi) over phi."""
    a, b = mpf(3) / 10 * c, mp.sqrt(mpf(91) / 100 * (1 - c * c))
    return 0 if abs(a) >= b else 2 * mp.sqrt(1 - c * c) * mp.sqrt(1 - (a / b) ** 2)


NESTED = [(Max(0, LIT), lit_area), (Heaviside(LIT) * sqrt(1 - x**2) * cos(phi), lit_moment)]


@pytest.mark.parametrize("weight", [x**2, 1 / (1 + x**2)])
@pytest.mark.parametrize("inner, known", NESTED)
def test_nested_integrals(inner, known, weight):
    expr = Integral(facing(inner) * weight, (x, -1, 1))
    start = time.perf_counter()
    found = value(expr, 20, points={x: [-tau, tau]})
    assert time.perf_counter() - start < 3
    with mp.workdps(40):
        edge = mp.sqrt(91) / 10
        known_weight = sp.lambdify(x, weight, "mpmath")
        parts = ((mpf(-1), -edge), (-edge, edge), (edge, mpf(1)))
        truth = sum(mp.quad(lambda c: known(c) * known_weight(c), part) for part in parts)
        assert abs(found / truth - 1) < mpf(10) ** -20


def test_kinks_of_the_outer_integrand_are_found_unasked():
    expr = Integral(facing(Max(0, LIT)) * x**2, (x, -1, 1))
    assert mpmath.nstr(value(expr, 20), 19) == mpmath.nstr(value(expr, 20, points={x: [-tau, tau]}), 19)


def test_smooth_nested_integrals():
    expr = Integral(exp(x * y), (y, 0, x), (x, 0, 1))
    with mp.workdps(40):
        truth = mp.quad(lambda t: mp.expm1(t * t) / t, [0, 1])
        assert abs(value(expr, 20) / truth - 1) < mpf(10) ** -20


def test_a_polynomial_switch_moves_with_the_outer_variable():
    expr = Integral(Integral(Abs(y - x**2), (y, 0, 1)), (x, 0, 1))
    with mp.workdps(40):
        assert abs(value(expr, 20) - mpf(11) / 30) < mpf(10) ** -20


def test_poles_do_not_cancel_by_symmetry():
    with mp.workdps(40), pytest.raises((NoValue, ZeroDivisionError)):
        tanh_sinh(lambda t: t / (t * t - mpf(1) / 4), mpf(-1), mpf(1), 20)


def test_definitions_are_unfolded():
    class Area(sp.Function):
        def definition(self):
            return Integral(2 * sqrt(self.args[0] ** 2 - x**2), (x, -self.args[0], self.args[0]))

    with mp.workdps(40):
        assert abs(value(Area(2), 25) / (4 * mp.pi) - 1) < mpf(10) ** -25


def test_the_precision_is_given_back():
    before = mp.dps
    value(over(exp(x), 0, 1), 50)
    with pytest.raises(NoValue):
        value(over(1 / x, 0, 1))
    assert mp.dps == before
