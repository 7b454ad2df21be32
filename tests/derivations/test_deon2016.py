"""What the paper's forms and the project's corrections are, as plain text: a tool that changes one is noticed."""

from __future__ import annotations

import pytest
from sympy import Integral, Symbol, symbols

from derivations.deon2016 import (
    beckmann,
    dirac_ring,
    flat_limit,
    ggx,
    kagiwada_kalaba,
    polynomials,
    scope,
    table1,
    table1_reciprocals,
)
from derivations.extensions import circle, ring_lemma, smith_link
from xsec_sym import ledger
from xsec_sym.exact import RingCrossSection
from xsec_sym.proof.claim import REGISTRY
from xsec_sym.proof.say import said
from xsec_sym.proof.verdict import SETTLED

PAPER = (scope, dirac_ring, flat_limit, polynomials, table1, table1_reciprocals, beckmann, ggx, kagiwada_kalaba)
PROJECT = (ring_lemma, circle, smith_link)
ROWS = ["1", "u", "u2", "u4", "even", "odd", "inv1p", "inv1m", "inv1m2", "inv1pu2"]
COLUMNS = ["s1", "s2", "s3", "s"]

# id -> (verdict, the form that holds)
GOLDEN = {
    "deon2016:7": ("proved", "u/2 + Abs(u)/2"),
    "deon2016:14": ("proved", "pi"),
    "deon2016:16": ("proved", "2*pi*u_i/(2 + p)"),
    "deon2016:17": ("proved", "pi*Abs(u_i)/(1 + p/2)"),
    "deon2016:18": ("misprint", "pi*(-1)**(p/2)*(-1 + u_i**2)**(1 + p/2)*Abs(u_i)/(1 + p/2)"),
    "deon2016:T1.1.s3": ("misprint", "pi*(u**2 - Abs(u))"),
    "deon2016:T1.1.s": ("proved", "pi"),
    "deon2016:T1.u2.s3": ("misprint", "-pi*(u**4 - 3*u**2 + 2*Abs(u))/4"),
    "deon2016:T1.u4.s": ("proved", "-pi*(-3 + u**4 - 6*u**2)/24"),
    "deon2016:T1.odd.s": ("proved", "2*pi*u/(2 + p)"),
    "deon2016:T1.inv1p.s2": ("misprint", "2*pi*(1 - Abs(u))"),
    "deon2016:T1.inv1p.s.pos": ("proved", "2*pi*(1 - u*log(1 + 1/u))"),
    "deon2016:T1.inv1p.s.zero": ("proved", "2*pi"),
    "deon2016:T1.inv1p.s.neg": ("divergent", "oo"),
    "deon2016:T1.inv1m.s.pos": ("divergent", "oo"),
    "deon2016:T1.inv1m2.s2.pos": ("proved", "2*pi*(-1 + 1/u)"),
    "deon2016:T1.inv1m2.s2.neg": ("misprint", "2*pi*(-1 + 1/Abs(u))"),
    "deon2016:T1.inv1m2.s2.zero": ("divergent", "oo"),
    "deon2016:T1.inv1pu2.s1": ("misprint", "pi*Abs(u)*log(2)"),
    "deon2016:T1.inv1pu2.s2": ("proved", "2*pi*(-1 + sqrt(2 - u**2))"),
    "deon2016:25": ("proved", "u_i/2 + sqrt(alpha**2 + u_i**2 - alpha**2*u_i**2)/2"),
    "deon2016:27.spread": ("proved", "(1 - sqrt(1 + b**2*(-1 + u_i**2)))/(b*log((1 + b)/(1 - b)))"),
    "deon2016:27.2": (
        "misprint",
        "2*pi*(-1 + sqrt(1 + b**2*(-1 + u_i**2)) + b*u_i + u_i*log(sqrt(1 + b**2*(-1 + u_i**2)) - u_i) - "
        "u_i*log((-1 + u_i)*(-1 - b)))/(b*log(-1 + 2/(1 + b)))",
    ),
    "xsec:mean-over-a-circle": ("proved", "1/sqrt(A**2 - B**2)"),
    "xsec:ring-odd-part": ("proved", "2*pi*u*x"),
}


