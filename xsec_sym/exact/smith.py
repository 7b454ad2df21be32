"""A Smith microsurface: how its heights are distributed, and what a distribution of facets shows to a direction.

The share of heights below zeta is always the integral of their density P_1: no closed form of it is assumed.

================  ====================================  ================
`uniform`         1 / 2                                 -1 < zeta < 1
`gaussian`        exp(-zeta^2 / 2) / sqrt(2 pi)         every zeta
`logistic`        exp(zeta) / (1 + exp(zeta))^2         every zeta
`exponential`     exp(zeta)                             zeta < 0
================  ====================================  ================
"""

from __future__ import annotations

from typing import Any

from sympy import Expr, Integral, Max, Rational, Symbol, exp, oo, pi, sqrt

from xsec_sym.exact.ring import OnTheRing
from xsec_sym.proof.wire import register

HEIGHT = Symbol("eta", real=True)
COSINE = Symbol("c", real=True)  # between a facet's normal and the direction in question


def uniform(zeta: Expr) -> Expr:
    """Heights spread evenly between -1 and 1."""
    return Rational(1, 2)


def gaussian(zeta: Expr) -> Expr:
    """Heights of a Gaussian surface with unit variance."""
    return exp(-(zeta**2) / 2) / sqrt(2 * pi)


def logistic(zeta: Expr) -> Expr:
    """The logistic distribution of heights, with unit scale."""
    return exp(zeta) / (1 + exp(zeta)) ** 2


def exponential(zeta: Expr) -> Expr:
    """Heights below 0 that thin out downwards: those of a homogeneous half-space."""
    return exp(zeta)


def ahead(facets: Any) -> Integral:
    """The projected area of the facets that face a direction, seen from it: sigma(-omega) of dupuy2016 (4).

    ``facets(c)`` is the distribution of normals, summed over the azimuths about that direction, at the cosine c.

    >>> from sympy import Rational
    >>> ahead(lambda c: Rational(1, 2)).doit()
    1/4
    """
    return Integral(Max(0, COSINE) * facets(COSINE), (COSINE, -1, 1))


def behind(facets: Any) -> Integral:
    """The projected area of the facets that face away from a direction: sigma(omega), light travelling along omega.

    >>> behind(lambda c: c**2).doit()
    1/4
    """
    return Integral(Max(0, -COSINE) * facets(COSINE), (COSINE, -1, 1))


class _Below(OnTheRing):
    nargs = 1
    density: Any = None
    low: Expr = -oo

    @classmethod
    def eval(cls, u: Any, x: Any = None) -> None:
        return None

    def definition(self) -> Expr:
        return Integral(type(self).density(HEIGHT), (HEIGHT, self.low, self.args[0]))


@register
class BelowUniform(_Below):
    """C_1: the share of heights below zeta, -1 <= zeta <= 1, of the uniform distribution.

    >>> from sympy import Symbol
    >>> BelowUniform(Symbol("zeta", real=True)).definition().doit()
    zeta/2 + 1/2
    """

    symbol, density, low = r"C_{1,U}", staticmethod(uniform), Rational(-1)


@register
class BelowGaussian(_Below):
    """C_1 of the Gaussian distribution."""

    symbol, density = r"C_{1,G}", staticmethod(gaussian)


@register
class BelowLogistic(_Below):
    """C_1 of the logistic distribution."""

    symbol, density = r"C_{1,L}", staticmethod(logistic)


@register
class BelowExponential(_Below):
    """C_1 of the exponential distribution, zeta <= 0."""

    symbol, density = r"C_{1,E}", staticmethod(exponential)
