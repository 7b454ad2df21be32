"""Work that always ends: each job in a child process that the clock and a memory limit can stop."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import time
import warnings
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sympy import Expr

    from xsec_sym.proof.verdict import Verdict

MEMORY = 4 << 30
SECONDS = 240.0


@dataclass(frozen=True)
class Outcome:
    """What became of one job: its ``value``, or why there is none.

    ``stopped`` is a sentence when a limit was hit; ``error`` is the exception that the job raised.
    """

    job: Any
    value: Any = None
    stopped: str = ""
    error: Exception | None = None
    seconds: float = 0.0


def each(
    work: Callable[[Any], Any],
    jobs: Iterable[Any],
    *,
    seconds: float = SECONDS,
    memory: int = MEMORY,
    workers: int = 1,
) -> Iterator[Outcome]:
    """``work(job)`` for every job, in child processes, as they come in; each gets ``seconds`` and ``memory`` bytes.

    A job that exceeds a limit, or takes its process down, costs that process only. Children are forked: they see what
    the caller has imported, and ``work`` may be a closure; what it returns must survive pickling.

    >>> sorted(o.value for o in each(lambda k: k * k, [1, 2, 3], workers=2))
    [1, 4, 9]
    >>> next(each(lambda k: time.sleep(9), [0], seconds=0.1)).stopped
    'stopped after 0.1 s'
    """
    queue = deque(jobs)
    crew = [_Worker(work, seconds, memory) for _ in range(min(max(1, workers), len(queue)))]
    try:
        for worker in crew:
            worker.give(queue.popleft())
        while busy := [w for w in crew if w.busy]:
            left = min(w.until for w in busy) - time.monotonic()
            ready = wait([w.pipe for w in busy], max(0.0, left))
            for worker in busy:
                if worker.pipe in ready:
                    yield worker.take()
                elif time.monotonic() >= worker.until:
                    yield worker.stop(f"stopped after {seconds:g} s")
                else:
                    continue
                if queue:
                    worker.give(queue.popleft())
    finally:
        for worker in crew:
            worker.end()


class _Worker:
    """One child process, replaced by a new one whenever a job has ended it."""

    pipe: Connection

    def __init__(self, work: Callable[[Any], Any], seconds: float, memory: int) -> None:
        self.work, self.seconds, self.memory = work, seconds, memory
        self.process: Any = None
        self.busy = False
        self.job: Any = None
        self.since = self.until = 0.0

    def give(self, job: Any) -> None:
        if self.process is None:
            self._start()
        self.job, self.busy = job, True
        self.since = time.monotonic()
        self.until = self.since + self.seconds
        # a child that died between two jobs shows as an end of file when its answer is taken
        with contextlib.suppress(BrokenPipeError):
            self.pipe.send(job)

    def take(self) -> Outcome:
        try:
            value, error = self.pipe.recv()
        except (EOFError, OSError):
            return self.stop(f"the process was ended, most likely for want of memory (limit {_size(self.memory)})")
        except Exception as unreadable:
            value, error = None, RuntimeError(f"the result cannot be passed on: {unreadable}")
        if isinstance(error, MemoryError):
            return self.stop(f"stopped at the memory limit of {_size(self.memory)}")
        self.busy = False
        return Outcome(self.job, value, "", error, time.monotonic() - self.since)

    def stop(self, why: str) -> Outcome:
        self.end()
        return Outcome(self.job, None, why, None, time.monotonic() - self.since)

    def end(self) -> None:
        self.busy = False
        if self.process is not None:
            self.process.kill()
            self.process.join()
            self.process.close()
            self.pipe.close()
            self.process = None

    def _start(self) -> None:
        # fork: a spawned child would run an unguarded script of the user's again, and import SymPy anew
        context = multiprocessing.get_context("fork")
        self.pipe, theirs = context.Pipe()
        self.process = context.Process(target=_serve, args=(theirs, self.work, self.seconds, self.memory), daemon=True)
        with warnings.catch_warnings():
            # newer Pythons warn of forks beside threads; these children only compute, and the clock ends them
            warnings.simplefilter("ignore", DeprecationWarning)
            self.process.start()
        theirs.close()


def _serve(pipe: Connection, work: Callable[[Any], Any], seconds: float, memory: int) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # libraries in C print before they abort; what is worth telling comes through the pipe
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.dup2(nowhere, 2)
    _cap(memory)
    while True:
        try:
            job = pipe.recv()
        except (EOFError, OSError):
            return
        # unhandled, this signal ends even a loop in C, should the parent be gone by then
        signal.setitimer(signal.ITIMER_REAL, seconds + 10)
        answer: tuple[Any, Exception | None]
        try:
            answer = work(job), None
        except Exception as error:
            answer = None, error
        signal.setitimer(signal.ITIMER_REAL, 0)
        try:
            pipe.send(answer)
        except OSError:
            return
        except Exception as error:
            pipe.send((None, RuntimeError(f"the result cannot be passed on: {error}; {answer[1] or ''}")))


def _cap(memory: int) -> None:
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource

        used = 0
        with contextlib.suppress(OSError), open("/proc/self/statm") as pages:
            used = int(pages.read().split()[0]) * resource.getpagesize()
        hard = resource.getrlimit(resource.RLIMIT_AS)[1]
        wanted = used + memory if hard == resource.RLIM_INFINITY else min(used + memory, hard)
        resource.setrlimit(resource.RLIMIT_AS, (wanted, hard))


def _size(memory: int) -> str:
    return f"{memory / (1 << 30):g} GiB"


def check(
    lhs: str | Expr,
    rhs: str | Expr,
    where: Any = "",
    digits: int = 30,
    seconds: float = 60.0,
    *,
    memory: int = MEMORY,
    seed: int = 0,
) -> Verdict:
    """Does ``lhs`` equal ``rhs`` wherever ``where`` holds? The verdict on an equation of your own.

    The sides are strings in the syntax of `xsec_sym.proof.parse`, or SymPy expressions; ``where`` is a string such as
    ``"u in (-1, 1), n in {0, 1, 2}, u*n > 0"``, or a list of ranges and conditions. Raises `ParseError` for what
    cannot be read, `EmptyDomain` where no point is left to test. Whatever takes longer than ``seconds``, or more than
    ``memory`` bytes, earns the verdict "timeout".

    >>> check("sin(x)**2 + cos(x)**2", "1", where="x in (-oo, oo)").settled
    True
    >>> check("sin(x)", "x", where="x in (0, 1)").verdict
    'refuted'
    """
    from xsec_sym.proof import examine, ranges
    from xsec_sym.proof.domain import EmptyDomain
    from xsec_sym.proof.parse import ParseError
    from xsec_sym.proof.verdict import Verdict

    if digits < 1:
        raise ValueError("digits must be at least 1")

    def judge(_: None) -> Verdict:
        # reading is bounded like the rest: building an expression may already take for ever
        claim = ranges.equation(lhs, rhs, where)
        return examine.examine(claim, digits=digits, seed=seed)

    outcome = next(each(judge, [None], seconds=seconds, memory=memory))
    if isinstance(outcome.error, ParseError | EmptyDomain):
        raise outcome.error
    if outcome.error is not None:
        note = f"{type(outcome.error).__name__}: {outcome.error}"
        return Verdict("inconclusive", note=note, seconds=outcome.seconds)
    if outcome.stopped:
        return Verdict("timeout", note=outcome.stopped, seconds=outcome.seconds)
    return outcome.value
