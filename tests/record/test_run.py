import os
import time
from dataclasses import replace

import pytest

from tests.record.conftest import certificate
from xsec_sym.proof.verdict import Verdict
from xsec_sym.record import Entry, Ledger
from xsec_sym.record.cluster import NoCluster, batch, pack, remote, verdict
from xsec_sym.record.key import Keys
from xsec_sym.record.run import Job, Settings, differences, rest_on_lemmas, to_record, verify_all, whole

ONE, TWO, THREE, BOTH = (f"sample:{k}" for k in (1, 2, 3, 4))


@pytest.fixture
def ledger(tmp_path):
    return Ledger(tmp_path)


def record(ledger, claims, results):
    ledger.write(*to_record(results, ledger), order=claims)


def proved(name, *lemmas):
    return Verdict("proved", certificate=certificate(name, *lemmas))


def words(results):
    return {r.entry.id: r.entry.verdict for r in results}


def test_a_whole_brings_its_parts_and_carries_the_worst(claims, ledger, engine):
    engine[TWO] = Verdict("confirmed", digits=30)
    seen = []
    running = []
    results = verify_all(claims, [BOTH], ledger, Settings(), tick=lambda name, _: seen.append(name), now=running.append)
    assert running == [[ONE], [TWO], []]
    assert words(results) == {ONE: "proved", TWO: "confirmed", BOTH: "confirmed"}
    assert sorted(seen) == [ONE, TWO, BOTH]
    verify_all(claims, [ONE, TWO, THREE], ledger, Settings(jobs=2), now=running.append)
    assert [len(ids) for ids in running[3:]] == [2, 2, 1, 0] and set(running[3]) == {ONE, TWO}


def test_replay_where_nothing_changed_and_anew_where_something_did(claims, ledger, engine):
    engine[ONE], engine[TWO] = proved(ONE), proved(TWO)
    first = verify_all(claims, claims, ledger, Settings())
    assert all(r.entry.evidence["witnesses"] == 20 for r in first if r.entry.id != BOTH)
    record(ledger, claims, first)
    claims[TWO].printed += 0 * claims[TWO].printed + 1
    second = {r.entry.id: r for r in verify_all(claims, claims, ledger, Settings())}
    assert second[ONE].entry.evidence == {"witnesses": 4, "replayed": True}
    assert second[TWO].entry.evidence == {"witnesses": 20, "replayed": False}
    assert second[THREE].entry.evidence["witnesses"] == 20, "it has no certificate to replay"
    assert second[ONE].certificate == certificate(ONE)
    fresh = verify_all(claims, [ONE], ledger, Settings(fresh=True))
    assert fresh[0].entry.evidence["witnesses"] == 20


def test_a_replay_leaves_the_record_alone(claims, ledger, engine, tmp_path):
    engine[ONE], engine[TWO] = replace(proved(ONE), mutants=24), Verdict("proved", mutants=9)
    record(ledger, claims, verify_all(claims, claims, ledger, Settings()))
    before = (tmp_path / "sample.json").read_text()
    assert ledger[BOTH].mutants == 33, "a replay tries no mutants, and the whole keeps those of its parts"
    for settings in (Settings(), Settings(fresh=True)):
        record(ledger, claims, verify_all(claims, claims, ledger, settings))
        assert (tmp_path / "sample.json").read_text() == before


def test_failures_and_limits_are_verdicts(claims, ledger, engine):
    def fail():
        raise TypeError("odd")

    engine[ONE], engine[TWO], engine[THREE] = fail, lambda: time.sleep(60), lambda: os._exit(1)
    results = verify_all(claims, claims, ledger, Settings(seconds=0.5, jobs=2))
    assert words(results) == {ONE: "inconclusive", TWO: "timeout", THREE: "timeout", BOTH: "timeout"}
    assert results[0].entry.note == "TypeError: odd"


