import itertools

import numpy as np
import pytest
from mpmath import mp, mpf
from scipy.special import chdtrc
from scipy.stats import ks_2samp

from tests.kernels import lobes
from xsec_sym import kernels
from xsec_sym.kernels import (
    sample_visible_ggx,
    sample_visible_spherical_gaussian,
    visible_ggx,
    visible_normals,
    visible_spherical_gaussian,
)

DRAWS = 200_000
GGX = [(1, 0.5), (0.6, 0.3), (0.3, 5), (0.05, 0.2), (0, 1), (-0.02, 0.2), (-0.5, 0.5), (-0.9, 2), (-0.99, 0.8)]
GAUSSIAN = [(1, 0.3), (0.995, 0.1), (0.7, 0.2), (0.3, np.inf), (0.03, 0.1), (0, 0.1), (-0.05, 0.1)]
GAUSSIAN += [(-0.5, 0.3), (-0.9, 0.5), (-1, 0.7), (-1, 3), (-0.3, 20), (-0.8, 0.08)]
CASES = [("ggx", *case) for case in GGX] + [("spherical_gaussian", *case) for case in GAUSSIAN]
each_case = pytest.mark.parametrize(("name", "u", "alpha"), CASES)


def sample_ggx(u, alpha, rng, size):
    return np.stack(sample_visible_ggx(u, alpha, rng.random(size), rng.random(size)))


def sample_gaussian(u, alpha, rng, size):
    return np.stack(sample_visible_spherical_gaussian(u, alpha, rng, size))


SAMPLERS = {"ggx": sample_ggx, "spherical_gaussian": sample_gaussian}
DENSITIES = {"ggx": visible_ggx, "spherical_gaussian": visible_spherical_gaussian}


def cells(name, u, alpha):
    """Edges in (z, azimuth) about the lobe's axis, of much the same counts, from a few draws of other numbers."""
    x, y, z = SAMPLERS[name](u, alpha, np.random.default_rng(99), 4000)
    share = np.linspace(0, 1, 12)[1:-1]
    heights = np.concatenate([[-1], np.quantile(z, share), [1]])
    azimuths = np.concatenate([[-np.pi], np.quantile(np.arctan2(y, x), share), [np.pi]])
    return heights, azimuths


def probabilities(density, heights, azimuths):
    """The density's integral over each cell, by Gauss's rule on its parts; the axis is z, not the viewer."""
    nodes, weights = np.polynomial.legendre.leggauss(6)

    def rule(edges, cut=None):
        fine = [np.linspace(a, b, 5) for a, b in itertools.pairwise(edges)]
        # the outer cells are wide, and nearly all of their share is next to the others
        tail = np.concatenate([[0], np.geomspace(1e-4, 1, 24)])
        fine += [edges[1] - (edges[1] - edges[0]) * tail, edges[-2] + (edges[-1] - edges[-2]) * tail]
        fine = np.unique(np.concatenate([*fine, [cut] if cut is not None else []]))
        half = np.diff(fine)[:, None] / 2
        at = (fine[:-1, None] + half * (nodes + 1)).ravel()
        return at, (half * weights).ravel(), np.searchsorted(edges, at) - 1

    # heights as angles, since lobes are narrow in z; half a turn stands for the horizon, where GGX ends
    theta, theta_weight, row = rule(np.arccos(heights)[::-1], np.pi / 2)
    phi, phi_weight, column = rule(azimuths)
    sine = np.sin(theta)[:, None]
    values = density(sine * np.cos(phi), sine * np.sin(phi), np.cos(theta)[:, None] + 0 * phi)
    values = values * sine * theta_weight[:, None] * phi_weight
    table = np.zeros((len(heights) - 1, len(azimuths) - 1))
    np.add.at(table, (len(heights) - 2 - row[:, None] + 0 * column, column + 0 * row[:, None]), values)
    return table


def fit(name, u, alpha, normals):
    """The p-value of the chi-squared test that the normals follow the density."""
    heights, azimuths = cells(name, u, alpha)
    share = probabilities(lambda *m: DENSITIES[name](*m, u, alpha), heights, azimuths)
    # chi-squared grows by DRAWS (error of the rule)^2/share of the cell: by 0.25 if all of 1e-4 were in one
    assert share.sum() == pytest.approx(1, abs=1e-4)
    x, y, z = normals
    counts = np.histogram2d(z, np.arctan2(y, x), [heights, azimuths])[0].ravel()
    expected = share.ravel() * z.size
    rare = expected < 10
    counts = np.append(counts[~rare], counts[rare].sum())
    expected = np.append(expected[~rare], expected[rare].sum())
    used = expected > 1e-3
    assert counts[~used].sum() == 0
    return chdtrc(used.sum() - 1, ((counts - expected)[used] ** 2 / expected[used]).sum())


