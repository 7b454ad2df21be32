"""The cross-section of the spherical Gaussian against the definition and the series.

`python -m tests.kernels.test_spherical_gaussian SEED` is the deep run: 4000 fresh points.
"""

import sys

import numpy as np
import pytest
from mpmath import mp, mpf

from tests.kernels import gaussian, lobes
from xsec_sym.kernels import (
    _pairs,
    _spherical_gaussian_regions,
    log_sigma_spherical_gaussian,
    ndf_spherical_gaussian,
    scaled_sigma_spherical_gaussian,
    sigma_spherical_gaussian,
)
from xsec_sym.kernels import _spherical_gaussian_tables as tables

EPS = np.finfo(float).eps
# Half of what is promised of the kernel, 16 eps.
RELATIVE = 8 * EPS
# The least sigma whose digits are promised.
LEAST = 1e-300
FORMS = [
    (sigma_spherical_gaussian, gaussian.sigma, LEAST),
    (log_sigma_spherical_gaussian, gaussian.log_sigma, 0.0),
    (scaled_sigma_spherical_gaussian, gaussian.scaled_sigma, 0.0),
]
named = pytest.mark.parametrize(("kernel", "reference", "least"), FORMS, ids=lambda part: getattr(part, "__name__", ""))


def test_references_agree():
    rng = np.random.default_rng(1)
    u, alpha = gaussian.points(rng, 4)
    with mp.workdps(40):
        for point in zip(u, alpha, strict=True):
            exact = lobes.sigma_spherical_gaussian(*point)
            assert abs(gaussian.sigma(*point) / exact - 1) < mpf("1e-24"), point


@named
def test_accuracy(kernel, reference, least):
    rng = np.random.default_rng(11)
    u, alpha = gaussian.points(rng, 40)
    error, where = gaussian.worst(kernel(u, alpha), reference, u, alpha, least)
    assert error < RELATIVE, where


@named
@pytest.mark.parametrize("alpha", [1e-4, 0.0532, 0.3, 0.5, 1.15, 2.0, 1e4])
def test_corners(kernel, reference, least, alpha):
    u = np.array([-1.0, -np.nextafter(1, 0), -0.9, -0.5, -alpha, -1e-8, -5e-324, 0.0, 1e-8, alpha, 0.9, 1.0])
    u = u[np.abs(u) <= 1]
    error, where = gaussian.worst(kernel(u, alpha), reference, u, np.full(u.size, alpha), least)
    assert error < RELATIVE, where


@named
def test_fast(kernel, reference, least):
    """A relative 1e-6 of sigma is promised, and an absolute one of its logarithm."""
    rng = np.random.default_rng(12)
    u, alpha = gaussian.points(rng, 40)
    values = kernel(u, alpha, accuracy="fast")
    if kernel is log_sigma_spherical_gaussian:
        exact = np.array([float(reference(*point)) for point in zip(u, alpha, strict=True)])
        error, where = np.abs(values - exact).max(), None
    else:
        error, where = gaussian.worst(values, reference, u, alpha, least)
    assert error < 1e-7, where
    assert not np.array_equal(values, kernel(u, alpha))


def test_accuracy_is_named():
    with pytest.raises(ValueError, match=r"'full' or 'fast', not 'best'"):
        sigma_spherical_gaussian(0.5, 0.5, accuracy="best")


@named
def test_float32(kernel, reference, least):
    """8 ulp are promised."""
    rng = np.random.default_rng(3)
    u, alpha = gaussian.points(rng, 60)
    # The least favourable places that were found: even and odd part nearly cancel.
    u = np.append(u, [-0.9841185, -0.9868693, -0.9862657, -0.9961036]).astype(np.float32)
    alpha = np.append(alpha, [1.1617032, 1.1705196, 1.1551508, 1.458135]).astype(np.float32)
    values = kernel(u, alpha)
    assert values.dtype == np.float32
    for value, *point in zip(values, u, alpha, strict=True):
        exact = reference(*point)
        if least == 0.0 or exact > 1e-36:
            assert abs(mpf(float(value)) - exact) < 8 * np.spacing(np.float32(abs(float(exact)))), point


