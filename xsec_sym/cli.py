"""The command line: it parses, calls and prints. Whatever was typed wrong is told in one line, with exit code 2."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from xsec_sym import guide, terminal
from xsec_sym.scaffold import new
from xsec_sym.terminal import Count, Program, complain, drawn, output, progress, say

# Work is shared out to processes, whose small matrices threads would only slow down; to be set before NumPy is loaded.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def _known(what: str) -> Callable[..., Any]:
    """How a shell completes a word, by a function of `xsec_sym.complete`."""

    def complete(context: click.Context, parameter: click.Parameter, word: str) -> Any:
        from xsec_sym import complete

        return getattr(complete, what)(context, word)

    return complete


def _ledger(derivations: str | None) -> Any:
    from xsec_sym.record import store

    if derivations and not Path(derivations).is_dir():
        complain(f"{derivations} is not a folder of derivations")
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
    """Derive, verify and export the formulas of rendering papers. Without a command: what to do next."""
    if context.invoked_subcommand is None:
        click.echo(guide.told(_ledger(None)))


FILE = click.Path()
OWN = click.option("--derivations", metavar="PATH", shell_complete=_known("folders"),
                   help="Add a folder of derivation modules of your own.")  # fmt: skip


@main.command()
@click.argument("ids", nargs=-1, metavar="[ID]...", shell_complete=_known("ids"))
@click.option(
    "--source",
    "sources",
    multiple=True,
    metavar="KEY",
    shell_complete=_known("sources"),
    help="Only this source; may be given again.",
)
@click.option("--digits", type=Count(10, 1000), default=30, show_default=True, help="Digits to agree on.")
@click.option("--seed", type=Count(0), default=0, show_default=True, help="Seed of the points tested.")
@click.option("--jobs", type=Count(1, 1024), help="Processes to use.  [default: one a core]")
@click.option("--cluster", metavar="ADDRESS", help="Hand the work to a dask.distributed scheduler.")
@click.option("--fresh", is_flag=True, help="Derive everything again instead of replaying recorded proofs.")
@click.option("--record", is_flag=True, help="Write the new verdicts as the recorded ones.")
@OWN
@click.option("--json", "target", type=FILE, metavar="FILE", help="Write the verdicts as JSON as well.")
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
    from time import perf_counter

    from xsec_sym import verifying

    begun, met, effort = perf_counter(), {}, {}
    try:
        with output(target) as out, progress("reading the derivations") as steps:
            from xsec_sym.record import show
            from xsec_sym.record.run import Settings, differences, to_record, verify_all, with_parts

            if cluster and derivations:
                complain("--derivations cannot go with --cluster: its machines do not have that folder")
            claims = verifying.claims_of(derivations)
            ledger = _ledger(derivations)
            chosen = verifying.chosen_ids(ids, sources, claims, ledger)
            settings = Settings(digits, seed, fresh, jobs or os.cpu_count() or 1)
            execute = verifying.on_cluster(cluster, settings) if cluster else None
            effort = verifying.efforts(with_parts(claims, chosen), ledger)
            steps.expect(len(effort), sum(effort.values()))

            def tick(name: str, verdict: Any) -> None:
                met[name] = verdict
                steps.done(effort[name])

            results = verify_all(claims, chosen, ledger, settings, execute=execute, tick=tick,
                                 now=lambda names: steps.now(*names))  # fmt: skip
            entries = [r.entry for r in results]
            restricted = set(sources) if sources else set() if ids else {e.source for e in ledger.values()}
            expected = [e.id for e in ledger.values() if e.source in restricted]
            found = differences(results, ledger, claims, expected)
            # a claim of the user's own is new at first, and that is no fault
            own = {r.entry.id for r in results if not claims[r.entry.id].module.startswith("derivations")}
            faults = [said for said in found if said.partition(": ")[0] not in own - set(ledger)]
            gone = [n for n in expected if n not in claims]
            last = verifying.closing(entries, gone, ledger, record, perf_counter() - begun)
            if record:
                verifying.keep(results, to_record(results, ledger), ledger, claims, gone, own)
                faults = []
            if out is not None:
                verifying.write_json(out, entries, digits)
    except KeyboardInterrupt:
        if effort:
            verifying.print_so_far(met, claims, len(effort))
        raise
    verifying.print_verdicts(entries)
    for said in [*show.summary(entries), *([] if record and not found else found), last]:
        click.echo(said)
    if target is not None:
        click.echo(f"wrote {target}", err=True)
    context.exit(1 if faults or not all(e.settled for e in entries) else 0)


@main.command(short_help="What the record holds on equations, or on a source.")
@click.argument("names", nargs=-1, metavar="[ID|SOURCE]...", shell_complete=_known("ids_and_sources"))
@click.option("--latex", is_flag=True, help="The formulas as LaTeX.")
@click.option(
    "--bibtex", is_flag=True, help="BibTeX for the sources and the verdicts named; without a name, all sources."
)
@OWN
def show(names: tuple[str, ...], latex: bool, bibtex: bool, derivations: str | None) -> None:
    """Tell what the record holds on equations: their forms, verdict, evidence and steps; of a source, a line each.

    Formulas are typeset on a terminal that knows Unicode, and stand in one line elsewhere.
    """
    from shutil import get_terminal_size

    from xsec_sym.record import show as text
    from xsec_sym.record.sources import SOURCES, bibtex_of
    from xsec_sym.record.store import nearest

    ledger = _ledger(derivations)
    known = dict.fromkeys([*ledger, *ledger.sources, *(SOURCES if bibtex else ())])
    if not names and not bibtex:
        complain("name at least one entry, such as deon2016:18, or a source: " + ", ".join(ledger.sources))
    for name in names:
        if name not in known:
            complain(guide.no_entry(name, derivations, nearest(name, known)))
    if bibtex:
        try:
            click.echo("\n\n".join(bibtex_of(name, ledger) for name in names or SOURCES))
        except KeyError as error:
            complain(error.args[0])
        return
    form = "latex" if latex else "pretty" if terminal.typesets() else "line"
    wide = get_terminal_size().columns - text.INDENT
    told = {name: text.told(ledger[name], ledger, form, wide, terminal.paint) for name in names if name in ledger}
    say("\n\n\n".join(told.get(name) or text.listed(ledger.source(name), terminal.paint) for name in names))


@main.command(short_help="Check an equation of your own.")
@click.argument("lhs")
@click.argument("rhs")
@click.option("--where", default="", help='The domain, such as "u in (-1, 1), n in {0, 1, 2}, u*n > 0".')
@click.option("--digits", type=Count(1, 1000), default=30, show_default=True, help="Digits to agree on.")
@click.option("--seconds", type=click.FloatRange(0.1, 86400), default=60.0, show_default=True, metavar="S",
              help="Time limit.")  # fmt: skip
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
    say(answer(verdict, terminal.paint))
    if verdict.verdict == "confirmed":
        say(f"  a difference below 1e-{digits} of the sides would not be seen; --digits {3 * digits} looks closer")
    context.exit(0 if verdict.settled else 1 if verdict.verdict == "refuted" else 3)


@main.command(short_help="Speed against accuracy of a quantity's methods.")
@click.argument("name", metavar="[NAME]", required=False, shell_complete=_known("quantities"))
@click.option(
    "-o", "target", type=FILE, metavar="FILE", help="An .svg, .png or .json file.  [default: a table on the terminal]"
)
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
                click.echo("\n".join([*files.table(data), "", *files.LEGEND]))
            else:
                files.write(data, path, kind, stability)
    except (UnknownQuantity, files.Unmeasured, NoCluster) as error:
        complain(error)
    if target is not None:
        click.echo(f"wrote {target}", err=True)


def _measured(name: str, seed: int, jobs: int, cluster: str | None) -> dict[str, Any]:
    from xsec_sym import processes
    from xsec_sym.record.cluster import spread
    from xsec_sym.study import files

    if cluster is None:
        processes.start(jobs)
    with spread(cluster), progress(count=files.steps(name)) as steps:
        return files.measured(name, seed, jobs, steps.next)


@main.command(short_help="Write verified expressions as a module of NumPy.")
@click.argument("names", nargs=-1, metavar="[NAME]...", shell_complete=_known("exports"))
@click.option("-o", "target", type=FILE, metavar="FILE", help="The module to write.  [default: standard output]")
@click.option("--dtype", type=click.Choice(["float32", "float64"]), default="float64", show_default=True,
              help="What the functions return.")  # fmt: skip
@OWN
def export(names: tuple[str, ...], target: str | None, dtype: str, derivations: str | None) -> None:
    """Write verified expressions as one module that imports NumPy; without a NAME, list what there is.

    The list has a line for each name; lines that begin with # say what they have in common.
    """
    from importlib import import_module

    from xsec_sym import exporting

    exporter = import_module("xsec_sym.export")
    refusal = exporter.Refusal
    if not names:
        if target is not None:
            complain("name what to export; without a name there is only the list")
        record = _ledger(derivations)
        click.echo("\n".join(exporting.listing(exporter.available(record), record)))
        return
    for name in names:
        if said := guide.made_by_hand(name):
            complain(said)
    with output(None if target == "-" else target) as out, progress(count=len(names)) as steps:
        try:
            own = {"record": _ledger(derivations)} if derivations else {}
            text = exporter.module(list(names), dtype, tick=steps.next, **own)
        except (refusal, KeyError) as error:
            complain(error if isinstance(error, refusal) else str(error))
        if out is not None:
            out.write(text)
    if out is None:
        click.echo(text, nl=False)
    else:
        click.echo(f"wrote {target}", err=True)


@main.command(short_help="Choose the cheapest kernels for a scene.")
@click.argument("scene", type=FILE, metavar="SCENE.toml")
@click.option("-o", "target", type=FILE, metavar="FILE", help="The module to write, with a function for each material.")
@click.option(
    "--json", "report", type=FILE, metavar="FILE", help="Write the choices, and what was turned down, as JSON."
)
@click.option("--measure", is_flag=True, help="Measure on this machine first, which takes minutes a quantity.")
def plan(scene: str, target: str | None, report: str | None, measure: bool) -> None:
    """Choose the cheapest kernels that keep to a scene's tolerances, write them as one module, and check it."""
    from xsec_sym.planner import BadScene, Scene, Unmet
    from xsec_sym.planner import plan as planned
    from xsec_sym.planner.planning import steps as expected
    from xsec_sym.record.files import layout

    with output(target) as out, output(report) as told, progress() as steps:
        try:
            asked = Scene.load(scene)
            steps.expect(expected(asked, measure))
            found = planned(asked, measure=measure, tick=steps.next)
        except (BadScene, Unmet) as error:
            complain(error)
        if out is not None:
            out.write(found.source)
        if told is not None:
            told.write(layout(found.as_dict()) + "\n")
    for line in found.lines():
        click.echo(line)
    for path in (target, report):
        if path is not None:
            click.echo(f"wrote {path}", err=True)


