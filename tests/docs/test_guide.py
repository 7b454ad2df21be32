"""The guides are followed to the letter, from an empty folder, and must print what they say."""

import re

import pytest

from tests.docs import replay
from xsec_sym.proof import Refused, Source, Step
from xsec_sym.proof.steps import derive

DOCS = replay.ROOT / "docs"


@pytest.mark.parametrize("name", ["add_your_own_paper.md", "proof_moves.md"])
def test_what_a_guide_prints_is_what_comes_out(name, tmp_path, monkeypatch):
    monkeypatch.setattr("os.cpu_count", lambda: 1)
    page = (DOCS / name).read_text(encoding="utf-8")
    codes = {}
    found = replay.replayed(page, tmp_path, codes)
    assert replay.timeless(found) == replay.timeless(page)
    # what the guide says of exit codes: the slip is refuted
    assert {command: code for command, code in codes.items() if code} == (
        {
            "xsec verify --derivations heitz2014 heitz2014:slip heitz2014:slip.mended": 1,
        }
        if name.startswith("add")
        else {}
    )


def test_the_refusal_that_the_guide_quotes(monkeypatch):
    monkeypatch.setattr("xsec_sym.proof.claim.REGISTRY", {})
    page = (DOCS / "add_your_own_paper.md").read_text(encoding="utf-8")
    files = [b for b in replay.BLOCK.finditer(page) if b[3] == "heitz2014/smith.py"]
    module = {"__name__": "smith"}
    exec("".join(b[4] for b in files).replace("antiderivative(-(1 + a", "antiderivative((1 + a"), module)
    quoted = re.search(r"^```text\n.* does not go through: (.*)\n```$", page, re.M)[1]
    with pytest.raises(Refused, match=f"^{re.escape(quoted)}$"):
        derive(module["ggx"], {})


def test_a_changed_page_would_be_noticed(tmp_path):
    page = "```python a.py\nprint(1)\n```\n\n```console\n$ python a.py\n2\n```\n"
    assert replay.replayed(page, tmp_path, {}) == page.replace("\n2\n", "\n1\n")


def test_every_move_is_on_the_page():
    rows = re.findall(r"^\| (`.*?) \|", (DOCS / "proof_moves.md").read_text(encoding="utf-8"), re.M)
    listed = {name for row in rows for name in re.findall(r"`([a-z_]+)", row)}
    assert listed == {name for name in [*vars(Step), "left", "right"] if not name.startswith("_")}


def test_every_kind_of_claim_is_in_the_guide():
    rows = re.findall(r"^\| (`.*?) \|", (DOCS / "add_your_own_paper.md").read_text(encoding="utf-8"), re.M)
    listed = {name for row in rows for name in re.findall(r"`([a-z_]+)", row)}
    assert listed == {name for name in vars(Source) if not name.startswith("_")} - {"tell"}
