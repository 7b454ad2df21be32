import builtins

import numpy as np
import pytest
from scipy.special import hyp2f1

from xsec_sym import kernels
from xsec_sym.export import lambert_sphere_fits as generator
from xsec_sym.export import search_fast_variant as fast
from xsec_sym.kernels import (
    _lambert_sphere_fits_tables,
    albedo_lambert_sphere,
    albedo_lambert_sphere_fit,
    albedo_lambert_sphere_inverse,
    albedo_lambert_sphere_inverse_fit,
    brdf_lambert_sphere,
    brdf_lambert_sphere_fast,
    brdf_lambert_sphere_fit,
    h_lambert_sphere_fit,
    phase_lambert_sphere,
)
from xsec_sym.kernels.half_space import crowded_nodes
from xsec_sym.kernels.lambert_sphere_fits import FAST

H_ERROR = (2.4e-5, 4e-5, 1.7e-5)
LEAST = 0.025


def h_by_fock(mode, mu, c, nodes=500):
    """`deon2021:22`, K by the moments of 1/(1 + t^2 x^2): an integral along t, where the fits' data solve for H."""
    x, weight = np.polynomial.legendre.leggauss(nodes)
    x, weight = (1 + x) / 2, weight / 2
    # crowds at both ends, where log K has a logarithm or a root
    theta, weight = np.pi / 2 * x**3 * (10 - 15 * x + 6 * x * x), weight * np.pi / 2 * 30 * x**2 * (1 - x) ** 2
    t = np.tan(theta) / mu
    m0, m2, m4 = (hyp2f1(1, n + 0.5, n + 1.5, -t * t) / (2 * n + 1) for n in range(3))
    k = {
        0: c / 192 * (-15 * (c - 1) * (4 * c + 9) * m4 + (c * (20 * c + 281) - 346) * m2 + 207 * m0),
        1: -c / 96 * (5 * (4 * c + 9) * (m4 - m2) - 64 * (m2 - m0)),
        2: 15 / 128 * c * (m4 - 2 * m2 + m0),
    }[mode]
    return np.exp(-np.sum(weight * np.log(1 - k)) / np.pi)


def printed_h(mu, c):
    """`deon2021:37` with `deon2021:fit.a`, `deon2021:fit.d` and `deon2021:H0inf`."""
    s = np.sqrt(1 - c)
    a = (1.50112 * s**6.05435 + 8.21644) / (4.17593 - 1.21222 * s)
    d = (7.7731 - 0.565811 * s**0.961546) / (8.65912 - 0.159974 * s**7)
    return (1 + a * mu**d) / (1 + a * mu**d * np.sqrt((c - 16) * (c - 1) * (4 * c + 9)) / 12)


def printed_k_d(c):
    """`deon2021:47`."""
    s = np.sqrt(1 - c)
    return (1 - 0.453029 * (1 - c) - 0.544162 * s) / (1.42931 * s + 1)


def printed_fast(mu_i, mu_o, phi, c):
    """`deon2021:48`."""
    sines = np.sqrt(1 - mu_i**2) * np.sqrt(1 - mu_o**2)
    single = c * phase_lambert_sphere(-(mu_i * mu_o + sines * np.cos(phi))) / (mu_i + mu_o)
    turned = (c - 0.249978) * (abs(phi) + np.sqrt(mu_i * mu_o)) / (np.arccos(sines) / sines + 0.113706)
    return np.maximum(0, single + 0.234459 * printed_k_d(c) ** 1.85432 + 0.0151829 * turned)


@pytest.fixture(scope="module")
def scene():
    """Directions and albedos at random, none of them those that anything was fitted to, and the exact BRDF."""
    rng = np.random.default_rng(77)
    albedos = np.append(1 - rng.uniform(0, 1, 9) ** 2, 1.0)
    mu_i, mu_o = rng.uniform(LEAST, 1, (2, 2500))
    phi, c = rng.uniform(0, np.pi, 2500), albedos[np.arange(2500) % albedos.size]
    return (mu_i, mu_o, phi, c), brdf_lambert_sphere(mu_i, mu_o, phi, c)


