import numpy as np
import pytest
from mpmath import mp, mpf

from tests.kernels import lobes
from xsec_sym.kernels import _pairs, beckmann, lambda_beckmann, ndf_beckmann, sigma_beckmann

CASES = {
    "sigma": (sigma_beckmann, lobes.sigma_beckmann),
    "lambda": (lambda_beckmann, lobes.lambda_beckmann),
    "ndf": (ndf_beckmann, lobes.ndf_beckmann),
}


def samples(quantity, n, dtype=np.float64, seed=22):
    rng = np.random.default_rng(seed)
    u = lobes.cosines(rng, n)
    alpha = 10 ** rng.uniform(-4, 4, u.size)
    steep, its_alpha = lobes.slopes(rng, 3 * n)
    if quantity == "ndf":
        # tan/alpha between 0 and 28
        steep = np.sqrt((1 - steep) * (1 + steep))
    steep *= rng.choice([-1, 1], steep.size)
    u, alpha = np.concatenate([u, steep]).astype(dtype), np.concatenate([alpha, its_alpha]).astype(dtype)
    return np.abs(u) if quantity == "lambda" else u, alpha


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("quantity", CASES)
def test_accuracy(quantity, dtype):
    """Largest found among 54 000 points each: sigma 5.9, lambda 6.0, ndf 5.9 ulp; 0.5 in float32.

    An ulp of a subnormal number is 5e-324, which is the absolute floor.
    """
    kernel, reference = CASES[quantity]
    error, where = lobes.worst(kernel, reference, *samples(quantity, 300, dtype))
    assert error <= (lobes.ULPS if dtype == np.float64 else 1), where


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("quantity", CASES)
def test_corners(quantity, dtype):
    kernel, reference = CASES[quantity]
    u, alpha = lobes.corners(dtype)
    keep = u > 0 if quantity == "lambda" else u >= -1
    error, where = lobes.worst(kernel, reference, u[keep], alpha[keep])
    assert error <= (lobes.ULPS if dtype == np.float64 else 1), where


def test_the_rounding_of_the_slope_is_made_up_for():
    """Root mean square of 1.7 half-ulps of 1 where a^2 is in [1/4, 8]; 2.5 without."""
    rng = np.random.default_rng(8)
    alpha = 10 ** rng.uniform(-4, 4, 1500)
    t = np.sqrt(rng.uniform(0.25, beckmann.FAR, alpha.size)) * alpha
    u = t / np.sqrt(1 + t * t)
    with mp.workdps(50):
        points = zip(lambda_beckmann(u, alpha), u, alpha, strict=True)
        error = [float((mpf(float(value)) / lobes.lambda_beckmann(*point) - 1) * 2**53) for value, *point in points]
    assert np.sqrt(np.mean(np.square(error))) < 2.1


def test_the_far_dark_side_ends_in_subnormal_numbers():
    alpha = np.full(400, 0.1)
    a = np.linspace(26.0, 27.3, 400)
    u = -a * alpha / np.sqrt(1 + (a * alpha) ** 2)
    values = sigma_beckmann(u, alpha)
    assert (values > 0).any() and (values == 0).any() and ((values > 0) & (values < np.finfo(float).tiny)).any()
    assert lobes.worst(sigma_beckmann, lobes.sigma_beckmann, u, alpha)[0] <= lobes.ULPS


def test_a_density_outlives_its_exponential():
    """exp(-x) is 0 from x = 745 on, while its factor exceeds 1e13."""
    x = np.linspace(700, 775, 200)
    alpha = np.full(200, 1e4)
    u = 1 / np.sqrt(1 + x * alpha**2)
    values = ndf_beckmann(u, alpha)
    assert (np.exp(-x) == 0).any() and (values[np.exp(-x) == 0] > 0).any()
    assert lobes.worst(ndf_beckmann, lobes.ndf_beckmann, u, alpha)[0] <= lobes.ULPS


def test_rationals_are_the_function_they_stand_for():
    def exact(a):
        return 1 / mp.sqrt(mp.pi) - a * mp.exp(a * a) * mp.erfc(a)

    with mp.workdps(60):
        for k in range(281):
            a = mpf(k) / 10
            value = mp.polyval(beckmann._P, a) / mp.polyval(beckmann._Q, a)
            assert abs(value / exact(a) - 1) < mpf(2) ** -52
        for k in range(1, 101):
            y = mpf(1) / 800 + (mpf(1) / 8 - mpf(1) / 800) * k / 100
            value = y * mp.polyval(beckmann._P_FAR, y) / mp.polyval(beckmann._Q_FAR, y)
            assert abs(value / exact(1 / mp.sqrt(y)) - 1) < mpf(2) ** -52


@pytest.mark.parametrize("quantity", ["sigma", "lambda"])
@pytest.mark.parametrize("a", [beckmann.STEEP_SLOPE, np.sqrt(beckmann.FAR)])
def test_value_and_slope_are_continuous_across_switches(quantity, a):
    alpha = np.full(400, 0.3)
    t = (a * (1 + np.linspace(-1e-4, 1e-4, 400))) * alpha
    u = t / np.sqrt(1 + t * t)
    kernel, reference = CASES[quantity]
    lobes.assert_joined(kernel, reference, -u if quantity == "sigma" else u, alpha)


@pytest.mark.parametrize(("x", "alpha"), [(_pairs.STEEP, 0.3), (_pairs.SHIFT, 1e4)])
def test_density_is_continuous_across_switches(x, alpha):
    tangent = np.sqrt(x * (1 + np.linspace(-1e-4, 1e-4, 400))) * alpha
    lobes.assert_joined(ndf_beckmann, lobes.ndf_beckmann, 1 / np.sqrt(1 + tangent**2), np.full(400, alpha))


@pytest.mark.parametrize("alpha", [1e-100, 1e100])
def test_density_is_continuous_at_extreme_roughness(alpha):
    path = alpha * (1 + np.linspace(-1e-4, 1e-4, 100))
    lobes.assert_joined(ndf_beckmann, lobes.ndf_beckmann, np.full(100, min(1.0, 1 / alpha)), path)


def test_limits():
    assert np.array_equal(sigma_beckmann([1.0, -1.0], 0.7), [1.0, 0.0])
    assert np.array_equal(lambda_beckmann([0.0, 1.0], 0.7), [np.inf, 0.0])
    assert np.array_equal(lambda_beckmann([0.0, 0.5, 1.0], 0.0), [0.0, 0.0, 0.0])
    assert np.array_equal(ndf_beckmann([0.0, -0.0, -0.5], 0.7), [0.0, 0.0, 0.0])
    assert sigma_beckmann(0.0, 2.0) == pytest.approx(1 / np.sqrt(np.pi), rel=4e-16)
