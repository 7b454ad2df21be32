"""What stands on both sides of a sign, and how near that is: of what fails, no nearness may be said to hold."""

import pytest
from sympy import Integer, Symbol, exp

from xsec_sym.proof import Source, interval
from xsec_sym.proof.verdict import Verdict
from xsec_sym.record import Entry, Ledger
from xsec_sym.record.relation import nearness, sides
from xsec_sym.record.show import told

RECORD = Ledger()
u = Symbol("u", real=True)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("deon2021:28",
         "within 0.5 % of the left side; the largest error found is 0.099 %; the error of the print is 11.4 %"),
        ("deon2016:claim.40-accuracy", "within 0.001; the largest error is 0.000943"),
        ("deon2016:claim.44-accuracy", "said to be within 0.001; the largest error is 0.00103"),
        ("deon2021:claim.energy", "said to be within 0.01; the largest error found is 0.0211"),
        ("deon2021:7", "no accuracy is stated; the largest error found is 0.000574"),
        ("deon2016:18", ""),
        ("deon2021:38.A", ""),
    ],
)  # fmt: skip
def test_how_near(name, words):
    assert nearness(RECORD[name]) == words
    assert ("\nnear " in told(RECORD[name], RECORD)) == bool(words)


def test_the_sides_of_an_inequality_are_those_whose_difference_was_shown():
    found = [e for e in RECORD.values() if e.relation("corrected") == "≥"]
    assert len(found) > 20 and "xsec:sel-three-quarters" in {e.id for e in found}
    for entry in found:
        greater, lesser = sides(entry, "corrected")
        assert greater - lesser == entry.form == entry.side("left").args[0], entry.id
        assert entry.latex("corrected").count(r"\geq") == 1
        assert "Magnitude" not in told(entry, RECORD, "line").partition("\n\nwhere")[0]
    assert "\n  besseli(j, z) ≥ besseli(j + 1, z)\n" in told(RECORD["xsec:bessel-order"], RECORD, "line")


def test_inequalities_of_one_term_and_of_a_sign():
    source = Source("signs")
    for label, gap, shown in (("a", exp(u), (exp(u), 0)), ("b", -exp(u), (-exp(u), 0)), ("c", 1 - u, (Integer(1), u))):
        claim = source.inequality(label, "t", gap, where=[interval(u, 0, 1)])
        assert sides(Entry.of(claim, Verdict("claim-holds")), "corrected") == shown


def test_what_has_no_expression_falls_back_on_latex():
    entry = Entry(id="r:1", source="r", label="1", title="t", verdict="claim-holds", kind="statement",
                  left=r"\left|{x}\right|", corrected="x")  # fmt: skip
    assert entry.latex("corrected") == r"x \geq 0" and "statement\n  x \\geq 0" in told(entry, {}, "line")


def test_the_sign_stands_on_the_line_of_both_sides():
    text = told(RECORD["deon2021:29"], RECORD, "pretty", 110)
    assert text.count("\n  H^(1)(μ, 1) ≈ ℯ ") == 2, "not beside the exponent"
