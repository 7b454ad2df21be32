import subprocess
import sys

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.stats import ks_2samp, kstest

from xsec_sym.walks import (
    HEIGHTS,
    Emerged,
    HomogeneousMedium,
    SmithMedium,
    TwoSidedMedium,
    compare,
    heights,
    same_directions,
    same_orders,
)
from xsec_sym.walks import __main__ as command

PATHS = 100_000
TESTS = (same_directions, same_orders)


def p_values(one, other):
    return [test(one, other).p_value for test in TESTS]


@pytest.mark.parametrize(
    ("flakes", "kind", "alpha", "cosine"),
    [
        ("mirror", "gaussian", 0.5, 0.6),
        ("mirror", "uniform", 2.0, 0.05),
        ("mirror", "logistic", 0.2, 1.0),
        ("diffuse", "gaussian", 1.0, 0.3),
        ("diffuse", "exponential", 3.0, 0.8),
    ],
)
def test_both_media_scatter_alike(flakes, kind, alpha, cosine):
    one = HomogeneousMedium(alpha, flakes).walk(cosine, PATHS, np.random.default_rng(1))
    other = SmithMedium(alpha, flakes, kind).walk(cosine, PATHS, np.random.default_rng(2))
    assert min(p_values(one, other)) > 1e-4


@pytest.mark.parametrize("flakes", ["mirror", "diffuse"])
def test_two_sided_flakes_are_rejected(flakes):
    smith = SmithMedium(0.7, flakes).walk(0.5, PATHS, np.random.default_rng(3))
    wrong = TwoSidedMedium(0.7, flakes).walk(0.5, PATHS, np.random.default_rng(4))
    assert max(p_values(wrong, smith)) < 1e-20


def test_a_roughness_ten_per_cent_off_is_rejected():
    one = HomogeneousMedium(0.7 * 1.1).walk(0.5, PATHS, np.random.default_rng(5))
    other = SmithMedium(0.7).walk(0.5, PATHS, np.random.default_rng(6))
    assert max(p_values(one, other)) < 1e-6


def test_a_lambda_of_the_way_back_is_rejected(monkeypatch):
    """1 + Lambda(omega) is -Lambda(-omega): upward light would meet flakes as downward light does."""
    one = HomogeneousMedium(0.7).walk(0.5, PATHS, np.random.default_rng(7))
    right = heights.lambda_ggx
    monkeypatch.setattr(heights, "lambda_ggx", lambda u, alpha: 1 + right(u, alpha))
    wrong = SmithMedium(0.7).walk(0.5, PATHS, np.random.default_rng(8))
    assert max(p_values(one, wrong)) < 1e-20


def test_depths_are_logarithms_of_heights():
    """dupuy2016 (13): the first collisions of both walks, in one scale."""
    depths = HomogeneousMedium(0.8).first_hits(0.4, PATHS, np.random.default_rng(9))
    for kind, distribution in HEIGHTS.items():
        found = distribution.log_cdf(SmithMedium(0.8, heights=kind).first_hits(0.4, PATHS, np.random.default_rng(10)))
        assert ks_2samp(depths, found).pvalue > 1e-4
        assert ks_2samp(1.05 * depths, found).pvalue < 1e-4


@pytest.mark.parametrize("rise", [-1.0, -0.7, -0.05, 0.05, 0.4, 0.8])
@pytest.mark.parametrize("flakes", ["mirror", "diffuse"])
def test_the_two_ways_to_scatter_agree(rise, flakes):
    """From below the horizon too: the phase function (dupuy2016:5) by two samplers of visible normals."""
    turn, across = 0.7, np.sqrt(1 - rise**2)
    toward = np.array([across * np.cos(turn), across * np.sin(turn), rise])[:, None] + np.zeros(PATHS)
    one = HomogeneousMedium(0.6, flakes)._scattered(tuple(toward), np.random.default_rng(11))
    other = SmithMedium(0.6, flakes)._scattered(toward, np.random.default_rng(12))
    walks = [Emerged(np.stack(tuple(found), axis=1), np.ones(PATHS, int)) for found in (one, other)]
    assert same_directions(*walks).p_value > 1e-4
    wrong = SmithMedium(0.66, flakes)._scattered(toward, np.random.default_rng(13))
    # a diffuse flake hides its normal
    if rise < 0 and flakes == "mirror":
        assert same_directions(walks[0], Emerged(wrong.T, np.ones(PATHS, int))).p_value < 1e-4


def test_p_values_of_equal_walks_are_uniform():
    """Chi-squared is what it should be: among 150 pairs of walks of one medium, no p-value is preferred."""
    medium, rng = HomogeneousMedium(0.7), np.random.default_rng(14)
    found = np.array([p_values(medium.walk(0.5, 8000, rng), medium.walk(0.5, 8000, rng)) for _ in range(150)])
    for column, test in zip(found.T, TESTS, strict=True):
        assert kstest(column, "uniform").pvalue > 1e-3, test.__name__


def test_samples_of_unequal_size():
    medium = HomogeneousMedium(0.7)
    small = medium.walk(0.5, 10_000, np.random.default_rng(15))
    large = medium.walk(0.5, PATHS, np.random.default_rng(16))
    assert min(p_values(small, large)) > 1e-4
    assert max(p_values(small, HomogeneousMedium(1.0).walk(0.5, PATHS, np.random.default_rng(17)))) < 1e-6


def test_rare_cells_are_joined():
    expected, counts = np.array([100.0, 3.0, 30.0, 4.0]), np.array([90.0, 1.0, 40.0, 6.0])
    joined = compare._joined(expected, counts, expected)
    assert [part.tolist() for part in joined] == [[90, 47], [100, 37]]
    assert compare._joined(np.array([30.0, 40.0]), counts[:2])[0].tolist() == [90, 1]


def test_command():
    result = CliRunner().invoke(command.main, ["--paths", "50000"])
    assert result.exit_code == 0, result.output
    assert "20 tests at the level 0.0001/20, 8 controls: all as they should be (50,000 paths a walk" in result.output


def test_command_fails_where_a_test_does(monkeypatch):
    monkeypatch.setattr(command, "SmithMedium", lambda alpha, flakes, kind: SmithMedium(1.3 * alpha, flakes, kind))
    result = CliRunner().invoke(command.main, ["--paths", "50000"])
    assert result.exit_code == 1
    assert "FAILS" in result.output


def test_command_fails_where_a_control_is_not_rejected(monkeypatch):
    monkeypatch.setattr(command, "TwoSidedMedium", HomogeneousMedium)
    result = CliRunner().invoke(command.main, ["--paths", "50000"])
    assert result.exit_code == 1
    assert "there are too few paths" in result.output


def test_import_brings_no_symbolic_library():
    code = "import sys, xsec_sym.walks; print([m for m in ('sympy', 'mpmath', 'scipy.stats') if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "[]"
