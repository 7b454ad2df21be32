"""NumPy source of an expression: straight lines, one a common subexpression, powers by multiplication."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from sympy import Add, Expr, Function, Heaviside, Mul, Pow, Rational, S, Symbol, acos, asin, cse, pi
from sympy.logic.boolalg import Boolean
from sympy.printing.numpy import NumPyPrinter
from sympy.printing.precedence import PRECEDENCE

WIDTH = 120
# What is taken from SciPy, and what an exported module carries with it.
SPECIAL = {"erf": "scipy.special.erf", "erfc": "scipy.special.erfc", "erfcx": "scipy.special.erfcx",
           "complement": "scipy.special.erfc",
           "ive": "scipy.special.ive", "besseli": "scipy.special.iv", "besselj": "scipy.special.jv",
           "gamma": "scipy.special.gamma", "loggamma": "scipy.special.gammaln", "Ei": "scipy.special.expi",
           "expint": "scipy.special.expn", "langevin": "langevin", "ierfc": "ierfc"}  # fmt: skip
HALF = Rational(1, 2)


class Unprintable(ValueError):
    """An expression has a part that neither NumPy nor SciPy has a function for."""


class AtLeastZero(Function):
    """What is not negative, though its rounded value may be."""

    nargs = 1


class WithinOne(Function):
    """What lies in [-1, 1], though its rounded value may not."""

    nargs = 1


class Printer(NumPyPrinter):
    """SymPy's printer for NumPy, with numbers as floats, each constant rounded once, and products as written.

    >>> u = Symbol("u")
    >>> Printer().doprint(2 * pi * (1 - u) * (1 + u) / 3)
    '2.0943951023931957 * (u + 1.0) * (1.0 - u)'
    """

    def __init__(self) -> None:
        super().__init__({"fully_qualified_modules": True, "allow_unknown_functions": False, "strict": True})

    def _module_format(self, fqn: str, register: bool = True) -> str:
        module, _, name = fqn.rpartition(".")
        return f"np.{name}" if module == "numpy" else super()._module_format(fqn, register)

    def _print(self, expr: Any, **kwargs: Any) -> str:
        if isinstance(expr, Expr) and not expr.free_symbols and expr.is_extended_real:
            return self.constant(expr)
        if self.known_functions.get(type(expr).__name__, "").startswith("math."):
            return self._print_Function(expr)
        return super()._print(expr, **kwargs)

    def _print_not_supported(self, expr: Expr) -> str:
        raise Unprintable(f"neither NumPy nor SciPy has {type(expr).__name__}")

    def _print_Function(self, expr: Expr) -> str:
        name = type(expr).__name__
        if name in SPECIAL:
            return f"{SPECIAL[name]}({', '.join(self._print(a) for a in expr.args)})"
        if name not in self.known_functions or not self.known_functions[name].startswith("numpy."):
            self._print_not_supported(expr)
        arguments = ", ".join(self._print(a) for a in expr.args)
        return f"{self._module_format(self.known_functions[name])}({arguments})"

    def constant(self, e: Expr) -> str:
        """A number in one rounding: exact, a power of 2 times pi, or the nearest double."""
        if e.is_infinite:
            return "np.inf" if e is S.Infinity else "-np.inf"
        if e.is_Rational and Rational(float(e)) == e:
            return repr(float(e))
        scale = e / pi
        if scale.is_Rational and abs(scale.p) & (abs(scale.p) - 1) == 0 and scale.q & (scale.q - 1) == 0:
            return {1: "np.pi", -1: "-np.pi"}.get(scale) or f"{float(scale)!r} * np.pi"
        number = e.evalf(40)
        if not number.is_real:
            raise Unprintable(f"{e} is no real number")
        return repr(float(number))

    def _print_Add(self, expr: Add, order: str | None = None) -> str:
        fixed = [t for t in expr.args if not t.free_symbols]
        terms = [t for t in self._as_ordered_terms(expr, order=order) if t.free_symbols]
        if fixed:
            number = Add(*fixed)
            place = 0 if terms and all(_negative(t) for t in terms) else len(terms)
            terms.insert(place, number)
        terms.sort(key=_negative)
        said = ""
        for term in terms:
            if said and _negative(term):
                said += f" - {self.parenthesize(-term, PRECEDENCE['Add'] + 1)}"
            else:
                said += (" + " if said else "") + self._print(term)
        return said

    def _print_Mul(self, expr: Mul) -> str:
        number = Mul(*(f for f in expr.args if not f.free_symbols))
        above: list[str] = []
        below: list[str] = []
        for factor in (f for f in expr.args if f.free_symbols):
            if isinstance(factor, Pow) and _negative(factor.exp):
                turned = factor.base if factor.exp == -1 else Pow(factor.base, -factor.exp, evaluate=False)
                below.append(self.parenthesize(turned, PRECEDENCE["Mul"] + 1))
            else:
                above.append(self._factor(factor))
        sign = ""
        if _negative(number):
            sign, number = "-", -number
        if number != 1 or not above:
            above.insert(0, self.constant(number))
        said = sign + " * ".join(above)
        if not below:
            return said
        return f"{said} / {below[0]}" if len(below) == 1 else f"{said} / ({' * '.join(below)})"

    def _factor(self, e: Expr) -> str:
        return self.parenthesize(e, PRECEDENCE["Mul"] + (1 if isinstance(e, Add) else 0))

    def _print_Pow(self, expr: Pow, rational: bool = False) -> str:
        base, power = expr.base, expr.exp
        if _negative(power):
            return self._print_Mul(Mul(1, expr, evaluate=False))
        if power == 1:
            return self._print(base)
        if power == HALF:
            return f"np.sqrt({self._print(base)})"
        if power.is_Integer and base.is_Symbol:
            return " * ".join([self._print(base)] * int(power))
        return f"np.power({self._print(base)}, {self._print(power)})"

    def _print_Abs(self, expr: Expr) -> str:
        return f"np.abs({self._print(expr.args[0])})"

    def _print_AtLeastZero(self, expr: Expr) -> str:
        return f"np.maximum({self._print(expr.args[0])}, 0.0)"

    def _print_WithinOne(self, expr: Expr) -> str:
        return f"np.maximum(-1.0, np.minimum(1.0, {self._print(expr.args[0])}))"

    def _print_besseli(self, expr: Expr) -> str:
        return self._print_Function(expr)

    def _print_ive(self, expr: Expr) -> str:
        order, z = expr.args
        name = {0: "scipy.special.i0e(", 1: "scipy.special.i1e(", 2: "i2e("}.get(order, f"scipy.special.ive({order}, ")
        return f"{name}{self._print(z)})"

    def _print_coth(self, expr: Expr) -> str:
        return f"1.0 / np.tanh({self._print(expr.args[0])})"

    def _print_csch(self, expr: Expr) -> str:
        return f"1.0 / np.sinh({self._print(expr.args[0])})"

    def _print_sech(self, expr: Expr) -> str:
        return f"1.0 / np.cosh({self._print(expr.args[0])})"

    def _print_polylog(self, expr: Expr) -> str:
        order, z = expr.args
        if order != 2:
            self._print_not_supported(expr)
        return f"scipy.special.spence({self._print(1 - z)})"

    def _print_Heaviside(self, expr: Heaviside) -> str:
        return f"np.heaviside({self._print(expr.args[0])}, {self._print(expr.args[1])})"

    def _print_Max(self, expr: Expr) -> str:
        return self._folded("np.maximum", expr)

    def _print_Min(self, expr: Expr) -> str:
        return self._folded("np.minimum", expr)

    def _folded(self, name: str, expr: Expr) -> str:
        first, *rest = (self._print(a) for a in expr.args)
        for other in rest:
            first = f"{name}({first}, {other})"
        return first

    def _print_And(self, expr: Boolean) -> str:
        return " & ".join(f"({self._print(a)})" for a in sorted(expr.args, key=str))

    def _print_Or(self, expr: Boolean) -> str:
        return " | ".join(f"({self._print(a)})" for a in sorted(expr.args, key=str))

    def _print_Not(self, expr: Boolean) -> str:
        return f"~({self._print(expr.args[0])})"

    def _print_Relational(self, expr: Boolean) -> str:
        return f"{self._print(expr.lhs)} {expr.rel_op} {self._print(expr.rhs)}"


def missing(e: Expr) -> str:
    """The name of a function in it that has no code, or nothing."""
    printer = Printer()
    for name in sorted({type(part).__name__ for part in e.atoms(Function) if part.free_symbols}):
        known = name in SPECIAL or printer.known_functions.get(name, "").startswith("numpy.")
        if not known and not hasattr(printer, f"_print_{name}"):
            return name
    return ""


def _negative(e: Expr) -> bool:
    return bool(e.could_extract_minus_sign()) if not e.is_Add else False


def lines(e: Expr, taken: frozenset[str] = frozenset()) -> list[str]:
    """Assignments and a last ``return``: the body of a function of arrays.

    >>> u = Symbol("u")
    >>> lines((1 - u**2) ** 4 * u**2)
    ['u_2 = u * u', 'b = 1.0 - u_2', 'b_2 = b * b', 'b_4 = b_2 * b_2', 'return b_4 * u_2']
    """
    names = _names(taken | {s.name for s in e.free_symbols})
    shared, (last,) = cse([e], symbols=names, order="canonical")
    made: list[tuple[Symbol, Expr]] = []
    powers: dict[tuple[Expr, int], Symbol] = {}
    alias: dict[Expr, Expr] = {}

    def power(base: Symbol, n: int) -> Expr:
        if n == 1:
            return base
        if (base, n) not in powers:
            half = power(base, n // 2)
            product = Mul(half, half, *([base] if n % 2 else []), evaluate=False)
            powers[base, n] = Symbol(f"{base.name}_{n}")
            made.append((powers[base, n], product))
        return powers[base, n]

    def lowered(node: Expr) -> Expr:
        if not node.args:
            return alias.get(node, node)
        arguments = [lowered(a) for a in node.args]
        if isinstance(node, Pow) and node.exp.is_Rational and node.exp not in (1, -1, HALF, -HALF):
            base, exponent = arguments
            if not exponent.is_Integer and exponent.q != 2:
                return node.func(*arguments)
            if not base.is_Symbol:
                name = next(names)
                made.append((name, base))
                base = name
            whole = power(base, abs(int(exponent))) if abs(exponent) >= 1 else S.One
            root = Pow(base, HALF, evaluate=False) if exponent.q == 2 else S.One
            product = whole if root == 1 else root if whole == 1 else Mul(whole, root, evaluate=False)
            return product if exponent > 0 else 1 / product
        if node.func in (Add, Mul) or not isinstance(node, Expr):
            return node.func(*arguments)
        return node.func(*arguments, evaluate=False) if isinstance(node, Pow) else node.func(*arguments)

    for name, value in shared:
        value = lowered(value)
        if value.is_Symbol or not value.free_symbols:
            alias[name] = value
        else:
            made.append((name, value))
    last = lowered(last)
    printer = Printer()
    said: list[str] = []
    for name, value in made:
        said += _fitted(printer, name.name, value, names)
    return [*said, *_fitted(printer, "", last, names)]


def _names(taken: frozenset[str] | set[str]) -> Iterator[Symbol]:
    for word in (*"abcdfghklmqrstvwyz", *(f"t{k}" for k in range(1000))):
        if word not in taken:
            yield Symbol(word)


def _fitted(printer: Printer, name: str, value: Expr, names: Iterator[Symbol]) -> list[str]:
    """One assignment, its largest parts taken out first where the line would be too long."""
    before: list[str] = []
    while True:
        line = f"{name} = {printer._print(value)}" if name else f"return {printer._print(value)}"
        if len(line) + 4 <= WIDTH:
            return [*before, line]
        part = max(
            (a for a in value.args if a.free_symbols and a.args), key=lambda a: len(printer._print(a)), default=None
        )
        if part is None:
            return [*before, line]
        new = next(names)
        before += _fitted(printer, new.name, part, names)
        value = value.xreplace({part: new})


def guarded(e: Expr, least: Callable[[Expr], float]) -> Expr:
    """Radicands that may round below 0, and arguments of asin and acos that may round past 1, held back.

    ``least`` gives the smallest value of an expression on its domain.
    """
    if not e.args:
        return e
    arguments = [guarded(a, least) for a in e.args]
    if isinstance(e, Pow) and e.exp.is_Rational and e.exp.q == 2 and e.base.is_Add and least(e.base) < 1e-3:
        return Pow(AtLeastZero(arguments[0]), e.exp, evaluate=False)
    if isinstance(e, acos | asin) and not e.args[0].is_Symbol:
        return e.func(WithinOne(arguments[0]))
    if all(a is b for a, b in zip(arguments, e.args, strict=True)):
        return e
    return e.func(*arguments)
