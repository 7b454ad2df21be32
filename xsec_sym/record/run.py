"""Verify many claims: what is replayed and what derived anew, in parallel, and what each result rests on."""

from __future__ import annotations

from collections import ChainMap, deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from xsec_sym.proof.claim import Claim
from xsec_sym.proof.limits import MEMORY, SECONDS, Outcome, each
from xsec_sym.proof.verdict import Verdict, worst
from xsec_sym.record.entry import Entry
from xsec_sym.record.key import Keys
from xsec_sym.record.store import Ledger

REPLAYED = 4  # witnesses for a claim whose recorded proof still applies
ANEW = 20


@dataclass(frozen=True)
class Settings:
    digits: int = 30
    seed: int = 0
    fresh: bool = False
    jobs: int = 1
    seconds: float = SECONDS
    memory: int = MEMORY


@dataclass(frozen=True)
class Job:
    """One claim to verify, with its recorded proof where that may be replayed."""

    id: str
    witnesses: int
    certificate: dict[str, Any] | None = None
    expected: float = 0.0


@dataclass(frozen=True)
class Result:
    entry: Entry
    certificate: dict[str, Any] | None
    replayed: bool = False


# How jobs are carried out: on this machine, or elsewhere.
Execute = Callable[[list[Job]], Iterator[tuple[str, Verdict]]]


def verify_all(
    claims: Mapping[str, Claim],
    chosen: Iterable[str],
    ledger: Ledger,
    settings: Settings,
    *,
    execute: Execute | None = None,
    tick: Callable[[str, Verdict], None] = lambda name, verdict: None,
    now: Callable[[list[str]], None] = lambda names: None,
) -> list[Result]:
    """A result for every chosen claim, and for the parts of chosen wholes, in the order of the claims.

    ``tick`` is called with an id and its verdict whenever one comes in, ``now`` with the ids in work whenever these
    change, if they are on this machine.
    """
    wanted = with_parts(claims, chosen)
    keys = Keys(claims)
    unchanged = {n for n in wanted if n in ledger and ledger[n].key == keys.of(n, ledger.certificate(n))}
    jobs = []
    for name in wanted:
        if claims[name].kind == "whole":
            continue
        # what was not settled with all witnesses must not come out better with a few
        if name in unchanged and not settings.fresh and ledger.certificate(name) and ledger[name].settled:
            jobs.append(Job(name, REPLAYED, ledger.certificate(name), ledger[name].seconds))
        else:
            # the longest are started first, and of what is new nothing is known
            jobs.append(Job(name, ANEW, None, ledger[name].seconds if name in ledger else SECONDS))
    earned: dict[str, Verdict] = {}
    for name, verdict in (execute or local(claims, settings, now))(jobs):
        earned[name] = verdict
        tick(name, verdict)
    # a replay need not hand back the certificate that it was given
    for job in jobs:
        if job.certificate and earned[job.id].certificate is None and earned[job.id].verdict == ledger[job.id].verdict:
            earned[job.id] = replace(earned[job.id], certificate=job.certificate)
    earned = rest_on_lemmas(earned, ledger, lambda name: _current(name, claims, ledger, keys))
    for name in wanted:
        if claims[name].kind == "whole":
            earned[name] = whole(name, claims, earned)
            tick(name, earned[name])
    results, given = [], {job.id for job in jobs if job.certificate}
    for name in wanted:
        verdict = earned[name]
        like = ledger[name] if name in unchanged else None
        key = keys.of(name, verdict.certificate)
        entry = Entry.of(claims[name], verdict, key=key, like=like)
        results.append(Result(entry, verdict.certificate, replayed=name in given))
    return results


def with_parts(claims: Mapping[str, Claim], chosen: Iterable[str]) -> list[str]:
    """The chosen ids and the parts of wholes among them, in the order of the claims.

    A part that is no claim is left out here; the whole's verdict names it.
    """
    found: set[str] = set()
    waiting = list(chosen)
    while waiting:
        name = waiting.pop()
        if name in claims and name not in found:
            found.add(name)
            waiting += claims[name].parts
    return [name for name in claims if name in found]


