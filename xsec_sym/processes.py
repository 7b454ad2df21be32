"""Processes of joblib that Ctrl-C does not reach: a terminal sends it to all, and each would tell of it at length."""

from __future__ import annotations

import contextlib
import signal
from collections.abc import Iterator


@contextlib.contextmanager
def undisturbed() -> Iterator[None]:
    """What is started here never hears of Ctrl-C, nor do we while it is; who starts processes has to end them."""
    try:
        before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    except ValueError:  # not the first thread, which alone may say so
        yield
        return
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def start(jobs: int) -> None:
    """Have so many processes begun, which joblib then uses again."""
    from joblib import Parallel, delayed

    if jobs > 1:
        with undisturbed():
            begun = Parallel(n_jobs=jobs, return_as="generator")(delayed(abs)(k) for k in range(jobs))
        list(begun)
