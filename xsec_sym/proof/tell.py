"""A section told aloud: each claim, its steps with a tick once checked, and the verdict it earns."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterable

from sympy import pretty

from xsec_sym.proof.claim import REGISTRY, Claim
from xsec_sym.proof.verdict import worst
from xsec_sym.proof.verify import verify

TOLD = ("largest error", "where", "proved bound", "reach", "holds to", "broken at", "largest error found", "at point",
        "digits agreed on", "share of the points within", "error of the print")  # fmt: skip


def tell(claims: Iterable[Claim]) -> None:
    """Verify the claims of a section and print how each one fares."""
    chosen = list(claims)
    for package in {c.module.split(".")[0] for c in chosen}:
        _import_all(package)
    earned: dict[str, str] = {}
    for claim in chosen:
        print(f"\n{claim.id}  {claim.title}")
        if claim.domain.symbols:
            print(f"    where {claim.domain.text()}")
        if claim.kind == "whole":
            words = [earned.get(p) or verify(REGISTRY[p], REGISTRY).verdict for p in claim.parts]
            earned[claim.id] = worst(words)
            print(f"  = {earned[claim.id]}, the worst of its {len(words)} parts")
            continue
        if claim.kind not in ("definition", "out-of-scope"):
            _show(claim)
        verdict = verify(claim, REGISTRY)
        earned[claim.id] = verdict.verdict
        for depth, said in verdict.steps:
            print(f"    {'  ' * depth}✓ {said}")
        if verdict.witness:
            print(f"  ✗ the print fails at {verdict.witness['point']}:")
            print(f"    {verdict.witness['left']} against {verdict.witness['right']}")
        for name in TOLD:
            if name in verdict.evidence:
                print(f"    {name}: {_plainly(verdict.evidence[name])}")
        tried = verdict.evidence.get("witnesses")
        numbers = f" ({tried} witnesses, {verdict.mutants} mutants rejected)" if tried else ""
        print(f"  = {verdict.verdict}{numbers}{'; ' + claim.edit if claim.edit else ''} {verdict.note}".rstrip())


def _show(claim: Claim) -> None:
    for word, side in (("printed", claim.printed), ("holds", claim.corrected)):
        if side is not None:
            print(f"    {word}:")
            print("\n".join("        " + line for line in pretty(side, use_unicode=True).splitlines()))


def _plainly(value: object) -> str:
    return ", ".join(f"{k} = {v}" for k, v in value.items()) if isinstance(value, dict) else str(value)


def _import_all(package: str) -> None:
    """A proof may lean on a claim of another section, so all sections of the same collection are read."""
    try:
        root = importlib.import_module(package)
    except ImportError:
        return
    for found in pkgutil.walk_packages(getattr(root, "__path__", []), f"{package}."):
        importlib.import_module(found.name)
