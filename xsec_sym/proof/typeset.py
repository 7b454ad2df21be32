"""LaTeX of expressions whose symbols are named for what they stand for: products of directions, gradients along one."""

from __future__ import annotations

import re
from typing import Any

from sympy import Symbol
from sympy.printing.latex import LatexPrinter

PRODUCT = re.compile(r"\((-?)(\w+)\.(\w+)\)")
APPLIED = re.compile(r"(\w+)\((\w+)\)")


class Printer(LatexPrinter):
    def _print_Symbol(self, expr: Any, style: str = "plain") -> str:
        if found := PRODUCT.fullmatch(expr.name):
            sign, *names = found.groups()
            first, second = (self._print(Symbol(name)) for name in names)
            return rf"\left({sign}{first} \cdot {second}\right)"
        if found := APPLIED.fullmatch(expr.name):
            name, argument = found.groups()
            return rf"\{name}{{\left({self._print(Symbol(argument))} \right)}}"
        return super()._print_Symbol(expr, style)

    def _print_Function(self, expr: Any, exp: Any = None) -> str:
        along, _, word = expr.func.__name__.partition(".")
        if word != "grad":
            return super()._print_Function(expr, exp)
        inner = rf"{self._print(Symbol(along))} \cdot \nabla {self._print(expr.args[0])}"
        return inner if exp is None else rf"\left({inner}\right)^{{{exp}}}"


def latex(e: Any) -> str:
    r"""The expression as LaTeX.

    >>> from sympy import Function, symbols
    >>> latex(symbols("(-omega_1.omega_m)") + symbols("z") / symbols("cos(theta)"))
    '\\left(-\\omega_{1} \\cdot \\omega_{m}\\right) + \\frac{z}{\\cos{\\left(\\theta \\right)}}'
    >>> latex(Function("omega_1.grad")(Function("L")(symbols("x"))))
    '\\omega_{1} \\cdot \\nabla L{\\left(x \\right)}'
    """
    return Printer().doprint(e)
