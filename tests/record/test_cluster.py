"""A local Dask cluster of two workers: the same verdicts, and nothing lost when a worker dies."""

import os
import signal
import threading
import time

import numpy as np
import pytest

distributed = pytest.importorskip("distributed")

from xsec_sym.record.cluster import remote, spread  # noqa: E402
from xsec_sym.record.discover import discover  # noqa: E402
from xsec_sym.record.run import Settings, verify_all  # noqa: E402
from xsec_sym.record.store import Ledger  # noqa: E402
from xsec_sym.study.method import registered  # noqa: E402
from xsec_sym.study.points import right  # noqa: E402

IDS = ["deon2016:1", "deon2016:5", "deon2016:14", "deon2016:18"]
POINTS = (np.linspace(-1, 1, 150), np.full(150, 0.4))

pytestmark = [
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
    pytest.mark.filterwarnings("ignore:Port .* is already in use:UserWarning"),
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),
]


@pytest.fixture(scope="module")
def cluster():
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50) as found:
        yield found


def verdicts(address):
    claims, settings = discover(), Settings(jobs=1)
    results = verify_all(claims, IDS, Ledger(), settings, execute=remote(address, settings))
    return {r.entry.id: r.entry.verdict for r in results}


def test_a_worker_that_dies_loses_nothing(cluster, monkeypatch):
    monkeypatch.setattr("xsec_sym.record.cluster.BATCH", 2)
    doomed = next(iter(cluster.workers.values())).process.pid

    def kill():
        time.sleep(1.0)
        os.kill(doomed, signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    found = verdicts(cluster.scheduler_address)
    killer.join()
    assert found == {name: Ledger()[name].verdict for name in found}
    assert len(found) == len(IDS)


def test_references_of_a_study_on_the_cluster(cluster):
    with spread(cluster.scheduler_address):
        there = right(registered("sigma_beckmann").quantity, "", POINTS, jobs=-1)
    here = right(registered("sigma_beckmann").quantity, "", POINTS)
    assert (there.high == here.high).all() and (there.low == here.low).all()
