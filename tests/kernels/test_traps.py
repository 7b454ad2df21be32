"""Where printed and customary forms lose their digits, by how much, and that the kernels do not."""

import numpy as np
import pytest
from mpmath import mpf
from scipy import special

from tests.kernels import lobes, oracle
from xsec_sym import kernels

ROOT_PI = np.sqrt(np.pi)


def lost(value, exact):
    """The relative error; infinite for what is no number."""
    return float(abs(mpf(float(value)) / exact - 1)) if np.isfinite(value) else np.inf


def assert_trap(naive, kernel, reference, points, loss):
    """The naive form is off by more than `loss` at every point, the kernel by at most 8 ulp."""
    for point in points:
        dtype = np.result_type(*point)
        arguments = [np.array([argument], dtype) for argument in point]
        exact = reference(*point)
        with np.errstate(all="ignore"):
            assert lost(naive(*arguments)[0], exact) > loss, point
        assert oracle.ulps(kernel(*arguments)[0], exact) <= lobes.ULPS, point


def printed_beckmann(u, alpha, sign=-1):
    """deon2016 (22); in print the sign of the exponent is +1."""
    s = np.sqrt(1 - u * u)
    a = u / (alpha * s)
    return 0.5 * (u * (1 + special.erf(a)) + alpha * s * np.exp(sign * a * a) / ROOT_PI)


def test_beckmann_toward_the_axis():
    """1 - u^2 in doubles has lost 2e-5 at u = -1 + 1e-12, and the difference that is left everything."""
    assert_trap(
        printed_beckmann, kernels.sigma_beckmann, lobes.sigma_beckmann, [(-1 + 1e-12, 1e4), (-1 + 1e-13, 1e4)], 1e-6
    )
    with np.errstate(all="ignore"):
        assert np.isnan(printed_beckmann(np.array([-1.0, 1.0]), 0.5, sign=1)).all()
    assert kernels.sigma_beckmann([-1.0, 1.0], 0.5).tolist() == [0.0, 1.0]


def test_beckmann_on_the_dark_side():
    """1 + erf(a) cancels: 9e-9 is lost at a = -3.8, 3e-5 at -4.6, everything at -5.9."""
    points = [(-0.9, 0.45), (-0.9, 0.35), (-0.3, 0.05), (-0.01, 0.001)]
    assert_trap(printed_beckmann, kernels.sigma_beckmann, lobes.sigma_beckmann, points, 1e-6)


def test_the_printed_exponent_of_beckmann_grows():
    assert_trap(lambda u, a: printed_beckmann(u, a, 1), kernels.sigma_beckmann, lobes.sigma_beckmann, [(0.5, 0.5)], 0.1)


def lambda_from_erf(u, alpha):
    a = u / (alpha * np.sqrt(1 - u * u))
    return 0.5 * (special.erf(a) - 1 + np.exp(-a * a) / (a * ROOT_PI))


def cosine_of_slope(a, alpha):
    return a * alpha / np.sqrt(1 + (a * alpha) ** 2)


def test_lambda_from_erf():
    """5e-11 is lost at a = 3, 3e-8 at 4, 8e-4 at 5, everything at 6."""
    points = [(cosine_of_slope(a, 0.1), 0.1) for a in (4.0, 4.5, 5.0, 6.0, 10.0)]
    assert_trap(lambda_from_erf, kernels.lambda_beckmann, lobes.lambda_beckmann, points, 1e-8)
    assert_trap(lambda_from_erf, kernels.lambda_beckmann, lobes.lambda_beckmann, points[2:], 1e-4)


def test_the_exponent_needs_more_than_a_double():
    """An exponent near 650, right to a few last places, loses 1.8e-13: a hundred times 8 ulp."""

    def rounded(u, alpha):
        return np.exp(-(1 / u**2 - 1) / alpha**2) / (np.pi * alpha**2 * u**4)

    rng = np.random.default_rng(1)
    alpha = rng.uniform(0.1, 1, 200)
    u = 1 / np.sqrt(1 + 650 * alpha**2)
    exact = [lobes.ndf_beckmann(*point) for point in zip(u, alpha, strict=True)]
    assert max(lost(*pair) for pair in zip(rounded(u, alpha), exact, strict=True)) > 1e-13
    assert oracle.worst_ulps(kernels.ndf_beckmann(u, alpha), exact) <= lobes.ULPS


