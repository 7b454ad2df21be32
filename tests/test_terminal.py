"""What is seen on a terminal and not in a pipe, what a shell completes, and how Ctrl-C leaves."""

import contextlib
import io
import os
import pty
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from xsec_sym import complete, terminal
from xsec_sym.cli import main
from xsec_sym.record import Ledger

XSEC = [sys.executable, "-m", "xsec_sym.cli"]
PLAIN = {k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "FORCE_COLOR")} | {"TERM": "xterm-256color"}


def on_a_terminal(*arguments, **environment):
    """What a terminal of 200 columns is sent."""
    ours, theirs = pty.openpty()
    environment = {**PLAIN, "COLUMNS": "200", "PYTHONIOENCODING": "utf-8", **environment}
    with subprocess.Popen([*XSEC, *arguments], stdout=theirs, stderr=theirs, env=environment):
        os.close(theirs)
        said = b""
        # the end of what a closed terminal says is an error
        with contextlib.suppress(OSError):
            while more := os.read(ours, 65536):
                said += more
    os.close(ours)
    return said.decode()


def piped(*arguments, **environment):
    return subprocess.run([*XSEC, *arguments], capture_output=True, text=True, env={**PLAIN, **environment})


# --- colour and formulas ---------------------------------------------------------------------------------


def test_colour_and_typeset_formulas_on_a_terminal():
    said = on_a_terminal("show", "deon2016:18")
    assert "\x1b[33m\x1b[1mmisprint\x1b[0m: the form in print is refuted" in said
    assert "⎛  2    ⎞" in said and "Integral" not in said


@pytest.mark.parametrize("environment", [{"NO_COLOR": "1"}, {"TERM": "dumb"}, {"NO_COLOR": "1", "FORCE_COLOR": "1"}])
def test_no_colour_where_none_is_wanted(environment):
    said = on_a_terminal("show", "--latex", "deon2016:18", **environment)
    assert "misprint: the form" in said and "\x1b" not in said


def test_a_pipe_gets_one_line_a_formula_and_no_escapes():
    done = piped("show", "deon2016:18")
    assert "\x1b" not in done.stdout + done.stderr and done.stdout.count("  Integral(-2*pi*u*u**p") == 2
    assert "\x1b[33m" in piped("show", "--latex", "deon2016:18", FORCE_COLOR="1").stdout


def test_a_terminal_without_unicode():
    said = on_a_terminal("show", "kenha2018:1", PYTHONIOENCODING="latin-1")
    assert "GGX" in said and "Traceback" not in said and "⎛" not in said
    near = on_a_terminal("show", "deon2021:30", PYTHONIOENCODING="latin-1")
    assert near.count("H^(1)(1, c) ~= exp(") == 2 and "?" not in near


def test_beside_below_or_in_lines():
    from xsec_sym.record.show import told

    entry = Ledger()["deon2016:18"]
    beside, below, lines = (told(entry, {}, "pretty", wide).partition("change")[0] for wide in (200, 60, 30))
    assert "⎛" in beside and "⎛" in below and "⎛" not in lines and "  Integral(" in lines
    assert "\n  =\n" in below and "\n  =\n" not in beside
    assert max(len(line) for line in below.splitlines() if line.startswith("  ")) <= 60 + 2


# --- progress --------------------------------------------------------------------------------------------


class Screen(io.StringIO):
    def isatty(self):
        return True


def test_progress_names_what_is_done_and_the_time_left(monkeypatch):
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "120")
    monkeypatch.setattr(sys, "stderr", Screen())
    with terminal.progress("reading") as steps:
        steps.bar.refresh()
        steps.expect(3, 10.0)
        steps.now("deon2016:[a]", "deon2016:9")
        steps.bar.refresh()
        time.sleep(0.02)
        steps.done(4.0)
        time.sleep(0.02)
        steps.done(4.0)
        steps.bar.refresh()
    said = sys.stderr.getvalue()
    assert "0/?" in said and "left  reading" in said
    assert (
        "0/3" in said and "left  deon2016:[a], deon2016:9" in said and re.search(r"2/3 .*\d:\d\d:\d\d\S* left ", said)
    )


def test_each_step_ends_the_one_before(monkeypatch):
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(sys, "stderr", Screen())
    with terminal.progress(count=2) as steps:
        steps.next("first")
        assert steps.bar.tasks[0].completed == 0
        steps.next("second")
        assert (steps.bar.tasks[0].completed, steps.bar.tasks[0].description) == (1, "second")


def test_no_progress_in_a_pipe(capsys):
    with terminal.progress("reading", 2) as steps:
        steps.expect(2)
        steps.next("first")
        steps.done()
    assert capsys.readouterr() == ("", "")


