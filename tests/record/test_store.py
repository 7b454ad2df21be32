import json

import pytest

from tests.record.conftest import certificate
from xsec_sym.proof.verdict import Verdict
from xsec_sym.record import Entry, Ledger, UnknownEntry, ledger
from xsec_sym.record.store import BrokenRecord


@pytest.fixture
def stored(tmp_path, claims):
    book = Ledger(tmp_path / "data")
    words = {"sample:1": "proved", "sample:2": "confirmed", "sample:3": "misprint", "sample:4": "confirmed"}
    entries = [Entry.of(claims[name], Verdict(word)) for name, word in words.items()]
    book.write(entries, {"sample:1": certificate("sample:1"), "sample:2": None}, order=claims)
    return book


def test_queries(stored):
    assert list(stored) == [f"sample:{k}" for k in (1, 2, 3, 4)] and len(stored) == 4
    assert [e.id for e in stored.source("sample")] == list(stored) and stored.sources == ["sample"]
    assert [e.id for e in stored.by_verdict("confirmed")] == ["sample:2", "sample:4"]
    assert stored.certificate("sample:1") == certificate("sample:1") and stored.certificate("sample:2") is None
    assert "sample:3</td>" in stored._repr_html_() and repr(stored) == "<Ledger: 4 entries of 1 sources>"
    assert "sample:9" not in stored and stored.get("sample:9") is None


def test_the_table_of_a_ledger_tells_verdicts_and_escapes_titles(tmp_path):
    book = Ledger(tmp_path)
    odd = Entry(id="odd:1", source="odd", label="1", title="for u < 0", verdict="claim-fails")
    book.write([odd], {}, order=["odd:1"])
    assert "<td>claim-fails</td>" in book._repr_html_() and "for u &lt; 0" in book._repr_html_()


def test_unknown_names_come_with_suggestions(stored):
    with pytest.raises(UnknownEntry, match=r"^there is no entry sampel:1; did you mean sample:1 or ") as caught:
        stored["sampel:1"]
    assert isinstance(caught.value, KeyError)
    with pytest.raises(UnknownEntry, match="there is no source smaple; did you mean sample"):
        stored.source("smaple")
    with pytest.raises(ValueError, match="not a verdict"):
        stored.by_verdict("certain")


def test_writing_keeps_the_others_and_the_order(stored, claims, tmp_path):
    path = tmp_path / "data" / "sample.json"
    before = path.read_text()
    stored.write([Entry.of(claims["sample:2"], Verdict("proved"))], {}, order=claims)
    after = path.read_text()
    assert [e.verdict for e in stored.values()] == ["proved", "proved", "misprint", "confirmed"]
    changed = [(a, b) for a, b in zip(before.splitlines(), after.splitlines(), strict=True) if a != b]
    assert changed == [('   "verdict": "confirmed",', '   "verdict": "proved",')]
    stored.write([], {}, order=claims, gone=["sample:1"])
    assert "sample:1" not in stored and stored.certificate("sample:1") is None
    assert sorted(p.name for p in path.parent.iterdir()) == ["sample.json", "sample.proofs.json"]


@pytest.mark.parametrize("text", ["{", "[]", '{"entries": [{"id": 1}]}', "{}", '{"entries": 3}'])
def test_a_broken_file_is_named(tmp_path, text):
    (tmp_path / "bad.json").write_text(text)
    with pytest.raises(BrokenRecord, match=r"bad\.json"):
        len(Ledger(tmp_path))


def test_the_project_s_own_record_reads():
    for entry in ledger.values():
        assert Entry.from_json(json.loads(json.dumps(entry.to_json()))) == entry