def slope_grid(alpha=0.5, n=4001):
    """cosines with a = 1/(alpha tan) from 0.01 to 2"""
    a = np.linspace(0.01, 2, n)
    return a, cosine_of_slope(a, alpha), np.full(n, alpha)


def test_rational_masking_of_renderers():
    """G1 ~ (3.535 a + 2.181 a^2)/(1 + 2.276 a + 2.577 a^2), else 1 from a = 1.6.

    Off by up to 0.313 %, at a = 1.336; above 1 for 1.548 < a < 1.6; and it jumps where it ends.
    """
    a, u, alpha = slope_grid()
    fit = np.where(a < 1.6, (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a), 1.0)
    exact = 1 / (1 + kernels.lambda_beckmann(u, alpha))
    error = np.abs(fit / exact - 1)
    assert 3.12e-3 < error.max() < 3.13e-3 and abs(a[error.argmax()] - 1.336) < 0.01
    assert 1.00006 < fit.max() < 1.00007
    above = a[fit > 1]
    assert 1.547 < above.min() < 1.549 and 1.598 < above.max() < 1.6
    assert (exact < 1).all() and (exact > 0).all()


def test_rational_lambda_of_renderers():
    """Lambda ~ ((0.396 a - 1.259) a + 1)/((2.181 a + 3.535) a), else 0 from a = 1.6.

    Off by up to 4.6 % for a < 1; negative from a = 1.548 on, down to -6.1e-5 where Lambda is 1.8e-3.
    """
    a, u, alpha = slope_grid()
    fit = np.where(a < 1.6, ((0.396 * a - 1.259) * a + 1) / ((2.181 * a + 3.535) * a), 0.0)
    exact = kernels.lambda_beckmann(u, alpha)
    below = a[fit < 0]
    assert 1.547 < below.min() < 1.549 and 1.598 < below.max() < 1.6
    assert (fit[a >= 1.6] == 0).all() and exact[a >= 1.6].max() > 1.5e-3
    assert np.abs(fit / exact - 1)[a < 1].max() == pytest.approx(0.0458, abs=1e-4)
    assert fit.min() == pytest.approx(-6.13e-5, rel=0.01)
    assert (exact > 0).all()
    assert lobes.worst(kernels.lambda_beckmann, lobes.lambda_beckmann, u[::40], alpha[::40])[0] <= lobes.ULPS


def test_vanishing_roughness():
    """alpha^2 underflows to 0/0 or to a wrong 0; alpha = 0 divides by 0 at u = 0."""
    tiny = 1e-170
    assert_trap(
        lambda u, a: 0.5 * (u + np.sqrt(u * u + a * a * (1 - u * u))),
        kernels.sigma_ggx,
        lobes.sigma_ggx,
        [(-tiny, tiny), (-1e-200, 1e-180)],
        0.1,
    )
    with np.errstate(all="ignore"):
        assert np.isnan(printed_beckmann(np.array([0.0]), np.array([0.0]))).all()
        # A clamp that lets numbers win over NaN hides it.
        assert np.fmax(printed_beckmann(np.array([0.0]), np.array([0.0])), 0) == 0
    for sigma in (kernels.sigma_beckmann, kernels.sigma_ggx, kernels.sigma_spherical_gaussian):
        assert sigma([-0.5, 0.0, 0.5], 0.0).tolist() == [0.0, 0.0, 0.5]
        assert np.isnan(sigma([np.nan, 0.5], [0.5, np.nan])).all()


def test_lambda_of_ggx_near_the_axis():
    """(sqrt(1 + x) - 1)/2 loses eps/x, and so does the cross-section, which holds the same difference."""
    points = [(1 - 1e-10, 0.1), (1 - 1e-9, 0.01), (0.9, 1e-6), (0.5, 1e-7)]
    assert_trap(
        lambda u, a: 0.5 * (np.sqrt(1 + a**2 * (1 / u**2 - 1)) - 1), kernels.lambda_ggx, lobes.lambda_ggx, points, 1e-6
    )
    assert_trap(
        lambda u, a: 0.5 * (u + np.sqrt(a**2 - a**2 * u**2 + u**2)),
        kernels.sigma_ggx,
        lobes.sigma_ggx,
        [(-u, alpha) for u, alpha in points],
        1e-6,
    )