def local(
    claims: Mapping[str, Claim], settings: Settings, now: Callable[[list[str]], None] = lambda names: None
) -> Execute:
    """Carry out jobs in processes on this machine, each job within the limits."""
    from xsec_sym.proof import verify

    def work(job: Job) -> Verdict:
        return verify.verify(
            claims[job.id],
            claims,
            digits=settings.digits,
            seed=settings.seed,
            witnesses=job.witnesses,
            certificate=job.certificate,
        )

    def execute(jobs: list[Job]) -> Iterator[tuple[str, Verdict]]:
        ordered = sorted(jobs, key=lambda j: -j.expected)
        # jobs are begun in this order, the next whenever one has ended
        waiting = deque(j.id for j in ordered)
        running = dict.fromkeys(waiting.popleft() for _ in ordered[: max(1, settings.jobs)])
        now(list(running))
        for outcome in each(work, ordered, seconds=settings.seconds, memory=settings.memory, workers=settings.jobs):
            running.pop(outcome.job.id, None)
            if waiting:
                running[waiting.popleft()] = None
            now(list(running))
            yield outcome.job.id, judged(outcome)

    return execute


def judged(outcome: Outcome) -> Verdict:
    """The verdict of a job; one that hit a limit or failed is never settled."""
    if outcome.stopped:
        return Verdict("timeout", note=outcome.stopped, seconds=outcome.seconds)
    if outcome.error is not None:
        said = f"{type(outcome.error).__name__}: {outcome.error}"
        return Verdict("inconclusive", note=said, seconds=outcome.seconds)
    return outcome.value


def carries(word: str, certificate: Mapping[str, Any] | None) -> bool:
    """Whether a claim may serve as a lemma: its form is proved, whatever became of the print."""
    if certificate is not None and "accuracy" in certificate:
        return False  # it is near, and no identity
    return word == "proved" or (word in ("misprint", "claim-holds") and certificate is not None)


def rest_on_lemmas(earned: Mapping[str, Verdict], ledger: Ledger, current: Callable[[str], bool]) -> dict[str, Verdict]:
    """A proof is as good as what it leans on: where a lemma is not proved, or leans back, it proves nothing.

    ``current(id)`` tells whether the recorded verdict of a claim outside this run may still be used.
    """
    from xsec_sym.proof.checker import lemmas

    def leans(name: str) -> list[str]:
        certificate = earned[name].certificate if name in earned else ledger.certificate(name)
        return sorted(lemmas(certificate["moves"])) if certificate else []

    reach: dict[str, set[str]] = {}

    def below(name: str) -> set[str]:
        if name not in reach:
            seen: set[str] = set()
            waiting = leans(name)
            while waiting:
                other = waiting.pop()
                if other not in seen:
                    seen.add(other)
                    waiting += leans(other)
            reach[name] = seen
        return reach[name]

    told: dict[str, str] = {}

    def weakness(name: str) -> str:
        """Why a proof does not stand, or nothing."""
        if name not in told:
            if name in below(name):
                ring = [other for other in sorted(below(name)) if name in below(other) and other != name]
                told[name] = f"its proof leans on itself{' through ' + ', '.join(ring) if ring else ''}"
            else:
                told[name] = next((why for lemma in leans(name) if (why := fault(lemma, near(name)))), "")
        return told[name]

    def near(name: str) -> bool:
        """Whether the claim is one of accuracy, which may lean on another of its kind."""
        certificate = earned[name].certificate if name in earned else ledger.certificate(name)
        return certificate is not None and "accuracy" in certificate

    def fault(lemma: str, approximate: bool = False) -> str:
        if lemma in earned:
            word, certificate = earned[lemma].verdict, earned[lemma].certificate
        elif lemma not in ledger:
            return f"it leans on {lemma}, which has no verdict"
        elif not current(lemma):
            return f"it leans on {lemma}, which has changed since it was recorded: verify that one too"
        else:
            word, certificate = ledger[lemma].verdict, ledger.certificate(lemma)
        if not carries(word, certificate) and not (approximate and near(lemma) and word == "claim-holds"):
            return f"it leans on {lemma}, which is {word}"
        return f"it leans on {lemma}, which does not stand" if weakness(lemma) else ""

    settled = {}
    for name, verdict in earned.items():
        why = weakness(name) if verdict.settled else ""
        settled[name] = replace(verdict, verdict="inconclusive", note=why) if why else verdict
    return settled


