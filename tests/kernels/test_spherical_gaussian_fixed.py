import numpy as np
import pytest
from mpmath import mp, mpf

from tests.kernels import gaussian
from xsec_sym.kernels import sigma_spherical_gaussian, specialize_spherical_gaussian

EPS = np.finfo(float).eps
ROUGHNESSES = [1e-4, 0.0037, 0.05, 0.08, 0.2, 0.52, 1.1, 1.7, 40.0, 1e4]


def cosines(rng, alpha):
    layer = np.minimum(1, 27 * alpha)
    return np.concatenate(
        [rng.uniform(-1, 1, 20), rng.uniform(-1, 0.3, 30) * layer, [-1, -0.9, -1e-9, 0, 1e-9, 0.9, 1]]
    )


@pytest.mark.parametrize("alpha", ROUGHNESSES)
def test_errors(alpha):
    """Absolute and relative ones at the same cosines, for a reference costs more than all kernels."""
    u = cosines(np.random.default_rng(1), alpha)
    for tol in (5e-16, 1e-10, 1e-7):
        with mp.workdps(40):
            for value, cosine in zip(specialize_spherical_gaussian(alpha, tol)(u), u, strict=True):
                assert abs(mpf(float(value)) - gaussian.sigma(cosine, alpha)) <= tol, (tol, cosine)
    error, where = gaussian.worst(
        specialize_spherical_gaussian(alpha)(u), gaussian.sigma, u, np.full(u.size, alpha), 1e-300
    )
    assert error < 8 * EPS, where


@pytest.mark.parametrize("alpha", [0.004, 0.3, 3.0])
@pytest.mark.parametrize("tol", [5e-16, None, 1e-7])
def test_sigma_rises_and_pieces_join(alpha, tol):
    sigma = specialize_spherical_gaussian(alpha, tol)
    u = np.sort(np.random.default_rng(3).uniform(-1, 1, 20_000))
    ends = np.linspace(0, sigma.end, sigma.pieces.shape[1])[1:]
    ends = 2 * ends / (1 + ends**2) if tol is None else ends
    u = np.unique(np.clip(np.concatenate([u, -ends * (1 - EPS), -ends * (1 + EPS), ends]), -1, 1))
    values = sigma(u)
    room = 16 * EPS * values[:-1] if tol is None else 2 * tol
    assert (values[1:] >= np.maximum.accumulate(values)[:-1] - room).all()


@pytest.mark.parametrize("alpha", [0.0, 1e-200, 1e200, np.inf])
@pytest.mark.parametrize("tol", [None, 1e-7])
def test_limits(alpha, tol):
    u = np.linspace(-1, 1, 11)
    assert np.array_equal(specialize_spherical_gaussian(alpha, tol)(u), sigma_spherical_gaussian(u, alpha))


@pytest.mark.parametrize("tol", [5e-16, None, 1e-7])
def test_arguments(tol):
    sigma = specialize_spherical_gaussian(0.3, tol)
    assert np.isnan(sigma([1.1, -2, np.nan, np.inf])).all()
    assert sigma(np.float32([0.5, -0.5])).dtype == np.float32
    assert sigma(np.zeros((2, 0, 3))).shape == (2, 0, 3)
    assert isinstance(sigma(0.5), np.float64)
    with pytest.raises(TypeError, match="u must hold real numbers"):
        sigma(1j)


@pytest.mark.parametrize("alpha", [-1.0, np.nan])
def test_no_roughness(alpha):
    with pytest.raises(ValueError, match="alpha must be a roughness"):
        specialize_spherical_gaussian(alpha)


@pytest.mark.parametrize("tol", [0.0, 1e-16, -1.0, np.nan, np.inf])
def test_no_tolerance(tol):
    with pytest.raises(ValueError, match="tol must be at least 5e-16"):
        specialize_spherical_gaussian(0.3, tol)