def customary_ggx(u, alpha):
    """With cos^2 (alpha^2 - 1) + 1."""
    d = u * u * (alpha * alpha - 1) + 1
    return alpha * alpha / (u.dtype.type(np.pi) * d * d)


def test_density_of_ggx_at_its_peak():
    """1e-8 is lost at alpha = 1e-4, 4e-5 at 1e-6; in float32 2.6 % at 1e-3."""
    assert_trap(customary_ggx, kernels.ndf_ggx, lobes.ndf_ggx, [(1.0, 1e-6), (1.0, 3e-7), (1 - 1e-13, 3e-6)], 1e-6)
    singles = [(np.float32(1), np.float32(1e-3)), (np.float32(1 - 6e-8), np.float32(7e-4))]
    assert_trap(customary_ggx, kernels.ndf_ggx, lobes.ndf_ggx, singles, 1e-3)


def test_density_of_ggx_at_the_horizon():
    """tan^2 = 1/u^2 - 1 overflows, or u^4 underflows, and neither density is 0 there."""

    def through_the_tangent(u, alpha):
        return alpha**2 / (np.pi * u**4 * (alpha**2 + (1 / u**2 - 1)) ** 2)

    assert_trap(through_the_tangent, kernels.ndf_ggx, lobes.ndf_ggx, [(1e-90, 0.5), (1e-170, 0.5), (5e-324, 2.0)], 0.1)


def printed_ellipsoidal(u, b):
    """deon2016 (27), mended."""
    R = np.sqrt(1 - b * b * (1 - u * u))
    numerator = 1 - b * u - R + u * np.log((1 + b) * (1 - u)) - u * np.log(R - u)
    return numerator / (b * np.log((1 + b) / (1 - b)))


def test_ellipsoidal_toward_the_sphere():
    """What is left of the numerator is b^2/2: 8e-8 is lost at b = 1e-5, 9e-5 at 1e-6, everything at 1e-8."""
    points = [(0.5, 1e-6), (-0.3, 1e-7), (0.9, 1e-8), (-1.0, 1e-8)]
    assert_trap(printed_ellipsoidal, kernels.sigma_ellipsoidal, lobes.sigma_ellipsoidal, points, 1e-6)
    with np.errstate(all="ignore"):
        assert np.isnan(printed_ellipsoidal(np.array([0.5]), 0.0)).all()
    assert kernels.sigma_ellipsoidal(0.5, 0.0) == 0.25


def test_ellipsoidal_toward_the_disk():
    """R - u, which is small for u > 0 as b tends to 1 and as u does, loses its digits; (1 - u)/(R - u) ends as 0/0."""
    points = [(0.5, 1 - 1e-12), (0.999, 1 - 1e-10), (0.99, 1 - 1e-13), (1.0, 0.5), (1 - 1e-12, 0.5)]
    assert_trap(printed_ellipsoidal, kernels.sigma_ellipsoidal, lobes.sigma_ellipsoidal, points, 1e-6)
    assert kernels.sigma_ellipsoidal(0.5, 1.0) == 0.5


def printed_density(u, alpha):
    """deon2016 (28)"""
    return np.exp(2 * u / alpha**2) / np.sinh(2 / alpha**2) / (2 * np.pi * alpha**2)


def test_density_of_the_spherical_gaussian_beyond_kappa_700():
    """1/sinh is 0 and exp infinite, or the product is a wrong 0."""
    points = [(1.0, 0.05), (0.8, np.sqrt(2 / 720)), (0.99, 0.01)]
    assert_trap(printed_density, kernels.ndf_spherical_gaussian, lobes.ndf_spherical_gaussian, points, 0.1)
    singles = [(np.float32(1), np.float32(0.14))]
    assert_trap(printed_density, kernels.ndf_spherical_gaussian, lobes.ndf_spherical_gaussian, singles, 0.1)


