"""What stands between the sides of an entry: a reader must be told what was shown of them."""

import re

import pytest
from sympy import Integer, Symbol, exp

from xsec_sym.proof import Source, interval
from xsec_sym.proof.verdict import Verdict
from xsec_sym.record import Entry, Ledger
from xsec_sym.record.relation import EQUAL, LEAST, NEAR, nearness, sides, sign
from xsec_sym.record.show import told

RECORD = Ledger()
u = Symbol("u", real=True)


def stated(entry):
    return "printed" if entry.corrected is None else "corrected"


@pytest.fixture
def source():
    return Source("related")


def test_what_is_judged_by_its_error_is_near_and_nothing_else():
    near = {e.id for e in RECORD.values() if sign(e) == NEAR}
    assert near == {e.id for e in RECORD.values() if e.kind in ("approximation", "accuracy")}
    assert {"deon2021:28", "deon2016:claim.44-accuracy", "deon2016:40", "deon2021:37"} < near
    for name in near:
        entry = RECORD[name]
        for side in ("printed", "corrected"):
            if getattr(entry, side) is not None:
                assert entry.latex(side) == rf"{entry.left} \approx {getattr(entry, side)}"
        assert r" \approx " in entry._repr_latex_() and r" \approx " in entry._repr_html_()
    assert all(r"\approx" not in e.latex(stated(e)) for e in RECORD.values() if e.id not in near)


@pytest.mark.parametrize("form", ["pretty", "line", "latex"])
def test_every_form_of_a_text_says_near(form):
    for name in ("deon2021:28", "deon2016:claim.44-accuracy", "deon2021:30"):
        text = told(RECORD[name], RECORD, form, 200)
        formulas = re.findall(r"^(?:printed|corrected)[^\n]*\n((?:  [^\n]*\n)+)", text, re.M)
        assert len(formulas) == 1 + (RECORD[name].corrected is not None)
        for formula in formulas:
            assert (r"\approx" if form == "latex" else NEAR) in formula and " = " not in formula
    below = told(RECORD["deon2021:39"], RECORD, "pretty", 70)
    assert f"\n  {NEAR}\n" in below and "\n  =\n" not in below


def test_the_sign_stands_on_the_line_of_both_sides():
    text = told(RECORD["deon2021:29"], RECORD, "pretty", 110)
    assert text.count(f"\n  H^(1)(μ, 1) {NEAR} ℯ ") == 2, "not beside the exponent"


@pytest.mark.parametrize(
    ("name", "side", "words"),
    [
        ("deon2021:28", "printed", "said to be within 0.5 % of the left side; off by up to 11.4 %"),
        ("deon2021:28", "corrected", "within 0.5 % of the left side; the largest error found is 0.099 %"),
        ("deon2016:claim.40-accuracy", "printed", "within 0.001; the largest error is 0.000943"),
        ("deon2016:claim.44-accuracy", "printed", "said to be within 0.001; the largest error is 0.00103"),
        ("deon2021:39", "corrected", "the largest error found is 0.00421; no accuracy is stated"),
        ("deon2016:18", "printed", ""),
        ("deon2021:38.A", "printed", ""),
    ],
)
def test_how_near(name, side, words):
    assert nearness(RECORD[name], side) == words
    heading = RECORD[name].heading(side)
    assert heading == (f"{side}, {words}" if words else side)
    assert f"\n\n{heading}\n  " in told(RECORD[name], RECORD, "line")


def test_an_inequality_is_told_as_one():
    found = [e for e in RECORD.values() if sign(e) == LEAST]
    assert len(found) > 20 and {"xsec:bessel-order", "xsec:sel-three-quarters"} < {e.id for e in found}
    for entry in found:
        greater, lesser = sides(entry, stated(entry))
        # the two sides are those whose difference was shown to be its own magnitude
        assert greater - lesser == entry.form and entry.side("left").args[0] == entry.form, entry.id
        text = entry.latex(stated(entry))
        assert text.count(r"\geq") == 1 and not text.startswith(r"\left|")
        assert "Magnitude" not in told(entry, RECORD, "line").partition("\n\nwhere")[0]
    assert "\n  besseli(j, z) >= besseli(j + 1, z)\n" in told(RECORD["xsec:bessel-order"], RECORD, "line")


def test_inequalities_of_one_term_and_of_a_sign(source):
    for label, gap, shown in (("a", exp(u), (exp(u), 0)), ("b", -exp(u), (-exp(u), 0)), ("c", 1 - u, (Integer(1), u))):
        claim = source.inequality(label, "t", gap, where=[interval(u, 0, 1)])
        assert sides(Entry.of(claim, Verdict("claim-holds")), "corrected") == shown


def test_what_looks_like_an_inequality_and_is_an_equation(source):
    claim = source.claim(
        "e", "t", left=abs(u), printed=u, corrected=abs(u) * 1, edit="bars", where=[interval(u, -1, 1)]
    )
    entry = Entry(id="r:1", source="r", label="1", title="t", verdict="misprint", left="f", printed="g", corrected="h")
    assert sign(entry) == EQUAL and entry.latex() == "f = g"
    assert Entry.of(claim, Verdict("misprint")).latex() == r"\left|{u}\right| = u"


def test_what_has_no_expression_falls_back_on_latex():
    entry = Entry(id="r:1", source="r", label="1", title="t", verdict="claim-holds", kind="statement",
                  left=r"\left|{x}\right|", corrected="x")  # fmt: skip
    assert entry.latex("corrected") == r"x \geq 0" and "statement\n  x \\geq 0" in told(entry, {}, "line")
