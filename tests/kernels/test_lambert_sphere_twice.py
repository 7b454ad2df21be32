"""Light that Lambertian spheres scatter twice, by an integral over the sphere: no series and no equation to solve."""

import itertools

import numpy as np
import pytest

from xsec_sym.kernels import phase_lambert_sphere
from xsec_sym.kernels.half_space_table import HalfSpaceTable
from xsec_sym.kernels.lambert_sphere import _half_space, _phase_at

# What is scattered three times is beyond the last digit.
FAINT = 1e-15
# mu_i, mu_o, phi: grazing forward, where the series of p is worst, and elsewhere.
DIRECTIONS = [
    (1e-7, 1e-7, np.pi),
    (1e-5, 3e-5, np.pi),
    (1e-6, 1e-3, np.pi),
    (1e-7, 0.004, np.pi),
    (1e-3, 3e-3, np.pi),
    (0.01, 0.02, np.pi),
    (0.03, 0.06, np.pi),
    (0.05, 0.051, np.pi),
    (0.1, 0.2, np.pi),
    (0.3, 0.35, np.pi),
    (0.3, 0.3, 0.0),
    (0.01, 0.02, 0.0),
]


def graded(low, high, n):
    """Gauss-Legendre panels on [low, high], a quarter of one another toward either end."""
    x, weight = np.polynomial.legendre.leggauss(n)
    half = 0.5 * 0.25 ** np.arange(14)[::-1]
    edges = np.concatenate([[0.0], half, (1 - half[:-1])[::-1], [1.0]])
    middle, reach = (edges[1:] + edges[:-1]) / 2, (edges[1:] - edges[:-1]) / 2
    nodes, weights = middle[:, None] + reach[:, None] * x, reach[:, None] * weight
    return low + (high - low) * nodes.ravel(), (high - low) * weights.ravel()


def twice(mu_i, mu_o, phi, n):
    """Over c^2: p p times mu_i/(mu_i + mu) for light that travels up in between, mu_o/(mu_o + mu) for light down.

    Both directions in one plane, and in it every kink of p: light in travels with (s_i, 0, -mu_i).
    """
    side = -np.cos(phi)
    assert abs(side) == 1
    azimuth, share = graded(0, np.pi, n)
    total = 0.0

    def phase(mu, other, same):
        """p of the cosine 1 - t, t half the square of a difference of unit vectors, their cosines signed."""
        s, s_other = np.sqrt((1 - mu) * (1 + mu)), np.sqrt((1 - other) * (1 + other))
        lean = (other - mu) * (other + mu) / (s + s_other)
        angle = np.sin(azimuth / 2) ** 2 if same > 0 else np.cos(azimuth / 2) ** 2
        t = (lean**2 + (mu - other) ** 2) / 2
        t = t[:, None] + 2 * (s * s_other)[:, None] * angle
        return _phase_at(np.minimum(t, 2).ravel()).reshape(t.shape)

    edges = sorted({0.0, mu_i, mu_o, min(4 * max(mu_i, mu_o), 0.9), 1.0})
    for low, high in itertools.pairwise(edges):
        mu, weight = graded(low, high, n)
        for z in (mu, -mu):
            left = (mu_i if z[0] > 0 else mu_o) / ((mu_i if z[0] > 0 else mu_o) + mu)
            product = phase(z, -mu_i, 1) * phase(z, mu_o, side)
            total += 2 * (weight * left) @ product @ share
    return total / (mu_i + mu_o)


@pytest.fixture(scope="module")
def truth():
    coarse, fine = (np.array([twice(*direction, n) for direction in DIRECTIONS]) for n in (14, 18))
    assert np.abs(coarse / fine - 1).max() < 1e-13
    return fine


def errors(multiple, truth):
    """Of light scattered once and twice, as if c were 1."""
    i, o, phi = np.array(DIRECTIONS).T
    cosine = i * o + np.sqrt((1 - i * i) * (1 - o * o)) * np.cos(phi)
    return np.abs(multiple(i, o, phi) / FAINT**2 - truth) / (truth + phase_lambert_sphere(-cosine) / (i + o))


def test_solver(truth):
    """Found: 7e-12 at cosines of 1e-7, 1.1e-12 above 1e-3."""
    error = errors(_half_space(FAINT, True).multiple, truth)
    assert error.max() < 1.5e-11 and error[4:].max() < 2e-12


def test_tables(truth):
    """Found: the same."""
    error = errors(HalfSpaceTable(_half_space(FAINT, True)).multiple, truth)
    assert error.max() < 1.5e-11 and error[4:].max() < 2e-12
