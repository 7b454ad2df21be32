import functools

import numpy as np
import pytest
from mpmath import mp, mpf

from tests.kernels.oracle import ulps, worst_ulps
from xsec_sym.kernels import (
    HalfSpace,
    _lambert_sphere_fit,
    _lambert_sphere_table,
    albedo_lambert_sphere,
    albedo_lambert_sphere_inverse,
    brdf_lambert_sphere,
    lambert_sphere_coefficients,
    phase_lambert_sphere,
    sample_lambert_sphere,
)
from xsec_sym.kernels.half_space import crowded_nodes
from xsec_sym.kernels.half_space_table import LOWEST, HalfSpaceTable, _factors
from xsec_sym.kernels.lambert_sphere import MANY, MIDDLE, MOST_ALBEDOS, TAIL

ULPS = 8


def phase_from_definition(mu):
    """Lit and seen points of the unit sphere, each a Lambertian emitter: cosines over pi, twice, per projected area pi.

    Both directions in the equator: cos^3 over latitudes is 4/3, and their arcs overlap in (theta - pi/2, pi/2).
    """
    back = mp.pi - mp.acos(mu)
    arc = mp.quad(lambda angle: mp.cos(angle) * mp.cos(angle - back), [back - mp.pi / 2, mp.pi / 2])
    return mpf(4) / 3 * arc / mp.pi**2


def phase(mu):
    """The closed form, which `test_phase_is_that_of_a_sphere` compares with the definition."""
    return 2 * (mp.sqrt(1 - mu * mu) - mu * mp.acos(mu)) / (3 * mp.pi**2)


def above(mu):
    """The part that is scattered to cosines above mu, by theta = acos mu."""
    theta = mp.acos(mu)
    return (2 * theta * (2 + mp.cos(2 * theta)) - 3 * mp.sin(2 * theta)) / (6 * mp.pi)


def quantile(xi, start):
    """mu with above(mu) = 1 - xi by Newton's method in 1 - mu, at the working precision."""
    xi = mpf(float(xi))
    if xi in (0, 1):
        return 2 * xi - 1
    t = 1 - mpf(float(start)) or mpf(10) ** -7
    for _ in range(6):
        t -= (above(1 - t) - (1 - xi)) / (2 * mp.pi * phase(1 - t))
    assert abs(above(1 - t) / (1 - xi) - 1) < mpf(10) ** -40
    return 1 - t


def test_phase_is_that_of_a_sphere():
    for mu in (mpf(-1), mpf("-0.4"), mpf(0), mpf("0.3"), mpf("0.999")):
        assert abs(phase(mu) - phase_from_definition(mu)) < mpf(10) ** -14
        assert abs(above(mu) - 2 * mp.pi * mp.quad(phase, [mu, 1])) < mpf(10) ** -13


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_phase_accuracy(dtype):
    """Largest found among 10 000 points: 3.8 ulp; 0.5 in float32."""
    rng = np.random.default_rng(1)
    ends = 10 ** rng.uniform(-16, 0, 150)
    mu = np.concatenate(
        [rng.uniform(-1, 1, 400), 1 - ends, ends - 1, ends, -ends, MIDDLE + np.linspace(-1e-6, 1e-6, 60)]
    )
    mu = np.concatenate([mu, [-1, 0, 1, np.nextafter(1, 0), 5e-324]]).astype(dtype)
    with mp.workdps(60):
        references = [phase(mpf(float(x))) for x in mu]
    assert worst_ulps(phase_lambert_sphere(mu), references) <= (ULPS if dtype == np.float64 else 1)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_sample_accuracy(dtype):
    """Ulps of mu, for xi as given, near 5/6 too. Largest found among 3 000 points: 5.6 ulp; 0.5 in float32."""
    rng = np.random.default_rng(2)
    ends = 10 ** rng.uniform(-16, -0.5, 80)
    joints = [float(1 - above(mpf(mu))) for mu in (-MIDDLE, MIDDLE)]
    xi = np.concatenate([rng.uniform(0, 1, 200), 1 - ends, ends, 5 / 6 + ends / 2, 5 / 6 - ends / 2, [0, 1, 5 / 6]])
    xi = np.concatenate([xi, *(joint + np.linspace(-1e-3, 1e-3, 30) for joint in joints)])
    xi = xi[xi <= 1].astype(dtype)
    mu = sample_lambert_sphere(xi)
    with mp.workdps(60):
        found = [ulps(value, quantile(x, value)) for x, value in zip(xi, mu, strict=True)]
    assert max(found) <= (ULPS if dtype == np.float64 else 1), xi[int(np.argmax(found))]


