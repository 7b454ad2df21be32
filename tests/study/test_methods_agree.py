"""Every method that can run here, where it should be right: inside the domain, far from every edge."""

import numpy as np
import pytest

from tests.study import rivals
from xsec_sym.study.method import registered

# Forms that are exact but for rounding, as often as it happens.
EXACT = 5e-14
REGIONS = {
    "sigma_dirac_ring": rivals.box(1, 6, (0.2, 0.6), (0.2, 0.6)),
    "sigma_power": (rivals.box(2, 6, (-0.8, 0.8))[0], np.array([0.0, 1, 2, 4, 7, 10])),
    "sigma_beckmann": rivals.box(3, 6, (-0.6, 0.8), (0.5, 1.5)),
    "sigma_ggx": rivals.box(4, 6, (-0.6, 0.8), (0.5, 1.5)),
    "sigma_ellipsoidal": rivals.box(5, 6, (-0.8, 0.8), (0.2, 0.6)),
    "lambda_beckmann": rivals.box(6, 6, (0.2, 0.4), (0.7, 1.0)),
    "lambda_ggx": rivals.box(7, 6, (0.2, 0.6), (0.5, 1.0)),
    "ssl": rivals.box(8, 6, (-0.9, 0.9), (0.3, 0.9)),
    "sel": rivals.box(9, 6, (0.3, 2.8), (0.0, 6.2), (0.3, 0.9), (0.3, 0.9)),
}
QUADRATURES = {"Gauss-Legendre over rings": 4e-4, "scipy.integrate.quad": 1e-8, "cross_section": 1e-10}
# What is no exact form, and how wrong it is at most in the region, at the last point of its curve.
LOOSE = {
    "sigma_dirac_ring": {
        "scipy.integrate.quad": 1e-7,
        "Legendre series": 1e-4,
        "equidistant azimuths": 1e-4,
        "table": 1e-5,
    },
    "sigma_power": {"two plates": 0.7},
    "sigma_beckmann": {"Gaussian slopes": 0.05, "rational Lambda": 0.05, "GGX": 4.0, "spherical Gaussian": 0.6},
    "sigma_ggx": {"linear root": 0.2, "Beckmann": 0.8},
    # 48 terms leave what b^48 times the next power's cross-section is, for b up to 0.6
    "sigma_ellipsoidal": {"powers of b": 2e-12},
    "lambda_beckmann": {
        "asymptotic series": np.inf,
        "rational Lambda": 0.06,
        "rational G1": 0.06,
        "compiled rational Lambda": 0.06,
        "GGX": 10.0,
    },
    "lambda_ggx": {"Schlick, alpha/2": 0.6, "Schlick": 1.5},
    "ssl": {"spherical Gaussian": 1.01},
    "sel": {"geometric mean": 0.8, "anisotropic Gaussian": 1.01},
}


@pytest.mark.parametrize("name", REGIONS)
def test_every_method(name):
    methods = [m for m in registered(name).methods if m.available and m.name != "Mitsuba 3"]
    told = QUADRATURES | LOOSE[name]
    assert len(methods) >= 5 and LOOSE[name].keys() <= {m.name for m in registered(name).methods}
    for method in methods:
        error = rivals.worst(name, method.name, REGIONS[name], **rivals.last(method))
        bound = told.get(method.name, EXACT)
        assert error < bound, (method.name, error)
        if bound > 1e-10 and np.isfinite(bound):
            # neither is it better than it is said to be
            assert error > bound / 1000, (method.name, error)


@pytest.mark.parametrize("name", REGIONS)
def test_every_curve_and_every_neighbourhood_can_be_drawn(name):
    quantity = registered(name).quantity
    for draw in quantity.trouble.values():
        columns = draw(np.random.default_rng(0), 50)
        assert len(columns) == len(quantity.arguments)
        for argument, column in zip(quantity.arguments, columns, strict=True):
            assert len(column) == 50
            assert (argument.low <= column.min() and column.max() <= argument.high) or argument.name in ("b", "phi")


@pytest.mark.parametrize("name", REGIONS)
def test_kernels_hold_in_every_neighbourhood(name):
    """At most 8 ulp, in doubles and in singles."""
    quantity = registered(name).quantity
    for label, draw in quantity.trouble.items():
        for dtype, eps in (("float64", 2.0**-52), ("float32", 2.0**-23)):
            columns = draw(np.random.default_rng(5), 16)
            _, errors = rivals.tried(name, "kernel", columns, dtype)
            assert not (errors > 8 * eps).any(), (label, dtype, np.nanmax(errors))


def test_series_and_quadratures_converge():
    for name, method, gain in [
        ("sigma_ellipsoidal", "powers of b", 1e-9),
        ("sigma_ellipsoidal", "Legendre series", 1e-9),
        ("sigma_dirac_ring", "Legendre series", 1e-2),
        ("sigma_dirac_ring", "equidistant azimuths", 1e-1),
        ("sigma_power", "Chebyshev interpolant", 1e-9),
        ("sigma_beckmann", "Gauss-Legendre over rings", 1e-1),
        ("ssl", "Chebyshev interpolant", 1e-9),
    ]:
        curve = registered(name)[method].curve
        first, final = (rivals.worst(name, method, REGIONS[name], **parameters) for parameters in (curve[0], curve[-1]))
        assert final < gain * first, (name, method, first, final)
