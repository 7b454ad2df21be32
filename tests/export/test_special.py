"""Forms with special functions: right against mpmath, term by term, and silent."""

import warnings

import mpmath
import numpy as np
import pytest
from mpmath import mp, mpf
from sympy import Symbol, besseli, coth, csch, erf, exp, pi, polylog, sinh, sqrt

from xsec_sym import exporting
from xsec_sym.export import available, functions, module, special
from xsec_sym.export.floats import exact
from xsec_sym.export.printer import lines
from xsec_sym.proof.domain import domain, interval
from xsec_sym.record.store import Ledger
from xsec_sym.report.code import codes

u = Symbol("u", real=True)
z = Symbol("z", positive=True)
LEDGER = Ledger()
# Of the roughnesses that are tried; (42) divides what cancels by powers of m, and its docstring says so.
LEAST = {"deon2016:41": 0.01, "deon2016:42": 0.001, "deon2016:43": 0.01, "deon2016:40": 0.001}


@pytest.fixture(scope="module")
def kept():
    return codes(LEDGER)


def beckmann(x, m):
    """Equation (22), mended, by the projected slopes: the mean of what is seen of each facet, clamped."""
    s = mp.sqrt(1 - x * x)
    return mp.quad(lambda t: (x + s * m * t) * mp.exp(-t * t) / mp.sqrt(mp.pi), [max(-x / (s * m), -30), 0, 30]
                   if x > 0 else [-x / (s * m), -x / (s * m) + 2, -x / (s * m) + 8, 60])  # fmt: skip


def test_22_against_an_integral_over_slopes(kept):
    space = {}
    exec(kept["deon2016:22"].text, space)
    for x, m in [(0.3, 0.5), (-0.3, 0.5), (-0.6, 0.1), (0.99, 0.05), (-0.9, 2.0)]:
        with mp.workdps(40):
            expected = beckmann(mpf(x), mpf(m))
        assert np.isclose(space["deon2016_22"](x, m), float(expected), rtol=1e-13, atol=0), (x, m)


KEPT = "deon2016:22 deon2016:31 deon2016:37 deon2016:40 deon2016:41 deon2016:42 deon2016:43 deon2016:44 xsec:sg-band "


@pytest.mark.parametrize("name", [*KEPT.split(), "dupuy2016:12.gaussian"])
def test_kept_code_computes_the_form(name, kept):
    """Against SymPy's own translation to mpmath, at points over the domain; nothing is warned of."""
    entry, code, space = LEDGER[name], kept[name], {}
    assert "from xsec_sym" not in code.text
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        exec(code.text, space)
        function = space[name.replace(":", "_").replace(".", "_").replace("-", "_")]
        count = len(entry.where.symbols)
        first = np.linspace(-0.95, 0.95, 9) if count == 2 else np.linspace(0.05, 3, 9)
        high = float(min(entry.where.variables[-1].high, 3))
        second = [LEAST.get(name, 0.02), 0.5 * high, 0.99 * high] if count == 2 else [None]
        points = [(float(a),) if b is None else (float(a), b) for a in first for b in second]
        values = [float(function(*p)) for p in points]
        assert np.isnan(function(*([np.nan] * count)))
        if name != "dupuy2016:12.gaussian":
            assert np.isnan(function(*([-7.0] * count)))
    for point, value in zip(points, values, strict=True):
        expected = float(exact(entry.form, tuple(entry.where.symbols), point))
        assert np.isclose(value, expected, rtol=1e-8, atol=1e-14), point


@pytest.mark.parametrize(("name", "low", "high"), [("deon2016:41", 1e-6, 0.2999), ("deon2016:42", 1e-3, 1e3)])
def test_no_wrong_number_at_any_roughness(name, low, high, kept):
    """Without the narrower range (41) was 0.45 off at m = 8e-91, and (42) 7e83 at m = 4.7e-34."""
    entry, space, rng = LEDGER[name], {}, np.random.default_rng(41)
    exec(kept[name].text, space)
    function = space[name.replace(":", "_")]
    u, m = rng.uniform(-1, 1, 4000), 10 ** rng.uniform(-300, 300, 4000)
    u[:3], m[:3] = (0.906, -0.999, -0.9), (7.98e-91, 4.69e-34, 1e-8)
    outside = (m < low) | (m > high)
    assert np.isnan(function(u[outside], m[outside])).all()
    roughnesses = np.append(10 ** rng.uniform(np.log10(low), np.log10(high), 10), [low, high])
    for x, rough in zip(rng.uniform(-1, 1, 12), roughnesses, strict=True):
        expected = float(exact(special.plain(entry.form), tuple(entry.where.symbols), (float(x), float(rough))))
        assert np.isclose(function(x, rough), expected, rtol=1e-8, atol=1e-15), (x, rough)


