"""Questions about the shape of an expression that its normal form asks: they need no facts."""

from __future__ import annotations

from sympy import (
    Abs,
    Add,
    Expr,
    Heaviside,
    Integral,
    Mul,
    Poly,
    Pow,
    Rational,
    S,
    Sum,
    Symbol,
    acos,
    atan,
    cos,
    preorder_traversal,
    sin,
)
from sympy.core.function import AppliedUndef

from xsec_sym.proof.atoms import Unsettled


def hidden_name(letter: str, e: Expr) -> str:
    """A name for a bound variable that no bound variable inside has, and that nobody types."""
    depth = sum(1 for node in preorder_traversal(e) if isinstance(node, Integral | Sum))
    return f"{letter}#{depth}"


def bounded(atom: Expr) -> bool:
    """Atoms that stay bounded, or are integrable by hypothesis, between finite limits."""
    if isinstance(atom, Pow):
        return bool(atom.exp.is_nonnegative) and bounded(atom.base)
    if isinstance(atom, Add | Mul):
        return all(bounded(a) for a in atom.args)
    if isinstance(atom, Abs):
        return bounded(atom.args[0])
    tame = Symbol, cos, sin, acos, atan, Heaviside, AppliedUndef
    return atom.is_number or isinstance(atom, tame) or hasattr(atom, "definition")


def paired(factors: list[tuple[Poly, int]]) -> list[tuple[Poly, int]]:
    """Factors f(x) and f(-x) of one multiplicity brought together: 1 - x^2 rather than 1 - x and 1 + x."""
    left, found = list(factors), []
    while left:
        f, k = left.pop(0)
        mirror = Poly(f.as_expr().subs({g: -g for g in f.free_symbols}, simultaneous=True), *f.gens, domain="QQ")
        for other, j in left:
            if j == k and (other == mirror or other == -mirror):
                left.remove((other, j))
                f = f * other
                break
        found.append((f, k))
    return found


def split_exponent(e: Expr) -> tuple[Rational, dict[Symbol, int]]:
    """An exponent as rational + sum of integer multiples of integer symbols."""
    e = e.expand()
    fixed, moving = S.Zero, {}
    for term in Add.make_args(e):
        if term.is_Rational:
            fixed += term
            continue
        coefficient, rest = term.as_coeff_Mul()
        if not (rest.is_Symbol and rest.is_integer and coefficient.is_Integer):
            raise Unsettled(f"{e} is not an integer combination of integer symbols")
        moving[rest] = int(coefficient)
    return fixed, moving
