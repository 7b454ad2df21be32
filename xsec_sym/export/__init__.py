"""Verified expressions as NumPy source: rewritten so that they round well, one branch at a time."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from xsec_sym.export.assemble import available, module
    from xsec_sym.export.kernel import Refusal
    from xsec_sym.export.rules import NotShown

__all__ = ["NotShown", "Refusal", "available", "module"]

# Not before it is asked for: the names of the recipes, which a shell completes, need no SymPy.
_HOME = {"NotShown": "rules", "Refusal": "kernel", "available": "assemble", "module": "assemble"}


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
