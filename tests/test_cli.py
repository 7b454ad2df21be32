import json
import os
import re
import sys
import time
from types import SimpleNamespace

import pytest
from click.testing import CliRunner

from tests.record.conftest import certificate, stand_in_for_engine
from xsec_sym import cli, guide, verifying
from xsec_sym.proof.verdict import Verdict
from xsec_sym.record import Entry, Ledger, store

MINE = """from sympy import Symbol
from xsec_sym.proof import Source, interval
u = Symbol("u", real=True)
paper = Source("mine", section="1")
for k in (1, 2):
    paper.claim(str(k), f"power {k}", left=u * u**k, printed=u ** (k + 1), where=[interval(u, 0, 1)])
paper.claim("3", "a misprint", left=u + u, printed=3*u, corrected=2*u, edit="2 instead of 3", where=[interval(u, 0, 1)])
paper.whole("4", "all", ["1", "3"], left=u)
"""
RECORD = Ledger()
IDS = ["mine:1", "mine:2", "mine:3", "mine:4"]


@pytest.fixture
def mine(tmp_path, monkeypatch):
    """A folder with derivations of one's own, beside a project's record that is empty."""
    monkeypatch.setattr(store, "DATA", tmp_path / "data")
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "paper.py").write_text(MINE)
    return str(tmp_path / "mine")


@pytest.fixture
def engine(monkeypatch):
    return stand_in_for_engine(monkeypatch)


def run(*arguments):
    plain = {"FORCE_COLOR": None}
    return CliRunner(env=plain).invoke(cli.main, [str(a) for a in arguments], catch_exceptions=False)


def refused(result, *words):
    assert result.exit_code == 2, result.output
    assert result.stderr.count("\n") == 1 and result.stderr.startswith("xsec: ")
    assert result.stdout == ""
    for word in words:
        assert word in result.stderr


def verdicts(result):
    return dict(
        line.split()[:2] for line in result.stdout.splitlines() if line.startswith("mine:") and ": " not in line
    )


# --- verify ------------------------------------------------------------------------------------------


def test_verify_prints_a_line_for_each(mine, engine):
    engine["mine:2"] = Verdict("confirmed", digits=30, mutants=9, seconds=1.5)
    result = run("verify", *IDS, "--derivations", mine, "--jobs", 1)
    assert result.exit_code == 0 and result.stderr == ""
    assert verdicts(result) == {"mine:1": "proved", "mine:2": "confirmed", "mine:3": "proved", "mine:4": "proved"}
    assert result.stdout.splitlines()[0].split() == ["id", "verdict", "digits", "mutants", "seconds"]
    assert result.stdout.splitlines()[2].split() == ["mine:2", "confirmed", "30", "9", "1.50"]
    assert "   3 proved\n   1 confirmed\n" in result.stdout
    assert "mine:1: proved, and not in the record" in result.stdout
    assert last(result) == "4 verdicts: 4 not in the record"


def last(result):
    """The closing sentence, without the time."""
    said, seconds = result.stdout.splitlines()[-1].split("; ")
    assert float(seconds.removesuffix(" s")) >= 0
    return said


def test_record_then_compare(mine, engine, tmp_path):
    engine["mine:1"] = Verdict("proved", certificate=certificate("mine:1"))
    assert run("verify", "--source", "mine", "--derivations", mine, "--record").exit_code == 0
    kept = tmp_path / "mine" / "record"
    assert sorted(os.listdir(kept)) == ["mine.json", "mine.proofs.json"] and not (tmp_path / "data").exists()
    again = run("verify", "--source", "mine", "--derivations", mine)
    assert again.exit_code == 0 and last(again) == "4 verdicts: all as recorded"

    engine["mine:1"] = Verdict("confirmed", digits=30)
    before = (kept / "mine.json").read_text()
    differs = run("verify", "mine:1", "mine:2", "--derivations", mine)
    assert differs.exit_code == 1
    assert "mine:1: confirmed, while the record says proved" in differs.stdout
    assert last(differs) == "2 verdicts: 1 as recorded, 1 other than recorded"
    assert (kept / "mine.json").read_text() == before, "only --record changes the record"
    assert run("verify", "mine:1", "--derivations", mine, "--record").exit_code == 0
    assert [e.verdict for e in Ledger(kept).values()] == ["confirmed", "proved", "proved", "proved"]
    assert Ledger(kept).certificate("mine:1") is None


def test_what_is_not_settled_is_recorded_and_fails(mine, engine, tmp_path):
    engine["mine:1"] = Verdict("inconclusive", note="too\nhard")
    result = run("verify", "mine:1", "--derivations", mine, "--record")
    assert result.exit_code == 1 and "mine:1: too hard\n" in result.stdout
    assert last(result) == "1 verdict: recorded, 1 not settled"
    assert Ledger(tmp_path / "mine" / "record")["mine:1"].verdict == "inconclusive"
    assert run("verify", "mine:1", "--derivations", mine).exit_code == 1, "it never counts as passed"