@pytest.mark.parametrize("mode", [0, 1, 2])
def test_h_accuracy(mode):
    rng = np.random.default_rng(3)
    mu = np.concatenate([rng.uniform(0, 1, 40), 10 ** rng.uniform(-5, -1, 20), [1.0]])
    # at c = 1 itself K has no digits left near t = 0
    c = np.concatenate([rng.uniform(0, 1, 30), 1 - 10 ** rng.uniform(-6, -1, 30), [1 - 1e-10]])
    exact = np.array([h_by_fock(mode, *pair) for pair in zip(mu, c, strict=True)])
    fitted = h_lambert_sphere_fit(mu, c, mode)
    assert abs(fitted / exact - 1).max() < H_ERROR[mode]
    if mode == 0:
        # the paper's 1 %, an order of magnitude and more above
        assert abs(printed_h(mu, c) / exact - 1).max() > 100 * H_ERROR[0]


def test_h_of_the_generator_is_that_of_the_integral():
    for mode in range(3):
        for s in (1e-5, 0.05, 0.6):
            mu = np.array([0.01, 0.3, 1.0])
            exact = [h_by_fock(mode, m, 1 - s * s) for m in mu]
            assert np.allclose(generator.h(mode, mu, s), exact, rtol=1e-9, atol=0)


@pytest.mark.parametrize("s", [0.013, 0.31, 0.77, 0.97])
def test_constants(s):
    for name, exact, error in zip("BDFL", generator.constants(s), (2e-6, 1e-7, 1e-7, 2e-5), strict=True):
        row = getattr(_lambert_sphere_fits_tables, name)[0]
        fitted = (1 - s * s) * (s if name in "DF" else 1) * np.polynomial.polynomial.polyval(s, row)
        assert abs(fitted - exact) < error


def test_constants_at_the_ends():
    """B and C = 0.1171875, D and F at c = 1, where D and F vanish; F/c as c vanishes, from single scattering alone."""
    b, d, f, _ = generator.constants(0.0)
    assert (b, d, f) == pytest.approx((-0.0833231213, 0, 0), abs=1e-10)
    assert 2 * f - (20 + 281 - 346) / 384 == pytest.approx(0.1171875, abs=1e-10)
    c = 1 - 0.9999**2
    assert generator.constants(0.9999)[2] / c == pytest.approx(-45 / 384, abs=1e-4)


def test_albedo_accuracy():
    rng = np.random.default_rng(4)
    c = np.concatenate([rng.uniform(0, 1, 3000), 1 - 10 ** rng.uniform(-12, 0, 1000), 10 ** rng.uniform(-300, 0, 100)])
    exact, fitted = albedo_lambert_sphere(c), albedo_lambert_sphere_fit(c)
    assert abs(fitted - exact).max() < 2.6e-5
    assert abs(fitted / exact - 1).max() < 5.5e-4
    assert abs(printed_k_d(c) - exact).max() > 2e-3
    k_d = np.concatenate([rng.uniform(0, 1, 3000), 1 - 10 ** rng.uniform(-12, 0, 1000), 10 ** rng.uniform(-300, 0, 99)])
    exact, fitted = albedo_lambert_sphere_inverse(k_d), albedo_lambert_sphere_inverse_fit(k_d)
    assert abs(fitted - exact).max() < 6e-6
    assert abs(fitted / exact - 1).max() < 5e-5
    printed = (1 - (1 - k_d) ** 2.73556) / (1 - 0.184096 * (1 - k_d) ** 2.48423)
    assert abs(printed - exact).max() > 4e-3
    assert np.array_equal(albedo_lambert_sphere_fit([0.0, 1.0]), [0.0, 1.0])
    assert np.allclose(albedo_lambert_sphere_inverse_fit([0.0, 1.0]), [0.0, 1.0], rtol=2.3e-16, atol=0)
    steps = np.linspace(0, 1, 20_001)
    assert np.all(np.diff(albedo_lambert_sphere_fit(steps)) > 0)
    assert np.all(np.diff(albedo_lambert_sphere_inverse_fit(steps)) > 0)


def test_brdf_accuracy(scene):
    arguments, exact = scene
    error = abs(brdf_lambert_sphere_fit(*arguments) - exact)
    assert error.max() < 5e-4
    assert np.sqrt(np.mean(error**2)) < 4e-5
    assert error[np.minimum(*arguments[:2]) > 0.2].max() < 5e-5


