"""Table 1 of deon2016 as a whole: what holds in each cell, and how it came there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from markupsafe import Markup

from xsec_sym.record.entry import Entry
from xsec_sym.report.difference import mark
from xsec_sym.report.formula import set_, tree, written
from xsec_sym.report.items import Item
from xsec_sym.report.papers import COLUMNS, ROWS, SIDES

TABLE = "deon2016:T1."


@dataclass(frozen=True)
class Cell:
    """A cell: its class, and its lines, each with the side of u = 0 for which it is meant."""

    id: str
    kinds: str
    verdict: str
    lines: tuple[tuple[str, Markup], ...]

    @property
    def label(self) -> str:
        return self.id.partition(":")[2]


@dataclass(frozen=True)
class Row:
    name: Markup
    cells: tuple[Cell, ...]


def rows(record: Mapping[str, Entry], found: Mapping[str, Item]) -> list[Row]:
    """The rows that the record has, in the order of the print."""
    return [
        Row(
            Markup(set_(distribution, display=False)),
            tuple(_cell(f"{TABLE}{row}.{column}", record) for column in COLUMNS if f"{TABLE}{row}.{column}" in found),
        )
        for row, distribution in ROWS.items()
        if any(f"{TABLE}{row}.{column}" in found for column in COLUMNS)
    ]


def _cell(name: str, record: Mapping[str, Entry]) -> Cell:
    whole = record[name]
    sides = [record[f"{name}.{side}"] for side in SIDES if f"{name}.{side}" in record]
    parts = sides or [whole]
    lines = tuple((SIDES.get(p.label.rpartition(".")[2], ""), _formula(p)) for p in parts)
    return Cell(name, " ".join(kinds(whole, parts)), whole.verdict, lines)


def kinds(whole: Entry, parts: list[Entry]) -> list[str]:
    """The classes of a cell.

    >>> from xsec_sym.record.store import Ledger
    >>> cell = Ledger()["deon2016:T1.u4.s3"]
    >>> kinds(cell, [cell])
    ['cell-filled']
    """
    found = []
    if all(p.printed is None for p in [whole, *parts]):
        found.append("cell-filled")
    elif any(p.verdict == "misprint" for p in parts):
        found.append("cell-misprint")
    else:
        found.append("cell-printed")
    if any(p.verdict == "divergent" for p in parts):
        found.append("cell-infinite")
    return found


def _formula(entry: Entry) -> Markup:
    if entry.corrected is None:
        return Markup(set_(entry.printed or "", display=False))
    corrected = tree(entry.corrected)
    if entry.printed is not None:
        mark(tree(entry.printed), corrected)
    return Markup(written(corrected, display=False))
