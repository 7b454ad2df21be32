import numpy as np
import pytest
from mpmath import mp, mpf

from xsec_sym import kernels
from xsec_sym.kernels import HalfSpace, h_lambert_sphere
from xsec_sym.kernels.half_space import crowded_nodes
from xsec_sym.study.references import three_terms
from xsec_sym.study.references.chandrasekhar import relative, unit_rule

ERROR = 2e-15
MODES = (0, 1, 2)
ALBEDOS = np.array([0.0, 5e-324, 1e-17, 1e-3, 0.5, 0.99, 1 - 1e-9, 1 - 2**-53, 1.0])
COSINES = np.array([0.0, 5e-324, 1e-300, 1e-17, 1e-8, 1e-3, 0.7, 1.0, 1 + 2**-52, 1e3, 1e6, 1e8])


def worst(mu, c, mode):
    """The largest relative error of H at these points, and where it occurs."""
    errors = [
        (relative(value, three_terms.h(m, albedo, mode)), (float(m), float(albedo), mode))
        for value, m, albedo in zip(h_lambert_sphere(mu, c, mode), mu, c, strict=True)
    ]
    return max(errors, key=lambda pair: pair[0])


def grid(mu, c):
    return tuple(part.ravel() for part in np.meshgrid(mu, c, indexing="ij"))


@pytest.mark.parametrize(("c", "mode"), [(0.3, 0), (1 - 2**-40, 0), (1.0, 0), (0.9, 1), (1.0, 2)])
def test_references_solve_the_nonlinear_equation(c, mode):
    """`deon2021:20` with a product for its sum, by a rule on [0, 1], and the same integral by another rule."""
    solution, albedo = three_terms.Solution(c, mode), mpf(c)
    with mp.workdps(three_terms.DIGITS):
        rule = unit_rule()
        weighted = [(x, w * solution.h(x) * three_terms.characteristic(mode, albedo, x)) for x, w in rule]
        for mu in (mpf("0.02"), mpf("0.37"), mpf(1)):
            inverse = 1 - mu * mp.fsum(part / (mu + x) for x, part in weighted)
            assert abs(solution.h(mu) * inverse - 1) < mpf("1e-28"), mu
    assert abs(three_terms.by_parts("0.4", c, mode) / solution.h(mpf("0.4")) - 1) < mpf("1e-18")


@pytest.mark.parametrize("mode", MODES)
def test_accuracy(mode):
    rng = np.random.default_rng(20 + mode)
    c = np.concatenate([rng.uniform(0, 1, 5), 1 - 10 ** rng.uniform(-16, 0, 5), 10 ** rng.uniform(-18, 0, 2)])
    mu = np.concatenate([rng.uniform(0, 1, 5), 10 ** rng.uniform(-18, 0, 4), 10 ** rng.uniform(0, 10, 4)])
    error, where = worst(*grid(mu, c), mode)
    assert error < ERROR, where


@pytest.mark.parametrize("mode", MODES)
def test_corners(mode):
    error, where = worst(*grid(COSINES, ALBEDOS[1:]), mode)
    assert error < ERROR, where


def test_limits():
    c = np.array([0.0, 5e-324, 0.3, 0.7, 1 - 2**-30, 1 - 2**-53])
    limits = 12 / np.sqrt((16 - c) * (1 - c) * (4 * c + 9)), 12 / np.sqrt(144 + 55 * c - 4 * c * c), 4 / np.sqrt(16 - c)
    for mode, limit in enumerate(limits):
        for mu in (np.inf, np.finfo(float).max):
            assert np.allclose(h_lambert_sphere(mu, c, mode), limit, rtol=1e-15, atol=0)
    assert h_lambert_sphere(np.inf, 1, 0) == np.inf
    assert np.allclose(h_lambert_sphere(np.inf, 1, [1, 2]), [12 / 195**0.5, 4 / 15**0.5], rtol=1e-15, atol=0)
    large = np.array([1e17, 1e60, 1e150, 1e307])
    assert np.allclose(h_lambert_sphere(large, 1, 0) / large, 3.2**0.5, rtol=2e-15, atol=0)
    mode = np.array(MODES)[:, np.newaxis]
    assert np.array_equal(
        h_lambert_sphere([0.0, -0.0, 5e-324], ALBEDOS[:, np.newaxis, np.newaxis], mode), np.ones((9, 3, 3))
    )
    assert np.array_equal(h_lambert_sphere([0.0, 0.2, 1.0, 1e9, np.inf], 0, mode), np.ones((3, 5)))