def test_what_no_derivation_claims_any_more(mine, engine, tmp_path):
    run("verify", "--source", "mine", "--derivations", mine, "--record")
    (tmp_path / "mine" / "paper.py").write_text(MINE[: MINE.index("paper.whole")])
    result = run("verify", "--source", "mine", "--derivations", mine)
    assert result.exit_code == 1 and "mine:4: in the record, and no derivation claims it" in result.stdout
    assert last(result) == "3 verdicts: 3 as recorded, 1 gone"
    assert run("verify", "--source", "mine", "--derivations", mine, "--record").exit_code == 0
    assert "mine:4" not in Ledger(tmp_path / "mine" / "record")


def test_the_project_s_own_must_be_in_the_record(mine, engine, tmp_path):
    first = next(iter(verifying.claims_of(None).values()))
    assert run("verify", first.id).exit_code == 1
    assert run("verify", first.id, "--record").exit_code == 0
    assert (tmp_path / "data" / f"{first.source}.json").exists()
    assert run("verify", first.id).exit_code == 0


def test_what_is_done_is_told_on_ctrl_c(mine, monkeypatch):
    def interrupted(claims, chosen, ledger, settings, *, tick, **rest):
        tick("mine:1", Verdict("proved", mutants=9, seconds=1.5))
        tick("mine:3", Verdict("inconclusive", note="too hard"))
        raise KeyboardInterrupt

    monkeypatch.setattr("xsec_sym.record.run.verify_all", interrupted)
    monkeypatch.setattr("xsec_sym.terminal._end_children", lambda: None)  # other tests have processes in this one
    result = run("verify", "--source", "mine", "--derivations", mine)
    assert result.exit_code == 130 and result.stderr == "xsec: interrupted\n"
    assert verdicts(result) == {"mine:1": "proved", "mine:3": "inconclusive"}
    assert result.stdout.endswith("mine:3: too hard\n2 of 4 verdicts, and none of them compared with the record\n")


def test_a_proof_that_does_not_go_through_is_told(mine, engine):
    engine["mine:1"] = Verdict("confirmed", digits=30, note="the proof does not go through: 1 is not 2")
    result = run("verify", "mine:1", "--derivations", mine)
    assert result.exit_code == 0 and "\nmine:1: the proof does not go through: 1 is not 2\n" in result.stdout


def test_json(mine, engine, tmp_path):
    path = tmp_path / "out.json"
    done = run("verify", "mine:3", "mine:4", "--derivations", mine, "--digits", 40, "--json", path)
    assert done.stderr == f"wrote {path}\n"
    data = json.loads(path.read_text())
    assert data["digits"] == 40 and [e["id"] for e in data["entries"]] == ["mine:1", "mine:3", "mine:4"]
    entry = data["entries"][1]
    assert (entry["printed"], entry["corrected"], entry["domain"], entry["digits"]) == ("3 u", "2 u", "u in [0, 1]", 40)
    assert {"source", "label", "title", "verdict", "witness", "evidence", "mutants", "seconds"} < set(entry)
    assert "corrected" in data["entries"][0] and data["entries"][0]["corrected"] is None


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["verify", "deon2061:8"], ["no claim deon2061:8", "did you mean"]),
        (["verify", "--source", "kenha2081"], ["no source kenha2081", "did you mean kenha2018"]),
        (["verify", "--digits", "ten"], ["--digits"]),
        (["verify", "--digits", "0"], ["--digits"]),
        (["verify", "--jobs", "0"], ["--jobs"]),
        (["verify", "--frehs"], ["no option --frehs; did you mean --fresh?"]),
        (["verify", "--derivations", "/nowhere"], ["/nowhere is not a folder"]),
        (["verify", "--json", "/nowhere/out.json"], ["cannot write /nowhere/out.json"]),
        (["verify", "--json", "/"], ["cannot write /"]),
        (["verify", "--cluster", "tcp://127.0.0.1:1"], ["distributed"]),
        (["verify", "--cluster", "tcp://127.0.0.1:1", "--derivations", "/tmp"], ["--derivations cannot go"]),
        (["verify", "deon2016"], ["no claim deon2016, but a source: --source deon2016"]),
        (["show"], ["name at least one entry"]),
        (["show", "sigma_ggx"], ["but a quantity: xsec chart sigma_ggx"]),
        (["show", "--derivations", "/nowhere", "a:1"], ["/nowhere is not a folder"]),
        (["show", "deon2016:twenty"], ["no entry deon2016:twenty"]),
        (["show", "--bibtex", "dupuy2061"], ["no entry dupuy2061; did you mean dupuy2016"]),
        (["sohw"], ["no command sohw; did you mean show?"]),
        (["xyzzy"], ["no command xyzzy; there are verify, show"]),
        (["chart", "sigma_gxg"], ["no quantity sigma_gxg; did you mean sigma_ggx?"]),
        (["chart", "sigma_ggx", "--stabilty"], ["no option --stabilty; did you mean --stability?"]),
        (["completion", "bsh"], ["bash"]),
        (["check", "x"], ["Missing argument"]),
        (["check", "x", "x"], ["x has no range"]),
        (["check", "9**9**9", "1"], ["too large to write out"]),
        (["check", "1", "factorial(10**8)"], ["too large to write out"]),
        (["check", "__import__('os')", "1"], ["no function called __import__"]),
        (["check", "x.real", "1", "--where", "x in (0, 1)"], ["a dot after a name"]),
        (["check", "x", "x", "--where", "x in (1, 0)"], ["empty"]),
        (["check", "x", "x", "--where", "x in [0, 1"], ["bracket"]),
        (["check", "x", "x", "--where", "x in (0, 1), x > 2"], ["no x in (0, 1) satisfies"]),
        (["check", "1", "1", "--seconds", "-1"], ["--seconds"]),
        (["check", "1", "1", "--digits", "x"], ["--digits"]),
        (["export", "x", "--dtype", "float16"], ["--dtype"]),
        (["export", "-o", "x.py"], ["name what to export"]),
        (["export", "x", "-o", "/nowhere/x.py"], ["cannot write /nowhere/x.py"]),
    ],
)
def test_every_mistake_is_one_line(arguments, words, mine, monkeypatch):
    if "--cluster" in arguments:
        monkeypatch.setitem(sys.modules, "distributed", None)
    refused(run(*arguments), *words)


