"""The normal form behind every symbolic proof: a quotient of polynomials in atoms.

An atom is a symbol, pi, a square root of a polynomial, a logarithm, an exponential, a power with a symbolic integer
exponent, a gamma function, an integral, ... Each expression is rewritten once into atoms by rules that hold on the
piece at hand (its facts decide signs), and the relations between atoms (r^2 = Q for a root) are then divided out.
A numerator that becomes the zero polynomial is zero: that, and nothing heuristic, is what "identity" means here.
"""

from __future__ import annotations

from functools import reduce
from math import floor
from operator import mul
from typing import Any

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
    besseli,
    binomial,
    cos,
    cosh,
    coth,
    csch,
    default_sort_key,
    erf,
    erfc,
    exp,
    factorial,
    factorint,
    gamma,
    hyper,
    legendre,
    log,
    oo,
    pi,
    sign,
    sin,
    sinh,
    tan,
    tanh,
)
from sympy.core.function import AppliedUndef

from xsec_sym.proof import bessel
from xsec_sym.proof.atoms import Atoms, Unsettled
from xsec_sym.proof.legendre import atomised as legendre_normal
from xsec_sym.proof.names import captured
from xsec_sym.proof.shapes import bounded, hidden_name, paired, split_exponent

_HYPERBOLIC = (sinh, cosh, tanh, coth, csch)