def test_progress_is_told_as_often_as_expected(tmp_path, monkeypatch):
    from xsec_sym.planner import Scene, planning
    from xsec_sym.study import measure

    seen = []
    for unneeded in ("right", "_conditioned", "_measured", "mark_pareto"):
        monkeypatch.setattr(measure, unneeded, lambda *given: [0])
    monkeypatch.setattr(measure.clock, "yardsticks", lambda n: {})
    measure.measure("sel", tick=seen.append)
    assert len(seen) == measure.steps("sel") and seen[0] == "references, bulk, float64"

    seen.clear()
    scene = Scene.of({"material": [{"name": "matt", "quantity": "sel", "tolerance": 0.1, "alpha_x": 1, "alpha_y": 1}]})
    planning.plan(scene, tick=seen.append)
    assert len(seen) == planning.steps(scene, False) == 1


# --- completion ------------------------------------------------------------------------------------------


def completed(line, shell="bash", word=""):
    words = {
        "COMP_WORDS": line,
        "COMP_CWORD": word or str(len(line.split()) - 1),
        "_XSEC_COMPLETE": f"{shell}_complete",
    }
    return piped(**words).stdout.splitlines()


def values(line):
    return [said.partition(",")[2] for said in completed(line)]


def test_what_is_completed():
    assert values("xsec ver") == ["verify"]
    assert values("xsec verify --s") == ["--source", "--seed"]
    ids = values("xsec show deon2016:1")
    assert set(ids) == {name for name in Ledger() if name.startswith("deon2016:1")} and "deon2016:18" in ids
    assert values("xsec verify deon2016:9 --source ken") == ["kenha2018"]
    assert values("xsec show tokuyoshi_harada:1")[0].startswith("tokuyoshi_harada:1")
    assert "sigma_ggx" in values("xsec chart sigma_")
    assert {"sigma_power", "sigma_inv1pu2"} < set(values("xsec export sigma_"))
    assert values("xsec export deon2016:27.2") == ["deon2016:27.2"]
    assert completed("xsec plan ex") == ["file,ex"] and completed("xsec report -o ex") == ["dir,ex"]
    assert values("xsec completion ") == ["bash", "zsh", "fish"]


def test_other_shells_are_told_the_titles():
    assert r"deon2016\:18" in completed("xsec show deon2016:18", "zsh")
    assert completed("xsec show deon2016:18", "fish", "deon2016:18")[0].startswith("plain,deon2016:18\tmisprint: ")


def test_ids_of_one_s_own_are_completed(tmp_path):
    Ledger(tmp_path / "record").write(
        [Ledger()["kenha2018:1"].__class__("own:1", "own", "1", "t", "proved")], {}, order=[]
    )
    assert values(f"xsec show --derivations {tmp_path} own") == ["own", "own:1"]


@pytest.mark.parametrize("line", ["xsec show d", "xsec export d", "xsec verify --source d", "xsec chart s"])
def test_completion_is_quick(line):
    code = f"""import sys
from xsec_sym.cli import main
try:
    main([])
except SystemExit:
    print([m for m in ("sympy", "scipy", "matplotlib", "rich") if m in sys.modules], {line!r})"""
    environment = PLAIN | {"COMP_WORDS": line, "_XSEC_COMPLETE": "bash_complete"}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment)
    assert done.stdout.count("\n") > 1 and done.stdout.endswith(f"[] {line}\n")


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_the_scripts(shell):
    script = complete.script(shell, main, "_XSEC_COMPLETE")
    assert re.search(rf"_XSEC_COMPLETE[= ]{shell}_complete", script) and "xsec" in script


def test_how_to_switch_it_on_is_told_on_a_terminal():
    assert on_a_terminal("completion", "fish").endswith(
        "# to switch it on: xsec completion fish > ~/.config/fish/completions/xsec.fish\r\n"
    )
    assert "switch it on" not in piped("completion", "zsh").stdout + piped("completion", "zsh").stderr


@pytest.fixture
def asked(tmp_path):
    """What a shell prints that has completion switched on, and `xsec` on its path."""
    (tmp_path / "xsec").write_text(f'#!/bin/sh\nexec "{sys.executable}" -m xsec_sym.cli "$@"\n')
    (tmp_path / "xsec").chmod(0o755)
    environment = {**PLAIN, "PATH": f"{tmp_path}:{os.environ['PATH']}", "HOME": str(tmp_path)}

    def ask(shell, *lines):
        if shutil.which(shell[0]) is None:
            pytest.skip(f"{shell[0]} is not installed")
        done = subprocess.run([*shell, "-c", "\n".join(lines)], capture_output=True, text=True, env=environment)
        assert done.stderr == ""
        return done.stdout.splitlines()

    return ask


