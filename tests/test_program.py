"""The program as a process, its examples, what `make help` and the citation say, and what an import costs."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from tests.test_cli import MINE, run
from xsec_sym import cli, guide
from xsec_sym.export.recipes import RECIPES
from xsec_sym.record import Ledger
from xsec_sym.record.sources import SOURCES
from xsec_sym.study.method import HOMES

# --- what stands beside the program -----------------------------------------------------------------------


def test_make_help_lists_what_contributing_does():
    done = subprocess.run(["make", "help"], cwd=ROOT, capture_output=True, text=True)
    listed = {line.split()[1] for line in done.stdout.splitlines() if line.startswith("make ")}
    phony = re.search(r"^\.PHONY: (.*)$", (ROOT / "Makefile").read_text(), re.M)[1].split()
    told = re.findall(r"`make ([a-z-]+)", (ROOT / "CONTRIBUTING.md").read_text())
    assert done.returncode == 0 and listed == set(phony) and listed - {"clean"} <= set(told) <= listed


def test_the_citation_names_the_sources():
    yaml = pytest.importorskip("yaml")
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))["references"]
    for source, reference in zip([s for s in SOURCES.values() if not s.own], cited, strict=True):
        names = [
            f"{a['given-names']} {a['family-names']}" if "name" not in a else a["name"] for a in reference["authors"]
        ]
        assert (reference["title"], tuple(names)) == (source.title, source.authors)
        for ours, theirs in (("year", "year"), ("doi", "doi"), ("volume", "volume"), ("number", "issue")):
            assert source.fields.get(ours) == (str(reference[theirs]) if theirs in reference else None)


# --- processes ---------------------------------------------------------------------------------------


def xsec(*arguments, **more):
    return subprocess.run([sys.executable, "-m", "xsec_sym.cli", *arguments], capture_output=True, text=True, **more)


def test_as_a_program(tmp_path):
    done = xsec("show", "nothing:1")
    assert done.returncode == 2 and done.stderr == (
        "xsec: there is no entry nothing:1; one of your own wants --derivations PATH, and its verdict recorded\n"
    )
    (tmp_path / "paper.py").write_text(MINE[: MINE.index('paper.claim("3"')])
    done = xsec("verify", "--source", "mine", "--derivations", str(tmp_path), "--jobs", "1")
    assert done.stderr == "" and "mine:1" in done.stdout


def test_bare_call_says_what_to_do_next():
    result = run()
    assert result.exit_code == 0 and result.stderr == ""
    assert result.stdout.startswith(f"The record: {len(RECORD)} entries of {len(RECORD.sources)} sources; ")
    unsettled = sum(not e.settled for e in RECORD.values())
    assert f", {unsettled} not settled.\n" in result.stdout
    for who in ("check a paper", "need a kernel", "add a paper", "plan a scene"):
        assert f"\nYou {who}\n  xsec " in result.stdout
    assert run("--version").stdout.startswith("xsec 0.")


# --- examples ----------------------------------------------------------------------------------------

ROOT = Path(__file__).parent.parent
RECORD = Ledger()
LINES = [line for name in guide.EXAMPLES for line, _ in guide.EXAMPLES[name] if not line.startswith("eval")]
NEXT = [line for _, *lines in guide.USERS for line, _ in lines if "FOLDER" not in line]


def test_every_command_has_examples():
    assert set(guide.EXAMPLES) == set(cli.main.commands)
    for name, examples in guide.EXAMPLES.items():
        said = run(name, "--help").stdout.partition("\nExamples:\n")[2]
        for line, _ in examples:
            assert f"  {line}  " in said or f"  {line}\n" in said
            assert name in line


@pytest.mark.parametrize("line", dict.fromkeys(LINES + NEXT))
def test_examples_name_what_there_is(line, monkeypatch):
    monkeypatch.chdir(ROOT)
    program, *words = shlex.split(line.partition(" > ")[0])
    command = cli.main.commands.get(words[0] if words else "")
    assert program == "xsec" and command is not None
    given = command.make_context(command.name, words[1:]).params
    names = [*given.get("ids", ()), *given.get("names", ()), *([given["name"]] if given.get("name") else [])]
    known = {"chart": HOMES, "export": [*RECIPES, *RECORD]}.get(command.name, [*RECORD, *RECORD.sources])
    assert set(names) <= set(known) and set(given.get("sources", ())) <= set(RECORD.sources)
    assert "scene" not in given or Path(given["scene"]).is_file()


QUICK = [line for name in ("show", "check", "export") for line, _ in guide.EXAMPLES[name] if "--dtype" not in line]


@pytest.mark.parametrize("line", [*QUICK, "xsec chart", "xsec chart sigma_ggx"])
def test_examples_that_are_quick_work(line, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = shlex.split(line)[1:]
    result = run(*words)
    assert result.stderr == ("wrote kernel.py\n" if "-o" in words else "")
    assert result.exit_code == (1 if "sqrt(x**2)" in words else 0)
    assert result.stdout != "" or os.listdir(tmp_path) == [words[words.index("-o") + 1]]


@pytest.mark.parametrize(
    ("statement", "absent"),
    [
        ("import xsec_sym", ["sympy", "numpy", "mpmath", "click", "rich"]),
        ("import xsec_sym.kernels", ["sympy", "mpmath", "matplotlib"]),
        ("from xsec_sym import cross_section, kernels", ["sympy", "mpmath"]),
        ("from xsec_sym import ledger; len(ledger)", ["matplotlib", "scipy"]),
        ("import xsec_sym.cli", ["sympy", "numpy", "rich", "json"]),
        ("from xsec_sym import cli, guide; guide.told(cli._ledger(None))", ["sympy", "numpy", "rich"]),
        ("import xsec_sym.record.run", ["matplotlib", "scipy"]),
    ],
)
def test_imports_stay_cheap(statement, absent):
    code = f"import sys; {statement}; print([m for m in {absent!r} if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "[]\n"


def test_names_of_the_package():
    import xsec_sym

    assert {"check", "cross_section", "kernels", "ledger"} <= set(dir(xsec_sym))
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = xsec_sym.nothing
