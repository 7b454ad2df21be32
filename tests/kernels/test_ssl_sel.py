from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp

from tests.kernels import ellipsoid, lobes, oracle
from tests.kernels.test_traps import assert_trap
from xsec_sym.kernels import _support, sel, ssl
from xsec_sym.kernels import lobes as shipped

TINY = (5e-324, 3e-310, 1e-200, 1e-160, shipped.SMALLEST, 1e-140, 1e-77, 1e-30)
ROUGH = st.floats(0, 1, exclude_min=True)


def limit(dtype):
    return lobes.ULPS if dtype == np.float64 else 1


# --- the references ---------------------------------------------------------------------------------------------


def test_the_reference_lies_on_the_ellipsoid():
    for point in zip(*ellipsoid.samples(100), strict=True):
        t = ellipsoid.distance(*point)
        with mp.workdps(180):
            *vector, alpha_x, alpha_y = ellipsoid.mpfs(*point)
            squared = max(alpha_x, alpha_y) ** 2
            semi_axes = (alpha_x, alpha_y, (1 + squared) / 2)
            centre = (0, 0, (1 - squared) / 2)
            terms = [((t * w - c) / r) ** 2 for w, c, r in zip(vector, centre, semi_axes, strict=True)]
            assert t > 0 and abs(sum(terms) - 1) < mp.mpf(10) ** -100


@pytest.mark.parametrize("alpha", [1e-8, 1e-3, 0.3, 1.0])
def test_the_two_references_agree_where_both_roughnesses_are_alike(alpha):
    for m in (-1.0, -1 + 1e-12, -0.5, 0.0, 0.3, 1 - 1e-12, 1.0):
        with mp.workdps(180):
            x, m, a = mp.sqrt(1 - mp.mpf(m) ** 2), mp.mpf(m), mp.mpf(alpha)
            assert mp.almosteq(ellipsoid.distance.__wrapped__(x, 0, m, a, a) ** 2, ellipsoid.ssl(m, alpha), 1e-100)


# --- accuracy ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_accuracy_of_ssl(dtype):
    """Largest found among 32 million points: 6.4 ulp; 0.5 in float32."""
    error, where = ellipsoid.worst(ssl, ellipsoid.ssl, ellipsoid.cosines(4000, dtype))
    assert error <= limit(dtype), where


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_accuracy_of_sel(dtype):
    """Largest found among 16 million points: 6.5 ulp; 0.5 in float32."""
    error, where = ellipsoid.worst(sel, ellipsoid.sel, ellipsoid.samples(4000, dtype))
    assert error <= limit(dtype), where


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_corners(dtype):
    alphas = np.array([1e-8, 1e-4, 0.01, 0.3, np.nextafter(1, 0), 1.0], dtype)
    m, alpha = np.meshgrid(np.unique(lobes.CORNERS.astype(dtype)), alphas)
    error, where = ellipsoid.worst(ssl, ellipsoid.ssl, (m.ravel(), alpha.ravel()))
    assert error <= limit(dtype), where
    angles = [0, 1e-300, 1e-16, 1e-8, 1e-4, 0.5, np.pi / 2, 2.0, np.pi - 1e-8, np.pi]
    grid = np.meshgrid(angles, [0, 1e-9, 0.7, np.pi / 2], alphas, alphas)
    angle, azimuth, alpha_x, alpha_y = (part.ravel() for part in grid)
    points = (*ellipsoid.vectors(angle, azimuth, dtype), alpha_x, alpha_y)
    error, where = ellipsoid.worst(sel, ellipsoid.sel, points)
    assert error <= limit(dtype), where


