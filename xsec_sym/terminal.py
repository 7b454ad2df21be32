"""What every command does alike: mistakes in one line, files that appear whole or not at all, progress and colour."""

from __future__ import annotations

import atexit
import contextlib
import os
import signal
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import IO, Any, NoReturn, TextIO

import click

from xsec_sym import guide

INTERRUPTED = 130
# As of a program that a reader's end ends, such as that of `| head`.
UNREAD = 141
COMPLETE = "_XSEC_COMPLETE"


class Interrupted(click.ClickException):
    exit_code = INTERRUPTED


class Verb(click.Command):
    """A command whose help ends with worked examples."""

    def format_epilog(self, context: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Examples"):
            formatter.write_dl(guide.EXAMPLES[str(self.name)], col_max=46)


class Program(click.Group):
    """Tells every mistake in one line on standard error, and leaves with one line on Ctrl-C."""

    command_class = Verb

    def main(self, *args: Any, standalone_mode: bool = True, **extra: Any) -> Any:
        run: Any = super().main
        extra |= {"prog_name": "xsec", "complete_var": COMPLETE}
        if not standalone_mode:
            return run(*args, standalone_mode=False, **extra)
        if COMPLETE in os.environ:
            from xsec_sym import complete

            complete.register()
        for stream in (sys.stdout, sys.stderr):
            # a terminal that knows no Greek is told a question mark, and no traceback
            with contextlib.suppress(AttributeError, ValueError):
                stream.reconfigure(errors="replace")  # type: ignore[union-attr]
        _mind_exit()
        code: Any
        try:
            code = run(*args, standalone_mode=False, **extra)
        except Interrupted as left:
            # what is echoed as ^C stands on the line already
            _tell(f"{chr(10) * sys.stderr.isatty()}xsec: {left.message}")
            _EXIT.append(INTERRUPTED)
            code = INTERRUPTED
        except click.ClickException as mistake:
            _tell(f"xsec: {one_line(_told(mistake))}")
            code = 2
        except (click.Abort, KeyboardInterrupt):
            code = INTERRUPTED
        sys.exit(code if isinstance(code, int) else 0)

    def invoke(self, context: click.Context) -> Any:
        try:
            with _insisting(), _read():
                return super().invoke(context)
        except KeyboardInterrupt:
            # who presses again would only disturb the tidying
            with contextlib.suppress(ValueError):
                signal.signal(signal.SIGINT, signal.SIG_IGN)
            _end_children()
            raise Interrupted("interrupted") from None

    def make_context(self, *args: Any, **extra: Any) -> click.Context:
        # what --help prints is printed here
        with _read():
            return super().make_context(*args, **extra)

    def resolve_command(self, context: click.Context, args: list[str]) -> Any:
        name = args[0]
        if self.get_command(context, name) is None and not name.startswith("-"):
            complain(f"there is no command {name}{nearest_or_all(name, self.commands)}")
        return super().resolve_command(context, args)


def _tell(said: str) -> None:
    # nobody may be reading that either
    with contextlib.suppress(BrokenPipeError):
        click.echo(said, err=True)


def _told(mistake: click.ClickException) -> str:
    if isinstance(mistake, click.NoSuchOption):
        near = f"; did you mean {' or '.join(mistake.possibilities)}?" if mistake.possibilities else ""
        bare = mistake.ctx is not None and mistake.ctx.command.name == "check" and not near
        hint = "; an expression that begins with a minus sign stands in brackets" if bare else ""
        return f"there is no option {mistake.option_name}{near}{hint}"
    return mistake.format_message()


@contextlib.contextmanager
def _read() -> Iterator[None]:
    """A reader who leaves early ends the program, which is no mistake."""
    try:
        yield
    except BrokenPipeError:
        _end_children()
        _EXIT.append(UNREAD)
        raise click.exceptions.Exit(UNREAD) from None


@contextlib.contextmanager
def _insisting() -> Iterator[None]:
    """A Ctrl-C that a library swallows while it is imported is raised again, as long as the work goes on."""

    def press(*_: Any) -> None:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.2)
        if not isinstance(sys.exc_info()[1], KeyboardInterrupt):
            raise KeyboardInterrupt

    try:
        before = {s: signal.signal(s, press) for s in (signal.SIGINT, signal.SIGVTALRM)}
    except (ValueError, AttributeError):  # another thread than the first, or a system without this timer
        yield
        return
    tell = sys.unraisablehook
    sys.unraisablehook = lambda lost: None if lost.exc_type is KeyboardInterrupt else tell(lost)
    try:
        yield
    finally:
        sys.unraisablehook = tell
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        for number, handler in before.items():
            signal.signal(number, handler)


