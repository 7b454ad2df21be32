"""What every command does alike: mistakes in one line, files that appear whole or not at all, progress shown."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NoReturn, TextIO

import click

INTERRUPTED = 130


class Program(click.Group):
    """Tells every mistake in one line on standard error, and leaves quietly on Ctrl-C."""

    def main(self, *args: Any, standalone_mode: bool = True, **extra: Any) -> Any:
        run: Any = super().main
        if not standalone_mode:
            return run(*args, standalone_mode=False, **extra)
        code: Any
        try:
            code = run(*args, standalone_mode=False, **extra)
        except click.ClickException as mistake:
            click.echo(f"xsec: {one_line(mistake.format_message())}", err=True)
            code = 2
        except (click.Abort, KeyboardInterrupt):
            code = INTERRUPTED
        sys.exit(code if isinstance(code, int) else 0)


class Count(click.IntRange):
    name = "N"


def one_line(text: str) -> str:
    return " ".join(text.split())


def complain(said: object) -> NoReturn:
    raise click.ClickException(str(said))


@contextlib.contextmanager
def output(path: str | None) -> Iterator[TextIO | None]:
    """A file that appears only when the block ends well; its folder is tried before any work is done."""
    from xsec_sym.record.files import writing

    if path is None:
        yield None
        return
    with contextlib.ExitStack() as stack:
        try:
            out = stack.enter_context(writing(path))
        except (OSError, ValueError) as error:
            complain(f"cannot write {path}: {getattr(error, 'strerror', None) or error}")
        yield out


@contextlib.contextmanager
def progress(total: int) -> Iterator[Callable[[str], None]]:
    if not sys.stderr.isatty():
        yield lambda name: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    columns = BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(), TextColumn("{task.description}")
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=total)
        yield lambda name: bar.update(task, advance=1, description=name)


@contextlib.contextmanager
def drawn(target: str | None) -> Iterator[str | None]:
    """The path of a file beside the target, which takes its place when the block ends well."""
    import tempfile

    if target is None:
        yield None
        return
    folder = Path(target).resolve().parent
    try:
        if Path(target).is_dir():
            raise IsADirectoryError(0, "it is a folder")
        with tempfile.TemporaryDirectory(prefix=".xsec-", dir=folder) as room:
            path = Path(room) / Path(target).name
            yield str(path)
            os.replace(path, target)
    except OSError as error:
        complain(f"cannot write {target}: {error.strerror or error}")


@contextlib.contextmanager
def saying() -> Iterator[Callable[[str], None]]:
    """What is being done, in one line of a terminal that is written over."""
    if not sys.stderr.isatty():
        yield lambda said: None
        return
    from rich.console import Console

    with Console(stderr=True).status("") as status:
        yield lambda said: status.update(said)