@pytest.mark.parametrize("alpha", TINY)
def test_roughness_down_to_the_smallest_double(alpha):
    """Beside the axis by up to a few widths, far from it, and behind; the other roughness alike or larger."""
    with mp.workdps(1500):
        for other in {alpha, min(1.0, 1e3 * alpha), 1e-8, 0.5, 1.0}:
            steps = np.array([0.0, 0.3, 1.0, 1.7, 40.0, 1e5])
            x, y = (part.ravel() for part in np.meshgrid(steps * alpha, [0.0, 0.4 * other]))
            z = np.sqrt((1 - np.hypot(x, y)) * (1 + np.hypot(x, y)))
            for sign in (1, -1):
                points = (x, y, sign * z, np.full_like(x, alpha), np.full_like(x, other))
                keep = np.hypot(x, y) < 1
                error, where = ellipsoid.worst(sel, ellipsoid.sel, [part[keep] for part in points])
                assert error <= lobes.ULPS, where
                swapped = [points[i][keep] for i in (1, 0, 2, 4, 3)]
                assert np.array_equal(sel(*swapped), sel(*(part[keep] for part in points)))
        m = np.array([-1.0, -0.5, 0.0, 0.9, np.nextafter(1, 0), 1.0])
        error, where = ellipsoid.worst(ssl, ellipsoid.ssl, (m, np.full_like(m, alpha)))
        assert error <= lobes.ULPS, where


@settings(deadline=None, max_examples=60)
@given(st.floats(0, np.pi), st.floats(0, 7), ROUGH, ROUGH)
def test_any_roughness_and_direction(angle, azimuth, alpha_x, alpha_y):
    with mp.workdps(1500):
        point = (*ellipsoid.vectors(np.array([angle]), np.array([azimuth])), np.array([alpha_x]), np.array([alpha_y]))
        assert ellipsoid.worst(sel, ellipsoid.sel, point)[0] <= lobes.ULPS
        point = (np.cos([angle]), np.array([alpha_x]))
        assert ellipsoid.worst(ssl, ellipsoid.ssl, point)[0] <= lobes.ULPS


def test_values_that_are_subnormal_numbers():
    """The lobe falls through the last normal double, where its inverse overflows and the kernel takes another way."""
    x = np.full(400, 0.6)
    alpha = np.geomspace(8e-78, 2e-78, 400)
    values = sel(x, 0.0, 0.8, alpha, alpha)
    tiny = np.finfo(float).tiny
    assert values.max() > 10 * tiny and 0 < values.min() < tiny / 4
    wide = np.geomspace(1e-152, 1e-160, 400)
    points = [(x, 0 * x, 0 * x + 0.8, alpha, alpha), (x, 0 * x, 0 * x - 0.8, alpha, alpha)]
    points += [(x, 0 * x, 0 * x + 0.8, wide, 0 * x + 1), (x, 0 * x, 0 * x - 0.8, wide, 0 * x + 0.9)]
    with mp.workdps(800):
        for point in points:
            error, where = ellipsoid.worst(sel, ellipsoid.sel, point)
            assert error <= lobes.ULPS, where
        error, where = ellipsoid.worst(ssl, ellipsoid.ssl, (x, alpha))
        assert error <= lobes.ULPS, where


@given(st.floats(-1, 1).filter(lambda x: abs(x) > 1e-90), st.floats(1e-90, 1))
def test_the_square_of_a_quotient_has_twice_the_digits(x, alpha):
    parts = shipped._square_of_quotient(np.array([x]), np.array([alpha]))
    high, rest = (Fraction(float(part[0])) for part in parts)
    exact = (Fraction(x) / Fraction(alpha)) ** 2
    assert abs((high + rest) / exact - 1) < Fraction(2) ** -75 and abs(rest) < exact / 2**24


# --- joins ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("pair", [(1e-6, 1e-3), (0.2, 0.2), (0.9, 0.01), (1.0, 1.0)])
def test_value_and_slope_are_continuous_where_front_and_back_meet(pair):
    def at(z):
        return np.sqrt((1 - z) * (1 + z)) * 0.6, np.sqrt((1 - z) * (1 + z)) * 0.8, z

    def reference(z, _):
        return ellipsoid.sel(*at(z), *pair)

    path = np.linspace(-1e-4, 1e-4, 200)
    lobes.assert_joined(lambda z, _: sel(*at(z), *pair), reference, path, path)


def test_the_scale_for_tiny_roughness_changes_no_value():
    points = ellipsoid.samples(3000)
    alone = sel(*points)
    beside = sel(*(np.append(part, end) for part, end in zip(points, (0, 0, 1, 1e-300, 1.0), strict=True)))
    assert np.array_equal(beside[:-1], alone) and beside[-1] == 1


