"""The derivatives of the spherical Gaussian's cross-section against the definition.

`python -m tests.kernels.test_spherical_gaussian_slopes SEED` is the deep run: 600 fresh points.
"""

import sys
from pathlib import Path

import numpy as np
import pytest
from mpmath import mp, mpf

from tests.kernels import gaussian, gaussian_slopes
from tests.kernels.test_spherical_gaussian import switches
from xsec_sym.export import spherical_gaussian_slopes as generator
from xsec_sym.kernels import (
    _spherical_gaussian_slopes_tables as tables,
)
from xsec_sym.kernels import (
    sigma_spherical_gaussian,
    sigma_spherical_gaussian_dalpha,
    sigma_spherical_gaussian_du,
)

EPS = np.finfo(float).eps
# 64 eps are promised.
RELATIVE = 8 * EPS
KERNELS = [sigma_spherical_gaussian_du, sigma_spherical_gaussian_dalpha]
both = pytest.mark.parametrize("kernel", KERNELS)
# One cell of each region, of either derivative; the layer by u, too, where there is time.
PART = [("U_", "EVEN", 1), ("KAPPA_", "ROUND", 6), ("KAPPA_", "LAYER", 8), ("U_", "RIM", 0), ("KAPPA_", "EDGE", 2)]
PART += [pytest.param("U_", "LAYER", 1, marks=pytest.mark.deep)]


def worst(kernel, u, alpha):
    """The largest error, of the derivative by alpha relative to the moduli of its two parts; and where it occurs."""
    largest = (0.0, None)
    with mp.workdps(40):
        for value, *point in zip(kernel(u, alpha), u, alpha, strict=True):
            if kernel is sigma_spherical_gaussian_du:
                parts = (gaussian_slopes.by_u(*point),)
            else:
                parts = gaussian_slopes.parts_by_alpha(*point)
            scale = sum(map(abs, parts))
            assert np.isfinite(value), point
            if scale > 1e-300:
                error = float(abs(mpf(float(value)) - sum(parts)) / scale)
                largest = max(largest, (error, tuple(map(float, point))), key=lambda pair: pair[0])
    return largest


def test_references_are_derivatives():
    """Of a reference that is differentiated by none of them."""
    step = mpf(2) ** -20
    for u, alpha in ((-0.75, 0.5), (0.25, 0.75), (-0.125, 0.0625), (0.5, 3.0)):
        with mp.workdps(40):

            def slope(of, at):
                near, far = ((of(at + k * step) - of(at - k * step)) / (2 * k * step) for k in (1, 2))
                return (4 * near - far) / 3

            by_u = slope(lambda x, alpha=alpha: gaussian.sigma(float(x), alpha), mpf(u))
            by_alpha = slope(lambda x, u=u: gaussian.sigma(u, float(x)), mpf(alpha))
            assert abs(gaussian_slopes.by_u(u, alpha) / by_u - 1) < mpf("1e-15")
            assert abs(gaussian_slopes.by_alpha(u, alpha) / by_alpha - 1) < mpf("1e-15")


@both
def test_accuracy(kernel):
    u, alpha = gaussian.points(np.random.default_rng(31), 9)
    error, where = worst(kernel, u, alpha)
    assert error < RELATIVE, where


@both
@pytest.mark.parametrize("alpha", [1e-4, 0.0532, 0.3, 0.51, 1.15, 2.0, 1e4])
def test_corners(kernel, alpha):
    u = np.array([-1.0, -0.9, -alpha, -1e-9, 0.0, 1e-9, 0.9, 1.0])
    u = u[np.abs(u) <= 1]
    error, where = worst(kernel, u, np.full(u.size, alpha))
    assert error < RELATIVE, where


@both
def test_no_jump_at_a_switch(kernel):
    """As right on either side of a border of a region or a cell."""
    sides = [(u[i], alpha[i]) for u, alpha in list(switches())[::5] for i in (7, 8)]
    error, where = worst(kernel, *np.array(sides).T)
    assert error < RELATIVE, where


def test_exact_relations():
    """sigma'(u) + sigma'(-u) = c, and both differentiate sigma: 2 points of Gauss in each of 400 steps."""
    rng = np.random.default_rng(33)
    u, alpha = gaussian.points(rng, 2000)
    total = sigma_spherical_gaussian_du(u, alpha) + sigma_spherical_gaussian_du(-u, alpha)
    kappa = 2 / alpha**2
    chosen = kappa > 1
    assert np.allclose(total[chosen], (1 / np.tanh(kappa) - 1 / kappa)[chosen], rtol=8 * EPS, atol=0)
    edges = np.linspace(0, 1, 401)
    places = edges[:-1, None] + (0.5 + np.array([-0.5, 0.5]) / np.sqrt(3)) / 400
    for alpha in (0.1, 0.5, 0.9, 3.0):
        for sign in (-1, 1):
            gain = sigma_spherical_gaussian_du(sign * places, alpha).mean() * sign
            exact = sigma_spherical_gaussian(sign, alpha) - sigma_spherical_gaussian(0, alpha)
            assert abs(gain - exact) < 1e-9
    for u in (-0.7, -0.05, 0.3, 0.95):
        gain = sigma_spherical_gaussian_dalpha(u, 0.3 + 0.7 * places).mean() * 0.7
        assert abs(gain - (sigma_spherical_gaussian(u, 1.0) - sigma_spherical_gaussian(u, 0.3))) < 1e-9