@each_case
def test_samples_follow_the_density(name, u, alpha):
    normals = SAMPLERS[name](u, alpha, np.random.default_rng(6), DRAWS)
    assert fit(name, u, alpha, normals) > 1e-4


@pytest.mark.parametrize("name", SAMPLERS)
@pytest.mark.parametrize(("u", "alpha"), [(0.4, 0.5), (-0.4, 0.5), (-0.05, 0.3)])
def test_wrong_samplers_are_rejected(name, u, alpha):
    rng = np.random.default_rng(7)
    sample = SAMPLERS[name]
    wrong = {
        "a tenth rougher": sample(u, 1.1 * alpha, rng, DRAWS),
        "a viewer on the other side of the horizon": sample(-u, alpha, rng, DRAWS),
        "not weighted by the cosine": sample(1.0, alpha, rng, DRAWS),
        "another viewer": sample(u + 0.02, alpha, rng, DRAWS),
    }
    for why, normals in wrong.items():
        assert fit(name, u, alpha, normals) < 1e-6, why


@each_case
def test_normals_are_unit_vectors_that_face_the_viewer(name, u, alpha):
    x, y, z = SAMPLERS[name](u, alpha, np.random.default_rng(8), 20_000)
    assert np.abs(x * x + y * y + z * z - 1).max() < 2e-15
    assert (np.sqrt((1 - u) * (1 + u)) * x + u * z).min() > -1e-15
    assert name != "ggx" or z.min() >= 0


@pytest.mark.parametrize(("name", "u", "alpha"), [case for case in CASES if case[2] < np.inf])
def test_the_mean_weight_is_a_ratio_of_cross_sections(name, u, alpha):
    """The mean of D'(m)/D(m) over visible normals is sigma'/sigma, for a D' of less roughness."""
    ndf, sigma = getattr(kernels, f"ndf_{name}"), getattr(kernels, f"sigma_{name}")
    less = 0.8 * alpha
    z = SAMPLERS[name](u, alpha, np.random.default_rng(9), DRAWS)[2]
    weights = ndf(z, less) / ndf(z, alpha)
    error = weights.std() / np.sqrt(DRAWS)
    assert abs(weights.mean() - sigma(u, less) / sigma(u, alpha)) < 4.5 * error
    assert error < 0.02 * weights.mean()


@pytest.mark.parametrize("name", DENSITIES)
def test_density_against_the_definition(name):
    """Largest found in units of the slack below: a third; for the spherical Gaussian the exponent is rounded."""
    rng = np.random.default_rng(10)
    ndf, sigma = getattr(lobes, f"ndf_{name}"), getattr(lobes, f"sigma_{name}")
    for u, alpha in GGX if name == "ggx" else [case for case in GAUSSIAN if case[1] < np.inf]:
        for x, y, z in SAMPLERS[name](u, alpha, rng, 4).T:
            with mp.workdps(50):
                facing = mp.sqrt(1 - mpf(u) ** 2) * mpf(x) + mpf(u) * mpf(z)
                exact = facing * ndf(z, alpha) / sigma(u, alpha)
            # the rounding of the cosine counts where it is nearly 0
            slack = 1e-15 * (1 + 1 / float(facing) + (2 / alpha**2 if name != "ggx" else 0))
            assert abs(float(mpf(float(DENSITIES[name](x, y, z, u, alpha))) / exact) - 1) < slack, (u, alpha, z)


def test_density_where_the_cross_section_underflows():
    u, alpha = -0.9, 0.02
    assert kernels.sigma_spherical_gaussian(u, alpha) == 0
    normals = sample_gaussian(u, alpha, np.random.default_rng(11), DRAWS)
    assert fit("spherical_gaussian", u, alpha, normals) > 1e-4


def exact_ggx(u, alpha, xi_1, xi_2):
    """The point of the cap plus the viewer, stretched back, at 60 digits."""
    with mp.workdps(400):
        u, alpha, xi_1, xi_2 = (mpf(float(value)) for value in (u, alpha, xi_1, xi_2))
        length = mp.sqrt(alpha**2 * (1 - u * u) + u * u)
        v_x, v_z = alpha * mp.sqrt(1 - u * u) / length, u / length
        c = 1 - xi_1 * (1 + v_z)
        r = mp.sqrt(1 - c * c)
        m = [alpha * (v_x + r * mp.cos(2 * mp.pi * xi_2)), alpha * r * mp.sin(2 * mp.pi * xi_2), v_z + c]
        return [float(part / mp.sqrt(sum(p * p for p in m))) for part in m]


