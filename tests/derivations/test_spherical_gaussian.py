"""The spherical Gaussian: forms as plain text, and its integral, series and bounds against the definition by mpmath."""

from __future__ import annotations

import pytest
from mpmath import asin, besseli, besselj, cos, cosh, exp, inf, mp, mpf, nsum, pi, quad, sin, sinh, sqrt

from derivations.deon2016 import spherical_gaussian
from derivations.extensions import spherical_gaussian as integral
from derivations.extensions import (
    spherical_gaussian_bounds,
    spherical_gaussian_dark,
    spherical_gaussian_rim,
    spherical_gaussian_series,
)
from xsec_sym import ledger
from xsec_sym.proof.claim import REGISTRY
from xsec_sym.proof.say import said

MODULES = (
    *(spherical_gaussian, integral, spherical_gaussian_series, spherical_gaussian_bounds),
    *(spherical_gaussian_dark, spherical_gaussian_rim),
)
TRIED = ("xsec:sg-dark-layer", "xsec:sg-rim", "xsec:sg-rim.surplus")
GOLDEN = {
    "deon2016:30": ("misprint", "(alpha**2 - (2 + alpha**2)*exp(-2/alpha**2))*csch(2/alpha**2)/4"),
    "deon2016:31": ("proved", "besseli(1, 2/alpha**2)*csch(2/alpha**2)/2"),
    "deon2016:32": ("misprint", "(alpha**2 - (-2 + alpha**2)*exp(2/alpha**2))*csch(2/alpha**2)/4"),
    "deon2016:35": ("proved", "u*(-alpha**2 + 2*coth(2/alpha**2))/4"),
    "xsec:sg-ode": ("proved", "besseli(0, 2*sqrt(1 - u**2)/alpha**2)/(alpha**2*sinh(2/alpha**2))"),
    "xsec:sg-hemisphere": ("proved", "sinh(k)/k"),
}


@pytest.fixture(autouse=True)
def thirty_digits():
    with mp.workdps(30):
        yield


def by_definition(u, kappa):
    """The clamped cosine over the sphere about the viewer, one integral of the density's exponential over azimuth."""
    s = sqrt(1 - u * u)

    def around(t):
        swing = kappa * s * sqrt(1 - t * t)
        return quad(lambda phi: exp(kappa * u * t + swing * cos(phi)), [0, pi / 2, pi]) * 2

    return kappa / (4 * pi * sinh(kappa)) * quad(lambda t: t * around(t), [0, mpf(1) / 2, 1])


@pytest.mark.parametrize("name", GOLDEN)
def test_the_form_that_holds_and_its_verdict(name):
    verdict, form = GOLDEN[name]
    assert said(REGISTRY[name].form) == form
    assert ledger[name].verdict == verdict


@pytest.mark.parametrize("name", [c.id for m in MODULES for c in (m.paper if hasattr(m, "paper") else m.project)])
def test_all_but_what_says_so_is_proved(name):
    entry = ledger[name]
    how = entry.evidence.get("statement") or entry.evidence.get("corrected form") or entry.verdict
    if name in TRIED:
        assert how == "confirmed"
    else:
        assert how in ("proved", "definition")


@pytest.mark.parametrize(("u", "kappa"), [("0.3", 2), ("-0.8", 5), ("0.95", 11)])
def test_the_chebyshev_series_is_the_definition(u, kappa):
    u, z = mpf(u), mpf(kappa) / 2
    psi, s = asin(u), sqrt(1 - u * u)
    orders = [besseli(j, z) for j in range(40)]

    def term(j):
        weight = z * (orders[j] ** 2 + orders[j + 1] ** 2) - orders[j] * orders[j + 1]
        return weight * sin((2 * j + 1) * psi) / (2 * j + 1)

    series = 2 * sum(term(j) for j in range(39))
    sigma = (s * besseli(1, kappa * s) + u * (cosh(kappa) - sinh(kappa) / kappa + series)) / (2 * sinh(kappa))
    assert abs(sigma / by_definition(u, kappa) - 1) < mpf(10) ** -20


