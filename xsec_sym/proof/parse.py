"""What users type, read through a whitelist: a formula becomes a SymPy object, and nothing is ever run as Python.

Python's own grammar does the tokens and the precedence; every node of its tree must be one of the few known here.
"""

from __future__ import annotations

import ast
import re
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from decimal import Decimal, InvalidOperation
from difflib import get_close_matches
from itertools import pairwise
from keyword import iskeyword
from math import log2
from typing import Any, NoReturn

import sympy
from sympy import And, Basic, Expr, Float, Integer, Not, Or, Rational, S, Symbol, nan, oo, zoo
from sympy.logic.boolalg import Boolean

LONGEST = 5000
DEEPEST = 60
MOST_BITS = 14_000  # about 4200 decimal digits: Python prints no integer longer than 4300

CONSTANTS: dict[str, Basic] = {"pi": sympy.pi, "E": sympy.E, "I": sympy.I, "oo": sympy.oo,
                               "EulerGamma": sympy.EulerGamma, "Catalan": sympy.Catalan}  # fmt: skip
BOUND = ("Integral", "Sum")
_UNIT = (S.Zero, S.One, S.NegativeOne, S.ImaginaryUnit, -S.ImaginaryUnit)  # whose powers never grow
_LONG = (sympy.Integral, sympy.Sum, sympy.hyper)  # a number, but one that may take long to find
_ONE = """exp sin cos tan cot sec csc asin acos atan acot asec acsc sinh cosh tanh coth sech csch asinh acosh atanh
acoth sqrt cbrt Abs sign Heaviside DiracDelta floor ceiling re im conjugate erf erfc erfi gamma loggamma digamma
factorial Ei li Si Ci Shi Chi elliptic_k elliptic_e zeta""".split()  # noqa: SIM905
_TWO = """atan2 besselj bessely besseli besselk binomial legendre chebyshevt chebyshevu hermite laguerre polylog
polygamma elliptic_f RisingFactorial FallingFactorial lowergamma uppergamma beta expint""".split()  # noqa: SIM905
_ALIASES = {"ln": "log", "abs": "Abs", "max": "Max", "min": "Min", "arcsin": "asin", "arccos": "acos",
            "arctan": "atan", "arctan2": "atan2", "rf": "RisingFactorial", "ff": "FallingFactorial"}  # fmt: skip
ARITY: dict[str, tuple[int, int]] = {
    **dict.fromkeys(_ONE, (1, 1)),
    **dict.fromkeys(_TWO, (2, 2)),
    "log": (1, 2),
    "assoc_legendre": (3, 3),
    "hyper": (3, 3),
    "Max": (1, 50),
    "Min": (1, 50),
    "Piecewise": (1, 50),
    "Integral": (2, 5),
    "Sum": (2, 5),
}
_ELEMENTARY = set(_ONE[: _ONE.index("im") + 1]) | {"log", "Max", "Min", "atan2", "conjugate"}
# Numbers up to these sizes are written out by SymPy at once: the result, or a polynomial of that degree.
_LARGEST = {
    "factorial": 1500, "gamma": 1500, "loggamma": 1500, "digamma": 1500, "binomial": 3000, "beta": 1500,
    "zeta": 500, "polygamma": 500, "polylog": 20, "expint": 100, "lowergamma": 100, "uppergamma": 100,
    **dict.fromkeys(("legendre", "chebyshevt", "chebyshevu", "hermite", "laguerre", "assoc_legendre"), 200),
    "RisingFactorial": 200, "FallingFactorial": 200,
}  # fmt: skip
_REFUSED: dict[type[ast.AST], str] = {
    ast.Attribute: "a dot after a name",
    ast.Subscript: "square brackets after a name",
    ast.Lambda: "lambda",
    ast.IfExp: "if ... else (write Piecewise)",
    ast.NamedExpr: "an assignment",
    ast.Starred: "an asterisk before an argument",
    ast.JoinedStr: "a string",
    ast.Dict: "a dictionary",
    ast.Set: "a set",
    ast.Await: "await",
    ast.Yield: "yield",
    ast.YieldFrom: "yield",
    ast.ListComp: "a comprehension",
    ast.SetComp: "a comprehension",
    ast.DictComp: "a comprehension",
    ast.GeneratorExp: "a comprehension",
    ast.List: "a list outside hyper([...], [...], x)",
    ast.Tuple: "a list of values outside Integral, Sum and Piecewise",
}


