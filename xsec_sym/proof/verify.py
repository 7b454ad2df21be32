"""How a verdict is earned: refute the print or not, prove what holds, try it at witnesses, try to fool the check."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from sympy import Expr, Symbol

from xsec_sym.proof import measured
from xsec_sym.proof.approximate import judged
from xsec_sym.proof.checker import Certificate, lemmas, replay
from xsec_sym.proof.claim import Claim
from xsec_sym.proof.domain import Interval
from xsec_sym.proof.mutants import mutants
from xsec_sym.proof.numeric import (
    Outcome,
    Trial,
    agree_by_digits,
    hold_against,
    is_infinite,
    reduced,
    rejected_by_digits,
    rejects,
    shown,
    told_apart,
    try_at,
    with_instances,
)
from xsec_sym.proof.regular import Refused
from xsec_sym.proof.say import said
from xsec_sym.proof.steps import BrokenProof, derive
from xsec_sym.proof.verdict import Verdict
from xsec_sym.proof.witnesses import distance_from_bulk, witnesses

WITNESSES = 20  # effective witnesses without which nothing is confirmed
MUTANTS = 8  # different functions that the check must reject
WITH_PROOF = 10  # witnesses that go with a proof, against a proof on the wrong branch
ROUTES = 2  # points at which mpmath integrates straight from the definitions


@dataclass
class Mutation:
    """What became of the mutants: rejected, found to be the form itself, or accepted although they differ."""

    killed: int = 0
    equal: int = 0
    survivors: list[Expr] = field(default_factory=list)


def verify(
    claim: Claim,
    claims: Mapping[str, Claim],
    *,
    digits: int = 30,
    seed: int = 0,
    witnesses: int = WITNESSES,
    certificate: Certificate | None = None,
) -> Verdict:
    """The verdict on one claim.

    With a ``certificate`` the recorded proof is replayed, without one it is derived anew. ``digits`` is what a claim
    without a proof must reach; fewer ``witnesses`` than 20 are enough only to check a proof once more.
    """
    begun = time.perf_counter()
    verdict = _verify(claim, claims, digits, seed, witnesses, certificate)
    return replace(verdict, seconds=time.perf_counter() - begun)


def _verify(
    claim: Claim, claims: Mapping[str, Claim], digits: int, seed: int, count: int, recorded: Certificate | None
) -> Verdict:
    if claim.kind in ("definition", "out-of-scope"):
        return Verdict(claim.kind, note=claim.reading if claim.kind == "out-of-scope" else "")
    if claim.measure is not None:
        return measured.judged(claim, seed)
    if claim.accuracy is not None:
        return judged(claim, claims, recorded if count < WITNESSES else None)
    try:
        certificate, steps, refusal = _proof(claim, claims, recorded)
    except BrokenProof as error:
        return Verdict("inconclusive", note=f"the proof cannot be run: {error}")
    if is_infinite(claim.form):
        return _divergence(claim, certificate, steps, refusal, seed)
    proved, thorough = certificate is not None, count >= WITNESSES
    needed = max(12, digits // 2) if proved else digits
    enough = WITNESSES if not proved else WITH_PROOF if thorough else max(1, count // 2)
    points = _points(claim, enough, seed)
    helpers = [claims[name] for name in claim.reduces if name in claims]
    trials, unreached = try_at(reduced(claim.left, helpers), points, needed)
    evidence: dict[str, Any] = {"proof": proved, "enclosure": bool(trials)}
    witness = None
    if claim.corrected is not None and claim.printed is not None:
        of_the_print = hold_against(trials, reduced(claim.printed, helpers), needed)
        if of_the_print.refuted_at is None and not thorough:
            wide, _ = try_at(reduced(claim.left, helpers), _points(claim, WITH_PROOF, seed), needed)
            of_the_print = hold_against(wide, reduced(claim.printed, helpers), needed)
        if of_the_print.refuted_at is None:
            return Verdict("inconclusive", evidence=evidence, note="a correction is offered, but the print holds")
        witness = _witness(of_the_print)
    outcome = hold_against(trials, reduced(claim.form, helpers), needed)
    if outcome.refuted_at is not None:
        return _refuted(claim, outcome, certificate, evidence)
    routes, disagreement = 0, ""
    if thorough or not proved or not outcome.held:
        chosen = [_easiest(claim, seed)] if proved else sorted(points, key=_ease(claim))[:ROUTES]
        routes, disagreement = agree_by_digits(claim, claim.form, chosen, 8 if proved else digits)
    evidence |= {"witnesses": outcome.held, "digits tried": needed, "mpmath": routes}
    if certificate is not None:
        evidence |= {"moves": _count(certificate["moves"]), "lemmas": sorted(lemmas(certificate["moves"]))}
    short = disagreement or _shortfall(outcome, unreached, len(points), routes, proved)
    if short:
        return Verdict("inconclusive", evidence=evidence, certificate=certificate, steps=steps, note=short)
    killed = 0
    if thorough or not proved:
        tried = _mutation(claim, trials, outcome.held > 0, helpers, needed, seed)
        killed, evidence["mutants equal to the form"] = tried.killed, tried.equal
        evidence["witnesses"] = max(outcome.held, len(trials) if outcome.held else 0)
        if tried.survivors or killed < MUTANTS:
            note = f"only {killed} mutants could be tried"
            if tried.survivors:
                note = f"the check lets {said(tried.survivors[0])} pass"
            return Verdict("inconclusive", evidence=evidence, certificate=certificate, steps=steps, note=note)
    word = "proved" if proved else "confirmed"
    if witness is not None:
        evidence["corrected form"], word = word, "misprint"
    elif claim.kind == "statement":
        evidence["statement"], word = word, "claim-holds"
    return Verdict(word, digits=needed, witness=witness, evidence=evidence, mutants=killed, steps=steps,
                   certificate=certificate, note="" if proved else refusal)  # fmt: skip


def _proof(claim: Claim, claims: Mapping[str, Claim], recorded: Certificate | None) -> tuple[Any, tuple, str]:
    """A certificate that replays, with the steps in words; or the reason why there is none."""
    if recorded is not None:
        try:
            replay(claim, recorded, claims)
        except Refused as reason:
            return None, (), f"the recorded certificate no longer replays: {reason}"
        return recorded, (), ""
    if claim.prove is None:
        return None, (), ""
    try:
        certificate, steps = derive(claim, claims)
        replay(claim, certificate, claims)
    except Refused as reason:
        return None, (), f"the proof does not go through: {reason}"
    return certificate, tuple(steps), ""


def _points(claim: Claim, count: int, seed: int) -> list[Any]:
    sides = [s for s in (claim.left, claim.printed, claim.corrected) if s is not None]
    return with_instances(witnesses(claim.domain, sides, count, seed), claim.domain)


def _divergence(claim: Claim, certificate: Any, steps: Any, refusal: str, seed: int) -> Verdict:
    """Infinite by a bound. No number of samples could show it, so here the certificate is everything."""
    if certificate is None:
        return Verdict("inconclusive", note=refusal or "nothing bounds the quantity from below")
    points = _points(claim, 4, seed)
    trials, _ = try_at(claim.left, points[:2], 8)
    if trials:
        return Verdict("inconclusive", note=f"a finite value was found at {shown(trials[0].point)}")
    evidence = {"proof": True, "moves": _count(certificate["moves"]), "lemmas": sorted(lemmas(certificate["moves"]))}
    return Verdict("divergent", evidence=evidence, steps=steps, certificate=certificate)


def _shortfall(outcome: Outcome, unreached: list[str], enough: int, routes: int, proved: bool) -> str:
    """What is missing for the numeric half, as a sentence; empty where nothing is."""
    reasons = outcome.unreached or unreached
    because = f": {reasons[0]}" if reasons else ""
    if proved:
        if outcome.held or routes:
            return ""
        return f"the proof goes through, but no witness could be tried{because}"
    if outcome.held < enough:
        return f"only {outcome.held} of {enough} witnesses are effective{because}"
    return "" if routes else "mpmath has no second opinion to give"


def _mutation(
    claim: Claim, trials: list[Trial], enclosed: bool, helpers: list[Claim], digits: int, seed: int
) -> Mutation:
    """Try to fool the check. Where a mutant slips through, look for a point that tells it from the form and make that
    point a witness too: the check grows until it rejects the mutant, or no point tells the two apart."""
    result = Mutation()
    more: list[Any] = []
    unreached: list[Expr] = []
    left, form = reduced(claim.left, helpers), reduced(claim.form, helpers)
    for mutant in mutants(claim.form, _reals(claim)):
        rival = reduced(mutant, helpers)
        verdict = rejects(trials, rival) if enclosed else None
        if verdict is None:
            unreached.append(mutant)
            continue
        if not verdict:
            more = more or _points(claim, 2 * WITNESSES, seed + 1)
            apart = told_apart(rival, form, more)
            if apart is None:
                result.equal += 1
                continue
            added, _ = try_at(left, [apart], digits)
            held = hold_against(added, form, digits)
            if not added or held.refuted_at is not None or not rejects(added, rival):
                result.survivors.append(mutant)
                continue
            trials += added
        result.killed += 1
    if result.killed < MUTANTS:
        result.killed += rejected_by_digits(claim, unreached, _easiest(claim, seed), MUTANTS - result.killed)
    return result


def _easiest(claim: Claim, seed: int) -> Any:
    return min(_points(claim, WITH_PROOF, seed), key=_ease(claim))


def _ease(claim: Claim) -> Callable[[Any], float]:
    return lambda point: distance_from_bulk(claim.domain, point)


def _reals(claim: Claim) -> list[Symbol]:
    return [v.symbol for v in claim.domain.variables if isinstance(v, Interval)]


def _refuted(claim: Claim, outcome: Outcome, certificate: Any, evidence: dict[str, Any]) -> Verdict:
    """A form that fails at a witness. With a certificate for it, something is rotten: say so, loudly."""
    witness = _witness(outcome)
    if certificate is not None:
        return Verdict("inconclusive", witness=witness, evidence=evidence,
                       note="the proof goes through, yet a witness refutes the claim")  # fmt: skip
    word = "claim-fails" if claim.kind == "statement" else "refuted" if claim.corrected is None else "inconclusive"
    return Verdict(
        word, witness=witness, evidence=evidence, note="" if word != "inconclusive" else "the corrected form fails"
    )


def _witness(outcome: Outcome) -> dict[str, Any]:
    trial = outcome.refuted_at
    assert trial is not None
    digits = next((d for d in (20, 40, 80) if trial.left.str(d) != outcome.refuting.str(d)), 80)
    return {"point": shown(trial.point), "left": trial.left.str(digits), "right": outcome.refuting.str(digits)}


def _count(moves: list[Any]) -> int:
    return sum(1 + sum(_count(b) for b in branches) for _, _, *branches in moves)


__all__ = ["MUTANTS", "WITNESSES", "verify"]
