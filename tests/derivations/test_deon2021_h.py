"""The H functions of Lambertian spheres: their balls and digits, the bounds that those rest on, and what is printed."""

from __future__ import annotations

import json

import numpy as np
import pytest
from flint import arb
from mpmath import mp, mpf
from sympy import Rational, lambdify, pi

from derivations.deon2021 import characteristic, h_equation
from xsec_sym.exact import DispersionLambertSphere, HLambertSphere, HLambertTransform, h_lambert_sphere, three_terms
from xsec_sym.exact.half_space_balls import LEVELS, transform, value
from xsec_sym.proof import digits, wire
from xsec_sym.proof.ball_compile import precision
from xsec_sym.proof.balls import NoEnclosure, enclose
from xsec_sym.proof.claim import REGISTRY

ORDERS = range(3)


def dispersion(order, t, c):
    """K from (23), by a rule of its own, on and off the real axis."""
    x, weight = three_terms.nodes(80, 1)
    psi = lambdify([characteristic.mu, characteristic.c], characteristic.PSI[order], "numpy")
    t = np.asarray(t)[..., None]
    return 1 - 2 * (psi(x, c) * weight / (1 + t**2 * x**2)).sum(-1)


@pytest.mark.parametrize("order", ORDERS)
def test_k_keeps_within_the_bounds_that_the_enclosures_rest_on(order):
    size = np.geomspace(1e-4, 20, 120)
    for c in (0.0, 0.01, 0.019, 0.02, 0.1, 0.5, 0.9, 0.99, 1.0):
        for angle in np.linspace(0, 3 * np.pi / 8, 13):
            k = dispersion(order, size * np.exp(1j * angle), c)
            assert np.all(abs(k) >= np.minimum(1, size**2) / 23) and np.all(abs(k) <= 2.62)
            assert np.all(abs(np.log(k)) <= 5.5 + 2 * np.maximum(0, -np.log(size)))
            assert abs(np.angle(k)).max() <= 3 * np.pi / 4 + 1e-6  # K is rounded where it is small
        assert np.all(abs(np.log(dispersion(order, size, c))) <= np.pi / size)


@pytest.mark.parametrize("order", ORDERS)
def test_what_balls_and_digits_start_from_is_what_was_derived(order):
    """The coefficients of Psi, and K(0) = 1 - 2 int Psi, which every route to H shares."""
    c, mu = characteristic.c, characteristic.mu
    psi = sum(a * mu ** (2 * k) for k, a in enumerate(three_terms.characteristic(order, c)))
    assert (psi - characteristic.PSI[order]).expand() == 0
    rest = 1 - 2 * characteristic.PSI[order].expand().integrate((mu, 0, 1))
    assert (three_terms.at_rest(order, c) - rest).expand() == 0


def test_the_constant_in_the_bound_from_below():
    c = np.linspace(0.02, 1, 99)
    x, weight = three_terms.nodes(40, 1)
    psi = lambdify([characteristic.mu, characteristic.c], characteristic.PSI[0], "numpy")(x, c[:, None])
    assert psi.min() >= 0 and np.all(np.diff(psi, axis=1) < 0)
    last = 1 - 2 * psi @ weight + psi @ (weight * x**2)
    assert last.min() == pytest.approx(5 / 32, abs=1e-12) and np.all(np.diff(last) < 0)
    assert np.cos(3 * np.pi / 8) * 5 / 32 > 1 / 17


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("c", ["0", "1/100", "3/10", "1"])
def test_balls_digits_and_newtons_method_agree(order, c):
    albedo = Rational(c)
    for u in (Rational(1, 50), Rational(2, 3), Rational(7, 2)):
        ball, solved = enclose(HLambertSphere(order, u, albedo), 30), HLambertSphere.routes[0](order, u, float(albedo))
        assert float(ball.mid()) == pytest.approx(float(solved), rel=1e-12)
        with mp.workdps(40):
            found = digits.value(HLambertSphere(order, u, albedo), 30)
            assert abs(found / mpf(ball.mid().str(38, radius=False)) - 1) < mpf(10) ** -29
    x, weight = three_terms.nodes(150, 4)
    exact = enclose(HLambertTransform(order, 2, Rational(1, 3), albedo), 30)
    h = three_terms.by_equation(order, x, float(albedo))
    assert float(exact.mid()) == pytest.approx((weight * h * x**2 / (1 / 3 + x)).sum(), rel=1e-12)


def test_coarse_balls_hold_the_fine_ones():
    for order in ORDERS:
        for c in (arb(1), arb(0.5), arb(2) ** -20):
            for f, rest in ((value, ()), (transform, (4,))):
                found = []
                for bits in LEVELS[:2]:
                    with precision(bits):
                        found.append(f(arb(0.25), c, *rest, h_lambert_sphere.LOG_K[order]))
                assert found[0].overlaps(found[1])
                assert found[1].rad() < found[0].rad() < 1e-15 * found[0]


@pytest.mark.parametrize("order", ORDERS)
def test_k_by_the_angle_is_the_printed_one_on_both_sides_of_its_switch(order):
    for angle in (Rational(1, 10), Rational(54, 100), Rational(56, 100), Rational(3, 2)):
        for c in (Rational(1, 3), Rational(1)):
            ball = enclose(DispersionLambertSphere(order, angle, c), 25)
            printed = lambdify([characteristic.t, characteristic.c], characteristic.K[order], "mpmath")
            with mp.workdps(60):
                expected = printed(mp.tan(mpf(angle.p) / angle.q), mpf(c.p) / c.q)
                assert abs(mpf(ball.mid().str(40, radius=False)) / expected - 1) < mpf(10) ** -24


@pytest.mark.parametrize(
    "e",
    [
        HLambertSphere(0, -1, Rational(1, 2)),
        HLambertSphere(1, Rational(1, 2), Rational(3, 2)),
        HLambertSphere(3, Rational(1, 2), Rational(1, 2)),
        HLambertTransform(0, Rational(1, 2), Rational(1, 2), Rational(1, 2)),
    ],
)
def test_outside_the_domain_there_is_no_ball(e):
    with pytest.raises(NoEnclosure):
        enclose(e, 15)


def test_the_new_heads_are_set_and_come_back_from_the_record():
    claims = [c for c in (*h_equation.paper, *h_equation.project) if c.kind == "equation"]
    for claim in claims:
        for side in (claim.left, claim.form):
            assert wire.decode(json.loads(json.dumps(wire.encode(side)))) == side
    assert r"H^{(1)}\left(v, c\right)" in REGISTRY["deon2021:20.1"].latex()
    assert r"\tan \theta" in REGISTRY["deon2021:22.2"].latex()
    assert REGISTRY["deon2021:21"].form.has(pi)