def test_near_0_it_falls_from_1_as_mu_log_mu():
    """H - 1 = -Psi(0) mu log mu + O(mu), which digits of H itself would not show."""
    mu = 1e-8
    for mode, start in enumerate((207 / 384, -64 / 192, 15 / 256)):
        # The O(mu) drops out of H(mu/2) - 1 less half of H(mu) - 1.
        one, half = h_lambert_sphere([mu, mu / 2], 0.5, mode) - 1
        assert half - one / 2 == pytest.approx(0.5 * start * mu / 2 * np.log(2), rel=1e-4)


@pytest.fixture(scope="module")
def rule():
    return crowded_nodes(80, 6)


@pytest.mark.parametrize("c", [1e-6, 0.3, 0.9, 1 - 1e-9, 1.0])
@pytest.mark.parametrize("mode", MODES)
def test_nonlinear_equation(rule, c, mode):
    """`deon2021:20` and, at infinity, 1/H = 1 - int H Psi, which a second solution of it would not obey."""
    x, weight = rule
    weighted = weight * h_lambert_sphere(x, c, mode) * three_terms.characteristic(mode, c, x)
    mu = np.array([1e-6, 1e-3, 0.1, 0.5, 1.0, 30.0])
    inverse = 1 - mu * (weighted / (mu[:, np.newaxis] + x)).sum(1)
    assert np.allclose(1 / h_lambert_sphere(mu, c, mode), inverse, rtol=0, atol=1e-13)
    assert 1 / h_lambert_sphere(np.inf, c, mode) == pytest.approx(1 - weighted.sum(), abs=1e-13)


@pytest.mark.parametrize("c", [0.3, 0.9, 1.0])
def test_weakest_mode_of_the_solver(c):
    """Order 2 has one term of the phase function and no constants: `HalfSpace` finds c A_2/12 H H of it."""
    mu = np.array([0.01, 0.2, 0.5, 0.8, 0.99])
    half = HalfSpace([1.0, -4 / 3, 5 / 16], c)
    i, o = mu[:, np.newaxis], mu
    shape = 15 * c / 256 * (1 - i**2) * (1 - o**2) / (np.pi * (i + o))
    h = h_lambert_sphere(mu, c, 2)
    assert np.allclose(half.fourier(2, mu, mu), shape * (h[:, np.newaxis] * h - 1), rtol=0, atol=1e-14)


def test_many_albedos_and_one_give_the_same_bits():
    rng = np.random.default_rng(9)
    mu = np.concatenate([rng.uniform(0, 1, 20000), COSINES])
    for mode in MODES:
        for c in (0.2, 1.0):
            values = h_lambert_sphere(mu, c, mode)
            few = np.where(rng.random(mu.size) < 0.5, c, 0.7)
            many = np.where(rng.random(mu.size) < 0.1, c, rng.uniform(0, 1, mu.size))
            for mixed in (few, many):
                assert np.array_equal(h_lambert_sphere(mu, mixed, mode)[mixed == c], values[mixed == c])
    orders = rng.integers(0, 3, mu.size)
    assert np.array_equal(
        h_lambert_sphere(mu, 0.4, orders), np.choose(orders, [h_lambert_sphere(mu, 0.4, m) for m in MODES])
    )


def test_single_precision_is_within_one_last_place():
    rng = np.random.default_rng(3)
    mu, c = grid(np.r_[rng.uniform(0, 1, 4), 1e-45, 1e-4, 1.0, 7e5], np.r_[rng.uniform(0, 1, 2), 1 - 2**-24, 1.0])
    mu, c = mu.astype(np.float32), c.astype(np.float32)
    for mode in MODES:
        values = h_lambert_sphere(mu, c, mode)
        assert values.dtype == np.float32
        for value, m, albedo in zip(values, mu, c, strict=True):
            exact = three_terms.h(m, albedo, mode)
            assert abs(mpf(float(value)) - exact) <= np.spacing(np.float32(float(exact))), (m, albedo, mode)


