"""Half-spaces and their phase function: every method is as right as it should be, and wrong where it is known to be."""

import json
from importlib.resources import files
from itertools import pairwise

import numpy as np
import pytest
from mpmath import mp, mpf

from xsec_sym.kernels import (
    HalfSpace,
    albedo_lambert_sphere,
    albedo_lambert_sphere_inverse,
    brdf_lambert_sphere,
    h_lambert_sphere,
    lambert_sphere_coefficients,
)
from xsec_sym.study.errors import summary, values
from xsec_sym.study.method import HOMES, along, registered
from xsec_sym.study.methods import half_spaces
from xsec_sym.study.points import right
from xsec_sym.study.references import chandrasekhar, half_space, sphere, three_terms

NAMES = (
    "h_isotropic",
    "brdf_isotropic",
    "h_lambert_sphere",
    "phase_lambert_sphere",
    "sample_lambert_sphere",
    "brdf_lambert_sphere",
    "albedo_lambert_sphere",
    "albedo_lambert_sphere_inverse",
)
COSINES = (0.03, 0.2, 0.4, 0.7, 0.95)
PLAIN = {
    "h_isotropic": [(mu, c) for mu in COSINES for c in (0.3, 0.95)],
    "brdf_isotropic": [(a, b, c) for a in COSINES[1:4] for b in COSINES[::2] for c in (0.3, 0.95)],
    "h_lambert_sphere": [(mu, c, mode) for mu in COSINES[1:4] for c in (0.3, 0.95) for mode in (0, 1, 2)],
    "phase_lambert_sphere": [(mu,) for mu in (-0.95, -0.5, 0.1, 0.4, 0.7)],
    "sample_lambert_sphere": [(xi,) for xi in (0.02, 0.3, 0.6, 0.95)],
    "brdf_lambert_sphere": [
        (a, b, phi, 0.75) for a in COSINES[1:4] for b in COSINES[1::2] for phi in (0.0, 1.5, np.pi)
    ],
    "albedo_lambert_sphere": [(c,) for c in (0.3, 0.6, 0.9, 0.99)],
    "albedo_lambert_sphere_inverse": [(k_d,) for k_d in (0.1, 0.3, 0.6, 0.9)],
}
# Bounds on the largest relative error at the plain points for the ends of each curve: it lies between them.
H_RULES = {
    "Fock, trapezoidal in log t": [(1e-4, 1e-3), (0, 1e-14)],
    "Fock, compiled": [(1e-9, 1e-6)],
    "Fock, Gauss-Legendre": [(1e-5, 5e-3), (0, 1e-10)],
    "nonlinear equation": [(1e-4, 5e-3), (0, 1e-9)],
    "Chebyshev table for one albedo": [(1e-3, 2e-2), (1e-14, 1e-9)],
    "scipy.integrate.quad": [(0, 1e-9)],
    "mpmath.quad": [(0, 1e-13), (0, 5e-16)],
}
ISOTROPIC = H_RULES | {
    "kernel": [(0, 1e-15)],
    "Hapke": [(5e-3, 8e-2)],
    "Hapke, improved": [(5e-4, 2e-2)],
    "Hapke, compiled": [(5e-3, 8e-2)],
    "Hapke, improved, compiled": [(5e-4, 2e-2)],
    "Chebyshev polynomial": [(1e-3, 2e-2), (1e-11, 1e-7)],
    "linear table": [(1e-4, 6e-3), (1e-7, 4e-5)],
}
BOUNDS = {
    "h_isotropic": ISOTROPIC,
    "brdf_isotropic": ISOTROPIC
    | {
        "Fock, trapezoidal in log t": [(1e-6, 1e-4), (1e-12, 1e-9)],
        "nonlinear equation": [(1e-6, 2e-3), (0, 1e-6)],
        "Fock, Gauss-Legendre": [(1e-8, 1e-3), (0, 1e-10)],
        "Chebyshev table for one albedo": [(1e-7, 1e-4), (0, 1e-9)],
        "mpmath.quad": [(0, 1e-13)],
    },
    "h_lambert_sphere": H_RULES
    | {
        "kernel": [(0, 1e-15)],
        "fit": [(1e-6, 4e-5)],
        "paper's fits, mended": [(1e-3, 3e-2)],
        "paper's fits, printed": [(5e-2, 0.3)],
        "paper's fits, mended, compiled": [(1e-3, 3e-2)],
        "Hapke's form": [(5e-3, 6e-2)],
    },
    "phase_lambert_sphere": {
        "kernel": [(0, 1e-15)],
        "closed form": [(0, 1e-14)],
        "closed form, compiled": [(0, 1e-14)],
        "closed form in the angle": [(0, 1e-14)],
        "Legendre series": [(1e-2, 1), (1e-7, 1e-4)],
        "linear table": [(1e-5, 1e-2), (1e-10, 1e-6)],
        "Gauss-Legendre": [(1e-2, 0.5), (0, 1e-13)],
        "scipy.integrate.quad": [(0, 1e-13)],
        "mpmath.quad": [(0, 1e-12), (0, 2e-16)],
    },
    "sample_lambert_sphere": {
        "kernel": [(0, 2e-15)],
        "paper's fit": [(1e-5, 5e-3)],
        "paper's fit, compiled": [(1e-5, 5e-3)],
        "Newton from the paper's fit": [(1e-10, 1e-4), (0, 1e-12)],
        "bisection": [(1e-5, 1e-2), (0, 1e-13)],
        "linear table": [(1e-5, 1e-1), (1e-10, 1e-5)],
        "quad and brentq": [(0, 1e-6)],
        "mpmath.findroot": [(0, 1e-13), (0, 2e-16)],
    },
    "brdf_lambert_sphere": {
        "kernel": [(0, 5e-12)],
        "HalfSpace": [(1e-5, 2e-3), (1e-12, 1e-7)],
        "HalfSpace, series throughout": [(1e-3, 0.5), (1e-5, 0.05)],
        "table for one albedo": [(1e-3, 0.2), (1e-5, 2e-2)],
        "fit": [(1e-5, 3e-3)],
        "fast fit": [(1e-3, 0.5)],
        "fast fit, compiled": [(1e-3, 0.5)],
        "paper's model, mended": [(1e-3, 0.1)],
        "paper's model, printed": [(0.2, 20)],
        "paper's fast model": [(1e-2, 1)],
        "Hapke": [(3e-2, 1)],
        "single scattering": [(0.1, 1)],
        "Lambert": [(0.1, 3)],
        "isotropic scatterers": [(0.1, 10)],
    },
    "albedo_lambert_sphere": {
        "kernel": [(0, 2e-12)],
        "fit": [(1e-6, 2e-4)],
        "paper's fit": [(1e-4, 2e-2)],
        "paper's fit, compiled": [(1e-4, 2e-2)],
        "similarity": [(1e-3, 0.1)],
        "isotropic scatterers": [(3e-2, 0.5)],
        "HalfSpace": [(1e-8, 1e-5), (0, 1e-10)],
        "doubling": [(0, 1e-9)],
        "Chebyshev polynomial": [(1e-3, 1), (0, 1e-11)],
        "linear table": [(1e-2, 0.2), (1e-7, 1e-2)],
    },
    "albedo_lambert_sphere_inverse": {
        "kernel": [(0, 2e-12)],
        "fit": [(1e-8, 6e-5)],
        "paper's fit": [(1e-4, 2e-2)],
        "paper's fit, compiled": [(1e-4, 2e-2)],
        "paper's other fit, inverted": [(1e-4, 2e-2)],
        "similarity, inverted": [(1e-3, 0.1)],
        "Newton's method": [(1e-9, 1e-2), (0, 1e-11)],
        "HalfSpace and brentq": [(1e-12, 1e-6), (0, 1e-9)],
        "Chebyshev polynomial": [(1e-4, 1), (0, 1e-9)],
        "linear table": [(1e-4, 0.1), (1e-9, 1e-4)],
    },
}


