import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from tests.kernels import oracle
from xsec_sym.kernels import power, sigma_power

ULPS = 8
EVEN = [0, 2, 4, 6, 8, 10, 16, 30, 60, 100, 150, 198, 200]
ODD = [1, 3, 7, 77, 199]


def exact(u, p):
    """A_n 2F1(-1/2, -n; 1/2; u^2) and 2 pi u/(p + 2), which `test_references` compares with the definition."""
    u = mpf(float(u))
    if p % 2:
        return 2 * mp.pi * u / (p + 2)
    n = p // 2
    return mp.pi * mp.binomial(p, n) / mpf(4) ** n / (n + 1) * mp.hyp2f1(mpf(-1) / 2, -n, mpf(1) / 2, u * u)


def naive(u, p):
    """The alternating sum of powers of u, in doubles."""
    n, total, term = p // 2, np.zeros_like(u), np.pi * float(mp.binomial(p, p // 2)) / 4.0 ** (p // 2) / (p // 2 + 1)
    for k in range(n + 1):
        total = total - term / (2 * k - 1)
        term = term * -(n - k) / (k + 1) * u * u
    return total


def cosines(n):
    rng = np.random.default_rng(200)
    edges = np.arange(power.CELLS + 1) / power.CELLS
    beside = np.concatenate([edges[::9], np.nextafter(edges[1::9], 0), np.nextafter(edges[:-1:9], 1)])
    wide = np.concatenate([10 ** rng.uniform(-12, 0, n), rng.uniform(0, 1, n), [1e-300, 5e-324, np.nextafter(1, 0)]])
    u = np.concatenate([beside, wide])
    return u * rng.choice([-1, 1], u.size)


@pytest.mark.parametrize("p", EVEN + ODD)
def test_accuracy(p):
    u = cosines(60)
    with mp.workdps(120):
        assert oracle.worst_ulps(sigma_power(u, p), (exact(one, p) for one in u)) <= ULPS


@pytest.mark.parametrize("p", range(0, 201, 2))
def test_accuracy_of_every_even_power(p):
    u = [0.0, 0.04, 0.11, -0.3, 0.77, 1.0]
    with mp.workdps(120):
        assert oracle.worst_ulps(sigma_power(u, p), (exact(one, p) for one in u)) <= ULPS


@pytest.mark.parametrize("p", [0, 1, 2, 20, 200])
def test_accuracy_float32(p):
    u = cosines(40).astype(np.float32)
    values = sigma_power(u, np.array(p))
    assert values.dtype == np.float32
    with mp.workdps(120):
        assert oracle.worst_ulps(values, (exact(one, p) for one in u)) <= ULPS


@pytest.mark.parametrize("p", [0, 1, 2, 3, 4, 7, 12])
@pytest.mark.parametrize("u", [-0.7, 0.25])
def test_references_agree_with_the_definition(p, u):
    with mp.workdps(20):
        assert mp.almosteq(exact(u, p), oracle.cross_section_about_view(lambda x: x**p, u), 1e-15, 1e-17)


@pytest.mark.parametrize("p", [20, 101, 200])
def test_references_agree_with_the_integral_over_rings(p):
    with mp.workdps(60):
        for u in (-0.9, 0.03, 0.4):
            assert mp.almosteq(exact(u, p), oracle.cross_section_over_rings(lambda x: x**p, u), 1e-50, 1e-50)


def test_printed_rows():
    u = np.linspace(-1, 1, 41)
    assert np.allclose(sigma_power(u, 0), np.pi, rtol=4e-16)
    assert np.allclose(sigma_power(u, 2), np.pi / 4 * (1 + u * u), rtol=1e-15)
    assert np.allclose(sigma_power(u, 4), -np.pi / 24 * (u**4 - 6 * u * u - 3), rtol=1e-15)


def test_naive_sum_fails_where_the_kernel_holds():
    u = np.array([0.5, 0.7, 0.9])
    with mp.workdps(120):
        reference = [exact(one, 200) for one in u]
        assert min(oracle.ulps(*pair) for pair in zip(naive(u, 200), reference, strict=True)) > 1e6
        assert oracle.worst_ulps(sigma_power(u, 200), reference) <= ULPS


@pytest.mark.parametrize("p", [2, 40, 200])
def test_value_and_slope_are_continuous_across_cells(p):
    edges = np.arange(1, power.CELLS) / power.CELLS
    h = 1e-6
    left, at, right = (sigma_power(edges + step, p) for step in (-h, 0, h))
    curvature = p * np.pi / (p / 2 + 1) * (1 - edges**2) ** (p / 2 - 1)
    assert np.allclose((right - at) / h, (at - left) / h, rtol=0, atol=2 * h * curvature.max() + 1e-9)


@pytest.mark.parametrize("p", [-1, -2, 0.5, 2.0000000001, 201, 202, 1e300, np.inf, -np.inf, np.nan])
def test_other_powers_are_nan(p):
    assert np.isnan(sigma_power(0.5, p))
    assert np.isnan(sigma_power([0.5, 0.1], [p, 2])).tolist() == [True, False]


def test_integers_past_64_bits_are_other_powers():
    assert np.isnan(sigma_power(0.5, 10**30))


def test_powers_of_many_kinds_in_one_call():
    u, p = np.linspace(-1, 1, 5)[:, None], np.array([3, 0, 200, -1, 2, 3])
    table = sigma_power(u, p)
    assert np.array_equal(table, np.stack([sigma_power(u[:, 0], int(one)) for one in p], axis=1), equal_nan=True)
    assert np.array_equal(table, sigma_power(u, p.astype(float)), equal_nan=True)


@given(st.floats(-1, 1), st.integers(0, 200))
def test_parity_and_bounds(u, p):
    value, opposite = sigma_power(u, p), sigma_power(-u, p)
    assert opposite == (-value if p % 2 else value)
    # For even p the visible half of a convex body: between the signed moment and half the area.
    least, most = 2 * np.pi * abs(u) / (p + 2), 2 * np.pi / (p + 1)
    assert least * (1 - 2e-15) <= abs(value) <= most


@given(st.floats(-1, 1), st.integers(0, 99))
def test_falls_with_the_power(u, n):
    assert sigma_power(u, 2 * n + 2) <= sigma_power(u, 2 * n)
