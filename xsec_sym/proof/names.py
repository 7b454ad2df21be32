"""Names in a proof: which are bound, which are plain variables, and what a name may be replaced by."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from sympy import Expr, Symbol, oo, sympify
from sympy.concrete.expr_with_limits import ExprWithLimits

if TYPE_CHECKING:
    from xsec_sym.proof.piece import Piece

REAL = Symbol("_", real=True).assumptions0
NATURAL = Symbol("_", integer=True, nonnegative=True).assumptions0
COUNTED = Symbol("_", integer=True, positive=True).assumptions0
KINDS = ("integer", "rational", "irrational", "noninteger", "even", "odd", "prime", "composite")
SIGNS = {
    "positive": ("+",),
    "negative": ("-",),
    "nonnegative": ("+", ">=", "0"),
    "nonpositive": ("-", "<=", "0"),
    "zero": ("0",),
    "nonzero": ("+", "-"),
}


def plain(*symbols: Any) -> bool:
    """Real variables of which SymPy assumes nothing else: not a sign, which it would use when it simplifies."""
    return all(isinstance(s, Symbol) and s.assumptions0 == REAL for s in symbols)


def natural(index: Any, low: Any = 0) -> bool:
    """An index that runs over low, low + 1, ... as far as SymPy knows; one that it takes for positive starts at 1."""
    known = index.assumptions0 if isinstance(index, Symbol) else None
    low = sympify(low)
    return bool((known == NATURAL and low.is_nonnegative) or (known == COUNTED and (low - 1).is_nonnegative))


def bound_in(*expressions: Any) -> set[Symbol]:
    """The variables of the integrals and sums in an expression."""
    return {limit[0] for e in expressions for node in e.atoms(ExprWithLimits) for limit in node.limits}


def captured(whole: Iterable[Any], *replacements: Any) -> set[Symbol]:
    """What a replacement brings in that an integral or a sum in the whole would bind."""
    return bound_in(*whole) & {s for e in replacements for s in e.free_symbols}


def keeps_to(symbol: Symbol, value: Expr, piece: Piece) -> bool:
    """Whether a value is shown to be one that the symbol may stand for: real, whole, of a sign."""
    if value == symbol:
        return True
    known = symbol.assumptions0
    if any(bool(getattr(value, f"is_{kind}")) is not known[kind] for kind in KINDS if known.get(kind)):
        return False
    piece.field.fraction(value)  # has it none, it is not known to be real
    here = piece.sign(value)
    return not value.has(oo, -oo) and all(here in SIGNS[kind] for kind in SIGNS if known.get(kind))


__all__ = ["bound_in", "captured", "keeps_to", "natural", "plain"]
