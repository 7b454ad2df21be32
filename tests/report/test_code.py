"""The code that is kept for the report: up to date, and right at points of the domain."""

import numpy as np
import pytest
from sympy import lambdify

from xsec_sym.export.assemble import closed
from xsec_sym.export.recipes import RECIPES
from xsec_sym.record.store import Ledger
from xsec_sym.report.code import codes, fingerprint, kept

LEDGER = Ledger()
KEPT = kept()
CODES = codes(LEDGER)
SAMPLE = sorted(name for name, code in CODES.items() if code.text and name in KEPT and not LEDGER[name].parts)[::6]


def test_nothing_is_missing_or_out_of_date():
    cells = {name for r in RECIPES.values() for name in (r.cell, *r.ids)}
    wanted = {entry.id for entry, _ in closed(LEDGER)} - cells
    stale = {n for n in wanted if n not in KEPT or KEPT[n]["key"] != fingerprint(LEDGER[n], LEDGER)}
    assert not stale, "run python -m xsec_sym.report.code"
    assert KEPT.keys() == wanted


def test_code_of_another_form_is_not_shown():
    class Other(dict):
        sources = LEDGER.sources

    from dataclasses import replace

    name = SAMPLE[0]
    entry = LEDGER[name]
    side = "printed" if entry.corrected is None else "corrected"
    changed = replace(entry, encoded={**entry.encoded, side: ["int", "7"]})
    assert name in CODES
    assert name not in codes(Other({**LEDGER, name: changed}))


@pytest.mark.parametrize("name", SAMPLE)
def test_it_computes_the_form(name):
    """Against SymPy's own translation to mpmath, at 30 digits."""
    import mpmath

    entry = LEDGER[name]
    space = {}
    exec(CODES[name].text, space)
    function = space[name.replace(":", "_").replace(".", "_").replace("-", "_").lower()]
    symbols = entry.where.symbols
    exact = lambdify(symbols, entry.form, modules="mpmath")
    rng = np.random.default_rng(1)
    tried = 0
    for _ in range(400):
        point = drawn(entry.where, rng)
        if not all(bool(c.subs(dict(zip(symbols, point, strict=True)))) for c in entry.where.conditions):
            continue
        with mpmath.workdps(30):
            expected = complex(exact(*map(mpmath.mpf, point)))
        found = float(function(*point))
        assert np.isclose(found, expected.real, rtol=1e-6, atol=1e-9), point
        tried += 1
        if tried == 12:
            break
    assert tried >= 3


def drawn(domain, rng):
    """A point, the variables with bounds that are numbers first."""
    point = {}
    for v in sorted(domain.variables, key=lambda v: len(v.low.free_symbols | v.high.free_symbols)):
        low, high = (float(end.subs(point)) for end in (v.low, v.high))
        low = low if np.isfinite(low) else min(high, 3.0) - 3.0
        high = high if np.isfinite(high) else max(low, -1.0) + 3.0
        point[v.symbol] = float(low + (high - low) * rng.uniform(0.02, 0.98))
    return [point[s] for s in domain.symbols]
