"""From names to a module: which entries each rests on, its docstring, and all that it needs in one text."""

from __future__ import annotations

import contextlib
import re
import textwrap
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

from sympy import Integer, Rational, oo

from xsec_sym import kernels
from xsec_sym.export.floats import SPECIAL
from xsec_sym.export.kernel import VERIFIED, Branch, Refusal, branches, core, named, python_names
from xsec_sym.export.measure import judged, largest
from xsec_sym.export.printer import Unprintable, missing
from xsec_sym.export.recipes import GENERATED, RECIPES, Recipe
from xsec_sym.export.source import Cutting, Entangled, joined
from xsec_sym.export.special import bessels
from xsec_sym.proof.domain import Domain, Interval
from xsec_sym.record.entry import Entry
from xsec_sym.record.store import Ledger, nearest

DTYPES = ("float64", "float32", None)
KERNELS = "xsec_sym.kernels"
WIDTH = 120
# Before a function, while it is looked through for what it needs.
HEAD = (
    "import numpy as np\nimport scipy.special\n\nfrom xsec_sym.export.functions import i2e, ierfc, langevin\n"
    "from xsec_sym.kernels._support import elementwise\n\n\n"
)
# Points for a function that is exported once; the generated kernels are measured at more.
QUICK = 200
# Forms that divide what cancels by powers of a variable: its name, and the range where digits are left of the quotient.
# (41) needs the sign of (42) alone outside the layer, and its size only where that is small.
KEPT_DIGITS = {
    "deon2016:41": ("m", Rational(1, 10**6), oo),
    "deon2016:42": ("m", Rational(1, 10**3), Integer(1000)),
}
Record = Mapping[str, Entry]
Errors = tuple[float, float]


@cache
def recorded() -> Ledger:
    return Ledger()


# --- what there is ---------------------------------------------------------------------------------------


def available(record: Record | None = None) -> dict[str, str]:
    """Everything that `module` exports, with a line on each.

    >>> available()["sigma_power"]
    'cross-section of D(x) = x^p, p = 0 to 200 (Table 1)'
    """
    record = recorded() if record is None else record
    found = {r.name: r.summary for r in RECIPES.values() if all(_stands(record, name) for name in r.ids)}
    for entry, parts in closed(record):
        if not any(missing(bessels(b.form)) for b in parts):
            found[entry.id] = entry.title
    return found


def closed(record: Record) -> Iterator[tuple[Entry, list[Branch]]]:
    """The verified entries that are closed forms of real variables, some with functions that have no code."""
    for entry in record.values():
        with contextlib.suppress(Refusal):
            yield entry, _branches(entry, record)


def _stands(record: Record, name: str) -> bool:
    return name in record and record[name].verdict in VERIFIED | {"divergent"}


def _entry(record: Record, name: str) -> Entry:
    try:
        return record[name]
    except KeyError:
        if any(entry.source == name for entry in record.values()):
            raise Refusal(f"{name} is a source: export its equations by their ids") from None
        raise Refusal(
            f"there is nothing to export by the name {name}{nearest(name, [*RECIPES, *kernels.__all__, *record])}"
        ) from None


def _branches(entry: Entry, record: Record) -> list[Branch]:
    """The branches of an entry, with variables that are Python names."""
    parts: list[Entry] = []
    if entry.kind == "whole":
        parts = [_entry(record, p) for p in entry.parts]
        sides = {p.id.removeprefix(entry.id) for p in parts}
        if not sides <= {".neg", ".zero", ".pos"}:
            raise Refusal(f"{entry.id} is a display of several equations; export its parts {', '.join(entry.parts)}")
    found = branches(entry, parts)
    symbols = python_names(dict.fromkeys(s for b in found for s in b.domain.symbols))
    alike = [s.name for s in symbols.values()]
    if len(set(alike)) < len(alike):
        raise Refusal(f"{entry.id} has two variables of one name, and cannot be a function of {', '.join(alike)}")
    return [_with_digits(entry, named(b, symbols)) for b in found]


def _with_digits(entry: Entry, branch: Branch) -> Branch:
    """Where the form keeps digits; beyond, no wrong number is given."""
    if entry.id not in KEPT_DIGITS:
        return branch
    name, low, high = KEPT_DIGITS[entry.id]

    def narrow(domain: Domain) -> Domain:
        variables = [
            Interval(v.symbol, max(v.low, low), min(v.high, high), v.low > low, v.high <= high and v.high_open)
            if isinstance(v, Interval) and v.symbol.name == name
            else v
            for v in domain.variables
        ]
        return Domain(tuple(variables), domain.conditions, domain.instances)

    return replace(branch, domain=narrow(branch.domain), within=narrow(branch.within))


# --- generated functions -----------------------------------------------------------------------------------


