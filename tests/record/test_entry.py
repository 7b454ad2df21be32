import json

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sympy import Rational, Symbol, oo, pi, sqrt, symbols

from xsec_sym.exact import RingCrossSection
from xsec_sym.proof import Source, integers, interval
from xsec_sym.proof.accuracy import Accuracy
from xsec_sym.proof.domain import Choices
from xsec_sym.proof.verdict import RANK, Verdict
from xsec_sym.record.entry import PUBLIC, Entry
from xsec_sym.record.show import told
from xsec_sym.record.store import Ledger

u, x = symbols("u x", real=True)
n, q = Symbol("n", integer=True), Symbol("q", real=True)


def test_everything_comes_back(source):
    where = [
        interval(u, -1, 1, open="left"),
        interval(x, u, oo),
        integers(n, 2, 8),
        Choices(q, (pi, sqrt(2))),
        u * x > 0,
    ]
    claim = source.claim("7", "a title", left=RingCrossSection(u, x), printed=u**n, corrected=x**n / q, edit="swap",
                         where=where, reading="as printed")  # fmt: skip
    witness = {"point": {"u": "1/2"}, "left": "1.0", "right": "2.0"}
    verdict = Verdict(
        "misprint", 30, witness, {"balls": 20, "range": (1, 2)}, 9, 1.23456, ((0, "one"), (1, "two")), note="N"
    )
    entry = Entry.of(claim, verdict, key="k")
    again = Entry.from_json(json.loads(json.dumps(entry.to_json())))
    assert again == entry
    assert again.form == x**n / q and again.side("printed") == u**n and again.side("left") == RingCrossSection(u, x)
    assert again.where.variables == claim.domain.variables and again.where.conditions == claim.domain.conditions
    assert again.latex("corrected") == r"\sigma_{\delta}\left(u, x\right) = \frac{x^{n}}{q}"
    assert (again.digits, again.mutants, again.seconds, again.steps) == (30, 9, 1.23, ((0, "one"), (1, "two")))
    assert tuple(again.public()) == PUBLIC


@given(
    st.sampled_from(RANK),
    st.none() | st.integers(1, 99),
    st.dictionaries(st.text(), st.none() | st.text() | st.integers() | st.floats() | st.lists(st.booleans())),
    st.text(),
)
def test_any_verdict_comes_back(word, digits, evidence, note):
    claim = Source("sample").claim("any", "", left=u * u, printed=u**2)
    entry = Entry.of(claim, Verdict(word, digits, evidence=evidence, note=note))
    assert Entry.from_json(json.loads(json.dumps(entry.to_json(), allow_nan=False))) == entry


def test_blank_definition_whole_and_out_of_scope(source):
    blank = Entry.of(source.claim("b", "", left=u + u, corrected=2 * u), Verdict("proved"))
    assert blank.printed is None and blank.corrected == "2 u" and blank.form == 2 * u
    defined = Entry.of(source.definition("d", "", left=x, printed=u), Verdict("definition"))
    assert defined.form == u
    scope = Entry.of(source.out_of_scope("o", "", because="a time"), Verdict("out-of-scope"))
    assert scope.left == "" and scope.reading == "a time"
    with pytest.raises(ValueError, match="sample:o has no expression"):
        _ = scope.form
    with pytest.raises(ValueError, match="no side"):
        scope.side("middle")


def test_display(claims):
    entry = Entry.of(claims["sample:2"], Verdict("confirmed", 30, note="<odd>"))
    assert entry._repr_latex_() == r"$\displaystyle u^{3} = u^{3}$"
    assert "&lt;odd&gt;" in entry._repr_html_() and "confirmed" in entry._repr_html_()
    assert str(entry) == "sample:2 (power 2): confirmed" and entry.settled


def test_formulas_are_escaped_in_html():
    """MathJax reads text: a bare "<" before a letter would open a tag."""
    entry = Entry(
        id="s:1", source="s", label="1", title="a<b", verdict="misprint", left="f", printed="x<y", corrected="x<z"
    )
    html = entry._repr_html_()
    assert "<b>misprint</b>" in html and "a&lt;b" in html and "f = x&lt;y" in html and "f = x&lt;z" in html
    assert entry._repr_latex_() == r"$\displaystyle f = x<z$"


def test_only_a_print_is_corrected():
    said = {"id": "s:1", "source": "s", "label": "1", "title": "t", "left": "f", "corrected": "g"}
    for printed, heading in ((None, "statement"), ("h", "corrected")):
        entry = Entry(verdict="claim-fails", printed=printed, **said)
        assert entry.heading("corrected") == heading and f"<th>{heading}</th>" in entry._repr_html_()
        assert f"\n{heading}\n" in told(entry, {})


def test_what_stands_between_the_sides():
    u = Symbol("u", real=True)
    paper = Source("relations")
    equal = paper.claim("1", "", left=u**2, printed=u * u + 0, where=[interval(u, 0, 1)])
    within = Accuracy(Rational(1, 8), None, 0, 1)
    near = paper.approximation("2", "", left=sqrt(1 + u), printed=1 + u / 2, accuracy=within, where=[interval(u, 0, 1)])
    least = paper.inequality("3", "", u**2 + 1, 2 * u, where=[interval(u, 0, 1)])
    entries = [Entry.of(c, Verdict("claim-holds", evidence={"within": "0.125"})) for c in (equal, near, least)]
    assert [e.latex("printed" if e.printed else "corrected") for e in entries] == [
        "u^{2} = u^{2}", r"\sqrt{u + 1} \approx \frac{u}{2} + 1", r"u^{2} + 1 \geq 2 u",
    ]  # fmt: skip
    assert r"\approx" in near.latex() and "=" not in near.latex() and near.latex() in entries[1]._repr_latex_()
    assert "near      within 0.125\n" in told(entries[1], {}) and "near " not in told(entries[0], {})
    for form in ("pretty", "line"):
        signs = [[s for s in "=≈≥" if f" {s} " in told(e, {}, form).split("where")[0]] for e in entries]
        assert signs == [["="], ["≈"], ["≥"]]


def test_the_record_equates_nothing_that_is_only_near():
    told_near = {e.id for e in Ledger().values() if "equal" not in e.evidence.get("within", "equal")}
    assert told_near and told_near == {e.id for e in Ledger().values() if e.relation() == "≈"}


def test_a_whole_of_the_record_counts_its_parts():
    ledger = Ledger()

    def leaves(name):
        parts = ledger[name].parts
        return set().union(*map(leaves, parts)) if parts else {name}

    wholes = [e for e in ledger.values() if e.parts]
    assert len(wholes) > 40
    assert {e.id: e.mutants for e in wholes} == {e.id: sum(ledger[p].mutants for p in leaves(e.id)) for e in wholes}