# --- limits and relations ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_exact_values(dtype):
    alpha = np.array([1e-30, 1e-8, 0.1, 0.7, 1.0], dtype)
    one = dtype(1)
    assert (ssl(one, alpha) == 1).all() and (sel(0 * one, -0 * one, one, alpha, alpha[::-1]) == 1).all()
    fourth = (alpha.astype(float) ** 2) ** 2
    assert np.allclose(ssl(-one, alpha), fourth, rtol=4 * np.finfo(dtype).eps, atol=np.finfo(dtype).smallest_subnormal)
    larger = np.maximum(fourth, fourth[::-1])
    assert np.allclose(sel(0 * one, 0 * one, -one, alpha, alpha[::-1]), larger, rtol=4 * np.finfo(dtype).eps, atol=0)
    assert np.array_equal(ssl(np.linspace(-1, 1, 101).astype(dtype), one), np.ones(101))


def test_sel_with_one_roughness_is_ssl():
    m, alpha = ellipsoid.cosines(3000)
    across = np.sqrt((1 - m) * (1 + m))
    near = np.abs(ssl(m, alpha) / sel(across * 0.6, across * 0.8, m, alpha, alpha) - 1)
    assert near.max() < 16 * np.finfo(float).eps


def test_signs_and_axes():
    x, y, z, a, b = ellipsoid.samples(3000)
    value = sel(x, y, z, a, b)
    assert np.array_equal(value, sel(-x, y, z, a, b)) and np.array_equal(value, sel(x, -y, z, a, b))
    assert np.array_equal(value, sel(y, x, z, b, a))
    assert (value > 0).all() and (value <= 1 + 1e-15).all()


def test_a_longer_vector_has_a_smaller_value():
    x, y, z, a, b = ellipsoid.samples(300)
    for scale in (1 - 9e-7, 1 + 9e-7):
        longer = (x * scale, y * scale, z * scale, a, b)
        assert ellipsoid.worst(sel, ellipsoid.sel, longer)[0] <= lobes.ULPS
        assert np.allclose(sel(*longer) * scale**2, sel(x, y, z, a, b), rtol=1e-14, atol=0)


# --- domain, types and shapes -----------------------------------------------------------------------------------


@pytest.mark.parametrize("bad", [0.0, -0.0, -5e-324, -1.0, np.nextafter(1, 2), 2.0, np.inf, -np.inf, np.nan])
def test_bad_roughness_is_nan_and_silent(bad):
    for m in (-1.0, 0.0, 0.6, 1.0):
        assert np.isnan(ssl(m, bad))
        s = np.sqrt(1 - m * m)
        assert np.isnan([sel(s, 0, m, bad, 0.5), sel(s, 0, m, 0.5, bad), sel(0, s, m, bad, bad)]).all()
    assert np.isnan(ssl(0.5, [bad, 0.5])).tolist() == [True, False]
    assert np.isnan(sel(0.6, 0, 0.8, [bad, 0.5], [0.5, 0.5])).tolist() == [True, False]
    assert np.isnan(ssl(np.float32(0.5), np.float32(bad))) or np.float32(bad) == 1


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, np.nextafter(1, 2), -np.nextafter(1, 2), 1e300, -2.0])
def test_bad_cosines_are_nan_and_silent(bad):
    assert np.isnan(ssl([bad, 0.5], 0.5)).tolist() == [True, False]


def test_vectors_that_are_not_of_unit_length_are_nan():
    x, y, z, a, b = ellipsoid.samples(2000)
    for scale in (0.0, 0.5, 1 - 1.1e-6, 1 + 1.1e-6, 2.0, 1e200, 1e-200, np.inf, np.nan):
        assert np.isnan(sel(x * scale, y * scale, z * scale, a, b)).all(), scale
    for scale in (1 - 0.9e-6, 1 + 0.9e-6):
        assert not np.isnan(sel(x * scale, y * scale, z * scale, a, b)).any(), scale
    for bad in (np.nan, np.inf, -np.inf):
        assert np.isnan([sel(bad, 0, 1, 0.5, 0.5), sel(0, bad, 1, 0.5, 0.5), sel(0, 0, bad, 0.5, 0.5)]).all()