def test_accuracy_of_the_map():
    """Largest absolute error of a component among 20 000: 1.9e-14, where the mirrored light all but turns back."""
    rng = np.random.default_rng(12)
    u = rng.choice([-1, 1], 2000) * 10 ** rng.uniform(-6, 0, 2000)
    u = np.where(rng.random(2000) < 0.5, u, -np.sign(u) * (1 - np.abs(u)))
    alpha, xi_1, xi_2 = 10 ** rng.uniform(-8, 8, 2000), rng.random(2000), rng.random(2000)
    got = np.stack(sample_visible_ggx(u, alpha, xi_1, xi_2))
    want = np.array([exact_ggx(*point) for point in zip(u, alpha, xi_1, xi_2, strict=True)]).T
    assert np.abs(got - want).max() < 1e-13


def test_acceptance():
    """The lowest found: 0.783 (u = -0.9, alpha = 0.85) among 26 788 pairs; no draw where the hat is too low."""
    u = np.concatenate([-np.logspace(0, -120, 25), [0], np.logspace(-120, 0, 25), 1 - np.logspace(-16, -1, 16)])
    u = np.concatenate([u, -1 + np.logspace(-16, -1, 16)])
    alpha = np.concatenate([np.logspace(-100, 16, 30), np.logspace(-3, 2, 21), [np.inf]])
    nodes, weights = np.polynomial.legendre.leggauss(50)
    with np.errstate(all="ignore"):
        table = visible_normals._Cosines(*(part.ravel() for part in np.meshgrid(u, alpha)))
        hat, below = table.hat_area(), np.zeros(table.u.size)
        low, high = np.maximum(-table.start - table.mode, -40 * hat), np.minimum(table.far - table.mode, 40 * hat)
        for start, end in ((low, 0), (0, high)):
            for k in range(10):
                a, b = start + (end - start) * k / 10, start + (end - start) * (k + 1) / 10
                for node, weight in zip(nodes, weights, strict=True):
                    x = table.mode + a + (b - a) * (node + 1) / 2
                    log = table.log(x) - table.top
                    right = np.where(x > table.right, table.right_rate * (table.right - x), 0)
                    cover = np.minimum(np.minimum(table.left_rate * (x - table.left), 0), right)
                    assert np.nanmax(log - cover) < 1e-12
                    below += weight * (b - a) / 2 * np.exp(log)
    assert np.isfinite(hat).all()
    assert (below / hat).min() > 1 - 1 / np.e
    assert (below / hat).max() < 1 + 1e-9


@pytest.mark.parametrize("ratio", [-2.0, -0.3, 0.0, 1.0])
@pytest.mark.parametrize("alpha", [1e-10, 1e-99])
def test_tiny_roughness_is_the_flat_limit_scaled(ratio, alpha):
    """For u = ratio alpha slopes are proportional to alpha; 1e-4 is near enough to the limit."""
    n = 20_000
    x, y, _ = sample_gaussian(ratio * alpha, alpha, np.random.default_rng(13), n) / alpha
    p, q, _ = sample_gaussian(ratio * 1e-4, 1e-4, np.random.default_rng(14), n) / 1e-4
    assert ks_2samp(x, p).pvalue > 1e-4
    assert ks_2samp(y, q).pvalue > 1e-4
    assert ks_2samp(x, 1.05 * p).pvalue < 1e-4


def test_limits():
    rng = np.random.default_rng(15)
    assert np.array_equal(sample_visible_ggx([0.5, 1], 0.0, 0.3, 0.4), [[0, 0], [0, 0], [1, 1]])
    assert np.array_equal(sample_visible_spherical_gaussian([0.5, 1], 0.0, rng), [[0, 0], [0, 0], [1, 1]])
    assert np.isnan(sample_visible_ggx([-1, 0, -0.5], [0.5, 0, 0], 0.3, 0.4)).all()
    assert np.isnan(sample_visible_spherical_gaussian([0, -0.5, -1], 0.0, rng)).all()
    _, y, z = sample_visible_spherical_gaussian(-1.0, np.inf, rng, DRAWS)
    # seen from below, the square of an isotropic normal's cosine is uniform
    assert ks_2samp(z * z, rng.random(DRAWS)).pvalue > 1e-4
    assert z.max() <= 0
    assert abs(y.mean()) < 0.01
    # a half sphere of GGX and roughness 1, seen from above: again
    assert np.allclose(sample_visible_ggx(1.0, 1.0, [0.0, 0.19, 1.0], 0.3)[2], np.sqrt([1, 0.81, 0]), atol=1e-15)
    assert np.array_equal(visible_ggx(0, 0, 1, [-1, 0.5], [0.5, 0]), [np.nan, np.nan], equal_nan=True)
    assert visible_spherical_gaussian(0, 0, 1, 1, np.inf) == pytest.approx(1 / np.pi, rel=1e-14)


