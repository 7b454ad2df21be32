"""The pages, written as a whole: into a folder beside the target, which takes its place when all is there."""

from __future__ import annotations

import contextlib
import json
import os
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from xsec_sym import __version__
from xsec_sym.processes import undisturbed
from xsec_sym.record.entry import Entry
from xsec_sym.record.files import layout
from xsec_sym.record.show import MEANING
from xsec_sym.report import reference, words
from xsec_sym.report.code import codes
from xsec_sym.report.formula import set_
from xsec_sym.report.items import GROUPS, Item, counted, helped, items, misprints
from xsec_sym.report.papers import COLUMNS, Paper, in_order, papers
from xsec_sym.report.table1 import TABLE, rows

# By this file a folder is known to be a report.
MARK = ".xsec-report"
STATIC = ("style.css", "report.js", "icon.svg")
Tick = Callable[[str], None]


class NotAReport(FileExistsError):
    """The folder holds something else, which must not be lost."""


def build(folder: str | Path, record: Any = None, tick: Tick = lambda said: None) -> Path:
    """Write the whole record as a static site, and return the path of its index.

    The folder is made, or replaced where it is empty or an earlier report; nothing is seen of the new one before it is
    whole. Raises `NotAReport` for any other folder or a file, OSError where it cannot be written.
    """
    if record is None:
        from xsec_sym.record.store import ledger as record
    target = Path(folder).resolve()
    check(target, str(folder))
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".xsec-report-", dir=target.parent) as room:
        made = Path(room) / "report"
        made.mkdir()
        os.chmod(made, 0o777 & ~_umask())
        for path, text in pages(record, made, tick):
            place = made / path
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(text, encoding="utf-8")
        if target.exists():
            os.replace(target, Path(room) / "old")
        os.replace(made, target)
    return target / "index.html"


def check(target: Path, name: str) -> None:
    """Raises `NotAReport` unless a report may be put here."""
    if target.is_dir():
        if any(target.iterdir()) and not (target / MARK).exists():
            raise NotAReport(f"{name} is a folder that holds something else than a report")
    elif target.exists():
        raise NotAReport(f"{name} is a file")


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def pages(record: Any, folder: Path, tick: Tick = lambda said: None) -> Iterator[tuple[str, str]]:
    """Every file of the site that is a text, by its path. Charts are drawn into the folder."""
    tick("code")
    found = items(record, codes(record))
    sources = papers(record)
    drawn = charts(folder, tick)
    table = rows(record, found) if any(name.startswith(TABLE) for name in record) else []
    inside = Environment(
        loader=PackageLoader("xsec_sym.report"), autoescape=True, undefined=StrictUndefined, trim_blocks=True,
        lstrip_blocks=True,
    )  # fmt: skip
    inside.filters["with_links"] = lambda text: words.to_entries(text, record)
    inside.globals.update(
        papers=sources, items=found, href=words.href, version=__version__, table=bool(table), charts=bool(drawn),
        counted=counted, helped=helped, meanings=MEANING, groups=GROUPS, terms=words.TERMS,
        math=lambda latex: Markup(set_(latex, display=False)), words={g: " ".join(w) for g, w in GROUPS.items()},
    )  # fmt: skip

    def page(template: str, here: str, **told: Any) -> tuple[str, str]:
        return here, inside.get_template(template).render(here=here, **told)

    for paper in sources:
        tick(paper.key)
        yield from _source(paper, record, found, page)
    if table:
        columns = [Markup(set_(latex, display=False)) for latex in COLUMNS.values()]
        names = [Markup(set_(latex.partition(" =")[0], display=False)) for latex in COLUMNS.values()]
        yield page("table1.html", "table1.html", rows=table, columns=columns, names=names)
    if drawn:
        yield page("charts.html", "charts.html", drawn=drawn)
    yield page("index.html", "index.html", **_index(sources, record))
    yield page("reference.html", "reference.html", modules=reference.modules())
    tick("certificates")
    for item in found.values():
        if item.certificate:
            yield item.certificate, layout(record.certificate(item.entry.id), 3) + "\n"
    yield "search.js", _search(found)
    for name in STATIC:
        yield name, (Path(__file__).parent / "static" / name).read_text(encoding="utf-8")
    yield MARK, f"{__version__}\n"


