"""Forms with special functions, written so that no step overflows or cancels where the value does not.

The functions here are unevaluated names for what SciPy, or `functions` beside it, computes well. Growing and decaying
factors are taken out of sums first, so that they cancel as symbols: I_1(z) csch z is 2 ive(1, z) / (1 - exp(-2 z)).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from sympy import (
    Abs,
    Add,
    Dummy,
    Expr,
    Function,
    Max,
    Mul,
    Pow,
    S,
    besseli,
    cosh,
    coth,
    count_ops,
    csch,
    erf,
    erfc,
    exp,
    expand_mul,
    factor,
    factor_terms,
    gamma,
    hyper,
    pi,
    powdenest,
    sinh,
    sqrt,
    together,
)  # fmt: skip
from sympy.codegen.cfunctions import expm1

from xsec_sym.export import floats
from xsec_sym.proof.domain import Domain, Interval

# What a form may hold for this module to have a say in it.
CONCERNED = (besseli, hyper, csch, coth, erf, erfc)
# Two forms are the same where they agree to so many digits at every point.
SAME = 25
# What is smaller is 0 for every double.
TINY = floats.mpf(10) ** -340


class ive(Function):
    """exp(-z) I_n(z), z >= 0."""

    nargs = 2


class erfcx(Function):
    """exp(x^2) erfc(x)."""

    nargs = 1


class complement(Function):
    """erfc x, left as it is: SymPy turns erfc(-x) into 2 - erfc(x), which cancels."""

    nargs = 1


class langevin(Function):
    """coth z - 1/z."""

    nargs = 1


class ierfc(Function):
    """exp(-a^2)/sqrt(pi) - a erfc(a), a >= 0."""

    nargs = 1


def plain(e: Expr) -> Expr:
    """The same in functions that SymPy knows.

    >>> from sympy import Symbol
    >>> plain(langevin(Symbol("z")))
    coth(z) - 1/z
    """
    e = e.replace(ive, lambda n, z: exp(-z) * besseli(n, z))
    e = e.replace(erfcx, lambda x: exp(x**2) * erfc(x))
    e = e.replace(complement, erfc)
    e = e.replace(langevin, lambda z: coth(z) - 1 / z)
    return e.replace(ierfc, lambda a: exp(-(a**2)) / sqrt(pi) - a * erfc(a))


def concerned(e: Expr) -> bool:
    return e.has(*CONCERNED)


def candidates(e: Expr, domain: Domain) -> Iterator[Expr]:
    """Equal forms, the plainest first; only those that agree with ``e`` to many digits at points of the domain."""
    # equality shows at ordinary points; at m = 1e-300 the references themselves may lack digits
    found = [p for p in floats.points(domain, 80) if all(x == 0 or 1e-9 < abs(x) < 1e9 for x in p)]
    tried = [e]
    for new in _forms(e, domain):
        for form in (new, _factored(new)):
            if form not in tried:
                tried.append(form)
                if _agree(e, form, domain, found):
                    yield form


def _agree(e: Expr, new: Expr, domain: Domain, found: list[floats.Point]) -> bool:
    compared = 0
    for point in found:
        values = [floats.exact(plain(f), domain.symbols, point) for f in (e, new)]
        if values[0] is not None and values[1] is not None:
            if abs(values[0] - values[1]) > abs(values[0]) * floats.mpf(10) ** -SAME + TINY:
                return False
            compared += 1
    return compared >= 20


def _forms(e: Expr, domain: Domain) -> Iterator[Expr]:
    known = {}
    for v in domain.variables:
        if isinstance(v, Interval) and v.low.is_nonnegative:
            known[v.symbol] = Dummy(v.symbol.name, positive=True)
    back = {dummy: symbol for symbol, dummy in known.items()}
    here = e.xreplace(known)
    merged = _complements(_gauss(expand_mul(here)) if here.has(erf) else here)
    starts = [here, merged] if merged.has(ierfc, complement) else [here]
    for start in starts:
        yield start.xreplace(back)
        yield _roots(Scaling().whole(_langevins(_exponentials(start)))).xreplace(back)
        if start.has(complement):
            yield Scaling(erfc_too=True).whole(start).xreplace(back)


# --- one rule each -------------------------------------------------------------------------------------------


def bessels(e: Expr) -> Expr:
    """The form with I_n for the hypergeometric functions that are that."""
    return e.replace(hyper, _bessel)


def _bessel(above: Any, below: Any, w: Expr) -> Expr:
    """0F1(; n + 1; (z/2)^2) = n! (z/2)^-n I_n(z)."""
    (b,) = below
    if above or not (b.is_Integer and b > 0):
        return hyper(above, below, w)
    half = powdenest(sqrt(w), force=True)
    return gamma(b) * half ** (1 - b) * besseli(b - 1, 2 * half)


def _exponentials(e: Expr) -> Expr:
    """c sinh z + c cosh z = c exp z."""

    def joined(*terms: Expr) -> Expr:
        total = Add(*terms)
        for part in total.atoms(sinh):
            other = cosh(part.args[0])
            above, beside = total.coeff(part), total.coeff(other)
            if above != 0 and above == beside:
                total = total - above * part - beside * other + above * exp(part.args[0])
        return total

    return e.replace(Add, joined)


def _langevins(e: Expr) -> Expr:
    """coth z = langevin z + 1/z, whose pole often cancels at once."""
    changed = e.replace(coth, lambda z: langevin(z) + 1 / z)
    if changed == e:
        return e

    def tidy(*terms: Expr) -> Expr:
        total = Add(*terms)
        return min(total, expand_mul(total), key=count_ops) if total.has(langevin) else total

    return changed.replace(Add, tidy)


def _complements(e: Expr) -> Expr:
    """c + c erf x = c erfc(-x), and 2 c - c erfc x = c erfc(-x)."""

    def joined(*terms: Expr) -> Expr:
        total = Add(*terms)
        for part in total.atoms(erf, erfc):
            c, number = total.coeff(part), total.as_independent(part, as_Add=True)[0]
            whole = c if isinstance(part, erf) else -2 * c
            if c != 0 and not c.has(part) and number == whole:
                return (c if isinstance(part, erf) else -c) * complement(-part.args[0])
        return total

    return e.replace(Add, joined)


def _gauss(e: Expr) -> Expr:
    """A exp(-x^2) + sqrt(pi) x A erf x = sqrt(pi) A ierfc |x| + |sqrt(pi) x A|, for A >= 0."""

    def joined(*terms: Expr) -> Expr:
        for slope in (t for t in terms if t.has(erf)):
            parts = [f for f in Mul.make_args(slope) if isinstance(f, erf)]
            if len(parts) != 1:
                continue
            x = parts[0].args[0]
            linear = slope / parts[0]
            for bell in (t for t in terms if t is not slope and t.has(exp)):
                height = factor_terms(bell * exp(x**2)).replace(exp, lambda a: exp(together(factor(a))))
                if not height.has(exp) and together(linear**2 - pi * x**2 * height**2).equals(0):
                    rest = Add(*(t for t in terms if t is not slope and t is not bell))
                    return sqrt(pi) * height * ierfc(_size(x)) + _upper(rest, linear)
        return Add(*terms)

    return e.replace(Add, joined)


def _upper(rest: Expr, linear: Expr) -> Expr:
    """rest + |linear|; where rest is linear itself, as one term: 0 below, not a difference beside what is tiny."""
    if rest.coeff(linear.as_coeff_Mul()[1]) == linear.as_coeff_Mul()[0]:
        return rest - linear + Max(0, 2 * linear)
    return rest + Abs(linear)


def _size(x: Expr) -> Expr:
    """|x|, where roots need no bars."""
    return Abs(x).replace(Abs, lambda a: a if isinstance(a, Pow) and a.exp == S.Half else Abs(a))


def _factored(e: Expr) -> Expr:
    """sqrt(1 - u^2) = sqrt((1 - u)(1 + u)), which keeps its digits beside 1."""

    def apart(base: Expr, power: Expr) -> Expr:
        new = factor(base) if power.is_Rational and power.q == 2 else base
        if new.is_Mul and not base.is_Mul:
            signs = [-f if f.could_extract_minus_sign() else f for f in new.args]
            new = Mul(*signs) if Mul(*signs).equals(base) else new
            return Pow(new, power, evaluate=False)
        return Pow(base, power)

    return e.replace(Pow, apart)


def _roots(e: Expr) -> Expr:
    """-a / sqrt(a) = -sqrt(a), which has a value where a is 0."""

    def joined(*factors: Expr) -> Expr:
        for below in factors:
            if isinstance(below, Pow) and below.exp == -S.Half and -below.base in factors:
                others = [f for f in factors if f is not below and f != -below.base]
                return -sqrt(below.base) * Mul(*others)
        return Mul(*factors)

    return e.replace(Mul, joined)


class Scaling:
    """Every part as exp(s) times a rest of moderate size."""

    def __init__(self, erfc_too: bool = False) -> None:
        self.erfc_too = erfc_too

    def whole(self, e: Expr) -> Expr:
        """The expression with its exponential factors merged into one.

        >>> from sympy import Symbol
        >>> z = Symbol("z", positive=True)
        >>> Scaling().whole(besseli(1, z) * csch(z))
        -2*ive(1, z)/expm1(-2*z)
        """
        s, rest = self.pull(e)
        return _neat(s) * rest

    def pull(self, e: Expr) -> tuple[Expr, Expr]:
        if not e.free_symbols or not e.args:
            return S.Zero, e
        if isinstance(e, exp):
            return e.args[0], S.One
        if isinstance(e, besseli):
            return e.args[1], ive(e.args[0], e.args[1])
        if isinstance(e, sinh):
            return e.args[0], -expm1(-2 * e.args[0]) / 2
        if isinstance(e, cosh):
            return e.args[0], (1 + exp(-2 * e.args[0])) / 2
        if isinstance(e, csch):
            return -e.args[0], -2 / expm1(-2 * e.args[0])
        if isinstance(e, complement) and self.erfc_too:
            return -(e.args[0] ** 2), erfcx(e.args[0])
        if isinstance(e, Mul):
            scales, rests = zip(*map(self.pull, e.args), strict=True)
            return Add(*scales), Mul(*rests)
        if isinstance(e, Pow) and e.exp.is_Rational:
            s, rest = self.pull(e.base)
            return e.exp * s, rest**e.exp
        if isinstance(e, Add):
            return self._sum([self.pull(term) for term in e.args])
        return S.Zero, e.func(*(self.whole(a) if isinstance(a, Expr) else a for a in e.args))

    def _sum(self, found: list[tuple[Expr, Expr]]) -> tuple[Expr, Expr]:
        scales = list(dict.fromkeys(s for s, _ in found))
        largest = next((t for t in scales if all((s - t).is_nonpositive for s in scales)), S.Zero)
        return largest, factor_terms(Add(*(_neat(s - largest) * rest for s, rest in found)))


def _neat(s: Expr) -> Expr:
    """exp(s), with differences of roots in s as quotients."""
    s = factor(s)

    def turned(*terms: Expr) -> Expr:
        total = Add(*terms)
        roots = any(p.exp == S.Half for t in terms for p in t.atoms(Pow))
        if len(terms) != 2 or not roots or sum(t.could_extract_minus_sign() for t in terms) != 1:
            return total
        a, b = terms
        return factor(expand_mul(a**2 - b**2)) / (a - b)

    return exp(s.replace(Add, turned))
