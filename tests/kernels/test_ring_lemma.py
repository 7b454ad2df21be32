import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from tests.kernels import oracle
from xsec_sym.kernels import cross_section, sigma_dirac_ring, sigma_power

BOTH_SIDES = [-1.0, -0.999, -0.6, -0.1, -1e-3, 0.0, 1e-3, 0.1, 0.6, 0.999, 1.0]
ALPHA, KAPPA = 0.01, 5000.0


def beckmann(x, exp=np.exp):
    return exp(-(1 - x * x) / (x * x * ALPHA**2)) / (math.pi * ALPHA**2 * x**4) if x > 0 else 0.0


def ggx(x):
    return np.where(x > 0, ALPHA**2 / (np.pi * ((1 - x) * (1 + x) + (ALPHA * x) ** 2) ** 2), 0.0)


def spherical_gaussian(x, exp=np.exp):
    return exp(KAPPA * (x - 1))


def inverse_quadratic(u):
    u = abs(u)
    root = mp.sqrt(2 - u * u)
    return 2 * mp.pi * (root - 1 + u * mp.log(mp.sqrt(2) * (1 + u) / (u + root)))


def inverse_linear(u):
    return 2 * mp.pi * (1 - u * mp.log(1 + 1 / u)) if u > 0 else (2 * mp.pi if u == 0 else mpf("inf"))


def inverse_square(u):
    cuts = [0.9, 0.99, 0.999, 0.9999, 0.99999, 0.999999]
    return oracle.cross_section_over_rings(lambda x: 1 / (1 - x) ** 2, u, cuts) if u < 0 else mpf("inf")


def smith_ggx(u):
    u = mpf(u)
    return (u + mp.sqrt(u * u + ALPHA**2 * (1 - u * u))) / 2


def smith_beckmann(u):
    u = mpf(u)
    if abs(u) == 1:
        return max(u, mpf(0))
    h = mp.sqrt(1 - u * u) * ALPHA
    a = u / h
    # erfc keeps the digits of the dark side.
    return h * (mp.exp(-a * a) / mp.sqrt(mp.pi) + a * mp.erfc(-a)) / 2


def sigma_spherical_gaussian(u):
    return oracle.cross_section_over_rings(lambda x: mp.exp(KAPPA * (x - 1)), u, [1 - 100 / KAPPA, 1 - 10 / KAPPA])


def by_rings(ndf, *cuts):
    return lambda u: oracle.cross_section_over_rings(ndf, u, cuts)


def monomial(p):
    return lambda u: oracle.cross_section_over_rings(lambda x: x**p, u) if p % 2 == 0 else 2 * mp.pi * mpf(u) / (p + 2)


CASES = {
    **{f"x^{p}": (lambda x, p=p: x**p, monomial(p), 1e-10) for p in (0, 1, 2, 3, 4, 7)},
    "1/(1+x)": (lambda x: 1 / (1 + x), inverse_linear, 1e-9),
    "1/(1-x)": (lambda x: 1 / (1 - x), lambda u: inverse_linear(-u), 1e-9),
    "1/(1-x)^2": (lambda x: 1 / (1 - x) ** 2, inverse_square, 1e-8),
    "1/(1+x^2)": (lambda x: 1 / (1 + x * x), inverse_quadratic, 1e-10),
    "exp(x)(1+x^3)": (lambda x: np.exp(x) * (1 + x**3), by_rings(lambda x: mp.exp(x) * (1 + x**3)), 1e-10),
    "step": (lambda x: x > 0.3, by_rings(lambda x: mpf(x > mpf(0.3)), 0.3), 1e-9),
    "ggx": (ggx, smith_ggx, 1e-10),
    "beckmann": (beckmann, smith_beckmann, 1e-10),
    "spherical gaussian": (spherical_gaussian, sigma_spherical_gaussian, 1e-10),
}


@pytest.mark.parametrize("name", CASES)
def test_true_error_is_within_the_estimate(name):
    ndf, reference, aim = CASES[name]
    values, errors = cross_section(ndf).estimate(BOTH_SIDES)
    for u, value, error in zip(BOTH_SIDES, values, errors, strict=True):
        with mp.workdps(30):
            exact = reference(u)
            if mp.isinf(exact):
                assert value == np.inf and error == np.inf
            else:
                assert abs(mpf(float(value)) - exact) <= error
                # What is too dark to be a double has no relative error.
                # What is too dark to be a normal double has no relative error; an odd D cancels near u = 0.
                assert error <= aim * max(abs(value), 0.3 if name in ("x^1", "x^3", "x^7") else 1e-290)