def _source(paper: Paper, record: Any, found: dict[str, Item], page: Any) -> Iterator[tuple[str, str]]:
    entries = record.source(paper.key)
    sections = [(name, [found[e.id] for e in part]) for name, part in in_order(entries)]
    wrong = [item for _, part in sections for item in part if item.entry.verdict == "misprint"]
    yield page("source.html", paper.page, paper=paper, sections=sections, total=len(entries), counts=counts(entries),
               misprints=len(wrong), shown=[v for v in MEANING if any(e.verdict == v for e in entries)])  # fmt: skip
    if wrong:
        yield page("errata.html", paper.errata, paper=paper, found=wrong)


def counts(entries: Sequence[Entry]) -> list[tuple[str, str, int, int]]:
    """For each group of verdicts that occurs: its name, its first word, how many, and how many came before."""
    found = []
    before = 0
    for name, verdicts in GROUPS.items():
        count = sum(e.verdict in verdicts for e in entries)
        if count:
            found.append((name, verdicts[0], count, before))
            before += count
    return found


def _index(sources: list[Paper], record: Any) -> dict[str, Any]:
    cards = []
    for paper in sources:
        entries = record.source(paper.key)
        cards.append(
            {"paper": paper, "total": len(entries), "counts": counts(entries), "misprints": len(misprints(entries))}
        )
    totals = [(name, count) for name, _, count, _ in counts(list(record.values()))]
    return {"cards": cards, "total": len(record), "totals": totals}


def _search(found: dict[str, Item]) -> str:
    told = [[e.entry.id, e.entry.title, e.entry.verdict, words.href(e.entry.id), e.find] for e in found.values()]
    lines = ",\n".join(json.dumps(row, ensure_ascii=False) for row in told)
    return f'"use strict";\nwindow.RECORD = [\n{lines}\n];\n'


def steps(record: Any) -> int:
    """How often `build` says what it begins."""
    return 2 + 2 * len(_stored()) + len(papers(record))


def _stored() -> dict[str, Any]:
    """The measurements that can be drawn."""
    from xsec_sym.study import files
    from xsec_sym.study.method import HOMES

    found = {}
    for name in HOMES:
        with contextlib.suppress(files.Unmeasured):
            found[name] = files.stored(name)
    return found


def charts(folder: Path, tick: Tick = lambda said: None) -> list[dict[str, Any]]:
    """Draw what has a stored measurement, on two cores: each picture takes about a second."""
    from joblib import Parallel, delayed

    from xsec_sym.study import files
    from xsec_sym.study.method import registered

    found = _stored()
    if found:
        (folder / "charts").mkdir()
    pictures = [(name, stability) for name in found for stability in (False, True)]
    with undisturbed():
        drawing = Parallel(n_jobs=min(2, os.cpu_count() or 1, len(pictures) or 1), return_as="generator")(
            delayed(_draw)(name, folder / "charts" / f"{name}{'-stability' * stability}.svg", stability)
            for name, stability in pictures
        )
    # they come in one by one and in order: what is told is the next
    for name, _ in pictures:
        tick(f"the charts of {name}")
        next(drawing)
    return [
        {
            "name": name,
            "title": registered(name).quantity.title,
            "machine": ", ".join(f"{key} {value}" for key, value in data["machine"].items()),
            "table": "\n".join(files.table(data)),
        }
        for name, data in found.items()
    ]


def _draw(name: str, path: Path, stability: bool) -> None:
    from xsec_sym.study import files

    files.write(files.stored(name), path, ".svg", stability)
