import numpy as np
import pytest
from mpmath import mp, mpf

from xsec_sym.walks import HEIGHTS, SmithMedium, compare, first_order, heights, visibility

PATHS = 40_000
PLACES = [(0.1, 0.3, 0.05), (0.5, 0.6, 0.3), (1.0, 0.1, 0.95), (4.0, 0.9, 0.5)]
each_kind = pytest.mark.parametrize("kind", HEIGHTS)

# Densities and cumulative distributions, from their definitions.
DEFINITIONS = {
    "gaussian": (mp.npdf, mp.ncdf),
    "uniform": (lambda h: mpf(0 <= h <= 1), lambda h: min(max(h, mpf(0)), mpf(1))),
    "logistic": (lambda h: 1 / (2 * mp.cosh(h / 2)) ** 2, lambda h: 1 / (1 + mp.exp(-h))),
    "exponential": (lambda h: mp.exp(-h), lambda h: 1 - mp.exp(-h)),
}


@each_kind
def test_heights_far_up_and_far_down(kind):
    """The logarithm of C1 and its inverse, from 1e-12 to 600; exp(-600) is not far from the smallest double."""
    log = -np.concatenate([np.logspace(-12, 2.78, 40), np.linspace(0.5, 3, 11)])
    height = HEIGHTS[kind].inverse(log)
    assert (np.diff(height[np.argsort(log)]) > 0).all()
    for ell, h in zip(log, height, strict=True):
        with mp.workdps(400):
            exact = mp.log(DEFINITIONS[kind][1](mpf(float(h))))
        # as far as a height of doubles can tell
        assert float(exact) == pytest.approx(ell, rel=1e-4 if kind == "uniform" else 1e-9)
        assert float(HEIGHTS[kind].log_cdf(h)) == pytest.approx(float(exact), rel=1e-11)
    assert HEIGHTS[kind].log_cdf(np.array([np.inf])) == 0


@each_kind
@pytest.mark.parametrize("rise", [-0.8, -0.1, 0.1, 0.6])
def test_free_paths_obey_the_density(kind, rise):
    """How many get from one height to another, against the exponential of the integral of P1/C1 along the way."""
    alpha, start = 0.8, float(HEIGHTS[kind].inverse(np.log(np.array(0.4))))
    medium = SmithMedium(alpha, heights=kind)
    found = medium._next_heights(np.full(PATHS, start), np.full(PATHS, rise), np.random.default_rng(1))
    # the cross-section by its definition: the clamped integral over the GGX distribution
    theta, phi = (np.arange(400) + 0.5) / 400 * np.pi / 2, (np.arange(800) + 0.5) / 800 * 2 * np.pi
    c, s = np.cos(theta)[:, None], np.sin(theta)[:, None]
    ndf = alpha**2 / (np.pi * ((alpha**2 - 1) * c**2 + 1) ** 2)
    facing = np.maximum(np.sqrt(1 - rise**2) * s * np.cos(phi) - rise * c, 0)
    sigma = (ndf * s * facing).sum() * (np.pi / 800) * (np.pi / 400)
    pdf, cdf = DEFINITIONS[kind]
    for level in (0.1, 0.3) if rise < 0 else (0.5, 0.8):
        end = float(HEIGHTS[kind].inverse(np.log(np.array(level))))
        depth = abs(mp.quad(lambda h: pdf(h) / cdf(h), [start, end])) * sigma / abs(rise)
        beyond = (found < end).sum() if rise < 0 else (found > end).sum()
        assert compare.share("beyond", float(mp.exp(-depth)), int(beyond), PATHS).p_value > 1e-4
        assert compare.share("beyond", float(mp.exp(-1.1 * depth)), int(beyond), PATHS).p_value < 1e-2


@each_kind
@pytest.mark.parametrize(("alpha", "cosine_i", "cosine_o"), PLACES)
def test_visibility(kind, alpha, cosine_i, cosine_o):
    checks = visibility(SmithMedium(alpha, heights=kind), cosine_i, cosine_o, PATHS, np.random.default_rng(2))
    assert min(check.p_value for check in checks) > 1e-4


def test_visibility_rejects_a_wrong_lambda(monkeypatch):
    right = heights.lambda_ggx
    monkeypatch.setattr(heights, "lambda_ggx", lambda u, alpha: 1 + right(u, alpha))
    checks = visibility(SmithMedium(0.5), 0.6, 0.3, PATHS, np.random.default_rng(3))
    assert max(check.p_value for check in checks) < 1e-20


@each_kind
@pytest.mark.parametrize(("alpha", "cosine"), [(0.4, 1.0), (1.0, 0.1)])
def test_light_of_the_first_order(kind, alpha, cosine):
    walk = SmithMedium(alpha, heights=kind).walk(cosine, PATHS, np.random.default_rng(4))
    assert min(check.p_value for check in first_order(walk, cosine, alpha)) > 1e-4
    assert max(check.p_value for check in first_order(walk, cosine, 1.1 * alpha)) < 1e-4


@each_kind
@pytest.mark.parametrize("flakes", ["mirror", "diffuse"])
def test_traced_paths_are_those_of_the_walk(kind, flakes):
    medium = SmithMedium(1.0, flakes, kind)
    walk = medium.walk(0.3, 200, np.random.default_rng(5), most=64)
    paths = medium.trace(0.3, 200, np.random.default_rng(5))
    assert np.array_equal(walk.orders, paths.orders) and walk.inside == 0
    for positions, order, direction in zip(paths.positions, paths.orders, walk.directions, strict=True):
        assert np.isnan(positions[order + 2 :]).all() and not np.isnan(positions[: order + 2]).any()
        assert (positions[[0, order + 1], 2] >= HEIGHTS[kind].top - 1e-12).all()
        assert np.array_equal(positions[1, :2], [0, 0])
        last = positions[order + 1] - positions[order]
        if np.linalg.norm(last) > 1e-9:
            assert np.allclose(last / np.linalg.norm(last), direction, atol=1e-6)


def test_level_light_collides_where_it_is():
    medium = SmithMedium(0.5)
    start = np.array([-1.0, 0.0, 2.0])
    assert np.allclose(medium._next_heights(start, np.zeros(3), np.random.default_rng(6)), start, atol=1e-12)


def test_a_path_cut_off_is_counted():
    cut = SmithMedium(0.7).walk(0.5, PATHS, np.random.default_rng(7), most=1)
    assert compare.share("left", 0.589901, PATHS - cut.inside, PATHS).p_value > 1e-4
    assert set(cut.orders) == {0, 1}


def test_impossible_arguments():
    with pytest.raises(ValueError, match=r"^heights are gaussian, uniform, logistic, exponential, not 'fractal'$"):
        SmithMedium(0.5, heights="fractal")
    with pytest.raises(ValueError, match=r"^flakes are"):
        SmithMedium(0.5, "glass")
    with pytest.raises(ValueError, match=r"^the roughness must be"):
        SmithMedium(0.0)
    with pytest.raises(ValueError, match=r"^the cosine of a direction above the medium"):
        SmithMedium(0.5).walk(0.0, 10, np.random.default_rng(1))
