"""Where methods are known to fail, and by how much; the kernel holds at the same points."""

import warnings

import numpy as np
import pytest

from tests.study import rivals
from xsec_sym.study.methods import smith

KERNEL = 8 * 2.0**-52


def fails(name, method, columns, loss, **parameters):
    """Off by more than `loss` at every point, where the kernel is right to 8 ulp."""
    _, errors = rivals.tried(name, method, columns, **parameters)
    assert (errors > loss).all(), (method, errors)
    assert rivals.worst(name, "kernel", columns) < KERNEL


def just_inside(n):
    """u next to the printed edge, sqrt(1 - u_n^2), at most two last places below, and u_n."""
    rng = np.random.default_rng(3)
    x = rng.uniform(-1, 1, n)
    edge = np.sqrt(1 - x * x)
    return edge - rng.integers(0, 3, n) * np.spacing(edge), x


def beside(x, away):
    """Cosines on both sides of sqrt(1 - x^2), and x."""
    edge = np.sqrt((1 - x) * (1 + x))
    return np.clip(np.concatenate([edge * (1 - away), edge * (1 + away)]), 0, 1), np.concatenate([x, x])


def test_ring_whose_arccosine_has_no_argument():
    """At the edge the argument passes 1, and what is under the root 0; clamping hides it, at the price of digits."""
    columns = just_inside(2000)
    found, _ = rivals.tried("sigma_dirac_ring", "edge included", columns)
    assert np.isnan(found).any()
    clamped, errors = rivals.tried("sigma_dirac_ring", "clamped arccosine", columns)
    assert np.isfinite(clamped).all() and np.nanmax(errors) > 1e-3
    assert np.nanmax(rivals.tried("sigma_dirac_ring", "kernel", columns)[1]) < KERNEL


def test_printed_ring_ends_where_both_its_cases_do():
    """Its inequalities are strict, so that at the edge itself there is neither case; below it no argument passes 1."""
    u, x = just_inside(2000)
    u, x = np.sqrt(1 - x[x > 0] ** 2), x[x > 0]
    found, _ = rivals.tried("sigma_dirac_ring", "as printed", (u, x))
    assert (found == 0).all()
    assert (rivals.tried("sigma_dirac_ring", "kernel", (u, x))[0] > 0).all()


def test_ring_that_is_barely_lit():
    x = np.array([-0.3, -0.5, -0.8])
    columns = beside(x, 1e-12)
    columns = tuple(c[:3] for c in columns)
    for method, loss in [
        ("as printed", 1e-4),
        ("three terms", 1e-4),
        ("clamped arccosine", 1e-4),
        ("two-argument arctangent", 1e-5),
        ("compiled", 1e-5),
        ("table", 0.1),
        ("scipy.integrate.quad", 1e-6),
    ]:
        fails("sigma_dirac_ring", method, columns, loss, **rivals.last(rivals.registered("sigma_dirac_ring")[method]))
    assert rivals.worst("sigma_dirac_ring", "compiled, stable", columns) < KERNEL


def test_high_powers_of_u_cancel():
    columns = (np.array([0.8, 0.9, 0.95]), np.full(3, 200.0))
    fails("sigma_power", "powers of u", columns, 1.0)
    assert rivals.worst("sigma_power", "binomial series", columns) < 1e-13
    assert rivals.worst("sigma_power", "Legendre series", columns, n=16) > 1e-3


def slopes(a, alpha=0.1):
    a = np.atleast_1d(np.asarray(a, float))
    return smith.cosine_of(a, np.full(a.shape, alpha)), np.full(a.shape, alpha)


@pytest.mark.parametrize("method", ["erf", "compiled erf"])
def test_lambda_from_erf_loses_every_digit_beyond_a_slope_of_3(method):
    fails("lambda_beckmann", method, slopes([3.0, 3.3, 3.7]), 1e-13)
    fails("lambda_beckmann", method, slopes([4.0, 4.5]), 1e-9)
    fails("lambda_beckmann", method, slopes([6.0, 10.0, 20.0]), 0.9)
    u, alpha = slopes([4.0, 6.0, 10.0])
    fails("sigma_beckmann", method, (-u, alpha), 1e-9)


