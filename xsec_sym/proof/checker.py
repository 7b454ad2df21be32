"""The small checker: replay a certificate against the claim that it names.

It rebuilds the goal from the claim, never from the certificate, and applies the recorded moves. It does not know how
the moves were found.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from sympy import Symbol

from xsec_sym.proof import calculus, induction, plane, rules, sphere, wire
from xsec_sym.proof.claim import Claim
from xsec_sym.proof.field import Unsettled
from xsec_sym.proof.regular import Refused
from xsec_sym.proof.rules import Goal

MOVES: dict[str, Callable[..., list[Goal]]] = {
    move.__name__: move
    for move in (
        rules.cases,
        rules.vacuous,
        rules.fact,
        rules.unfold,
        rules.swap,
        rules.nest,
        rules.rewrite,
        rules.settle,
        rules.close,
        rules.lemma,
        rules.ode,
        induction.induct,
        induction.dominate,
        calculus.split,
        calculus.extend,
        calculus.linear,
        calculus.exchange,
        calculus.substitute,
        calculus.antiderivative,
        calculus.recurrence,
        calculus.telescope,
        calculus.diverges,
        plane.polar,
        sphere.turn,
        sphere.funk_hecke,
        sphere.parities,
        sphere.bessel,
        sphere.wave,
        sphere.beats,
        sphere.shear,
        sphere.harmonics,
        sphere.taylor,
        sphere.peel,
    )
}

Certificate = dict[str, Any]
FORMAT = 1


def opening(claim: Claim) -> Goal:
    return rules.start(claim.left, claim.form, claim.domain)


def apply(goal: Goal, move: str, data: Mapping[str, Any], claims: Mapping[str, Claim]) -> list[Goal]:
    """One move, with the lemma's name looked up; a refusal is a `Refused`, whatever raised it."""
    if move not in MOVES:
        raise Refused(f"there is no move called {move}")
    filled = dict(data)
    if "proven" in filled:
        if filled["proven"] not in claims:
            raise Refused(f"there is no claim called {filled['proven']}")
        filled["proven"] = claims[filled["proven"]]
    try:
        return MOVES[move](goal, **filled)
    except Unsettled as reason:
        raise Refused(str(reason)) from reason


def replay(claim: Claim, certificate: Certificate, claims: Mapping[str, Claim]) -> int:
    """Replay the moves; return how many there were. Raises `Refused` where one does not follow."""
    if certificate.get("format") != FORMAT or certificate.get("claim") != claim.id:
        raise Refused(f"this certificate is not one for {claim.id}")
    return _replay(opening(claim), certificate["moves"], claims, symbols_of(claim))


def symbols_of(claim: Claim) -> dict[str, Symbol]:
    return {s.name: s for s in claim.domain.symbols}


def _replay(goal: Goal, moves: list[Any], claims: Mapping[str, Claim], symbols: dict[str, Symbol]) -> int:
    if not moves:
        raise Refused("the certificate ends before the goal is closed")
    (name, data, *branches), *rest = moves
    goals = apply(goal, name, wire.decode(data, symbols), claims)
    if branches:
        if rest or len(branches) != len(goals):
            raise Refused(f"{name} leaves {len(goals)} goals, the certificate closes {len(branches)}")
        return 1 + sum(_replay(g, b, claims, symbols) for g, b in zip(goals, branches, strict=True))
    if not goals:
        if rest:
            raise Refused("the certificate goes on after the goal is closed")
        return 1
    if len(goals) != 1:
        raise Refused(f"{name} leaves {len(goals)} goals without a branch for each")
    return 1 + _replay(goals[0], rest, claims, symbols)


def lemmas(moves: list[Any]) -> set[str]:
    """The ids of the claims that a certificate leans on."""
    found: set[str] = set()
    for _, data, *branches in moves:
        if "proven" in data:
            found.add(data["proven"])
        for branch in branches:
            found |= lemmas(branch)
    return found