def test_sample_is_increasing_and_meets_its_corners():
    xi = np.linspace(0, 1, 200_001)
    mu = sample_lambert_sphere(xi)
    assert mu[0] == -1 and mu[-1] == 1 and np.all(np.diff(mu) > 0)
    assert (
        sample_lambert_sphere(1 - 2.0**-53) < 1 and np.isnan(sample_lambert_sphere([-1e-300, 1 + 1e-15, np.nan])).all()
    )
    assert np.isnan(phase_lambert_sphere([-1.0001, 1.0001, np.nan, np.inf])).all()
    # deon2021:7 claims 0.0005
    approximation = 1 - 2 * (1 - xi ** (0.0401885 * xi + 1.01938)) ** 0.397225
    assert abs(mu - approximation).max() < 0.0006


def three_numbers(rng, n):
    """`deon2021:6` as printed."""
    a, b, c = rng.random((3, n))
    return np.sqrt((1 - a) * (1 - b)) * np.sin(2 * np.pi * c) - np.sqrt(a * b)


def test_sample_has_the_distribution_of_the_exact_procedure():
    """Kolmogorov's distance of two samples; 1.95 sqrt(2/n) is exceeded once in a thousand."""
    n = 400_000
    rng = np.random.default_rng(6)
    printed = np.sort(three_numbers(rng, n))
    mu = sample_lambert_sphere((np.arange(n) + 0.5) / n)
    rank = np.searchsorted(mu, printed) / n
    assert abs(rank - np.arange(n) / n).max() < 1.95 / np.sqrt(n)


def test_coefficients():
    """(2 l + 1) 2 pi integral of p P_l, on a grid that knows the root at either end."""
    theta, weight = np.polynomial.legendre.leggauss(200)
    theta, weight = (theta + 1) * np.pi / 2, weight * np.pi / 2
    p = 2 * (np.sin(theta) - theta * np.cos(theta)) / (3 * np.pi**2) * np.sin(theta) * weight
    for order, a in enumerate(lambert_sphere_coefficients(20)):
        legendre = np.polynomial.legendre.Legendre.basis(order)(np.cos(theta))
        assert a == pytest.approx(2 * np.pi * (2 * order + 1) * np.sum(p * legendre), abs=1e-13)
    assert lambert_sphere_coefficients(0).tolist() == [1.0]
    with pytest.raises(ValueError, match="at least 0"):
        lambert_sphere_coefficients(-1)


DIRECTIONS = np.concatenate([[0, 1e-9, 1e-5, 1e-3, 0.01], np.linspace(0.05, 1, 9)])
AZIMUTHS = np.array([0, 1.0, 2.0, 2.8, np.pi])


def directions():
    i, o, phi = (x.ravel() for x in np.meshgrid(DIRECTIONS, DIRECTIONS, AZIMUTHS, indexing="ij"))
    seen = i + o > 0
    return i[seen], o[seen], phi[seen]


def single(i, o, phi, c):
    with mp.workdps(40):
        values = []
        for a, b, angle in zip(i, o, phi, strict=True):
            a, b, angle = (mpf(float(x)) for x in (a, b, angle))
            cosine = a * b + mp.sqrt((1 - a * a) * (1 - b * b)) * mp.cos(angle)
            values.append(float(c * phase(-cosine) / (a + b)))
    return np.array(values)


