"""Atoms, and the arithmetic of polynomials in them: the ground on which the normal form of `field.py` stands."""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from sympy import (
    Abs,
    Expr,
    Heaviside,
    Integral,
    Piecewise,
    Poly,
    Pow,
    Rational,
    S,
    Symbol,
    acos,
    asin,
    atan,
    besseli,
    cos,
    cosh,
    erf,
    exp,
    gamma,
    log,
    pi,
    sin,
    sympify,
)
from sympy.core.function import AppliedUndef
from sympy.polys.domains import QQ
from sympy.polys.fields import FracField
from sympy.polys.rings import PolyRing

if TYPE_CHECKING:
    from xsec_sym.proof.piece import Piece

_PLACEHOLDER = Symbol("_")


class Unsettled(ArithmeticError):
    """A sign or a branch that the facts of the piece do not decide."""


class Atoms:
    """Atoms, the relations that tie them, and quotients of polynomials in them with those relations divided out."""

    def __init__(self, piece: Piece, parent: Atoms | None = None) -> None:
        """A smaller piece takes over the atoms of the larger one: what was shown there holds here too."""
        self.piece = piece
        self.atoms: dict[Any, Symbol] = dict(parent.atoms) if parent else {}  # key -> atom
        self.meaning: dict[Symbol, Expr] = dict(parent.meaning) if parent else {}  # atom -> what it stands for
        # atom -> (k, Q): atom^k = Q, with Q in other atoms
        self.relations: dict[Symbol, tuple[int, Expr]] = dict(parent.relations) if parent else {}
        self._signs: dict[Symbol, str | None] = dict(parent._signs) if parent else {}
        self._bounds: dict[Any, tuple[Any, bool] | None] = dict(parent._bounds) if parent else {}
        self._done: dict[Expr, Expr] = dict(parent._done) if parent else {}
        self._fractions: dict[Expr, tuple[Poly, Poly]] = dict(parent._fractions) if parent else {}

    def forget(self) -> None:
        """Facts were added: signs that were unknown may be known now."""
        self._signs = {k: v for k, v in self._signs.items() if v in ("+", "-")}
        self._bounds = {k: v for k, v in self._bounds.items() if v is not None and v[1]}
        unsettled = {a for a, meaning in self.meaning.items() if isinstance(meaning, Abs | Heaviside)}
        self._done = {k: v for k, v in self._done.items() if not (unsettled and v.free_symbols & unsettled)}

    # --- the three answers ---------------------------------------------------------------------------

    def fraction(self, expression: Expr) -> tuple[Poly, Poly]:
        atoms = self.atomise(sympify(expression))
        if atoms not in self._fractions:
            gens = sorted_atoms(atoms.free_symbols)
            try:
                quotient = fractions_in(gens).from_expr(atoms)
            except (ValueError, ZeroDivisionError) as reason:
                raise Unsettled(f"{expression} is not a quotient of polynomials in atoms") from reason
            ring = quotient.numer.ring
            self._fractions[atoms] = self._brought_down(quotient.numer, ring), self._brought_down(quotient.denom, ring)
        top, bottom = self._fractions[atoms]
        if bottom.is_zero:
            raise Unsettled(f"the denominator of {expression} vanishes identically")
        return top, bottom

    def reducible(self, terms: Any) -> bool:
        """Whether some power of a root in these terms can be brought down."""
        return any(k >= self.relations[a][0] for m in terms for a, k in m if a in self.relations)

    def reduced(self, polynomial: Expr) -> Poly:
        """A polynomial in atoms, with every power of a root brought below the root's degree."""
        ring = polynomials_in(sorted_atoms(polynomial.free_symbols))
        return self._brought_down(ring.from_expr(polynomial), ring)

    def _brought_down(self, polynomial: Any, ring: Any) -> Poly:
        """Divide out the relations atom^k = Q, one root after the other, until none applies."""
        changed = True
        while changed:
            changed = False
            for atom in ring.symbols:
                degree, value = self.relations.get(atom, (0, S.Zero))
                if not degree or polynomial.degree(ring.symbols.index(atom)) < degree:
                    continue
                wider = polynomials_in(sorted_atoms({*ring.symbols, *value.free_symbols}))
                try:
                    divided = wider.from_expr(value)
                except ValueError as reason:
                    raise Unsettled(f"{self.meaning[atom]} has a quotient as its radicand") from reason
                polynomial, ring = polynomial.set_ring(wider), wider
                place = ring.symbols.index(atom)
                total = ring.zero
                for powers, coefficient in polynomial.terms():
                    times, left = divmod(powers[place], degree)
                    lower = (*powers[:place], left, *powers[place + 1 :])
                    total += ring({lower: coefficient}) * divided**times
                polynomial, changed = total, True
        if not polynomial:
            return Poly(0, _PLACEHOLDER, domain="QQ")
        used = [i for i, g in enumerate(ring.symbols) if any(powers[i] for powers in polynomial)]
        if not used:
            return Poly(polynomial.LC, _PLACEHOLDER, domain="QQ")
        terms = {tuple(powers[i] for i in used): c for powers, c in polynomial.terms()}
        return Poly.from_dict(terms, *(ring.symbols[i] for i in used), domain="QQ")

    def expression(self, expression: Expr) -> Expr:
        top, bottom = self.fraction(expression)
        quotient = top.as_expr() / bottom.as_expr()
        return sympify(self._meant(quotient.cancel()))

    def _meant(self, polynomial: Expr) -> Expr:
        return polynomial.xreplace(self.meaning)

    def _poly(self, polynomial: Expr) -> Poly:
        gens = sorted(polynomial.free_symbols, key=str) or [_PLACEHOLDER]
        return Poly(polynomial, *gens, domain="QQ")

    # --- atoms ---------------------------------------------------------------------------------------

    def _atom(self, name: str, meaning: Expr, *key: Any) -> Symbol:
        full = (name, *key) if key else (name, meaning)
        if full not in self.atoms:
            atom = Symbol(f"{name}#{len(self.atoms)}")
            self.atoms[full] = atom
            self.meaning[atom] = meaning
        return self.atoms[full]

    def sign_of_atom(self, atom: Symbol) -> str | None:
        if atom not in self._signs:
            self._signs[atom] = None
            self._signs[atom] = self._sign_of_atom(atom)
        return self._signs[atom]

    def _sign_of_atom(self, atom: Symbol) -> str | None:
        alone, weak = {((atom, 1),)}, None
        for g, strict in self.piece.known:
            if g.keys() == alone:
                positive = next(iter(g.values())) > 0
                if strict:
                    return "+" if positive else "-"
                weak = ">=" if positive else "<="
        if weak:
            return weak
        meaning = self.meaning.get(atom, atom)
        if meaning.is_Symbol:
            if meaning.is_integer:
                return "+" if meaning.is_positive else ">=" if meaning.is_nonnegative else None
            return self._sign_of_symbol(meaning)
        if not meaning.free_symbols:
            return self.piece.sign(meaning)
        if isinstance(meaning, exp | cosh):
            return "+"
        if isinstance(meaning, gamma):
            return "+" if self.piece.sign(meaning.args[0]) == "+" else None
        if isinstance(meaning, Abs):
            return ">="
        if isinstance(meaning, Pow):
            below = self.piece.sign(meaning.base)
            return below if below in ("+", ">=") else None
        if isinstance(meaning, acos):
            z = meaning.args[0]
            if not any({*map(self.piece.sign, gaps)} <= {"+", ">=", "0"} for gaps in ((1 - z**2,), (1 - z, 1 + z))):
                return None  # it need not be real
            return "+" if self.piece.sign(1 - meaning.args[0]) == "+" else ">="
        if isinstance(meaning, log):
            return self.piece.sign(meaning.args[0] - 1)
        if isinstance(meaning, cos):
            ends = {self.piece.sign(pi / 2 - meaning.args[0]), self.piece.sign(pi / 2 + meaning.args[0])}
            if ends <= {"+", ">="}:
                return "+" if ends == {"+"} else ">="
        if isinstance(meaning, sin):
            angle = meaning.args[0]
            if self.piece.sign(angle) == "+" and self.piece.sign(pi - angle) == "+":
                return "+"
            if self.piece.sign(angle - pi) == "+" and self.piece.sign(2 * pi - angle) == "+":
                return "-"
        if meaning.is_nonnegative and isinstance(meaning, AppliedUndef):
            return ">="
        if isinstance(meaning, Piecewise):
            return self.piece.sign(meaning)
        if isinstance(meaning, Integral):
            x, low, high = meaning.limits[0]
            if self.piece.sign(high - low) in ("+", ">=", "0"):
                inside = self.piece.inside(x, low, high).sign(meaning.function)
                return ">=" if inside in ("+", ">=", "0") else "<=" if inside in ("-", "<=") else None
        if isinstance(meaning, besseli):
            return self.sign_of_bessel(*meaning.args)
        if isinstance(meaning, erf | atan | asin):
            return self.piece.sign(meaning.args[0])
        return None

    def sign_of_bessel(self, n: Expr, z: Expr) -> str | None:
        """I_n(z) is positive for z > 0; for z < 0 it has the sign of (-1)^n."""
        here = self.piece.sign(z)
        if here == "+" or n == 0:
            return "+"
        if here in (">=", "0"):
            return ">="
        if here in ("-", "<=") and n.is_Integer:
            return ({"-": "+", "<=": ">="} if n % 2 == 0 else {"-": "-", "<=": "<="})[here]
        return None

    def _sign_of_symbol(self, symbol: Symbol) -> str | None:
        low, low_open, high, high_open = self.piece.bounds_of(symbol)
        if low is not None and low >= 0:
            return "+" if low > 0 or low_open else ">="
        if high is not None and high <= 0:
            return "-" if high < 0 or high_open else "<="
        return None

    def bounds_of_atoms(self) -> list[tuple[Any, bool]]:
        """Bounds that atoms bring with them, as terms known to be > 0 (strict) or >= 0: sqrt(Q) < 1 where Q < 1."""
        for atom, meaning in list(self.meaning.items()):
            if atom in self._bounds:
                continue
            self._bounds[atom] = None
            if isinstance(meaning, Pow) and meaning.exp == Rational(1, 2):
                below = self.piece.sign(1 - meaning.base)
                if below in ("+", ">="):
                    self._bounds[atom] = ({(): Fraction(1), ((atom, 1),): Fraction(-1)}, below == "+")
            elif isinstance(meaning, acos):
                strict = self.piece.sign(1 + meaning.args[0]) == "+"
                turn = self.atomise(pi)
                self._bounds[atom] = ({((turn, 1),): Fraction(1), ((atom, 1),): Fraction(-1)}, strict)
            elif isinstance(meaning, exp):
                rising = self.piece.sign(meaning.args[0])
                if rising in ("+", "-"):
                    k = Fraction(1 if rising == "+" else -1)
                    self._bounds[atom] = ({(): -k, ((atom, 1),): k}, True)
            elif isinstance(meaning, cos | sin):
                self._bounds[atom] = ({(): Fraction(1), ((atom, 1),): Fraction(-1)}, False)
                self._bounds[(atom, -1)] = ({(): Fraction(1), ((atom, 1),): Fraction(1)}, False)
        return [b for b in self._bounds.values() if b is not None]

    def atomise(self, e: Expr) -> Expr:
        """An expression as a quotient of polynomials in atoms: `field.py` knows how."""
        raise NotImplementedError


def sorted_atoms(symbols: Any) -> tuple[Symbol, ...]:
    return tuple(sorted(symbols, key=str)) or (_PLACEHOLDER,)


@lru_cache(maxsize=4096)
def fractions_in(gens: tuple[Symbol, ...]) -> Any:
    return FracField(gens, QQ)


@lru_cache(maxsize=4096)
def polynomials_in(gens: tuple[Symbol, ...]) -> Any:
    return PolyRing(gens, QQ)