def errors(name, method, rows, parameters=None):
    quantity = registered(name).quantity
    points = right(quantity, "", tuple(np.array(rows, float).T))
    found = values(quantity, registered(name)[method], parameters or {}, points.columns, "float64")
    return summary(found, points, "float64")


@pytest.mark.parametrize("name", NAMES)
def test_registered(name):
    field = registered(name)
    assert name in HOMES and len(field.methods) >= 4
    assert {m.name for m in field.methods} == set(BOUNDS[name]) and field["kernel"].ours
    count = np.prod(field.quantity.shape) * np.prod(field.quantity.per_cell)
    assert 100 < count < 3000
    for draw in field.quantity.trouble.values():
        columns = draw(np.random.default_rng(3), 200)
        for argument, column in zip(field.quantity.arguments, columns, strict=True):
            assert column.shape == (200,)
            # c of a neighbourhood may be nearer to 1 or to 0 than cells are told apart
            assert np.all((column >= min(argument.low, 0)) & (column <= argument.high)), argument.name


@pytest.mark.parametrize(("name", "method"), [(n, m) for n in NAMES for m in BOUNDS[n]])
def test_method(name, method):
    chosen = registered(name)[method]
    if not chosen.available:
        pytest.skip(f"no {chosen.needs}")
    bounds, rows = BOUNDS[name][method], PLAIN[name]
    if chosen.kind == "arbitrary precision":
        rows = rows[1::6]
    ends = chosen.curve if len(chosen.curve) == 1 else (chosen.curve[0], chosen.curve[-1])
    assert len(ends) == len(bounds)
    for parameters, (low, high) in zip(ends, bounds, strict=True):
        found = errors(name, method, rows, parameters)
        assert not found.failures and low <= found.max_rel <= high, (parameters, found)