def test_a_name_that_cannot_be_exported():
    refused(run("export", "sigma_inv1pu"), "did you mean sigma_inv1pu2")
    refused(run("export", "deon2016:4l"), "did you mean deon2016:4")
    refused(run("export", "sigma_spherical_gausian"), "did you mean sigma_spherical_gaussian ")


def test_a_broken_derivation_is_one_line_and_no_file(mine, tmp_path):
    (tmp_path / "mine" / "paper.py").write_text("import nothing\nthat\nparses")
    refused(run("verify", "--derivations", mine, "--json", tmp_path / "out.json"), "paper", "cannot be imported")
    assert not (tmp_path / "out.json").exists()
    assert sorted(os.listdir(tmp_path)) == ["mine"]


def test_a_broken_record_is_one_line(mine, tmp_path):
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "bad.json").write_text("{")
    refused(run("show", "x"), "bad.json")


# --- show --------------------------------------------------------------------------------------------


def test_show(mine, engine, tmp_path):
    witness = {"point": {"u": "1/3"}, "left": "0.667", "right": "1.000"}
    engine["mine:3"] = Verdict("misprint", 30, witness, {"witnesses": 20, "range": [1, 2], "by": {"a": 1}}, 9, 0.5,
                               ((0, "unfold"), (1, "close")))  # fmt: skip
    run("verify", "--source", "mine", "--derivations", mine, "--record")
    text = run("show", "mine:3", "--derivations", mine).stdout
    said = ["mine:3  a misprint", "misprint: the form in print is refuted", "\n  2*u = 3*u\n", "\n  2*u = 2*u\n"]
    said += ["2 instead of 3", "u in [0, 1]", "u = 1/3", "0.667", "1.000", "9 altered forms", "\n  unfold\n    close"]
    for words in said:
        assert words in text
    assert "mine:1  proved  power 1\n  mine:3  misprint" in run("show", "mine:4", "--derivations", mine).stdout

    several = run("show", "mine:1", "mine:3", "--latex", "--derivations", mine).stdout
    assert "\n\n\nmine:3  a misprint" in several and "\n  2 u = 3 u\n" in several
    listed = run("show", "mine", "--derivations", mine).stdout.splitlines()
    assert [line.split()[:2] for line in listed][2:] == [["mine:3", "misprint"], ["mine:4", "misprint"]]
    cited = run("show", "--bibtex", "mine:3", "dupuy2016", "--derivations", mine).stdout
    assert "@misc{xsec:mine:3," in cited and "Verdict: misprint (2 instead of 3)" in cited
    assert "\n\n@inproceedings{dupuy2016," in cited
    refused(run("show", "--bibtex", "mine", "--derivations", mine), "nothing is known of the source mine")


