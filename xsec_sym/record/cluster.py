"""Verify on a `dask.distributed` cluster: claims go out in batches, verdicts come back as data.

A worker there runs each batch in a Python process of its own, so that the limits of an entry hold there too.
"""

from __future__ import annotations

import contextlib
import json
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import asdict, replace
from typing import Any

from xsec_sym.proof.verdict import Verdict
from xsec_sym.record.files import plain
from xsec_sym.record.run import Execute, Job, Settings, local

BATCH = 8


class NoCluster(Exception):
    """The scheduler, or the package that speaks to it, is not there."""


def remote(address: str, settings: Settings) -> Execute:
    """Carry out jobs on the cluster whose scheduler listens at ``address``. Raises `NoCluster`."""
    client = connected(address)
    from distributed import as_completed

    def execute(jobs: list[Job]) -> Iterator[tuple[str, Verdict]]:
        # replays take milliseconds and share the imports of one process; what is derived anew goes out singly
        anew = [[j] for j in jobs if j.certificate is None]
        known = [j for j in jobs if j.certificate is not None]
        batches = anew + [known[k : k + BATCH] for k in range(0, len(known), BATCH)]
        with client:
            sent = {client.submit(batch, pack(b, settings), pure=False): b for b in batches}
            for future in as_completed(sent):
                yield from _answers(future, sent[future])

    return execute


def connected(address: str) -> Any:
    """A client of the scheduler. Raises `NoCluster`."""
    try:
        from distributed import Client
    except ImportError:
        raise NoCluster("--cluster needs the package dask.distributed: pip install distributed") from None
    try:
        return Client(address, timeout="10s")
    except (OSError, ValueError, TypeError) as error:
        raise NoCluster(f"no scheduler answers at {address}: {error or type(error).__name__}") from None


@contextlib.contextmanager
def spread(address: str | None) -> Iterator[None]:
    """While it lasts, what joblib runs in parallel runs on the cluster, if there is an address."""
    if address is None:
        yield
        return
    from joblib import parallel_config

    with connected(address), parallel_config("dask"):
        yield


def _answers(future: Any, jobs: list[Job]) -> Iterator[tuple[str, Verdict]]:
    failed = Verdict("inconclusive", note="the cluster left it out")
    try:
        found = {name: verdict(data) for name, data in json.loads(future.result()).items()}
    except Exception as error:
        found = {}
        failed = Verdict("inconclusive", note=f"the cluster gave no answer: {error}")
    for job in jobs:
        yield job.id, found.get(job.id, failed)


def pack(jobs: list[Job], settings: Settings) -> str:
    return json.dumps({"settings": asdict(replace(settings, jobs=1)), "jobs": [asdict(j) for j in jobs]})


def verdict(data: dict[str, Any]) -> Verdict:
    return Verdict(**{**data, "steps": tuple((depth, said) for depth, said in data["steps"])})


def batch(packed: str) -> str:
    """What a worker of the cluster does: the jobs of one batch, in a fresh interpreter."""
    # the cluster's own processes may have no children by multiprocessing, and do not share our imports
    done = subprocess.run([sys.executable, "-m", __name__], input=packed, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError((done.stderr.strip().splitlines() or ["the process ended"])[-1])
    return done.stdout


def main() -> None:
    from xsec_sym.record.discover import discover

    data = json.load(sys.stdin)
    jobs, settings = [Job(**j) for j in data["jobs"]], Settings(**data["settings"])
    execute = local(discover(), settings)
    json.dump({name: plain(asdict(earned)) for name, earned in execute(jobs)}, sys.stdout)


if __name__ == "__main__":
    main()
