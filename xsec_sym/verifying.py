"""What `xsec verify` does beside verifying: which claims are meant, and where the verdicts go."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TextIO

from xsec_sym.terminal import coloured, complain, nearest_or_all, one_line, say

if TYPE_CHECKING:
    from xsec_sym.proof.claim import Claim
    from xsec_sym.proof.verdict import Verdict
    from xsec_sym.record.store import Ledger


def efforts(names: Sequence[str], ledger: Any) -> dict[str, float]:
    """What share of the time an entry is expected to take: by its seconds in the record."""
    return {name: 0.1 + (ledger[name].seconds if name in ledger else 5.0) for name in names}


def claims_of(derivations: str | None) -> dict[str, Any]:
    from xsec_sym.record.discover import BrokenDerivation, discover

    try:
        return discover(derivations)
    except BrokenDerivation as error:
        complain(error)


def chosen_ids(ids: Sequence[str], sources: Sequence[str], claims: dict[str, Any], ledger: Any) -> list[str]:
    from xsec_sym.record.store import nearest

    known = list(dict.fromkeys(c.source for c in claims.values()))
    for name in ids:
        if name not in claims:
            hint = f", but a source: --source {name}" if name in known else nearest(name, claims)
            complain(f"there is no claim {name}{hint}")
    for key in sources:
        if key not in known:
            complain(f"there is no source {key}{nearest_or_all(key, known)}")
    if not ids and not sources:
        return list(claims)
    return [name for name, c in claims.items() if name in ids or c.source in sources]


def on_cluster(address: str, settings: Any) -> Any:
    from xsec_sym.record.cluster import NoCluster, remote

    try:
        return remote(address, settings)
    except NoCluster as error:
        complain(error)


def keep(results: Any, kept: Any, ledger: Any, claims: dict[str, Any], gone: list[str], own: set[str]) -> None:
    """Claims of the user's own are recorded beside them, the project's in the package."""
    from xsec_sym.record.store import Ledger

    entries, certificates = kept
    for folder, mine in [(ledger.folders[0], False), *((f, True) for f in ledger.folders[1:])]:
        here = [e for e in entries if (e.id in own) == mine]
        stored = Ledger(folder)
        dropped = [name for name in gone if name in stored]
        if here or dropped:
            proofs = {e.id: certificates[e.id] for e in here}
            try:
                stored.write(here, proofs, order=claims, gone=dropped)
            except OSError as error:
                complain(f"cannot write the record in {folder}: {error.strerror or error}")


def write_json(out: TextIO, entries: list[Any], digits: int) -> None:
    from xsec_sym import __version__
    from xsec_sym.record.files import layout

    data = {"version": __version__, "digits": digits, "entries": [e.public() for e in entries]}
    out.write(layout(data) + "\n")


def print_verdicts(entries: Sequence[Any]) -> None:
    from xsec_sym.record import show

    if coloured():
        from rich.console import Console

        # where colours are forced into a pipe, no line is folded for its sake
        console = Console(width=None if sys.stdout.isatty() else 200)
        # a pipe that is closed is not for the library to see
        with console.capture() as table:
            console.print(show.table(entries))
        say(table.get().rstrip("\n"))
    else:
        for line in show.lines(entries):
            say(line)
    for entry in entries:
        # what is confirmed has a note where its proof does not go through
        if entry.note and (not entry.settled or entry.verdict == "confirmed"):
            say(f"{entry.id}: {one_line(entry.note)}")


def print_so_far(met: Mapping[str, Verdict], claims: Mapping[str, Claim], expected: int) -> None:
    """What was found before somebody pressed Ctrl-C."""
    from xsec_sym.record.entry import Entry

    said = [
        Entry(id=name, source=claims[name].source, label=claims[name].label, title=claims[name].title,
              verdict=v.verdict, digits=v.digits, mutants=v.mutants, seconds=round(v.seconds, 2), note=v.note)
        for name, v in met.items()
    ]  # fmt: skip
    if said:
        print_verdicts(said)
    if expected:
        say(f"{len(said)} of {expected} verdicts, and none of them compared with the record")


def closing(entries: Sequence[Any], gone: Sequence[str], ledger: Ledger, recorded: bool, seconds: float) -> str:
    """The last line: whether all is as it was recorded. ``ledger`` is the record as it was before; ``gone`` are the ids
    in it that nothing claims any more.
    """
    new = sum(e.id not in ledger for e in entries)
    other = sum(e.id in ledger and ledger[e.id].verdict != e.verdict for e in entries)
    open_ = sum(not e.settled for e in entries)
    same = len(entries) - new - other
    if recorded:
        parts = ["recorded"]
    elif same == len(entries) and not gone:
        parts = ["all as recorded" if same != 1 else "as recorded"]
    else:
        parts = [f"{same} as recorded"] * bool(same) + [f"{other} other than recorded"] * bool(other)
        parts += [f"{new} not in the record"] * bool(new) + [f"{len(gone)} gone"] * bool(gone)
    parts += [f"{open_} not settled"] * bool(open_)
    return f"{len(entries)} verdict{'s' * (len(entries) != 1)}: {', '.join(parts)}; {seconds:.1f} s"
