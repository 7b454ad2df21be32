import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

import xsec_sym
from tests.kernels import oracle
from xsec_sym import kernels
from xsec_sym.export import assemble, floats, measure
from xsec_sym.export.__main__ import errors_module
from xsec_sym.export.errors import LARGEST
from xsec_sym.export.recipes import GENERATED, RECIPES

ROOT = Path(xsec_sym.__file__).parent
ROWS = [r for r in RECIPES.values() if r.cell]
ULPS = 8
DENSITY = {
    "sigma_inv1p": lambda x: 1 / (1 + x),
    "sigma_inv1m": lambda x: 1 / (1 - x),
    "sigma_inv1m2": lambda x: 1 / (1 - x) ** 2,
    "sigma_inv1pu2": lambda x: 1 / (1 + x**2),
}
FINITE = {"sigma_inv1p": 0.4, "sigma_inv1m": -0.4, "sigma_inv1m2": -0.4, "sigma_inv1pu2": 0.4}

each_row = pytest.mark.parametrize("recipe", ROWS, ids=lambda r: r.name)


@pytest.mark.parametrize("name", GENERATED)
def test_generated_files_are_what_is_generated(name):
    assert (ROOT / "kernels" / f"{name}.py").read_text() == assemble.kernel_module(name, assemble.recorded(), LARGEST)
    assert (ROOT / "export" / "errors.py").read_text() == errors_module(dict(LARGEST))


def test_generated_files_are_formatted(tmp_path):
    ruff = pytest.importorskip("ruff")
    (tmp_path / "a.py").write_text(assemble.module([*RECIPES, "deon2016:12", "deon2016:T1.inv1m2.s2"]))
    (tmp_path / "b.py").write_text(assemble.module(["deon2016:11"], "float32"))
    done = subprocess.run(
        [sys.executable, "-m", ruff.__name__, "format", "--check", "--isolated", "--line-length", "120", str(tmp_path)],
        capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout


@each_row
def test_stated_errors_hold(recipe):
    """Anew, at other points; NumPy's own functions may be another bit off elsewhere."""
    parts = assemble._branches(assemble.recorded()[recipe.cell], assemble.recorded())
    found = measure.largest(getattr(kernels, recipe.name), parts, 120)
    assert found[0] <= min(LARGEST[recipe.name][0] + 1, ULPS) and found[1] <= LARGEST[recipe.name][1] + 0.1


@each_row
def test_forms_agree_with_the_definition(recipe):
    record = assemble.recorded()
    parts = assemble._branches(record[recipe.cell], record)
    branch = next(b for b in parts if not b.is_constant)
    entry = record[branch.label]
    assert measure.disagreement(entry, branch, [FINITE[recipe.name], np.sign(FINITE[recipe.name])]) < 1e-15


@each_row
def test_kernels_agree_with_the_integral_over_rings(recipe):
    with mp.workdps(20):
        for u in (FINITE[recipe.name], 1.7 * FINITE[recipe.name]):
            reference = oracle.cross_section_over_rings(DENSITY[recipe.name], u)
            assert oracle.ulps(getattr(kernels, recipe.name)(u), reference) <= ULPS


def test_infinite_sides():
    assert np.all(np.isinf(kernels.sigma_inv1p([-1, -1e-300, -5e-324]))) and kernels.sigma_inv1p(-0.0) == 2 * np.pi
    assert np.all(np.isinf(kernels.sigma_inv1m([1, 1e-300, 5e-324]))) and kernels.sigma_inv1m(0) == 2 * np.pi
    assert np.all(np.isposinf(kernels.sigma_inv1m2([1, 1e-300, 0.0, -0.0, -5e-324, -1e-308])))
    assert np.isclose(kernels.sigma_inv1m2(-1e-300), np.pi * 1e300, rtol=1e-15)
    assert np.isposinf(kernels.sigma_inv1m2(np.float32(-1e-39)))


@pytest.mark.parametrize("u", [1.0000000000000002, -1.0000000000000002, 2, -1e300, np.inf, -np.inf, np.nan])
@each_row
def test_outside(recipe, u):
    assert np.isnan(getattr(kernels, recipe.name)(u))


@given(st.floats(-1, 1))
def test_symmetries(u):
    assert kernels.sigma_inv1p(u) == kernels.sigma_inv1m(-u)
    assert kernels.sigma_inv1pu2(u) == kernels.sigma_inv1pu2(-u)


@given(st.floats(-1, 0, exclude_max=True))
def test_order(u):
    """1/(1 - x) < 1/(1 - x)^2 nowhere on all of the sphere, but 1/(1 + x^2) lies between 1/2 and 1."""
    assert np.pi / 2 <= kernels.sigma_inv1pu2(u) * (1 + 1e-15) and kernels.sigma_inv1pu2(u) <= np.pi
    assert 0 < kernels.sigma_inv1m(u) <= 2 * np.pi


@each_row
def test_shapes_and_types(recipe):
    kernel = getattr(kernels, recipe.name)
    table = np.linspace(-1, 1, 12).reshape(3, 4)
    assert kernel(table).shape == (3, 4) and kernel([]).shape == (0,) and np.ndim(kernel(0.5)) == 0
    assert kernel(table.astype(np.float32)).dtype == np.float32 and kernel(1).dtype == np.float64
    assert np.array_equal(kernel(table.T), kernel(table).T)
    many = np.linspace(-1, 1, 40001)
    assert np.array_equal(kernel(many)[::1000], kernel(many[::1000]))
    with pytest.raises(TypeError):
        kernel(1j)


def test_references_are_exact_to_the_last_digits():
    parts = assemble._branches(assemble.recorded()["deon2016:T1.inv1m2.s"], assemble.recorded())
    branch = next(b for b in parts if not b.is_constant)
    with mp.workdps(60):
        u = mpf(-0.3)
        direct = -mp.pi * (2 + 1 / u + 2 * u * mp.log(1 - 1 / u))
        assert abs(floats.exact(branch.form, branch.domain.symbols, (-0.3,)) / direct - 1) < mpf(10) ** -25