@named
def test_float32_beyond_what_its_squares_can_hold(kernel, reference, least):
    u = np.array([-1e-30, -1.0, -1e-18, 0.0, 1e-20, 0.5], np.float32)
    for alpha in (1e-30, 1e-18, 1e18, 3e38):
        values = kernel(u, np.full_like(u, alpha))
        exact = kernel(u.astype(float), float(np.float32(alpha)))
        with np.errstate(under="ignore", over="ignore"):
            assert np.allclose(values, exact.astype(np.float32), rtol=1e-6, atol=1e-45), alpha


def test_tiny_roughness_far_from_its_layer():
    """Where it is no longer that of a flat surface; beside w, all else of the logarithm is below 1e-200."""
    u, alpha = np.array([[-1.0], [-0.5]]), np.array([1e-120, 1e-130, 1e-145, 1e-150])
    with mp.workdps(30):
        w = [[2 * (1 - mp.sqrt(1 - mpf(v) ** 2)) / mpf(rough) ** 2 for rough in alpha] for v in u.ravel()]
    assert np.allclose(log_sigma_spherical_gaussian(u, alpha), -np.array(w, float), rtol=1e-14, atol=0)
    assert np.allclose(scaled_sigma_spherical_gaussian(-1, alpha), alpha * alpha / 2, rtol=1e-14, atol=0)
    assert (scaled_sigma_spherical_gaussian(-0.5, alpha) == 0).all()


def test_the_odd_part_is_right_to_two_places():
    rng = np.random.default_rng(14)
    u, alpha = gaussian.points(rng, 400)
    # Where sigma is little more than its odd part, whose rounding errors show.
    u, alpha = np.append(u, rng.uniform(0.5, 1, 500)), np.append(alpha, rng.uniform(0.5, 2, 500))
    # Where the exponent and the mean cosine, rounded as they come, make 2.9 and 2.1 places.
    u, alpha = (
        np.append(u, [0.6863931272187602, 0.7917896376982807]),
        np.append(alpha, [0.9893545491468212, 1.1502476769089671]),
    )
    facing, away = sigma_spherical_gaussian(np.abs(u), alpha), sigma_spherical_gaussian(-np.abs(u), alpha)
    with mp.workdps(60):
        for lit, dark, *point in zip(facing, away, np.abs(u), alpha, strict=True):
            error = abs(mpf(float(lit)) - mpf(float(dark)) - gaussian.odd(*point))
            assert error <= 2 * np.spacing(lit), point


def test_sigma_rises():
    """Down by no more than rounding from any cosine to any larger one, however close."""
    rng = np.random.default_rng(15)
    edges = np.array([0.25, 0.5, 0.75, tables.LIT, np.sqrt(1 - 0.49), 1.0])
    steps = np.concatenate([1 + np.arange(-20, 21) * EPS, 1 + np.linspace(-1e-6, 1e-6, 41)])
    for alpha in np.append(10 ** rng.uniform(-4, 4, 60), np.sqrt(2 / np.array(tables.ROUND_Y))):
        layer = rng.uniform(-27, 7, 1000) * min(alpha, 0.037)
        near = np.outer(edges, steps).ravel()
        u = np.concatenate([rng.uniform(-1, 1, 1000), layer, near, -near])
        u = np.unique(u[np.abs(u) <= 1])
        sigma = sigma_spherical_gaussian(u, alpha)
        highest = np.maximum.accumulate(sigma)
        assert (sigma[1:] >= highest[:-1] * (1 - 16 * EPS)).all(), alpha