def test_grazing_accuracy():
    rng = np.random.default_rng(8)
    mu_i, mu_o, phi = 10 ** rng.uniform(-5, -1.6, 200), 10 ** rng.uniform(-5, 0, 200), rng.uniform(0, np.pi, 200)
    exact = brdf_lambert_sphere(mu_i, mu_o, phi, 1.0)
    errors = [abs(model(mu_i, mu_o, phi, 1.0) - exact) for model in (brdf_lambert_sphere_fit, brdf_lambert_sphere_fast)]
    assert errors[0].max() < 0.06 and errors[0][np.minimum(mu_i, mu_o) > 1e-3].max() < 5e-3
    # what the docstring owns up to, and no less: a formula without logarithm
    assert 0.1 < errors[1].max() < 0.7


def test_fast_variant_is_better_than_the_printed_one(scene):
    arguments, exact = scene
    errors = [abs(model(*arguments) - exact) for model in (brdf_lambert_sphere_fast, printed_fast)]
    largest, mean = [e.max() for e in errors], [np.sqrt(np.mean(e**2)) for e in errors]
    assert largest[0] < 0.04 and mean[0] < 0.005
    assert largest[1] > 2 * largest[0] and mean[1] > 2.5 * mean[0]
    # phi = 0 is backscattering in the printed one, too
    other = abs(printed_fast(arguments[0], arguments[1], np.pi - arguments[2], arguments[3]) - exact)
    assert np.mean(other) > np.mean(errors[1])


def test_energy_at_c_1():
    mu_o, weight = crowded_nodes(240, 4)
    phi = np.arange(192) * (2 * np.pi / 192)
    mu_i = np.array([0.0, 1e-6, 1e-4, 1e-3, 0.004, 0.01, 0.02, 0.03, 0.05, 0.1, 0.2, 0.4, 0.63, 0.85, 1.0])
    f = brdf_lambert_sphere_fit(mu_i[:, None, None], mu_o[:, None], phi, 1.0).mean(-1)
    assert abs(2 * np.pi * f @ (weight * mu_o) - 1).max() < 2.5e-5
    fast = brdf_lambert_sphere_fast(mu_i[3:, None, None], mu_o[:, None], phi, 1.0).mean(-1)
    returned = 2 * np.pi * fast @ (weight * mu_o)
    assert 0.95 < returned.min() < 0.955 and 1.02 < returned.max() < 1.035


@pytest.mark.parametrize("brdf", [brdf_lambert_sphere_fit, brdf_lambert_sphere_fast])
def test_symmetries_and_limits(brdf):
    rng = np.random.default_rng(6)
    i, o = rng.choice(np.concatenate([[0, 1, 1e-300, 1e-9, 1e-3], rng.uniform(0, 1, 50)]), (2, 3000))
    phi, c = rng.uniform(-9, 9, 3000), rng.choice([0.0, 1e-9, 0.3, 0.9, 1.0], 3000)
    f = brdf(i, o, phi, c)
    assert np.all(f >= 0) and np.array_equal(f, brdf(o, i, phi, c)) and np.array_equal(f, brdf(i, o, -phi, c))
    assert np.all(np.isfinite(f[i + o > 1e-200])) and np.all(f[(c == 0) & (i + o > 0)] == 0)
    assert np.array_equal(brdf(0.0, [0.0, 0.0, 0.5], 1.0, [0.4, 0.0, 0.0]), [np.inf, np.inf, 0.0])
    bad = [(-0.1, 0.5, 0, 0.4), (0.5, 1.1, 0, 0.4), (0.5, 0.5, np.inf, 0.4), (0.5, 0.5, 0, 1.1), (0.5, 0.5, 0, np.nan)]
    assert all(np.isnan(brdf(*arguments)) for arguments in bad)
    assert np.isnan(brdf(0, 0, 0, np.nan)) and np.isnan(brdf(np.nan, 0.5, 0, 0.5))