@pytest.mark.parametrize("name", ["x^0", "x^3", "x^4", "1/(1+x^2)", "exp(x)(1+x^3)"])
def test_references_agree_with_the_rotated_axis(name):
    ndf = {"exp(x)(1+x^3)": lambda x: mp.exp(x) * (1 + x**3)}.get(name, CASES[name][0])
    for u in (-0.6, 0.1):
        with mp.workdps(15):
            rotated = oracle.cross_section_about_view(ndf, u)
        with mp.workdps(30):
            assert abs(rotated - CASES[name][1](u)) < 1e-9


def test_peaked_references_agree_with_the_integral_over_rings():
    with mp.workdps(30):
        for u in (-0.02, 0.3):
            cuts = [0.9, 0.99, 0.999, 0.9999]
            over_rings = oracle.cross_section_over_rings(lambda x: beckmann(x, mp.exp), u, [0, *cuts])
            assert mp.almosteq(over_rings, smith_beckmann(u), 1e-15)
            over_rings = oracle.cross_section_over_rings(
                lambda x: ALPHA**2 / (mp.pi * (1 - x * x + (ALPHA * x) ** 2) ** 2) if x > 0 else mpf(0), u, [0, *cuts]
            )
            assert mp.almosteq(over_rings, smith_ggx(u), 1e-12)


def test_known_values():
    one_sided = cross_section(lambda x: 1 / (1 + x))
    assert np.isclose(one_sided(0.5), 2 * np.pi * (1 - 0.5 * np.log(3)), rtol=1e-12)
    assert one_sided(-1e-9) == np.inf
    u = np.linspace(-1, 1, 41)
    assert np.allclose(cross_section(lambda x: x**4)(u), -np.pi / 24 * (u**4 - 6 * u * u - 3), rtol=1e-12)


@pytest.mark.parametrize("power", [1.0, 1.2, 1.7, 3.0, 40.0])
def test_non_integrable_poles_are_infinite_on_their_side(power):
    value, error = cross_section(lambda x: (1 - x) ** -power).estimate([0.7, 1e-12, -0.7])
    assert value[0] == value[1] == error[0] == error[1] == np.inf
    assert np.isfinite(value[2]) and error[2] < 1e-8 * value[2]
    edge_on = cross_section(lambda x: (1 - x) ** -power)(0)
    assert np.isinf(edge_on) == (power >= 1.5)


def test_slow_divergence_is_infinite():
    assert cross_section(lambda x: 1 / ((1 - x) * (1 - np.log((1 - x) / 2))))(0.5) == np.inf
    assert cross_section(lambda x: 1 / np.abs(x))(0.5) == np.inf


@pytest.mark.parametrize("width", [5e-4, 3e-3, 0.03])
@pytest.mark.parametrize("floor", [0.0, 1.0])
def test_a_narrow_peak_nobody_announced_is_seen(width, floor):
    """A box: its cross-section by the trapezoidal rule over rings within it, which are smooth there."""
    views = np.array([-0.9, -0.3, 0.0, 0.5, 0.95, 1.0])
    for at in np.random.default_rng(1).uniform(-0.99, 0.99, 6):
        rings = at + width * np.linspace(-0.5, 0.5, 4001)
        exact = np.trapezoid(sigma_dirac_ring(rings[:, None], views), rings, axis=0)
        sigma = cross_section(lambda x, at=at: floor + (np.abs(x - at) < 0.5 * width))
        value, error = sigma.estimate(views)
        found = np.abs(value - floor * np.pi - exact)
        # the rule itself is off by what a kink in a ring's cross-section costs between two of its points
        assert (found <= error + 1e-4 * width).all() and (error < 1e-3 * (width + value)).all(), at


@pytest.mark.parametrize("power", [0.25, 0.5, 0.75, 0.9])
def test_integrable_poles_are_finite(power):
    value, error = cross_section(lambda x: (1 - x) ** -power).estimate(1.0)
    exact = 2 * np.pi * (1 / (1 - power) - 1 / (2 - power))
    assert abs(value - exact) <= error < 0.05 * exact


def test_a_negative_pole_is_minus_infinity():
    assert cross_section(lambda x: -1 / (1 - x))(0.5) == -np.inf


@settings(max_examples=12, deadline=None)
@given(st.floats(-0.999, 0.999), st.floats(-1, 1))
@example(5e-324, 0.0)
@example(-5e-324, 0.3)
@example(4.3075519357926675e-14, 0.03125)
def test_a_jump_nobody_announced_is_within_the_estimate(jump, u):
    value, error = cross_section(lambda x: x > jump).estimate(u)
    announced, its_error = cross_section(lambda x: x > jump, breakpoints=[jump]).estimate(u)
    assert abs(value - announced) <= error + its_error
    assert error < 1e-8
    with mp.workdps(20):
        exact = oracle.cross_section_over_rings(lambda x: mpf(x > mpf(jump)), u, [jump])
    assert abs(value - exact) <= error