@pytest.fixture(scope="module", params=[1e-3, 0.7, 1.0])
def c(request):
    """A single-scattering albedo; tests with the same one follow each other, and share `finer`."""
    return request.param


@functools.lru_cache(maxsize=1)
def finer(c):
    """More modes, twice the orders and more nodes, which leaves 1e-12 to 2e-12 at cosines of 1e-7."""
    highest = dict.fromkeys(range(3), 800) | {4: 560, 6: 480, 8: 400, 10: 320, 12: 240}
    coefficients = lambert_sphere_coefficients(800)
    return HalfSpace(coefficients, c, modes=56, core=56, nodes=100, highest=lambda mode: highest.get(mode, 160))


def test_brdf_accuracy(c):
    """Found: 8e-12 forward where the cosines add up to less than 0.1, 1.2e-12 elsewhere."""
    i, o, phi = directions()
    truth = single(i, o, phi, c) + finer(c).multiple(i, o, phi)
    error = abs(brdf_lambert_sphere(i, o, phi, c) / truth - 1)
    assert error.max() < 1.5e-11
    assert error[(phi < 2.5) | (i + o > 0.1)].max() < 3e-12


def test_brdf_of_many_directions(c):
    """The tables, at cosines and azimuths that no table has seen. Found: 7e-12 where both graze, forward, 6e-12
    elsewhere. A few are below what the tables reach."""
    rng = np.random.default_rng(7)
    i, o = rng.uniform(0, 1, (2, MANY))
    i[::3], o[::6] = 10 ** rng.uniform(-7, 0, i[::3].size), 10 ** rng.uniform(-7, 0, o[::6].size)
    i[:4], o[2:6] = [0, 1, 1e-12, LOWEST / 2], [1, 1, LOWEST, 0]
    phi = rng.uniform(-np.pi, np.pi, MANY)
    phi[::5] = np.pi
    few = np.concatenate([np.arange(6), rng.choice(MANY, 400, replace=False)])
    f = brdf_lambert_sphere(i, o, phi, c)[few]
    i, o, phi = i[few], o[few], phi[few]
    truth = single(i, o, phi, c) + finer(c).multiple(i, o, phi)
    assert abs(f / truth - 1).max() < 1.5e-11
    assert np.allclose(f, brdf_lambert_sphere(i, o, phi, c), rtol=1.5e-11, atol=0)


def test_table_of_another_half_space():
    """Forward-peaked scatterers, modes of every parity, and modes without light."""
    rng = np.random.default_rng(8)
    mu_i, mu_o, phi = rng.uniform(LOWEST, 1, 500), 10 ** rng.uniform(-7, 0, 500), rng.uniform(-np.pi, np.pi, 500)
    order = np.arange(40)
    for a in ([1.0], [1.0, 0.0, 0.5], (2 * order + 1) * 0.5**order):
        half = HalfSpace(a, 0.95, core=40)
        difference = HalfSpaceTable(half).multiple(mu_i, mu_o, phi) - half.multiple(mu_i, mu_o, phi)
        assert abs(difference).max() < 1e-12
    assert np.all(HalfSpaceTable(HalfSpace([1.0], 0.0)).multiple(mu_i, mu_o, phi) == 0)


@pytest.mark.parametrize("rank", [5, 30, 100])
def test_factors_of_tables_of_any_rank(rank):
    """More than the first guess of columns holds, too."""
    rng = np.random.default_rng(9)
    a = rng.normal(size=(100, rank)) @ rng.normal(size=(rank, 100))
    left, right = _factors(a, 1e-9)
    assert left.shape == right.shape == (100, rank)
    assert np.allclose(left @ right.T, a, rtol=0, atol=1e-11)


