"""`xsec new`: a folder for the derivations of a paper of one's own, with one module that already verifies."""

from __future__ import annotations

import keyword
import re
from pathlib import Path

import click

from xsec_sym.terminal import complain, output

SECTION = '''"""{key}, {section}: say here what the section shows, in whose notation, and in which normalisation."""

from sympy import Integral, Symbol

from xsec_sym.proof import Source, interval

paper = Source("{key}", section="{section}")

# Real variables; their ranges are stated claim by claim, so that SymPy assumes no more than the paper does.
u = Symbol("u", real=True)
x = Symbol("x", real=True)

# An equation of the paper: the left side from the definition, the right side symbol by symbol as it is printed.
first = paper.claim(
    "1",
    "the integral of x",
    left=Integral(x, (x, 0, u)),
    printed=u**2 / 2,
    where=[interval(u, 0, 1)],
    reading="what the print leaves open, such as the normalisation",
)


@first.proof
def antiderivative(step):
    step.antiderivative(x**2 / 2)


if __name__ == "__main__":
    paper.tell()
'''


def module(key: str, section: str) -> str:
    """The text of a first module, whose one claim is proved.

    >>> 'Source("heitz2014", section="masking")' in module("heitz2014", "masking")
    True
    """
    return SECTION.format(key=key, section=section)


@click.argument("folder", metavar="PATH")
@click.argument("section", default="section", metavar="[SECTION]")
def new(folder: str, section: str) -> None:
    """Begin the derivations of a paper: a folder, named by the paper's key, with a module that verifies.

    SECTION names the module; more of them may be begun in the same folder. `xsec verify --derivations PATH` checks
    what is in it.
    """
    key = Path(folder).resolve().name
    for word, what in ((key, "the folder"), (section, "the section")):
        # both become Python modules, and the first the part of every id before the colon
        if not re.fullmatch(r"[a-z][a-z0-9_]*", word) or keyword.iskeyword(word):
            complain(f"{what} cannot be called {word}: use small letters, digits and _, and begin with a letter")
    _free(key, folder)
    target = Path(folder) / f"{section}.py"
    if target.exists():
        complain(f"{target} is there already")
    try:
        Path(folder).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        complain(f"cannot make the folder {folder}: {error.strerror or error}")
    with output(str(target)) as out:
        assert out is not None
        out.write(module(key, section))
    click.echo(f"{target}: try  xsec verify --derivations {folder} --source {key}")


def _free(key: str, folder: str) -> None:
    from xsec_sym.record.store import ledger

    if key in ledger.sources:
        complain(f"{key} is a source of the project; give the folder {folder} another name")


__all__ = ["module", "new"]
