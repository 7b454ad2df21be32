"""Smith's functions of Lambda against their definition: the mean over heights of what both directions leave visible."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from tests.kernels import lobes, oracle
from tests.kernels.test_traps import assert_trap
from xsec_sym import kernels
from xsec_sym.kernels import smith_g1, smith_g2, smith_g2_given_g1

LARGEST = np.finfo(float).max
ENDS = [0.0, 5e-324, 1e-310, 1e-160, 1e-17, 1e-8, 0.3, 1.0, 3.0, 1e8, 1e17, 1e160, 1e307, LARGEST]
LAMBDA = st.floats(0, LARGEST)
PAIRS = [smith_g2, smith_g2_given_g1]


@lobes.exactly
def g1(lam):
    return 1 / (1 + lam)


@lobes.exactly
def g2(lam_i, lam_o):
    return 1 / (1 + lam_i + lam_o)


@lobes.exactly
def g2_given_g1(lam_i, lam_o):
    return (1 + lam_i) / (1 + lam_i + lam_o)


EXACT = {smith_g1: g1, smith_g2: g2, smith_g2_given_g1: g2_given_g1}
# Half an ulp for the quotient, and up to one for each rounding before it
BOUND = {smith_g1: 1.5, smith_g2: 2.5, smith_g2_given_g1: 3.5}


def named(kernel):
    return kernel.__name__


def visible(lam):
    """The part of the heights U in [0, 1] that is visible, each with the probability U^Lambda."""
    return mp.quad(lambda U: U**lam, [0, 0.25, 1])


@pytest.mark.parametrize("lam_i", [0.0, 0.3, 2.0])
@pytest.mark.parametrize("lam_o", [0.0, 0.7, 5.0])
def test_the_references_are_the_means_over_heights(lam_i, lam_o):
    with mp.workdps(30):
        i, o = mpf(lam_i), mpf(lam_o)
        assert mp.almosteq(g1(lam_i), visible(i), 1e-20)
        assert mp.almosteq(g2(lam_i, lam_o), visible(i + o), 1e-20)
        assert mp.almosteq(g2_given_g1(lam_i, lam_o), visible(i + o) / visible(i), 1e-20)


def samples(n, dtype=np.float64, seed=20):
    rng = np.random.default_rng(seed)
    low, high = (-300, 308) if dtype == np.float64 else (-40, 38)
    wide, narrow = 10 ** rng.uniform(low, high, (2, n)), 10 ** rng.uniform(-3, 3, (2, n))
    alike = wide * rng.uniform(0.1, 1, (2, n))
    alike[1] = alike[0] * rng.uniform(0.1, 1, n)
    return np.concatenate([wide, narrow, alike], axis=1).astype(dtype)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("kernel", EXACT, ids=named)
def test_accuracy(kernel, dtype):
    """Largest found among 8 million points: 1.50, 2.46 and 3.19 ulp; 0.5 in float32."""
    lam = samples(2000, dtype)[: 1 if kernel is smith_g1 else 2]
    with mp.workdps(700):
        exact = [EXACT[kernel](*point) for point in lam.T]
    values = kernel(*lam)
    assert values.dtype == dtype
    assert oracle.worst_ulps(values, exact) <= (BOUND[kernel] if dtype == np.float64 else 0.51)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("kernel", EXACT, ids=named)
def test_corners(kernel, dtype):
    top = np.finfo(dtype).max
    ends = np.unique(np.minimum(np.append(ENDS, [top / 2, np.nextafter(top, dtype(0))]), top).astype(dtype))
    points = [(a,) for a in ends] if kernel is smith_g1 else [(a, b) for a in ends for b in ends]
    with mp.workdps(700):
        exact = [EXACT[kernel](*point) for point in points]
    values = kernel(*np.array(points).T)
    assert oracle.worst_ulps(values, exact) <= (BOUND[kernel] if dtype == np.float64 else 0.51)


def test_infinite_lambda():
    finite = np.array([0.0, 5e-324, 1.0, LARGEST])
    assert smith_g1(np.inf) == 0 and smith_g2(np.inf, np.inf) == 0
    assert (smith_g2(np.inf, finite) == 0).all() and (smith_g2(finite, np.inf) == 0).all()
    assert (smith_g2_given_g1(np.inf, finite) == 1).all() and (smith_g2_given_g1(finite, np.inf) == 0).all()


def test_there_is_no_limit_where_both_are_infinite():
    assert np.isnan(smith_g2_given_g1([np.inf, 1.0], [np.inf, 1.0])).tolist() == [True, False]
    for k in (1e-3, 0.5, 1.0, 2.0, 1e3):
        assert smith_g2_given_g1(k * 1e300, 1e300) == pytest.approx(k / (1 + k), rel=1e-15)


def test_nothing_is_masked_where_lambda_is_zero():
    lam = np.array([0.0, 1e-300, 0.3, 1.0, 7.0, 1e20, 1e308, np.inf])
    for zero in (0.0, -0.0):
        assert smith_g1(zero) == 1 and smith_g2(zero, zero) == 1
        assert np.array_equal(smith_g2(lam, zero), smith_g1(lam)) and np.array_equal(smith_g2(zero, lam), smith_g1(lam))
        assert (smith_g2_given_g1(lam, zero) == 1).all()
        assert np.array_equal(smith_g2_given_g1(zero, lam), smith_g1(lam))


@settings(deadline=None)
@given(LAMBDA, LAMBDA)
def test_probabilities(lam_i, lam_o):
    one, other = smith_g1(lam_i), smith_g1(lam_o)
    both, given_one = smith_g2(lam_i, lam_o), smith_g2_given_g1(lam_i, lam_o)
    assert both == smith_g2(lam_o, lam_i)
    slack = 1 + 1e-15
    assert one * other <= both * slack + 1e-322 and both <= min(one, other) * slack
    assert 0 <= other <= given_one * slack and given_one <= 1
    assert given_one * one == pytest.approx(both, rel=1e-15, abs=1e-322)


@pytest.mark.parametrize("bad", [np.nan, -np.inf, -5e-324, -1e-300, -0.5, -1.0, -2.0, -1e308])
def test_outside_the_domain_is_nan_and_silent(bad):
    assert np.isnan(smith_g1([bad, 1.0])).tolist() == [True, False]
    assert np.isnan(smith_g1(np.float32(-1)))
    for kernel in PAIRS:
        for good in (0.0, 1.0, 3.0, LARGEST, np.inf):
            assert np.isnan(kernel(bad, good)) and np.isnan(kernel(good, bad))
        assert np.isnan(kernel(bad, bad))
        assert np.isnan(kernel([bad, 1.0], 1.0)).tolist() == [True, False]


@settings(deadline=None)
@given(st.floats(), st.floats())
def test_no_wrong_finite_value_for_any_arguments(lam_i, lam_o):
    assert np.isnan(smith_g1(lam_i)) == (not lam_i >= 0)
    inside = lam_i >= 0 and lam_o >= 0
    assert np.isnan(smith_g2(lam_i, lam_o)) == (not inside)
    assert np.isnan(smith_g2_given_g1(lam_i, lam_o)) == (not inside or lam_i == lam_o == np.inf)


@pytest.mark.parametrize("kernel", PAIRS, ids=named)
def test_shapes_and_dtypes(kernel):
    lam, single = np.array([0.0, 1.0, 3.0]), np.float32([0.5])
    table = kernel(lam[:, None], lam[:2])
    assert table.shape == (3, 2) and all(table[i, j] == kernel(lam[i], lam[j]) for i in range(3) for j in range(2))
    assert kernel(np.empty((0, 2)), 1.0).shape == (0, 2)
    assert type(kernel(1, 2)) is np.float64 and type(kernel(np.float32(1), 2)) is np.float32
    assert kernel(single, single).dtype == np.float32 and kernel(single, np.float64(1)).dtype == np.float64
    lam.flags.writeable = False
    assert kernel(lam, lam).flags.writeable
    with pytest.raises(TypeError, match=r"^lam_o must hold real numbers, not "):
        kernel(1, "1")
    with pytest.raises(ValueError, match=r"^these shapes do not broadcast: lam_i \(3,\), lam_o \(2,\)$"):
        kernel(lam, lam[:2])


def test_shapes_and_dtypes_of_g1():
    assert type(smith_g1(1)) is np.float64 and type(smith_g1(np.float32(1))) is np.float32
    assert smith_g1(np.empty((3, 0))).shape == (3, 0) and smith_g1(np.ones((2, 3), np.float32)).dtype == np.float32
    with pytest.raises(TypeError, match=r"^lam must hold real numbers, not "):
        smith_g1(1j)


@pytest.mark.parametrize("name", ["ggx", "beckmann"])
def test_masking_from_the_cross_section(name):
    """G1 = cos(theta)/sigma(theta), and 0 at grazing."""
    sigma, smith = getattr(kernels, f"sigma_{name}"), getattr(kernels, f"lambda_{name}")
    u = np.linspace(1e-3, 1, 500)
    for alpha in (0.05, 0.3, 1.0, 3.0):
        assert np.allclose(smith_g1(smith(u, alpha)), u / sigma(u, alpha), rtol=1e-14, atol=0)
        assert smith_g1(smith(0.0, alpha)) == 0
        assert smith_g2_given_g1(smith(0.0, alpha), smith(u, alpha)).tolist() == [1.0] * 500


# --- traps ------------------------------------------------------------------------------------------------------


def as_printed(lam_i, lam_o):
    """dupuy2016 (22)"""
    return (1 + lam_i) / (1 + lam_i + lam_o)


def test_the_sum_overflows():
    """1 + Lambda_i + Lambda_o is infinite for finite terms: a wrong 0, in singles from 1.8e38 on."""

    def together(lam_i, lam_o):
        return 1 / (1 + lam_i + lam_o)

    points = [(1.5e308, 1.5e308), (LARGEST, LARGEST)]
    single = [tuple(map(np.float32, (3e38, 3e38)))]
    assert_trap(together, smith_g2, g2, points, 0.9)
    assert_trap(together, smith_g2, g2, single, 0.9)
    assert_trap(as_printed, smith_g2_given_g1, g2_given_g1, [*points, (1.7e308, 1e308)], 0.9)
    assert_trap(as_printed, smith_g2_given_g1, g2_given_g1, single, 0.9)


def test_grazing_is_0_over_0():
    """G2/G1, and infinity over itself, where the limit is 1."""
    with np.errstate(all="ignore"):
        grazing, other = np.array([np.inf]), np.array([2.0])
        assert np.isnan(as_printed(grazing, other)).all()
        assert np.isnan(smith_g2(grazing, other) / smith_g1(grazing)).all()
        # A clamp that lets numbers win over NaN makes a black rim of it
        assert np.fmax(as_printed(grazing, other), 0) == 0
    assert smith_g2_given_g1(grazing, other) == 1


def test_the_quotient_of_tiny_maskings():
    """G1 and G2 are subnormal singles there, which have fewer digits."""

    def quotient(lam_i, lam_o):
        return (1 / (1 + lam_i + lam_o)) / (1 / (1 + lam_i))

    assert_trap(quotient, smith_g2_given_g1, g2_given_g1, [(np.float32(2e38), np.float32(1e38))], 1e-8)