@pytest.mark.parametrize("lemma", ["confirmed", "inconclusive", "timeout", "definition", "misprint", "claim-holds"])
def test_a_proof_is_as_good_as_its_lemmas(claims, ledger, engine, lemma):
    engine[TWO], engine[ONE] = Verdict(lemma), proved(ONE, TWO)
    found = {r.entry.id: r.entry for r in verify_all(claims, [ONE, TWO], ledger, Settings())}
    assert (found[ONE].verdict, found[ONE].note) == ("inconclusive", f"it leans on {TWO}, which is {lemma}")


@pytest.mark.parametrize("lemma", ["proved", "misprint", "claim-holds"])
def test_proved_forms_carry(claims, ledger, engine, lemma):
    engine[TWO] = Verdict(lemma, certificate=certificate(TWO))
    engine[ONE] = proved(ONE, TWO)
    assert words(verify_all(claims, [ONE, TWO], ledger, Settings()))[ONE] == "proved"


def test_the_record_answers_for_lemmas_outside_the_run(claims, ledger, engine):
    engine[ONE], engine[TWO] = proved(ONE, TWO), proved(TWO)
    assert verify_all(claims, [ONE], ledger, Settings())[0].entry.note == f"it leans on {TWO}, which has no verdict"
    record(ledger, claims, verify_all(claims, [TWO], ledger, Settings()))
    assert words(verify_all(claims, [ONE], ledger, Settings())) == {ONE: "proved"}
    claims[TWO].printed += 1
    assert "has changed since" in verify_all(claims, [ONE], ledger, Settings())[0].entry.note


def test_cycles_prove_nothing(claims, ledger):
    earned = {ONE: proved(ONE, TWO), TWO: proved(TWO, ONE), THREE: proved(THREE, ONE), BOTH: proved(BOTH, BOTH)}
    found = rest_on_lemmas(earned, ledger, lambda name: True)
    assert {v.verdict for v in found.values()} == {"inconclusive"}
    assert found[ONE].note == f"its proof leans on itself through {TWO}"
    assert found[THREE].note == f"it leans on {ONE}, which does not stand"
    assert found[BOTH].note == "its proof leans on itself"


def test_a_cycle_through_the_record(claims, ledger):
    entry = Entry.of(claims[TWO], Verdict("proved"), key=Keys(claims).of(TWO, certificate(TWO, ONE)))
    ledger.write([entry], {TWO: certificate(TWO, ONE)}, order=claims)
    found = rest_on_lemmas({ONE: proved(ONE, TWO)}, ledger, lambda name: True)
    assert found[ONE].note == f"its proof leans on itself through {TWO}"


def test_wholes_with_nothing_to_stand_on(claims, source):
    odd = source.whole("odd", "", ["nowhere"], left=1)
    empty = source.whole("empty", "", [], left=1)
    loop = source.whole("loop", "", ["loop"], left=1)
    claims.update({c.id: c for c in (odd, empty, loop)})
    assert whole(odd.id, claims, {}).note == "there is no claim sample:nowhere"
    assert whole(empty.id, claims, {}).verdict == whole(loop.id, claims, {}).verdict == "inconclusive"


def test_differences(claims, ledger, engine):
    record(ledger, claims, verify_all(claims, [ONE, TWO], ledger, Settings()))
    engine[ONE] = Verdict("confirmed")
    results = verify_all(claims, [ONE, TWO, THREE], ledger, Settings())
    assert differences(results, ledger, {k: c for k, c in claims.items() if k != TWO}, [ONE, TWO]) == [
        f"{ONE}: confirmed, while the record says proved",
        f"{THREE}: proved, and not in the record",
        f"{TWO}: in the record, and no derivation claims it",
    ]


def test_a_batch_for_a_cluster_runs_in_a_process_of_its_own():
    from xsec_sym.record.discover import discover

    name = next(c.id for c in discover().values() if c.kind == "definition")
    import json

    answer = json.loads(batch(pack([Job(name, 4)], Settings())))
    assert verdict(answer[name]).verdict == "definition"
    with pytest.raises(RuntimeError, match="KeyError"):
        batch('{"jobs": []}')


def test_no_cluster(monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(NoCluster, match="pip install distributed"):
        remote("tcp://127.0.0.1:1", Settings())
