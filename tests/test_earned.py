"""What stands in for a full verification in a test must still tell right from wrong, and know when it may stand in."""

import pytest
from sympy import Symbol, cos

from derivations.deon2016 import dirac_ring, table1  # noqa: F401  (claims, and their lemmas)
from derivations.dupuy2016 import free_path  # noqa: F401
from tests import earned
from xsec_sym import ledger
from xsec_sym.proof import REGISTRY, Source, interval
from xsec_sym.record.key import Keys

u = Symbol("u", real=True)


@pytest.fixture
def source():
    before = dict(REGISTRY)
    yield Source("sample")
    REGISTRY.clear()
    REGISTRY.update(before)


def square_of_the_sine(source, factor):
    return source.claim(f"{factor}", "sine", left=1 - cos(u) ** 2, printed=factor - factor * cos(u) ** 2,
                        where=[interval(u, 0, 1)])  # fmt: skip


def test_what_is_not_recorded_is_verified_in_full(source):
    """A claim without a proof: 20 witnesses, and the one that does not hold is refuted."""
    right, wrong = square_of_the_sine(source, 1), square_of_the_sine(source, 2)
    assert not earned.recorded(right) and not earned.recorded(wrong)
    assert earned.earned(wrong, deep=False).verdict == "refuted"


def test_any_change_of_the_claim_is_seen(monkeypatch):
    claim = REGISTRY["deon2016:T1.u2.s"]
    if not earned.recorded(claim):
        pytest.skip("the record is older than the code, and every verdict is earned in full")
    monkeypatch.setattr(earned, "keys", lambda: Keys(REGISTRY))
    monkeypatch.setattr(claim, "printed", 2 * claim.printed)
    assert not earned.recorded(claim)


@pytest.mark.parametrize("name", ["deon2016:T1.u2.s", "dupuy2016:claim.any-free-path"])
def test_a_few_witnesses_see_a_wrong_form(name, monkeypatch):
    """With a recorded proof and without: even if the key were blind, a form that is off by 1 in 1000 does not pass."""
    claim = REGISTRY[name]
    monkeypatch.setattr(earned, "recorded", lambda claim: True)
    assert earned.earned(claim, deep=False).verdict == ledger[name].verdict
    side = "corrected" if claim.corrected is not None else "printed"
    changed = getattr(claim, side) * 1001 / 1000 if claim.kind == "equation" else claim.left
    monkeypatch.setattr(claim, side, changed)
    assert earned.earned(claim, deep=False).verdict != ledger[name].verdict


def test_what_is_replayed_has_the_mutants_of_the_record():
    name = "deon2016:T1.u2.s"
    assert earned.earned(REGISTRY[name], deep=False).mutants >= 8
