"""The verdict that a claim earns today, without doing again what the record already holds for this very code.

A recorded verdict has a key: a digest of the claim, its derivation, the proof engine and the tools' versions. Where it
is today's, all witnesses and all mutants were tried on this very code when it was recorded; then the recorded proof is
replayed, or the two sides are held against each other, at a few witnesses, and other ones. Where it is not, and under
``--deep``, everything is done anew.
"""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import replace
from functools import cache
from unittest.mock import patch

from xsec_sym import ledger
from xsec_sym.proof import measured, verify
from xsec_sym.proof.claim import REGISTRY, Claim
from xsec_sym.proof.verdict import Verdict
from xsec_sym.record.key import Keys

FEW = 4  # witnesses; a proof takes half as many, and a print that was recorded as wrong must still fail at one
OTHER = 1  # the seed of those few: the record has 0
# in two and three variables, where values are cheap, the grid is whole; the search around the worst point always is
COARSE = {**measured.GRID, 1: (61,), 4: (5, 5, 5, 5)}


@cache
def keys() -> Keys:
    return Keys(REGISTRY)


def recorded(claim: Claim) -> bool:
    """Whether nothing has changed that the recorded verdict rests on."""
    if claim.id not in ledger or not ledger[claim.id].settled:
        return False
    return ledger[claim.id].key == keys().of(claim.id, ledger.certificate(claim.id))


def earned(claim: Claim, *, deep: bool, seed: int = 0) -> Verdict:
    """The verdict on a claim. One that agrees with the record has the mutants of the record, if it tried none."""
    if deep or not recorded(claim):
        return verify.verify(claim, REGISTRY, seed=seed)
    certificate = ledger.certificate(claim.id)
    with ExitStack() as stack:
        if certificate is None:  # then 20 witnesses are the rule of the engine, whatever it is asked for
            stack.enter_context(patch.multiple(verify, WITNESSES=FEW, ROUTES=1))
            stack.enter_context(patch.object(measured, "GRID", COARSE))
        verdict = verify.verify(claim, REGISTRY, seed=seed or OTHER, witnesses=FEW, certificate=certificate)
    entry = ledger[claim.id]
    if verdict.verdict == entry.verdict and not verdict.mutants:
        return replace(verdict, mutants=entry.mutants)
    return verdict
