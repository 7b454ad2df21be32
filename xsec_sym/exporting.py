"""The list that `xsec export` gives: what there is, and what of it needs SciPy."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from xsec_sym.complete import code

# Functions that NumPy lacks; what takes one of them may still be written without SciPy.
SPECIAL = ("erf", "erfc", "besseli", "besselj", "gamma", "loggamma", "Ei", "expint", "polylog")


def listing(found: Mapping[str, str], record: Mapping[str, Any]) -> list[str]:
    """A line on each name, grouped by what it is; the lines that are no name begin with #.

    found: the names with a line on each, as `xsec_sym.export.available` gives them.
    """
    from xsec_sym.record.sources import SOURCES

    groups: dict[str, list[str]] = {}
    for name in found:
        groups.setdefault(record[name].source if name in record else "", []).append(name)
    wide = max(map(len, found), default=0)
    lines = []
    for key, names in groups.items():
        known = SOURCES.get(key)
        title = f"{key}: {known.about or known.title}" if known else key
        lines.append(f"# {title}" if key else "# functions that several verified equations make up")
        lines += [f"{name:{wide}}  {found[name]}{_scipy(name, record)}" for name in names]
    return [
        *lines,
        "# [scipy]: the module imports scipy.special as well; [scipy?]: it may",
        "# kernels made by hand, such as sigma_spherical_gaussian, are imported: from xsec_sym import kernels",
    ]


def _scipy(name: str, record: Mapping[str, Any]) -> str:
    if name not in record:
        return ""
    # what was written once is known; for what was not, there is the form
    text = code().get(name, {}).get("text")
    if text is not None:
        return "  [scipy]" if "scipy." in text or "i2e(" in text else ""
    entry = record[name]
    parts = [record[p] for p in entry.parts if p in record] or [entry]
    return "  [scipy?]" if any(_special(part) for part in parts) else ""


def _special(entry: Any) -> bool:
    from sympy import Function

    try:
        return any(type(f).__name__ in SPECIAL for f in entry.form.atoms(Function))
    except ValueError:
        return False