@pytest.mark.parametrize("name", GOLDEN)
def test_the_form_that_holds_and_its_verdict(name):
    verdict, form = GOLDEN[name]
    assert said(REGISTRY[name].form) == form
    assert ledger[name].verdict == verdict


def test_every_equation_and_cell_has_an_entry_and_none_is_open():
    wanted = [f"deon2016:{k}" for k in range(1, 45)] + ["deon2016:8.piecewise", "deon2016:claim.even-plus-linear"]
    wanted += [f"deon2016:T1.{row}.{column}" for row in ROWS for column in COLUMNS]
    wanted += [
        "xsec:ring-lemma",
        "deon2016:claim.figure-1",
        "deon2016:claim.flat-limit",
        "deon2016:27.1",
        "deon2016:27.2",
    ]
    wanted += ["deon2016:claim.beckmann-lambda", "deon2016:claim.kk-isotropic", "deon2016:claim.blending.ellipsoidal"]
    wanted += [f"xsec:smith.{name}.{side}" for name in ("beckmann", "ggx") for side in ("above", "below")]
    accuracies = ("beckmann-0.001", "40-accuracy", "41-accuracy", "44-accuracy", "twelve-terms")
    wanted += [f"deon2016:claim.{name}" for name in (*accuracies, "sg-beckmann-asymptotic", "sg-isotropic")]
    gaussian = ("ode", "positive", "chebyshev", "second-derivative", "dark", "tail", "terms")
    wanted += [f"xsec:sg-{name}" for name in gaussian]
    for name in wanted:
        assert ledger[name].verdict in SETTLED, name
    assert all(entry.verdict in SETTLED for entry in ledger.values())


def test_the_record_is_of_these_derivations():
    claimed = {c.id for m in PAPER for c in m.paper} | {c.id for m in PROJECT for c in m.project}
    assert claimed <= set(ledger)


@pytest.mark.parametrize("name", [n for n in REGISTRY if n.startswith(("deon2016:", "xsec:"))])
def test_proved_forms_met_enough_mutants(name):
    entry = ledger[name]
    if entry.verdict in ("proved", "confirmed", "misprint", "claim-holds"):
        assert entry.mutants >= 8


def test_a_misprint_shows_where_the_print_fails():
    misprints = [e for e in ledger.values() if e.verdict == "misprint" and not e.parts]
    cells = [
        "1.s1",
        "1.s3",
        "u2.s1",
        "u2.s3",
        "u4.s1",
        "even.s1",
        "inv1p.s2",
        "inv1m.s2",
        "inv1m2.s2.neg",
        "inv1pu2.s1",
    ]
    equations = {f"deon2016:{k}" for k in ("18", "22", "23", "27.1", "27.2")}
    assert {e.id for e in misprints if e.source == "deon2016"} >= {*equations, *(f"deon2016:T1.{c}" for c in cells)}
    for entry in misprints:
        assert entry.witness and entry.edit and entry.printed and entry.corrected, entry.id


def test_the_columns_add_up():
    """s = s1 + s2 + s3 in every row that is finite throughout."""
    u, p = Symbol("u", real=True), Symbol("p", integer=True, nonnegative=True)
    for row in ("1", "u", "u2", "u4", "odd", "inv1pu2"):
        forms = [REGISTRY[f"deon2016:T1.{row}.{c}"].form for c in COLUMNS]
        for value in (0.3, -0.8):
            s1, s2, s3, s = (float(f.subs(p, 3).subs(u, value)) for f in forms)
            assert s1 + s2 + s3 == pytest.approx(s, abs=1e-12), row


def test_the_even_row_is_the_series_of_the_absolute_value():
    """For p = 2n the cross-section is that of |u|, cut off: the truncated row tends to 2 pi |u| / (p + 2)."""
    u, p = Symbol("u", real=True), Symbol("p", integer=True, nonnegative=True)
    form = REGISTRY["deon2016:T1.even.s"].form
    value = form.subs(p, 40).doit().subs(u, 0.9).evalf()
    assert float(value) == pytest.approx(2 * 3.141592653589793 / 42 * 0.9, rel=1e-12)


def test_a_cell_integrates_the_definition():
    u, x = symbols("u x", real=True)
    assert REGISTRY["deon2016:T1.u2.s"].left == Integral(RingCrossSection(x, u) * x**2, (x, -1, 1))
