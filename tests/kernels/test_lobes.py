"""What the kernels of the four distributions have in common, and their references against the definition."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from tests.kernels import lobes, oracle
from xsec_sym import kernels
from xsec_sym.kernels import _support

SIGMAS = [kernels.sigma_beckmann, kernels.sigma_ggx, kernels.sigma_ellipsoidal, kernels.sigma_spherical_gaussian]
LAMBDAS = [kernels.lambda_beckmann, kernels.lambda_ggx]
NDFS = [kernels.ndf_beckmann, kernels.ndf_ggx, kernels.ndf_ellipsoidal, kernels.ndf_spherical_gaussian]
KERNELS = [*SIGMAS, *LAMBDAS, *NDFS]
COSINE = st.floats(-1, 1)
SHAPE = st.floats(0, 1)
BAD_COSINES = [np.nan, np.inf, -np.inf, 1.0000000000000002, -1.0000000000000002, 1e300, -2.0]
BAD_SHAPES = [np.nan, -np.inf, -5e-324, -1.0, -1e300]


def named(kernel):
    return kernel.__name__


def largest_shape(kernel):
    """The last value of the second argument that is a number in the kernel's domain, and the first that is not."""
    if "ellipsoidal" in named(kernel):
        return (1.0, np.nextafter(1, 2)) if kernel in SIGMAS else (np.nextafter(1, 0), 1.0)
    return (np.inf, None) if "spherical" in named(kernel) else (np.finfo(float).max, np.inf)


@pytest.fixture(params=KERNELS, ids=named)
def kernel(request):
    return request.param


def of_definition(name):
    """The NDF of a kernel's name in mpmath, as a function of x for a given roughness, at the working precision."""
    reference = getattr(lobes, name)
    return lambda roughness: lambda x: reference.__wrapped__(x, mpf(roughness))


@pytest.mark.parametrize(
    ("name", "roughness", "cuts"),
    [("beckmann", 0.5, [0]), ("beckmann", 2.0, [0]), ("ggx", 0.25, [0]), ("ggx", 3.0, [0])]
    + [("ellipsoidal", b, []) for b in (1e-3, 0.25, 0.9, 0.999)],
)
@pytest.mark.parametrize("u", [-1.0, -0.6, -0.1, 0.0, 0.3, 0.95, 1.0])
def test_closed_forms_agree_with_the_definition(name, roughness, cuts, u):
    with mp.workdps(60):
        ndf = of_definition(f"ndf_{name}")(roughness)
        # `quad` samples no endpoint, and a height field has no normals below.
        exact = oracle.cross_section_over_rings(ndf, u, cuts)
        assert mp.almosteq(getattr(lobes, f"sigma_{name}")(u, roughness), exact, 1e-28, 1e-35)


@pytest.mark.parametrize(
    ("u", "alpha"),
    [
        (-1.0, 0.4),
        (-0.3, 1.0),
        (0.5, 20.0),
        *(pytest.param(u, alpha, marks=pytest.mark.deep) for u, alpha in ((0.0, 0.5), (0.9, 0.3))),
    ],
)
def test_reference_of_the_spherical_gaussian_does_not_depend_on_the_axis_chosen(u, alpha):
    with mp.workdps(20):
        ndf = of_definition("ndf_spherical_gaussian")(alpha)
        assert mp.almosteq(lobes.sigma_spherical_gaussian(u, alpha), oracle.cross_section_about_view(ndf, u), 1e-15)


@pytest.mark.parametrize(
    ("u", "alpha"), [(-1.0, 0.4), (-0.98, 0.06), (-0.02, 1e-3), (-0.3, 1.0), (1e-4, 1e-4), (0.9, 9.0)]
)
def test_reference_of_the_spherical_gaussian_agrees_with_itself_at_more_digits(u, alpha):
    with mp.workdps(60):
        more = lobes.sigma_spherical_gaussian(u, alpha, 50)
        assert abs(lobes.sigma_spherical_gaussian(u, alpha) / more - 1) < 1e-25


@pytest.mark.parametrize("alpha", [0.35, 0.8, 3.0])
def test_reference_of_the_spherical_gaussian_agrees_with_its_end_points(alpha):
    """deon2016 (30), (31) and (32), of which the first and the last stand in each other's place in print."""
    with mp.workdps(50):
        a, k = mpf(alpha), 2 / mpf(alpha) ** 2
        ends = {
            1.0: (a**2 - mp.exp(k) * (a**2 - 2)) / (4 * mp.sinh(k)),
            0.0: mp.besseli(1, k) / (2 * mp.sinh(k)),
            -1.0: (a**2 - mp.exp(-k) * (a**2 + 2)) / (4 * mp.sinh(k)),
        }
        for u, value in ends.items():
            assert mp.almosteq(lobes.sigma_spherical_gaussian(u, alpha), value, 1e-28)


