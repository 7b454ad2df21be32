import re
import subprocess
import sys
import types

import numpy as np
import pytest
from sympy import Abs, Integral, Piecewise, Symbol, log, oo, sqrt

from xsec_sym import kernels
from xsec_sym.export import Refusal, available, module
from xsec_sym.export.assemble import Cutting, function_name, recorded
from xsec_sym.export.recipes import RECIPES
from xsec_sym.export.source import Entangled
from xsec_sym.proof import Source, interval
from xsec_sym.proof.verdict import Verdict
from xsec_sym.record.entry import Entry

u, v, x = (Symbol(name, real=True) for name in "uvx")
U = np.concatenate([np.linspace(-1, 1, 41), [1e-300, -1e-300, 5e-324, -5e-324, -0.0, 1.1, -2, np.nan, np.inf]])

ALONE = """
import sys
class Nothing:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in ("sympy", "mpmath", "scipy", "gmpy2", "flint", "xsec_sym"):
            raise ImportError(name)
sys.meta_path.insert(0, Nothing())
import warnings
warnings.simplefilter("error")
import numpy as np
sys.path.insert(0, sys.argv[1])
import exported
u = np.load(sys.argv[1] + "/u.npy")
result = {name: getattr(exported, name)(u, *more) for name, more in __CALLS__}
np.savez(sys.argv[1] + "/result.npz", **result)
"""


def entry(label, form, where, verdict="proved", kind="equation", left=0):
    source = Source("exported")
    if kind == "definition":
        claim = source.definition(label, "a definition", left=left, printed=form)
    else:
        claim = source.claim(label, f"number {label}", left=left, printed=form, where=where)
    return Entry.of(claim, Verdict(verdict, mutants=8))


def record(*entries):
    return {e.id: e for e in entries}


def loaded(text):
    made = types.ModuleType("exported")
    exec(compile(text, "exported", "exec"), made.__dict__)
    return made


def same_bits(a, b):
    return a.dtype == b.dtype and np.array_equal(a, b, equal_nan=True)


def test_stands_alone_with_the_same_bits(tmp_path):
    more = {"sigma_power": (4,), "sigma_dirac_ring": (0.25,)}
    calls = [(name, more.get(name, ())) for name in RECIPES]
    (tmp_path / "exported.py").write_text(module(list(RECIPES)))
    np.save(tmp_path / "u.npy", U)
    code = ALONE.replace("__CALLS__", repr(calls))
    done = subprocess.run([sys.executable, "-c", code, str(tmp_path)], capture_output=True, text=True)
    assert done.returncode == 0 and done.stderr == "", done.stderr
    with np.load(tmp_path / "result.npz") as results:
        for name, extra in calls:
            assert same_bits(results[name], getattr(kernels, name)(U, *extra)), name


def test_imports_and_parts_occur_once():
    text = module(list(RECIPES))
    assert set(re.findall(r"^(?:from|import) (\S+)", text, re.M)) == {
        "math",
        "collections.abc",
        "functools",
        "typing",
        "numpy",
    }
    assert text.count("def elementwise(") == text.count("import numpy") == 1
    assert "ring_lemma" not in text and "def horner" not in module(["sigma_power"])


@pytest.mark.parametrize("name", ["sigma_inv1p", "sigma_power", "deon2016:T1.u2.s"])
def test_dtypes(name):
    public = function_name(name)
    extra = (2,) if name == "sigma_power" else ()
    single, double = (getattr(loaded(module([name], dtype)), public) for dtype in ("float32", "float64"))
    assert single(U, *extra).dtype == single(U.astype(np.float32), *extra).dtype == np.float32
    assert double(U, *extra).dtype == np.float64 and double(U.astype(np.float32), *extra).dtype == np.float32
    with np.errstate(over="ignore"):
        assert same_bits(single(U, *extra), double(U, *extra).astype(np.float32))


def test_a_split_cell_is_the_recipe():
    assert module(["deon2016:T1.inv1p.s"]) == module(["sigma_inv1p"]) == module(["sigma_inv1p", "deon2016:T1.inv1p.s"])


def test_every_name_told_of_is_exported():
    assert set(RECIPES) <= set(available())
    for name in ["deon2016:11", "deon2016:7", "deon2016:T1.inv1m2.s2", "deon2016:14"]:
        assert name in available()
        function = getattr(loaded(module([name])), function_name(name))
        assert name in function.__doc__ and "ulp" in function.__doc__