class ParseError(ValueError):
    """What was typed is no formula; the message says why, in one sentence."""


def expression(text: str, symbols: Mapping[str, Symbol] | None = None) -> Expr:
    """The value that a text stands for, with its decimals exact. Raises `ParseError`.

    >>> x = Symbol("x", real=True)
    >>> expression("0.1*x^2 + Integral(t, (t, 0, x))", {"x": x})
    x**2/10 + Integral(t, (t, 0, x))
    >>> expression("9**9**9")
    Traceback (most recent call last):
    ...
    xsec_sym.proof.parse.ParseError: 9**9**9 is too large to write out
    """
    value = _read(text, symbols or {})
    if not isinstance(value, Expr):
        raise ParseError(f"{short(text)} is a condition, where a value is wanted")
    return value


def condition(text: str, symbols: Mapping[str, Symbol] | None = None) -> Boolean:
    """The comparison that a text stands for, or several joined by ``and``, ``or``, ``not``. Raises `ParseError`.

    >>> x = Symbol("x", real=True)
    >>> condition("x > 0 and x < 1", {"x": x})
    (x > 0) & (x < 1)
    """
    value = _read(text, symbols or {})
    if not isinstance(value, Boolean) or isinstance(value, Symbol):
        raise ParseError(f"{short(text)} is a value, where a condition such as x > 0 is wanted")
    return value


# --- the tree ------------------------------------------------------------------------------------------


def _read(text: str, symbols: Mapping[str, Symbol]) -> Any:
    if len(text) > LONGEST:
        raise ParseError(f"an expression of {len(text)} characters is too long; the limit is {LONGEST}")
    if not text.strip():
        raise ParseError("an expression is empty")
    # one line, so that a line break inside a shell quotation means what it seems to mean
    source = re.sub(r"\s+", " ", text).strip().replace("^", "**")
    if "#" in source:
        raise ParseError(f"{short(text)} contains #, which has no place in a formula")
    depth = deepest = 0
    for character in source:
        depth += (character in "([{") - (character in ")]}")
        deepest = max(deepest, depth)
    if deepest > DEEPEST:
        raise ParseError(f"brackets {deepest} deep are too deep; the limit is {DEEPEST}")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(source, mode="eval")
    except SyntaxError as error:
        raise ParseError(f"{short(text)} cannot be read as an expression{_why(source, error)}") from None
    except (ValueError, MemoryError, RecursionError):
        raise ParseError(f"{short(text)} cannot be read as an expression") from None
    return _Reader(source).value(tree.body, symbols, 0)


_LOGIC = ("and", "or", "not", "in", "is", "None", "True", "False")
_PRODUCT = re.compile(r"(?<![\w.])(\d[\d.]*(?:e[+-]?\d+)?) *([^\W\d]\w*)|(\w+|\)) +(\w+|\()")


def _why(source: str, error: SyntaxError) -> str:
    """What is most likely meant, or where the trouble is."""
    words = [word for word in re.findall(r"[^\W\d]\w*", source) if iskeyword(word) and word not in _LOGIC]
    if source.count("(") != source.count(")"):
        return (
            ": a bracket is not closed" if source.count("(") > source.count(")") else ": it closes a bracket too many"
        )
    if words:
        return f": {words[0]} is a word of Python's; choose another name, such as {words[0]}_"
    if re.search(r"(?<![<>=!])=(?!=)", source):
        return ": the two sides of an equation are given apart, and a value is fixed as in x in {3}"
    if product := _PRODUCT.search(source):
        return ": a product needs its *, as in " + short("*".join(g for g in product.groups() if g))
    return f" near character {error.offset}" if error.offset else ""


