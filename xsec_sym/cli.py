"""The command line: it parses, calls and prints. Whatever was typed wrong is told in one line, with exit code 2."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TextIO

import click

from xsec_sym.scaffold import new
from xsec_sym.terminal import Count, Program, complain, drawn, one_line, output, progress, saying

# Work is shared out to processes, whose small matrices threads would only slow down; to be set before NumPy is loaded.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def _ledger(derivations: str | None) -> Any:
    from xsec_sym.record import store

    folders = [store.DATA, *([Path(derivations) / "record"] if derivations else [])]
    found = store.Ledger(*folders)
    try:
        len(found)
    except store.BrokenRecord as error:
        complain(error)
    return found


@click.group(cls=Program, invoke_without_command=True, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="xsec_sym", message="xsec %(version)s")
@click.pass_context
def main(context: click.Context) -> None:
    """Derive, verify and export the formulas of rendering papers."""
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


OWN = click.option("--derivations", metavar="PATH", help="Add a folder of derivation modules of your own.")


@main.command()
@click.argument("ids", nargs=-1, metavar="[ID]...")
@click.option("--source", "sources", multiple=True, metavar="KEY", help="Only this source; may be given again.")
@click.option("--digits", type=Count(10, 1000), default=30, show_default=True, help="Digits to agree on.")
@click.option("--seed", type=Count(0), default=0, show_default=True, help="Seed of the points tested.")
@click.option("--jobs", type=Count(1, 1024), help="Processes to use.  [default: one a core]")
@click.option("--cluster", metavar="ADDRESS", help="Hand the work to a dask.distributed scheduler.")
@click.option("--fresh", is_flag=True, help="Derive everything again instead of replaying recorded proofs.")
@click.option("--record", is_flag=True, help="Write the new verdicts as the recorded ones.")
@OWN
@click.option("--json", "target", metavar="FILE", help="Write the verdicts as JSON as well.")
@click.pass_context
def verify(
    context: click.Context,
    ids: tuple[str, ...],
    sources: tuple[str, ...],
    digits: int,
    seed: int,
    jobs: int | None,
    cluster: str | None,
    fresh: bool,
    record: bool,
    derivations: str | None,
    target: str | None,
) -> None:
    """Check the claims again: all, the given ids, or one source.

    Exit code 0 when every verdict is settled and is the recorded one, 1 when any differs or is not settled.
    """
    with output(target) as out:
        from xsec_sym.record import show
        from xsec_sym.record.run import Settings, differences, to_record, verify_all

        if cluster and derivations:
            complain("--derivations cannot go with --cluster: its machines do not have that folder")
        claims = _claims(derivations)
        ledger = _ledger(derivations)
        chosen = _chosen(ids, sources, claims, ledger)
        settings = Settings(digits, seed, fresh, jobs or os.cpu_count() or 1)
        execute = _remote(cluster, settings) if cluster else None
        with progress(len(chosen)) as tick:
            results = verify_all(claims, chosen, ledger, settings, execute=execute, tick=tick)
        entries = [r.entry for r in results]
        restricted = set(sources) if sources else set() if ids else {e.source for e in ledger.values()}
        met = [e.id for e in ledger.values() if e.source in restricted]
        found = differences(results, ledger, claims, met)
        # a claim of the user's own is new at first, and that is no fault
        own = {r.entry.id for r in results if not claims[r.entry.id].module.startswith("derivations")}
        faults = [said for said in found if said.partition(": ")[0] not in own - set(ledger)]
        if record:
            _record(results, to_record(results, ledger), ledger, claims, [n for n in met if n not in claims], own)
            faults = []
        if out is not None:
            _write_json(out, entries, digits)
    _print_verdicts(entries)
    for said in [*show.summary(entries), *([] if record and not found else found)]:
        click.echo(said)
    if record:
        click.echo("recorded")
    context.exit(1 if faults or not all(e.settled for e in entries) else 0)


def _claims(derivations: str | None) -> dict[str, Any]:
    from xsec_sym.record.discover import BrokenDerivation, discover

    try:
        return discover(derivations)
    except BrokenDerivation as error:
        complain(error)


def _chosen(ids: Sequence[str], sources: Sequence[str], claims: dict[str, Any], ledger: Any) -> list[str]:
    from xsec_sym.record.store import nearest

    known = list(dict.fromkeys(c.source for c in claims.values()))
    for name in ids:
        if name not in claims:
            complain(f"there is no claim {name}{nearest(name, claims)}")
    for key in sources:
        if key not in known:
            complain(f"there is no source {key}{nearest(key, known) or '; there are ' + ', '.join(known)}")
    if not ids and not sources:
        return list(claims)
    return [name for name, c in claims.items() if name in ids or c.source in sources]


def _remote(address: str, settings: Any) -> Any:
    from xsec_sym.record.cluster import NoCluster, remote

    try:
        return remote(address, settings)
    except NoCluster as error:
        complain(error)


def _record(results: Any, kept: Any, ledger: Any, claims: dict[str, Any], gone: list[str], own: set[str]) -> None:
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


def _write_json(out: TextIO, entries: list[Any], digits: int) -> None:
    from xsec_sym import __version__
    from xsec_sym.record.files import layout

    data = {"version": __version__, "digits": digits, "entries": [e.public() for e in entries]}
    out.write(layout(data) + "\n")


def _print_verdicts(entries: list[Any]) -> None:
    from xsec_sym.record import show

    if sys.stdout.isatty():
        from rich.console import Console

        Console().print(show.table(entries))
    else:
        for line in show.lines(entries):
            click.echo(line)
    for entry in entries:
        if not entry.settled and entry.note:
            click.echo(f"{entry.id}: {one_line(entry.note)}")


@main.command()
@click.argument("name", metavar="ID")
@OWN
def show(name: str, derivations: str | None) -> None:
    """Tell what the record holds on one equation: its forms, verdict, evidence and steps."""
    from xsec_sym.record import show as text
    from xsec_sym.record.store import UnknownEntry

    ledger = _ledger(derivations)
    try:
        entry = ledger[name]
    except UnknownEntry as error:
        complain(error)
    click.echo(text.told(entry, ledger))


@main.command()
@click.argument("lhs")
@click.argument("rhs")
@click.option("--where", default="", help='The domain, such as "u in (-1, 1), n in {0, 1, 2}, u*n > 0".')
@click.option("--digits", type=Count(1, 1000), default=30, show_default=True, help="Digits to agree on.")
@click.option("--seconds", type=click.FloatRange(0.1, 86400), default=60.0, show_default=True, help="Time limit.")
@click.pass_context
def check(context: click.Context, lhs: str, rhs: str, where: str, digits: int, seconds: float) -> None:
    """Check an equation of your own: LHS = RHS wherever --where holds.

    Exit code 0 when it is proved or confirmed, 1 when it is refuted, 3 when neither could be shown in time.
    """
    from xsec_sym.proof.domain import EmptyDomain
    from xsec_sym.proof.limits import check as judge
    from xsec_sym.proof.parse import ParseError
    from xsec_sym.record.show import answer

    try:
        verdict = judge(lhs, rhs, where, digits, seconds)
    except (ParseError, EmptyDomain) as error:
        complain(error)
    click.echo(answer(verdict))
    context.exit(0 if verdict.settled else 1 if verdict.verdict == "refuted" else 3)


@main.command()
@click.argument("name", metavar="[NAME]", required=False)
@click.option("-o", "target", metavar="FILE", help="An .svg, .png or .json file.  [default: a table on the terminal]")
@click.option("--stability", is_flag=True, help="The map of lost digits over the domain instead.")
@click.option("--measure", is_flag=True, help="Measure anew on this machine instead of drawing what is stored.")
@click.option("--seed", type=Count(0), default=1, show_default=True, help="Seed of the points that are measured.")
@click.option("--jobs", type=Count(1, 1024), default=1, show_default=True, help="Processes for the references.")
@click.option("--cluster", metavar="ADDRESS", help="Have the references computed by a dask.distributed scheduler.")
def chart(
    name: str | None, target: str | None, stability: bool, measure: bool, seed: int, jobs: int, cluster: str | None
) -> None:
    """Speed against accuracy for every method of a quantity, such as sigma_ggx; without a NAME, list them."""
    from xsec_sym.record.cluster import NoCluster
    from xsec_sym.study import files
    from xsec_sym.study.method import UnknownQuantity

    if name is None:
        from xsec_sym.study.method import HOMES

        if target is not None or stability or measure:
            complain("name the quantity; without a name there is only the list of them")
        click.echo("\n".join(HOMES))
        return
    kind = Path(target).suffix if target is not None else ""
    if target is not None and kind not in files.KINDS:
        complain(f"cannot draw {target}: the name must end in {', '.join(files.KINDS)}")
    if stability and kind in ("", ".json"):
        complain("--stability draws a picture: give -o a file that ends in .svg or .png")
    try:
        files.known(name)
        with drawn(target) as path:
            data = _measured(name, seed, jobs, cluster) if measure else files.stored(name)
            if path is None:
                click.echo("\n".join(files.table(data)))
            else:
                files.write(data, path, kind, stability)
    except (UnknownQuantity, files.Unmeasured, NoCluster) as error:
        complain(error)


def _measured(name: str, seed: int, jobs: int, cluster: str | None) -> dict[str, Any]:
    from xsec_sym.record.cluster import spread
    from xsec_sym.study import files

    with spread(cluster), progress(files.variants(name)) as tick:
        return files.measured(name, seed, jobs, tick)


@main.command()
@click.argument("names", nargs=-1, metavar="[NAME]...")
@click.option("-o", "target", metavar="FILE", help="The module to write.  [default: standard output]")
@click.option("--dtype", type=click.Choice(["float32", "float64"]), default="float64", show_default=True)
@OWN
def export(names: tuple[str, ...], target: str | None, dtype: str, derivations: str | None) -> None:
    """Write verified expressions as one module that imports NumPy; without a NAME, list what there is."""
    from importlib import import_module

    exporter = import_module("xsec_sym.export")
    if not names:
        if target is not None:
            complain("name what to export; without a name there is only the list")
        for line in _exportable(exporter, derivations):
            click.echo(line)
        return
    with output(None if target == "-" else target) as out:
        try:
            own = {"record": _ledger(derivations)} if derivations else {}
            text = exporter.module(list(names), dtype, **own)
        except (exporter.Refusal, KeyError) as error:
            complain(error if isinstance(error, exporter.Refusal) else str(error))
        if out is not None:
            out.write(text)
    if out is None:
        click.echo(text, nl=False)


def _exportable(exporter: Any, derivations: str | None) -> list[str]:
    return [str(name) for name in (exporter.names(_ledger(derivations)) if derivations else exporter.names())]


@main.command()
@click.argument("scene", metavar="SCENE.toml")
@click.option("-o", "target", metavar="FILE", help="The module to write, with a function for each material.")
@click.option("--json", "report", metavar="FILE", help="Write the choices, and what was turned down, as JSON.")
@click.option("--measure", is_flag=True, help="Measure on this machine first, which takes minutes a quantity.")
def plan(scene: str, target: str | None, report: str | None, measure: bool) -> None:
    """Choose the cheapest kernels that keep to a scene's tolerances, write them as one module, and check it."""
    from xsec_sym.planner import BadScene, Unmet
    from xsec_sym.planner import plan as planned
    from xsec_sym.record.files import layout

    with output(target) as out, output(report) as told, saying() as tick:
        try:
            found = planned(scene, measure=measure, tick=tick)
        except (BadScene, Unmet) as error:
            complain(error)
        if out is not None:
            out.write(found.source)
        if told is not None:
            told.write(layout(found.as_dict()) + "\n")
    for line in found.lines():
        click.echo(line)


@main.command()
@click.option("-o", "target", metavar="DIR", default="report", show_default=True, help="The folder to write.")
@OWN
def report(target: str, derivations: str | None) -> None:
    """Write the whole record as a static page that is read offline.

    An earlier report is replaced; a folder that holds anything else is not touched.
    """
    from time import perf_counter

    from xsec_sym.report import NotAReport, build

    start = perf_counter()
    with saying() as tick:
        try:
            index = build(target, _ledger(derivations), tick)
        except NotAReport as error:
            complain(error)
        except OSError as error:
            complain(f"cannot write {target}: {error.strerror or error}")
    click.echo(str(index))
    click.echo(f"written in {perf_counter() - start:.0f} s", err=True)


main.command()(new)

if __name__ == "__main__":
    main()