class Field(Atoms):
    """The rules that write an expression in atoms on the piece at hand."""

    # --- rewriting into atoms ------------------------------------------------------------------------

    def atomise(self, e: Expr) -> Expr:
        if e not in self._done:
            self._done[e] = self._atomise(e)
        return self._done[e]

    def _atomise(self, e: Expr) -> Expr:
        if e.is_Float:
            raise Unsettled(f"{e} is a float, and no proof rests on floats")
        if e in (oo, -oo, S.ComplexInfinity, S.NaN):
            raise Unsettled(f"{e} is not a number")
        if e is S.ImaginaryUnit or (e.is_Symbol and not e.is_real):
            raise Unsettled(f"{e} is not known to be real")
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
            if any(not a.is_nonnegative and self.piece.sign(a) not in ("+", ">=", "0") for a in (n, k, n - k)):
                raise Unsettled(f"{e} is a quotient of gamma functions only where nothing is negative")
            return self.atomise(gamma(n + 1) / (gamma(k + 1) * gamma(n - k + 1)))
        if isinstance(e, factorial):
            return self.atomise(gamma(e.args[0] + 1))
        if isinstance(e, gamma):
            return self._gamma(e.args[0])
        if isinstance(e, atanh):
            z = e.args[0]
            return self.atomise(log((1 + z) / (1 - z)) / 2)
        if isinstance(e, _HYPERBOLIC):
            return self.atomise(e.rewrite(exp))
        if isinstance(e, tan):
            return self.atomise(sin(e.args[0]) / cos(e.args[0]))  # SymPy's own rewriting brings in the double angle
        if isinstance(e, asin):
            return self.atomise(pi / 2 - acos(e.args[0]))
        if isinstance(e, acos):
            z = e.args[0]
            signs = ({*map(self.piece.sign, gaps)} for gaps in ((1 - z**2,), (1 - z, 1 + z)))
            if not any(found <= {"+", ">=", "0"} for found in signs):
                raise Unsettled(f"{e} may leave the range of the inverse")
            return self._mirrored(e, lambda other: self.atomise(pi) - other)
        if isinstance(e, erfc):
            return 1 - self.atomise(erf(e.args[0]))
        if isinstance(e, atan | erf | sin):
            return self._mirrored(e, lambda other: -other)
        if isinstance(e, cos):
            return self._mirrored(e, lambda other: other)
        if isinstance(e, besseli):
            return bessel.atomised(self, e)
        if isinstance(e, legendre):
            return legendre_normal(self, e)
        if isinstance(e, hyper):
            return bessel.confluent(self, e)
        if isinstance(e, Integral):
            return self._integral(e)
        if isinstance(e, Sum):
            return self._sum(e)
        if e is S.Exp1:
            return self._exponential(Integer(1))
        if e.is_number and e.is_Atom:
            return self._atom("c", e)
        if hasattr(e, "definition") or isinstance(e, AppliedUndef):
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
                top, bottom = self.fraction(e.args[0])
                if bottom.free_symbols:
                    return self._switch(Abs(self._meant(top.as_expr()))) / self._switch(
                        Abs(self._meant(bottom.as_expr()))
                    )
                square = self.reduced(self.atomise(e.args[0] ** 2))
                atom = self._atom("abs", Abs(self.expression(e.args[0])), square.as_expr())
                self.relations.setdefault(atom, (2, square.as_expr()))
                return atom
            if isinstance(e, Heaviside):
                constant, factors = self._factors(e.args[0])
                if constant == 0:
                    raise
                flip, left = constant < 0, S.One
                for f, k in factors:
                    # a factor of known sign does not move the step: the step of x / 2 is that of x
                    here = self.piece.sign_of_factors(f)
                    flip ^= here == "-" and k % 2 == 1
                    left *= S.One if here in ("+", "-") else f.as_expr() ** k
                at_zero = e.args[1] if len(e.args) > 1 else Rational(1, 2)
                atom = self._atom("step", Heaviside(self._meant(left), 1 - at_zero if flip else at_zero))
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
        below = isinstance(base, gamma) and exponent.is_Integer and exponent < 0 and base.args[0].expand().is_integer
        if below and self.piece.sign(base.args[0]) in ("-", "<=", "0"):
            return S.Zero  # 1 / gamma is entire, and 0 at the poles
        if exponent.is_Integer:
            return self.atomise(base) ** exponent
        if base is S.Exp1:
            return self._exponential(exponent)
        fixed, moving = split_exponent(exponent)
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
        for f, k in paired(factors):
            here = self.piece.sign_of_factors(f)
            if here in ("+", ">="):
                result *= self._radical(f.as_expr(), k * power)
            elif here in ("-", "<="):
                result *= self._radical(-f.as_expr(), k * power)
                total *= (-1) ** (k % 2)
            else:
                unknown.append((f, k))
        if unknown:
            if power.q != 2 or any(k != 1 for _, k in unknown):
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
        if part == Rational(1, 2):
            for atom, (_, square) in self.relations.items():
                # the root of 1 - cos^2 is the sine, where that is not negative
                known = square == radicand and isinstance(self.meaning.get(atom), sin)
                if known and self.sign_of_atom(atom) in ("+", ">=", "0"):
                    return result * atom
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
        e = e.expand()
        if e.is_integer and self.piece.sign(e) != "+":
            raise Unsettled(f"gamma({e}) may have a pole")
        fixed, moving = split_exponent(e)
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
        order = self.piece.sign(high - low)
        if order in ("-", "<=") or (order is None and default_sort_key(low) > default_sort_key(high)):
            return -self.atomise(Integral(e.function, (x, high, low)))
        inner = self.piece.inside(x, low, high).field
        top, bottom = inner.fraction(e.function)
        if top.is_zero:
            return S.Zero
        if bottom.total_degree():
            top, bottom = top.cancel(bottom, include=True)  # squares of roots may have left a common factor
        moving = {a for a in top.free_symbols | bottom.free_symbols if inner.meaning.get(a, a).has(x)}
        constant, factors = bottom.factor_list()
        outside = Mul(constant, *(f.as_expr() ** k for f, k in factors if not f.free_symbols & moving))
        inside = Mul(*(f.as_expr() ** k for f, k in factors if f.free_symbols & moving))
        hidden = Symbol(hidden_name("x", e), real=True)
        limits = (hidden, *(end if end in (oo, -oo) else self._argument(end) for end in (low, high)))
        tame = not {low, high} & {oo, -oo} and all(bounded(inner.meaning.get(a, a)) for a in moving)
        if (len(top.terms()) > 1 and not tame) or inside != 1:
            # term by term the integral might not exist: such an integrand stays whole, but for factors without x
            drawn, factors = top.factor_list()
            whole = Mul(*(f.as_expr() ** k for f, k in factors if f.free_symbols & moving))
            outside /= Mul(drawn, *(f.as_expr() ** k for f, k in factors if not f.free_symbols & moving))
            body = inner._meant(whole / inside)
            return self.atomise(inner._meant(1 / outside)) * self._atom(
                "int", Integral(body.xreplace({x: hidden}), limits)
            )
        coefficients: dict[Expr, Expr] = {}
        for powers, coefficient in top.terms():
            parts = [g**k for g, k in zip(top.gens, powers, strict=True)]
            body = Mul(*(p for p, g in zip(parts, top.gens, strict=True) if g in moving))
            rest = Mul(coefficient, *(p for p, g in zip(parts, top.gens, strict=True) if g not in moving))
            coefficients[body] = coefficients.get(body, S.Zero) + rest
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
        if captured([e.function], low, high) or low.has(j) or high.has(j) or {low, high} & {-oo}:
            raise Unsettled(f"the limits of {e} share a name with its terms, or it has no beginning")
        if not (high == oo or (high - low + 1).is_nonnegative):
            raise Unsettled(f"{e} may run backwards")
        plain = Symbol(hidden_name("i", e), integer=True, nonnegative=True if low.is_nonnegative else None)
        function = e.function.subs(j, plain)  # of the index nothing else is known, whatever its name is
        e, j = Sum(function, (plain, low, high)), plain
        if high == oo:
            return self._summed(e.function.subs(j, j + low), j, S.Zero, oo)
        if (high - low).is_Integer and high - low >= -1:
            return Add(*(self.atomise(e.function.subs(j, low + i)) for i in range(int(high - low) + 1)))
        fixed, moving = split_exponent(high)
        if not moving or not fixed.is_Integer or not low.is_Integer:
            raise Unsettled(f"the limits of {e} are not integers with one moving end")
        top = high - fixed
        atom = self._summed(e.function, j, low, top)
        extra = [e.function.xreplace({j: top + i}) for i in (range(1, fixed + 1) if fixed > 0 else range(fixed + 1, 1))]
        tail = Add(*(self.atomise(t) for t in extra))
        return atom + tail if fixed > 0 else atom - tail

    def _summed(self, term: Expr, j: Symbol, low: Expr, high: Expr) -> Expr:
        """A sum is an atom, but for factors that do not depend on the index."""
        top, bottom = self.fraction(term)
        if top.is_zero:
            return S.Zero
        moving = {a for a in top.free_symbols | bottom.free_symbols if self.meaning.get(a, a).has(j)}
        fixed, kept = S.One, S.One
        for polynomial, side in ((top, 1), (bottom, -1)):
            constant, factors = polynomial.factor_list()
            fixed *= Rational(constant) ** side
            for f, k in factors:
                if f.free_symbols & moving:
                    kept *= f.as_expr() ** (side * k)
                else:
                    fixed *= f.as_expr() ** (side * k)
        name = hidden_name("j", Sum(term, (j, low, high)))
        hidden = Symbol(name, integer=True, nonnegative=True if low >= 0 else None)
        return fixed * self._atom("sum", Sum(self._meant(kept).xreplace({j: hidden}), (hidden, low, high)))


__all__ = ["Field", "Unsettled"]
