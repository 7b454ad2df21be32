"""`xsec new`, and that what it writes is worth beginning with. That it verifies is in tests/docs/test_guide.py."""

import os
import subprocess
import sys

import pytest

from tests.test_cli import refused, run
from xsec_sym.scaffold import module


def test_a_second_section_joins_the_first(tmp_path):
    folder = tmp_path / "paper"
    assert run("new", folder).stdout.startswith(f"{folder}/section.py: try  xsec verify --derivations {folder}")
    assert run("new", folder, "other").exit_code == 0
    assert sorted(os.listdir(folder)) == ["other.py", "section.py"]
    assert (folder / "other.py").read_text() == module("paper", "other")


@pytest.mark.parametrize(
    ("name", "section", "words"),
    [
        ("2014", "smith", "the folder cannot be called 2014"),
        ("my-paper", "smith", "the folder cannot be called my-paper"),
        ("paper", "class", "the section cannot be called class"),
        ("paper", "../smith", "the section cannot be called ../smith"),
        ("deon2016", "smith", "deon2016 is a source of the project"),
        ("taken", "smith", "cannot make the folder"),
    ],
)
def test_what_is_refused_leaves_nothing(name, section, words, tmp_path):
    (tmp_path / "taken").write_text("")
    refused(run("new", tmp_path / name, section), words)
    assert os.listdir(tmp_path) == ["taken"]


def test_nothing_is_written_over(tmp_path):
    run("new", tmp_path / "paper")
    (tmp_path / "paper" / "section.py").write_text("mine")
    refused(run("new", tmp_path / "paper"), "is there already")
    assert (tmp_path / "paper" / "section.py").read_text() == "mine"


def test_the_linter_is_content(tmp_path):
    (tmp_path / "section.py").write_text(module("paper", "section"))
    for words in (["check", "--select", "E,F,W,I,UP,B"], ["format", "--check"]):
        command = [
            sys.executable,
            "-m",
            "ruff",
            *words,
            "--isolated",
            "--no-cache",
            "--line-length",
            "120",
            str(tmp_path / "section.py"),
        ]
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout
