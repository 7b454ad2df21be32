"""The kernels that Numba compiles, against those of NumPy and against the references."""

import importlib
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from mpmath import mp, mpf

import xsec_sym
from tests.kernels import gaussian
from xsec_sym import kernels
from xsec_sym.kernels import _compiled_polynomials as polynomials
from xsec_sym.kernels import _spherical_gaussian_compiled as loops
from xsec_sym.kernels import _spherical_gaussian_regions as regions
from xsec_sym.kernels import compiled

EPS = np.finfo(float).eps
FORMS = [
    (compiled.sigma_spherical_gaussian, kernels.sigma_spherical_gaussian, gaussian.sigma, 1e-300),
    (compiled.log_sigma_spherical_gaussian, kernels.log_sigma_spherical_gaussian, gaussian.log_sigma, 0.0),
    (compiled.scaled_sigma_spherical_gaussian, kernels.scaled_sigma_spherical_gaussian, gaussian.scaled_sigma, 0.0),
]
named = pytest.mark.parametrize(
    ("kernel", "slow", "reference", "least"), FORMS, ids=lambda part: getattr(part, "__name__", "")
)


def fresh(code, **environment):
    """What a new process prints."""
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, env={**os.environ, **environment}, timeout=300
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


@named
def test_as_without_numba(kernel, slow, reference, least):
    u, alpha = gaussian.points(np.random.default_rng(21), 40_000)
    values, expected = kernel(u, alpha), slow(u, alpha)
    chosen = np.abs(expected) > least
    assert chosen.sum() > 150_000
    assert (np.abs(values - expected)[chosen] <= 4 * np.spacing(np.abs(expected[chosen]))).all()
    assert (values[~chosen] >= 0).all() and (values[~chosen] <= least).all()


@named
def test_accuracy(kernel, slow, reference, least):
    u, alpha = gaussian.points(np.random.default_rng(22), 40)
    error, where = gaussian.worst(kernel(u, alpha), reference, u, alpha, least)
    assert error < 8 * EPS, where


@named
def test_cells_are_those_of_the_tables(kernel, slow, reference, least):
    """On both sides of every edge."""
    _, _, layer, rim, edge = regions.PRECISE.grid.parts
    step = 1 + np.linspace(-1e-12, 1e-12, 5)
    kappas = [*np.sqrt(regions.tables.EVEN_Y[1:]), *regions.tables.ROUND_Y, *(2 / np.array(layer.y)), 30.0]
    cosines = [*regions.tables.ROUND_X[1:-1], regions.tables.LIT, 0.3, *np.sqrt(1 - (1 / np.array(layer.x) - 0.2) ** 2)]
    u, alpha = (part.ravel() for part in np.meshgrid(np.outer(cosines, step), np.sqrt(2 / np.outer(kappas, step))))
    ks = np.outer([*rim.x, regions.RIM, *(1 / np.array(edge.x))], step).ravel()
    u, alpha = np.append(u, np.sqrt(1 - (ks / 40) ** 2)), np.append(alpha, np.full(ks.size, np.sqrt(2 / 40)))
    for side in (-u, u):
        expected = slow(side, alpha)
        assert (np.abs(kernel(side, alpha) - expected) <= 4 * np.spacing(np.abs(expected))).all()


@named
def test_outside_and_at_the_ends(kernel, slow, reference, least):
    u = np.array([-1.0, -0.3, -1e-8, -1e-300, 0.0, 1e-300, 0.3, 1.0, 1.0000000000000002, -2, np.nan, np.inf])
    alpha = np.array([0, 5e-324, 1e-300, 1e-141, 1e-139, 1e-30, 1e3, 1e160, np.inf, np.nan, -0.5, -1e-300])
    values, expected = kernel(u[:, None], alpha), slow(u[:, None], alpha)
    assert values.shape == (12, 12)
    assert np.array_equal(np.isnan(values), np.isnan(expected))
    assert np.allclose(values, expected, rtol=4 * EPS, atol=0, equal_nan=True)


@named
def test_arguments(kernel, slow, reference, least):
    assert kernel(0.5, 0.5) == kernel(np.array([0.5]), 0.5)[0] and type(kernel(0.5, 0.5)) is np.float64
    assert type(kernel(np.float32(0.5), 0.5)) is np.float32
    assert kernel(np.empty((3, 0)), 0.5).shape == (3, 0)
    with pytest.raises(TypeError, match="u must hold real numbers"):
        kernel(1j, 0.5)
    with pytest.raises(ValueError, match="do not broadcast: u \\(2,\\), alpha \\(3,\\)"):
        kernel(np.zeros(2), np.zeros(3))
    with pytest.raises(ValueError, match="threads must be at least 1, not 0"):
        kernel(0.5, 0.5, threads=0)