def test_the_list_has_them_and_only_what_can_be_written():
    found = available()
    assert {"deon2016:22", "deon2016:40", "deon2016:41", "deon2016:44", "xsec:smith.beckmann.lambda"} <= found.keys()
    assert "deon2021:27" not in found and "xsec:iso.albedo" not in found


def test_the_header_and_the_list_say_scipy(kept, monkeypatch):
    found = available()

    def listed():
        lines = exporting.listing(found, LEDGER)
        return {line.split()[0]: line for line in lines if not line.startswith("#")}

    said = listed()
    assert said["deon2016:31"].endswith("  [scipy]") and "[scipy" not in said["deon2016:35"]
    for name in said.keys() & kept.keys() & LEDGER.keys():
        assert said[name].endswith("  [scipy]") == ("import scipy.special\n" in kept[name].text), name
    # of forms that were never written nothing is known for certain
    monkeypatch.setattr(exporting, "code", dict)
    said = listed()
    assert said["deon2016:31"].endswith("  [scipy?]") and "[scipy" not in said["deon2016:35"]
    text = module(["deon2016:31"])
    assert "Imports NumPy and scipy.special only" in text and "import scipy.special\n" in text
    assert "scipy" not in module(["deon2016:35"]).replace("scipy.special.", "")


@pytest.mark.parametrize(
    ("form", "wanted"),
    [
        (besseli(1, z) * csch(z), -2 * special.ive(1, z) / special.expm1(-2 * z)),
        (besseli(0, z) / sinh(z), -2 * special.ive(0, z) / special.expm1(-2 * z)),
        (coth(z) - 1 / z, special.langevin(z)),
        (exp(-(z**2)) / sqrt(pi) + z * erf(z) - z, special.ierfc(z)),
    ],
)
def test_what_grows_and_what_cancels_is_taken_out(form, wanted):
    assert wanted in list(special.candidates(form, domain([interval(z, 0, 20, open="left")])))


def test_a_form_that_differs_is_never_offered(monkeypatch):
    monkeypatch.setattr(special, "_forms", lambda e, domain: iter([2 * e, e + mpf(10) ** -18]))
    assert list(special.candidates(coth(z), domain([interval(z, 1, 2)]))) == []


def test_references_see_through_saturation():
    """At 40 and at 100 digits 1 + erf(-26) is 0, and what is left agrees with itself on a wrong value."""
    form = exp(-(u**2)) / sqrt(pi) + u * (erf(u) + 1)
    with mp.workdps(60):
        expected = mp.exp(-676) / mp.sqrt(mp.pi) - 26 * mp.erfc(26)
    assert abs(exact(form, (u,), (-26.0,)) / expected - 1) < 1e-20


def test_functions_that_modules_carry():
    for x in (1e-100, 1e-8, 0.00999, 0.0101, 0.5, 1.99, 2.01, 700.0):
        with mp.workdps(700):
            langevin = mp.coth(mpf(x)) - 1 / mpf(x)
        with mp.workdps(40):
            ierfc = mp.exp(-(mpf(x) ** 2)) / mp.sqrt(mp.pi) - mpf(x) * mp.erfc(mpf(x))
            i2e = mp.exp(-mpf(x)) * mpmath.besseli(2, mpf(x))
        array = np.array([x, -x])
        assert np.allclose(functions.langevin(array), [float(langevin), -float(langevin)], rtol=1e-15, atol=0)
        assert np.allclose(functions.ierfc(array[:1]), float(ierfc), rtol=1e-14, atol=0)
        assert np.allclose(functions.i2e(array[:1]), float(i2e), rtol=2e-15, atol=0)


def test_the_dilogarithm():
    assert lines(polylog(2, u)) == ["return scipy.special.spence(1.0 - u)"]


def test_beside_a_hand_made_kernel():
    """Both carry polynomials of their own."""
    space = {}
    exec(module(["deon2016:22", "sigma_dirac_ring"]), space)
    assert np.isclose(space["sigma_dirac_ring"](0.5, 1.0), np.pi) and space["deon2016_22"](0.3, 0.5) > 0.3