@settings(max_examples=15, deadline=None)
@given(st.lists(st.floats(0, 1), min_size=1, max_size=6), st.floats(-1, 1))
def test_polynomials_are_sums_of_powers(coefficients, u):
    value, error = cross_section(lambda x: np.polyval(coefficients[::-1], x)).estimate(u)
    terms = np.array(coefficients) * sigma_power(u, np.arange(len(coefficients)))
    assert abs(value - terms.sum()) <= error + 1e-15 * np.abs(terms).sum()


def test_unresolved_noise_shows_in_the_error():
    value, error = cross_section(lambda x: 1 + 1e-3 * np.sin(1e9 * x)).estimate(0.5)
    assert abs(value - np.pi) <= error
    assert error > 1e-8


def test_a_peak_away_from_the_poles_is_found_by_its_breakpoint():
    width = 1e-5
    value, error = cross_section(lambda x: np.exp(-(((x - 0.3) / width) ** 2)), breakpoints=[0.3]).estimate(-0.2)
    with mp.workdps(20):
        cuts = [0.3 + k * width for k in (-9, -3, 0, 3, 9)]
        exact = oracle.cross_section_over_rings(lambda x: mp.exp(-(((x - mpf(0.3)) / width) ** 2)), -0.2, cuts)
    assert abs(value - exact) <= error < 1e-9 * value


def test_scalar_functions_and_constants_work():
    u = [-0.5, 0.2, 1]
    assert np.allclose(cross_section(math.exp)(u), cross_section(np.exp)(u), rtol=1e-14)
    assert np.allclose(cross_section(lambda x: 1.0)(u), np.pi, rtol=1e-13)
    assert np.allclose(cross_section(lambda x: 1 if x > 0 else 0)(u), cross_section(lambda x: x > 0)(u), rtol=1e-13)


def test_numpy_semantics():
    sigma = cross_section(lambda x: 1 + x)
    value, error = sigma.estimate([[np.nan, 1.5, -np.inf], [0.1, 0.2, 0.3]])
    assert np.isnan(value[0]).all() and np.isnan(error[0]).all() and np.isfinite(value[1]).all()
    assert sigma(np.float32(0.5)).dtype == np.float32 and type(sigma(0.5)) is np.float64
    assert sigma(np.zeros((0, 3))).shape == (0, 3)
    many = np.linspace(-1, 1, 301)
    assert np.allclose(sigma(many)[::50], [sigma(u) for u in many[::50]], rtol=1e-13)
    with pytest.raises(TypeError, match=r"^u must hold real numbers"):
        sigma("0.5")


@pytest.mark.parametrize("ndf", [None, 3.0, "x"])
def test_no_function(ndf):
    with pytest.raises(TypeError, match=r"^ndf must be a function of x = cos\(theta\), not "):
        cross_section(ndf)


@pytest.mark.parametrize(
    ("ndf", "kind", "sentence"),
    [
        (lambda x: np.nan * x, ValueError, "ndf must return finite values"),
        (lambda x: np.where(np.abs(x) < 0.2, np.inf, 1.0), ValueError, "ndf must return finite values"),
        (lambda x: np.sqrt(x), ValueError, "ndf must return finite values"),
        (lambda x: np.ones(7), ValueError, "ndf must return one value for each x"),
        (lambda x: x[:2], ValueError, "ndf fails on a number"),
        (lambda x: 1 / 0, ValueError, "ndf fails on a number"),
        (lambda: 1.0, ValueError, "ndf fails on a number"),
        (lambda x: 1j * x, TypeError, "ndf must return real numbers"),
        (lambda x: None, TypeError, "ndf must return real numbers"),
    ],
)
def test_bad_functions(ndf, kind, sentence):
    with pytest.raises(kind, match=r"^" + sentence):
        cross_section(ndf)(0.5)


@pytest.mark.parametrize("rtol", [0, -1, 1, np.nan, np.inf])
def test_bad_tolerances(rtol):
    with pytest.raises(ValueError, match=r"^rtol must lie between 0 and 1"):
        cross_section(np.exp, rtol=rtol)


@pytest.mark.parametrize("breakpoints", [[2.0], [np.nan]])
def test_bad_breakpoints(breakpoints):
    with pytest.raises(ValueError, match=r"^breakpoints must be cosines"):
        cross_section(np.exp, breakpoints=breakpoints)


def test_display():
    sigma = cross_section(lambda x: 1 + 0 * x)
    assert repr(sigma) == "<CrossSection of <lambda>, rtol = 1e-10>"
    html = sigma._repr_html_()
    assert "&lt;lambda&gt;" in html and "<lambda>" not in html and f"<td>{np.pi:.10g}</td>" in html
