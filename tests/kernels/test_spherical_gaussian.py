import numpy as np
import pytest
from mpmath import mp, mpf

from tests.kernels import lobes
from xsec_sym.kernels import _pairs, ndf_spherical_gaussian, sigma_spherical_gaussian, spherical_gaussian

RELATIVE = 3e-15


def cosines_in_view(rng, alpha):
    """Half of them anywhere, half where the dark side is a number: |u| < 26 alpha."""
    u = rng.uniform(-1, 1, alpha.size)
    return np.where(rng.random(alpha.size) < 0.5, u, u * np.minimum(26 * alpha, 1.0))


def largest_error(u, alpha):
    """Relative to the definition at 30 digits, where sigma > 1e-300."""
    largest = 0.0
    for value, *point in zip(sigma_spherical_gaussian(u, alpha), u, alpha, strict=True):
        exact = lobes.sigma_spherical_gaussian(*point)
        largest = max(largest, float(abs(mpf(float(value)) / exact - 1)) if exact > 1e-300 else 0.0)
    return largest


@pytest.mark.parametrize("seed", [1, 2])
def test_accuracy(seed):
    """Largest found among 1600 points: 1.2e-15."""
    rng = np.random.default_rng(seed)
    alpha = 10 ** rng.uniform(-4, 4, 60)
    assert largest_error(cosines_in_view(rng, alpha), alpha) < RELATIVE


@pytest.mark.parametrize("alpha", [1e-4, 0.0532, 0.3, 2.0, 1e4])
def test_corners(alpha):
    u = np.array([-1.0, -np.nextafter(1, 0), -0.5, -alpha, -1e-8, 0.0, 1e-8, alpha, 0.5, 1.0])
    u = u[np.abs(u) <= 1]
    assert largest_error(u, np.full(u.size, alpha)) < RELATIVE


def test_float32():
    rng = np.random.default_rng(3)
    alpha = (10 ** rng.uniform(-4, 4, 60)).astype(np.float32)
    u = cosines_in_view(rng, alpha).astype(np.float32)
    assert lobes.worst(sigma_spherical_gaussian, lobes.sigma_spherical_gaussian, u, alpha)[0] <= 1


def test_the_rule_is_rounded_once():
    nodes, weights = spherical_gaussian._rule()
    n = spherical_gaussian.NODES
    with mp.workdps(50):
        for node, weight in zip(nodes, weights, strict=True):
            x = mp.findroot(lambda z: mp.legendre(n, z), mpf(2 * node - 1))
            slope = n * (x * mp.legendre(n, x) - mp.legendre(n - 1, x)) / (x * x - 1)
            assert abs(node / ((1 + x) / 2) - 1) < 2e-16
            assert abs(weight * (1 - x * x) * slope**2 - 1) < 2e-16


def density_samples(n, dtype=np.float64):
    rng = np.random.default_rng(28)
    u = lobes.cosines(rng, n)
    alpha = 10 ** rng.uniform(-4, 4, u.size)
    near = np.clip(1 - alpha**2 * rng.uniform(0, 385, u.size), -1, 1)
    return np.concatenate([u, near]).astype(dtype), np.concatenate([alpha, alpha]).astype(dtype)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_density(dtype):
    """Largest found among 37 000 points: 3.6 ulp; 0.5 in float32."""
    u, alpha = density_samples(300, dtype)
    error, where = lobes.worst(ndf_spherical_gaussian, lobes.ndf_spherical_gaussian, u, alpha)
    assert error <= (lobes.ULPS if dtype == np.float64 else 1), where


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_density_at_corners(dtype):
    u, alpha = lobes.corners(dtype)
    error, where = lobes.worst(ndf_spherical_gaussian, lobes.ndf_spherical_gaussian, u, alpha)
    assert error <= (lobes.ULPS if dtype == np.float64 else 1), where


def test_a_density_outlives_its_exponential():
    """exp(-x) is 0 from x = 745 on, while kappa is 2e8."""
    x = np.linspace(700, 765, 200)
    alpha = np.full(200, 1e-4)
    u = 1 - x * alpha**2 / 2
    values = ndf_spherical_gaussian(u, alpha)
    assert (values[np.exp(-x) == 0] > 0).any()
    assert lobes.worst(ndf_spherical_gaussian, lobes.ndf_spherical_gaussian, u, alpha)[0] <= lobes.ULPS


@pytest.mark.parametrize(("x", "alpha"), [(_pairs.STEEP, 0.3), (_pairs.SHIFT, 0.01)])
def test_density_is_continuous_across_switches(x, alpha):
    u = 1 - x * (1 + np.linspace(-1e-4, 1e-4, 400)) * alpha**2 / 2
    lobes.assert_joined(ndf_spherical_gaussian, lobes.ndf_spherical_gaussian, u, np.full(400, alpha))


def assert_smooth(u, alpha):
    """No kink and no jump in the relative error against the definition."""
    ratio = np.array(
        [
            float(mpf(float(value)) / lobes.sigma_spherical_gaussian(*point) - 1)
            for value, *point in zip(sigma_spherical_gaussian(u, alpha), u, alpha, strict=True)
        ]
    )
    assert np.abs(ratio).max() < RELATIVE
    assert abs(ratio[: len(ratio) // 2].mean() - ratio[len(ratio) // 2 :].mean()) < 1e-15


@pytest.mark.parametrize("u", [-0.9, 0.2])
def test_value_and_slope_are_continuous_where_the_cut_is_dropped(u):
    """Where the integrand has fallen by exp(-52) at the angle 1.2."""
    v, s = abs(u), np.sqrt(1 - u * u)
    kappa = spherical_gaussian.NEGLIGIBLE / (spherical_gaussian.WIDE * v + spherical_gaussian.WIDE**2 * s / 2)
    alpha = np.sqrt(2 / kappa) * (1 + np.linspace(-1e-4, 1e-4, 12))
    assert_smooth(np.full(12, u), alpha)


def test_value_and_slope_are_continuous_where_the_mean_cosine_switches():
    alpha = np.sqrt(2 / spherical_gaussian.SMALL_KAPPA) * (1 + np.linspace(-1e-4, 1e-4, 12))
    assert_smooth(np.full(12, 0.8), alpha)
    kappa = np.array([1e-300, 1e-8, 0.1, 1.0, np.nextafter(2, 0), 2.0, 3.0, 50.0, 1e10])
    with mp.workdps(700):
        exact = [mp.coth(mpf(float(k))) - 1 / mpf(float(k)) for k in kappa]
    with np.errstate(over="ignore"):
        values = spherical_gaussian.mean_cosine(kappa)
    assert max(abs(float(mpf(float(v)) / e - 1)) for v, e in zip(values, exact, strict=True)) < 1e-15


def test_tiny_roughness_is_the_flat_limit_scaled():
    """Below alpha = 1e-30 and above, sigma(u, alpha)/alpha depends on u/alpha alone."""
    for scale in (1e-31, 1e-200, 1e-29):
        u = np.array([-3.0, -1.0, -0.1, 0.0, 0.1, 1.0, 3.0])
        assert np.allclose(
            sigma_spherical_gaussian(u * scale, scale) / scale,
            sigma_spherical_gaussian(u * 1e-10, 1e-10) / 1e-10,
            rtol=1e-14,
            atol=0,
        )
