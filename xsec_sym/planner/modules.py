"""The modules of this package as text: which names stand at the top of each, what they use, and where that is from."""

from __future__ import annotations

import ast
from dataclasses import dataclass, field
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from xsec_sym.export.source import OURS, Entangled

Function = ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda
Scoped = ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda | ast.ClassDef


@dataclass(frozen=True)
class Use:
    """A name that is none of the function's own, or a dotted one that begins with such a name; and where it stands."""

    node: ast.Name | ast.Attribute
    base: str
    attribute: str = ""


@dataclass
class Module:
    """parts: what is bound at the top, and the statements that bind it. ours, imports: names that are from elsewhere:
    (module, name there) in this package, where the name there is "" for a module; and import lines.
    """

    name: str
    text: str
    parts: dict[str, ast.stmt]
    ours: dict[str, tuple[str, str]]
    imports: dict[str, str]
    functions: list[ast.FunctionDef | ast.Lambda] = field(default_factory=list)
    lines: list[str] = field(default_factory=list)
    _uses: dict[int, list[Use]] = field(default_factory=dict)

    def uses(self, node: ast.stmt | ast.Lambda) -> list[Use]:
        """As `uses`, of a node of this module; kept."""
        if id(node) not in self._uses:
            self._uses[id(node)] = uses(node)
        return self._uses[id(node)]

    def segment(self, node: ast.stmt) -> tuple[int, int]:
        """The first line and the last of a statement, from 1 on, with its decorators and the comment above."""
        lines = self.lines
        first = min([node.lineno, *(d.lineno for d in getattr(node, "decorator_list", []))])
        while first > 1 and lines[first - 2].startswith("#") and not lines[first - 2].startswith("# ---"):
            first -= 1
        return first, node.end_lineno or first


@cache
def read(name: str) -> Module:
    spec = find_spec(name)
    if spec is None or not spec.origin:
        raise Entangled(f"there is no module {name}")
    text = Path(spec.origin).read_text(encoding="utf-8")
    module = Module(name, text, {}, {}, {}, lines=text.splitlines())
    tree = ast.parse(text)
    module.functions = [n for n in ast.walk(tree) if isinstance(n, ast.FunctionDef | ast.Lambda)]
    for node in tree.body:
        if isinstance(node, ast.Import | ast.ImportFrom):
            learn(module, node)
        else:
            for bound in _bound(node):
                module.parts[bound] = node
    return module


def learn(module: Module, node: ast.Import | ast.ImportFrom) -> None:
    for alias in node.names:
        if isinstance(node, ast.Import):
            bound = alias.asname or alias.name.partition(".")[0]
            renamed = f" as {alias.asname}" if alias.asname else ""
            module.imports[bound] = f"import {alias.name}{renamed}"
        elif node.level == 0 and (node.module or "").partition(".")[0] == OURS:
            below = f"{node.module}.{alias.name}"
            known = _is_module(below)
            module.ours[alias.asname or alias.name] = (below, "") if known else (str(node.module), alias.name)
        else:
            renamed = f" as {alias.asname}" if alias.asname else ""
            module.imports[alias.asname or alias.name] = f"from {node.module} import {alias.name}{renamed}"


@cache
def _is_module(name: str) -> bool:
    try:
        return find_spec(name) is not None
    except ModuleNotFoundError:
        return False


def _bound(node: ast.stmt) -> list[str]:
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        return [node.name]
    targets = node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, ast.AnnAssign) else []
    return [n.id for target in targets for n in ast.walk(target) if isinstance(n, ast.Name)]


def own_names(function: Function) -> set[str]:
    """The arguments of a function and all that it binds, inner functions' own names not among them."""
    spec = function.args
    found = {a.arg for a in [*spec.posonlyargs, *spec.args, *spec.kwonlyargs, spec.vararg, spec.kwarg] if a is not None}
    free: set[str] = set()
    stack: list[ast.AST] = list(function.body) if isinstance(function.body, list) else [function.body]
    while stack:
        node = stack.pop()
        if isinstance(node, ast.Global | ast.Nonlocal):
            free.update(node.names)
        elif isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load):
            found.add(node.id)
        elif isinstance(node, ast.ExceptHandler) and node.name:
            found.add(node.name)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            found.update(a.asname or a.name.partition(".")[0] for a in node.names)
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            found.add(node.name)
        if not isinstance(node, Scoped):
            stack.extend(ast.iter_child_nodes(node))
    return found - free


def uses(node: ast.AST, own: frozenset[str] = frozenset()) -> list[Use]:
    """Where names of the module are used or bound inside of `node`, in the order in which they are found."""
    found: list[Use] = []
    _look(node, own, found)
    return found


def _look(node: ast.AST, own: frozenset[str], found: list[Use]) -> None:
    if isinstance(node, ast.Import | ast.ImportFrom):
        raise Entangled("it imports while it runs")
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        if node.value.id not in own:
            found.append(Use(node, node.value.id, node.attr))
        return
    if isinstance(node, ast.Name):
        if node.id not in own:
            found.append(Use(node, node.id))
        return
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
        inner = own | own_names(node)
        body = node.body if isinstance(node.body, list) else [node.body]
        for child in ast.iter_child_nodes(node):
            _look(child, inner if child in body else own, found)
        return
    if isinstance(node, ast.ListComp | ast.SetComp | ast.GeneratorExp | ast.DictComp):
        bound = {n.id for part in node.generators for n in ast.walk(part.target) if isinstance(n, ast.Name)}
        own |= bound
    if isinstance(node, ast.ClassDef):
        body = node.body
        bound = {n.id for s in body for t in _targets(s) for n in ast.walk(t) if isinstance(n, ast.Name)}
        for child in ast.iter_child_nodes(node):
            # what a class binds, its methods do not see
            _look(child, own | bound if child in body and not isinstance(child, ast.FunctionDef) else own, found)
        return
    for child in ast.iter_child_nodes(node):
        _look(child, own, found)


def _targets(node: ast.stmt) -> list[ast.expr]:
    return node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, ast.AnnAssign) else []


def replaced(text: str, first: int, changes: list[tuple[ast.Name | ast.Attribute, str]]) -> str:
    """Lines of a module, from its line `first` on, with other names at some places."""
    lines = [line.encode() for line in text.splitlines()]
    for node, name in sorted(changes, key=lambda c: (c[0].lineno, c[0].col_offset), reverse=True):
        at, end = node.lineno - first, node.end_col_offset
        if node.end_lineno != node.lineno:
            raise Entangled("a dotted name goes over two lines")
        lines[at] = lines[at][: node.col_offset] + name.encode() + lines[at][end:]
    return "\n".join(line.decode() for line in lines)