@pytest.mark.parametrize("alpha", ["0.05", "0.3", "1", "4"])
@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-12])
def test_the_proved_number_of_terms_is_enough_and_not_wasteful(alpha, tolerance):
    """The bound of sg-tail against the true tail at its worst, u = 1, where every sine is 1 or -1."""
    z = 1 / mpf(alpha) ** 2
    scaled = [besseli(j, z) * exp(-z) for j in range(int(8 * sqrt(z)) + 40)]
    whole = 2 / (1 - exp(-4 * z))  # e^(2 z) / sinh(2 z)

    def bound(n):
        q = z / (z + n + mpf(1) / 2)
        return whole * 2 * z * scaled[n] ** 2 / ((2 * n + 1) * (1 - q * q))

    def tail(n):
        rest = (
            (z * (scaled[j] ** 2 + scaled[j + 1] ** 2) - scaled[j] * scaled[j + 1]) / (2 * j + 1)
            for j in range(n, len(scaled) - 1)
        )
        return whole * sum(rest)

    enough = next(n for n in range(len(scaled) - 1) if bound(n) <= tolerance)
    needed = next(n for n in range(len(scaled) - 1) if tail(n) <= tolerance)
    assert tail(enough) <= tolerance
    assert needed <= enough <= needed + 2 + needed // 8


def test_the_rim_is_the_definition():
    v, kappa = mpf("0.8"), mpf(5)
    s, dark = sqrt(1 - v * v), by_definition(-v, kappa)
    beyond = quad(lambda r: r * exp(-kappa * v * sqrt(1 + r * r)) * besselj(0, kappa * s * r), [0, 1, 3, 9, 27, 81])
    surplus = v * exp(-kappa) * (1 + 1 / kappa) / kappa
    assert abs(beyond / surplus - 1) < mpf(10) ** -18
    at_the_pole = (1 - (1 + kappa) * exp(-kappa)) / (2 * kappa * sinh(kappa))
    rest = quad(lambda x: besseli(1, kappa * x) / sqrt(1 - x * x) ** 3, [0, s / 2, s]) / (2 * sinh(kappa))
    assert abs((at_the_pole + rest) * v / dark - 1) < mpf(10) ** -20


@pytest.mark.parametrize(("u", "kappa"), [("0.3", 2), ("-0.6", 7), ("0.9", 20)])
def test_the_integral_that_is_left_is_a_lommel_function(u, kappa):
    u = mpf(u)
    r, s = sqrt((1 + u) / (1 - u)), sqrt(1 - u * u)
    lommel = nsum(lambda m: r ** (2 * m + 1) * besseli(2 * m + 1, kappa * s), [0, inf])
    left = quad(lambda t: besseli(0, kappa * sqrt(1 - t * t)), [0, u])
    assert abs(left - 2 / mpf(kappa) * (lommel - sinh(kappa) / 2)) < mpf(10) ** -24 * cosh(kappa)


def test_both_parities_of_the_sum_are_marcums_function_and_mirror_to_an_exponential():
    u, kappa = mpf("0.4"), mpf(3)
    r, s = sqrt((1 + u) / (1 - u)), sqrt(1 - u * u)

    def both(r):
        return nsum(lambda k: r**k * besseli(k, kappa * s), [0, inf])

    assert abs(both(r) + both(1 / r) - besseli(0, kappa * s) - exp(kappa)) < mpf(10) ** -24
    a, b = sqrt(kappa * (1 + u)), sqrt(kappa * (1 - u))
    marcum = quad(lambda x: x * exp(-(x * x + a * a) / 2) * besseli(0, a * x), [b, a + 2, a + 6, a + 14])
    assert abs(exp(kappa) * marcum - both(r)) < mpf(10) ** -20