@dataclass(frozen=True)
class _Reader:
    source: str

    def value(self, node: ast.AST, scope: Mapping[str, Symbol], depth: int) -> Any:
        """A SymPy value or condition, checked to be finite and of a size that can be written out."""
        if depth > DEEPEST:
            raise ParseError(f"the expression is nested more than {DEEPEST} deep")
        handler = _HANDLERS.get(type(node))
        if handler is None:
            said = _REFUSED.get(type(node), type(node).__name__)
            raise ParseError(f"{self.text(node)} contains {said}, which has no place in a formula")
        try:
            made = handler(self, node, scope, depth + 1)
        except ParseError:
            raise
        except (TypeError, ValueError, ArithmeticError, AttributeError, NotImplementedError, RecursionError):
            raise ParseError(f"{self.text(node)} makes no sense as a formula") from None
        if isinstance(made, Expr) and _magnitude(made) > MOST_BITS:
            self.too_large(node)
        if made.has(nan, zoo):
            raise ParseError(f"{self.text(node)} is infinite or undefined")
        return made

    def number(self, node: ast.AST, scope: Mapping[str, Symbol], depth: int) -> Expr:
        made = self.value(node, scope, depth)
        if not isinstance(made, Expr):
            raise ParseError(f"{self.text(node)} is a condition, where a value is wanted")
        return made

    def truth(self, node: ast.AST, scope: Mapping[str, Symbol], depth: int) -> Boolean:
        made = self.value(node, scope, depth)
        if isinstance(made, Expr):
            raise ParseError(f"{self.text(node)} is a value, where a condition such as x > 0 is wanted")
        return made

    def text(self, node: ast.AST) -> str:
        return short(ast.get_source_segment(self.source, node) or self.source)  # type: ignore[arg-type]

    def too_large(self, node: ast.AST) -> NoReturn:
        raise ParseError(f"{self.text(node)} is too large to write out")

    # --- one method for each kind of node --------------------------------------------------------------

    def constant(self, node: ast.Constant, scope: Mapping[str, Symbol], depth: int) -> Any:
        if isinstance(node.value, bool):
            return sympy.true if node.value else sympy.false
        if isinstance(node.value, int):
            return Integer(node.value)
        if not isinstance(node.value, float):
            kind = "a string" if isinstance(node.value, str | bytes) else "a constant of Python's"
            hint = " (the imaginary unit is I)" if isinstance(node.value, complex) else ""
            raise ParseError(f"{self.text(node)} contains {kind}, which has no place in a formula{hint}")
        # the digits as typed: the float that Python made of them is another number
        try:
            decimal = Decimal(ast.get_source_segment(self.source, node) or "")
        except InvalidOperation:
            raise ParseError(f"{self.text(node)} is not a number") from None
        if decimal and abs(decimal.adjusted()) > MOST_BITS // 4:
            self.too_large(node)
        return Rational(*decimal.as_integer_ratio())

    def name(self, node: ast.Name, scope: Mapping[str, Symbol], depth: int) -> Basic:
        if node.id in scope:
            return scope[node.id]
        if node.id in CONSTANTS:
            return CONSTANTS[node.id]
        if "__" in node.id:
            raise ParseError(f"{short(node.id)} is not a name that a formula can have")
        if _ALIASES.get(node.id, node.id) in ARITY:
            raise ParseError(f"{node.id} stands without its argument; write {node.id}(...)")
        raise ParseError(unbound(node.id))

    def unary(self, node: ast.UnaryOp, scope: Mapping[str, Symbol], depth: int) -> Any:
        if isinstance(node.op, ast.Not):
            return Not(self.truth(node.operand, scope, depth))
        if isinstance(node.op, ast.Invert):
            raise ParseError(f"{self.text(node)} contains ~, which has no place in a formula")
        inner = self.number(node.operand, scope, depth)
        return -inner if isinstance(node.op, ast.USub) else inner

    def binary(self, node: ast.BinOp, scope: Mapping[str, Symbol], depth: int) -> Expr:
        if isinstance(node.op, ast.Pow):
            return self.power(self.number(node.left, scope, depth), self.number(node.right, scope, depth), node)
        # sums and products of many terms lean to the left, and need no depth of their own
        chain: list[tuple[ast.operator, ast.AST]] = []
        first: ast.AST = node
        alike = (ast.Add, ast.Sub) if isinstance(node.op, ast.Add | ast.Sub) else (ast.Mult, ast.Div)
        if not isinstance(node.op, alike):
            raise ParseError(f"{self.text(node)} contains an operator that is none of + - * / **")
        while isinstance(first, ast.BinOp) and isinstance(first.op, alike):
            chain.append((first.op, first.right))
            first = first.left
        terms = [self.number(first, scope, depth)]
        for op, right in reversed(chain):
            term = self.number(right, scope, depth)
            if isinstance(op, ast.Div) and term.is_zero:
                raise ParseError(f"{self.text(node)} divides by zero")
            terms.append(-term if isinstance(op, ast.Sub) else 1 / term if isinstance(op, ast.Div) else term)
        made = sympy.Add(*terms) if alike[0] is ast.Add else sympy.Mul(*terms)
        return made

    def power(self, base: Expr, exponent: Expr, node: ast.AST) -> Expr:
        if exponent.is_Rational and base not in _UNIT and _base_bits(base) * abs(exponent) > MOST_BITS:
            self.too_large(node)
        # a constant beyond reach would keep every later question about its sign or its integer part busy for ever
        if not (base.free_symbols or base in _UNIT or exponent.free_symbols) and _magnitude(exponent, about=0) > 14:
            self.too_large(node)
        # 2**(10**9*log(3)/log(2)) and E**(10**9*log(3)) are written out as well
        if exponent.has(sympy.log) and any(abs(r) > MOST_BITS for r in exponent.atoms(Rational)):
            self.too_large(node)
        return base**exponent

    def compare(self, node: ast.Compare, scope: Mapping[str, Symbol], depth: int) -> Any:
        sides = [self.number(n, scope, depth) for n in (node.left, *node.comparators)]
        made = []
        for op, (a, b) in zip(node.ops, pairwise(sides), strict=True):
            if type(op) not in _RELATIONS:
                raise ParseError(f"{self.text(node)} contains a comparison that is none of < <= > >= == !=")
            relation = _RELATIONS[type(op)]
            # SymPy would evaluate an integral here, however long that takes
            made.append(relation(a, b, evaluate=False) if a.has(*_LONG) or b.has(*_LONG) else relation(a, b))
        return And(*made)

    def junction(self, node: ast.BoolOp, scope: Mapping[str, Symbol], depth: int) -> Any:
        parts = [self.truth(n, scope, depth) for n in node.values]
        return And(*parts) if isinstance(node.op, ast.And) else Or(*parts)

    def call(self, node: ast.Call, scope: Mapping[str, Symbol], depth: int) -> Expr:
        if not isinstance(node.func, ast.Name):
            raise ParseError(
                f"{self.text(node)} calls something that is not the name of a function; a product needs its *"
            )
        name = _ALIASES.get(node.func.id, node.func.id)
        if name not in ARITY:
            near = get_close_matches(name, [*ARITY, *_ALIASES], 1)
            hint = f"; did you mean {near[0]}?" if near else ""
            raise ParseError(f"there is no function called {short(node.func.id)}{hint}")
        if node.keywords:
            raise ParseError(f"{self.text(node)} names an argument, which has no place in a formula")
        low, high = ARITY[name]
        if not low <= len(node.args) <= high:
            many = f"{low}" if low == high else f"{low} to {high}"
            raise ParseError(f"{name} takes {many} argument{'s' * (high > 1)}, not {len(node.args)}")
        if name in BOUND:
            return self.bound(name, node, scope, depth)
        if name == "Piecewise":
            return sympy.Piecewise(*(self.branch(a, scope, depth) for a in node.args))
        if name == "hyper":
            top, low_, z = node.args
            return sympy.hyper(self.series(top, scope, depth), self.series(low_, scope, depth),
                               self.number(z, scope, depth))  # fmt: skip
        arguments = [self.number(a, scope, depth) for a in node.args]
        most = log2(_LARGEST.get(name, 1_000_000))
        if name not in _ELEMENTARY and any(_magnitude(a, about=0) > most for a in arguments):
            self.too_large(node)
        if name == "exp":
            return self.power(S.Exp1, arguments[0], node)
        if name in ("sqrt", "cbrt"):
            return self.power(arguments[0], Rational(1, 2 if name == "sqrt" else 3), node)
        return getattr(sympy, name)(*arguments)

    def bound(self, name: str, node: ast.Call, scope: Mapping[str, Symbol], depth: int) -> Expr:
        body, *limits = node.args
        made: list[tuple[Symbol, Expr, Expr]] = []
        inner = dict(scope)
        # the last limits are the outermost: theirs may not mention the variables of those before
        for limit in reversed(limits):
            if not isinstance(limit, ast.Tuple) or len(limit.elts) != 3 or not isinstance(limit.elts[0], ast.Name):
                raise ParseError(f"{self.text(node)} needs its limits as (variable, from, to)")
            variable, low, high = limit.elts
            demand_name(variable.id)  # type: ignore[attr-defined]
            ends = self.number(low, inner, depth), self.number(high, inner, depth)
            assumed = {"real": True} if name == "Integral" else {"integer": True}
            symbol = Symbol(variable.id, **assumed)  # type: ignore[attr-defined]
            inner[symbol.name] = symbol
            made.insert(0, (symbol, *ends))
        return getattr(sympy, name)(self.number(body, inner, depth), *made)

    def branch(self, node: ast.AST, scope: Mapping[str, Symbol], depth: int) -> tuple[Expr, Any]:
        if not isinstance(node, ast.Tuple) or len(node.elts) != 2:
            raise ParseError(f"{self.text(node)} is no branch of a Piecewise: write (value, condition)")
        return self.number(node.elts[0], scope, depth), self.truth(node.elts[1], scope, depth)

    def series(self, node: ast.AST, scope: Mapping[str, Symbol], depth: int) -> list[Expr]:
        if not isinstance(node, ast.List | ast.Tuple):
            raise ParseError("hyper takes two lists and a value: hyper([a, b], [c], x)")
        return [self.number(n, scope, depth) for n in node.elts]


