"""An entry in words and formulas, for someone with the paper in hand; verdicts as lines and as a table."""

from __future__ import annotations

import contextlib
import textwrap
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from xsec_sym.record.entry import Entry
from xsec_sym.record.relation import sides

if TYPE_CHECKING:
    from rich.table import Table
    from sympy import Expr

    from xsec_sym.proof.verdict import Verdict

MEANING = {
    "definition": "it introduces a symbol; nothing in it could be false",
    "proved": "an exact proof, replayed move by move by the checker, and numerically checked",
    "confirmed": "no symbolic proof, but enclosures of the difference contain 0 at every point tested",
    "misprint": "the form in print is refuted; a corrected form holds",
    "claim-holds": "the property, or the accuracy stated, holds",
    "claim-fails": "the property, or the accuracy stated, does not hold",
    "divergent": "the quantity is infinite there",
    "out-of-scope": "no computation can settle it",
    "refuted": "it is false, and nobody has mended it",
    "inconclusive": "neither shown nor refuted",
    "timeout": "stopped at its limit of time or memory",
}
MEASURED = "no symbolic proof and no enclosure, but two independent methods agree at every point tested"
WIDTH = 100
INDENT = 2
UNSETTLED = ("refuted", "inconclusive", "timeout")
COLOURS = {"misprint": "yellow", "claim-fails": "yellow", **dict.fromkeys(UNSETTLED, "red")}
# How formulas stand: typeset over several lines, each in one line, or as LaTeX.
FORMS = ("pretty", "line", "latex")
# What puts a colour on a text, where there are colours.
Paint = Callable[[str, str], str]


def told(
    entry: Entry,
    ledger: Mapping[str, Entry],
    form: str = "pretty",
    wide: int = WIDTH,
    paint: Paint = lambda text, colour: text,
) -> str:
    """The entry as text, its formulas in one of the `FORMS` and typeset no wider than so many columns."""
    blocks = [_head(entry, paint)]
    blocks += [
        _formula(entry, name, form, wide)
        for name in ("printed", "corrected")
        if getattr(entry, name) is not None or (name == "printed" and not entry.wordless and entry.corrected is None)
    ]
    facts = [
        ("change", entry.edit),
        ("near", entry.nearness()),
        ("where", entry.domain),
        ("reading", entry.reading),
        ("note", entry.note),
        ("evidence", _evidence(entry)),
        *(("argument", words) for words in entry.evidence.get("in words", [])),
    ]
    lines = [_field(name, text) for name, text in facts if text]
    if entry.witness:
        lines.append(_witness(entry.witness))
    if lines:
        blocks.append("\n".join(lines))
    if entry.parts:
        blocks.append("\n".join(["parts", *(f"  {_part(name, ledger)}" for name in entry.parts)]))
    if entry.steps:
        blocks.append("\n".join(["steps", *(_step(depth, said) for depth, said in entry.steps)]))
    return "\n\n".join(blocks)


def listed(entries: Iterable[Entry], paint: Paint = lambda text, colour: text) -> str:
    """A line on each entry."""
    found = list(entries)
    wide = max((len(e.id) for e in found), default=0)
    return "\n".join(f"{e.id:<{wide}}  {paint(f'{e.verdict:<12}', colour(e.verdict))}  {e.title}" for e in found)


def _head(entry: Entry, paint: Paint) -> str:
    place = f"section {entry.section}" if entry.section else ""
    head = f"{entry.id}  {entry.title}" + (f"  ({entry.source}, {place})" if place else "")
    word = entry.verdict + (f" to {entry.digits} digits" if entry.verdict == "confirmed" and entry.digits else "")
    solved = entry.verdict == "confirmed" and "digits agreed on" in entry.evidence
    return f"{head}\n{paint(word, colour(entry.verdict))}: {MEASURED if solved else MEANING[entry.verdict]}"


def colour(verdict: str) -> str:
    return COLOURS.get(verdict, "green")


def _formula(entry: Entry, name: str, form: str, wide: int) -> str:
    left = right = None
    if form != "latex":
        with contextlib.suppress(ValueError, KeyError, TypeError):
            left, right = sides(entry, name)
    relation = entry.relation(name)
    if left is None or (right is None and getattr(entry, name) is not None):
        text = entry.latex(name)
    else:
        shown = [left] if right is None else [left, right]
        text = (form == "pretty" and _typeset(shown, relation, wide)) or f" {relation} ".join(map(_in_line, shown))
        if form == "pretty" and "\n" not in text:
            # a formula wider than the page is easier to read in one line than torn into stacks
            text = textwrap.fill(text, wide, break_long_words=False, break_on_hyphens=False)
    return f"{entry.heading(name)}\n{textwrap.indent(text, ' ' * INDENT)}"