def test_signs():
    """By u it is positive and rises; by alpha it changes sign once, facing, at 0.363 at most."""
    u = np.linspace(-1, 1, 4001)
    for alpha in np.logspace(-3, 3, 61):
        by_u, by_alpha = sigma_spherical_gaussian_du(u, alpha), sigma_spherical_gaussian_dalpha(u, alpha)
        assert (by_u >= 0).all() and (np.diff(by_u) >= -8 * EPS * by_u[1:]).all()
        changes = (np.diff(np.sign(by_alpha[u >= 0])) < 0).nonzero()[0]
        assert (by_alpha[u <= 0] >= 0).all() and len(changes) == 1 and changes[0] / 2000 < 0.363
    assert sigma_spherical_gaussian_dalpha(0.2499 / 1e4, 100) > 0 > sigma_spherical_gaussian_dalpha(0.2501 / 1e4, 100)


def test_limits():
    u = np.array([-1.0, -0.3, -1e-300, 0.0, 1e-300, 0.3, 1.0])
    assert sigma_spherical_gaussian_du(u, 0).tolist() == [0, 0, 0, 0.5, 1, 1, 1]
    assert np.allclose(sigma_spherical_gaussian_dalpha(u, 0), [0, 0, 0, 0.5 / np.sqrt(np.pi), 0, 0, 0], EPS, 0)
    for kernel in KERNELS:
        assert (kernel(u, np.inf) == 0).all() and (np.abs(kernel(u, 1e300)) < 1e-290).all()
        bad = kernel([np.nan, 1.1, -np.inf, 0.5, 0.5, np.nan], [0.5, 0.5, 0.5, -0.5, np.nan, 0.0])
        assert np.isnan(bad).all()
        assert kernel([], []).shape == (0,)
        assert type(kernel(np.float32(0.5), np.float32(0.5))) is np.float32


@both
def test_tiny_roughness_is_the_flat_limit(kernel):
    u = np.array([-3.0, -1.0, -0.1, 0.0, 0.1, 1.0, 3.0])
    for scale in (1e-30, 1e-139, 1e-141, 1e-200, 1e-300):
        assert np.allclose(kernel(u * scale, scale), kernel(u * 1e-20, 1e-20), rtol=1e-13, atol=0)


@both
def test_a_value_depends_on_its_arguments_alone(kernel):
    u, alpha = gaussian.points(np.random.default_rng(36), 8000)
    whole = kernel(u, alpha)
    for n in (1000, 17, 1):
        for start in (0, 9_000, 17_111, 33_333):
            part = slice(start, start + n)
            assert np.array_equal(kernel(u[part], alpha[part]), whole[part])


@pytest.mark.parametrize(("prefix", "name", "i"), PART)
def test_a_part_is_what_the_generator_writes(prefix, name, i):
    place = generator.region(prefix, name)
    assert generator.table(place, place.cells()[i]) == getattr(tables, prefix + name)[i]


def test_the_lines_are_what_the_generator_writes():
    for name, row in generator.lines().items():
        assert getattr(tables, name) == row
    assert "do not edit" in Path(tables.__file__).read_text()


@pytest.mark.parametrize("prefix", generator.SLOPES)
@pytest.mark.parametrize("name", generator.FUNCTIONS)
def test_tables_are_as_accurate_as_allowed(prefix, name):
    """At other points than those they are made from, in every cell."""
    place, found = generator.region(prefix, name), getattr(tables, prefix + name)
    assert len(found) == len(place.cells())
    for cell, table in zip(place.cells(), found, strict=True):
        assert generator.sigma.error(place, cell, table, 3, 77) < generator.ALLOWED, cell


def deep(seed):
    u, alpha = gaussian.points(np.random.default_rng(seed), 120)
    for kernel in KERNELS:
        error, where = worst(kernel, u, alpha)
        print(f"{kernel.__name__:36}{error:10.2e} = {error / EPS:.2f} eps at {where}", flush=True)


if __name__ == "__main__":
    deep(int(sys.argv[1]))
