"""The sources as a reader knows them, and their entries in the order of the paper."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from xsec_sym.record.entry import Entry
from xsec_sym.record.sources import SOURCES, bibtex

ROWS = {
    "1": "1", "u": "x", "u2": "x^{2}", "u4": "x^{4}",
    "even": r"x^{p},\ p \text{ even}", "odd": r"x^{p},\ p \text{ odd}",
    "inv1p": r"\frac{1}{1 + x}", "inv1m": r"\frac{1}{1 - x}", "inv1m2": r"\frac{1}{(1 - x)^{2}}",
    "inv1pu2": r"\frac{1}{1 + x^{2}}",
}  # fmt: skip
SAID = {
    "1": "1", "u": "x", "u2": "x²", "u4": "x⁴", "even": "xᵖ, p even", "odd": "xᵖ, p odd", "inv1p": "1/(1 + x)",
    "inv1m": "1/(1 − x)", "inv1m2": "1/(1 − x)²", "inv1pu2": "1/(1 + x²)", "s1": "σ₁", "s2": "σ₂", "s3": "σ₃", "s": "σ",
    "neg": "u < 0", "zero": "u = 0", "pos": "u > 0",
}  # fmt: skip
COLUMNS = {
    "s1": r"\sigma_{1}",
    "s2": r"\sigma_{2}",
    "s3": r"\sigma_{3}",
    "s": r"\sigma = \sigma_{1} + \sigma_{2} + \sigma_{3}",
}
SIDES = {"neg": "u < 0", "zero": "u = 0", "pos": "u > 0"}


@dataclass(frozen=True)
class Paper:
    """A source: by whom, its title, and whether it is in print or the project's own."""

    key: str
    title: str
    authors: str = ""
    own: bool = False

    @property
    def page(self) -> str:
        return f"{self.key}.html"

    @property
    def errata(self) -> str:
        return f"errata-{self.key}.html"

    @property
    def bibtex(self) -> str:
        """Empty where nothing is known that a bibliography could hold."""
        return bibtex(self.key) if self.key in SOURCES else ""

    @property
    def short(self) -> str:
        return self.key.replace("_", " ")


PAPERS = {p.key: Paper(p.key, p.about or p.title, p.short, p.own) for p in SOURCES.values()}


def papers(record: Mapping[str, Entry]) -> list[Paper]:
    """Those of the record, the project's own last; a source that is not known here goes by its key."""
    keys = dict.fromkeys(e.source for e in record.values())
    known = [p for key, p in PAPERS.items() if key in keys]
    others = [Paper(key, key) for key in keys if key not in PAPERS]
    return [p for p in known if not p.own] + others + [p for p in known if p.own]


def in_order(entries: Iterable[Entry]) -> list[tuple[str, list[Entry]]]:
    """Sections with their entries as the paper has them: by number, an unnumbered one after the one it came after.

    >>> from xsec_sym.record.store import Ledger
    >>> [e.label for e in in_order(Ledger().source("deon2016"))[1][1]][:5]
    ['6', '7', '8', '8.piecewise', '8.piecewise.rest']
    """
    sections: dict[str, list[Entry]] = {}
    for entry in entries:
        sections.setdefault(entry.section, []).append(entry)
    if all(_numbers(name) for name in sections if name):
        sections = dict(sorted(sections.items(), key=lambda s: (_numbers(s[0]), s[0])))
    return [(name, _within(found)) for name, found in sections.items()]


def _numbers(text: str) -> tuple[int, ...]:
    found = re.match(r"\d+(\.\d+)*", text)
    return tuple(map(int, found[0].split("."))) if found else ()


def _number(entry: Entry) -> int | None:
    found = re.match(r"\d+", entry.label)
    return int(found[0]) if found else None


def _within(entries: list[Entry]) -> list[Entry]:
    keys: dict[str, tuple[int, int, int]] = {}
    cells = [e for e in entries if e.label.startswith("T1.")]
    texts = [e for e in entries if e not in cells]
    first = next((n for e in texts if (n := _number(e)) is not None), 0)
    last, rank = first, -1
    for place, entry in enumerate(texts):
        number = _number(entry)
        if number is not None:
            last, rank = number, 2
        own = 0 if entry.label == str(number) else 1
        keys[entry.id] = (last, own if number is not None else rank, place)
    for entry in texts:
        # a whole stands before its parts, though it is claimed after them
        parts = [keys[p] for p in entry.parts if p in keys and p.startswith(f"{entry.id}.")]
        if parts:
            keys[entry.id] = min(keys[entry.id], (*min(parts)[:2], min(parts)[2] - 1))
    return sorted(texts, key=lambda e: keys[e.id]) + sorted(cells, key=_cell)


def _cell(entry: Entry) -> tuple[int, ...]:
    """Row, column and side; what is not in the table stands last."""
    names = entry.label.split(".")[1:]
    kinds = (list(ROWS), list(COLUMNS), list(SIDES))
    return tuple(k.index(n) + 1 if n in k else len(k) + 1 for n, k in zip(names, kinds, strict=False))


def place(entry: Entry) -> str:
    """How a reader finds it in the paper.

    >>> from xsec_sym.record.store import Ledger
    >>> ledger = Ledger()
    >>> [place(ledger[f"deon2016:{label}"]) for label in ("22", "22.rings", "T1.u.s2", "claim.plausible")]
    ['(22)', '22.rings', 'Table 1, D = x, σ₂', 'plausible']
    """
    if re.fullmatch(r"\d+", entry.label):
        return f"({entry.label})"
    if re.fullmatch(r"\d+\.\d+", entry.label):
        return f"({entry.label.replace('.', '), part ')}"
    if entry.label.startswith("T1."):
        return "Table 1, D = " + ", ".join(SAID.get(p, p) for p in entry.label.split(".")[1:])
    return entry.label.removeprefix("claim.")