GRAZING = [(1e-3, 0.75), (1e-2, 1.0)]
SKIMMING = [(1e-3, 1e-3, np.pi, 0.75), (1e-4, 2e-4, np.pi, 1.0)]


@pytest.mark.parametrize(
    ("name", "method", "parameters", "rows", "low", "high"),
    [
        # a quadrature of a function that is mu log mu, or nearly a delta, with nodes where they happen to be
        ("h_isotropic", "Fock, Gauss-Legendre", {"n": 64}, GRAZING, 1e-6, 1e-4),
        ("h_isotropic", "nonlinear equation", {"n": 64}, GRAZING, 1e-7, 1e-4),
        ("h_isotropic", "Fock, trapezoidal in log t", {"n": 256}, [*GRAZING, (1e-12, 1.0), (1.0, 1.0)], 0, 1e-14),
        ("h_isotropic", "kernel", {}, [*GRAZING, (0.0, 1.0), (0.5, 1 - 2.0**-53)], 0, 1e-15),
        ("h_isotropic", "Hapke, improved", {}, [(0.5, 1.0)], 1e-3, 1e-2),
        ("h_lambert_sphere", "paper's fits, mended", {}, [(0.8, 1.0, 2)], 0.02, 0.03),
        ("h_lambert_sphere", "kernel", {}, [(0.8, 1.0, 2), (1e-9, 0.75, 1), (1.0, 1 - 2.0**-40, 0)], 0, 2e-15),
        # differences of nearly equal terms
        ("phase_lambert_sphere", "closed form", {}, [(1 - 2.0**-36,)], 1e-4, np.inf),
        ("phase_lambert_sphere", "closed form in the angle", {}, [(1 - 2.0**-36,)], 1e-8, np.inf),
        ("phase_lambert_sphere", "kernel", {}, [(1 - 2.0**-36,), (-1.0,), (1 - 2.0**-53,)], 0, 1e-15),
        # what is cut from the series is larger than p near 1
        ("phase_lambert_sphere", "Legendre series", {"n": 64}, [(0.9999,)], 1, np.inf),
        ("phase_lambert_sphere", "Legendre series", {"n": 2}, [(0.95,)], 0.5, 10),
        ("sample_lambert_sphere", "paper's fit", {}, [(5 / 6 + 1e-7,)], 100, np.inf),
        ("sample_lambert_sphere", "kernel", {}, [(5 / 6 + 1e-7,), (1 - 2.0**-50,), (1e-20,)], 0, 2e-15),
        ("sample_lambert_sphere", "bisection", {"n": 60}, [(1 - 2.0**-50,)], 1e-13, 1e-8),
        ("albedo_lambert_sphere", "paper's fit", {}, [(1e-6,)], 1e3, np.inf),
        ("albedo_lambert_sphere", "Chebyshev polynomial", {"n": 12}, [(1e-9,)], 1, np.inf),
        ("albedo_lambert_sphere", "linear table", {"n": 256}, [(1 - 1e-4,)], 1e-3, 0.1),
        ("albedo_lambert_sphere", "kernel", {}, [(1e-20,), (1.0,), (1 - 2.0**-53,)], 0, 2e-12),
        ("albedo_lambert_sphere_inverse", "paper's fit", {}, [(1e-4,)], 1e-2, 0.1),
        ("albedo_lambert_sphere_inverse", "kernel", {}, [(1e-20,), (1.0,), (1 - 2.0**-53,)], 0, 2e-12),
        # two thirds too high where both cosines are 0.001, forward, and more below
        ("brdf_lambert_sphere", "paper's model, mended", {}, SKIMMING[:1], 0.5, 1),
        ("brdf_lambert_sphere", "paper's model, mended", {}, SKIMMING[1:], 1, 100),
        ("brdf_lambert_sphere", "fit", {}, SKIMMING[:1], 1e-4, 0.02),
        ("brdf_lambert_sphere", "HalfSpace, series throughout", {"n": 2}, SKIMMING, 3, np.inf),
        ("brdf_lambert_sphere", "HalfSpace", {"n": 2}, SKIMMING, 5e-4, 5e-3),
        ("brdf_lambert_sphere", "single scattering", {}, [(0.5, 0.5, 2.0, 1.0)], 0.6, 1),
    ],
)
def test_where_methods_fail_and_where_not(name, method, parameters, rows, low, high):
    found = errors(name, method, rows, parameters)
    assert not found.failures and low <= found.max_rel <= high, found


