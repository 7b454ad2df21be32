"""Functions, as they are at run time, as text that stands by itself.

A method may be a function of a module, or one made by another with numbers and arrays bound to it. Of either this takes
the source with all that it needs; what is bound becomes constants of the text. Names that two modules share are told
apart by a number.
"""

from __future__ import annotations

import ast
import builtins
import math
import textwrap
from collections.abc import Callable, Iterable
from importlib import import_module
from types import CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

from xsec_sym.export.source import _STANDARD, ALLOWED, OURS, Entangled, joined
from xsec_sym.planner.modules import Module, Use, read, replaced

WIDTH = 120


class Bundle:
    """One text with several functions, each definition once.

    >>> from xsec_sym.kernels import sigma_ggx
    >>> bundle = Bundle()
    >>> bundle.function(sigma_ggx)
    'sigma_ggx'
    >>> "def elementwise(" in bundle.text(), bundle.imports()[-1]
    (True, 'import numpy as np')
    """

    def __init__(self, reserved: Iterable[str] = ()) -> None:
        self._used = {*reserved, "np", "math", "annotations"}
        self._named: dict[tuple[str, str], str] = {}
        self._said: dict[tuple[str, int], str] = {}
        self._modules: list[str] = []
        self._bound: dict[int, tuple[Any, str]] = {}
        self._bindings: list[str] = []
        self._imports: dict[str, str] = {}

    # --- names ---

    def fresh(self, wanted: str) -> str:
        """This name, or it with a number behind it, for use once."""
        name, number = wanted, 1
        while name in self._used or hasattr(builtins, name):
            number += 1
            name = f"{wanted}_{number}"
        self._used.add(name)
        return name

    def take(self, home: str, name: str) -> str:
        """The definition of `name` in the module `home` and all that it needs; what it is called in the text."""
        module = read(home)
        if name in module.ours:
            at, there = module.ours[name]
            return self.take(at, there) if there else self._whole(at)
        if name in module.imports:
            return self._import(module.imports[name], name)
        if name not in module.parts:
            found = getattr(import_module(home), name, None)
            origin = getattr(found, "__module__", None)
            if origin and origin != home and getattr(found, "__qualname__", "") == name:
                return self.take(origin, name)
            raise Entangled(f"{home} has no definition of {name}")
        if (home, name) in self._named:
            return self._named[home, name]
        node = module.parts[name]
        # a statement may bind several names
        for other in [n for n, part in module.parts.items() if part is node]:
            self._named[home, other] = self.fresh(other)
        if home not in self._modules:
            self._modules.append(home)
        first, last = module.segment(node)
        said = "\n".join(module.lines[first - 1 : last])
        said = replaced(said, first, self._changes(module, module.uses(node), {}))
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and self._named[home, name] != name:
            said = said.replace(f"{_word(node)} {name}", f"{_word(node)} {self._named[home, name]}", 1)
        self._said[home, node.lineno] = said
        return self._named[home, name]

    def _changes(
        self, module: Module, found: list[Use], bound: dict[str, str]
    ) -> list[tuple[ast.Name | ast.Attribute, str]]:
        """Every use with what it is called in the text."""
        changes: list[tuple[ast.Name | ast.Attribute, str]] = []
        for use in found:
            name = use.node.value if isinstance(use.node, ast.Attribute) else use.node
            assert isinstance(name, ast.Name)
            if use.base in bound:
                changes.append((name, bound[use.base]))
                continue
            home = module.ours.get(use.base)
            if home and not home[1] and use.attribute:
                changes.append((use.node, self.take(home[0], use.attribute)))
            elif use.base in module.parts or home or use.base in module.imports:
                changes.append((name, self.take(module.name, use.base)))
            elif not hasattr(builtins, use.base):
                raise Entangled(f"{module.name} does not say what {use.base} is")
        return changes

    def _whole(self, home: str) -> str:
        """A module whose parts are asked for by name while the text runs."""
        key = (home, "")
        if key not in self._named:
            names = list(read(home).parts)
            taken = [f"{name}={self.take(home, name)}" for name in names]
            self._named[key] = name = self.fresh(home.rpartition(".")[2])
            maker = self._import("from types import SimpleNamespace", "SimpleNamespace")
            listed = textwrap.fill(", ".join(taken), WIDTH - 4, initial_indent="    ", subsequent_indent="    ")
            # it stands below all parts of that module
            self._said[home, 10**9] = f"{name} = {maker}(\n{listed}\n)"
        return self._named[key]

    def _import(self, said: str, name: str) -> str:
        origin = said.split()[1]
        top = origin.partition(".")[0]
        exact = said.startswith("from scipy import special")
        if (
            top not in _STANDARD | {"types", "__future__"}
            and not exact
            and not any(origin == a or origin.startswith(a + ".") for a in ALLOWED)
        ):
            raise Entangled(f"it needs {top}")
        if name in self._imports and self._imports[name] != said:
            raise Entangled(f"{name} stands for two imports")
        self._used.add(name)
        self._imports[name] = said
        return name

    # --- functions as they are at run time ---

    def function(self, found: Any, wanted: str = "") -> str:
        """A function with what is bound to it; its name in the text. Raises `Entangled` where there is none."""
        for library, said in _libraries():
            name = getattr(found, "__name__", "")
            if isinstance(found, np.ufunc) and getattr(library, name, None) is found:
                return f"{self._import(said, said.split()[-1])}.{name}"
        if isinstance(found, type) or not isinstance(found, FunctionType):
            # what `functools.cache` makes keeps its decorator in the source; anything else compiles, or worse
            inner = getattr(found, "__wrapped__", None) if type(found).__module__ == "functools" else None
            if isinstance(inner, FunctionType) and "<locals>" not in inner.__qualname__:
                return self.take(inner.__module__, inner.__qualname__)
            raise Entangled(f"{getattr(found, '__name__', type(found).__name__)} is no function with a source")
        home = found.__module__ or ""
        if home.partition(".")[0] != OURS:
            raise Entangled(f"it needs {home.partition('.')[0]}")
        if "<" not in found.__qualname__ and "." not in found.__qualname__:
            return self.take(home, found.__qualname__)
        if id(found) in self._bound:
            return self._bound[id(found)][1]
        module = read(home)
        node, first, lines = _located(module, found.__code__)
        plain = found.__name__ if found.__name__ != "<lambda>" else ""
        name = self.fresh(wanted or plain or "function")
        self._bound[id(found)] = (found, name)
        cells = dict(zip(found.__code__.co_freevars, found.__closure__ or (), strict=True))
        bound = {
            free: self.literal(cell.cell_contents, f"{name}_{free}".lstrip("_"))
            for free, cell in cells.items()
            if cell.cell_contents is not found
        }
        bound |= {free: name for free, cell in cells.items() if cell.cell_contents is found}
        if found.__defaults__ or found.__kwdefaults__:
            raise Entangled(f"{name} has arguments with defaults")
        said = replaced("\n".join(lines), first, self._changes(module, module.uses(node), bound))
        self._bindings.append(_defined(said, node, name))
        return name

    def call(self, make: Callable[..., Any], fixed: Iterable[float], parameters: dict[str, Any], wanted: str) -> str:
        """What a function of a module returns, made once when the text is imported."""
        maker = self.function(make)
        given = [repr(v) for v in fixed] + [f"{k}={v!r}" for k, v in parameters.items()]
        name = self.fresh(wanted)
        self._bindings.append(f"{name} = {maker}({', '.join(given)})")
        return name

    def literal(self, value: Any, wanted: str) -> str:
        """An expression for a value: itself where it is short, the name of a constant where it is an array."""
        if isinstance(value, np.generic):
            value = value.item()
        if isinstance(value, float) and not math.isfinite(value):
            sign = "-" if value < 0 else ""
            return f"{sign}{self._import('import math', 'math')}.{'nan' if math.isnan(value) else 'inf'}"
        if value is None or isinstance(value, bool | int | float | str):
            return repr(value)
        if type(value) in (tuple, list):
            inner = ", ".join(self.literal(v, wanted) for v in value)
            opening, closing = ("(", ",)" if len(value) == 1 else ")") if isinstance(value, tuple) else "[]"
            return f"{opening}{inner}{closing}"
        if isinstance(value, np.ndarray):
            return self.array(value, wanted)
        kind = type(value)
        fields = getattr(kind, "_fields", None) or getattr(kind, "__dataclass_fields__", None)
        if fields and kind.__module__.partition(".")[0] == OURS and "." not in kind.__qualname__:
            inner = ", ".join(f"{n}={self.literal(getattr(value, n), f'{wanted}_{n}')}" for n in fields)
            return f"{self.take(kind.__module__, kind.__qualname__)}({inner})"
        if isinstance(value, ModuleType) or not callable(value):
            raise Entangled(f"{wanted} is a {type(value).__name__}, which cannot be written down")
        return self.function(value)

    def array(self, value: np.ndarray, wanted: str) -> str:
        """The name of a constant array."""
        if value.dtype.kind not in "bif":
            raise Entangled(f"{wanted} holds {value.dtype}")
        np_ = self._import("import numpy as np", "np")
        name = self.fresh(wanted.upper())
        kind = "" if value.dtype == np.float64 else f", dtype={value.dtype.name!r}"
        numbers = ", ".join(repr(v) for v in value.ravel().tolist()).replace("inf", f"{np_}.inf")
        shape = f".reshape{value.shape}" if value.ndim != 1 else ""
        flat = f"{name} = {np_}.array([{numbers}]{kind}){shape}"
        if len(flat) > WIDTH:
            inner = textwrap.fill(numbers, WIDTH, initial_indent="    ", subsequent_indent="    ")
            flat = f"{name} = {np_}.array([\n{inner}\n]{kind}){shape}"
        self._bindings.append(flat)
        return name

    # --- the text ---

    def imports(self) -> list[str]:
        """The import lines: the future, the standard library, the others."""
        said = {s for s in self._imports.values() if "__future__" not in s}
        standard = sorted(s for s in said if s.split()[1].partition(".")[0] in _STANDARD | {"types"})
        others = sorted((s for s in said if s not in standard), key=lambda s: (not s.startswith("import"), s))
        gap = [""] if standard and others else []
        return ["from __future__ import annotations", "", *standard, *gap, *others]

    @property
    def needs_scipy(self) -> bool:
        return any("scipy" in s for s in self._imports.values())

    def text(self) -> str:
        """The definitions, what others need first."""
        ranked: list[str] = []

        def rank(home: str, seen: tuple[str, ...] = ()) -> None:
            if home in ranked or home in seen:
                return
            for there, _ in sorted(set(read(home).ours.values())):
                rank(there, (*seen, home))
            ranked.append(home)

        for home in self._modules:
            rank(home)
        ordered = sorted(self._said.items(), key=lambda part: (ranked.index(part[0][0]), part[0][1]))
        return joined([f"{said}\n" for _, said in ordered] + [f"{said}\n" for said in self._bindings])