def test_brdf_conserves_energy():
    """p's kink straight back asks for so many nodes; the error falls with the fifth power. Found: 8e-12."""
    mu_o, weight = crowded_nodes(240, 4)
    phi = np.arange(192) * (2 * np.pi / 192)
    for mu_i in (0.001, 0.2, 0.6, 1.0):
        f = brdf_lambert_sphere(mu_i, mu_o[:, None], phi, 1.0)
        albedo = 2 * np.pi / 192 * np.sum(f * (weight * mu_o)[:, None])
        assert albedo == pytest.approx(1, abs=2e-11)


def test_brdf_against_random_walks():
    """Moments of what leaves, for walks by `deon2021:6`, to 4.5 standard deviations: no transport theory in common."""
    c, mu_i, n = 0.8, 0.6, 120_000
    rng = np.random.default_rng(5)
    w = np.tile([-np.sqrt(1 - mu_i**2), 0.0, -mu_i], (n, 1))
    depth, weight, out = np.zeros(n), np.ones(n), []
    for _ in range(60):
        depth = depth - w[:, 2] * rng.exponential(size=depth.size)
        gone = depth < 0
        out.append((w[gone], weight[gone]))
        w, depth, weight = w[~gone], depth[~gone], c * weight[~gone]
        mu, angle = three_numbers(rng, depth.size), rng.uniform(0, 2 * np.pi, depth.size)
        axis = np.where(abs(w[:, :1]) < 0.7, [[1.0, 0, 0]], [[0, 1.0, 0]])
        u = np.cross(w, axis)
        u /= np.linalg.norm(u, axis=1)[:, None]
        side = np.cos(angle)[:, None] * u + np.sin(angle)[:, None] * np.cross(w, u)
        w = mu[:, None] * w + np.sqrt(1 - mu * mu)[:, None] * side
    w, weight = np.concatenate([a for a, _ in out]), np.concatenate([a for _, a in out])

    moments = (
        lambda x, y, z: np.ones_like(z),
        lambda x, y, z: z,
        lambda x, y, z: x,
        lambda x, y, z: x * x - y * y,
        lambda x, y, z: np.exp(4 * (x * np.sqrt(1 - mu_i**2) + z * mu_i - 1)),
    )
    mu_o, share = crowded_nodes(30, 2)
    phi = np.arange(64) * (2 * np.pi / 64)
    f = brdf_lambert_sphere(mu_i, mu_o[:, None], phi, c) * (mu_o * share)[:, None] * (2 * np.pi / 64)
    x, y = (np.sqrt(1 - mu_o**2)[:, None] * turn(phi) for turn in (np.cos, np.sin))
    for moment in moments:
        values = weight * moment(*w.T)
        mean, square = values.sum() / n, (values**2).sum() / n
        deviation = np.sqrt((square - mean**2) / n)
        assert abs(mean - np.sum(f * moment(x, y, mu_o[:, None] + 0 * x))) < 4.5 * deviation
        assert deviation < 2e-3


def test_brdf_symmetries_and_limits():
    i, o, phi = directions()
    c = np.resize([0.0, 0.4, 1.0], i.size)
    f = brdf_lambert_sphere(i, o, phi, c)
    assert np.all(f[c > 0] > 0) and np.all(f[c == 0] == 0)
    assert np.allclose(f, brdf_lambert_sphere(o, i, -phi, c), rtol=1e-13, atol=0)
    assert np.allclose(f, brdf_lambert_sphere(i, o, phi + 2 * np.pi, c), rtol=1e-9, atol=0)
    assert np.array_equal(brdf_lambert_sphere(0.0, [0.0, 0.0, 0.5], 1.0, [0.4, 0.0, 0.0]), [np.inf, np.inf, 0.0])
    bad = [(-0.1, 0.5, 0, 0.4), (0.5, 1.1, 0, 0.4), (0.5, 0.5, np.inf, 0.4), (0.5, 0.5, 0, 1.1), (0.5, 0.5, 0, np.nan)]
    assert all(np.isnan(brdf_lambert_sphere(*arguments)) for arguments in bad)
    single_precision = brdf_lambert_sphere(*(np.float32(x) for x in (0.5, 0.25, 1.0, 0.4)))
    assert single_precision.dtype == np.float32
    assert brdf_lambert_sphere(np.ones((2, 1)), np.ones(0), 0.0, 0.4).shape == (2, 0)