def test_sources_are_entries_of_the_record():
    data = files("xsec_sym.record") / "data"
    for method in (m for name in NAMES for m in registered(name).methods):
        source, _, label = method.source.partition(":")
        if label:
            entries = json.loads((data / f"{source}.json").read_text(encoding="utf-8"))["entries"]
            assert method.source in {entry["id"] for entry in entries}, method.source


def test_curves_fall():
    """More nodes, terms or steps, smaller errors, at points that tables and rules do not know."""
    for name, method in (
        ("h_isotropic", "Fock, trapezoidal in log t"),
        ("h_isotropic", "Chebyshev polynomial"),
        ("h_lambert_sphere", "Chebyshev table for one albedo"),
        ("phase_lambert_sphere", "Legendre series"),
        ("sample_lambert_sphere", "bisection"),
    ):
        worst = [errors(name, method, PLAIN[name], p).max_rel for p in registered(name)[method].curve]
        assert all(later < sooner / 2 for sooner, later in pairwise(worst)), (method, worst)


# --- references -------------------------------------------------------------------------------------------

DIRECTIONS = np.concatenate([[0, 1e-9, 1e-5, 1e-3, 0.01], np.linspace(0.05, 1, 7)])


@pytest.mark.parametrize("c", [0.75, 1.0])
def test_the_two_solvers_agree(c):
    """Found: 3e-11 forward at grazing angles, by the orders that the kernel leaves out, and 5e-12 elsewhere."""
    i, o, phi = (x.ravel() for x in np.meshgrid(DIRECTIONS, DIRECTIONS, [0, 1.0, 2.0, np.pi], indexing="ij"))
    seen = i + o > 0
    i, o, phi = i[seen], o[seen], phi[seen]
    error = abs(brdf_lambert_sphere(i, o, phi, c) / half_space.brdf(i, o, phi, np.full(i.size, c)) - 1)
    assert error.max() < 1e-10
    assert error[(phi < 2.5) | (i + o > 0.3)].max() < 1e-11


def test_the_reference_returns_all_light():
    """Its own energy, without the kernel: the azimuthal mean at c = 1, but for the kink straight back."""
    _, mu_o, weight = half_space.rule(60, 4)
    phi = (np.arange(48) + 0.5) * np.pi / 48
    for mu_i in (0.01, 0.4):
        i, o, angle = np.broadcast_arrays(mu_i, mu_o[:, None], phi)
        f = half_space.brdf(i.ravel(), o.ravel(), angle.ravel(), np.ones(i.size)).reshape(i.shape)
        assert 2 * np.pi * (weight * mu_o) @ f.mean(1) == pytest.approx(1, abs=1e-7)


def test_the_reference_is_symmetric_and_the_same_for_numbers():
    quantity = registered("brdf_lambert_sphere").quantity
    row = (0.3, 0.8, 1.1, 0.75)
    there, back = half_space.brdf(*(np.array(pair) for pair in zip(row, (0.8, 0.3, 1.1, 0.75), strict=True)))
    assert there == pytest.approx(back, rel=1e-13)
    assert quantity.reference(*row) == pytest.approx(there, rel=1e-14)
    points = right(quantity, "", tuple(np.array([x]) for x in row))
    assert points.high[0] == pytest.approx(there, rel=1e-14) and points.low[0] == 0


