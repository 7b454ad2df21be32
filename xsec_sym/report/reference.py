"""The reference of public names, from the docstrings that the doctests run: nothing is written twice."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from markupsafe import Markup, escape

# Where the names are, and in what words a reader is told what the module is for; `study` names its own.
MODULES = {
    "xsec_sym": "",
    "xsec_sym.kernels": "",
    "xsec_sym.kernels.compiled": "",
    "xsec_sym.planner": "",
    "xsec_sym.study": "",
    "xsec_sym.proof": "what derivations import; the moves of a proof are listed in `docs/proof_moves.md`",
}
STUDY = {
    "xsec_sym.study.method": ("Argument", "Quantity", "Method", "Field", "UnknownQuantity", "along", "registered"),
    "xsec_sym.study.files": ("Unmeasured", "stored", "table", "write"),
}
# A module that needs an optional package is read, not imported.
OPTIONAL = ("xsec_sym.kernels.compiled",)
# Not a function, a class or an object that a reader calls.
INNER = ("xsec_sym.proof.REGISTRY",)
CODE = re.compile(r"`([^`]+)`")


@dataclass(frozen=True)
class Name:
    """A public name: how it is called, its docstring in paragraphs, and the names inside it."""

    path: str
    kind: str
    signature: str
    doc: str
    inner: tuple[Name, ...] = ()

    @property
    def name(self) -> str:
        return self.path.rpartition(".")[2]

    @property
    def example(self) -> bool:
        return ">>>" in self.doc

    @property
    def find(self) -> str:
        """What the search of the page looks through."""
        words = [self.path, self.kind, self.signature, self.doc, *(n.find for n in self.inner)]
        return " ".join(" ".join(words).lower().split())

    @property
    def paragraphs(self) -> list[tuple[str, Markup]]:
        return list(paragraphs(self.doc))


@dataclass(frozen=True)
class Module:
    path: str
    doc: str
    names: tuple[Name, ...] = field(default=())

    @property
    def paragraphs(self) -> list[tuple[str, Markup]]:
        return list(paragraphs(self.doc))


def modules() -> list[Module]:
    """Every module that a reader imports from, with its public names in their order.

    >>> {module.path: len(module.names) for module in modules()}["xsec_sym.kernels.compiled"]
    3
    """
    return [Module(path, _told(path, more), tuple(_names(path))) for path, more in MODULES.items()]


def _told(path: str, more: str) -> str:
    doc = ast.get_docstring(_tree(path)) or ""
    return f"{doc}\n\n{more[:1].upper()}{more[1:]}." if more else doc


def _names(path: str) -> Iterator[Name]:
    if path in OPTIONAL:
        yield from _read(path)
        return
    homes = STUDY if path == "xsec_sym.study" else {path: import_module(path).__all__}
    for home, names in homes.items():
        for name in names:
            if f"{home}.{name}" not in INNER:
                yield _name(f"{home}.{name}", getattr(import_module(home), name))


def _name(path: str, found: Any) -> Name:
    doc = inspect.getdoc(found) or ""
    if inspect.ismodule(found):
        return Name(path, "module", "", doc)
    if not inspect.isclass(found):
        if not callable(found):
            return Name(path, "object", "", inspect.getdoc(type(found)) or "", tuple(_inner(path, type(found))))
        return Name(path, "function", _signature(found), doc)
    if issubclass(found, Exception):
        return Name(path, "exception", "", doc)
    # a dataclass without a docstring is given its own signature as one
    doc = "" if doc.startswith(f"{found.__name__}(") else doc
    return Name(path, "class", _signature(found), doc, tuple(_inner(path, found)))


def _inner(path: str, owner: type) -> Iterator[Name]:
    for name, found in vars(owner).items():
        if name.startswith("_") and name != "__call__":
            continue
        plain = found.__func__ if isinstance(found, classmethod | staticmethod) else found
        if isinstance(plain, property):
            doc = inspect.getdoc(plain) or ""
            yield Name(f"{path}.{name}", "property", "", doc)
        elif inspect.isfunction(plain):
            yield Name(f"{path}.{name}", "method", _signature(plain, bound=True), inspect.getdoc(plain) or "")


def _signature(found: Callable[..., Any], bound: bool = False) -> str:
    try:
        told = inspect.signature(found)
    except (TypeError, ValueError):
        return ""
    arguments = [p.replace(annotation=p.empty) for p in told.parameters.values()]
    if bound and arguments and arguments[0].name in ("self", "cls"):
        arguments = arguments[1:]
    # what a default prints as may hold an address, which changes from run to run
    shown = [p.replace(default=_Shown(p.default)) if p.default is not p.empty else p for p in arguments]
    return str(told.replace(parameters=shown, return_annotation=told.empty))


class _Shown:
    def __init__(self, value: object) -> None:
        self.value = value

    def __repr__(self) -> str:
        said = repr(self.value)
        return "…" if " at 0x" in said or "<" in said else said


def _read(path: str) -> Iterator[Name]:
    """The public functions of a module, by its text."""
    for node in _tree(path).body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            arguments = ast.parse(ast.unparse(node)).body[0]
            assert isinstance(arguments, ast.FunctionDef)
            for a in arguments.args.args:
                a.annotation = None
            yield Name(
                f"{path}.{node.name}", "function", f"({ast.unparse(arguments.args)})", ast.get_docstring(node) or ""
            )


def _tree(path: str) -> ast.Module:
    spec = find_spec(path)
    assert spec is not None and spec.origin is not None
    return ast.parse(Path(spec.origin).read_text(encoding="utf-8"))


def paragraphs(doc: str) -> Iterator[tuple[str, Markup]]:
    """A docstring as paragraphs: "text", whose words in backticks are code, "example", and "table" as it is typed.

    >>> [(kind, str(text)) for kind, text in paragraphs("Doubles `x`.\\n\\n>>> 2 * 2\\n4")]
    [('text', 'Doubles <code>x</code>.'), ('example', '&gt;&gt;&gt; 2 * 2\\n4')]
    """
    for part in re.split(r"\n\s*\n", inspect.cleandoc(doc)) if doc.strip() else []:
        lines = part.splitlines()
        if part.lstrip().startswith(">>>"):
            yield "example", escape(part)
        elif any(re.match(r"\s*[=-]{3,}", line) for line in lines) or all(line.startswith("    ") for line in lines):
            yield "table", escape(part)
        else:
            said = str(escape(" ".join(line.strip() for line in lines)))
            yield "text", Markup(CODE.sub(r"<code>\1</code>", said.replace("``", "`")))


__all__ = ["Module", "Name", "modules", "paragraphs"]
