"""Powers, roots, logarithms, exponentials and gamma functions in the normal form: each factor goes its own way."""

from __future__ import annotations

from functools import reduce
from math import floor
from operator import mul

from sympy import Add, Expr, Integer, Mul, Poly, Pow, Rational, S, Symbol, exp, factorint, gamma, log, sin

from xsec_sym.proof.atoms import Atoms, Unsettled
from xsec_sym.proof.shapes import paired, split_exponent


class Powers(Atoms):
    """The rules for what has a base and an exponent."""

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
