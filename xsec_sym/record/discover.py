"""Find the claims: import every derivation, the project's own and a folder of the user's."""

from __future__ import annotations

import hashlib
import importlib
import pkgutil
import sys
import traceback
from importlib.machinery import ModuleSpec
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

from xsec_sym.proof.claim import REGISTRY, Claim

OWN = "derivations"
PREFIX = "xsec_user_"


class BrokenDerivation(Exception):
    """A derivation cannot be imported, or a folder holds none."""


def discover(folder: str | Path | None = None) -> dict[str, Claim]:
    """Every claim by id, in the order of the sources; ``folder`` holds modules of the user's own.

    Modules in the folder import each other relatively (``from . import other``). Raises `BrokenDerivation`.
    """
    _walk(_import(OWN, None))
    roots = {OWN}
    if folder is not None:
        roots.add(_user(Path(folder)))
    return {name: claim for name, claim in REGISTRY.items() if claim.module.partition(".")[0] in roots}


def _user(folder: Path) -> str:
    if not folder.is_dir():
        raise BrokenDerivation(f"{folder} is not a folder of derivations")
    folder = folder.resolve()
    name = PREFIX + hashlib.sha256(str(folder).encode()).hexdigest()[:12]
    # an earlier folder of this process would claim the same ids again
    for old in [m for m in sys.modules if m.startswith(PREFIX)]:
        del sys.modules[old]
    for stale in [key for key, claim in REGISTRY.items() if claim.module.startswith(PREFIX)]:
        del REGISTRY[stale]
    init = folder / "__init__.py"
    if init.exists():
        spec = spec_from_file_location(name, init, submodule_search_locations=[str(folder)])
    else:
        spec = ModuleSpec(name, None, is_package=True)
        spec.submodule_search_locations = [str(folder)]
    assert spec is not None
    package = sys.modules[name] = module_from_spec(spec)
    if spec.loader is not None:
        _guarded(lambda: spec.loader.exec_module(package), str(init), folder)
    importlib.invalidate_caches()
    _walk(package, folder)
    if not any(claim.module.partition(".")[0] == name for claim in REGISTRY.values()):
        raise BrokenDerivation(f"{folder} holds no module that makes a claim")
    return name


def _walk(package: ModuleType, folder: Path | None = None) -> None:
    for found in pkgutil.iter_modules(package.__path__, package.__name__ + "."):
        if found.name.rpartition(".")[2] == "__main__":
            continue
        module = _import(found.name, folder)
        if found.ispkg:
            _walk(module, folder)


def _import(name: str, folder: Path | None) -> ModuleType:
    shown = name
    if folder is not None:
        shown = str(folder.joinpath(*name.split(".")[1:]))
    _guarded(lambda: importlib.import_module(name), shown, folder)
    return sys.modules[name]


def _guarded(act, shown: str, folder: Path | None) -> None:  # type: ignore[no-untyped-def]
    try:
        act()
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        # a derivation may do anything on import, even leave by sys.exit
        line = _line(error, folder)
        raise BrokenDerivation(f"{shown} cannot be imported: {type(error).__name__}: {error}{line}") from error


def _line(error: BaseException, folder: Path | None) -> str:
    if isinstance(error, SyntaxError):
        return f" in {error.filename}"
    root = str(folder) if folder is not None else f"{OWN}/"
    frames = [f for f in traceback.extract_tb(error.__traceback__) if root in f.filename]
    return f" ({frames[-1].filename}, line {frames[-1].lineno})" if frames else ""
