import numpy as np
import pytest
from mpmath import mp, mpf

from tests.kernels import lobes
from xsec_sym.kernels import ellipsoidal, ndf_ellipsoidal, sigma_ellipsoidal

CASES = {
    "sigma": (sigma_ellipsoidal, lobes.sigma_ellipsoidal),
    "ndf": (ndf_ellipsoidal, lobes.ndf_ellipsoidal),
}


def samples(n, dtype=np.float64, seed=27):
    """b from 1e-8 to 1 - 1e-12, or to the last number below 1."""
    rng = np.random.default_rng(seed)
    u = lobes.cosines(rng, 2 * n)
    small, large = 10 ** rng.uniform(-8, 0, u.size // 3), 1 - 10 ** rng.uniform(-12, 0, u.size // 3)
    b = rng.permutation(np.concatenate([small, large, rng.uniform(0, 1, u.size // 3)])).astype(dtype)
    # cosines where 1 - b^2 (1 - u^2) is not dominated by either part
    tied = np.sqrt((1 - b) * (1 + b)) * rng.uniform(0, 3, b.size)
    u = np.concatenate([u, np.minimum(tied, 1) * rng.choice([-1, 1], b.size)]).astype(dtype)
    b = np.concatenate([b, b])
    return u[b < 1], b[b < 1]


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("quantity", CASES)
def test_accuracy(quantity, dtype):
    """Largest found among 54 000 points each: sigma 5.3, ndf 3.7 ulp; 0.5 in float32."""
    kernel, reference = CASES[quantity]
    error, where = lobes.worst(kernel, reference, *samples(300, dtype))
    assert error <= (lobes.ULPS if dtype == np.float64 else 1), where


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("quantity", CASES)
def test_corners(quantity, dtype):
    kernel, reference = CASES[quantity]
    shapes = np.array([1e-8, 1e-4, 0.3, np.nextafter(0.5, 0), 0.5, np.nextafter(0.5, 1), 0.99, 1 - 1e-6])
    if dtype == np.float64:
        shapes = np.concatenate([shapes, [1e-30, 1e-16, 1 - 1e-12, np.nextafter(1, 0)]])
    error, where = lobes.worst(kernel, reference, *lobes.corners(dtype, shapes))
    assert error <= (lobes.ULPS if dtype == np.float64 else 1), where


def test_log1p_defect():
    """c - log(1 + c); largest found among 3000 points: 3.1 ulp."""
    rng = np.random.default_rng(3)
    c = np.concatenate([-(10 ** rng.uniform(-30, 0, 1000)), 10 ** rng.uniform(-30, 0, 1000), rng.uniform(-1, 1, 1000)])
    with mp.workdps(100):
        error, where = lobes.worst(
            lambda c, _: ellipsoidal.log1p_defect(c),
            lambda c, _: mpf(float(c)) - mp.log1p(mpf(float(c))),
            c,
            c,
        )
    assert error <= 5, where


@pytest.mark.parametrize("u", [-0.6, 0.8, 1.0])
@pytest.mark.parametrize("b", [0.5, ellipsoidal.SMALLEST])
def test_value_and_slope_are_continuous_across_switches(u, b):
    path = b * (1 + np.linspace(-1e-4, 1e-4, 100))
    lobes.assert_joined(sigma_ellipsoidal, lobes.sigma_ellipsoidal, np.full(100, u), path)


@pytest.mark.parametrize("b", [1e-6, 0.7, 1 - 1e-9])
def test_value_is_continuous_across_the_horizon(b):
    u = np.linspace(-1e-9, 1e-9, 100)
    lobes.assert_joined(sigma_ellipsoidal, lobes.sigma_ellipsoidal, u, np.full(100, b))