@pytest.mark.parametrize("kernel", [*SIGMAS, *LAMBDAS], ids=named)
def test_broadcasting(kernel):
    u, shape = np.linspace(0, 1, 7), np.array([0.0, 0.3, 1.0])
    table = kernel(u[:, None], shape)
    assert table.shape == (7, 3)
    assert all(table[i, j] == kernel(u[i], shape[j]) for i in range(7) for j in range(3))


def test_many_blocks_and_strides(kernel):
    rng = np.random.default_rng(1)
    u, shape = rng.uniform(0, 1, (2, _support.BLOCK + 5, 2))
    whole = kernel(u[::-2, 1], shape[::-2, 0])
    assert np.array_equal(
        whole[-9:], [kernel(*pair) for pair in zip(u[::-2, 1][-9:], shape[::-2, 0][-9:], strict=True)]
    )
    assert np.array_equal(kernel(np.asfortranarray(u), 0.5), kernel(u, 0.5))
    one_shape = np.full_like(u[:, 0], 0.3)
    assert np.array_equal(kernel(u[:, 0], one_shape), kernel(u[:, 0], 0.3))


@pytest.mark.parametrize("shape", [(0,), (3, 0), (0, 2, 1)])
def test_empty(kernel, shape):
    assert kernel(np.empty(shape), 0.5).shape == shape
    assert kernel(0.5, np.empty(shape)).shape == shape


def test_dtypes(kernel):
    single = np.float32([0.5])
    assert type(kernel(0.5, 0.5)) is np.float64
    assert type(kernel(np.float32(0.5), 0.5)) is np.float32
    assert kernel(single, single).dtype == kernel(single, 0.5).dtype == kernel(0.5, single).dtype == np.float32
    assert kernel(single, np.float64(0.5)).dtype == kernel([0.5], single).dtype == np.float64
    assert kernel(single, [0.5]).dtype == kernel(np.float16([0.5]), 0.5).dtype == kernel(1, 0.5).dtype == np.float64


def test_arguments_are_not_changed(kernel):
    u, shape = np.array([-0.5, 0.5, np.nan, 3.0]), np.array([0.5, 0.0, 0.5, np.nan])
    u.flags.writeable = shape.flags.writeable = False
    assert kernel(u, shape).flags.writeable


@pytest.mark.parametrize("bad", BAD_COSINES)
def test_bad_cosines_are_nan_and_silent(kernel, bad):
    for shape in (0.0, 1e-4, 0.5, 1.0, np.inf):
        assert np.isnan(kernel(bad, shape))
        assert np.isnan(kernel(np.float32(-2), np.float32(shape)))
    assert np.isnan(kernel([bad, 0.5], 0.5)).tolist() == [True, False]


@pytest.mark.parametrize("bad", BAD_SHAPES)
def test_bad_shapes_are_nan_and_silent(kernel, bad):
    for u in (-1.0, -0.5, -0.0, 0.0, 5e-324, 0.5, 1.0):
        assert np.isnan(kernel(u, bad))
    assert np.isnan(kernel(0.5, [bad, 0.5])).tolist() == [True, False]


def test_ends_of_the_domain(kernel):
    last, beyond = largest_shape(kernel)
    u = np.array([0.0, 5e-324, 0.5, np.nextafter(1, 0), 1.0])
    assert not np.isnan(kernel(u, last)).any()
    assert beyond is None or np.isnan(kernel(u, beyond)).all()
    first = 5e-324 if "ndf" in named(kernel) and "ellipsoidal" not in named(kernel) else 0.0
    assert not np.isnan(kernel(u, first)).any()
    assert (first == 0.0) or np.isnan(kernel(u, 0.0)).all()
    if kernel in LAMBDAS:
        assert np.isnan(kernel([-5e-324, -0.5, -1.0], 0.5)).all()


@settings(deadline=None)
@given(st.floats(), st.floats())
def test_no_wrong_finite_value_for_any_arguments(u, shape):
    for kernel in KERNELS:
        value, (last, _) = kernel(u, shape), largest_shape(kernel)
        low = 0.0 if kernel in LAMBDAS else -1.0
        inside = low <= u <= 1 and 0 <= shape <= last
        if "ndf" in named(kernel) and "ellipsoidal" not in named(kernel):
            inside = inside and shape > 0
        assert np.isnan(value) == (not inside), named(kernel)
        assert not value < 0, named(kernel)


