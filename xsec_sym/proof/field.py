"""The normal form behind every symbolic proof: a quotient of polynomials in atoms.

An atom is a symbol, pi, a square root of a polynomial, a logarithm, an exponential, a power with a symbolic integer
exponent, a gamma function, an integral, ... Each expression is rewritten once into atoms by rules that hold on the
piece at hand (its facts decide signs), and the relations between atoms (r^2 = Q for a root) are then divided out.
A numerator that becomes the zero polynomial is zero: that, and nothing heuristic, is what "identity" means here.
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache, reduce
from math import floor
from operator import mul
from typing import TYPE_CHECKING, Any

from sympy import (
    Abs,
    Add,
    Expr,
    Heaviside,
    Integer,
    Integral,
    Max,
    Min,
    Mul,
    Piecewise,
    Poly,
    Pow,
    Rational,
    S,
    Sum,
    Symbol,
    acos,
    asin,
    atan,
    atanh,
    binomial,
    cos,
    cosh,
    coth,
    csch,
    erf,
    exp,
    factorial,
    factorint,
    gamma,
    log,
    pi,
    sign,
    sin,
    sinh,
    sympify,
    tan,
    tanh,
)
from sympy.core.function import AppliedUndef
from sympy.polys.domains import QQ
from sympy.polys.fields import FracField
from sympy.polys.rings import PolyRing

if TYPE_CHECKING:
    from xsec_sym.proof.piece import Piece

_PLACEHOLDER = Symbol("_")
_HYPERBOLIC = (sinh, cosh, tanh, coth, csch, tan)


class Unsettled(ArithmeticError):
    """A sign or a branch that the facts of the piece do not decide."""


class Field:
    def __init__(self, piece: Piece, parent: Field | None = None) -> None:
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
            gens = _sorted(atoms.free_symbols)
            try:
                quotient = _fractions_in(gens).from_expr(atoms)
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
        ring = _polynomials_in(_sorted(polynomial.free_symbols))
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
                wider = _polynomials_in(_sorted({*ring.symbols, *value.free_symbols}))
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
        if isinstance(meaning, exp | gamma | cosh):
            return "+"
        if isinstance(meaning, Abs):
            return ">="
        if isinstance(meaning, Pow):
            below = self.piece.sign(meaning.base)
            return below if below in ("+", ">=") else None
        if isinstance(meaning, acos):
            return "+" if self.piece.sign(1 - meaning.args[0]) == "+" else ">="
        if isinstance(meaning, log):
            return self.piece.sign(meaning.args[0] - 1)
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
        if isinstance(meaning, erf | atan | asin):
            return self.piece.sign(meaning.args[0])
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
            elif isinstance(meaning, cos):
                self._bounds[atom] = ({(): Fraction(1), ((atom, 1),): Fraction(-1)}, False)
                self._bounds[(atom, -1)] = ({(): Fraction(1), ((atom, 1),): Fraction(1)}, False)
        return [b for b in self._bounds.values() if b is not None]

    # --- rewriting into atoms ------------------------------------------------------------------------

    def atomise(self, e: Expr) -> Expr:
        if e not in self._done:
            self._done[e] = self._atomise(e)
        return self._done[e]

    def _atomise(self, e: Expr) -> Expr:
        if e.is_Float:
            raise Unsettled(f"{e} is a float, and no proof rests on floats")
        if e.is_Rational or e.is_Symbol:
            return e
        if e.is_Add or e.is_Mul:
            return e.func(*(self.atomise(a) for a in e.args))
        if isinstance(e, Pow):
            return self._power(e.base, e.exp)
        if isinstance(e, exp):
            return self._exponential(e.args[0])
        if isinstance(e, log):
            return self._logarithm(e.args[0])
        if isinstance(e, Abs | sign | Heaviside | Max | Min | Piecewise):
            return self._switch(e)
        if isinstance(e, binomial):
            n, k = e.args
            return self.atomise(gamma(n + 1) / (gamma(k + 1) * gamma(n - k + 1)))
        if isinstance(e, factorial):
            return self.atomise(gamma(e.args[0] + 1))
        if isinstance(e, gamma):
            return self._gamma(e.args[0])
        if isinstance(e, atanh):
            z = e.args[0]
            return self.atomise(log((1 + z) / (1 - z)) / 2)
        if isinstance(e, _HYPERBOLIC):
            return self.atomise(e.rewrite(sin if isinstance(e, tan) else exp))
        if isinstance(e, asin):
            return self.atomise(pi / 2 - acos(e.args[0]))
        if isinstance(e, acos):
            return self._mirrored(e, lambda other: self.atomise(pi) - other)
        if isinstance(e, atan | erf | sin):
            return self._mirrored(e, lambda other: -other)
        if isinstance(e, cos):
            return self._mirrored(e, lambda other: other)
        if isinstance(e, Integral):
            return self._integral(e)
        if isinstance(e, Sum):
            return self._sum(e)
        if e is S.Exp1:
            return self._exponential(Integer(1))
        if e.is_number and e.is_Atom:
            return self._atom("c", e)
        if hasattr(e, "definition") or e.func.is_Function:
            return self._atom("f", e.func(*(self._argument(a) for a in e.args)))
        raise Unsettled(f"{e.func.__name__} has no normal form here")

    def _argument(self, a: Expr) -> Expr:
        return self.expression(a) if isinstance(a, Expr) else a

    def _mirrored(self, e: Expr, other_side: Any) -> Expr:
        """f at a normal argument, with f(-x) told from f(x), so that x and -x meet in one atom."""
        top, bottom = self.fraction(e.args[0])
        flip = top.LC() < 0
        argument = self._meant(((-top if flip else top).as_expr() / bottom.as_expr()).cancel())
        value = e.func(argument)
        if value.is_Atom or not isinstance(value, e.func):
            atom = self.atomise(value)
        else:
            atom = self._atom(e.func.__name__, value)
            if isinstance(value, sin):
                partner = self._atom("cos", cos(argument))
                self.relations.setdefault(atom, (2, 1 - partner**2))
            elif isinstance(value, cos):
                partner = self._atom("sin", sin(argument))
                self.relations.setdefault(partner, (2, 1 - atom**2))
        return other_side(atom) if flip else atom

    def _switch(self, e: Expr) -> Expr:
        """A switch that no fact settles stays an atom: |x| with |x|^2 = x^2, and max(0, x) = x times the step of x."""
        try:
            return self.atomise(self.settled(e))
        except Unsettled:
            if isinstance(e, Abs):
                square = self.reduced(self.atomise(e.args[0] ** 2))
                atom = self._atom("abs", Abs(self.expression(e.args[0])), square.as_expr())
                self.relations.setdefault(atom, (2, square.as_expr()))
                return atom
            if isinstance(e, Heaviside):
                top, bottom = self.fraction(e.args[0])
                flip = top.LC() < 0
                argument = self._meant(((-top if flip else top).as_expr() / bottom.as_expr()).cancel())
                atom = self._atom("step", Heaviside(argument))
                return 1 - atom if flip else atom
            if isinstance(e, Max) and len(e.args) == 2:
                a, b = e.args
                return self.atomise(b) + self.atomise(a - b) * self._switch(Heaviside(a - b))
            if isinstance(e, Piecewise):
                return self._atom("branches", e)
            raise

    def settled(self, e: Expr) -> Expr:
        """Replace |.|, max, min, sign, the step and pieces by the branch that the facts select."""
        if isinstance(e, Piecewise):
            for value, condition in e.args:
                truth = self.piece.decide(condition)
                if truth is None:
                    raise Unsettled(f"the facts do not decide {condition}")
                if truth:
                    return value
            raise Unsettled(f"no branch of {e} applies")
        if isinstance(e, Max | Min):
            kept = list(e.args)
            for a in e.args:
                rivals = [b for b in kept if b is not a]
                better = (">=", "+", "0") if isinstance(e, Max) else ("<=", "-", "0")
                if all(self.piece.sign(a - b) in better for b in rivals):
                    return a
            raise Unsettled(f"the facts do not decide {e}")
        here = self.piece.sign(e.args[0])
        if isinstance(e, Abs):
            if here is None:
                raise Unsettled(f"the sign of {e.args[0]} is not known")
            return e.args[0] if here in ("+", ">=", "0") else -e.args[0]
        if here not in ("+", "-", "0"):
            raise Unsettled(f"the sign of {e.args[0]} is not known")
        if isinstance(e, sign):
            return Integer({"+": 1, "-": -1, "0": 0}[here])
        if here == "0":
            return e.func(*(S.Zero, *e.args[1:]))
        return Integer(1 if here == "+" else 0)

    def _factors(self, e: Expr) -> tuple[Rational, list[tuple[Poly, int]]]:
        top, bottom = self.fraction(e)
        c_top, f_top = top.factor_list()
        c_bottom, f_bottom = bottom.factor_list()
        constant = Rational(c_top) / Rational(c_bottom)
        return constant, [*f_top, *((f, -k) for f, k in f_bottom)]

    def _power(self, base: Expr, exponent: Expr) -> Expr:
        if exponent.is_Integer:
            return self.atomise(base) ** exponent
        if base is S.Exp1:
            return self._exponential(exponent)
        fixed, moving = _split_exponent(exponent)
        constant, factors = self._factors(base)
        if constant == 0 or any(f.is_zero for f, _ in factors):
            if self.piece.sign(exponent) == "+":
                return S.Zero
            raise Unsettled(f"0 to the power {exponent}")
        result: Expr = S.One
        for index, coefficient in moving.items():
            result *= self._integer_power(constant, factors, index, coefficient)
        if fixed.is_Integer:
            result *= self.atomise(base) ** fixed
        else:
            result *= self._root(constant, factors, fixed)
        return result

    def _integer_power(self, constant: Rational, factors: list[tuple[Poly, int]], n: Symbol, times: int) -> Expr:
        result: Expr = S.One
        if constant < 0:
            atom = self._atom("p", Pow(-1, n, evaluate=False), -1, n)
            self.relations[atom] = (2, S.One)
            result *= atom ** (times % 2)
        for prime, k in [*factorint(abs(constant).p).items(), *((q, -j) for q, j in factorint(constant.q).items())]:
            if prime != 1:
                result *= self._atom("p", Pow(Integer(prime), n), prime, n) ** (k * times)
        for f, k in factors:
            root = f.as_expr()
            if root in self.relations and str(root).startswith("r#") and k * times % self.relations[root][0] == 0:
                degree, radicand = self.relations[root]
                inner_constant, inner = self._factors(self._meant(radicand))
                result *= self._integer_power(inner_constant, inner, n, k * times // degree)
                continue
            meaning = self._meant(f.as_expr())
            result *= self._atom("p", Pow(meaning, n), f.as_expr(), n) ** (k * times)
        return result

    def _root(self, constant: Rational, factors: list[tuple[Poly, int]], power: Rational) -> Expr:
        """A broken power of a product: each factor of known sign goes its own way, the rest stay together."""
        result: Expr = S.One
        total = 1 if constant > 0 else -1
        unknown: list[tuple[Poly, int]] = []
        for f, k in _paired(factors):
            here = self.piece.sign_of_factors(f)
            if here in ("+", ">="):
                result *= self._radical(f.as_expr(), k * power)
            elif here in ("-", "<="):
                result *= self._radical(-f.as_expr(), k * power)
                total *= (-1) ** (k % 2)
            else:
                unknown.append((f, k))
        if unknown:
            if power.q != 2 or any(abs(k) != 1 for _, k in unknown):
                raise Unsettled(f"the signs of the factors of {unknown} under a root are not known")
            product = reduce(mul, (f for f, _ in unknown)) * total
            total = 1
            if self.piece.sign_of_factors(product) not in ("+", ">="):
                raise Unsettled(f"the sign of {self._meant(product.as_expr())} under a root is not known")
            result *= self._radical(product.as_expr(), power)
            result /= Mul(*(f.as_expr() ** (2 * power) for f, k in unknown if k < 0))
        if total < 0:
            raise Unsettled("the root of a negative number")
        for prime, k in [*factorint(abs(constant).p).items(), *((q, -j) for q, j in factorint(constant.q).items())]:
            if prime != 1:
                result *= self._radical(Integer(prime), k * power)
        return result

    def _radical(self, radicand: Expr, power: Rational) -> Expr:
        """radicand^power for a radicand that is not negative."""
        whole = floor(power)
        part = power - whole
        result = radicand**whole
        if part:
            root = self._atom("r", Pow(self._meant(radicand), Rational(1, part.q)), radicand, part.q)
            self.relations.setdefault(root, (part.q, radicand))
            result *= root**part.p
        return result

    def _logarithm(self, e: Expr) -> Expr:
        constant, factors = self._factors(e)
        total = 1 if constant > 0 else -1
        terms: list[Expr] = []
        for f, k in factors:
            here = self.piece.sign_of_polynomial(f)
            if here not in ("+", "-"):
                raise Unsettled(f"the logarithm of {self._meant(f.as_expr())}, whose sign is not known")
            g = f.as_expr() if here == "+" else -f.as_expr()
            total *= (-1) ** (k % 2) if here == "-" else 1
            terms.append(k * self._log_atom(g))
        if total < 0:
            raise Unsettled("the logarithm of a negative number")
        for prime, k in [*factorint(abs(constant).p).items(), *((q, -j) for q, j in factorint(constant.q).items())]:
            if prime != 1:
                terms.append(k * self._atom("log", log(Integer(prime))))
        return Add(*terms)

    def _log_atom(self, g: Expr) -> Expr:
        if g.is_Symbol and g in self.relations and str(g).startswith("r#"):
            degree, radicand = self.relations[g]
            return self._logarithm(self._meant(radicand)) / degree
        if g.is_Symbol and isinstance(self.meaning.get(g), exp):
            return self.atomise(self.meaning[g].args[0])
        return self._atom("log", log(self._meant(g)), g)

    def _exponential(self, e: Expr) -> Expr:
        top, bottom = self.fraction(e)
        result: Expr = S.One
        for powers, coefficient in top.terms():
            monomial = Mul(*(g**k for g, k in zip(top.gens, powers, strict=True)))
            exponent = (Rational(coefficient) * monomial / bottom.as_expr()).cancel()
            q, rest = exponent.as_coeff_Mul()
            if not q.is_Rational:
                q, rest = Integer(1), exponent
            meant = self._meant(rest)
            if isinstance(meant, log):
                result *= self._power(meant.args[0], q)
                continue
            atom = self._atom("exp", exp(meant / q.q), rest, q.q)
            if q.q > 1:
                self.relations.setdefault(atom, (q.q, self._atom("exp", exp(meant), rest, 1)))
            result *= atom**q.p
        return result

    def _gamma(self, e: Expr) -> Expr:
        """Shift the argument to one representative, so that ratios of neighbours become rational."""
        fixed, moving = _split_exponent(e)
        if not moving:
            value = gamma(fixed)
            return value if value.is_Rational else self._atom("c", value) if value.is_Atom else self.atomise(value)
        steps = floor(fixed) - 1
        start = e - steps
        shift = [start + i for i in range(steps)] if steps > 0 else [start - 1 - i for i in range(-steps)]
        product = reduce(mul, shift, S.One)
        atom = self._atom("gamma", gamma(start))
        return atom * product if steps > 0 else atom / product

    def _integral(self, e: Integral) -> Expr:
        if len(e.limits) != 1 or len(e.limits[0]) != 3:
            raise Unsettled("only an integral over one variable between two limits is an atom")
        x, low, high = e.limits[0]
        if self.piece.is_zero(high - low):
            return S.Zero
        inner = self.piece.inside(x, low, high).field
        top, bottom = inner.fraction(e.function)
        if top.is_zero:
            return S.Zero
        moving = {a for a in top.free_symbols | bottom.free_symbols if inner.meaning.get(a, a).has(x)}
        constant, factors = bottom.factor_list()
        outside = Mul(constant, *(f.as_expr() ** k for f, k in factors if not f.free_symbols & moving))
        inside = Mul(*(f.as_expr() ** k for f, k in factors if f.free_symbols & moving))
        coefficients: dict[Expr, Expr] = {}
        for powers, coefficient in top.terms():
            parts = [g**k for g, k in zip(top.gens, powers, strict=True)]
            body = Mul(*(p for p, g in zip(parts, top.gens, strict=True) if g in moving))
            rest = Mul(coefficient, *(p for p, g in zip(parts, top.gens, strict=True) if g not in moving))
            coefficients[body] = coefficients.get(body, S.Zero) + rest
        hidden = Symbol("x_", real=True)
        limits = (hidden, self._argument(low), self._argument(high))
        total: Expr = S.Zero
        for body, coefficient in coefficients.items():
            meaning = Integral(inner._meant(body / inside).xreplace({x: hidden}), limits)
            total += self.atomise(inner._meant(coefficient / outside)) * self._atom("int", meaning)
        return total

    def _sum(self, e: Sum) -> Expr:
        """A sum up to n + k becomes the sum up to n and k single terms."""
        if len(e.limits) != 1:
            raise Unsettled("only a single sum is an atom")
        j, low, high = e.limits[0]
        if (high - low).is_Integer:
            return self.atomise(e.doit())
        fixed, moving = _split_exponent(high)
        if not moving or not fixed.is_Integer or not low.is_Integer:
            raise Unsettled(f"the limits of {e} are not integers with one moving end")
        top = high - fixed
        hidden = Symbol("j_", integer=True, nonnegative=True)
        atom = self._atom("sum", Sum(e.function.xreplace({j: hidden}), (hidden, low, top)))
        extra = [e.function.xreplace({j: top + i}) for i in (range(1, fixed + 1) if fixed > 0 else range(fixed + 1, 1))]
        tail = Add(*(self.atomise(t) for t in extra))
        return atom + tail if fixed > 0 else atom - tail


def _sorted(symbols: Any) -> tuple[Symbol, ...]:
    return tuple(sorted(symbols, key=str)) or (_PLACEHOLDER,)


@lru_cache(maxsize=4096)
def _fractions_in(gens: tuple[Symbol, ...]) -> Any:
    return FracField(gens, QQ)


@lru_cache(maxsize=4096)
def _polynomials_in(gens: tuple[Symbol, ...]) -> Any:
    return PolyRing(gens, QQ)


def _paired(factors: list[tuple[Poly, int]]) -> list[tuple[Poly, int]]:
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


def _split_exponent(e: Expr) -> tuple[Rational, dict[Symbol, int]]:
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
