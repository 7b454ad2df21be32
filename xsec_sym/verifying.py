"""What `xsec verify` does beside verifying: which claims are meant, and where the verdicts go."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any, TextIO

from xsec_sym.terminal import Interrupted, calm, coloured, complain, nearest_or_all, one_line, say


class Stopped(Interrupted):
    """Ctrl-C came before all was verified; what was is told."""

    def __init__(self, run: Any, record: bool) -> None:
        self.entries = [r.entry for r in run.results()]
        kept = "; nothing is recorded" if record else ""
        super().__init__(f"stopped after {len(self.entries)} of {len(run.wanted)}{kept}")


def carried_out(run: Any, cluster: str | None, steps: Any, effort: dict[str, float], record: bool) -> list[Any]:
    """The results of a run. Raises `Stopped` with those there are when Ctrl-C is pressed."""
    execute = on_cluster(cluster, run.settings) if cluster else None
    try:
        run.go(execute, tick=lambda name: steps.done(effort[name]), now=lambda names: steps.now(*names))
    except KeyboardInterrupt:
        calm()
        raise Stopped(run, record) from None
    found: list[Any] = run.results()
    return found


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
    from xsec_sym import hints

    known = list(dict.fromkeys(c.source for c in claims.values()))
    for name in ids:
        if name not in claims:
            complain(f"there is no claim {name}{hints.claim(name, claims, known)}")
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


def print_verdicts(entries: list[Any]) -> None:
    from xsec_sym.record import show

    if not entries:
        return
    if coloured():
        from rich.console import Console

        # where colours are forced into a pipe, no line is folded for its sake
        console = Console(width=None if sys.stdout.isatty() else 200)
        with console.capture() as table:
            console.print(show.table(entries))
        say(table.get().rstrip("\n"))
    else:
        for line in show.lines(entries):
            say(line)
    for entry in entries:
        if not entry.settled and entry.note:
            say(f"{entry.id}: {one_line(entry.note)}")


def closing(results: Sequence[Any], ledger: Any, gone: int, recorded: bool, seconds: float) -> str:
    """All in one sentence.

    >>> from types import SimpleNamespace as Made
    >>> result = Made(entry=Made(id="a:1", verdict="proved", settled=True))
    >>> closing([result], {"a:1": Made(verdict="confirmed")}, 0, False, 154)
    '1 verdict: differs from the record (2 min 34 s)'
    """
    entries = [r.entry for r in results]
    differ = sum(e.id in ledger and ledger[e.id].verdict != e.verdict for e in entries)
    new = sum(e.id not in ledger for e in entries)
    unsettled = sum(not e.settled for e in entries)
    counted = [
        (0 if recorded else differ, "differs from the record" if differ == 1 else "differ from the record"),
        (0 if recorded else new, "not in the record"),
        (0 if recorded else gone, "in the record that nothing claims"),
        (unsettled, "not settled"),
    ]
    told = [said if len(entries) == 1 else f"{number} {said}" for number, said in counted if number]
    head = f"{len(entries)} verdict{'s' * (len(entries) != 1)}" + ", recorded" * recorded
    same = "" if recorded else ", as recorded" if len(entries) == 1 else ", all as recorded"
    return f"{head}{': ' + ', '.join(told) if told else same} ({duration(seconds)})"


def duration(seconds: float) -> str:
    """A time as it is said.

    >>> duration(0.84), duration(34.2), duration(154)
    ('0.8 s', '34 s', '2 min 34 s')
    """
    if seconds < 9.95:
        return f"{seconds:.1f} s"
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"
