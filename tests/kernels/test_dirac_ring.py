import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from tests.kernels import oracle
from xsec_sym.kernels import dirac_ring, sigma_dirac_ring

COSINE = st.floats(-1, 1)
ULPS = 8
CORNERS = [0.0, 5e-324, 1e-300, 1e-160, 1e-30, 1e-8, 0.5, 0.6, 0.7071067811865475, 0.7071067811865476, 0.8]
CORNERS += [1 - 1e-8, 1 - 3 * 2.0**-53, np.nextafter(1, 0), 1.0]


def naive(u, u_n):
    """The printed form: acos of a quotient, and the difference of two terms."""
    s, s_n = np.sqrt(1 - u * u), np.sqrt(1 - u_n * u_n)
    with np.errstate(invalid="ignore"):
        return 2 * (np.sqrt(1 - u * u - u_n * u_n) + u * u_n * np.arccos(-u * u_n / (s * s_n)))


def joins(rng, n):
    """Pairs where a ring becomes fully lit or fully dark, within a few last places."""
    u = np.sqrt(rng.uniform(0, 1, n)) * rng.choice([-1, 1], n)
    x = np.sqrt((1 - u) * (1 + u))
    return u, np.minimum(x + rng.integers(-4, 5, n) * np.spacing(x), 1.0)


def samples(name, n=1500):
    rng = np.random.default_rng(2016)
    u = rng.uniform(-1, 1, n)
    match name:
        case "bulk":
            return u, rng.uniform(-1, 1, n)
        case "joins":
            return joins(rng, n)
        case "toward the join":
            return u, -np.sign(u) * np.sqrt((1 - u) * (1 + u)) * (1 - 10 ** rng.uniform(-17, 0, n))
        case "switch":
            t = np.sqrt(dirac_ring.BARELY) * (1 + rng.uniform(-1, 1, n) * 10 ** rng.uniform(-16, -1, n))
            return u, -np.sign(u) * np.sqrt((1 - u * u) / (1 + (t * u) ** 2))
        case "dark":
            return u, -np.sign(u) * np.sqrt((1 - u * u) / (1 + (rng.uniform(0, 4, n) * u) ** 2))
        case "tiny":
            return rng.choice([-1, 1], n) * 10 ** rng.uniform(-320, 0, n), 1 - 10 ** rng.uniform(-17, 0, n)
        case "edge-on":
            h = 1 - rng.integers(1, 60, n) * 2.0**-53
            x = np.sqrt((1 - h) * (1 + h))
            return h, -x + rng.integers(-4, 5, n) * np.spacing(x)
    raise ValueError(name)


SAMPLES = ["bulk", "joins", "toward the join", "switch", "dark", "tiny", "edge-on"]


@pytest.mark.parametrize("name", SAMPLES)
def test_accuracy(name):
    u, x = samples(name)
    with mp.workprec(420):
        assert oracle.worst_ulps(sigma_dirac_ring(u, x), map(oracle.ring, u, x)) <= ULPS


@pytest.mark.parametrize("name", SAMPLES)
def test_accuracy_float32(name):
    u, x = (np.clip(argument, -1, 1).astype(np.float32) for argument in samples(name, 500))
    with mp.workprec(420):
        assert oracle.worst_ulps(sigma_dirac_ring(u, x), map(oracle.ring, u, x)) <= ULPS


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_corners(dtype):
    cosines = np.unique(np.array(CORNERS).astype(dtype))
    cosines = np.concatenate([-cosines, cosines])
    u, x = (grid.ravel() for grid in np.meshgrid(cosines, cosines))
    # The squares of the smallest cosines are far below 1, and must not be rounded away from a difference with it.
    with mp.workprec(2300):
        assert oracle.worst_ulps(sigma_dirac_ring(u, x), map(oracle.ring, u, x)) <= ULPS


@pytest.mark.parametrize("name", ["bulk", "dark", "switch", "toward the join"])
def test_references_agree_with_the_definition(name):
    u, x = samples(name, 12)
    with mp.workdps(120):
        for pair in zip(u, x, strict=True):
            assert mp.almosteq(oracle.ring(*pair), oracle.ring_from_definition(*pair), 1e-50, 1e-75)


def test_kernel_against_the_definition_with_its_clamp():
    u, x = samples("bulk", 6)
    phi = (np.arange(200_000) + 0.5) * (np.pi / 200_000)
    for one, other in zip(u, x, strict=True):
        height = one * other + np.sqrt((1 - one**2) * (1 - other**2)) * np.cos(phi)
        assert np.isclose(2 * np.pi * np.maximum(height, 0).mean(), sigma_dirac_ring(one, other), rtol=1e-7, atol=1e-9)


