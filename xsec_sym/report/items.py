"""What a page shows of an entry."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from markupsafe import Markup

from xsec_sym.record.entry import Entry
from xsec_sym.record.relation import parts
from xsec_sym.record.show import MEANING, MEASURED
from xsec_sym.report import words
from xsec_sym.report.code import Code
from xsec_sym.report.difference import mark
from xsec_sym.report.formula import equation, tree
from xsec_sym.report.papers import place

# Verdicts as the index counts them: a heading, and the words under it.
GROUPS = {
    "proved": ("proved",),
    "confirmed": ("confirmed",),
    "misprinted": ("misprint",),
    "claims that hold": ("claim-holds",),
    "claims that fail": ("claim-fails",),
    "infinite": ("divergent",),
    "definitions": ("definition",),
    "beyond computation": ("out-of-scope",),
    "not settled": ("refuted", "inconclusive", "timeout"),
}
ONE = {"claims that hold": "claim that holds", "claims that fail": "claim that fails", "definitions": "definition"}
# By what an approximation is judged.
ERRORS = ("error of the print", "error of the form at points", "largest error found", "within")
# What is told elsewhere on the page.
SILENT = ("in words", "lemmas", "parts", "moves")
# The names of the record in words that say what was done, and more of it for whoever points at them.
SAID = {
    "proof": ("exact proof", "whether the checker can replay moves that lead to exact zero"),
    "enclosure": ("ball arithmetic", "whether both sides were enclosed in balls, that is with bounds of every error"),
    "witnesses": ("points tried", "where the ball of the difference contains 0 and is small enough"),
    "digits tried": ("digits asked for", "of the difference, at each of the points"),
    "mpmath": ("points by mpmath as well", "where a second library agrees by another route"),
    "mutants equal to the form": ("altered forms that are the same", "they are the same function, and so no test"),
    "altered forms rejected": (
        "altered forms rejected", "by the same check: signs flipped, factors of 2, other exponents, terms dropped",
    ),
    "altered forms that are as near": ("altered forms as near", "which this accuracy cannot tell from the form"),
}  # fmt: skip
# SymPy's sign for the function that is 1 for positive arguments and 0 for negative ones.
STEP = r"\theta\left("
UNIT_STEP = Markup("<i>θ</i>(…) is the unit step: 1 for positive arguments, 0 for negative ones")
ALIKE = "built separately, and written by SymPy as the same expression"


@dataclass(frozen=True)
class Item:
    """An entry with all that its article needs."""

    entry: Entry
    record: Mapping[str, Entry] = field(repr=False)
    users: tuple[str, ...] = ()
    code: Code | None = None
    certified: bool = False

    @property
    def anchor(self) -> str:
        return self.entry.label

    @property
    def place(self) -> str:
        return place(self.entry)

    @property
    def title(self) -> Markup:
        """Cells of the table are named by their place alone."""
        return Markup() if self.entry.label.startswith("T1.") else words.titled(self.entry.title)

    @property
    def section(self) -> str:
        return self.entry.section.partition(",")[0] if self.entry.label.startswith("T1.") else self.entry.section

    @property
    def meaning(self) -> str:
        measured = self.entry.verdict == "confirmed" and "digits agreed on" in self.entry.evidence
        return MEASURED if measured else MEANING[self.entry.verdict]

    @property
    def verdict(self) -> str:
        e = self.entry
        return f"confirmed, {e.digits} digits" if e.verdict == "confirmed" and e.digits else e.verdict.replace("-", " ")

    @property
    def fails(self) -> bool:
        return self.entry.verdict in ("claim-fails", "refuted")

    # --- formulas --------------------------------------------------------------------------------------

    @cached_property
    def formulas(self) -> list[tuple[str, str, Markup]]:
        """A heading, a class and the formula, for each form; both forms of a misprint with their difference."""
        e = self.entry
        if e.wordless:
            return []
        if e.printed is not None and e.corrected is not None:
            printed, corrected = tree(e.printed), tree(e.corrected)
            mark(printed, corrected)
            return [
                ("in print", "print", self._equation(printed, "printed")),
                ("what holds", "holds", self._equation(corrected, "corrected")),
            ]
        right = e.printed if e.corrected is None else e.corrected
        if e.verdict == "definition" and self._alike:
            right = None
        if e.printed is None and e.label.startswith("T1.") and e.corrected is not None:
            return [("blank in print; what holds", "holds", self._equation(tree(e.corrected), "corrected"))]
        side = "printed" if e.corrected is None else "corrected"
        heading, kind = ("as stated", "print") if self.fails else ("", "plain")
        return [(heading, kind, self._equation(None if right is None else tree(right), side))]

    def _equation(self, right: Any, side: str) -> Markup:
        relation = self.entry.relation(side)
        if relation == "≥":
            greater, lesser = map(tree, parts(self.entry, side))  # type: ignore[arg-type]
            return Markup(equation(greater, lesser, relation))
        return Markup(equation(tree(self.entry.left) if self.entry.left else None, right, relation))

    # --- facts ------------------------------------------------------------------------------------------

    def linked(self, text: str) -> Markup:
        return words.linked(text, self.record)

    @cached_property
    def facts(self) -> list[tuple[str, Markup]]:
        e = self.entry
        found = [
            ("change", self.linked(e.edit)),
            ("near", Markup.escape(e.nearness())),
            ("where", words.symbols(e.domain)),
            ("reading", self.linked(e.reading)),
            ("note", self.linked(e.note if e.note != e.reading else "")),
            (
                "sign",
                Markup("<i>θ</i>(…) is the unit step: 1 for positive arguments, 0 for negative ones" * self._steps),
            ),
            ("sides", Markup.escape(ALIKE * (self._alike and e.verdict != "definition"))),
        ]
        return [(name, text) for name, text in found if text]

    @property
    def _steps(self) -> bool:
        return any(STEP in (text or "") for text in (self.entry.left, self.entry.printed, self.entry.corrected))

    @property
    def _alike(self) -> bool:
        right = self.entry.printed if self.entry.corrected is None else self.entry.corrected
        return bool(self.entry.left) and self.entry.left == right

    @cached_property
    def witness(self) -> list[tuple[str, Markup]]:
        found = self.entry.witness or {}
        shown = {"point": "fails at", "left": "left side", "right": "right side as printed" if self.printed else
                 "right side"}  # fmt: skip
        return [
            (shown.get(name, name), self._point(value) if isinstance(value, dict) else Markup.escape(words.ball(value)))
            for name, value in found.items()
        ]

    @property
    def printed(self) -> bool:
        return self.entry.printed is not None

    @staticmethod
    def _point(value: Mapping[str, Any]) -> Markup:
        return Markup(", ").join(words.symbols(f"{k} = {v}") for k, v in value.items())

    @cached_property
    def evidence(self) -> list[tuple[str, Markup]]:
        e = self.entry
        found = [
            (SAID.get(name, (name,))[0], self.linked(words.said(value)))
            for name, value in e.evidence.items()
            if value not in ([], {}, None) and name not in SILENT
        ]
        if e.mutants:
            found.append(("altered forms rejected", Markup.escape(str(e.mutants))))
        return found + [("argument", self.linked(text)) for text in e.evidence.get("in words", [])]

    @property
    def holds_by(self) -> str:
        """How it is known that the corrected form of a misprint holds."""
        e = self.entry
        how = e.evidence.get("corrected form")
        if how:
            return f"The corrected form is {how}{f' to {e.digits} digits' if how == 'confirmed' and e.digits else ''}."
        if e.kind == "equation" and "digits agreed on" in e.evidence:
            return f"The corrected form agrees with independent solutions to {e.evidence['digits agreed on']} digits."
        errors = [f"{name}: {words.said(e.evidence[name])}" for name in ERRORS if name in e.evidence]
        return f"An approximation is judged by its error ({'; '.join(errors)})." if errors else ""

    @property
    def steps(self) -> list[tuple[int, Markup]]:
        return [(min(depth, 9), self.linked(text)) for depth, text in self.entry.steps]

    @property
    def certificate(self) -> str:
        return f"certificates/{self.entry.source}/{self.entry.label}.json" if self.certified else ""

    @property
    def cited(self) -> str:
        return self.entry.bibtex()

    @property
    def moves(self) -> int | None:
        return self.entry.evidence.get("moves")

    @property
    def uses(self) -> list[str]:
        return uses(self.entry, self.record)

    @property
    def find(self) -> str:
        """What a search looks through."""
        e = self.entry
        return " ".join([e.id, self.place, e.title, e.section, e.verdict, e.edit, e.reading]).lower()


def uses(entry: Entry, record: Mapping[str, Entry]) -> list[str]:
    """The entries that this one's proof, bound or display rests on."""
    found = [*entry.evidence.get("lemmas", []), *entry.evidence.get("rests on", []), *entry.parts]
    return [name for name in dict.fromkeys(found) if name in record and name != entry.id]


def items(record: Any, codes: Mapping[str, Code]) -> dict[str, Item]:
    """All entries, each knowing which others use it."""
    users: dict[str, list[str]] = {}
    for entry in record.values():
        for name in uses(entry, record):
            users.setdefault(name, []).append(entry.id)
    return {
        e.id: Item(e, record, tuple(users.get(e.id, ())), codes.get(e.id), record.certificate(e.id) is not None)
        for e in record.values()
    }


def helped(name: str) -> str:
    """More of a fact, for whoever points at its name."""
    return next((more for said, more in SAID.values() if said == name), words.TERMS.get(name, ""))


def counted(name: str, count: int) -> str:
    """The heading of a group, for one entry or more."""
    return ONE.get(name, name) if count == 1 else name


def misprints(entries: list[Entry]) -> list[Entry]:
    return [e for e in entries if e.verdict == "misprint"]
