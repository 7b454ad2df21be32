"""Expressions in sentences. SymPy's own printer evaluates a sum, integrals included, to order it; this one does not."""

from __future__ import annotations

from typing import Any

from sympy import sstr

MOST = 240


def said(e: Any) -> str:
    text = sstr(e, order="none")
    return text if len(text) <= MOST else text[: MOST - 3] + "..."