@main.command()
@click.option(
    "-o",
    "target",
    metavar="DIR",
    default="report",
    shell_complete=_known("folders"),
    show_default=True,
    help="The folder to write.",
)
@OWN
def report(target: str, derivations: str | None) -> None:
    """Write the whole record as a static page that is read offline.

    An earlier report is replaced; a folder that holds anything else is not touched.
    """
    from time import perf_counter

    from xsec_sym.report import NotAReport, build
    from xsec_sym.report.site import steps as expected

    start, ledger = perf_counter(), _ledger(derivations)
    with progress(count=expected(ledger)) as steps:
        try:
            index = build(target, ledger, steps.next)
        except NotAReport as error:
            complain(error)
        except OSError as error:
            complain(f"cannot write {target}: {error.strerror or error}")
    click.echo(str(index))
    click.echo(f"written in {perf_counter() - start:.0f} s", err=True)


@main.command(short_help="Print the script that completes in your shell.")
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
def completion(shell: str) -> None:
    """Print the script by which a shell completes commands, options, ids, names and sources."""
    from xsec_sym import complete, guide

    click.echo(complete.script(shell, main, terminal.COMPLETE), nl=False)
    if sys.stdout.isatty():
        line = next(line for line, _ in guide.EXAMPLES["completion"] if shell in line)
        click.echo(f"# to switch it on: {line}", err=True)


main.command()(new)


if __name__ == "__main__":
    main()