def switches():
    """Paths of 2e-4 across every border of a region or a cell: u, alpha."""
    step = 1 + np.linspace(-1e-4, 1e-4, 16)
    kappas = [*np.sqrt(tables.EVEN_Y[1:]), *tables.ROUND_Y, *(2 / np.array(tables.LAYER_Y[1:]))]
    kappas.append(_spherical_gaussian_regions.PRECISE.faint)
    for kappa in kappas:
        for u in (-0.95, -0.3, 1e-4, 0.7):
            if kappa < 1e4 or abs(u) < 1e-3:
                yield np.full(16, u), np.sqrt(2 / (kappa * step))
    for v in (*tables.ROUND_X[1:-1], tables.LIT, np.sqrt(1 - (1 / tables.LAYER_X[1] - tables.SHIFT) ** 2)):
        for alpha in (0.15, 0.3, 0.7):
            yield -v * step, np.full(16, alpha)
    for ks in (*tables.RIM_X[1:], *(1 / np.array(tables.EDGE_X[1:]))):
        for kappa in (40.0, 300.0):
            yield -np.sqrt(1 - (ks / kappa * step) ** 2), np.full(16, np.sqrt(2 / kappa))
    for alpha in (1e-4, 0.01, 0.1):
        yield np.sqrt(_spherical_gaussian_regions.PRECISE.lit_ends) * alpha * step, np.full(16, alpha)


@pytest.mark.parametrize(("u", "alpha"), list(switches()))
def test_value_and_slope_are_continuous_across_switches(u, alpha):
    lobes.assert_joined(sigma_spherical_gaussian, gaussian.sigma, u, alpha)