def test_erfc_and_erfcx_cancel_less():
    """a^2 times the rounding error, and the exponent's: the kernel has neither."""
    for method in ("erfc", "erfcx"):
        errors = rivals.tried("lambda_beckmann", method, slopes([20.0, 22.0, 25.0]))[1]
        assert 3e-14 < errors.max() < 1e-9, method
    assert rivals.worst("lambda_beckmann", "kernel", slopes([20.0, 22.0, 25.0])) < KERNEL


@pytest.mark.parametrize("method", ["rational Lambda", "rational G1", "compiled rational Lambda"])
def test_rational_fit_of_renderers(method):
    """Lambda is negative for 1.548 < a < 1.6 and 0 beyond; 1/(1 + Lambda) is off by up to 0.31 %."""
    a = np.concatenate([np.linspace(0.05, 1.54, 300), np.linspace(1.549, 1.5999, 60), [1.61, 2.0, 5.0]])
    found, _ = rivals.tried("lambda_beckmann", method, slopes(a))
    exact, _ = rivals.tried("lambda_beckmann", "kernel", slopes(a))
    g1, right = 1 / (1 + found), 1 / (1 + exact)
    assert (found[:300] > 0).all() and (found[300:360] < 0).all() and (g1[300:360] > 1).all()
    assert (np.abs(found[360:]) < 1e-15).all() and (exact[360:] > 0).all()
    assert 3.1e-3 < np.abs(g1 / right - 1).max() < 3.2e-3


def test_asymptotic_series_needs_large_slopes():
    """Its best is at a few terms; towards a = 0 every term is worse than the one before."""
    errors = [rivals.worst("lambda_beckmann", "asymptotic series", slopes([8.0]), n=n) for n in (1, 2, 4, 8)]
    assert errors == sorted(errors, reverse=True) and errors[-1] < 1e-9
    assert rivals.worst("lambda_beckmann", "asymptotic series", slopes([0.5]), n=8) > 1e6


def test_ggx_of_small_x():
    columns = (np.array([1 - 1e-10, 0.9, 0.5]), np.array([0.1, 1e-6, 1e-7]))
    for method in ("(sqrt(1 + x) - 1)/2", "through the angle", "without the tangent", "sigma/u - 1", "compiled"):
        fails("lambda_ggx", method, columns, 1e-6)
    assert rivals.worst("lambda_ggx", "rationalised", columns) < 1e-5
    assert rivals.worst("lambda_ggx", "compiled, stable", columns) < KERNEL
    dark = (-columns[0], columns[1])
    for method in ("as printed", "stretched vector", "compiled"):
        fails("sigma_ggx", method, dark, 1e-6)
    assert rivals.worst("sigma_ggx", "compiled, stable", dark) < KERNEL


def test_tangent_at_the_horizon():
    """arccos(1e-18) is pi/2, whose tangent is 1.6e16."""
    fails("lambda_ggx", "through the angle", ([1e-18, 1e-17], [0.5, 2.0]), 0.1)


def test_axis_of_beckmann():
    """1 - u^2 has lost its digits; on the axis itself, 0/0 for erfcx."""
    fails("sigma_beckmann", "erf", ([-1 + 1e-10, -1 + 2e-10], [1e4, 1e4]), 1e-6)
    assert not np.isfinite(rivals.tried("sigma_beckmann", "erfcx", ([1.0], [0.5]))[0]).any()
    assert rivals.tried("sigma_beckmann", "kernel", ([1.0, -1.0], [0.5, 0.5]))[0].tolist() == [1.0, 0.0]


def test_linear_root_for_rough_surfaces():
    """Schlick's masking, on the dark side of a smooth surface and of a very rough one."""
    fails("sigma_ggx", "linear root", ([-0.5, -0.9], [1e-2, 1e-2]), 10.0)


