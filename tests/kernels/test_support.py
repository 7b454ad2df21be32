import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from xsec_sym import kernels
from xsec_sym.kernels import _support

KERNELS = [kernels.sigma_dirac_ring, kernels.sigma_power]
OUTSIDE = [np.nan, np.inf, -np.inf, 1.0000000000000002, -2, 1e300]
MODERATE = st.floats(-1e100, 1e100, allow_subnormal=False).filter(lambda x: x == 0 or abs(x) > 1e-100)


@pytest.fixture(params=KERNELS, ids=lambda kernel: kernel.__name__)
def kernel(request):
    return request.param


def test_broadcasting(kernel):
    u, x = np.linspace(-1, 1, 7), np.arange(2.0)
    table = kernel(u[:, None], x)
    assert table.shape == (7, 2)
    assert all(table[i, j] == kernel(u[i], x[j]) for i in range(7) for j in range(2))


def test_many_blocks_and_strides(kernel):
    u = np.random.default_rng(1).uniform(-1, 1, (3 * _support.BLOCK + 5, 2))
    whole = kernel(u[::-2, 1], 1)
    assert np.array_equal(whole, [kernel(one, 1) for one in u[::-2, 1][:50]] + list(whole[50:]))
    assert np.array_equal(kernel(np.asfortranarray(u), 1), kernel(u, 1))


@pytest.mark.parametrize("shape", [(0,), (3, 0), (0, 2, 1)])
def test_empty(kernel, shape):
    assert kernel(np.empty(shape), 1).shape == shape


def test_zero_dimensional_gives_scalars(kernel):
    assert type(kernel(0.5, 1)) is np.float64
    assert type(kernel(np.float32(0.5), 1)) is np.float32
    assert type(kernel(np.array(0.5, np.float32), 1.0)) is np.float32


@pytest.mark.parametrize(
    ("u", "x", "dtype"),
    [
        (np.float32([0.5]), 1, np.float32),
        (np.float32([0.5]), 1.0, np.float32),
        (np.float32([0.5]), np.float32(1), np.float32),
        (np.float32([0.5]), np.float64(1), np.float64),
        (np.float32([0.5]), [1.0], np.float64),
        (np.float32([0.5]), np.array([1.0]), np.float64),
        (np.float16([0.5]), 1, np.float64),
        (np.longdouble([0.5]), 1, np.float64),
        ([1, 0], 1, np.float64),
        (1, 1, np.float64),
        (np.array([True]), 1, np.float64),
    ],
)
def test_dtypes(kernel, u, x, dtype):
    assert kernel(u, x).dtype == dtype


def test_orders_keep_float32():
    u = np.float32([0.5])
    assert kernels.sigma_power(u, np.array([2])).dtype == np.float32
    assert kernels.sigma_power(u, np.uint8(2)).dtype == np.float32
    assert kernels.sigma_power(u, np.array([2.0])).dtype == np.float64
    assert kernels.sigma_dirac_ring(u, np.array([1])).dtype == np.float64


@pytest.mark.parametrize("bad", [*OUTSIDE, 10**400, -(10**400)], ids=lambda bad: str(bad)[:20])
def test_outside_the_domain_is_nan_and_silent(kernel, bad):
    assert np.isnan(kernel(bad, 1))
    assert np.isnan(kernel(np.float32(0.5), np.float32(-2)))
    if not isinstance(bad, int):
        assert np.isnan(kernel([bad, 0.5], 1)).tolist() == [True, False]
    if not -3 < bad < 3:
        assert np.isnan(kernel(0.5, bad))


@pytest.mark.parametrize("bad", ["1", 1j, None, object(), ["a"], np.array([1j]), np.datetime64("2020"), b"1", {}])
def test_impossible_dtypes_raise(kernel, bad):
    with pytest.raises(TypeError, match=r"^u must hold real numbers, not "):
        kernel(bad, 1)
    with pytest.raises(TypeError, match="must hold real numbers, not "):
        kernel(0.5, bad)


def test_impossible_shapes_raise(kernel):
    with pytest.raises(ValueError, match=r"^these shapes do not broadcast: u \(3,\), .* \(2,\)$"):
        kernel(np.zeros(3), np.zeros(2))
    with pytest.raises(ValueError, match=r"^u is not a rectangular array of numbers$"):
        kernel([[1.0], [1.0, 2.0]], 1)


def test_inputs_are_not_changed(kernel):
    u, x = np.array([-0.5, 0.5, np.nan, 3.0]), np.array([1.0, 0.0, 1.0, 1.0])
    u.flags.writeable = x.flags.writeable = False
    assert kernel(u, x).flags.writeable


@given(MODERATE, MODERATE)
def test_error_free_transformations(a, b):
    total, lost = _support.two_sum(a, b)
    assert Fraction(total) + Fraction(lost) == Fraction(a) + Fraction(b)
    total, lost = _support.quick_two_sum(*sorted([a, b], key=abs, reverse=True))
    assert Fraction(total) + Fraction(lost) == Fraction(a) + Fraction(b)
    product, lost = _support.two_prod(a, b)
    assert Fraction(product) + Fraction(lost) == Fraction(a) * Fraction(b)
    square, lost = _support.two_square(a)
    assert Fraction(square) + Fraction(lost) == Fraction(a) ** 2


def test_horner():
    assert np.array_equal(_support.horner([2.0, 0.0, 1.0], np.array([3.0, -1.0])), [19.0, 3.0])


def test_import_brings_no_symbolic_library():
    code = "import sys, xsec_sym.kernels; print([m for m in ('sympy', 'mpmath', 'scipy') if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "[]"
