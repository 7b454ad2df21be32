"""The normal form behind every symbolic proof: a quotient of polynomials in atoms.

An atom is a symbol, pi, a square root of a polynomial, a logarithm, an exponential, a power with a symbolic integer
exponent, a gamma function, an integral, ... Each expression is rewritten once into atoms by rules that hold on the
piece at hand (its facts decide signs), and the relations between atoms (r^2 = Q for a root) are then divided out.
A numerator that becomes the zero polynomial is zero: that, and nothing heuristic, is what "identity" means here.
"""

from __future__ import annotations

from typing import Any

from sympy import (
    Abs,
    Expr,
    Heaviside,
    Integer,
    Integral,
    Max,
    Min,
    Piecewise,
    Pow,
    Rational,
    S,
    Sum,
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
    erf,
    erfc,
    exp,
    factorial,
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

from xsec_sym.proof import bessel, totals
from xsec_sym.proof.atoms import Unsettled
from xsec_sym.proof.legendre import atomised as legendre_normal
from xsec_sym.proof.powers import Powers

_HYPERBOLIC = (sinh, cosh, tanh, coth, csch)


class Field(Powers):
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
            return totals.integral(self, e)
        if isinstance(e, Sum):
            return totals.series(self, e)
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


__all__ = ["Field", "Unsettled"]