def test_vectors_normalised_in_singles_are_of_unit_length():
    rng = np.random.default_rng(7)
    vector = rng.normal(size=(3, 10**5)).astype(np.float32)
    vector /= np.sqrt((vector * vector).sum(axis=0))
    assert not np.isnan(sel(*vector, np.float32(0.3), np.float32(0.1))).any()
    assert not np.isnan(sel(*vector.astype(float), 0.3, 0.1)).any()


@settings(deadline=None)
@given(*[st.floats()] * 5)
def test_no_wrong_finite_value_for_any_arguments(x, y, z, alpha_x, alpha_y):
    inside = abs(x) <= 1 and 0 < alpha_x <= 1
    assert np.isnan(ssl(x, alpha_x)) == (not inside)
    with np.errstate(all="ignore"):
        length = np.sqrt(np.square(x) + np.square(y) + np.square(z))
    if not (abs(length - 1) < 2e-6 and 0 < alpha_x <= 1 and 0 < alpha_y <= 1):
        assert np.isnan(sel(x, y, z, alpha_x, alpha_y))


def test_shapes():
    m, alpha = np.linspace(-1, 1, 7), np.array([0.1, 0.5, 1.0])
    table = ssl(m[:, None], alpha)
    assert table.shape == (7, 3) and all(table[i, j] == ssl(m[i], alpha[j]) for i in range(7) for j in range(3))
    table = sel(0.6, 0.0, np.array([[0.8], [-0.8]]), alpha, 0.3)
    assert table.shape == (2, 3) and table[1, 2] == sel(0.6, 0.0, -0.8, 1.0, 0.3)
    for shape in [(0,), (3, 0), (0, 2, 1)]:
        assert ssl(np.empty(shape), 0.5).shape == sel(np.empty(shape), 0, 1, 0.5, 0.5).shape == shape
    with pytest.raises(ValueError, match=r"^these shapes do not broadcast: x \(3,\), y \(2,\), z \(\)"):
        sel(np.zeros(3), np.zeros(2), 1, 0.5, 0.5)
    with pytest.raises(TypeError, match=r"^alpha_y must hold real numbers, not "):
        sel(0, 0, 1, 0.5, 1j)


def test_many_blocks_and_strides():
    n = _support.BLOCK + 5
    points = np.array(ellipsoid.samples(2 * n)).reshape(5, n, 2)
    whole = sel(*points[:, ::-2, 1])
    assert np.array_equal(whole[-9:], [sel(*point) for point in points[:, ::-2, 1].T[-9:]])
    assert np.array_equal(ssl(points[2, ::-2, 1], points[3, ::-2, 1])[-1], ssl(*points[2:4, ::-2, 1][:, -1]))


def test_dtypes_and_unchanged_arguments():
    single = np.float32([0.5])
    assert type(ssl(0.5, 0.5)) is type(sel(0, 0, 1, 0.5, 0.5)) is np.float64
    assert ssl(single, single).dtype == ssl(single, 0.5).dtype == sel(0 * single, 0, 1, 0.5, 0.5).dtype == np.float32
    assert ssl(single, np.float64(0.5)).dtype == sel(single, 0, 1, np.float64(0.5), 0.5).dtype == np.float64
    arguments = [np.array(part) for part in ((0.6, 9.0), (0.0, 0.0), (0.8, 1.0), (0.5, np.nan), (0.1, 0.5))]
    for part in arguments:
        part.flags.writeable = False
    assert np.isnan(sel(*arguments)).tolist() == [False, True]
    assert np.isnan(ssl(arguments[0], arguments[3])).tolist() == [False, True]


# --- traps ------------------------------------------------------------------------------------------------------


def printed_sel(x, y, z, alpha_x, alpha_y):
    """tokuyoshi_harada, the last display."""
    square = np.maximum(alpha_x, alpha_y) ** 2
    U = np.sqrt(square / alpha_x**2 * x * x + square / alpha_y**2 * y * y + z * z)
    return 4 * square**2 / ((U - z) + square * (U + z)) ** 2


def printed_ssl(m, alpha):
    return 4 * alpha**4 / (1 - m + alpha**2 * (1 + m)) ** 2


