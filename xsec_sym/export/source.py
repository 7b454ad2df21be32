"""Parts of modules as text: a function with all that it needs, taken from where it stands."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path

OURS = "xsec_sym"
ALLOWED = ("numpy", "scipy.special")
FOLLOWING_THE_INPUT = "result_dtype"
SINGLE = '''def result_dtype(arguments: dict, orders: Collection[str] = ()) -> type[np.floating]:
    """float32, for which this module was exported, whatever the arguments are."""
    return np.float32
'''


class Entangled(ValueError):
    """A function cannot be cut out of its module."""


@dataclass
class _Module:
    """The top-level names of a module: the text of each, what it uses, and where other names come from."""

    name: str
    text: str
    parts: dict[str, tuple[int, str, set[str]]] = field(default_factory=dict)
    ours: dict[str, tuple[str, str]] = field(default_factory=dict)
    imports: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        lines = self.text.splitlines()
        for place, node in enumerate(ast.parse(self.text).body):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith(OURS):
                for alias in node.names:
                    self.ours[alias.asname or alias.name] = (str(node.module), alias.name)
            elif isinstance(node, ast.Import | ast.ImportFrom):
                self._learn_import(node)
            else:
                first = min([node.lineno, *(d.lineno for d in getattr(node, "decorator_list", []))])
                while first > 1 and lines[first - 2].startswith("#"):
                    first -= 1
                said = "\n".join(lines[first - 1 : node.end_lineno]) + "\n"
                used = {n.id for n in ast.walk(node) if isinstance(n, ast.Name)}
                for name in _bound(node):
                    self.parts[name] = (place, said, used)

    def _learn_import(self, node: ast.Import | ast.ImportFrom) -> None:
        for alias in node.names:
            bound = alias.asname or alias.name.partition(".")[0]
            renamed = f" as {alias.asname}" if alias.asname else ""
            if isinstance(node, ast.Import):
                self.imports[bound] = f"import {alias.name}{renamed}"
            else:
                self.imports[bound] = f"from {node.module} import {alias.name}{renamed}"


@lru_cache(maxsize=64)
def _parsed(name: str, text: str) -> _Module:
    """Every module that is cut out needs the same few, which take long to parse."""
    return _Module(name, text)


def _bound(node: ast.stmt) -> list[str]:
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        return [node.name]
    targets = node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, ast.AnnAssign) else []
    return [n.id for target in targets for n in ast.walk(target) if isinstance(n, ast.Name)]


class Cutting:
    """Functions taken out of modules of this package, each with what it needs, once.

    >>> cut = Cutting()
    >>> cut.take("xsec_sym.kernels._support", "quick_two_sum")
    >>> cut.imports(), [said.partition("(")[0] for said in cut.texts()]
    (['import numpy as np'], ['def quick_two_sum'])
    """

    def __init__(self, single: bool = False) -> None:
        self.single = single
        self._modules: dict[str, _Module] = {}
        self._taken: dict[str, tuple[str, int, str]] = {}
        self._order: list[str] = []
        self._imports: set[str] = set()

    def take(self, module: str, name: str) -> None:
        self._take(self._module(module), name)

    def add(self, module: str, text: str, name: str) -> None:
        """As `take`, from a text that is not in a file."""
        self._modules[module] = _Module(module, text)
        if module not in self._order:
            self._order.append(module)
        self.take(module, name)

    def _module(self, name: str) -> _Module:
        if name not in self._modules:
            spec = find_spec(name)
            if spec is None or not spec.origin:
                raise Entangled(f"there is no module {name}")
            self._modules[name] = _parsed(name, Path(spec.origin).read_text(encoding="utf-8"))
        return self._modules[name]

    def _take(self, module: _Module, name: str) -> None:
        if name in module.ours:
            home, known_as = module.ours[name]
            if known_as != name:
                raise Entangled(f"{module.name} calls {known_as} of {home} by another name")
            self._take(self._module(home), name)
        elif name in module.parts:
            place, said, used = module.parts[name]
            if name == FOLLOWING_THE_INPUT and self.single:
                said, used = SINGLE, {"np", "Collection"}
            if name in self._taken:
                if self._taken[name][:2] != (module.name, place):
                    raise Entangled(f"{name} is defined both in {self._taken[name][0]} and in {module.name}")
                return
            self._taken[name] = (module.name, place, said)
            for other in sorted(used):
                self._take(module, other)
            # what a module uses has to stand before it
            if module.name not in self._order:
                self._order.append(module.name)
        elif name in module.imports:
            said = module.imports[name]
            origin = said.split()[1]
            top = origin.partition(".")[0]
            if top not in _STANDARD and not any(origin == a or origin.startswith(a + ".") for a in ALLOWED):
                raise Entangled(f"{module.name} needs {origin}")
            self._imports.add(said)
        elif not hasattr(builtins, name):
            # a local name of the function
            return

    def imports(self) -> list[str]:
        """The import lines, as a formatter sorts them: the standard library first."""
        plain: list[str] = []
        named: dict[str, list[str]] = {}
        for said in sorted(self._imports):
            if said.startswith("import"):
                plain.append(said)
            else:
                home, _, name = said.removeprefix("from ").partition(" import ")
                named.setdefault(home, []).append(name)
        lines = [*plain, *(f"from {home} import {', '.join(sorted(names))}" for home, names in sorted(named.items()))]
        standard = [s for s in lines if s.split()[1].partition(".")[0] in _STANDARD]
        others = [s for s in lines if s not in standard]
        return [*standard, *([""] if standard and others else []), *others]

    def texts(self) -> list[str]:
        """The definitions, what is used by others first."""
        found = sorted({(self._order.index(module), place, said) for module, place, said in self._taken.values()})
        return [said for _, _, said in found]

    @property
    def needs_scipy(self) -> bool:
        return any("scipy" in said for said in self._imports)


_STANDARD = frozenset({"math", "collections", "typing", "functools", "itertools", "dataclasses", "operator"})


def joined(texts: Iterable[str]) -> str:
    """Definitions one below the other, with the blank lines that a formatter puts between them."""
    result, before = "", ""
    for said in texts:
        apart = _is_block(said) or _is_block(before)
        result += ("\n\n" if apart else "") + said if result else said
        before = said
    return result


def _is_block(said: str) -> bool:
    code = [line for line in said.splitlines() if not line.startswith("#")]
    return bool(code) and code[0].startswith(("def ", "class ", "@"))
