import sys

import pytest

from tests.record.conftest import certificate
from xsec_sym.record import key
from xsec_sym.record.discover import BrokenDerivation, discover
from xsec_sym.record.key import Keys

SHARED = "from sympy import Symbol\nu = Symbol('u', real=True)\n"
ONE = """from xsec_sym.proof import Source, interval
from .tools.shared import u
from . import other
paper = Source("mine", section="1")
paper.claim("1", "a sum", left=u + u, printed=2*u, where=[interval(u, 0, 1)])
"""
TWO = """import sympy
from xsec_sym.proof import Source, interval
u = sympy.Symbol('u', real=True)
Source("mine").claim("2", "a product", left=u * u, printed=u**2, where=[interval(u, 0, 1)])
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "tools").mkdir()
    for name, text in {
        "one.py": ONE,
        "two.py": TWO,
        "other.py": "",
        "tools/__init__.py": "",
        "tools/shared.py": SHARED,
    }.items():
        (tmp_path / name).write_text(text)
    yield tmp_path
    from xsec_sym.record import discover as module

    for name in [m for m in sys.modules if m.startswith(module.PREFIX)]:
        del sys.modules[name]
    for name in [n for n, c in module.REGISTRY.items() if c.module.startswith(module.PREFIX)]:
        del module.REGISTRY[name]


def keys(folder):
    made = Keys(discover(folder))
    return {name: made.of(name) for name in ("mine:1", "mine:2")}


@pytest.mark.parametrize(
    ("name", "text", "changed"),
    [
        ("one.py", ONE.replace("a sum", "A sum"), {"mine:1"}),
        ("one.py", ONE.replace("2*u", "3*u"), {"mine:1"}),
        ("two.py", TWO + "# more\n", {"mine:2"}),
        ("tools/shared.py", SHARED + "# more\n", {"mine:1"}),
        ("tools/__init__.py", "# more\n", {"mine:1"}),
        ("other.py", "# more\n", {"mine:1"}),
        ("unrelated.py", "# more\n", set()),
    ],
)
def test_what_changes_a_key(folder, name, text, changed):
    before = keys(folder)
    (folder / name).write_text(text)
    after = keys(folder)
    assert {n for n in before if before[n] != after[n]} == changed


def test_engine_lemmas_and_claims_count(folder, monkeypatch):
    claims = discover(folder)
    made = Keys(claims)
    assert made.of("mine:1", certificate("mine:1")) == made.of("mine:1")
    leaning = made.of("mine:1", certificate("mine:1", "mine:2"))
    assert leaning != made.of("mine:1")
    object.__setattr__(claims["mine:2"], "printed", claims["mine:2"].printed + 1)
    assert made.of("mine:1", certificate("mine:1", "mine:2")) != leaning
    before = made.of("mine:2")
    monkeypatch.setattr(key, "engine", lambda: "another")
    assert made.of("mine:2") != before


def test_the_project_s_own_are_always_there(folder):
    claims = discover(folder)
    assert {"mine:1", "mine:2"} < set(claims) and "mine:1" not in discover()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("1/0", "ZeroDivisionError.*line 1"),
        ("import nowhere_to_be_found", "No module named"),
        ("x = (", "SyntaxError"),
        ("raise SystemExit(3)", "SystemExit: 3"),
        (
            "from xsec_sym.proof import Source\np = Source('p')\nfor k in 1, 2: p.claim('8', '', left=1, printed=1)",
            "claimed twice",
        ),
        ("", "no module that makes a claim"),
    ],
)
def test_what_cannot_be_imported_is_named(tmp_path, text, said):
    (tmp_path / "bad.py").write_text(text)
    with pytest.raises(BrokenDerivation, match=said):
        discover(tmp_path)


def test_an_id_of_the_project_s_own_is_refused(tmp_path):
    source, _, label = next(iter(discover())).partition(":")
    (tmp_path / "bad.py").write_text(
        f"from xsec_sym.proof import Source\nSource({source!r}).claim({label!r}, '', left=1, printed=1)"
    )
    with pytest.raises(BrokenDerivation, match="claimed twice"):
        discover(tmp_path)


def test_no_folder(tmp_path):
    with pytest.raises(BrokenDerivation, match="is not a folder"):
        discover(tmp_path / "none")