def test_ellipsoid_toward_the_sphere_and_the_disk():
    for method in ("as printed", "regular at the pole", "compiled"):
        fails("sigma_ellipsoidal", method, ([0.5, -0.3], [1e-7, 1e-8]), 1e-6)
    fails("sigma_ellipsoidal", "as printed", ([0.999, 0.99], [1 - 1e-10, 1 - 1e-13]), 1e-6)
    assert not np.isfinite(rivals.tried("sigma_ellipsoidal", "as printed", ([1.0], [0.5]))[0]).any()
    assert rivals.worst("sigma_ellipsoidal", "regular at the pole", ([1.0, 0.999], [0.5, 1 - 1e-10])) < 1e-13
    fails("sigma_ellipsoidal", "powers of b", ([0.9, 0.5], [0.9999, 0.9999]), 0.1, n=48)
    assert rivals.worst("sigma_ellipsoidal", "compiled, stable", ([0.5, 0.999], [1e-8, 1 - 1e-10])) < KERNEL
    # the reference's limits, which singles reach by rounding
    assert rivals.tried("sigma_ellipsoidal", "kernel", ([0.5, -0.5], [1.0, 1.0]))[0].tolist() == [0.5, 0.0]
    assert rivals.worst("sigma_ellipsoidal", "kernel", ([0.5, -0.5], [0.0, 0.0])) == 0.0


def test_fixed_rules_miss_narrow_peaks():
    for name in ("sigma_beckmann", "sigma_ggx", "sigma_ellipsoidal"):
        shape = 1 - 1e-9 if name == "sigma_ellipsoidal" else 1e-3
        fails(name, "Gauss-Legendre over rings", ([0.5], [shape]), 0.05, n=48)


def test_spheroidal_lobe_at_its_peak():
    """1 + m and 1 - m are added before they are rounded, or not."""
    alpha = np.array([1e-4, 1e-3])
    columns = np.cos(2 * alpha), alpha
    fails("ssl", "collected", columns, 1e-12)
    fails("ssl", "GGX at half the angle", columns, 1e-12)
    fails("ssl", "spherical Gaussian", (np.cos([0.5, 1.0]), alpha), 0.9)
    fails("ssl", "Chebyshev interpolant", columns, 0.1, n=64)


def test_ellipsoidal_lobe_at_its_peak():
    """U - z cancels: in doubles all but eight digits, in singles everything."""
    theta, alpha = np.array([1e-4, 2e-4]), np.array([1e-4, 1e-4])
    for method in ("as printed", "collected", "compiled"):
        fails("sel", method, (theta, [0.4, 0.4], alpha, alpha), 1e-11)
    singles = rivals.tried("sel", "as printed", (theta, [0.4, 0.4], alpha, alpha), "float32")[1]
    assert (singles > 0.3).all()
    assert rivals.worst("sel", "kernel", (theta, [0.4, 0.4], alpha, alpha), "float32") < 2.0**-23
    fails("sel", "ray and sphere", ([0.8, 1.2], [0.4, 0.4], alpha, alpha), 1e-13)
    for method in ("U - z as a sum", "compiled, stable"):
        assert rivals.worst("sel", method, (theta, [0.4, 0.4], alpha, alpha)) < KERNEL


def test_geometric_mean_holds_for_round_lobes_only():
    theta, phi = [0.7, 1.4], [0.3, 0.3]
    assert rivals.worst("sel", "geometric mean", (theta, phi, [0.3, 0.3], [0.3, 0.3])) < 1e-13
    fails("sel", "geometric mean", (theta, phi, [0.3, 0.3], [0.03, 0.03]), 0.5)


@pytest.mark.skipif(not rivals.registered("lambda_ggx")["Mitsuba 3"].available, reason="Mitsuba is not installed")
def test_mitsuba():
    columns = rivals.box(5, 100, (0.2, 0.6), (0.5, 1.0))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert rivals.worst("lambda_ggx", "Mitsuba 3", columns) < 1e-5
        assert 0.02 < rivals.worst("lambda_beckmann", "Mitsuba 3", columns) < 0.06
        assert rivals.worst("sigma_ggx", "Mitsuba 3", columns) < 1e-6
