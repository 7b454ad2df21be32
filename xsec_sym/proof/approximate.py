"""How an approximation is judged: by a proved bound on its error, and by points where it is as bad as that."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from flint import arb
from sympy import Expr

from xsec_sym.proof.accuracy import Accuracy
from xsec_sym.proof.ball_compile import NoEnclosure
from xsec_sym.proof.claim import Claim
from xsec_sym.proof.error import Error, Unbounded, ceiling, decimal, lemmas_of, short, shown, spread, surface
from xsec_sym.proof.mutants import mutants
from xsec_sym.proof.reach import SHARP, Found, searched
from xsec_sym.proof.suprema import panels
from xsec_sym.proof.verdict import Verdict
from xsec_sym.proof.zeros import Undecided

READABLE = 1e6
MUTANTS = 8  # altered forms that must miss the stated accuracy


def judged(claim: Claim, claims: Mapping[str, Claim], recorded: Any) -> Verdict:
    """The verdict on an approximation, or on an accuracy that is stated of one.

    With a ``recorded`` certificate the points are tried again, and the bound only next to its end.
    """
    assert claim.accuracy is not None
    try:
        if claim.accuracy.by:
            return _held_against(claim, claim.accuracy, claims)
        if recorded is None:
            found = searched(claim, claim.accuracy, claims)
        else:
            found = _replayed(claim, claim.accuracy, recorded)
        return _verdict(claim, found, recorded is None)
    except (Unbounded, NoEnclosure, Undecided) as reason:
        return Verdict("inconclusive", note=str(reason))


def _held_against(claim: Claim, spec: Accuracy, claims: Mapping[str, Claim]) -> Verdict:
    """The print against the form that another claim bounds. Whether that one holds is settled where all are known."""
    other = claims.get(spec.by)
    if other is None or other.accuracy is None or other.accuracy.by or other.form != claim.form:
        raise Unbounded(f"{spec.by} bounds no error of this form")
    if other.accuracy.within != spec.within or other.domain != claim.domain:
        raise Unbounded(f"{spec.by} is a claim of another accuracy")
    tolerance = float(spec.within)
    last = float(spec.chart.y_of.subs(claim.domain.symbols[1], spec.end)) * (1 - 1e-6)
    points = [p for p in spread(claim, spec.chart, float(spec.start), last) if claim.domain.holds_at(p)]
    error = Error(claim, claim.form)
    sizes = [(p, size) for p in points if (size := error.at(p)).is_finite()]
    worst, size = max(sizes, key=lambda found: float(found[1].mid()))
    if not size < tolerance:
        raise Unbounded(f"the form misses the accuracy at {shown(worst)}")
    found = Found(tolerance, worst, size, tolerance, spec.end, worst, points, {}, (spec.by, *lemmas_of(claim)))
    evidence = {"within": decimal(spec.within), "bounded by": spec.by, "error of the form at points": short(size)}
    witness, word = None, "claim-holds"
    if claim.corrected is not None and claim.printed is not None:
        witness, wrong = _worst_of_print(claim, found)
        if not wrong > tolerance:
            raise Unbounded("a correction is offered, but the print was not seen to miss the accuracy")
        evidence["error of the print"] = short(wrong)
        word = "misprint"
    killed = sum(_misses(claim, rival, found, tolerance) is True for rival in mutants(claim.form, []))
    if killed < MUTANTS:
        raise Unbounded(f"only {killed} altered forms miss the tolerance")
    return Verdict(word, witness=witness, evidence=evidence, mutants=killed, certificate=found.certificate(claim))


def _verdict(claim: Claim, found: Found, thorough: bool) -> Verdict:
    tolerance, evidence, killed = found.tolerance, dict(found.evidence), 0
    holds = found.bound <= tolerance
    if not holds and not found.worst_error > tolerance:
        raise Unbounded(f"the error is at most {found.bound:.4g}, and no point was found where it exceeds {tolerance}")
    if thorough:
        killed = _fooled(claim, found, evidence)
    printed = None
    if claim.corrected is not None and claim.printed is not None and claim.kind == "approximation":
        printed, size = _worst_of_print(claim, found)
        if not size > tolerance:
            raise Unbounded("a correction is offered, but the print was not seen to miss the accuracy")
        evidence["error of the print"] = short(size)
    if claim.kind == "approximation" and not holds:
        raise Unbounded("the form misses the accuracy stated for it")
    witness = printed
    if not holds:
        inside = found.worst if claim.domain.holds_at(found.worst) else found.broken
        left, right = Error(claim, claim.form).sides(inside)
        witness = {"point": shown(inside), "left": left.str(20), "right": right.str(20)}
        if not (claim.domain.holds_at(inside) and abs(left - right) > tolerance):
            raise Unbounded("no point of the domain itself was found that breaks the tolerance")
    word = "misprint" if printed else "claim-holds" if holds else "claim-fails"
    return Verdict(word, witness=witness, evidence=evidence, mutants=killed, certificate=found.certificate(claim))


def _fooled(claim: Claim, found: Found, evidence: dict[str, Any]) -> int:
    """Try to fool the check: with altered forms, the form of opposite sign, and half the tolerance."""
    tolerance = found.tolerance
    if not found.worst_error > found.bound / 2:
        raise Unbounded("the bound is more than twice the error found, so half of it would not be refused")
    if _misses(claim, -claim.form, found, tolerance) is not True:
        raise Unbounded("the check lets the form with the opposite sign pass")
    fates = [_misses(claim, rival, found, tolerance) for rival in mutants(claim.form, [])]
    killed = sum(fate is True for fate in fates)
    if killed < MUTANTS:
        raise Unbounded(f"only {killed} altered forms miss the tolerance")
    as_near = sum(fate is False for fate in fates)
    if as_near:
        evidence["altered forms that are as near"] = as_near
    return killed


def _misses(claim: Claim, rival: Expr, found: Found, tolerance: float) -> bool | None:
    """Whether an altered form misses the tolerance at one of the points; None where it has no value."""
    try:
        error = Error(claim, rival)
        sizes = [error.at(p) for p in found.points]
    except (NoEnclosure, ValueError, TypeError, ZeroDivisionError, Undecided):
        return None
    if not any(s.is_finite() for s in sizes):
        return None
    return any(s.is_finite() and s > tolerance for s in sizes)


def _worst_of_print(claim: Claim, found: Found) -> tuple[dict[str, Any], arb]:
    assert claim.printed is not None
    error = Error(claim, claim.printed)
    sizes = [(p, here) for p in found.points if (here := error.at(p)).is_finite()]
    # a print that grows without bound is shown where a reader can still tell its size
    readable = [(p, here) for p, here in sizes if here < READABLE] or sizes
    if not readable:
        raise Unbounded("the print has no value at any of the points")
    best, size = max(readable, key=lambda pair: float(pair[1].mid()))
    left, right = error.sides(best)
    return {"point": shown(best), "left": left.str(20), "right": right.str(20)}, size


def _replayed(claim: Claim, spec: Accuracy, recorded: Mapping[str, Any]) -> Found:
    """The recorded points once more, and the bound on the last piece before the recorded end."""
    from xsec_sym.proof.wire import decode

    if recorded.get("claim") != claim.id or "accuracy" not in recorded:
        raise Unbounded("the recorded certificate is not one for this claim")
    kept = recorded["accuracy"]
    tolerance, bound, holds_to = kept["tolerance"], kept["bound"], decode(kept["holds to"])
    worst, broken = (dict(zip(claim.domain.symbols, map(decode, p), strict=True)) for p in kept["points"])
    error = Error(claim, claim.form)
    if not error.at(broken) > tolerance:
        raise Unbounded("the recorded point no longer breaks the tolerance")
    size = error.at(worst)
    if not size <= bound:
        raise Unbounded("the recorded bound is exceeded at a recorded point")
    end = float(holds_to)
    reach = (float(spec.chart.reach[0]), float(spec.chart.reach[1]))
    near = panels(surface(claim, spec.chart), reach, (0.99 * end, end), tolerance * SHARP)
    if not max(p.bound(sharp=160) for p in near) <= tolerance:
        raise Unbounded("the bound next to the recorded end no longer holds")
    evidence = {"within": str(spec.within), "largest error": short(size), "where": shown(worst),
                "proved bound": ceiling(bound)}  # fmt: skip
    points = [worst, broken, *spread(claim, spec.chart, float(spec.start), end)]
    return Found(tolerance, worst, size, bound, holds_to, broken, points, evidence, lemmas_of(claim))
