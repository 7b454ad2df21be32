"""Distributions of normals as the sources print them: their normalisation, and the zero below the horizon."""

from __future__ import annotations

from typing import Any

from sympy import Expr, Piecewise, pi

from xsec_sym.exact.distributions import beckmann, ellipsoidal, ggx
from xsec_sym.exact.ring import OnTheRing
from xsec_sym.proof.wire import register


class _HeightField(OnTheRing):
    ndf: Any = None

    def definition(self) -> Expr:
        u, roughness = self.args
        return Piecewise((type(self).ndf(u, roughness), u > 0), (0, True))


@register
class NormalsBeckmann(_HeightField):
    """Beckmann's distribution, per steradian, with unit projected area.

    >>> from sympy import Rational, Symbol
    >>> NormalsBeckmann(-Rational(1, 2), Symbol("alpha", real=True)).definition()
    0
    """

    symbol, ndf = "D_{B}", staticmethod(beckmann)


@register
class NormalsGGX(_HeightField):
    """The GGX distribution, per steradian, with unit projected area."""

    symbol, ndf = "D_{GGX}", staticmethod(ggx)


@register
class NormalsKagiwadaKalaba(OnTheRing):
    """Kagiwada and Kalaba's distribution, per unit cosine."""

    symbol = "D_{KK}"

    def definition(self) -> Expr:
        return 2 * pi * ellipsoidal(*self.args)
