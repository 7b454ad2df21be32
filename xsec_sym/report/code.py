"""The NumPy code of the entries: looked for once, since that takes minutes, and kept; a report only assembles it.

`python -m xsec_sym.report.code` looks for what is missing or out of date. Code is kept under a hash of the form and of
the domain that it computes, so that it is shown only while these are the recorded ones.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from xsec_sym.record.entry import Entry
from xsec_sym.record.files import layout, writing

STORED = Path(__file__).parent / "data" / "code.json"
Record = Mapping[str, Entry]


@dataclass(frozen=True)
class Code:
    """A module as text, by what name it is exported, and what the reader is told where there is none."""

    name: str
    text: str = ""
    refused: str = ""


def fingerprint(entry: Entry, record: Record) -> str:
    """Changes with the form that holds, its domain, what the docstring says of them, and those of the parts.

    >>> from xsec_sym.record.store import Ledger
    >>> record = Ledger()
    >>> fingerprint(record["deon2016:9"], record) == fingerprint(record["deon2016:10"], record)
    False
    """
    side = "printed" if entry.corrected is None else "corrected"
    parts = [fingerprint(record[p], record) for p in entry.parts if p in record]
    told = [entry.id, entry.verdict, entry.encoded.get(side), entry.variables, entry.title, entry.reading, parts]
    return hashlib.sha256(json.dumps(told, sort_keys=True).encode()).hexdigest()[:16]


def kept() -> dict[str, Any]:
    return json.loads(STORED.read_text(encoding="utf-8")) if STORED.exists() else {}


def codes(record: Record) -> dict[str, Code]:
    """For each entry that has code: hand-made and generated kernels by their names, the others as they are kept."""
    from xsec_sym.export import module
    from xsec_sym.export.assemble import function_name
    from xsec_sym.export.kernel import Refusal
    from xsec_sym.export.recipes import RECIPES

    found: dict[str, Code] = {}
    for name, stored in kept().items():
        if name in record and stored["key"] == fingerprint(record[name], record):
            if "text" in stored:
                found[name] = Code(name, _module(function_name(name), name, stored["text"]))
            else:
                found[name] = Code(name, refused=stored["refused"])
    for recipe in RECIPES.values():
        try:
            code = Code(recipe.name, module([recipe.name], record=record))
        except Refusal:
            continue
        for name in (recipe.cell, *recipe.ids):
            if name in record:
                found[name] = code
    return found


def _module(public: str, name: str, text: str) -> str:
    from xsec_sym.export.assemble import HEAD
    from xsec_sym.export.source import Cutting, joined

    cut = Cutting()
    cut.add(f"entry {name}", HEAD + text, public)
    return "\n".join(cut.imports()) + "\n\n\n" + joined(cut.texts())


def look(record: Record, names: Iterable[str] | None = None) -> None:
    """Export what is missing or out of date, and drop what is no longer recorded."""
    from xsec_sym.export.assemble import closed, function_name, written
    from xsec_sym.export.kernel import Refusal
    from xsec_sym.export.recipes import RECIPES

    cells = {name for r in RECIPES.values() for name in (r.cell, *r.ids)}
    wanted = {entry.id for entry, _ in closed(record)} - cells
    found = {name: code for name, code in kept().items() if name in wanted}
    for name in sorted(wanted if names is None else wanted & set(names)):
        key = fingerprint(record[name], record)
        if names is None and found.get(name, {}).get("key") == key and not _improved(found[name], name, record):
            continue
        try:
            found[name] = {"key": key, "text": written(function_name(name), record[name], record)}
        except Refusal as error:
            found[name] = {"key": key, "refused": str(error).removeprefix(f"{name} cannot be exported: ")}
        except Exception as error:
            # the exporter failed where it should have refused: a page can say so, and the others are still made
            found[name] = {"key": key, "refused": f"the exporter fails on this form ({type(error).__name__})"}
        print(f"{name}: {found[name].get('refused', 'exported')}", flush=True)
        with writing(STORED) as out:
            out.write(layout(dict(sorted(found.items())), 2) + "\n")


def _improved(code: dict[str, Any], name: str, record: Record) -> bool:
    """Whether the exporter has learned what it lacked for a form; named entries are exported anew in any case."""
    from xsec_sym.export.assemble import available

    return "refused" in code and name in available({name: record[name]})


if __name__ == "__main__":
    import sys

    from xsec_sym.record.store import ledger

    look(ledger, sys.argv[1:] or None)