@pytest.mark.parametrize("bad", [np.nan, 1.0000000000000002, -2, np.inf, -np.inf])
def test_outside_the_domain_is_nan_and_silent(bad):
    rng = np.random.default_rng(16)
    assert np.isnan(sample_visible_ggx(bad, 0.5, 0.5, 0.5)).all()
    assert np.isnan(sample_visible_ggx(0.5, 0.5, bad, 0.5)).all()
    assert np.isnan(sample_visible_ggx(0.5, 0.5, 0.5, bad)).all()
    assert np.isnan(sample_visible_spherical_gaussian([bad, 0.5], 0.5, rng))[:, 0].all()
    assert np.isnan(visible_ggx(0, 0, 1, bad, 0.5))
    assert np.isnan(visible_spherical_gaussian(0, 0, 1, bad, 0.5))
    for density in (visible_ggx, visible_spherical_gaussian):
        assert np.isnan(density(0.1, 0, 1, 0.5, 0.5))
        assert np.isnan(density(0, bad, 1, 0.5, 0.5))
    for alpha in (-0.5, np.nan, -np.inf):
        assert np.isnan(sample_visible_ggx(0.5, alpha, 0.5, 0.5)).all()
        assert np.isnan(sample_visible_spherical_gaussian(0.5, alpha, rng)).all()
        assert np.isnan(visible_ggx(0, 0, 1, 0.5, alpha))
        assert np.isnan(visible_spherical_gaussian(0, 0, 1, 0.5, alpha))
    assert np.isnan(sample_visible_ggx(0.5, np.inf, 0.5, 0.5)).all()


def test_shapes_and_dtypes():
    rng = np.random.default_rng(17)
    u, alpha = np.linspace(-1, 1, 5)[:, None], np.array([0.1, np.inf])
    for part in sample_visible_spherical_gaussian(u, alpha, rng):
        assert part.shape == (5, 2) and np.isfinite(part).all()
    assert sample_visible_spherical_gaussian(0.5, alpha, rng, size=(3, 2))[0].shape == (3, 2)
    assert sample_visible_spherical_gaussian(u[:0], alpha, rng)[0].shape == (0, 2)
    assert isinstance(sample_visible_spherical_gaussian(0.5, 0.5, rng)[0], np.float64)
    assert sample_visible_spherical_gaussian(np.float32(0.5), np.float32(0.5), rng, 3)[0].dtype == np.float32
    half = np.float32(0.5)
    assert all(part.dtype == np.float32 for part in sample_visible_ggx(half, half, half, half))
    assert sample_visible_ggx(half, half, np.zeros((2, 0)), half)[2].shape == (2, 0)
    assert visible_ggx(0, 0, np.float32(1), half, half).dtype == np.float32
    with pytest.raises(ValueError, match=r"^u and alpha of the common shape \(5, 2\) do not broadcast to the"):
        sample_visible_spherical_gaussian(u, alpha, rng, 5)
    with pytest.raises(ValueError, match=r"^these shapes do not broadcast: u"):
        sample_visible_spherical_gaussian([1, 1], [1, 1, 1], rng)
    with pytest.raises(TypeError, match=r"^rng must be a numpy\.random\.Generator, not int$"):
        sample_visible_spherical_gaussian(0.5, 0.5, 7)
    with pytest.raises(TypeError, match=r"^u must hold real numbers"):
        sample_visible_spherical_gaussian("a", 0.5, rng)


def test_each_element_has_its_own_viewer():
    """Mixed pairs in one call are drawn as those of one pair are."""
    u = np.repeat([-0.5, 0.05, 0.9], DRAWS // 4)
    alpha = np.repeat([0.4, 0.2, 0.6], DRAWS // 4)
    normals = np.stack(sample_visible_spherical_gaussian(u, alpha, np.random.default_rng(18)))
    for k in range(3):
        part = slice(k * DRAWS // 4, (k + 1) * DRAWS // 4)
        assert fit("spherical_gaussian", u[part][0], alpha[part][0], normals[:, part]) > 1e-4


def test_one_viewer_and_many_have_the_same_density():
    """A block of one viewer takes a shorter way."""
    u, z = np.linspace(-1, 1, 9), np.linspace(-0.9, 1, 20)
    x = np.sqrt(1 - z * z)
    for density in DENSITIES.values():
        many = density(x, 0, z, u[:, None], 0.4)
        assert np.array_equal(many, [density(x, 0, z, one, 0.4) for one in u], equal_nan=True)
