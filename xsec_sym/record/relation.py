"""How the two sides of an entry stand to each other: equal, near, or the one at least as large as the other."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sympy import Expr

    from xsec_sym.record.entry import Entry

EQUAL, NEAR, LEAST = "=", "≈", "≥"
LATEX = {EQUAL: "=", NEAR: r"\approx", LEAST: r"\geq"}
# Claims that are judged by their error.
JUDGED = ("approximation", "accuracy")


def sign(entry: Entry) -> str:
    r"""What belongs between the sides: `EQUAL`, `NEAR` or `LEAST`.

    >>> from xsec_sym.record.store import Ledger
    >>> [sign(Ledger()[name]) for name in ("deon2016:18", "deon2021:28", "xsec:bessel-order")]
    ['=', '≈', '≥']
    """
    if entry.kind in JUDGED:
        return NEAR
    right = _right(entry, _stated(entry))
    # a claim that the magnitude of X is X says that X is not negative
    return LEAST if right is not None and entry.left == rf"\left|{{{right}}}\right|" else EQUAL


def sides(entry: Entry, name: str) -> tuple[Expr | None, Expr | None]:
    """Both sides as expressions; of an inequality what is on the larger side and what is on the smaller."""
    left, right = entry.side("left"), entry.side(name)
    if sign(entry) != LEAST or right is None:
        return left, right
    from sympy import Add, Integer

    terms = Add.make_args(right)
    lesser = [-term for term in terms if term.could_extract_minus_sign()]
    if not lesser or len(lesser) == len(terms):
        return right, Integer(0)
    return Add(*(term for term in terms if not term.could_extract_minus_sign())), Add(*lesser)


def parts(entry: Entry, name: str) -> tuple[str, str | None]:
    """Both sides as LaTeX; the second is None where there is none."""
    right = _right(entry, name)
    if right is None or sign(entry) != LEAST:
        return entry.left, right
    from xsec_sym.proof.typeset import latex

    with contextlib.suppress(ValueError, KeyError, TypeError):
        greater, lesser = sides(entry, name)
        if greater is not None:
            return latex(greater), latex(lesser)
    return right, "0"


def nearness(entry: Entry, name: str) -> str:
    """How near a side is, in words, or how near it is said to be; nothing where the sides are equal.

    >>> from xsec_sym.record.store import Ledger
    >>> nearness(Ledger()["deon2021:37"], "printed")
    'within 1 % of the left side; the largest error found is 0.808 %'
    """
    if entry.kind not in JUDGED:
        return ""
    told = entry.evidence
    relative = told.get("relative") is True
    stated = _size(told.get("within"), relative)
    print_fails = name == "printed" and entry.verdict == "misprint"
    holds = entry.verdict in ("claim-holds", "misprint") and not print_fails
    words = []
    if stated:
        words.append(f"{'within' if holds else 'said to be within'} {stated}{' of the left side' * relative}")
    if print_fails:
        if error := _size(told.get("error of the print"), relative):
            words.append(f"off by up to {error}")
    elif error := _size(told.get("largest error"), relative):
        words.append(f"the largest error is {error}")
    elif error := _size(told.get("largest error found"), relative):
        words.append(f"the largest error found is {error}")
    if not stated and "within" in told:
        words.append("no accuracy is stated")
    return "; ".join(words)


def _stated(entry: Entry) -> str:
    return "printed" if entry.corrected is None else "corrected"


def _right(entry: Entry, name: str) -> str | None:
    found: str | None = getattr(entry, name)
    return found


def _size(value: Any, relative: bool) -> str:
    """A number of the evidence, relative ones as a share of a hundred; nothing for what is said in words."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        return ""
    return f"{100 * number:.3g} %" if relative else f"{number:.3g}"