def test_the_difference_at_the_peak():
    """U - z has nothing left where the lobe has fallen to 0.64 and to 0.25: relative errors of 0.56 and 3."""
    points = [(1e-8, 0.0, 1.0, 1e-8, 1e-8), (0.0, 1e-9, 1.0, 3e-9, 1e-9), (2e-9, 0.0, 1.0, 1e-9, 1e-9)]
    assert_trap(printed_sel, sel, ellipsoid.sel, points, 0.5)
    assert_trap(printed_sel, sel, ellipsoid.sel, points[2:], 2.9)
    assert_trap(printed_sel, sel, ellipsoid.sel, [(1e-5, 2e-5, np.sqrt(1 - 5e-10), 1e-5, 3e-5)], 1e-8)
    single = [tuple(map(np.float32, point)) for point in [(2e-4, 0, 1, 1e-4, 1e-4), (2e-4, 0, 1, 1e-4, 5e-5)]]
    assert_trap(printed_sel, sel, ellipsoid.sel, single, 1)


def rounded_sel(x, y, z, alpha_x, alpha_y):
    """Without a difference in front, but with every quotient and square rounded."""
    P, square = (x / alpha_x) ** 2 + (y / alpha_y) ** 2, np.maximum(alpha_x, alpha_y) ** 2
    W = np.sqrt(square * P + z * z) + z
    return (2 * W / (P + W * W)) ** 2


def test_the_fourth_power_of_a_rounded_quotient():
    """Nothing cancels, and yet more than 8 ulp add up."""
    points = [
        (
            0.0011328168445717242,
            -0.0015688927587296886,
            0.9999981276490013,
            3.904517098045581e-07,
            8.004667085719312e-06,
        ),
        (
            7.024208329330075e-05,
            0.0001278208317752687,
            0.9999999893639423,
            3.0384742010650588e-05,
            1.9722764791047996e-06,
        ),
    ]
    assert_trap(rounded_sel, sel, ellipsoid.sel, points, 1e-15)
    for point in points:
        exact = ellipsoid.sel(*point)
        assert oracle.ulps(rounded_sel(*np.array(point)), exact) > lobes.ULPS > 2 * oracle.ulps(sel(*point), exact)


def test_a_cosine_cannot_tell_where_on_a_narrow_peak_it_is():
    """The cosine of 1e-8 is 1 in doubles, and that of 1e-4 in singles: the lobe of that width has fallen to 0.64."""
    for dtype, alpha in ((np.float64, 1e-8), (np.float32, 1e-4)):
        z = np.cos(dtype(alpha))
        assert z == 1 and ssl(z, dtype(alpha)) == 1
        assert sel(np.sin(dtype(alpha)), dtype(0), z, dtype(alpha), dtype(alpha)) == pytest.approx(0.64, rel=1e-6)


def by_half_the_angle(m, alpha):
    """pi alpha^2 D(cos(theta/2)), with the customary cos^2 (alpha^2 - 1) + 1."""
    d = np.sqrt((1 + m) / 2) ** 2 * (alpha * alpha - 1) + 1
    return alpha**4 / (d * d)


def test_half_the_angle_loses_the_peak():
    points = [(1 - 1e-12, 1e-6), (1 - 1e-13, 3e-7), (1.0, 3e-7)]
    assert_trap(by_half_the_angle, ssl, ellipsoid.ssl, points, 1e-5)
    assert_trap(by_half_the_angle, ssl, ellipsoid.ssl, [(np.float32(1 - 1e-6), np.float32(1e-3))], 1e-2)


def test_the_fourth_power_underflows():
    """0/0 on the axis, or a wrong 0, in doubles below a roughness of 1e-81, in singles below 1e-11."""
    with mp.workdps(800):
        assert_trap(printed_ssl, ssl, ellipsoid.ssl, [(1.0, 1e-90), (1.0, 1e-170)], 0.9)
        assert_trap(printed_ssl, ssl, ellipsoid.ssl, [(np.float32(1), np.float32(1e-12))], 0.9)
        points = [(0.0, 0.0, 1.0, 1e-90, 1e-95), (1e-90, 0.0, 1.0, 1e-90, 1e-90)]
        assert_trap(printed_sel, sel, ellipsoid.sel, points, 0.5)


def test_clamps_hide_nan_and_the_kernels_do_not():
    assert np.isnan(ssl([np.nan, 0.5], [0.5, np.nan])).all()
    assert oracle.ulps(ssl(1.0, 5e-324), 1) == 0
