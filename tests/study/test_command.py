"""`xsec chart`: what it writes, and one line for what it cannot do."""

import json

import pytest
from click.testing import CliRunner

from xsec_sym.cli import main
from xsec_sym.study.method import HOMES

NAME = "sigma_spherical_gaussian"


def run(*arguments):
    return CliRunner().invoke(main, ["chart", *map(str, arguments)])


def test_a_table_on_the_terminal():
    said = run(NAME)
    assert said.exit_code == 0
    assert "Tokuyoshi 2024" in said.output and "max rel" in said.output


def test_without_a_name_the_quantities_are_listed():
    said = run()
    assert said.exit_code == 0
    assert said.output.split() == list(HOMES)


@pytest.mark.parametrize(
    ("options", "start"), [(("-o", "a.svg"), b"<?xml"), (("--stability", "-o", "b.png"), b"\x89PNG")]
)
def test_pictures(tmp_path, options, start):
    *flags, name = options
    assert run(NAME, *flags, tmp_path / name).exit_code == 0
    assert (tmp_path / name).read_bytes().startswith(start)
    assert [p.name for p in tmp_path.iterdir()] == [name]


def test_data(tmp_path):
    run(NAME, "-o", tmp_path / "a.json")
    data = json.loads((tmp_path / "a.json").read_text())
    assert {"quantity", "machine", "yardsticks", "points"} <= data.keys()
    keys = "method parameters dtype n ns_median ns_q1 ns_q3 setup_s max_rel p99_rel max_abs max_ulp failures pareto"
    assert all(set(keys.split()) <= row.keys() for row in data["points"])
    assert {"np.exp", "copy"} <= data["yardsticks"].keys()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("sigma_spherical_gausian",), "did you mean sigma_spherical_gaussian"),
        ((NAME, "-o", "a.pdf"), "must end in .svg, .png, .json"),
        ((NAME, "-o", "no/such/folder/a.svg"), "cannot write no/such/folder/a.svg"),
        ((NAME, "--stability"), "give -o a file"),
        (("-o", "a.svg"), "name the quantity"),
        ((NAME, "--stability", "-o", "a.json"), "give -o a file"),
    ],
)
def test_what_cannot_be_done_is_one_line(tmp_path, monkeypatch, arguments, said):
    monkeypatch.chdir(tmp_path)
    result = run(*arguments)
    assert result.exit_code == 2
    assert said in result.output and result.output.count("\n") == 1
    assert not list(tmp_path.iterdir())
