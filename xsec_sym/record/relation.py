"""What stands on the two sides of an entry's sign, and how near they are, in words."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sympy import Expr

    from xsec_sym.record.entry import Entry


def sides(entry: Entry, side: str) -> tuple[Expr | None, Expr | None]:
    """Both sides as expressions; of an inequality the larger one, and what of it is known to be at most as large.

    >>> from xsec_sym.record.store import Ledger
    >>> sides(Ledger()["xsec:bessel-order"], "corrected")
    (besseli(j, z), besseli(j + 1, z))
    """
    left, right = entry.side("left"), entry.side(side)
    if entry.relation(side) != "≥" or right is None:
        return left, right
    from sympy import Add, Integer

    # it is kept as X >= 0: what X takes away goes to the other side
    terms = Add.make_args(right)
    lesser = [-term for term in terms if term.could_extract_minus_sign()]
    if not lesser or len(lesser) == len(terms):
        return right, Integer(0)
    return Add(*(term for term in terms if not term.could_extract_minus_sign())), Add(*lesser)


def parts(entry: Entry, side: str) -> tuple[str, str | None]:
    """Both sides as LaTeX; the second is None where there is none."""
    right: str | None = getattr(entry, side)
    if right is None or entry.relation(side) != "≥":
        return entry.left, right
    from xsec_sym.proof.typeset import latex

    with contextlib.suppress(ValueError, KeyError, TypeError):
        greater, lesser = sides(entry, side)
        if greater is not None:
            return latex(greater), latex(lesser)
    return right, "0"


def nearness(entry: Entry) -> str:
    """How near the sides are, and whether that was stated; empty for what is no approximation.

    >>> from xsec_sym.record.store import Ledger
    >>> nearness(Ledger()["deon2021:37"])
    'within 1 % of the left side; the largest error found is 0.808 %'
    >>> nearness(Ledger()["deon2016:claim.44-accuracy"])
    'said to be within 0.001; the largest error is 0.00103'
    """
    if entry.relation() != "≈":
        return ""
    told, relative = entry.evidence, entry.evidence.get("relative") is True
    words = []
    if stated := _size(told.get("within"), relative):
        holds = entry.verdict in ("claim-holds", "misprint")
        words.append(f"{'within' if holds else 'said to be within'} {stated}{' of the left side' * relative}")
    elif "within" in told:
        words.append("no accuracy is stated")
    for name in ("largest error", "largest error found", "error of the print"):
        if error := _size(told.get(name), relative):
            words.append(f"the {name} is {error}")
    return "; ".join(words)


def _size(value: Any, relative: bool) -> str:
    """A number of the evidence, a relative one in percent; nothing for what is said in words."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        return ""
    return f"{100 * number:.3g} %" if relative else f"{number:.3g}"
