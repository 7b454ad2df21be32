"""Rewrites of an expression into equal ones that round better, each shown equal before it is used."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import combinations

from sympy import (
    Add,
    Expr,
    Mul,
    Pow,
    Rational,
    S,
    collect,
    cos,
    exp,
    expand,
    factor,
    fraction,
    horner,
    log,
    preorder_traversal,
    sin,
    sqrt,
    together,
)
from sympy.codegen.cfunctions import expm1, log1p

from xsec_sym.export import special
from xsec_sym.proof.piece import Piece

Rule = Callable[[Expr, Piece], Iterator[Expr]]
HALF = Rational(1, 2)
# Pairs of terms are tried one by one; in a longer sum they would be too many to try.
MOST_TERMS = 6


class NotShown(ValueError):
    """Two expressions could not be shown equal, so one must not stand for the other."""


def plain(e: Expr) -> Expr:
    """The same with log1p, expm1 and scaled functions written out, in which the proof engine knows its way."""
    return special.plain(e).replace(log1p, lambda x: log(1 + x)).replace(expm1, lambda x: exp(x) - 1)


def checked(old: Expr, new: Expr, piece: Piece) -> Expr:
    """``new``, once it is shown equal to ``old`` everywhere on the piece.

    >>> from sympy import Symbol
    >>> from xsec_sym.proof.domain import domain, interval
    >>> u = Symbol("u", real=True)
    >>> here = Piece.of(domain([interval(u, 0, 1, open="left")]))
    >>> checked(log(1 + 1 / u), log1p(u) - log(u), here)
    -log(u) + log1p(u)
    >>> checked(log(1 + 1 / u), log1p(u) + log(u), here)
    Traceback (most recent call last):
    ...
    xsec_sym.export.rules.NotShown: log(1 + 1/u) was not shown equal to log(u) + log1p(u)
    """
    if old != new and not piece.is_zero(plain(old) - plain(new)):
        raise NotShown(f"{old} was not shown equal to {new}")
    return new


def rewritten(e: Expr, piece: Piece) -> Iterator[tuple[Expr, Expr, Expr]]:
    """Every expression that one rule makes of one part of ``e``, with the part and its replacement, not yet checked."""
    seen = {e}
    for part in dict.fromkeys(preorder_traversal(e)):
        if isinstance(part, Expr) and part.args:
            for rule in RULES:
                for new in rule(part, piece):
                    whole = e.xreplace({part: new})
                    if whole not in seen:
                        seen.add(whole)
                        yield whole, part, new


def _pairs(e: Expr) -> Iterator[tuple[Expr, Expr, Expr]]:
    """Two terms of a sum, and the rest."""
    if e.is_Add and len(e.args) <= MOST_TERMS:
        for a, b in combinations(e.args, 2):
            yield a, b, e - a - b


def _ln(e: Expr) -> Expr:
    if e.is_Add and S.One in e.args:
        return log1p(e - 1)
    return log(e)


def log_of_a_sum(e: Expr, piece: Piece) -> Iterator[Expr]:
    """log(1 + x) = log1p(x)."""
    if isinstance(e, log) and e.args[0].is_Add:
        yield log1p(e.args[0] - 1)


def log_near_one(e: Expr, piece: Piece) -> Iterator[Expr]:
    """log(n/d) = log1p((n - d)/d), and so for log1p."""
    if isinstance(e, log | log1p):
        n, d = fraction(together(e.args[0] if isinstance(e, log) else 1 + e.args[0]))
        if d != 1:
            yield log1p(expand(n - d) / d)


def log_of_a_quotient(e: Expr, piece: Piece) -> Iterator[Expr]:
    """log(n/d) = log n - log d, factor by factor where all are positive."""
    if isinstance(e, log | log1p):
        n, d = fraction(together(e.args[0] if isinstance(e, log) else 1 + e.args[0]))
        if piece.sign(d) == "-":
            n, d = expand(-n), expand(-d)
        above, below = Mul.make_args(n), Mul.make_args(d)
        if len(above) + len(below) > 2 or d != 1:
            yield Add(*(_ln(f) for f in above if f != 1)) - Add(*(_ln(f) for f in below if f != 1))


def exp_less_one(e: Expr, piece: Piece) -> Iterator[Expr]:
    """c exp x - c = c expm1(x)."""
    for a, b, rest in _pairs(e):
        for grown, base in ((a, b), (b, a)):
            ratio = -grown / base
            if isinstance(ratio, exp):
                yield rest - base * expm1(ratio.args[0])


def one_less_cosine(e: Expr, piece: Piece) -> Iterator[Expr]:
    """c - c cos x = 2 c sin(x/2)^2."""
    for a, b, rest in _pairs(e):
        for turned, base in ((a, b), (b, a)):
            ratio = -turned / base
            if isinstance(ratio, cos):
                yield rest + 2 * base * sin(ratio.args[0] / 2) ** 2


def _has_root(e: Expr) -> bool:
    return any(isinstance(p, Pow) and p.exp == HALF for p in preorder_traversal(e))


def conjugate(e: Expr, piece: Piece) -> Iterator[Expr]:
    """a - b = (a^2 - b^2)/(a + b), where a root cancels."""
    for a, b, rest in _pairs(e):
        if _has_root(a) or _has_root(b):
            above, below = factor(expand(a**2 - b**2)), a - b
            yield rest + (-above / -below if below.could_extract_minus_sign() else above / below)


def factored(e: Expr, piece: Piece) -> Iterator[Expr]:
    """1 - u^2 = (1 - u)(1 + u), and common factors, in a sum or in two of its terms."""
    if e.is_Add:
        whole = factor(e)
        if whole.is_Mul:
            yield whole
        if len(e.args) > 2:
            for a, b, rest in _pairs(e):
                part = factor(a + b)
                if part.is_Mul:
                    yield rest + part


def one_denominator(e: Expr, piece: Piece) -> Iterator[Expr]:
    """1/a - 2 = (1 - 2 a)/a."""
    for a, b, rest in _pairs(e):
        n, d = fraction(together(a + b))
        if d != 1:
            yield rest + n / d


def collected(e: Expr, piece: Piece) -> Iterator[Expr]:
    """Terms with the same power of a variable together."""
    if e.is_Add:
        for symbol in sorted(e.free_symbols, key=str):
            new = collect(e, symbol)
            if new != e:
                yield new


def nested(e: Expr, piece: Piece) -> Iterator[Expr]:
    """Horner's form of a polynomial."""
    if e.is_Add and len(e.free_symbols) == 1 and e.is_polynomial():
        yield horner(e)


def roots(e: Expr, piece: Piece) -> Iterator[Expr]:
    """sqrt(a) sqrt(b) = sqrt(a b), and a radicand in factors."""
    if e.is_Mul:
        under = [f.base for f in e.args if isinstance(f, Pow) and f.exp == HALF]
        if len(under) > 1:
            yield e / Mul(*map(sqrt, under)) * sqrt(Mul(*under))
    elif isinstance(e, Pow) and e.exp == HALF and e.base.is_Add:
        new = factor(e.base)
        if new.is_Mul:
            yield Pow(new, HALF, evaluate=False)


RULES: tuple[Rule, ...] = (
    log_of_a_sum,
    log_near_one,
    log_of_a_quotient,
    exp_less_one,
    one_less_cosine,
    conjugate,
    factored,
    one_denominator,
    collected,
    nested,
    roots,
)