def test_bash_itself(asked):
    lines = ["xsec show deon2016:T1.u2.s", "xsec sho", "xsec show 'deon2016:T1.u2.s1"]
    tried = [
        f'COMP_LINE="{a}"; COMP_POINT=${{#COMP_LINE}}; _xsec_completion xsec; echo "${{COMPREPLY[*]}}"' for a in lines
    ]
    assert asked(["bash", "--norc"], 'eval "$(xsec completion bash)"', "complete -p xsec", *tried) == [
        "complete -o nosort -F _xsec_completion xsec",
        "T1.u2.s1 T1.u2.s2 T1.u2.s3 T1.u2.s",
        "show",
        "deon2016:T1.u2.s1",
    ]


def test_fish_itself(asked):
    tried = [f'complete -C "{line}"' for line in ("xsec sho", "xsec show deon2016:T1.u2.s")]
    found = asked(["fish", "--no-config"], "xsec completion fish | source", *tried)
    assert [line.partition("\t")[0] for line in found] == [
        "show", "deon2016:T1.u2.s1", "deon2016:T1.u2.s2", "deon2016:T1.u2.s3", "deon2016:T1.u2.s",
    ]  # fmt: skip
    assert "Table 1: x**2, column s1" in found[1], "a comma does not end what is said"


def test_zsh_itself(asked):
    """With the two functions of its own by which zsh is told of completions, which want a line editor."""
    tried = ["words=(xsec sho); CURRENT=2; _xsec_completion",
             "words=(xsec show deon2016:T1.u2.s); CURRENT=3; _xsec_completion"]  # fmt: skip
    found = asked(["zsh", "-f"], "compdef() { true }", 'compadd() { print -rl -- "${completions[@]}" }',
                  '_describe() { print -rl -- "${completions_with_descriptions[@]}" }',
                  'eval "$(xsec completion zsh)"', *tried)  # fmt: skip
    assert found[0].startswith("show:") and len(found) == 5
    assert [line.replace("\\:", "").split(":")[0] for line in found[1:]] == [
        "deon2016T1.u2.s1", "deon2016T1.u2.s2", "deon2016T1.u2.s3", "deon2016T1.u2.s",
    ]  # fmt: skip


@pytest.mark.parametrize("arguments", [["show", "deon2016"], ["export"], ["--help"], []])
def test_a_reader_who_leaves_early_is_no_mistake(arguments):
    with subprocess.Popen([*XSEC, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=PLAIN) as left:
        left.stdout.close()
        assert left.wait(60) == 141 and left.stderr.read() == b""


def test_a_reader_who_leaves_early_of_colours_or_of_a_mistake():
    for arguments, code in ((["verify", "deon2016:9", "--jobs", "1"], 141), (["nothing"], 2)):
        read, write = os.pipe()
        os.close(read)
        environment = {**PLAIN, "FORCE_COLOR": "1"}
        with subprocess.Popen([*XSEC, *arguments], stdout=write, stderr=write, env=environment) as left:
            os.close(write)
            assert left.wait(60) == code


# --- Ctrl-C ----------------------------------------------------------------------------------------------

SLOW = """import time
from sympy import Symbol
from xsec_sym.proof import Source, interval
u = Symbol("u", real=True)
paper = Source("mine", section="1")
for k in (1, 2, 3):
    claim = paper.claim(str(k), f"slow {k}", left=u * u**k, printed=u ** (k + 1), where=[interval(u, 0, 1)])
    claim.proof(lambda step: time.sleep(60))
"""


def children(pid):
    found = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    return [int(child) for child in found]


def interrupted(folder, *arguments, ready):
    """What is left of a command that SIGINT met when it was ready: its exit code, what it said, its processes."""
    with subprocess.Popen([*XSEC, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=folder,
                          env=PLAIN | {"PYTHONPATH": str(Path(__file__).parent.parent)}) as process:  # fmt: skip
        until = time.monotonic() + 120
        while not ready(process.pid) and process.poll() is None and time.monotonic() < until:
            time.sleep(0.02)
        time.sleep(0.2)
        begun = children(process.pid) if process.poll() is None else []
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=20)
    until = time.monotonic() + 5
    while (left := [child for child in begun if Path(f"/proc/{child}").exists()]) and time.monotonic() < until:
        time.sleep(0.05)
    return process.returncode, said, begun, left


@pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="processes are found through /proc")
@pytest.mark.parametrize(
    "arguments",
    [
        ["verify", "--derivations", "mine", "--source", "mine", "--jobs", "2", "--json", "out.json"],
        ["chart", "sel", "--measure", "--jobs", "2", "-o", "out.svg"],
    ],
)
def test_ctrl_c_leaves_one_line_and_nothing_else(arguments, tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "paper.py").write_text(SLOW)
    code, said, begun, left = interrupted(tmp_path, *arguments, ready=lambda pid: len(children(pid)) >= 2)
    assert (code, said) == (130, "xsec: interrupted\n")
    assert len(begun) >= 2 and left == []
    assert [p for p in os.listdir(tmp_path) if p != "mine"] == [] and not (tmp_path / "mine" / "record").exists()
