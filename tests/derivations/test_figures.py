"""The figures that readings quote as measured, measured: the cross-section of the kernel against the approximants."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import erf, erfcx, eval_legendre, i0e, i1e, ive

from xsec_sym import kernels

VIEWS = np.linspace(-1, 1, 401)


def fitted(u, m, factor=2.0, regular=0.5, cubic=1.0):
    """(41) with (42) and (43); ``factor`` of 0F1(; 2; ), ``regular`` of 0F1(; 3; ) in the first bracket."""
    k, s = 2 / m**2, np.sqrt(1 - u * u)
    coth, csch = 1 / np.tanh(k), 2 / -np.expm1(-2 * k)  # csch over exp(-k), which the scaled Bessel functions bring
    cosine = 2 * coth - m**2
    i0, i1, i2 = i0e(k), i1e(k), ive(2, k)
    a_1 = np.sqrt(np.pi) * csch * (k * i0 - i1) / cosine
    bracket = factor * m**2 * i1 - regular * 2 * m**4 * i2
    a_3 = a_1**3 / 3 - np.sqrt(np.pi) * csch * bracket / (3 * m**6 * cosine)
    second = csch * s * i1e(k * s) * np.exp(-k * (1 - s)) / 2
    return cosine * (u * erf(a_1 * u + cubic * a_3 * u**3) + u) / 4 + second


def expanded(u, m, degrees):
    k = 2 / m**2
    value = np.zeros_like(u)
    for degree in degrees:
        kernel = {0: 0.5, 1: 1 / 3}.get(degree, 0.0)
        if degree > 1 and degree % 2 == 0:
            kernel = -eval_legendre(degree, 0.0) / ((degree - 1) * (degree + 2))
        value += (2 * degree + 1) / 2 * kernel * ive(degree + 0.5, k) / ive(0.5, k) * eval_legendre(degree, u)
    return value


def error(form, m):
    return np.abs(form - kernels.sigma_spherical_gaussian(VIEWS, m)).max()


@pytest.mark.parametrize(
    ("variant", "figure"),
    [({}, 9.2e-5), ({"factor": 1.0}, 8.9e-3), ({"regular": 1.0}, 1.0e-3), ({"cubic": 0.0}, 1.0e-3)],
)
def test_the_variants_of_42_at_the_end_of_the_claim(variant, figure):
    assert error(fitted(VIEWS, 0.299, **variant), 0.299) == pytest.approx(figure, rel=0.06)


def test_twelve_terms_against_41():
    def twelve(m):
        return error(expanded(VIEWS, m, range(12)), m)

    assert twelve(0.33) > error(fitted(VIEWS, 0.33), 0.33)
    assert twelve(0.35) < error(fitted(VIEWS, 0.35), 0.35)
    assert 0.35 < next(m for m in np.arange(0.34, 0.4, 0.002) if twelve(m) < 1e-4) < 0.37
    not_zero = [0, 1, *range(2, 22, 2)]
    assert error(expanded(VIEWS, 0.3, not_zero), 0.3) == pytest.approx(1.4e-7, rel=0.1)


def test_the_largest_error_of_the_boundary_layer():
    v, alpha = (x.ravel() for x in np.meshgrid(np.geomspace(0.01, 0.95, 60), np.linspace(0.2, 1, 33)))
    kappa, s = 2 / alpha**2, np.sqrt(1 - v * v)
    a = v * np.sqrt(kappa / (2 * s))
    bare = (1 - np.sqrt(np.pi) * a * erfcx(a)) * np.exp(-kappa * v * v / (1 + s))
    layer = bare / (s * np.sqrt(2 * np.pi * kappa * s))
    found = np.abs(kernels.sigma_spherical_gaussian(-v, alpha) / layer - 1) * kappa * s
    worst = found.argmax()
    assert found[worst] == pytest.approx(0.44, abs=0.005)
    assert (v[worst], alpha[worst]) == (pytest.approx(0.01), pytest.approx(1))
