"""The reference of public names, from the docstrings that the doctests run: nothing is written twice."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Callable, Iterable, Iterator
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
# A line of the index that a module's docstring holds: a name with its arguments, and what it is.
LISTED = re.compile(r"^    (\w+)\(.*?\): (.+)$")


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
        return list(paragraphs(self.doc, re.findall(r"\w+", self.signature)))

    @property
    def link(self) -> str:
        return f"api:{self.path}"


@dataclass(frozen=True)
class Module:
    path: str
    doc: str
    names: tuple[Name, ...] = field(default=())

    @property
    def paragraphs(self) -> list[tuple[str, Markup]]:
        return [(kind, text) for part in _parts(self.doc) if not _listed(part) for kind, text in paragraphs(part)]

    @property
    def index(self) -> list[tuple[str, list[tuple[Name, str]]]]:
        """Headings with their names and what these are: as the docstring groups them, or all under none.

        >>> next(m for m in modules() if m.path == "xsec_sym.kernels").index[1][0]
        'Distributions of normals at the cosine u'
        """
        names = {name.name: name for name in self.names}
        groups = [
            (part.partition(":\n")[0], [(names[found[1]], found[2]) for found in _listed(part) if found[1] in names])
            for part in _parts(self.doc)
            if _listed(part)
        ]
        return groups or [("", [(name, "") for name in self.names])]


def _parts(doc: str) -> list[str]:
    return re.split(r"\n\s*\n", inspect.cleandoc(doc)) if doc.strip() else []


def _listed(part: str) -> list[re.Match[str]]:
    """The lines of a part of an index, empty for any other part."""
    head, *lines = part.splitlines()
    found = [LISTED.match(line) for line in lines]
    return [f for f in found if f] if head.endswith(":") and all(found) else []


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
        # its index stands where the module itself is told of
        return Name(path, "module", "", "\n\n".join(part for part in _parts(doc) if not _listed(part)))
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


def paragraphs(doc: str, arguments: Iterable[str] = ()) -> Iterator[tuple[str, Markup]]:
    """A docstring as paragraphs: "text", whose words in backticks are code, "example", and "table" as it is typed.

    Where an argument is explained, as in "alpha: roughness", its name stands out.

    >>> [(kind, str(text)) for kind, text in paragraphs("Doubles `x`.\\n\\n>>> 2 * 2\\n4")]
    [('text', 'Doubles <code>x</code>.'), ('example', '&gt;&gt;&gt; 2 * 2\\n4')]
    >>> [str(text) for kind, text in paragraphs("u, v: cosines. b: at most 1.", ["u", "v", "b"])]
    ['<b>u, v</b>: cosines. <b>b</b>: at most 1.']
    """
    known = "|".join(sorted(arguments, key=len, reverse=True))
    for part in _parts(doc):
        lines = part.splitlines()
        if part.lstrip().startswith(">>>"):
            yield "example", escape(part)
        elif any(re.match(r"\s*[=-]{3,}", line) for line in lines) or all(line.startswith("    ") for line in lines):
            yield "table", escape(part)
        else:
            said = str(escape(" ".join(line.strip() for line in lines)))
            said = CODE.sub(r"<code>\1</code>", said.replace("``", "`"))
            if known:
                said = re.sub(rf"(^|\. )((?:{known})(?:(?:, | and )(?:{known}))*): ", r"\1<b>\2</b>: ", said)
            yield "text", Markup(said)


__all__ = ["Module", "Name", "modules", "paragraphs"]
