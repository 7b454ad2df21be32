"""Chosen candidates as one NumPy module that needs nothing of this package."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Sequence
from typing import Any

from xsec_sym.export.source import ALLOWED, Entangled, joined
from xsec_sym.planner import runtime
from xsec_sym.planner.candidates import Candidate
from xsec_sym.planner.cutting import Bundle

WIDTH = 120


def reason_not_to_write(candidate: Candidate) -> str:
    """Why a candidate cannot stand in a module, in a few words; nothing if it can."""
    method = candidate.method
    if method is None:
        return ""
    if method.serial:
        return "takes one number at a time"
    if method.needs:
        return f"needs {method.needs}, while a planned module imports NumPy and SciPy alone"
    if method.folds and candidate.material.folded is None:
        return "is for constant " + ", ".join(a.name for a in candidate.material.quantity.set)
    try:
        _function(Bundle(), candidate)
    except Entangled as error:
        return f"cannot be written down: {error}"
    return ""


def module(chosen: Sequence[Candidate], errors: Sequence[float], generals: Sequence[float], title: str) -> str:
    """The text of the module: a function for each, with its expected error, and the general kernel's time."""
    bundle = Bundle(c.material.function for c in chosen)
    functions = [
        _written(bundle, candidate, error, general)
        for candidate, error, general in zip(chosen, errors, generals, strict=True)
    ]
    body = joined([bundle.text(), *functions]) if bundle.text() else joined(functions)
    return _head(bundle, chosen, title) + body


def _head(bundle: Bundle, chosen: Sequence[Candidate], title: str) -> str:
    from xsec_sym import __version__

    needs = "NumPy and scipy.special" if bundle.needs_scipy else "NumPy"
    lines = textwrap.wrap(f"{title}: the kernels of a scene, planned by xsec_sym {__version__}.", WIDTH - 3)
    lines += ["", f"Imports {needs} only. What is outside a function's ranges gives NaN, or the right value.", ""]
    for c in chosen:
        said = f"{c.material.function}: {c.material.wanted()}; {c.name}"
        lines += textwrap.wrap(said, WIDTH, subsequent_indent="    ", break_on_hyphens=False)
    imports = "\n".join(bundle.imports())
    return f'"""{_quoted(chr(10).join(lines))}\n"""\n\n{imports}\n\n\n'


def _quoted(text: str) -> str:
    return re.sub(r"\s+$", "", text.replace("\\", "/").replace('"', "'"), flags=re.M)


def _docstring(candidate: Candidate, error: float, general: float) -> str:
    material = candidate.material
    model = "" if candidate.model == material.quantity.name else f", which is that of {candidate.model}"
    paragraphs = [
        f"{material.quantity.title[:1].upper()}{material.quantity.title[1:]}, for {material.name}.",
        f"{material.wanted()}. Arguments of shapes that broadcast.",
        f"By: {candidate.name}{model}; from {candidate.source}. Expected {material.error} error: {error:.2g}. "
        f"About {candidate.ns:.3g} ns a value on the machine that was measured, {general:.3g} by the general kernel.",
    ]
    filled = [textwrap.fill(_quoted(p), WIDTH - 7, break_on_hyphens=False) for p in paragraphs]
    return textwrap.indent('"""' + "\n\n".join(filled) + '\n"""', "    ", lambda line: bool(line.strip()))


def _function(bundle: Bundle, candidate: Candidate) -> str:
    """The name of the method's function in the text."""
    method, wanted = candidate.method, f"{candidate.material.function}_by"
    assert method is not None and candidate.parameters is not None
    made: Any = candidate.made
    try:
        return bundle.function(made, wanted if "<" in getattr(made, "__qualname__", "") else "")
    except Entangled:
        if not method.folds or isinstance(made, type(_function)):
            raise
        return bundle.call(method.make, candidate.material.folded or (), dict(candidate.parameters), wanted)


