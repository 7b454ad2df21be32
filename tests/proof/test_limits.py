import os
import signal
import time

import pytest

from xsec_sym import check
from xsec_sym.proof import EmptyDomain
from xsec_sym.proof.limits import each
from xsec_sym.proof.parse import ParseError
from xsec_sym.proof.verdict import Verdict


def act(job):
    if job == "sleep":
        time.sleep(30)
    if job == "spin":
        9**9**9
    if job == "eat":
        bytearray(3 << 30)
    if job == "die":
        os.kill(os.getpid(), signal.SIGKILL)
    if job == "raise":
        raise ValueError("no")
    if job == "odd":
        return lambda: 1
    if job == "noise":
        os.write(2, b"noise")
    return job


def test_one_bad_job_costs_only_itself():
    jobs = ["a", "sleep", "b", "eat", "c", "die", "d", "raise", "e", "odd", "f", "spin", "g"]
    begun = time.perf_counter()
    found = {o.job: o for o in each(act, jobs, seconds=0.5, memory=1 << 30, workers=2)}
    assert time.perf_counter() - begun < 10
    assert set(found) == set(jobs)
    assert all(found[j].value == j for j in "abcdefg")
    assert found["sleep"].stopped == found["spin"].stopped == "stopped after 0.5 s"
    assert found["eat"].stopped == "stopped at the memory limit of 1 GiB"
    assert "ended" in found["die"].stopped
    assert isinstance(found["raise"].error, ValueError)
    assert "cannot be passed on" in str(found["odd"].error)


def test_children_are_quiet_and_gone(capfd):
    stream = each(act, ["noise", "sleep"], workers=2)
    assert next(stream).value == "noise"
    stream.close()
    assert capfd.readouterr().err == ""
    assert list(each(act, [])) == []


@pytest.fixture
def examined(monkeypatch):
    def set_to(result):
        def examine(claim, *, digits=30, seed=0):
            if isinstance(result, Exception):
                raise result
            return result(claim) if callable(result) else result

        monkeypatch.setattr("xsec_sym.proof.examine.examine", examine)

    return set_to


def test_check_passes_on_what_examine_says(examined):
    examined(lambda claim: Verdict("proved", note=f"{claim.left} {claim.domain.text()}"))
    assert check("u + 0.5", "1", where="u in (0, 1)").note == "u + 1/2 u in (0, 1)"


def test_check_keeps_to_its_time(examined):
    examined(lambda claim: time.sleep(60))
    begun = time.perf_counter()
    assert check("1", "1", seconds=0.3).verdict == "timeout"
    assert time.perf_counter() - begun < 5


def test_check_keeps_to_its_memory(examined):
    examined(lambda claim: bytearray(2 << 30))
    verdict = check("1", "1", memory=1 << 29)
    assert verdict.verdict == "timeout" and "0.5 GiB" in verdict.note


def test_check_reports_an_internal_failure(examined):
    examined(TypeError("odd"))
    assert (check("1", "1").verdict, check("1", "1").note) == ("inconclusive", "TypeError: odd")


def test_check_refuses_bad_input(examined):
    examined(EmptyDomain("nowhere"))
    with pytest.raises(EmptyDomain, match="nowhere"):
        check("1", "1")
    with pytest.raises(ParseError, match="too large"):
        check("9**9**9", "1")
    with pytest.raises(EmptyDomain):
        check("u", "u", where="u in (1, 0)")
    with pytest.raises(ValueError, match="digits"):
        check("1", "1", digits=0)
