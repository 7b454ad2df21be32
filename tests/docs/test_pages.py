"""The pages say what the record and the measurements say, their commands exist, and their examples run."""

import doctest
import os
import re
import shlex
import subprocess
from importlib.util import find_spec
from math import isclose

import pytest
from sympy import simplify

from tests.docs import replay, tables
from xsec_sym import cli
from xsec_sym.record.store import Ledger
from xsec_sym.study import files
from xsec_sym.study.method import HOMES

ROOT = replay.ROOT
PAGES = ["README.md", "CONTRIBUTING.md", *sorted(f"docs/{p.name}" for p in (ROOT / "docs").glob("*.md"))]
RECORD = Ledger()


def read(name):
    return (ROOT / name).read_text(encoding="utf-8")


def rows(page, heading):
    """The rows of the tables below a heading, as lists of cells, without the heads of the tables."""
    part = re.search(rf"^#+ {re.escape(heading)}\n(.*?)(?=^#+ |\Z)", page, re.M | re.S)[1]
    found = re.findall(r"^\| (.*) \|$", part, re.M)
    return [
        [c.replace(r"\|", "|") for c in re.split(r" (?<!\\)\| ", row)] for row in found if not row.startswith("id ")
    ]


def ids(cell):
    return re.findall(r"`([a-z0-9_]+:[^`]+)`", cell)


# --- numbers ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", tables.TABLES)
def test_what_is_counted_is_up_to_date(name):
    """`python -m tests.docs.tables` writes it."""
    path, table = tables.TABLES[name]
    assert tables.renewed(read(path), name, table(RECORD)) == read(path)


def test_a_stale_count_would_be_noticed():
    path, table = tables.TABLES["counts"]
    fewer = {k: e for k, e in list(RECORD.items())[1:]}
    record = type("Fewer", (dict,), {"sources": RECORD.sources, "source": lambda self, key: [
        e for e in self.values() if e.source == key]})(fewer)  # fmt: skip
    assert tables.renewed(read(path), "counts", table(record)) != read(path)


ERRATA = rows(read("README.md"), "Errata")


def test_every_erratum_is_a_misprint_and_every_misprint_an_erratum():
    listed = {name for row in ERRATA for name in ids(row[0])}
    misprints = {e.id for e in RECORD.by_verdict("misprint")}
    assert listed <= misprints

    def told(name):
        """It is listed, or a part of what is, or a whole whose parts are."""
        parts = [p for p in RECORD[name].parts if p in misprints]
        return name in listed or any(name.startswith(f"{one}.") for one in listed) or (parts and all(map(told, parts)))

    assert [name for name in misprints if not told(name)] == []


def symbolic(text, entry):
    """A cell of Table 1 as it is set in a line, as an expression in the entry's own variables."""
    from sympy.parsing.sympy_parser import implicit_multiplication, parse_expr, standard_transformations

    text = re.sub(r"\|u\|", "Abs(u)", text).replace("π", "pi").replace("^", "**").replace("log 2", "log(2)")
    names = {s.name: s for s in entry.side("printed").free_symbols}
    return parse_expr(text, names, transformations=(*standard_transformations, implicit_multiplication))


TABLE1 = [row for row in ERRATA if ids(row[0])[0].startswith("deon2016:T1.") and "wrong for" not in row[1]]


@pytest.mark.parametrize("row", TABLE1, ids=lambda row: ids(row[0])[0])
def test_the_forms_of_table_1_are_the_recorded_ones(row):
    entry = RECORD[ids(row[0])[0]]
    for side, cell in (("printed", row[1]), ("corrected", row[2])):
        assert simplify(symbolic(cell.strip("`"), entry) - entry.side(side)) == 0


@pytest.mark.parametrize("name", PAGES)
def test_every_id_that_is_named_exists(name):
    for one in re.findall(rf"`((?:{'|'.join(RECORD.sources)}):[^`]+)`", read(name)):
        stem, dots, _ = one.partition("…")
        assert any(known.startswith(stem) for known in RECORD) if dots else one in RECORD, one


ACCURACIES = rows(read("docs/findings.md"), "Stated accuracies")


def test_no_stated_accuracy_is_left_out():
    stated = {e.id for e in RECORD.values() if e.kind == "accuracy" and e.source == "deon2016"}
    assert {row[0].strip("`") for row in ACCURACIES if "deon2016" in row[0]} == stated


