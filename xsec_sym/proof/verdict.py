"""The one definition of a verdict: a word that was earned, and what earned it."""

from __future__ import annotations

from dataclasses import dataclass, field
from html import escape
from typing import Any

# From best to worst: a display with several parts carries the worst verdict of its parts.
RANK = (
    "definition",
    "proved",
    "confirmed",
    "claim-holds",
    "out-of-scope",
    "divergent",
    "claim-fails",
    "misprint",
    "refuted",
    "inconclusive",
    "timeout",
)
SETTLED = frozenset(RANK) - {"refuted", "inconclusive", "timeout"}


@dataclass(frozen=True)
class Verdict:
    """What became of one claim.

    ``witness`` is a point where a printed form fails, with both values; ``evidence`` counts what was done;
    ``steps`` tells the derivation as (depth, sentence) pairs; ``certificate`` replays it. "refuted" occurs only for
    an equation that nobody has mended: a user's own, or a print without a corrected form.
    """

    verdict: str
    digits: int | None = None
    witness: dict[str, Any] | None = None
    evidence: dict[str, Any] = field(default_factory=dict)
    mutants: int = 0
    seconds: float = 0.0
    steps: tuple[tuple[int, str], ...] = ()
    certificate: dict[str, Any] | None = None
    note: str = ""

    def __post_init__(self) -> None:
        if self.verdict not in RANK:
            raise ValueError(f"{self.verdict!r} is not a verdict; the verdicts are {', '.join(RANK)}")

    @property
    def settled(self) -> bool:
        return self.verdict in SETTLED

    def _repr_html_(self) -> str:
        extra = f" ({self.digits} digits)" if self.digits and self.verdict == "confirmed" else ""
        at = f" at {escape(str(self.witness['point']))}" if self.witness else ""
        return f"<b>{self.verdict}</b>{extra}{at} {escape(self.note)}"


def worst(verdicts: list[str]) -> str:
    return max(verdicts, key=RANK.index)
