"""Modified Bessel functions I_n of integer order in the normal form.

Every order is brought down to a pair of neighbours by I_(n+1)(z) = I_(n-1)(z) - (2 n / z) I_n(z): to I_0 and I_1, or
to I_k and I_(k+1) where the order is k plus a number. A confluent function 0F1(; n; z^2/4) is one of them in disguise.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sympy import Expr, S, besseli, gamma, sqrt

from xsec_sym.proof.atoms import Unsettled

if TYPE_CHECKING:
    from xsec_sym.proof.field import Field


def order_of(n: Expr) -> tuple[int, Expr]:
    """An integer order as a number and a symbolic part that is an integer, not negative, or 0."""
    number, rest = n.expand().as_coeff_Add()
    if not number.is_Integer or not (rest == 0 or (rest.is_integer and rest.is_nonnegative)):
        raise Unsettled(f"the order {n} of a Bessel function is not known to be an integer")
    return int(number), rest


def atomised(field: Field, e: Expr) -> Expr:
    """I_n(z) in atoms: at most two of one argument."""
    n, z = e.args
    number, moving = order_of(n)
    here = field.piece.sign(z)
    if here == "0":
        return _at_zero(field, n)
    argument = field.expression(z)
    if argument.could_extract_minus_sign():
        parity = field.atomise(S.NegativeOne**n)
        return parity * field.atomise(besseli(n, -argument))
    if moving == 0:
        number = abs(number)
    if here not in ("+", "-") or (moving == 0 and number < 2):
        return field._atom("I", besseli(number + moving, argument))
    low, high = field._atom("I", besseli(moving, argument)), field._atom("I", besseli(moving + 1, argument))
    at, turns = field.atomise(argument), field.atomise(moving)
    index = 0
    while index > number:
        low, high, index = high + 2 * (turns + index) / at * low, low, index - 1
    while index < number:
        low, high, index = high, low - 2 * (turns + index + 1) / at * high, index + 1
    return low


def _at_zero(field: Field, n: Expr) -> Expr:
    if n == 0:
        return S.One
    if field.piece.sign(n) in ("+", "-"):
        return S.Zero
    return field._atom("I", besseli(n, S.Zero))  # 1 or 0, as the order is 0 or not


def confluent(field: Field, e: Expr) -> Expr:
    """0F1(; n; z) with a natural n and z >= 0: (n - 1)! I_(n-1)(2 sqrt(z)) / sqrt(z)^(n-1), and 1 at 0.

    Where n has a symbolic part and z no root in atoms, it stays what it is.
    """
    above, below, z = e.args
    if len(above) != 0 or len(below) != 1 or not (below[0].is_integer and below[0].is_positive):
        raise Unsettled(f"{e} is not a Bessel function of integer order")
    (n,) = below
    here = field.piece.sign(z)
    if here == "0":
        return S.One
    if here == "+":
        try:
            return field.atomise(gamma(n) * besseli(n - 1, 2 * sqrt(z)) / sqrt(z) ** (n - 1))
        except Unsettled:
            if n.is_Integer:
                raise
    return field._atom("F", e.func((), (n.expand(),), field.expression(z)))