def _in_line(side: Expr) -> str:
    # the magnitude that is left as it is reads as any other
    return str(side).replace("Magnitude(", "Abs(")


def _typeset(sides: list[Expr], relation: str, wide: int) -> str:
    """Side by side where that fits, one below the other where not; nothing if even so it is too wide."""
    from sympy.printing.pretty.pretty import PrettyPrinter, pretty_use_unicode

    before = pretty_use_unicode(True)
    try:
        # pictures know on which of their lines a sign has to stand
        pictures = [PrettyPrinter({"num_columns": 10_000})._print(side) for side in sides]
    finally:
        pretty_use_unicode(before)
    beside = str(_beside(pictures[0], pictures[1], relation)) if len(pictures) == 2 else str(pictures[0])
    for text in (beside, f"\n{relation}\n".join(map(str, pictures))):
        if max(map(len, text.splitlines())) <= wide:
            return text
    return ""


def _beside(left: Any, right: Any, relation: str) -> Any:
    from sympy.printing.pretty.stringpict import stringPict

    return stringPict(*left.right(f" {relation} ", right))


def _field(name: str, text: str) -> str:
    return textwrap.fill(text, WIDTH, initial_indent=f"{name:<10}", subsequent_indent=" " * 10)


def _evidence(entry: Entry) -> str:
    said = [
        f"{name.replace('_', ' ')}: {_said(value)}"
        for name, value in entry.evidence.items()
        if value not in ([], {}, None) and name != "in words"
    ]
    if entry.mutants:
        said.append(f"{entry.mutants} altered forms rejected")
    return "; ".join([*said, f"{entry.seconds:g} s"]) if said else ""


def _said(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, dict):
        return ", ".join(f"{k} = {_said(v)}" for k, v in value.items())
    return ", ".join(map(_said, value)) if isinstance(value, list) else str(value)


def _witness(witness: Mapping[str, Any]) -> str:
    return "\n".join(_field("fails at" if name == "point" else f"  {name}", _point(value))
                     for name, value in witness.items())  # fmt: skip


def _point(value: Any) -> str:
    return ", ".join(f"{k} = {v}" for k, v in value.items()) if isinstance(value, dict) else str(value)


def _part(name: str, ledger: Mapping[str, Entry]) -> str:
    return f"{name}  {ledger[name].verdict}  {ledger[name].title}" if name in ledger else f"{name}  not in the record"


def _step(depth: int, said: str) -> str:
    indent = "  " * (depth + 1)
    return textwrap.fill(said, WIDTH, initial_indent=indent, subsequent_indent=indent + "    ",
                         break_long_words=False, break_on_hyphens=False)  # fmt: skip


# --- verdicts ------------------------------------------------------------------------------------------


def answer(verdict: Verdict, paint: Paint = lambda text, colour: text) -> str:
    """The verdict on a user's own equation."""
    word = verdict.verdict + (
        f" to {verdict.digits} digits" if verdict.verdict == "confirmed" and verdict.digits else ""
    )
    meaning = "the two sides differ" if verdict.verdict == "refuted" else MEANING[verdict.verdict]
    lines = [f"{paint(word, colour(verdict.verdict))}: {meaning}"]
    if verdict.witness:
        lines.append(_witness(verdict.witness))
    if verdict.note:
        lines.append(_field("note", verdict.note))
    lines += [_step(depth, said) for depth, said in verdict.steps]
    return "\n".join(lines)


COLUMNS = ("id", "verdict", "digits", "mutants", "seconds")


def rows(entries: Iterable[Entry]) -> list[tuple[str, str, str, str, str]]:
    return [
        (e.id, e.verdict, str(e.digits or ""), str(e.mutants or ""), f"{e.seconds:.2f}" if e.seconds else "")
        for e in entries
    ]


def lines(entries: Iterable[Entry]) -> list[str]:
    """The table for a pipe: one line an entry, whatever the width of a terminal."""
    found = [COLUMNS, *rows(entries)]
    wide = max(len(r[0]) for r in found)
    return [f"{r[0]:<{wide}}  {r[1]:<12}  {r[2]:>6}  {r[3]:>7}  {r[4]:>7}".rstrip() for r in found]


def table(entries: Iterable[Entry]) -> Table:
    """The table for a terminal."""
    from rich.table import Table

    made = Table(box=None, pad_edge=False)
    for name in COLUMNS[:2]:
        made.add_column(name, no_wrap=True)
    for name in COLUMNS[2:]:
        made.add_column(name, justify="right")
    for row in rows(entries):
        made.add_row(row[0], f"[{colour(row[1])}]{row[1]}[/]", *row[2:])
    return made


def summary(entries: Iterable[Entry]) -> list[str]:
    """How many entries carry each verdict, best first."""
    count = Counter(e.verdict for e in entries)
    return [f"{count[word]:>4} {word}" for word in sorted(count, key=list(MEANING).index)]
