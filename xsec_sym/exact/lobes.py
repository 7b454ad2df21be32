"""The lobes that a distribution of normals gives at the half angle: 1 on the axis, and a function of the direction."""

from __future__ import annotations

from sympy import Expr, pi, sqrt

from xsec_sym.exact.distributions import ggx
from xsec_sym.exact.ring import OnTheRing
from xsec_sym.proof.wire import register


def ggx_anisotropic(x: Expr, y: Expr, z: Expr, alpha_x: Expr, alpha_y: Expr) -> Expr:
    """Normals of the upper half of an ellipsoid, per steradian with unit projected area, at a unit vector, z > 0."""
    return 1 / (pi * alpha_x * alpha_y * ((x / alpha_x) ** 2 + (y / alpha_y) ** 2 + z**2) ** 2)


@register
class LobeGGX(OnTheRing):
    """GGX at half the angle whose cosine is the first argument, over its value on the axis: pi alpha^2 D.

    >>> from sympy import Symbol
    >>> LobeGGX(1, Symbol("alpha", real=True)).definition()
    1
    """

    symbol = "G_{GGX}"

    def definition(self) -> Expr:
        m, alpha = self.args
        return pi * alpha**2 * ggx(sqrt((1 + m) / 2), alpha)
