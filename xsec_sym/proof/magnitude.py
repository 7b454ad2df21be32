"""Inequalities as equations: X >= 0 says that the magnitude of X is X."""

from __future__ import annotations

from typing import Any

from sympy import Abs

from xsec_sym.proof.wire import register


@register
class Magnitude(Abs):
    """|X|, left as it is: SymPy would evaluate every sum and integral in X to find its sign.

    >>> from sympy import Integer
    >>> Magnitude(Integer(-2))
    Magnitude(-2)
    """

    @classmethod
    def eval(cls, arg: Any) -> None:
        return None

    def _latex(self, printer: Any, exp: Any = None) -> str:
        power = "" if exp is None else f"^{{{exp}}}"
        return rf"\left|{{{printer._print(self.args[0])}}}\right|{power}"
