"""The record: every entry of every source, read when it is first asked for."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from difflib import get_close_matches
from functools import cached_property
from html import escape
from pathlib import Path
from typing import Any

from xsec_sym.record.entry import Entry
from xsec_sym.record.files import layout, writing

VERSION = 1
DATA = Path(__file__).parent / "data"
PROOFS = ".proofs.json"


class UnknownEntry(KeyError):
    """No entry has this id; the message names those that come near."""

    def __str__(self) -> str:
        return str(self.args[0])


class BrokenRecord(ValueError):
    """A file of the record cannot be read."""


def nearest(word: str, known: Iterable[str]) -> str:
    """A hint at what may have been meant, for the end of a sentence.

    >>> nearest("deon2016:2", ["deon2016:22", "kenha2018:z"])
    '; did you mean deon2016:22?'
    """
    known = list(known)
    found = get_close_matches(word, known, 3, 0.6) or [k for k in known if k.partition(":")[2] == word][:3]
    return f"; did you mean {' or '.join(found)}?" if found else ""


class Ledger(Mapping[str, Entry]):
    """Entries by id, from one folder, or several of which later ones win.

    >>> ledger = Ledger()
    >>> ledger["deon2016:twenty-two"]
    Traceback (most recent call last):
    ...
    xsec_sym.record.store.UnknownEntry: there is no entry deon2016:twenty-two...
    """

    def __init__(self, *folders: str | Path) -> None:
        self.folders = tuple(Path(f) for f in folders) or (DATA,)

    @cached_property
    def _entries(self) -> dict[str, Entry]:
        found: dict[str, Entry] = {}
        for path in self._files(".json"):
            if not path.name.endswith(PROOFS):
                data = _read(path)
                try:
                    entries = [Entry.from_json(e) for e in data["entries"]]
                except (KeyError, TypeError, ValueError) as error:
                    raise BrokenRecord(f"{path} is not a record: {error!r}") from error
                found.update((e.id, e) for e in entries)
        return found

    @cached_property
    def _certificates(self) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for path in self._files(PROOFS):
            found.update(_read(path))
        return found

    def _files(self, ending: str) -> Iterator[Path]:
        for folder in self.folders:
            yield from sorted(folder.glob(f"*{ending}"))

    # --- queries -----------------------------------------------------------------------------------

    def __getitem__(self, name: str) -> Entry:
        try:
            return self._entries[name]
        except KeyError:
            raise UnknownEntry(f"there is no entry {name}{nearest(str(name), self._entries)}") from None

    def __contains__(self, name: object) -> bool:
        return name in self._entries

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def certificate(self, name: str) -> dict[str, Any] | None:
        """The recorded proof of an entry, for the checker to replay."""
        return self._certificates.get(name)

    @property
    def sources(self) -> list[str]:
        return list(dict.fromkeys(e.source for e in self.values()))

    def source(self, key: str) -> list[Entry]:
        """The entries of one source, in its own order. Raises `UnknownEntry` for a source that has none."""
        found = [e for e in self.values() if e.source == key]
        if not found:
            raise UnknownEntry(f"there is no source {key}{nearest(key, self.sources)}")
        return found

    def by_verdict(self, word: str) -> list[Entry]:
        """The entries that carry one verdict. Raises ValueError for what is not a verdict."""
        from xsec_sym.proof.verdict import RANK

        if word not in RANK:
            raise ValueError(f"{word!r} is not a verdict; the verdicts are {', '.join(RANK)}")
        return [e for e in self.values() if e.verdict == word]

    # --- writing -----------------------------------------------------------------------------------

    def write(
        self,
        entries: Iterable[Entry],
        certificates: Mapping[str, Any],
        *,
        order: Iterable[str],
        gone: Iterable[str] = (),
    ) -> None:
        """Put entries into the last folder, in place of those of the same id; all other entries stay.

        ``order`` lists ids as the sources have them; ``gone`` those to be dropped. Each file changes whole or not at
        all; a certificate of None is dropped.
        """
        entries = list(entries)
        gone = list(gone)
        folder = self.folders[-1]
        folder.mkdir(parents=True, exist_ok=True)
        own = Ledger(folder)
        kept = {**own, **{e.id: e for e in entries}}
        proofs = {**own._certificates, **certificates}
        rank = {name: k for k, name in enumerate(order)}
        touched = {kept[name].source for name in (*(e.id for e in entries), *gone) if name in kept}
        for name in gone:
            kept.pop(name, None)
        ids = sorted(kept, key=lambda name: rank.get(name, len(rank)))
        for source in sorted(touched):
            names = [name for name in ids if kept[name].source == source]
            data = {"version": VERSION, "entries": [kept[name].to_json() for name in names]}
            with writing(folder / f"{source}.json") as out:
                out.write(layout(data, 4) + "\n")
            with writing(folder / f"{source}{PROOFS}") as out:
                out.write(layout({name: proofs[name] for name in names if proofs.get(name)}, 3) + "\n")
        for cached in ("_entries", "_certificates"):
            self.__dict__.pop(cached, None)

    # --- display -----------------------------------------------------------------------------------

    def __repr__(self) -> str:
        return f"<Ledger: {len(self)} entries of {len(self.sources)} sources>"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{escape(e.id)}</td><td style='text-align:left'>{escape(e.title)}</td><td>{e.verdict}</td></tr>"
            for e in self.values()
        )
        return f"<table><tr><th>id</th><th>title</th><th>verdict</th></tr>{rows}</table>"


def _read(path: Path) -> dict[str, Any]:
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise BrokenRecord(f"{path} cannot be read: {getattr(error, 'strerror', None) or error}") from error
    if not isinstance(data, dict):
        raise BrokenRecord(f"{path} is not a record")
    return data


ledger = Ledger()