@pytest.mark.parametrize("row", ACCURACIES, ids=lambda row: row[0])
def test_accuracies_are_the_recorded_ones(row):
    entry = RECORD[row[0].strip("`")]
    assert ("**fails**" if entry.verdict == "claim-fails" else "holds") == row[2]
    near = entry.evidence.get("largest error") or entry.evidence["largest error found"]
    said = row[3].split(" (")[0]
    value = float(said.removesuffix(" %")) / (100 if said.endswith("%") else 1)
    assert isclose(value, float(near), rel_tol=5e-3)
    point = entry.evidence.get("where") or entry.evidence["at point"]
    told = [float(x) for x in re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", row[4])]
    rest = [float(x) for name, x in point.items() if name in ("u", "m", "mu", "mu_i", "c", "xi")]
    assert told and all(any(isclose(abs(a), abs(b), rel_tol=6e-3) for b in rest) for a in told)
    if len(row) > 5:
        reach = [float(re.search(r"[\d.]+$", text)[0]) for text in (row[5], entry.evidence["reach"])]
        assert isclose(*reach, rel_tol=1e-3)


def test_the_numbers_of_the_fast_variant():
    text = read("docs/findings.md")
    for name, form in (("deon2021:48.energy", "{:.1%}"), ("deon2021:48.grazing", "{:.2f}")):
        said = form.format(float(RECORD[name].evidence["largest error found"])).replace("%", " %")
        assert f"`{name}`" in text and said in text


def test_the_numbers_below_the_chart():
    points = files.stored("sigma_spherical_gaussian")["points"]
    plain = [p for p in points if p["dtype"] == "float64" and not p["fixed"]]
    kernels = [p for p in plain if p["method"] == "kernel" and p["parameters"] == {"accuracy": "full"}]
    kernel = max(kernels, key=lambda p: p["n"])
    used = ("punctual", "inner product", "Hill", "Meder-Brüderlin", "Tokuyoshi 2022", "Tokuyoshi 2024", "Beckmann")
    nearest = min((p for p in plain if p["method"] in used), key=lambda p: float(p["max_abs"]))
    text = read("README.md")
    assert f"takes {kernel['ns_median']:.0f} ns a value" in text
    assert f"largest relative error of {float(kernel['max_rel']):.1e}" in text
    assert f"off by {float(nearest['max_abs']):.1e}".replace("e-03", "e-3") in text
    assert float(nearest["max_rel"]) > 100, "on the dark side by orders of magnitude"
    assert "seventeen more quantities" in text and len(HOMES) == 18


def test_every_verdict_is_explained_and_its_limits_told():
    from xsec_sym.proof.limits import MEMORY, SECONDS
    from xsec_sym.proof.verdict import RANK

    page = read("docs/verdicts.md")
    explained = {word for row in rows(page, "Verdicts") for word in row[0].split(", ")}
    assert set(RANK) <= explained
    assert (SECONDS, MEMORY) == (240, 4 << 30) and "four minutes and 4 GB" in page


# --- what can be called -----------------------------------------------------------------------------------------


def commands():
    """Every line of a shell that a page shows, outside of what is replayed."""
    for name in PAGES:
        for block in re.findall(r"^```sh\n(.*?)^```$", read(name), re.M | re.S):
            for line in block.splitlines():
                yield name, shlex.split(line, comments=True)
        for said in re.findall(r"`((?:xsec|make|python -m) [^`]*)`", read(name)):
            yield name, shlex.split(said)


def parsed(words):
    """The options and arguments of a call of `xsec`, which is not made; words in capitals stand for something."""
    command = cli.main.commands[words[1]]
    given = [w for w in words[2:] if not w.isupper() or w.startswith("-")] or ["ID"] * (words[1] == "show")
    with command.make_context(words[1], given) as context:
        return context.params


@pytest.mark.parametrize(
    ("page", "words"), list(commands()), ids=lambda x: x if isinstance(x, str) else "-".join(x[:2])
)
def test_a_command_of_a_page_exists(page, words):
    if words[0] == "make":
        assert re.search(rf"^{words[1]}:", read("Makefile"), re.M)
    elif words[:2] == ["python", "-m"]:
        assert find_spec(words[2])
    else:
        assert words[0] == "xsec"
        found = parsed(words)
        sources = tuple(f"{s}:" for s in RECORD.sources)
        assert all(w in RECORD for w in words if w.startswith(sources))
        assert words[1] != "chart" or found["name"] in (None, *HOMES)
        assert words[1] != "plan" or (ROOT / found["scene"]).is_file()
        if words[1] == "export":
            from xsec_sym.export import available

            assert set(found["names"]) <= set(available())


@pytest.mark.parametrize("name", ["README.md"])
def test_examples_of_a_page_run(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = doctest.testfile(str(ROOT / name), module_relative=False, encoding="utf-8")
    assert found.attempted > 10 and found.failed == 0


def test_the_shell_of_the_readme_prints_what_it_says(tmp_path, monkeypatch):
    monkeypatch.setattr("os.cpu_count", lambda: 1)
    page = read("README.md")
    assert replay.timeless(replay.replayed(page, tmp_path, {})) == replay.timeless(page)


@pytest.mark.parametrize("name", PAGES)
def test_links_lead_somewhere(name):
    for target in re.findall(r"\]\(([^)]+)\)", read(name)):
        path, _, anchor = target.partition("#")
        place = os.path.normpath(ROOT / os.path.dirname(name) / path)
        assert os.path.exists(place), target
        if anchor:
            heads = re.findall(r"^#+ (.*)$", read(os.path.relpath(place, ROOT)), re.M)
            assert anchor in {h.lower().replace(" ", "-") for h in heads}


def test_every_make_target_is_told():
    targets = set(re.findall(r"^([a-z-]+):", read("Makefile"), re.M)) - {"clean", "lint"}
    assert {t for t in targets if f"`make {t}`" not in read("CONTRIBUTING.md")} == set()
    listed = subprocess.run(["make", "-s", "help"], cwd=ROOT, capture_output=True, text=True).stdout.splitlines()
    assert {line.split()[1] for line in listed} == targets | {"clean", "lint"} and all(
        line.split()[2:] for line in listed
    )


def test_names_of_the_licence_and_the_version_agree():
    import tomllib

    from xsec_sym import __version__

    project = tomllib.loads(read("pyproject.toml"))["project"]
    cited = dict(re.findall(r"^([a-z-]+): (.*)$", read("CITATION.cff"), re.M))
    assert project["license"] == cited["license"] == "BSD-3-Clause"
    assert project["version"] == cited["version"] == __version__
    assert "Copyright (c) 2026, The xsec_sym authors" in read("LICENSE")
    assert project["authors"] == [{"name": "The xsec_sym authors"}]
