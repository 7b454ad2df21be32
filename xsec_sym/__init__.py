"""A paper's equations go in; verdicts, proofs, and the fastest verified code for a scene come out.

>>> import xsec_sym
>>> sorted(set(dir(xsec_sym)) & {"check", "cross_section", "kernels", "ledger", "plan"})
['check', 'cross_section', 'kernels', 'ledger', 'plan']
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from xsec_sym import kernels
    from xsec_sym.kernels.ring_lemma import cross_section
    from xsec_sym.planner import plan
    from xsec_sym.proof.limits import check
    from xsec_sym.record import ledger

__version__ = "0.1.0"
__all__ = ["check", "cross_section", "kernels", "ledger", "plan"]

# Nothing is imported before it is asked for: the kernels do without SymPy, and a glance at the record without either.
_HOME = {
    "check": "xsec_sym.proof.limits",
    "cross_section": "xsec_sym.kernels.ring_lemma",
    "kernels": "",
    "ledger": "xsec_sym.record.store",
    "plan": "xsec_sym.planner",
}


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    found = getattr(import_module(_HOME[name]), name) if _HOME[name] else import_module(f"{__name__}.{name}")
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