def test_show_falls_back_on_latex(mine, tmp_path):
    entry = Entry("odd:1", "odd", "1", "odd", "proved", left="L", printed="R", steps=((0, "s" * 300),))
    Ledger(tmp_path / "data").write([entry], {}, order=[])
    assert "printed\n  L = R\n" in run("show", "odd:1").stdout


# --- check -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("verdict", "code"),
    [("proved", 0), ("confirmed", 0), ("refuted", 1), ("inconclusive", 3), ("timeout", 3)],
)
def test_check_exit_codes(verdict, code, monkeypatch):
    witness = {"point": {"u": "1/3"}, "left": "1", "right": "2"} if verdict == "refuted" else None
    said = Verdict(verdict, 30, witness, note="N", steps=((0, "a step"),))
    monkeypatch.setattr("xsec_sym.proof.examine.examine", lambda claim, **kw: said)
    result = run("check", "u", "u", "--where", "u in (0, 1)")
    assert result.exit_code == code and result.stdout.startswith(verdict) and result.stderr == ""
    assert ("u = 1/3" in result.stdout) == (verdict == "refuted")


def test_check_ends_in_time(monkeypatch):
    monkeypatch.setattr("xsec_sym.proof.examine.examine", lambda claim, **kw: time.sleep(60))
    result = run("check", "1", "1", "--seconds", 0.2)
    assert result.exit_code == 3 and "stopped after 0.2 s" in result.stdout


# --- export ------------------------------------------------------------------------------------------


@pytest.fixture
def exporter(monkeypatch):
    class Refusal(ValueError):
        pass

    def module(names, dtype, tick):
        if "bad" in names:
            raise Refusal("bad is not verified:\nno export")
        return f"# {' '.join(names)} {dtype}\n"

    fake = SimpleNamespace(module=module, Refusal=Refusal, available=lambda record: {"sigma": "area"})
    monkeypatch.setitem(sys.modules, "xsec_sym.export", fake)


def test_export(exporter, tmp_path):
    listed = run("export").stdout.splitlines()
    assert listed[:2] == ["# functions that several verified equations make up", "sigma  area"]
    assert all(line.startswith("# ") for line in listed[2:])
    assert run("export", "a", "b", "--dtype", "float32").stdout == "# a b float32\n"
    written = run("export", "a", "-o", tmp_path / "k.py")
    assert (written.exit_code, written.stdout, written.stderr) == (0, "", f"wrote {tmp_path / 'k.py'}\n")
    assert (tmp_path / "k.py").read_text() == "# a float64\n"
    refused(run("export", "bad", "-o", tmp_path / "no.py"), "bad is not verified: no export")
    assert os.listdir(tmp_path) == ["k.py"]


def test_a_kernel_made_by_hand_is_pointed_to():
    refused(run("export", "lambda_beckmann"), "from xsec_sym.kernels import lambda_beckmann; xsec plan writes a module")
    refused(run("export", "smith_g1"), "from xsec_sym.kernels import smith_g1")
    assert guide.made_by_hand("sigma_inv1pu2") == guide.made_by_hand("nothing") == ""


def test_the_list_of_exports_is_grouped_and_easily_searched():
    lines = run("export").stdout.splitlines()
    names = [line for line in lines if not line.startswith("#")]
    assert len(names) > 200 and all(re.match(r"(sigma_\w+|[a-z_0-9]+:\S+) +\S", line) for line in names)
    heads = [line.split()[1].rstrip(":") for line in lines if line.startswith("# ")]
    assert [h for h in heads if h in RECORD.sources] == RECORD.sources
    for key in RECORD.sources:
        own = [k for k, line in enumerate(lines) if line.startswith(f"{key}:")]
        assert own == list(range(own[0], own[0] + len(own))) and lines[own[0] - 1].startswith(f"# {key}: ")
    marked = {line.split()[0] for line in names if line.endswith("  [scipy]")}
    assert "deon2016:31" in marked and not {"deon2016:35", "deon2016:11", "sigma_power"} & marked


def test_export_and_report_take_what_is_one_s_own(mine, engine, exporter, tmp_path, monkeypatch):
    run("verify", "--source", "mine", "--derivations", mine, "--record")
    given = []
    monkeypatch.setattr(
        sys.modules["xsec_sym.export"], "module", lambda names, dtype, record, tick: given.append(record) or ""
    )
    monkeypatch.setattr("xsec_sym.report.build", lambda target, record, tick: given.append(record) or target)
    assert run("export", "mine:1", "--derivations", mine).exit_code == 0
    assert run("report", "--derivations", mine, "-o", tmp_path / "pages").exit_code == 0
    assert [sorted(record) for record in given] == [IDS, IDS]