def assert_spherical_gaussian(naive, points, loss):
    """As `assert_trap`; the kernel's own error is below a relative 3e-15."""
    for u, alpha in points:
        exact = lobes.sigma_spherical_gaussian(u, alpha)
        with np.errstate(all="ignore"):
            assert lost(naive(u, np.float64(alpha)), exact) > loss, (u, alpha)
        assert lost(kernels.sigma_spherical_gaussian(u, alpha), exact) < 3e-15


def even_series(u, alpha, terms=60):
    """deon2016 (36), summed in doubles."""
    kappa, total = 2 / alpha**2, 0.0
    for j in range(terms):
        power = alpha ** (-2.0 * j) * u ** (2 * j) / special.factorial(j)
        total += (-1) ** (j + 1) * special.iv(j + 1, kappa) * power / (2 * (2 * j - 1))
    return total / np.sinh(kappa)


def by_even_series(u, alpha):
    return even_series(u, alpha) + (2 / np.tanh(2 / alpha**2) - alpha**2) * u / 4


def test_alternating_series_for_small_roughness():
    """Right to the last place for alpha = 1; 1e-7 is lost at alpha = 0.3 in the dark; below 0.053 it overflows."""
    with np.errstate(all="ignore"):
        assert lost(by_even_series(0.5, 1.0), lobes.sigma_spherical_gaussian(0.5, 1.0)) < 1e-13
    assert_spherical_gaussian(by_even_series, [(0.3, 0.05), (-0.8, 0.2), (-0.7, 0.15)], 1e-6)
    assert_spherical_gaussian(by_even_series, [(-0.9, 0.3)], 1e-8)


def legendre_sum(u, alpha, terms=12):
    """deon2016 (38) with c_l = i_l(kappa)/(2 pi i_0(kappa)), cut after as many terms as the paper advises."""
    kappa, total = 2 / alpha**2, 0.0
    for l in range(terms):
        c_l = special.ive(l + 0.5, kappa) / special.ive(0.5, kappa) / (2 * np.pi)
        weight = np.pi**1.5 * (2 * l + 1) * special.rgamma(1.5 - l / 2) * special.rgamma(l / 2 + 2) / 4
        total += weight * c_l * special.eval_legendre(l, u)
    return total


def test_legendre_sum_for_small_roughness():
    """Right to 4e-12 for alpha = 1; for alpha = 0.1 off by 30 % at the horizon, and even in sign in the dark."""
    assert lost(legendre_sum(0.5, 1.0), lobes.sigma_spherical_gaussian(0.5, 1.0)) < 1e-11
    assert_spherical_gaussian(legendre_sum, [(0.0, 0.1), (-0.3, 0.1), (-0.6, 0.2)], 1e-2)
    assert min(legendre_sum(u, 0.1) for u in np.linspace(-1, 0, 50)) < 0


def printed_end(_, alpha):
    """deon2016 (32), which is the value at u = -1."""
    return (alpha**2 - np.exp(-2 / alpha**2) * (alpha**2 + 2)) / np.sinh(2 / alpha**2) / 4


def test_closed_forms_for_large_roughness():
    """alpha^2 - exp(-kappa) (alpha^2 + 2) is of the order of 1/alpha^2: 9e-6 is lost at alpha = 1e3, 0.25 at 1e4."""
    assert_spherical_gaussian(printed_end, [(-1.0, 1e3), (-1.0, 1e4)], 5e-6)


def test_single_precision_on_the_dark_side():
    single = np.float32

    def in_singles(u, alpha):
        s = np.sqrt(1 - u * u)
        a = u / (alpha * s)
        return single(0.5) * (u * (1 + special.erf(a)) + alpha * s * np.exp(-a * a) / single(ROOT_PI))

    points = [(single(-0.5), single(0.3)), (single(-0.9), single(0.9)), (single(-0.05), single(0.02))]
    assert_trap(in_singles, kernels.sigma_beckmann, lobes.sigma_beckmann, points, 1e-5)


def test_alpha_is_the_roughness_and_not_its_square():
    """The peak is 1/(pi alpha^2) for the three that agree there."""
    for ndf in (kernels.ndf_beckmann, kernels.ndf_ggx, kernels.ndf_spherical_gaussian):
        assert ndf(1.0, 0.01) == pytest.approx(1 / (np.pi * 1e-4), rel=1e-14)