def written(name: str, entry: Entry, record: Record, recipe: Recipe | None = None, errors: Errors | None = None) -> str:
    """The source of a generated function and its private parts. Errors are measured where none are given."""
    found, told = _branches(entry, record), ""
    try:
        body = core(name, found)
    except Unprintable as error:
        raise Refusal(f"{entry.id} cannot be exported: {error}") from error
    arguments = [s.name for s in found[0].domain.symbols]
    if errors is None:
        errors, told = judged(executable(name, body, arguments), found, QUICK)
    said = _docstring(name, entry, record, found, recipe, errors, body, told)
    return body + "\n\n" + _public(name, arguments, said)


def _public(name: str, arguments: Sequence[str], said: str) -> str:
    typed = ", ".join(f"{a}: np.typing.ArrayLike" for a in arguments)
    passed = ", ".join(f"{a}={a}" for a in arguments)
    return (
        f"def {name}({typed}) -> np.ndarray | np.floating:\n"
        f"{textwrap.indent(said, '    ', lambda line: bool(line.strip()))}\n"
        f"    return elementwise(_{name}, {passed})\n"
    )


def executable(name: str, body: str, arguments: Sequence[str]) -> Any:
    """The function, ready to be called."""
    import numpy as np

    from xsec_sym.kernels._support import elementwise

    space: dict[str, Any] = {**SPECIAL, "np": np, "elementwise": elementwise}
    exec(body + "\n\n" + _public(name, arguments, '"""."""'), space)
    return space[name]


def _docstring(
    name: str, entry: Entry, record: Record, found: Sequence[Branch], recipe: Recipe | None, errors: Errors, body: str,
    told: str = "",
) -> str:  # fmt: skip
    arguments = [s.name for s in found[0].domain.symbols]
    shapes = ", of shapes that broadcast" if len(arguments) > 1 else ", of any shape"
    if recipe:
        title, more, ranges = recipe.title, recipe.about, "u: cosine in [-1, 1]"
    else:
        infinite = ", ".join(sorted({b.domain.text() for b in found if b.form.is_infinite}))
        title = f"{entry.title[:1].upper()}{entry.title[1:]}."
        more = f"{entry.reading}. " * bool(entry.reading) + f"Infinite for {infinite}." * bool(infinite)
        if entry.id in KEPT_DIGITS:
            more += (
                f"The equation holds for {entry.where.text()}; beyond the range below, what it divides by powers of "
                f"{KEPT_DIGITS[entry.id][0]} cancels to nothing, or a power leaves the range of numbers."
            )
        ranges = f"{', '.join(arguments)}: real numbers, {_where(found)}"
    bounds = ""
    if any(b.within.conditions for b in found):
        bounds = " So may arguments within a rounding error of a bound that depends on others."
    semantics = (
        f"{ranges}{shapes}. Anything else, NaN included, gives NaN.{bounds} float32 for float32 arguments, float64 "
        "otherwise. TypeError for arguments that are no real numbers"
    )
    semantics += ", ValueError for shapes that do not broadcast." if len(arguments) > 1 else "."
    basis = (
        f"{verdicts(entry, record)}. Largest error found: {errors[0]:g} ulp in float64, {errors[1]:g} ulp in float32."
        f"{told}"
    )
    # a long title becomes a paragraph of its own below a short one
    head = [title] if len(title) <= WIDTH - 7 else [f"The verified form of {entry.id}.", _filled(title)]
    paragraphs = [*head, *(_filled(text) for text in (more, semantics, basis) if text)]
    if recipe:
        result = eval(recipe.example, {name: executable(name, body, arguments)})
        paragraphs.append(f">>> {recipe.example}\n{result!r}")
    return _quoted("\n\n".join(paragraphs))


def _quoted(text: str) -> str:
    said = text.strip().replace("\\", "/").replace('"', "'")
    return f'"""{said}\n"""'


def _filled(text: str) -> str:
    return textwrap.fill(text, WIDTH - 4, break_long_words=False, break_on_hyphens=False)


def _where(found: Sequence[Branch]) -> str:
    return " or ".join(dict.fromkeys(b.within.text().replace("; ", ", ") for b in found))


def verdicts(entry: Entry, record: Record) -> str:
    """The ids that a function rests on, each with its verdict."""
    if entry.kind == "whole":
        return ", ".join(f"`{p}` ({_verdict(record[p])})" for p in entry.parts)
    return f"`{entry.id}` ({_verdict(entry)})"


def _verdict(entry: Entry) -> str:
    return "misprint, corrected" if entry.verdict == "misprint" else entry.verdict


# --- whole modules -------------------------------------------------------------------------------------------