_HANDLERS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Constant: _Reader.constant,
    ast.Name: _Reader.name,
    ast.UnaryOp: _Reader.unary,
    ast.BinOp: _Reader.binary,
    ast.Compare: _Reader.compare,
    ast.BoolOp: _Reader.junction,
    ast.Call: _Reader.call,
}
_RELATIONS: dict[type[ast.cmpop], Any] = {
    ast.Lt: sympy.Lt, ast.LtE: sympy.Le, ast.Gt: sympy.Gt, ast.GtE: sympy.Ge, ast.Eq: sympy.Eq, ast.NotEq: sympy.Ne,
}  # fmt: skip


def _bits(number: Rational) -> int:
    return abs(int(number.p)).bit_length() + int(number.q).bit_length()


def _magnitude(e: Expr, about: int = 1) -> float:
    """The binary logarithm of a constant's size: of |e|, or with ``about`` 1 of whichever of |e| and 1/|e| is above 1.

    Zero for what is not plainly a number.
    """
    if isinstance(e, Rational):
        return _bits(e) if about else log2(abs(int(e.p))) - log2(int(e.q)) if e else 0.0
    if e.free_symbols or not e.is_number or e.has(oo, -oo, zoo, nan, *_LONG):
        return 0.0
    value = abs(e.evalf(5))
    if not isinstance(value, Float) or value == 0:
        return 0.0
    _, _, exponent, bits = value._mpf_
    size = exponent + bits  # an integer of any length
    return abs(size) if about else size


def _base_bits(base: Expr) -> int:
    """How fast a power of base grows when SymPy multiplies its numbers out."""
    return max((_bits(r) for r in base.atoms(Rational) if abs(r) != 1 and r != 0), default=0)


def short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= 60 else f"{line[:57]}..."


def unbound(name: str) -> str:
    return f'{short(name)} has no range: name one in --where, such as "{short(name)} in (0, 1)"'


def demand_name(name: str) -> None:
    if not name.isidentifier() or "__" in name or len(name) > 40:
        raise ParseError(f"{short(name)} is not a name that a variable can have")
    if name in CONSTANTS:
        raise ParseError(f"{name} is a constant here, so it cannot be a variable")