def whole(name: str, claims: Mapping[str, Claim], earned: Mapping[str, Verdict]) -> Verdict:
    """The worst verdict of the parts, which may be wholes themselves."""
    parts: list[Verdict] = []
    waiting, seen = list(claims[name].parts), {name}
    while waiting:
        part = waiting.pop(0)
        if part in seen:
            continue
        seen.add(part)
        if part not in claims:
            return Verdict("inconclusive", note=f"there is no claim {part}")
        if claims[part].kind == "whole":
            waiting += claims[part].parts
        else:
            parts.append(earned[part])
    if not parts:
        return Verdict("inconclusive", note="it has no parts")
    return Verdict(
        worst([p.verdict for p in parts]),
        digits=min((p.digits for p in parts if p.digits), default=None),
        mutants=sum(p.mutants for p in parts),
        seconds=sum(p.seconds for p in parts),
        evidence={"parts": len(parts)},
    )


def _current(name: str, claims: Mapping[str, Claim], ledger: Ledger, keys: Keys) -> bool:
    return name in claims and ledger[name].key == keys.of(name, ledger.certificate(name))


def differences(
    results: Iterable[Result], ledger: Ledger, claims: Mapping[str, Claim], everything: Iterable[str]
) -> list[str]:
    """One sentence for each verdict that is not the recorded one, and for each recorded id that is gone.

    ``everything`` are the recorded ids that this run should have met.
    """
    found = []
    for result in results:
        entry = result.entry
        if entry.id not in ledger:
            found.append(f"{entry.id}: {entry.verdict}, and not in the record")
        elif ledger[entry.id].verdict != entry.verdict:
            found.append(f"{entry.id}: {entry.verdict}, while the record says {ledger[entry.id].verdict}")
    gone = [name for name in everything if name not in claims]
    return found + [f"{name}: in the record, and no derivation claims it" for name in gone]


def to_record(results: Sequence[Result], ledger: Ledger) -> tuple[list[Entry], dict[str, Any]]:
    """What `Ledger.write` should be given.

    A replay that agrees leaves the fuller evidence of the record alone, and no time is recorded for its own sake.
    """
    kept: dict[str, Entry] = dict(ledger)
    changed, certificates = set(), {}
    # a whole tells of its parts what stays recorded of them
    ordered = sorted(results, key=lambda result: bool(result.entry.parts))
    known = ChainMap(kept, {r.entry.id: r.entry for r in results if r.entry.parts})
    for result in ordered:
        earlier = ledger.get(result.entry.id)
        entry = _summed(result.entry, known)
        if earlier is not None:
            agrees = result.replayed and earlier.verdict == entry.verdict
            same = replace(entry, seconds=earlier.seconds) == earlier
            if agrees or (same and result.certificate == ledger.certificate(earlier.id)):
                continue
        kept[entry.id] = entry
        changed.add(entry.id)
        certificates[entry.id] = result.certificate
    return [kept[r.entry.id] for r in results if r.entry.id in changed], certificates


def _summed(entry: Entry, known: Mapping[str, Entry]) -> Entry:
    """A whole with the counts of its parts, whole ones among them taken apart; anything else as it is."""
    if not entry.parts:
        return entry
    leaves, waiting, seen = [], list(entry.parts), {entry.id}
    while waiting:
        part = known.get(waiting.pop())
        if part is not None and part.id not in seen:
            seen.add(part.id)
            waiting += part.parts
            leaves += [] if part.parts else [part]
    digits = min((p.digits for p in leaves if p.digits), default=None)
    seconds = round(sum(p.seconds for p in leaves), 2)
    return replace(entry, mutants=sum(p.mutants for p in leaves), digits=digits, seconds=seconds)