def test_interpolation_reproduces_polynomials():
    matrix = half_space.interpolation(12, 5, np.array([0.0, 0.3, 1.0, half_space.rule(12, 5)[1][4]]))
    x = half_space.rule(12, 5)[0]
    at = np.array([0.0, 0.3, 1.0, half_space.rule(12, 5)[1][4]]) ** 0.2
    assert np.allclose(matrix @ x**11, at**11, rtol=0, atol=1e-13)


def test_coefficients_and_phase_of_the_reference():
    assert np.allclose(half_space.coefficients(60), lambert_sphere_coefficients(60), rtol=1e-13, atol=0)
    for mu_i, mu_o, phi in ((0.5, 0.4, 1.0), (0.01, 0.02, np.pi), (1.0, 1.0, 0.0), (0.3, 0.3, 3.1)):
        with mp.workdps(40):
            a, b = mpf(mu_i), mpf(mu_o)
            exact = sphere.phase(-a * b - mp.sqrt((1 - a * a) * (1 - b * b)) * mp.cos(mpf(phi)))
        found = half_space.phase(*(np.array([x]) for x in (mu_i, mu_o, phi)))
        assert found[0] == pytest.approx(float(exact), rel=3e-14)


def test_albedo_references():
    for c in (1e-9, 0.2, 0.7, 0.99):
        kept, lost = half_space.bond(c)
        assert kept + lost == pytest.approx(1, abs=1e-12)
        assert half_space.albedo(c) == pytest.approx(kept, rel=1e-12)
        finer = HalfSpace(lambert_sphere_coefficients(120), c, core=80, nodes=130, modes=1)
        assert half_space.albedo(c) == pytest.approx(finer.bond_albedo(), rel=2e-12)
    c = np.array([0.0, 1e-20, 0.1, 0.4999, 0.5001, 0.9, 1 - 1e-9, 1.0])
    k_d = np.array([half_space.albedo(x) for x in c])
    assert np.allclose(k_d, albedo_lambert_sphere(c), rtol=1e-12, atol=0)
    back = [half_space.inverse(x) for x in k_d]
    assert np.allclose(back, c, rtol=1e-11, atol=0)
    assert np.allclose(back, albedo_lambert_sphere_inverse(k_d), rtol=1e-11, atol=0)


def test_quantiles_are_those_of_the_phase_function():
    for xi in (1e-12, 0.2, 5 / 6, 0.999999):
        mu = sphere.sample(xi)
        with mp.workdps(30):
            theta = mp.acos(mu)
            above = 2 * mp.pi * mp.quad(lambda t: sphere.of_angle(t) * mp.sin(t), [0, theta])
            assert abs(above - (1 - mpf(xi))) < mpf(10) ** -18
    assert sphere.sample(0.0) == -1 and sphere.sample(1.0) == 1


def test_characteristic_functions():
    """K of the methods is that of the references, which have it otherwise."""
    from xsec_sym.study.methods.h_lambert_sphere import OF
    from xsec_sym.study.methods.isotropic import OF as ISO

    for t in (0.01, 0.5, 0.7, 20.0):
        for mode in (0, 1, 2):
            with mp.workdps(60):
                exact = three_terms.k_of(mode, mpf("0.9"), mpf(t), mp.atan(mpf(t)))
            k = OF._rows(half_spaces.parts(t), np.float64(0.9), np.float64(mode))
            assert k.item() == pytest.approx(float(exact), rel=1e-13)
        with mp.workdps(60):
            exact = 1 - mpf("0.9") * mp.atan(mpf(t)) / mpf(t)
        assert ISO._rows(half_spaces.parts(t), np.float64(0.9)).item() == pytest.approx(float(exact), rel=1e-13)
        assert half_spaces.part(t, 3) == pytest.approx(half_spaces.parts(t).tolist(), rel=1e-13)
        assert [float(x) for x in half_spaces.parts_exactly(mpf(t))] == pytest.approx(half_spaces.parts(t).tolist())
    assert chandrasekhar.h(0.5, 0.9) > 1 and h_lambert_sphere(0.5, 0.9, 1) < 1


def test_modes_are_drawn_in_their_cells():
    mode = registered("h_lambert_sphere").quantity.set[1]
    rng = np.random.default_rng(0)
    for k, (low, high) in enumerate(zip(mode.edges, mode.edges[1:], strict=False)):
        assert np.all(mode.draw(rng, 20, low, high) == k)
    assert set(mode.draw(rng, 200)) == {0.0, 1.0, 2.0}
    assert along(n=(1,)) == ({"n": 1},)