def test_numpy_semantics():
    single = [np.float32(x) for x in (0.5, 0.25, 1.0, 0.4)]
    for brdf in (brdf_lambert_sphere_fit, brdf_lambert_sphere_fast):
        assert brdf(*single).dtype == np.float32 and brdf(0.5, 0.25, 1.0, 0.4).dtype == np.float64
        assert brdf(np.ones((2, 1)), np.ones(0), 0.0, 0.4).shape == (2, 0)
        with pytest.raises(TypeError, match="c must hold real numbers"):
            brdf(0.5, 0.5, 0.0, 1j)
    assert h_lambert_sphere_fit(single[0], single[1], np.arange(3)).dtype == np.float32
    assert np.isnan(h_lambert_sphere_fit([-0.1, 1.1, np.nan, 0.5, 0.5], [0.5] * 3 + [1.1, -0.1], 0)).all()
    assert np.isnan(h_lambert_sphere_fit(0.5, 0.5, [-1, 3, 0.5, np.nan])).all()
    assert np.array_equal(h_lambert_sphere_fit([0, 0.5, 1], [1, 0, 0], [[0], [1], [2]]), np.ones((3, 3)))
    assert np.isnan(albedo_lambert_sphere_fit([-1e-9, 1.0001, np.nan, np.inf, -np.inf])).all()
    assert np.isnan(albedo_lambert_sphere_fit([0.5, np.nan, -1])).tolist() == [False, True, True]
    assert np.isnan(albedo_lambert_sphere_inverse_fit([-1e-9, 1.0001, np.nan])).all()
    assert {"h_lambert_sphere_fit", "brdf_lambert_sphere_fit", "brdf_lambert_sphere_fast"} <= set(kernels.__all__)


def test_tables_are_what_their_script_writes(monkeypatch):
    """By their values: the last digits of coefficients that nearly make up for each other are a machine's own."""
    mu, c = (x.ravel() for x in np.meshgrid(np.linspace(0, 1, 41), np.linspace(0, 1, 41)))

    def values():
        found = [h_lambert_sphere_fit(mu, c, mode) for mode in range(3)]
        found += [albedo_lambert_sphere_fit(c), albedo_lambert_sphere_inverse_fit(c)]
        return [*found, brdf_lambert_sphere_fit(np.maximum(mu, 0.01), 0.5, 1.0, c)]

    committed = values()

    def before(found):
        for name, table in found.items():
            monkeypatch.setattr(_lambert_sphere_fits_tables, name, table)

    found = generator.tables(before)
    before(found)
    for old, new in zip(committed, values(), strict=True):
        assert np.allclose(old, new, rtol=0, atol=2e-6)
    assert set(found) == {name for name in vars(_lambert_sphere_fits_tables) if name.isupper()}
    assert generator.module(found).count("\n") > 30


def test_search_without_its_package(monkeypatch):
    there = builtins.__import__

    def missing(name, *arguments, **options):
        if name.startswith("pyoperon"):
            raise ImportError(name)
        return there(name, *arguments, **options)

    monkeypatch.setattr(builtins, "__import__", missing)
    with pytest.raises(ImportError, match="the search needs pyoperon"):
        fast.regressor(1, 20, 1000)


def test_fast_formula_is_that_of_the_search(scene):
    (mu_i, mu_o, phi, c), _ = scene
    points = np.stack([mu_i, mu_o, phi, c], axis=1)
    cosine = mu_i * mu_o + np.sqrt((1 - mu_i**2) * (1 - mu_o**2)) * np.cos(phi)
    single = c * phase_lambert_sphere(-cosine) / (mu_i + mu_o)
    formula = np.maximum(fast.form(np.array(FAST), fast.features(points)) + single, 0)
    assert np.allclose(brdf_lambert_sphere_fast(mu_i, mu_o, phi, c), formula, rtol=0, atol=1e-12)


def test_polished_constants_are_near_a_least(monkeypatch):
    """From a sample of its own, of few albedos: the errors of the constants found anew are those of the ones in use."""
    monkeypatch.setattr(fast, "ALBEDOS", 8)
    found = fast.polished(5, count=1500, rounds=4)
    points, target = fast.sample(6, 1500)
    columns = fast.features(points)
    rms = [np.sqrt(np.mean((fast.form(k, columns) - target) ** 2)) for k in (found, np.array(FAST))]
    assert rms[1] < 1.3 * rms[0] and rms[0] < 0.005
