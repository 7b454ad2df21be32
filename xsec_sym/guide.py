"""What to do next: for who calls `xsec` bare, and worked examples for the help of every command."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from xsec_sym.record.entry import Entry

# Command lines that work as they stand, in a folder that holds this project; tests hold them to it.
EXAMPLES: Mapping[str, tuple[tuple[str, str], ...]] = {
    "verify": (
        ("xsec verify deon2016:18", "check one equation: replay its proof, try it at fresh points"),
        ("xsec verify --fresh deon2016:18", "derive it again instead"),
        ("xsec verify --source kenha2018 --jobs 2", "all of a source, in two processes"),
        ("xsec verify --seed 7 --json out.json", "everything, at other points; the verdicts as JSON"),
    ),
    "show": (
        ("xsec show deon2016:18", "what is printed, what holds, where the print fails, the steps"),
        ("xsec show deon2016:22 deon2016:23", "two equations"),
        ("xsec show --latex deon2016:18", "its formulas as LaTeX, to paste into a paper"),
        ("xsec show deon2016", "a line on every entry of a source"),
        ("xsec show --bibtex deon2016 deon2016:18", "BibTeX for a paper, and for the verdict on its (18)"),
    ),
    "check": (
        ('xsec check "sin(2*x)" "2*sin(x)*cos(x)" --where "x in (-oo, oo)"', "an identity; exit code 0"),
        ('xsec check "sqrt(x**2)" "x" --where "x in (-1, 1)"', "refuted, with a point; exit code 1"),
    ),
    "chart": (
        ("xsec chart", "the quantities that are measured"),
        ("xsec chart sigma_ggx", "every method's error and time, as a table"),
        ("xsec chart sigma_ggx -o ggx.svg", "the same as a picture"),
        ("xsec chart sigma_ggx --stability -o lost.png", "where each method loses digits"),
        ("xsec chart sigma_ggx --measure -o ggx.json", "measure here, which takes minutes"),
    ),
    "export": (
        ("xsec export", "the list of what there is"),
        ("xsec export sigma_inv1pu2 -o kernel.py", "one function as a module of NumPy"),
        ("xsec export deon2016:11 deon2016:12 --dtype float32", "two equations, in single precision"),
    ),
    "plan": (
        ("xsec plan examples/foggy_glass.toml", "the choices for a scene, and what was turned down"),
        ("xsec plan examples/foggy_glass.toml -o kernels.py", "and the module"),
        ("xsec plan examples/foggy_glass.toml --measure", "go by times of this machine, measured first"),
    ),
    "report": (
        ("xsec report", "into the folder report; open report/index.html"),
        ("xsec report -o pages", "into another folder"),
    ),
    "new": (
        ("xsec new mypaper", "the folder mypaper, with a first module to fill in"),
        ("xsec new mypaper masking", "the same, and the module is called masking"),
    ),
    "completion": (
        ('eval "$(xsec completion bash)"', "for this Bash; in ~/.bashrc for every one"),
        ('eval "$(xsec completion zsh)"', "the same in ~/.zshrc, below compinit"),
        ("xsec completion fish > ~/.config/fish/completions/xsec.fish", "for fish, once"),
    ),
}

USERS = (
    (
        "You check a paper",
        ("xsec show deon2016:18", "one equation: what is printed, what holds, and why"),
        ("xsec verify --source deon2016", "replay the proofs of a whole source"),
        ("xsec report", "the record as pages, errata for each paper among them"),
    ),
    (
        "You need a kernel",
        ("xsec chart sigma_ggx", "what each method of a quantity costs, and its error"),
        ("xsec export", "what can be written as a module of NumPy"),
    ),
    (
        "You add a paper",
        ('xsec check "sqrt(x**2)" "x" --where "x in (-1, 1)"', "try an equation before deriving it"),
        ("xsec new mypaper", "a folder for it, with a first module to fill in"),
        ("xsec verify --derivations mypaper", "verify it beside the project's"),
    ),
    (
        "You plan a scene",
        ("xsec plan examples/foggy_glass.toml -o kernels.py", "the cheapest kernels within its tolerances"),
    ),
)


def told(record: Mapping[str, Entry]) -> str:
    """What a bare `xsec` says."""
    blocks = [state(record)]
    for who, *lines in USERS:
        blocks.append("\n".join([who, *(f"  {line:<52}  {said}".rstrip() for line, said in lines)]))
    blocks.append(
        "xsec --help lists all commands, xsec COMMAND --help has examples, and\n"
        'eval "$(xsec completion bash)" completes names (zsh and fish: see xsec completion --help).'
    )
    return "\n\n".join(blocks)


def state(record: Mapping[str, Entry]) -> str:
    """The record in one line.

    >>> state({})
    'The record is empty.'
    """
    if not record:
        return "The record is empty."
    from xsec_sym.record.show import UNSETTLED

    count = Counter(e.verdict for e in record.values())
    wide = [("proved or confirmed", count["proved"] + count["confirmed"]), ("misprints mended", count["misprint"])]
    wide += [("claims that fail", count["claim-fails"]), ("not settled", sum(count[word] for word in UNSETTLED))]
    sources = len({e.source for e in record.values()})
    said = ", ".join(f"{number} {name}" for name, number in wide)
    return f"The record: {len(record)} entries of {sources} sources; {said}."


def no_entry(name: str, derivations: str | None, near: str) -> str:
    """Why the record holds nothing by a name, with a hint that may have been found.

    >>> no_entry("mine:1", None, "")
    'there is no entry mine:1; one of your own wants --derivations PATH, and its verdict recorded'
    """
    from xsec_sym.study.method import HOMES

    said = f"there is no entry {name}{near}"
    if name in HOMES:
        return f"there is no entry {name}, but a quantity: xsec chart {name}"
    if near:
        return said
    if derivations:
        return f"{said}; xsec verify --derivations {derivations} --record keeps the verdicts there"
    return f"{said}; one of your own wants --derivations PATH, and its verdict recorded"


def made_by_hand(name: str) -> str:
    """What to do where a kernel is asked for that no equation alone gives; empty for other names.

    >>> made_by_hand("smith_g1")
    'smith_g1 is made by hand and not written: from xsec_sym.kernels import smith_g1'
    """
    from xsec_sym import kernels
    from xsec_sym.export.recipes import RECIPES
    from xsec_sym.study.method import HOMES

    if name in RECIPES or name not in kernels.__all__:
        return ""
    planned = "; xsec plan writes a module of it for a scene" if name in HOMES else ""
    return f"{name} is made by hand and not written: from xsec_sym.kernels import {name}{planned}"