def k_of_0(t, c):
    """`deon2021:24` in doubles, and in digits enough."""
    with mp.workdps(60):
        exact = float(three_terms.k_of(0, mpf(c), mpf(t), mp.atan(mpf(t))))
    return three_terms.k_of(0, c, t, np.arctan(t)), exact


def by_gauss(mu, c, nodes=64):
    """`deon2021:22` with t = tan(theta), by Gauss-Legendre, of a K that is right to the last digit."""
    x, weight = np.polynomial.legendre.leggauss(nodes)
    theta = np.pi / 4 * (1 + x)
    k = np.array([k_of_0(float(t), c)[1] for t in np.tan(theta)])
    f = np.log(k) / (np.cos(theta) ** 2 + mu**2 * np.sin(theta) ** 2)
    return np.exp(-mu / np.pi * np.pi / 4 * (f @ weight))


@pytest.mark.parametrize(
    ("t", "c", "loss"), [(0.02, 0.99, 4e-10), (1e-3, 0.99, 5e-5), (1e-4, 0.99, 0.5), (1e-4, 0.5, 0.6), (1e-6, 1.0, 1e8)]
)
def test_the_printed_k_has_no_digits_near_0(t, c, loss):
    """t^5 divides what is left of terms that cancel; for c = 1 it comes out negative, and its logarithm is NaN."""
    value, exact = k_of_0(t, c)
    assert abs(value / exact - 1) > loss
    assert c < 1 or value < 0


@pytest.mark.parametrize(
    ("mu", "c", "loss"), [(1.0, 1.0, 1e-4), (0.5, 1 - 1e-6, 1e-6), (1e3, 0.9, 3e-2), (1e-3, 0.9, 4e-6)]
)
def test_plain_quadrature_loses_what_the_kernel_keeps(mu, c, loss):
    """The logarithm dips at t = 0 as c nears 1, and the other factor peaks at either end."""
    exact = three_terms.h(mu, c, 0)
    assert relative(by_gauss(mu, c), exact) > loss
    assert relative(h_lambert_sphere(mu, c, 0), exact) < ERROR


def test_k_at_0_multiplied_out_loses_digits_near_1():
    c = 1 - 2.0**-50
    k = 1 - c / 192 * (207 + (c * (20 * c + 281) - 346) / 3 - 3 * (c - 1) * (4 * c + 9))
    assert abs(1 / np.sqrt(k) / h_lambert_sphere(np.inf, c, 0) - 1) > 5e-3


def test_outside_the_domain_is_nan():
    assert np.isnan(h_lambert_sphere([-5e-324, -1.0, -np.inf, np.nan], 0.5, 0)).all()
    assert np.isnan(h_lambert_sphere(0.5, [-5e-324, np.nextafter(1, 2), np.inf, -np.inf, np.nan], 1)).all()
    assert np.isnan(h_lambert_sphere(0.5, 0.5, [-1, 0.5, 3, 1e300, np.inf, -np.inf, np.nan])).all()


def test_numpy_semantics():
    assert h_lambert_sphere(0.5, 0.5, 0).shape == () and isinstance(h_lambert_sphere(0.5, 0.5, 0), np.float64)
    assert h_lambert_sphere(np.float32(0.5), np.float32(0.5), np.int64(2)).dtype == np.float32
    assert h_lambert_sphere(np.float32(0.5), np.float32(0.5), np.arange(3)).dtype == np.float32
    assert h_lambert_sphere(np.float32(0.5), np.ones(2), 0).dtype == np.float64
    assert h_lambert_sphere([], 0.5, 0).shape == (0,)
    assert h_lambert_sphere(np.ones((2, 1, 1)), np.ones((3, 1)), np.zeros(4)).shape == (2, 3, 4)
    frozen = np.linspace(0, 1, 7)
    frozen.flags.writeable = False
    h_lambert_sphere(frozen, frozen, 0)
    with pytest.raises(TypeError, match="mode must hold real numbers"):
        h_lambert_sphere(0.5, 0.5, 1j)
    with pytest.raises(ValueError, match="do not broadcast"):
        h_lambert_sphere(np.ones(2), np.ones(3), 0)
    assert "h_lambert_sphere" in kernels.__all__