@named
@pytest.mark.parametrize("accuracy", ["full", "fast"])
def test_a_value_depends_on_its_arguments_alone(kernel, reference, least, accuracy):
    """Not on its place, nor on the length of the array, nor on its neighbours."""
    rng = np.random.default_rng(16)
    u, alpha = gaussian.points(rng, 20_000)
    whole = kernel(u, alpha, accuracy)
    order = rng.permutation(u.size)
    assert np.array_equal(kernel(u[order], alpha[order], accuracy), whole[order])
    for n in (1000, 17, 1):
        for start in rng.integers(0, u.size - n, 60 // n + 40):
            part = slice(start, start + n)
            assert np.array_equal(kernel(u[part], alpha[part], accuracy), whole[part])
    for i in range(40):
        assert kernel(u[i], alpha[i], accuracy) == whole[i]
    assert np.array_equal(kernel(u[:9000], 0.3, accuracy)[:300], [kernel(one, 0.3, accuracy) for one in u[:300]])


def single_samples(n):
    """Of float32: those of `gaussian.points`, and next to every edge of a cell and wherever sigma is simple."""
    rng = np.random.default_rng(19)
    u, alpha = gaussian.points(rng, n)
    kappas = [0.15, 0.25, 0.5, 1.0, 1.5, *tables.ROUND_Y, *(2 / np.array(tables.LAYER_Y[1:])), 3e3, 1e6, 1e7]
    edges = [*tables.ROUND_X[1:], tables.LIT, *(np.sqrt(1 - (1 / np.array(tables.LAYER_X[1:]) - tables.SHIFT) ** 2))]
    edges = [(v, kappa) for v in (*edges, 0.01, 0.05) for kappa in kappas]
    v, kappa = (np.outer(edge, 1 + rng.normal(0, 1e-7, 25)).ravel() for edge in zip(*edges, strict=True))
    u, alpha = np.append(u, np.minimum(v, 1)), np.append(alpha, np.sqrt(2 / kappa))
    return (rng.choice([-1, 1], u.size) * u).astype(np.float32), alpha.astype(np.float32)


@named
def test_a_value_in_float32_depends_on_its_arguments_alone(kernel, reference, least):
    u, alpha = single_samples(2000)
    assert u.size > 12_000
    whole = kernel(u, alpha)
    for n in (2000, 100):
        parts = [kernel(u[i : i + n], alpha[i : i + n]) for i in range(0, u.size, n)]
        assert np.array_equal(np.concatenate(parts), whole)
    alone = [kernel(*point) for point in zip(u[::7], alpha[::7], strict=True)]
    assert np.array_equal(alone, whole[::7])


@named
def test_numbers_too_large_for_float32_are_silent(kernel, reference, least):
    """Beside float32 they are infinite; and so is what a longdouble holds and a double does not."""
    isotropic = kernel(np.float32(0.5), np.inf)
    assert kernel(np.float32(0.5), 1e300) == isotropic and np.isnan(kernel(1e300, np.float32(0.5)))
    assert (kernel(np.full(3, 0.5, np.float32), 1e39) == isotropic).all()
    assert np.isclose(kernel(0.5, np.longdouble("1e400")), isotropic)


def test_limits():
    u = np.array([-1.0, -0.3, -1e-300, 0.0, 1e-300, 0.3, 1.0])
    assert np.array_equal(sigma_spherical_gaussian(u, 0), np.maximum(u, 0))
    assert np.array_equal(scaled_sigma_spherical_gaussian(u, 0), np.maximum(u, 0))
    with np.errstate(divide="ignore"):
        assert np.allclose(log_sigma_spherical_gaussian(u, 0), np.log(np.maximum(u, 0)), rtol=EPS, atol=0)
    for huge in (np.inf, 1e160, 1e300):
        for kernel, limit in ((sigma_spherical_gaussian, 0.25), (log_sigma_spherical_gaussian, np.log(0.25))):
            assert (kernel(u, huge) == limit).all()
        assert (scaled_sigma_spherical_gaussian(u, huge) == 0.25).all()
    for kernel, _, _ in FORMS:
        bad = kernel([np.nan, 1.1, -np.inf, 0.5, 0.5, np.nan], [0.5, 0.5, 0.5, -0.5, np.nan, 0.0])
        assert np.isnan(bad).all()
        assert np.isnan(kernel(0.5, -1e-200))
        assert kernel([], []).shape == (0,)


def test_scaled_and_logarithm_outlive_sigma():
    u, alpha = np.array([-1.0, -0.5, -0.01]), np.array([1e-4, 0.01, 1e-6])
    assert (sigma_spherical_gaussian(u, alpha) == 0).all()
    assert (scaled_sigma_spherical_gaussian(u, alpha) > 0).all()
    assert np.isfinite(log_sigma_spherical_gaussian(u, alpha)).all()
    assert scaled_sigma_spherical_gaussian(-0.5, 1e-50) > 0


def test_tiny_roughness_is_the_flat_limit_scaled():
    """sigma(u, alpha)/alpha depends on u/alpha alone."""
    for scale in (1e-30, 1e-139, 1e-141, 1e-200, 1e-300):
        u = np.array([-3.0, -1.0, -0.1, 0.0, 0.1, 1.0, 3.0])
        for kernel in (sigma_spherical_gaussian, scaled_sigma_spherical_gaussian):
            assert np.allclose(kernel(u * scale, scale) / scale, kernel(u * 1e-10, 1e-10) / 1e-10, rtol=1e-14, atol=0)
        logs = log_sigma_spherical_gaussian(u * scale, scale) - np.log(scale)
        assert np.allclose(logs, log_sigma_spherical_gaussian(u * 1e-10, 1e-10) + np.log(1e10), rtol=0, atol=1e-12)


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


def deep(seed):
    rng = np.random.default_rng(seed)
    u, alpha = gaussian.points(rng, 800)
    for kernel, reference, least in FORMS:
        for accuracy in ("full", "fast"):
            error, where = gaussian.worst(kernel(u, alpha, accuracy), reference, u, alpha, least)
            print(f"{kernel.__name__:36}{accuracy:6}{error:10.2e} = {error / EPS:.2f} eps at {where}", flush=True)


if __name__ == "__main__":
    deep(int(sys.argv[1]))
