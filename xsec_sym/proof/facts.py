"""Facts as polynomials in atoms, and the sign of a polynomial as far as they tell it."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations
from typing import TYPE_CHECKING, Any

from sympy import Add, Expr, Mul, Poly, Rational, Symbol

from xsec_sym.proof.signs import FLIP, Sign, plus, times

if TYPE_CHECKING:
    from xsec_sym.proof.field import Field

Terms = dict[tuple[tuple[Symbol, int], ...], Fraction]  # monomial -> coefficient, a monomial as (atom, power) pairs
Fact = tuple[Expr, bool]


def terms_of(polynomial: Poly) -> Terms:
    found: Terms = {}
    for powers, coefficient in polynomial.terms():
        if coefficient:
            monomial = tuple((g, k) for g, k in zip(polynomial.gens, powers, strict=True) if k)
            found[monomial] = Fraction(int(coefficient.p), int(coefficient.q))
    return found


def expression_of(terms: Terms) -> Expr:
    return Add(*(Rational(c.numerator, c.denominator) * Mul(*(g**k for g, k in m)) for m, c in terms.items()))


def product_of(a: Terms, b: Terms) -> Terms:
    found: Terms = {}
    for m, c in a.items():
        for n, d in b.items():
            powers = dict(m)
            for atom, k in n:
                powers[atom] = powers.get(atom, 0) + k
            monomial = tuple(sorted(powers.items(), key=lambda pair: str(pair[0])))
            found[monomial] = found.get(monomial, Fraction(0)) + c * d
    return {m: c for m, c in found.items() if c}


class Facts:
    """What is known to be > 0 (strict) or >= 0: ``known`` has each as its terms in the atoms of ``field``."""

    field: Field
    known: list[tuple[Terms, bool]]
    _polynomial_signs: dict[frozenset[Any], Sign]
    _products: list[tuple[Terms, bool]] | None

    def sign_of_factors(self, polynomial: Poly) -> Sign:
        whole = self.sign_of_polynomial(polynomial)
        if whole in ("+", "-"):
            return whole
        constant, factors = polynomial.factor_list()
        result: Sign = "+" if constant > 0 else "-"
        for factor, multiplicity in factors:
            here = self.sign_of_polynomial(factor)
            if multiplicity % 2 == 0:
                here = "+" if here in ("+", "-") else "0" if here == "0" else ">="
            result = times(result, here)
        return result or whole

    def sign_of_polynomial(self, f: Poly) -> Sign:
        """The sign of a polynomial in atoms, from its terms or from the facts."""
        terms = terms_of(f)
        key = frozenset(terms.items())
        if key not in self._polynomial_signs:
            self._polynomial_signs[key] = self._sign_of_terms(f, terms)
        return self._polynomial_signs[key]

    def _sign_of_terms(self, f: Poly, terms: Terms) -> Sign:
        weak: Sign = None
        for answer in (
            lambda: self._sign_by_terms(terms),
            lambda: self._sign_by_fact(terms),
            lambda: self._sign_by_roots(f),
            lambda: self._sign_above(terms),
            lambda: FLIP[self._sign_above({m: -c for m, c in terms.items()})],
        ):
            here = answer()
            if here in ("+", "-", "0"):
                return here
            weak = weak or here
        return weak

    def _sign_by_terms(self, terms: Terms) -> Sign:
        total: Sign = "0"
        for monomial, coefficient in terms.items():
            term: Sign = "+" if coefficient > 0 else "-"
            for atom, power in monomial:
                here = self.field.sign_of_atom(atom)
                if power % 2 == 0:
                    here = "+" if here in ("+", "-") else "0" if here == "0" else ">="
                term = times(term, here)
            total = plus(total, term)
            if total is None:
                return None
        return total

    def _sign_by_fact(self, terms: Terms) -> Sign:
        weak: Sign = None
        for g, strict in self.known:
            if g.keys() == terms.keys():
                first = next(iter(g))
                ratio = terms[first] / g[first]
                if all(terms[m] == ratio * c for m, c in g.items()):
                    if strict:
                        return "+" if ratio > 0 else "-"
                    weak = ">=" if ratio > 0 else "<="
        return weak

    def _sign_by_roots(self, f: Poly) -> Sign:
        """One variable between rational bounds: count the real roots exactly."""
        atoms = f.free_symbols
        if len(atoms) != 1:
            return None
        (x,) = atoms
        low, low_open, high, high_open = self.bounds_of(x)
        if low is None and high is None:
            return None
        g = Poly(f.as_expr(), x)
        at_ends = [(end, is_open) for end, is_open in ((low, low_open), (high, high_open)) if end is not None]
        zeros = [is_open for end, is_open in at_ends if g.eval(end) == 0]
        if g.count_roots(low, high) > len(zeros):
            return None
        finite = low is not None and high is not None
        middle = (low + high) / 2 if finite else low + 1 if low is not None else high - 1
        positive = g.eval(middle) > 0
        if all(zeros):
            return "+" if positive else "-"
        return ">=" if positive else "<="

    def bounds_of(self, x: Symbol) -> tuple[Any, bool, Any, bool]:
        """The tightest rational bounds that the facts give a symbol: low, excluded?, high, excluded?"""
        low = high = None
        low_open = high_open = True
        one = ((x, 1),)
        for g, strict in self.known:
            if one in g and all(m in (one, ()) for m in g):
                root = -g.get((), Fraction(0)) / g[one]
                end = Rational(root.numerator, root.denominator)
                if g[one] > 0 and (low is None or end > low or (end == low and strict)):
                    low, low_open = end, strict
                elif g[one] < 0 and (high is None or end < high or (end == high and strict)):
                    high, high_open = end, strict
        return low, low_open, high, high_open

    def _sign_above(self, f: Terms, depth: int = 2) -> Sign:
        """f = c g + (something not negative), with g a fact or a product of two facts and c > 0."""
        weak: Sign = None
        for g, strict in [*self.known, *self.field.bounds_of_atoms(), *(self._fact_products() if depth == 2 else [])]:
            for c in {f[m] / k for m, k in g.items() if m in f and (f[m] > 0) == (k > 0)}:
                rest = dict(f)
                for m, k in g.items():
                    left = rest.pop(m, Fraction(0)) - c * k
                    if left:
                        rest[m] = left
                sign = self._sign_by_terms(rest) if rest else "0"
                if sign is None and depth == 2 and len(rest) < len(f) + len(g):
                    sign = self._sign_above(rest, depth=1)
                if sign == "+" or (strict and sign in ("0", ">=")):
                    return "+"
                if sign in ("0", ">="):
                    weak = ">="
        return weak

    def _fact_products(self) -> list[tuple[Terms, bool]]:
        if self._products is None:
            self._products = []
            for (a, strict_a), (b, strict_b) in combinations(self.known, 2):
                product = product_of(a, b)
                if self.field.reducible(product):
                    product = terms_of(self.field.reduced(expression_of(product)))
                if product:
                    self._products.append((product, strict_a and strict_b))
        return self._products