_EXIT: list[int] = []


@cache
def _mind_exit() -> None:
    # Python ends itself by the signal, whatever was asked, if the exception once went through an exec; being the first
    # to be registered, this is done last
    atexit.register(_last)


def _last() -> None:
    if _EXIT:
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(OSError, ValueError):
                stream.flush()
        os._exit(_EXIT[0])
    # all is done and told, and its exit code stands
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _end_children() -> None:
    import multiprocessing

    for child in multiprocessing.active_children():
        # joblib's are of a kind that cannot be told to kill
        with contextlib.suppress(ProcessLookupError, TypeError):
            os.kill(child.pid, signal.SIGKILL)  # type: ignore[arg-type]
        child.join()
    # joblib's processes are ended with its executor, if there is one: asking for it would make it
    loky = sys.modules.get("joblib.externals.loky.reusable_executor")
    executor = getattr(loky, "_executor", None)
    if executor is not None:
        executor.shutdown(wait=True, kill_workers=True)


class Count(click.IntRange):
    name = "N"


def one_line(text: str) -> str:
    return " ".join(text.split())


def complain(said: object) -> NoReturn:
    raise click.ClickException(str(said))


def nearest_or_all(word: str, known: Iterable[str]) -> str:
    from xsec_sym.record.store import nearest

    known = list(known)
    return nearest(word, known) or "; there are " + ", ".join(known)


# --- colour ----------------------------------------------------------------------------------------------


def coloured(stream: IO[str] | None = None) -> bool:
    """Whether colours may be used: on a terminal, unless NO_COLOR says no; anywhere where FORCE_COLOR says yes."""
    stream = stream or sys.stdout
    if os.environ.get("NO_COLOR"):
        return False
    if os.environ.get("FORCE_COLOR"):
        return True
    return stream.isatty() and os.environ.get("TERM", "") not in ("", "dumb")


def paint(text: str, colour: str) -> str:
    return click.style(text, fg=colour, bold=True) if coloured() else text


def say(text: str) -> None:
    try:
        text.encode(sys.stdout.encoding or "utf-8")
    except (UnicodeEncodeError, LookupError):
        # signs that mean something are spelt out where there are no such letters
        for sign, spelt in (("≈", "~="), ("≥", ">=")):
            text = text.replace(sign, spelt)
    click.echo(text, color=coloured())


def typesets() -> bool:
    """Whether formulas may take several lines, and letters that ASCII lacks."""
    return sys.stdout.isatty() and (sys.stdout.encoding or "").lower().replace("-", "").startswith("utf")


# --- files -----------------------------------------------------------------------------------------------


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


# --- progress --------------------------------------------------------------------------------------------


@dataclass
class Steps:
    """What is being done, how much of it is done, and how long the rest takes; silent where there is no terminal."""

    bar: Any = None
    task: Any = None
    begun: bool = False

    def expect(self, count: int, effort: float | None = None) -> None:
        """So many steps come; ``effort`` is the sum of what `done` will be told, 1 a step if nothing else is said."""
        if self.bar is not None:
            self.bar.update(self.task, total=effort or count, count=count)

    def now(self, *names: str) -> None:
        """These are in work."""
        if self.bar is not None:
            self.bar.update(self.task, description=", ".join(names))

    def done(self, effort: float = 1.0) -> None:
        if self.bar is not None:
            self.bar.update(self.task, advance=effort, steps=self.bar.tasks[0].fields["steps"] + 1)

    def next(self, name: str) -> None:
        """What was in work is done, and this is begun."""
        if self.begun:
            self.done()
        self.begun = True
        self.now(name)


@contextlib.contextmanager
def progress(doing: str = "", count: int | None = None) -> Iterator[Steps]:
    """A bar on standard error, gone when the block ends. Without a count it says only what is being done, at first."""
    if not sys.stderr.isatty():
        yield Steps()
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn
    from rich.table import Column

    cut = Column(no_wrap=True, overflow="ellipsis")
    columns: Sequence[Any] = (
        BarColumn(bar_width=24),
        TextColumn("{task.fields[steps]}/{task.fields[count]}"),
        TimeRemainingColumn(),
        TextColumn("left  {task.description}", markup=False, table_column=cut),
    )
    # an hour: the slowest steps would else leave the estimate without a single one to go by
    bar = Progress(*columns, console=Console(stderr=True), transient=True, speed_estimate_period=3600)
    with bar:
        steps = Steps(bar, bar.add_task(doing, total=count, steps=0, count=count if count is not None else "?"))
        yield steps