def test_too_many_albedos():
    c = np.linspace(0, 1, MOST_ALBEDOS + 1)
    with pytest.raises(ValueError, match=f"{MOST_ALBEDOS + 1} distinct values of c in a call, of which at most 64"):
        brdf_lambert_sphere(0.5, 0.5, 0.0, c)


def test_albedo_is_that_of_the_brdf():
    mu, weight = crowded_nodes(24, 3)
    phi = np.arange(32) * (2 * np.pi / 32)
    for c in (0.2, 0.9):
        f = brdf_lambert_sphere(mu[:, None, None], mu[:, None], phi, c).mean(-1)
        share = weight * mu
        assert albedo_lambert_sphere(c) == pytest.approx(4 * np.pi * share @ f @ share, rel=1e-6)


def test_albedo_accuracy():
    """Relative, of k_d and of 1 - k_d. Found: 1e-15 below c = 1/2, 1e-12 of k_d above, the reference's own."""
    low = np.concatenate([10.0 ** np.arange(-9, 0), [0.3, np.nextafter(0.5, 0)]])
    high = np.concatenate([[0.5, 0.7, 0.9], 1 - 10.0 ** np.arange(-9, -1)])
    for c in np.concatenate([low, high]):
        half = HalfSpace(lambert_sphere_coefficients(120), c, core=80, nodes=130)
        k_d = albedo_lambert_sphere(c)
        if c < 0.5:
            assert k_d == pytest.approx(half.bond_albedo(), rel=1e-12, abs=0)
        else:
            # what k_d itself can show of 1 - k_d
            assert 1 - k_d == pytest.approx(half.absorbed(), rel=1e-12, abs=2e-16)
            assert k_d == pytest.approx(half.bond_albedo(), rel=1e-11)


def test_albedo_table_is_what_its_script_writes():
    for name, values in _lambert_sphere_fit.table().items():
        assert np.allclose(values, getattr(_lambert_sphere_table, name), rtol=0, atol=5e-14)
        assert abs(np.array(values[-3:])).max() < 1e-14


def test_albedo_inverse():
    c = np.concatenate(
        [[0.0], 10.0 ** np.arange(-300, 0, 10), np.linspace(0.01, 0.99, 99), 1 - 10.0 ** np.arange(-16, -1)]
    )
    back = albedo_lambert_sphere_inverse(albedo_lambert_sphere(c))
    # k_d near 1 resolves c better than c itself
    assert np.allclose(back, c, rtol=2e-15, atol=0)
    k_d = np.linspace(0, 1, 4001)
    c = albedo_lambert_sphere_inverse(k_d)
    assert c[0] == 0 and c[-1] == 1 and np.all(np.diff(c) > 0)
    # and c near 1 resolves k_d no better than the root of its last place
    dark = k_d < 0.9
    assert np.allclose(albedo_lambert_sphere(c)[dark], k_d[dark], rtol=1e-14, atol=0)
    assert np.allclose(albedo_lambert_sphere(c), k_d, rtol=0, atol=1e-11)
    assert np.isnan(albedo_lambert_sphere_inverse([-1e-9, 1.0001, np.nan])).all()
    assert np.isnan(albedo_lambert_sphere([-1e-9, 1.0001, np.nan])).all()


def test_series_reach_each_other():
    assert TAIL + MIDDLE == 1
    joint = np.array([np.nextafter(0.5, 0), 0.5])
    values = albedo_lambert_sphere(joint)
    assert abs(np.diff(values)) < 1e-14