def _written(bundle: Bundle, candidate: Candidate, error: float, general: float) -> str:
    material = candidate.material
    arguments = material.arguments
    np_ = bundle._import("import numpy as np", "np")
    typed = ", ".join(f"{a}: {np_}.typing.ArrayLike" for a in arguments)
    head = f"def {material.function}({typed}) -> {np_}.ndarray | {np_}.floating:\n"
    head += _docstring(candidate, error, general)
    if candidate.number is not None:
        return f"{head}\n    return {np_}.{material.dtype}({candidate.number!r})\n"
    given = {a: a for a in arguments}
    if material.dtype == "float32":
        single = bundle.function(runtime.single)
        given = {a: f'{single}("{a}", {a})' for a in arguments}
    if candidate.plain:
        name = _function(bundle, candidate)
        names = [*material.running, *(a.name for a in material.quantity.set)]
        passed = ", ".join(given.get(n) or _number(material.constants[n]) for n in names)
        return f"{head}\n    return {name}({passed})\n"
    from xsec_sym.kernels._support import elementwise

    within, blocks = bundle.function(runtime.within), bundle.function(elementwise)
    limits = "".join(f", ({a}, {low!r}, {high!r})" for a, (low, high) in _limits(candidate).items())
    core = bundle.fresh(f"_{material.function}")
    value = _table(bundle, candidate) if candidate.table is not None else _call(bundle, candidate)
    inner = f"def {core}({', '.join(f'{a}: {np_}.ndarray' for a in arguments)}) -> {np_}.ndarray:\n"
    inner += f"    return {within}({value}{limits})\n" if limits else f"    return {value}\n"
    passed = ", ".join(f"{a}={said}" for a, said in given.items())
    return f"{inner}\n\n{head}\n    return {blocks}({core}, {passed})\n"


def _limits(candidate: Candidate) -> dict[str, tuple[float, float]]:
    return {a: candidate.material.ranges[a] for a in candidate.material.arguments if a in candidate.material.ranges}


def _number(value: float) -> str:
    return repr(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)


def _call(bundle: Bundle, candidate: Candidate) -> str:
    assert candidate.method is not None
    material, name = candidate.material, _function(bundle, candidate)
    np_ = bundle._import("import numpy as np", "np")
    passed = [
        a if a in material.arguments else f"{np_}.full_like({material.arguments[0]}, {material.constants[a]!r})"
        for a in material.running
    ]
    for argument in material.quantity.set if not candidate.method.folds else ():
        if argument.name in material.ranges:
            passed.append(argument.name)
        elif material.folded is not None:
            passed.append(repr(material.constants[argument.name]))
        else:
            passed.append(f"{np_}.full_like({material.arguments[0]}, {material.constants[argument.name]!r})")
    return f"{name}({', '.join(passed)})"


def _table(bundle: Bundle, candidate: Candidate) -> str:
    table = candidate.table
    assert table is not None
    (x,) = candidate.material.arguments
    np_ = bundle._import("import numpy as np", "np")
    rows = bundle.array(table.rows, candidate.material.function)
    if table.variable == "half angle":
        x = f"{bundle.function(runtime.half_angle)}({x})"
    name = bundle.function(runtime.piecewise if table.pieces > 1 else runtime.polynomial)
    value = f"{name}({x}, {table.low!r}, {table.scale!r}, {rows})"
    return f"{np_}.exp({value})" if table.form == "logarithm" else value


def foreign(source: str) -> list[str]:
    """What a text imports besides the standard library, NumPy and scipy.special.

    >>> foreign("import math\\nimport numpy as np\\nimport numba")
    ['numba']
    """
    import ast
    import sys

    found = []
    for node in ast.walk(ast.parse(source)):
        names = []
        if isinstance(node, ast.Import):
            names = [a.name for a in node.names]
        elif isinstance(node, ast.ImportFrom):
            names = [node.module or ""]
            if node.module == "scipy":
                names = [f"scipy.{a.name}" for a in node.names]
        found += [
            n
            for n in names
            if n.partition(".")[0] not in sys.stdlib_module_names
            and not any(n == a or n.startswith(f"{a}.") for a in ALLOWED)
        ]
    return found
