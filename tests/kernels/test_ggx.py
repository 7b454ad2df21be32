import numpy as np
import pytest

from tests.kernels import lobes
from xsec_sym.kernels import ggx, lambda_ggx, ndf_ggx, sigma_ggx

CASES = {
    "sigma": (sigma_ggx, lobes.sigma_ggx),
    "lambda": (lambda_ggx, lobes.lambda_ggx),
    "ndf": (ndf_ggx, lobes.ndf_ggx),
}


def samples(quantity, n, dtype=np.float64, seed=25):
    rng = np.random.default_rng(seed)
    u = lobes.cosines(rng, n)
    alpha = 10 ** rng.uniform(-4, 4, u.size)
    # u ~ alpha, where neither term under the root is negligible
    steep, its_alpha = lobes.slopes(rng, 3 * n)
    steep *= rng.choice([-1, 1], steep.size)
    u, alpha = np.concatenate([u, steep]).astype(dtype), np.concatenate([alpha, its_alpha]).astype(dtype)
    return np.abs(u) if quantity == "lambda" else u, alpha


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("quantity", CASES)
def test_accuracy(quantity, dtype):
    """Largest found among 54 000 points each: sigma 3.5, lambda 4.0, ndf 6.6 ulp; 0.5 in float32."""
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


@pytest.mark.parametrize("quantity", ["sigma", "lambda"])
@pytest.mark.parametrize("alpha", [ggx.SMALLEST, ggx.LARGEST])
def test_value_and_slope_are_continuous_at_extreme_roughness(quantity, alpha):
    kernel, reference = CASES[quantity]
    path = alpha * (1 + np.linspace(-1e-4, 1e-4, 100))
    u = min(alpha, 0.5)
    lobes.assert_joined(kernel, reference, np.full(100, -u if quantity == "sigma" else u), path)


def test_limits():
    u = np.linspace(-1, 1, 201)
    assert np.allclose(sigma_ggx(u, 1.0), (1 + u) / 2, rtol=1e-15, atol=0)
    assert np.array_equal(sigma_ggx([1.0, -1.0], 0.7), [1.0, 0.0])
    assert np.array_equal(lambda_ggx([0.0, 1.0], 0.7), [np.inf, 0.0])
    assert np.array_equal(lambda_ggx([0.0, 0.5, 1.0], 0.0), [0.0, 0.0, 0.0])
    assert np.array_equal(ndf_ggx([0.0, -0.0, -0.5], 0.7), [0.0, 0.0, 0.0])
    assert ndf_ggx(5e-324, 0.7) == pytest.approx(0.49 / np.pi, rel=1e-15)