def _libraries() -> list[tuple[ModuleType, str]]:
    from scipy import special

    return [(np, "import numpy as np"), (special, "from scipy import special")]


def _word(node: ast.FunctionDef | ast.ClassDef) -> str:
    return "class" if isinstance(node, ast.ClassDef) else "def"


def _located(module: Module, code: CodeType) -> tuple[ast.FunctionDef | ast.Lambda, int, list[str]]:
    """Where a function of this code stands in its module."""
    found = [
        n
        for n in module.functions
        if (n.name if isinstance(n, ast.FunctionDef) else "<lambda>") == code.co_name
        and n.lineno == code.co_firstlineno
        and [a.arg for a in n.args.args] == list(code.co_varnames[: code.co_argcount])
    ]
    if len(found) > 1:
        # of two on one line, the one whose body the code is of
        columns = {p[2] for p in code.co_positions() if p[2] is not None and p[0] == code.co_firstlineno and p[1] != 0}
        found = [n for n in found if isinstance(n, ast.Lambda) and n.body.col_offset in columns]
    if len(found) != 1:
        raise Entangled(f"the source of {code.co_name} in {module.name} is not found, or decorated")
    node = found[0]
    return node, node.lineno, module.lines[node.lineno - 1 : node.end_lineno]


def _defined(said: str, node: ast.FunctionDef | ast.Lambda, name: str) -> str:
    """The definition by its name, at the left margin. The text is the source, changed behind the place of the node."""
    if isinstance(node, ast.FunctionDef):
        return textwrap.dedent(said).replace(f"def {node.name}", f"def {name}", 1)
    # what follows a lambda on its line is found by where it still parses
    rest = said.encode()[node.col_offset :].decode()
    for end in range(len(rest), 0, -1):
        try:
            parsed = ast.parse(f"({rest[:end]})", mode="eval").body
        except SyntaxError:
            continue
        if isinstance(parsed, ast.Lambda):
            return f"def {name}({ast.unparse(parsed.args)}):\n    return {ast.unparse(parsed.body)}"
    raise Entangled(f"{name} is a lambda that cannot be told apart")