def test_discriminant_is_exact_in_sign_and_accurate():
    u, x = (np.abs(np.concatenate(pair)) for pair in zip(samples("joins", 4000), samples("edge-on", 4000), strict=True))
    with mp.workprec(420):
        exact = [1 - mpf(float(a)) ** 2 - mpf(float(b)) ** 2 for a, b in zip(u, x, strict=True)]
        assert oracle.worst_ulps(dirac_ring.discriminant(u, x), exact) <= 1


def test_rational_is_the_series_it_stands_for():
    with mp.workdps(60):
        for k in range(1, 301):
            z = mpf(dirac_ring.BARELY) * k / 300
            t = mp.sqrt(z)
            exact = (t - mp.atan(t)) / t**3
            assert abs(mp.polyval(dirac_ring._ARC_P, z) / mp.polyval(dirac_ring._ARC_Q, z) / exact - 1) < mpf(2) ** -54


def test_naive_form_fails_where_the_kernel_holds():
    u, x = samples("joins", 3000)
    partly = dirac_ring.discriminant(np.abs(u), np.abs(x)) > 0
    u, x = u[partly], x[partly]
    with mp.workprec(420):
        exact = [oracle.ring(*pair) for pair in zip(u, x, strict=True)]
        printed = [oracle.ulps(value, reference) for value, reference in zip(naive(u, x), exact, strict=True)]
        assert np.isnan(naive(u, x)).any()
        assert np.median([one for one, dark in zip(printed, u < 0, strict=True) if dark]) > 1e6
        assert oracle.worst_ulps(sigma_dirac_ring(u, x), exact) <= ULPS


def test_naive_form_loses_the_dark_side_well_inside():
    u, x = -0.6, 0.79
    with mp.workprec(420):
        exact = oracle.ring(u, x)
        assert oracle.ulps(np.float64(naive(u, x)), exact) > 500
        assert oracle.ulps(sigma_dirac_ring(u, x), exact) <= ULPS


def test_value_and_slope_are_continuous_across_the_switch():
    a, d = np.float64(-0.3), dirac_ring.BARELY * 0.09
    steps = np.linspace(-1e-4, 1e-4, 9)
    one, other = dirac_ring.partly_lit(d + steps, a), dirac_ring.barely_lit(d + steps, np.full(9, a))
    assert np.allclose(one, other, rtol=3e-15, atol=0)
    assert np.allclose(np.diff(one), np.diff(other), rtol=1e-9, atol=0)


@pytest.mark.parametrize("u", [-0.9, -0.3, 0.4, 0.8])
def test_value_and_slope_are_continuous_across_the_joins(u):
    join = np.sqrt(1 - u * u)
    for x in (join, -join):
        h = 1e-7
        left, at, right = sigma_dirac_ring(u, [x - h, x, x + h])
        assert abs(right - left) <= 4 * np.pi * h
        # One side is straight, the other leaves it like 2/3 d^(3/2)/a^2.
        assert abs((right - at) - (at - left)) < 1.1 * (2 / 3) * (2 * join * h) ** 1.5 / (u * join) ** 2


def test_limits():
    u = np.linspace(-1, 1, 201)
    assert np.allclose(sigma_dirac_ring(u, 1), 2 * np.pi * np.maximum(u, 0), rtol=4e-16, atol=0)
    assert np.allclose(sigma_dirac_ring(u, 0), 2 * np.sqrt((1 - u) * (1 + u)), rtol=4e-16, atol=0)
    dark = sigma_dirac_ring(-1.0, 1.0)
    assert dark == 0 and not np.signbit(dark)


@given(COSINE, COSINE)
def test_symmetry_and_bounds(u, x):
    value = sigma_dirac_ring(u, x)
    assert value == sigma_dirac_ring(x, u) == sigma_dirac_ring(-u, -x)
    assert 0 <= value <= 2 * np.pi
    assert value >= 2 * np.pi * max(u * x, 0) * (1 - 1e-15)
    assert value <= 2 * np.pi * np.hypot(u * x, np.sqrt((1 - u * u) * (1 - x * x) / 2)) * (1 + 1e-15) + 1e-300


@given(COSINE, COSINE)
def test_facing_and_opposite_differ_by_the_signed_area(u, x):
    facing, opposite = sigma_dirac_ring(u, x), sigma_dirac_ring(-u, x)
    assert abs(facing - opposite - 2 * np.pi * u * x) <= 10 * np.spacing(max(facing, opposite))


@given(st.floats(0, 1), st.floats(-1, 0), st.floats(-1, 0))
def test_falls_away_from_edge_on(x, u, v):
    assert sigma_dirac_ring(min(u, v), x) <= sigma_dirac_ring(max(u, v), x) * (1 + 4e-15)
