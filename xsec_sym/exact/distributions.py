"""Distributions of normals with azimuthal symmetry, and their cross-sections as superpositions of Dirac rings.

Three normalisations occur in the sources. Each distribution names its own; a cross-section here is always the one of
the distribution as it is written here.

=====================  ==============================  =====================================
`beckmann`, `ggx`      per steradian, height field     projected area 2 pi int u D du = 1
`ellipsoidal`          per steradian, whole sphere     mass 2 pi int D du = 1
`spherical_gaussian`   per steradian, whole sphere     mass 2 pi int D du = 1
=====================  ==============================  =====================================
"""

from __future__ import annotations

from typing import Any

from sympy import Expr, Integral, Symbol, csch, exp, log, pi

from xsec_sym.exact import gaussian_balls
from xsec_sym.exact.ring import OnTheRing, RingCrossSection, RingSpread
from xsec_sym.proof.wire import register

INCLINATION = Symbol("x", real=True)


def beckmann(x: Expr, alpha: Expr) -> Expr:
    """Normals of a Gaussian height field: deon2016 (19) for x > 0; there are none below."""
    return exp(-(1 / x**2 - 1) / alpha**2) / (pi * alpha**2 * x**4)


def ggx(x: Expr, alpha: Expr) -> Expr:
    """Normals of the upper half of a spheroid, for x > 0; there are none below. deon2016 (24) with 1/x^2 cleared."""
    return alpha**2 / (pi * (1 - (1 - alpha**2) * x**2) ** 2)


def ellipsoidal(x: Expr, b: Expr) -> Expr:
    """Kagiwada and Kalaba's: deon2016 (26), which is per unit cosine, over 2 pi."""
    return b / (2 * pi * (1 - b * x) * log((1 + b) / (1 - b)))


def spherical_gaussian(x: Expr, alpha: Expr) -> Expr:
    """The von Mises-Fisher distribution with kappa = 2 / alpha^2: deon2016 (28)."""
    return csch(2 / alpha**2) * exp(2 * x / alpha**2) / (2 * pi * alpha**2)


class _Seen(OnTheRing):
    """A distribution seen under the cosine u: its rings, each weighted by the density at its inclination."""

    ring: type = RingCrossSection
    ndf: Any = None
    low = -1  # the lowest inclination that occurs

    def definition(self) -> Expr:
        u, roughness = self.args
        x = INCLINATION
        return Integral(type(self).ring(x, u) * type(self).ndf(x, roughness), (x, self.low, 1))


class _Beckmann(_Seen):
    ndf, low = staticmethod(beckmann), 0


class _GGX(_Seen):
    ndf, low = staticmethod(ggx), 0


class _Ellipsoidal(_Seen):
    ndf = staticmethod(ellipsoidal)


class _SphericalGaussian(_Seen):
    ndf = staticmethod(spherical_gaussian)


@register
class SigmaBeckmann(_Beckmann):
    """The cross-section of Beckmann's distribution.

    >>> from sympy import symbols
    >>> u, alpha = symbols("u alpha", real=True)
    >>> SigmaBeckmann(u, alpha).definition().limits
    ((x, 0, 1),)
    """

    symbol = r"\sigma_{B}"


@register
class SigmaGGX(_GGX):
    """The cross-section of the GGX distribution."""

    symbol = r"\sigma_{GGX}"


@register
class SigmaEllipsoidal(_Ellipsoidal):
    """The cross-section of the ellipsoidal (Kagiwada-Kalaba) distribution, per steradian."""

    symbol = r"\sigma_{KK}"


@register
class SigmaSphericalGaussian(_SphericalGaussian):
    """The cross-section of the spherical Gaussian."""

    symbol = r"\sigma_{SG}"
    fast = gaussian_balls


@register
class SpreadBeckmann(_Beckmann):
    """The second Dirac component of Beckmann's cross-section."""

    symbol, ring = r"\sigma_{B,2}", RingSpread


@register
class SpreadGGX(_GGX):
    """The second Dirac component of the GGX cross-section."""

    symbol, ring = r"\sigma_{GGX,2}", RingSpread


@register
class SpreadEllipsoidal(_Ellipsoidal):
    """The second Dirac component of the ellipsoidal cross-section."""

    symbol, ring = r"\sigma_{KK,2}", RingSpread


@register
class SpreadSphericalGaussian(_SphericalGaussian):
    """The second Dirac component of the spherical Gaussian's cross-section."""

    symbol, ring = r"\sigma_{SG,2}", RingSpread