@settings(deadline=None)
@given(COSINE, st.floats(1e-300, 1e300))
def test_extreme_roughness(u, alpha):
    """No square may leave the range of doubles: these hold for roughnesses of any size, to a looser tolerance."""
    pairs = [(kernels.sigma_beckmann, lobes.sigma_beckmann), (kernels.sigma_ggx, lobes.sigma_ggx)]
    pairs += [(kernels.ndf_beckmann, lobes.ndf_beckmann), (kernels.ndf_ggx, lobes.ndf_ggx)]
    for kernel, reference in pairs:
        with mp.workdps(1400):
            error, _ = lobes.worst(kernel, reference, np.array([u]), np.array([alpha]))
        assert error <= (4096 if kernel is kernels.ndf_beckmann and not 1e-100 < alpha < 1e100 else lobes.ULPS)


@pytest.mark.parametrize("kernel", SIGMAS, ids=named)
@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_the_flat_limit_is_exact(kernel, dtype):
    u = np.linspace(-1, 1, 101).astype(dtype)
    flat = kernel(u, dtype(1.0 if "ellipsoidal" in named(kernel) else 0.0))
    assert np.array_equal(flat, np.maximum(u, 0)) and not np.signbit(flat).any()


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_the_isotropic_limit_is_exact(dtype):
    u = np.linspace(-1, 1, 101).astype(dtype)
    sphere = dtype(1 / (4 * np.pi))
    eps = np.finfo(dtype).eps
    assert (kernels.sigma_ellipsoidal(u, dtype(0.0)) == 0.25).all()
    assert (kernels.sigma_spherical_gaussian(u, dtype(np.inf)) == 0.25).all()
    for tiny, huge in [(0.0, np.inf), (1e-30, 1e30)]:
        assert np.allclose(kernels.ndf_ellipsoidal(u, dtype(tiny)), sphere, rtol=2 * eps, atol=0)
        assert np.allclose(kernels.ndf_spherical_gaussian(u, dtype(huge)), sphere, rtol=2 * eps, atol=0)
        assert np.allclose(kernels.sigma_ellipsoidal(u, dtype(tiny)), 0.25, rtol=2 * eps, atol=0)
        assert np.allclose(kernels.sigma_spherical_gaussian(u, dtype(huge)), 0.25, rtol=3e-15 + eps, atol=0)


@settings(deadline=None)
@given(COSINE, SHAPE)
def test_two_sides_differ_by_the_mean_cosine(u, shape):
    u, eps = abs(u), np.finfo(float).eps
    for sigma in SIGMAS:
        if sigma is kernels.sigma_ellipsoidal:
            with mp.workdps(400):
                b = mpf(shape)
                mean = float(1 / b - 1 / mp.atanh(b)) if 0 < b < 1 else shape
        elif sigma is kernels.sigma_spherical_gaussian:
            with mp.workdps(400):
                kappa = 2 / mpf(shape) ** 2 if shape else mp.inf
                mean = float(mp.coth(kappa) - 1 / kappa) if kappa < 1e300 else 1.0
        else:
            mean = 1.0
        facing, opposite = sigma(u, shape), sigma(-u, shape)
        assert abs(facing - opposite - mean * u) <= 16 * eps * facing, named(sigma)


@settings(deadline=None)
@given(st.floats(1e-150, 1), st.floats(0, 1e4))
def test_lambda_is_the_dark_side(u, alpha):
    eps = np.finfo(float).eps
    for sigma, smith in zip(SIGMAS, LAMBDAS, strict=False):
        value = smith(u, alpha)
        assert abs(sigma(-u, alpha) - value * u) <= 16 * eps * value * u + 1e-322
        assert abs(sigma(u, alpha) - (1 + value) * u) <= 16 * eps * sigma(u, alpha)


@settings(deadline=None)
@given(COSINE, COSINE, st.floats(1e-4, 1))
def test_sigma_rises_with_the_cosine(u, v, shape):
    for sigma in SIGMAS:
        low, high = sigma(min(u, v), shape), sigma(max(u, v), shape)
        assert low <= high * (1 + 1e-14), named(sigma)


@pytest.mark.parametrize("kernel", NDFS, ids=named)
@pytest.mark.parametrize("shape", [0.05, 0.3, 0.9])
def test_ndfs_are_normalised(kernel, shape):
    """Gauss-Legendre on panels; per steradian on the sphere, or projected area on the upper hemisphere."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    edges = np.concatenate([[-1.0], -(0.5 ** np.arange(1, 12)), [0.0], 1 - 0.5 ** np.arange(1, 40), [1.0]])
    half = np.diff(edges)[:, None] / 2
    u = (edges[:-1, None] + half) + half * nodes
    projection = 1.0 if "ellipsoidal" in named(kernel) or "spherical" in named(kernel) else u
    assert abs(2 * np.pi * (half * weights * projection * kernel(u, shape)).sum() - 1) < 1e-13