def test_masks_leave_no_branch_to_chance():
    form = Piecewise((log(u), u > 1), (sqrt(1 - u), u > 0), (1 / u, u < 0), (7, True))
    text = module(["exported:1"], record=record(entry("1", form, [interval(u, -2, 4)])))
    f = loaded(text).exported_1
    got = f([4, 1, 0.75, 0, -0.5, -2, -2.1, np.nan])
    assert np.allclose(got, [np.log(4), 0, 0.5, 7, -2, -0.5, np.nan, np.nan], equal_nan=True)
    assert f(4.0).shape == () and f([]).shape == (0,) and f(np.float32(4)).dtype == np.float32
    # the branches see only what is theirs, so that nothing is raised even where warnings are not silenced
    inner = loaded(text)._exported_1
    with np.errstate(all="raise"):
        inner(np.array([4, 1, 0.75, 0, -0.5, -2]))


def test_conditions_and_several_variables():
    form = Piecewise((u / v, u < v), (Abs(u) * v, True))
    where = [interval(u, 0, 1), interval(v, 0, oo, open="left"), u + v >= 1]
    f = loaded(module(["exported:2"], record=record(entry("2", form, where)))).exported_2
    assert np.allclose(f([0.5, 1, 0.25], [1, 0.5, 0.5]), [0.5, 0.5, np.nan], equal_nan=True)
    assert np.isnan(f(1, np.inf)) and f([[1], [1]], [1, 2, 3]).shape == (2, 3)
    with pytest.raises(ValueError, match=r"u .*v"):
        f([1, 2], [1, 2, 3])


def test_arguments_stay_and_names_are_python(recwarn):
    lam = Symbol("lambda", real=True)
    text = module(["exported:3"], record=record(entry("3", lam + 0, [interval(lam, 0, 1)])))
    given = np.array([0.5, 3.0])
    assert np.isnan(loaded(text).exported_3(lambda_=given)[1]) and given[1] == 3.0


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("sigma_inv1q", "there is nothing to export by the name sigma_inv1q; did you mean sigma_inv1"),
        ("deon2016:T1.even.s", "takes integer or single values only; export sigma_power, which rests on it"),
        ("deon2016:T1.inv1p.s.neg", "deon2016:T1.inv1p.s.neg is divergent"),
        ("deon2016:T1.inv1p.s1.zero", "it is the number 0"),
        ("deon2016:9", "refers to Ring"),
        ("deon2016:6", "is a definition"),
        ("deon2016:5", "it is the number 1"),
        ("deon2016:claim.figure-1", "export its parts"),
        ("deon2021:27", "neither NumPy nor SciPy has "),
        ("kenha2018:5", "two variables of one name"),
    ],
)
def test_refusals(name, words):
    if ":" in name and name not in recorded():
        pytest.skip(f"{name} is not recorded")
    with pytest.raises(Refusal, match=re.escape(words)) as refused:
        module([name])
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("verdict", ["inconclusive", "timeout", "refuted", "claim-fails"])
def test_what_is_not_verified_is_refused(verdict):
    with pytest.raises(Refusal, match=f"exported:4 is not verified: its verdict is {verdict}"):
        module(["exported:4"], record=record(entry("4", u, [interval(u, 0, 1)], verdict)))


def test_a_recipe_rests_on_verified_entries():
    from dataclasses import replace

    broken = {name: recorded()[name] for name in RECIPES["sigma_power"].ids}
    broken["deon2016:T1.odd.s"] = replace(broken["deon2016:T1.odd.s"], verdict="timeout")
    with pytest.raises(Refusal, match=r"sigma_power rests on deon2016:T1\.odd\.s.*timeout"):
        module(["sigma_power"], record=broken)
    assert "sigma_power" not in available(broken)


def test_integrals_and_infinities_are_refused():
    pending = entry("5", Integral(u * x, (x, 0, 1)), [interval(u, 0, 1)])
    with pytest.raises(Refusal, match="has an integral in it"):
        module(["exported:5"], record=record(pending))
    with pytest.raises(Refusal, match="infinite on its whole domain"):
        module(["exported:6"], record=record(entry("6", oo, [interval(u, 0, 1)])))


@pytest.mark.parametrize(("wanted", "dtype"), [([], None), (["sigma_power"], "float16")])
def test_nothing_and_no_dtype(wanted, dtype):
    with pytest.raises(Refusal):
        module(wanted, dtype)


def test_what_imports_more_than_numpy_is_not_cut_out():
    cut = Cutting()
    with pytest.raises(Entangled, match="sympy"):
        cut.add("example", "import sympy\n\n\ndef f(x):\n    return sympy.sin(x)\n", "f")