@named
def test_a_value_depends_on_its_arguments_alone(kernel, slow, reference, least):
    """Not on the threads, the layout, the length of the array, or the neighbours."""
    u, alpha = gaussian.points(np.random.default_rng(23), 100_000)
    before = u.copy(), alpha.copy()
    whole = kernel(u, alpha)
    for threads in (2, 3):
        assert np.array_equal(kernel(u, alpha, threads=threads), whole)
    assert np.array_equal(kernel(u[::-2], alpha[::-2]), whole[::-2])
    for part in (slice(5, 6), slice(100, 117), slice(70_000, 71_000)):
        assert np.array_equal(kernel(u[part], alpha[part]), whole[part])
    assert np.array_equal(u, before[0]) and np.array_equal(alpha, before[1])


def test_float32():
    u, alpha = (part.astype(np.float32) for part in gaussian.points(np.random.default_rng(24), 40))
    values = compiled.sigma_spherical_gaussian(u, alpha)
    assert values.dtype == np.float32
    for value, *point in zip(values, u, alpha, strict=True):
        exact = gaussian.sigma(*point)
        if exact > 1e-36:
            assert abs(mpf(float(value)) - exact) < 1.5 * np.spacing(np.float32(float(exact))), point


def test_exponential():
    x = np.concatenate([-(10 ** np.random.default_rng(25).uniform(-20, 2.85, 250)), [0.0, -745.0, -746.0, -np.inf]])
    value = np.empty(x.size)
    polynomials.exp(x, x.size, np.empty((2, x.size)), value)
    with mp.workdps(30):
        for one, found in zip(x[:250], value, strict=False):
            assert abs(mp.exp(mpf(float(one))) - mpf(float(found))) <= np.spacing(found), one
    assert value[250:].tolist() == [1.0, 5e-324, 0.0, 0.0]


def test_a_single_compilation_for_all_layouts_and_types():
    u = np.linspace(-1, 1, 64)
    for one in (0.5, u, u[::2], u.astype(np.float32), u[:, None], np.frombuffer(b"\0" * 17, np.uint8)[1:].view(float)):
        compiled.sigma_spherical_gaussian(one, 0.5)
    assert len(loops.fill.signatures) == 1


def test_kernels_do_without_numba():
    assert fresh("import sys, xsec_sym.kernels; print('numba' in sys.modules)") == "False"


def test_missing_numba_is_said():
    code = """
import sys
sys.modules["numba"] = None
try:
    from xsec_sym.kernels import compiled
except ImportError as error:
    print(error)
"""
    assert fresh(code) == "xsec_sym.kernels.compiled needs Numba: pip install numba"


def test_without_a_folder_for_the_cache(monkeypatch):
    def refuse(*arguments, **options):
        if options.get("cache"):
            raise RuntimeError("cannot cache function: no locator available")
        return lambda function: ("compiled", function)

    monkeypatch.setattr(polynomials, "jit", lambda function: ("not kept", function))
    monkeypatch.setattr(polynomials.numba, "njit", refuse)
    assert polynomials.kept(len) == ("not kept", len)


def test_the_cache_is_used():
    code = """
from xsec_sym.kernels import _spherical_gaussian_compiled as loops, compiled
compiled.sigma_spherical_gaussian(0.5, 0.5)
print(sum(loops.fill.stats.cache_hits.values()))
"""
    compiled.sigma_spherical_gaussian(0.5, 0.5)
    assert fresh(code, PYTHONPATH=str(Path(xsec_sym.__file__).parents[1])) == "1"


def test_a_cache_of_other_sources_is_renewed(tmp_path, monkeypatch):
    """Numba looks at the file of the function alone, while edges of cells and the like are compiled in."""
    monkeypatch.syspath_prepend(str(tmp_path))
    (tmp_path / "told.py").write_text(
        "from edges import STAMP\nfrom xsec_sym.kernels._compiled_polynomials import kept\n"
        "@kept\ndef told(value):\n    value[0] = STAMP\n    return STAMP\n"
    )
    value = np.zeros(1)
    for number, cached in ((1, 1), (22, 1), (22, 22)):
        (tmp_path / "edges.py").write_text(f"STAMP = {number}\n")
        for name in ("edges", "told"):
            sys.modules.pop(name, None)
        importlib.invalidate_caches()
        told = importlib.import_module("told").told
        assert told(value) == cached
        polynomials.renew(told, number, value)
        assert told(value) == number == value[0]
    for name in ("edges", "told"):
        sys.modules.pop(name)
