"""A guide that is run: its files are written, its commands are called, and what they print is put in its place.

In a page, ```` ```python NAME ```` is a file, ```` ```python >> NAME ```` is added to one below two empty lines, and
```` ```console ```` holds commands, each after `$ `, with what they print below. `python -m tests.docs.replay PAGE`
writes the page anew.
"""

import contextlib
import importlib
import io
import os
import re
import runpy
import shlex
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

from click.testing import CliRunner

from xsec_sym.proof import REGISTRY

BLOCK = re.compile(r"^```(python|console)( >>)?(?: (\S+))?\n(.*?)^```$", re.M | re.S)
ROOT = Path(__file__).parents[2]
# the last column of a table of verdicts, and the time at the end of an entry's evidence
SECONDS = re.compile(r" +\d+\.\d\d$|\b[\d.]+(e-\d+)? s$", re.M)


class Said(NamedTuple):
    text: str
    code: int


def replayed(page, folder, codes):
    """The page as it should read, its blocks run in order in the folder, which begins empty.

    ``codes`` receives the exit code of every command, the worst where one comes more than once.
    """

    def run(block):
        kind, more, name, text = block.groups()
        if kind == "python":
            if name:
                with (folder / name).open("a" if more else "w", encoding="utf-8") as out:
                    out.write("\n\n" * bool(more) + text)
            return block[0]
        commands = [line[2:] for line in text.splitlines() if line.startswith("$ ")]
        found = []
        for command in commands:
            result = said(command, folder)
            codes[command] = max(codes.get(command, 0), result.code)
            found.append(f"$ {command}\n{result.text}")
        return "```console\n" + "".join(found) + "```"

    before = Path.cwd()
    os.chdir(folder)
    try:
        return BLOCK.sub(run, page)
    finally:
        os.chdir(before)


def said(command, folder):
    """What a command prints, and its exit code. `xsec` and Python run in this process, which has SymPy at hand."""
    words = shlex.split(command)
    if words[0] == "xsec":
        from xsec_sym import cli

        result = CliRunner().invoke(cli.main, words[1:], catch_exceptions=False)
        text, code = result.output, result.exit_code
    elif words[0] == "python":
        text, code = interpreted(words[1:], folder), 0
    else:
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True)
        text, code = done.stdout + done.stderr, done.returncode
    return Said("".join(line.rstrip() + "\n" for line in text.splitlines()), code)


def interpreted(words, folder):
    """What `python -m NAME`, `python FILE` or `python -c CODE` prints; nothing of it is left behind."""
    modules, path, claims = set(sys.modules), list(sys.path), dict(REGISTRY)
    REGISTRY.clear()
    sys.path.insert(0, str(folder))
    importlib.invalidate_caches()
    out = io.StringIO()
    try:
        with contextlib.redirect_stdout(out):
            if words[0] == "-m":
                runpy.run_module(words[1], run_name="__main__")
            elif words[0] == "-c":
                exec(words[1], {"__name__": "__main__"})
            else:
                runpy.run_path(words[0], run_name="__main__")
    finally:
        # libraries that were imported on the way may stay; a package without a file is the folder's own
        for name in set(sys.modules) - modules:
            found = sys.modules[name]
            place = getattr(found, "__file__", None) or (str(folder) if hasattr(found, "__path__") else "")
            if place.startswith(str(folder)):
                del sys.modules[name]
        sys.path[:] = path
        REGISTRY.clear()
        REGISTRY.update(claims)
    return out.getvalue()


def timeless(page):
    """The page without the seconds that were measured."""
    return SECONDS.sub("...", page)


if __name__ == "__main__":
    import tempfile

    for path in map(Path, sys.argv[1:]):
        with tempfile.TemporaryDirectory() as room:
            path.write_text(replayed(path.read_text(encoding="utf-8"), Path(room), {}), encoding="utf-8")
