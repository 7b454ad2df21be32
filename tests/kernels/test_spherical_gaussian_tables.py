"""The generator of the tables, on a part of them."""

from pathlib import Path

import numpy as np
import pytest
from flint import arb
from mpmath import mp, mpf

from tests.kernels import gaussian
from xsec_sym.export import spherical_gaussian as generator
from xsec_sym.export import spherical_gaussian_functions as functions
from xsec_sym.kernels import _spherical_gaussian_tables as tables
from xsec_sym.kernels._patches import Joined, Patches
from xsec_sym.proof.ball_compile import precision

# One cell of each region, and the one of the rim whose kappa reaches infinity.
PART = [("EVEN", 1), ("ROUND", 6), ("LAYER", 1), ("RIM", 0), ("EDGE", 0)]


@pytest.mark.parametrize(("name", "i"), PART)
def test_a_part_is_what_the_generator_writes(name, i):
    region = generator.REGIONS[name]
    assert (getattr(tables, f"{name}_X"), getattr(tables, f"{name}_Y")) == (region.x, region.y)
    for prefix, table in generator.tables(region, region.cells()[i]).items():
        assert getattr(tables, prefix + name)[i] == table


def test_the_lines_are_what_the_generator_writes():
    for name, row in generator.lines().items():
        assert getattr(tables, name) == [row]
    for name in ("LIT", "SHIFT", "HALF"):
        assert getattr(tables, name) == getattr(generator, name)
    assert "do not edit" in Path(tables.__file__).read_text()


@pytest.mark.parametrize("name", generator.REGIONS)
def test_tables_are_as_accurate_as_allowed(name):
    """At other points than those they are made from, in every cell."""
    region = generator.REGIONS[name]
    for prefix, allowed in generator.ALLOWED.items():
        found = getattr(tables, prefix + name)
        assert len(found) == len(region.cells())
        for cell, table in zip(region.cells(), found, strict=True):
            assert generator.error(region, cell, table, 3, 77) < allowed, cell


def test_the_integral_is_the_definition():
    rng = np.random.default_rng(5)
    u, alpha = gaussian.points(rng, 6)
    with precision(generator.BITS), mp.workdps(40):
        for v, rough in zip(np.abs(u), alpha, strict=True):
            ball = arb(float(v))
            kappa, s = 2 / arb(float(rough)) ** 2, ((1 - ball) * (1 + ball)).sqrt() if v < 1 else arb(0)
            value = generator.number(functions.scaled(ball, s, kappa))
            assert abs(value / gaussian.scaled_sigma(-v, rough) - 1) < mpf("1e-22"), (v, rough)


def test_too_wide_a_ball_is_refused():
    with pytest.raises(ArithmeticError, match="is too wide"):
        generator.number(arb(1, 1e-3))


def test_a_patch_is_its_polynomial_for_one_point_few_and_many():
    cells = [[[1.0, 2.0, 3.0], [4.0]], [[5.0]], [[0.5, 1.0], [2.0, 0.0]], [[1.0, 0.0, 0.0], [0.0]]]
    patches = Patches([0.0, 1.0, 2.0], [0.0, 1.0, 3.0], cells)
    x, y = np.array([0.25, 1.5, 0.5, 1.25, 0.0]), np.array([0.5, 0.0, 3.0, 2.0, 1.0])
    number = patches.cell(x, y)
    assert number.tolist() == [0, 1, 2, 3, 0]
    assert [patches.cell_of_one(*point) for point in zip(x.tolist(), y.tolist(), strict=True)] == number.tolist()
    exact = [1 - 1 + 0.75 + 0.0, 5.0, 0.5 + 2.0, 1.0, 1 - 2 + 3 + 4.0]
    joined = Joined([patches, Patches([0.0, 1.0], [0.0, 1.0], [[[7.0, 0.0, 0.0, 0.0], [0.0], [0.0]]])])
    assert joined(x, y, number.astype(np.intp)).tolist() == exact
    assert joined(x, y, np.full(5, 4)).tolist() == [7.0] * 5
    for i, value in enumerate(exact):
        one = slice(i, i + 1)
        assert patches(x[one], y[one], int(number[i])).item() == value
        assert patches(x[one].repeat(9), y[one].repeat(9), int(number[i])).tolist() == [value] * 9
