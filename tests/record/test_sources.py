import re

import pytest

from xsec_sym.record.sources import SOURCES, bibtex, tex
from xsec_sym.record.store import Ledger

# What BibTeX's standard styles ask for; of a misc nothing, and here a title.
REQUIRED = {
    "article": {"author", "title", "journal", "year"},
    "inproceedings": {"author", "title", "booktitle", "year"},
    "misc": {"title", "howpublished"},
}


def braced(text, start):
    """What stands in the braces that open here, and where they close."""
    depth = 0
    for place in range(start, len(text)):
        if text[place - 1] != "\\":
            depth += {"{": 1, "}": -1}.get(text[place], 0)
        if depth == 0:
            return text[start + 1 : place], place + 1
    raise AssertionError(f"a brace is never closed: {text[start:]}")


def parsed(text):
    """Every entry as (kind, key, fields). Anything between entries, or between fields, is a mistake."""
    found, place = [], 0
    while head := re.compile(r"\s*@(\w+)(?=\{)").match(text, place):
        body, place = braced(text, head.end())
        key, _, rest = body.partition(",")
        fields, at = {}, 0
        while name := re.compile(r"\s*(\w+)\s*=\s*(?=\{)").match(rest, at):
            assert name[1] not in fields
            fields[name[1]], at = braced(rest, name.end())
            assert rest[at] == ","
            at += 1
        assert rest[at:].strip() == ""
        found.append((head[1], key, fields))
    assert text[place:].strip() == ""
    return found


def sound(kind, key, fields):
    assert REQUIRED[kind] <= set(fields)
    assert re.fullmatch(r"[\w:.+-]+", key, re.ASCII)
    for text in fields.values():
        assert text.strip()
        # outside mathematics nothing is left that TeX takes for its own
        assert not re.search(r"(?<!\\)[&%#_^~<>]", re.sub(r"\$.\$|\\[\^~]\{\}", "", text)), text


def test_the_parser_sees_mistakes():
    assert parsed("@misc{a,\n title = {b {c} \\} d},\n}") == [("misc", "a", {"title": "b {c} \\} d"})]
    for wrong in ("@misc{a, title = {b}", "@misc{a, title = b,}", "@misc{a, title = {b} year = {1},}", "x @misc{a,}"):
        with pytest.raises(AssertionError):
            parsed(wrong)


def test_every_source_of_the_record_can_be_cited():
    assert set(Ledger().sources) <= set(SOURCES)
    found = parsed("\n\n".join(map(bibtex, SOURCES)))
    assert [key for _, key, _ in found] == list(SOURCES)
    for entry in found:
        sound(*entry)


def test_every_verdict_can_be_cited():
    ledger = Ledger()
    found = parsed("\n".join(e.bibtex() for e in ledger.values()))
    assert len({key for _, key, _ in found}) == len(ledger) == len(found)
    for (kind, key, fields), entry in zip(found, ledger.values(), strict=True):
        sound(kind, key, fields)
        assert (
            entry.id in key
            and fields["note"].startswith(f"Verdict: {entry.verdict}")
            and entry.key[:12] in fields["note"]
        )


def test_a_verdict_of_one_s_own_and_one_without_a_paper():
    from xsec_sym.record import Entry

    text = Entry("a b:1%", "a b", "1%", "50 % of {x}", "confirmed", section="2.1", digits=30).bibtex()
    ((kind, key, fields),) = parsed(text)
    sound(kind, key, fields)
    assert key == "xsec:a-b:1-" and fields["note"] == "Verdict: confirmed to 30 digits. On a b, section 2.1"
    assert " On " not in Ledger()["xsec:ring-lemma"].bibtex()


def test_words_for_tex():
    assert tex(r"a\b {c} $d$ é_1") == r"a\textbackslash{}b \{c\} \$d\$ é\_1"
