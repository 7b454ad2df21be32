"""Legendre polynomials P_l in the normal form.

Every degree is brought to a pair of neighbours by (l + 1) P_(l+1) = (2 l + 1) x P_l - l P_(l-1): to numbers where the
degree is one, else to P_m and P_(m+1), m being the symbolic part of the degree.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sympy import Expr, S, legendre

from xsec_sym.proof.atoms import Unsettled

if TYPE_CHECKING:
    from xsec_sym.proof.field import Field


def atomised(field: Field, e: Expr) -> Expr:
    degree, x = e.args
    number, moving = degree.expand().as_coeff_Add()
    if not number.is_Integer or not (moving == 0 or (moving.is_integer and moving.is_nonnegative)) or number < 0:
        raise Unsettled(f"the degree {degree} of a Legendre polynomial is not known to be natural")
    at = field.atomise(x)
    if moving == 0:
        low, high, index = S.One, at, 0
    else:
        argument = field.expression(x)
        low, high = (field._atom("P", legendre(moving + i, argument, evaluate=False)) for i in (0, 1))
        index = 0
    turns = field.atomise(moving)
    while index < number:
        m = turns + index + 1
        low, high, index = high, ((2 * m + 1) * at * high - m * low) / (m + 1), index + 1
    return low
