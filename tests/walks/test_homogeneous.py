import numpy as np
import pytest

from xsec_sym.kernels import sigma_ggx
from xsec_sym.walks import HomogeneousMedium, TwoSidedMedium, compare, first_order, visibility

PATHS = 50_000
PLACES = [(0.1, 0.3, 0.05), (0.5, 0.6, 0.3), (1.0, 0.1, 0.95), (4.0, 0.9, 0.5)]


@pytest.mark.parametrize(("alpha", "cosine_i", "cosine_o"), PLACES)
def test_visibility(alpha, cosine_i, cosine_o):
    checks = visibility(HomogeneousMedium(alpha), cosine_i, cosine_o, PATHS, np.random.default_rng(1))
    assert min(check.p_value for check in checks) > 1e-4


def test_visibility_rejects_two_sided_flakes():
    checks = visibility(TwoSidedMedium(0.5), 0.6, 0.3, PATHS, np.random.default_rng(2))
    assert max(check.p_value for check in checks) < 1e-20


@pytest.mark.parametrize(("alpha", "cosine"), [(0.4, 1.0), (0.5, 0.6), (1.0, 0.1), (2.0, 0.7)])
def test_light_of_the_first_order(alpha, cosine):
    walk = HomogeneousMedium(alpha).walk(cosine, PATHS, np.random.default_rng(3))
    assert min(check.p_value for check in first_order(walk, cosine, alpha)) > 1e-4
    assert max(check.p_value for check in first_order(walk, cosine, 1.1 * alpha)) < 1e-4


@pytest.mark.parametrize("flakes", ["mirror", "diffuse"])
def test_all_light_leaves(flakes):
    walk = HomogeneousMedium(1.5, flakes).walk(0.2, PATHS, np.random.default_rng(4))
    assert walk.inside == 0 and walk.orders.min() == 1
    assert np.abs(np.linalg.norm(walk.directions, axis=1) - 1).max() < 1e-14
    assert walk.directions[:, 2].min() > 0


def test_a_path_cut_off_is_counted():
    """With one collision allowed, what has not left after it is inside."""
    cut = HomogeneousMedium(0.7).walk(0.5, PATHS, np.random.default_rng(5), most=1)
    whole = HomogeneousMedium(0.7).walk(0.5, PATHS, np.random.default_rng(6))
    left = compare.share("left", 0.589901, int((cut.orders == 1).sum()), PATHS)
    assert left.p_value > 1e-4
    assert cut.inside == PATHS - (cut.orders == 1).sum() > 0
    assert np.isnan(cut.directions[cut.orders == 0]).all()
    assert compare.same_orders(cut, whole).p_value < 1e-20
    assert compare.same_directions(cut, whole).p_value < 1e-20


def test_progress_is_told():
    told = []
    HomogeneousMedium(0.5).walk(0.5, 70_000, np.random.default_rng(7), told=told.append)
    assert sum(told) == 70_000 and len(told) == 2


@pytest.mark.parametrize("flakes", ["mirror", "diffuse"])
def test_traced_paths_are_those_of_the_walk(flakes):
    medium = HomogeneousMedium(1.0, flakes)
    walk = medium.walk(0.3, 200, np.random.default_rng(8), most=64)
    paths = medium.trace(0.3, 200, np.random.default_rng(8))
    assert np.array_equal(walk.orders, paths.orders)
    assert paths.positions.shape == (200, paths.orders.max() + 2, 3)
    for positions, order, direction in zip(paths.positions, paths.orders, walk.directions, strict=True):
        assert np.isnan(positions[order + 2 :]).all() and not np.isnan(positions[: order + 2]).any()
        assert np.array_equal(positions[0], [0, 0, 0]) and abs(positions[order + 1, 2]) < 1e-12
        assert (positions[1 : order + 1, 2] < 0).all()
        last = positions[order + 1] - positions[order]
        assert np.allclose(last / np.linalg.norm(last), direction, atol=1e-9)
        first = positions[1] / np.linalg.norm(positions[1])
        assert np.allclose(first, [-np.sqrt(1 - 0.09), 0, -0.3], atol=1e-12)


def test_a_traced_path_that_is_cut_off_ends_inside():
    paths = HomogeneousMedium(1.0, "diffuse").trace(0.3, 500, np.random.default_rng(9), most=2)
    inside = paths.positions[paths.orders == 0]
    assert len(inside) and (inside[:, 1:3, 2] < 0).all() and np.isnan(inside[:, 3:]).all()


def test_rates():
    rise = np.linspace(-1, 1, 9)
    assert np.array_equal(HomogeneousMedium(0.5).rate(rise), sigma_ggx(-rise, 0.5))
    two = TwoSidedMedium(0.5).rate(rise)
    assert np.array_equal(two, two[::-1])


@pytest.mark.parametrize("alpha", [0.0, -1.0, np.inf, np.nan])
def test_impossible_roughness(alpha):
    with pytest.raises(ValueError, match=r"^the roughness must be a positive number, not"):
        HomogeneousMedium(alpha)


def test_impossible_arguments():
    with pytest.raises(ValueError, match=r"^flakes are mirror or diffuse, not 'glass'$"):
        HomogeneousMedium(0.5, "glass")
    for cosine in (0.0, -0.5, 1.1, np.nan):
        with pytest.raises(ValueError, match=r"^the cosine of a direction above the medium"):
            HomogeneousMedium(0.5).walk(cosine, 10, np.random.default_rng(1))
