"""When may a recorded proof be replayed? As long as nothing has changed that its verdict rests on."""

from __future__ import annotations

import ast
import hashlib
import json
from collections.abc import Mapping
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from xsec_sym.proof.claim import Claim

ENGINE = ("proof", "exact")


class Keys:
    """The key of every claim: a digest of the claim, of its derivation, of the engine and of the tools' versions.

    A proof that leans on other claims has a key that changes with those as well.
    """

    def __init__(self, claims: Mapping[str, Claim]) -> None:
        self.claims = claims
        self._modules: dict[str, str] = {}
        self._texts: dict[str, tuple[str | None, list[str]]] = {}

    def of(self, name: str, certificate: Mapping[str, Any] | None = None) -> str:
        from xsec_sym.proof.checker import lemmas

        claim = self.claims[name]
        leans = sorted(lemmas(certificate["moves"])) if certificate else []
        parts = [engine(), self._module(claim.module), statement(claim)]
        parts += [statement(self.claims[other]) if other in self.claims else f"no {other}" for other in leans]
        return hashlib.sha256("\0".join(parts).encode()).hexdigest()

    def _module(self, name: str) -> str:
        if name not in self._modules:
            digest = hashlib.sha256()
            for module in sorted(self.family(name)):
                digest.update(f"{module}\0{self._read(module)[0]}\0".encode())
            self._modules[name] = digest.hexdigest()
        return self._modules[name]

    def family(self, name: str) -> set[str]:
        """A derivation module and all derivations that it imports, directly or not, with the packages around them."""
        roots = {name.partition(".")[0], "derivations"}
        found: set[str] = set()
        waiting = [name]
        while waiting:
            module = waiting.pop()
            if module in found or module.partition(".")[0] not in roots:
                continue
            text, imports = self._read(module)
            if text is not None:
                found.add(module)
                waiting += [module.rpartition(".")[0], *imports]
        return found

    def _read(self, module: str) -> tuple[str | None, list[str]]:
        if module not in self._texts:
            origin = _origin(module)
            text = Path(origin).read_text(encoding="utf-8") if origin and origin.endswith(".py") else None
            is_package = bool(origin) and Path(str(origin)).name == "__init__.py"
            self._texts[module] = text, [] if text is None else _imports(module, is_package, text)
        return self._texts[module]


def statement(claim: Claim) -> str:
    """All that the claim says, as text."""
    from xsec_sym.record.entry import encoded

    sides = [encoded(e) or repr(e) for e in (claim.left, claim.printed, claim.corrected)]
    stated = repr(claim.accuracy or claim.measure or "") if claim.accuracy or claim.measure else ""
    return json.dumps([claim.id, claim.kind, sides, claim.domain.text(), list(claim.parts), *([stated] * bool(stated))])


@cache
def engine() -> str:
    """The digest of everything that proves and defines, and of the libraries that it uses."""
    import flint
    import mpmath
    import numpy
    import scipy
    import sympy

    digest = hashlib.sha256()
    for library in (sympy, mpmath, flint, numpy, scipy):
        digest.update(f"{library.__name__} {library.__version__}\n".encode())
    root = Path(__file__).parent.parent
    for path in sorted(p for folder in ENGINE for p in (root / folder).rglob("*.py")):
        digest.update(f"{path.relative_to(root).as_posix()}\0{path.read_text(encoding='utf-8')}\0".encode())
    return digest.hexdigest()


def _imports(module: str, is_package: bool, text: str) -> list[str]:
    found = []
    package = module if is_package else module.rpartition(".")[0]
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            found += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                above = package.split(".")[: len(package.split(".")) - node.level + 1]
                base = ".".join([*above, *([base] if base else [])])
            # the name may be a module or something in one: what is no module has no source, and drops out
            found += [base, *(f"{base}.{alias.name}" for alias in node.names)]
    return found


def _origin(module: str) -> str | None:
    if not module:
        return None
    try:
        spec = find_spec(module)
    except (ImportError, ValueError, AttributeError):
        return None
    return spec.origin if spec else None