def kernel_module(module: str, record: Record, errors: Mapping[str, Errors]) -> str:
    """A generated module of kernels."""
    recipes = [r for r in RECIPES.values() if r.module == module]
    for recipe in recipes:
        _verified(recipe, record)
    head = (
        f'"""{GENERATED[module]}\n\n'
        "Generated from the record of verified equations by `python -m xsec_sym.export`: do not edit.\n"
        '"""\n\nfrom __future__ import annotations\n\n'
        "import numpy as np\n\nfrom xsec_sym.kernels._support import elementwise\n"
    )
    parts = [written(r.name, _entry(record, r.cell), record, r, errors.get(r.name)) for r in recipes]
    return "\n\n".join([head, *parts])


def remeasured(record: Record) -> dict[str, Errors]:
    """The largest errors of all generated kernels, as they are on this machine."""
    found: dict[str, Errors] = {}
    for recipe in RECIPES.values():
        if recipe.cell:
            parts = _branches(_entry(record, recipe.cell), record)
            arguments = [s.name for s in parts[0].domain.symbols]
            found[recipe.name] = largest(executable(recipe.name, core(recipe.name, parts), arguments), parts)
    return found


def _verified(recipe: Recipe, record: Record) -> list[Entry]:
    entries = [_entry(record, name) for name in recipe.ids]
    for entry in entries:
        if not _stands(record, entry.id):
            raise Refusal(f"{recipe.name} rests on {entry.id}, which is not verified: its verdict is {entry.verdict}")
    return entries


def function_name(name: str) -> str:
    """The name of the function for an entry.

    >>> function_name("deon2016:T1.inv1p.s2")
    'deon2016_t1_inv1p_s2'
    """
    word = re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_").lower()
    return word if word[:1].isalpha() else f"f_{word}"


def module(
    wanted: Iterable[str],
    dtype: str | None = "float64",
    record: Record | None = None,
    tick: Callable[[str], None] = lambda name: None,
) -> str:
    """One self-contained module with the functions asked for: names of `available`, or ids of the record.

    "float64" computes in double and, as the kernels do, answers float32 for float32; "float32" answers float32 whatever
    the arguments are. ``tick`` is called with each name as it is begun. Raises `Refusal` for what is unknown, not
    verified, or no closed form of real variables.

    >>> print(module(["sigma_inv1pi"]))
    Traceback (most recent call last):
    ...
    xsec_sym.export.kernel.Refusal: there is nothing to export by the name sigma_inv1pi; did you mean sigma_inv1p...
    """
    if dtype not in DTYPES:
        raise Refusal(f"{dtype} is no dtype to export for; there are float32 and float64")
    wanted = list(dict.fromkeys(wanted))
    if not wanted:
        raise Refusal("name at least one function or equation to export")
    record = recorded() if record is None else record
    cells = {r.cell: r.name for r in RECIPES.values() if r.cell}
    cut = Cutting(single=dtype == "float32")
    told: dict[str, str] = {}
    try:
        for name in dict.fromkeys(cells.get(name, name) for name in wanted):
            tick(name)
            if name in RECIPES:
                recipe = RECIPES[name]
                basis = _verified(recipe, record)
                cut.take(f"{KERNELS}.{recipe.module}", name)
                told[name] = f"{recipe.summary}; " + ", ".join(f"{e.id} {_verdict(e)}" for e in basis)
            else:
                entry = _entry(record, name)
                public = function_name(name)
                if public in told:
                    raise Refusal(f"two of the names asked for become the function {public}")
                text = _covered(public, entry, record)
                cut.add(f"entry {name}", HEAD + text, public)
                told[public] = f"{entry.title}; {verdicts(entry, record).replace('`', '')}"
    except Entangled as error:
        raise Refusal(f"this cannot be made one module: {error}") from error
    return _header(told, cut, dtype) + joined(cut.texts())


def _covered(public: str, entry: Entry, record: Record) -> str:
    try:
        return written(public, entry, record)
    except Refusal as refusal:
        by = [r.name for r in RECIPES.values() if entry.id in r.ids and not r.cell]
        if by and _stands(record, entry.id):
            raise Refusal(f"{refusal}; export {by[0]}, which rests on it") from refusal
        raise


def _header(told: Mapping[str, str], cut: Cutting, dtype: str | None) -> str:
    from xsec_sym import __version__

    needs = "NumPy and scipy.special" if cut.needs_scipy else "NumPy"
    result = "float32, whatever the arguments are" if dtype == "float32" else "float32 for float32, float64 otherwise"
    lines = [f"Exported by xsec_sym {__version__}. Imports {needs} only; results are {result}.", ""]
    for name, said in told.items():
        lines += textwrap.wrap(f"{name}: {said}", WIDTH, subsequent_indent="    ", break_on_hyphens=False)
    imports = "\n".join(cut.imports())
    apart = "\n" if cut.texts()[0].startswith(("#", "_", *"ABCDEFGHIJKLMNOPQRSTUVWXYZ")) else "\n\n"
    return f"{_quoted(chr(10).join(lines))}\n\n{imports}\n{apart}"
