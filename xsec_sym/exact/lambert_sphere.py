"""A white Lambertian sphere lit by parallel light and seen from afar: the phase function of a cloud of such spheres.

Also a family of characteristic functions for which everything in the theory of half-spaces is elementary. It has one
parameter b > 1, and is 0 up to 1/b; the phase functions of the sources have no such luck.
"""

from __future__ import annotations

from typing import Any

from sympy import Expr, Integral, Piecewise, Symbol, pi, sqrt

from xsec_sym.exact.ring import OnTheRing, RingCrossSection
from xsec_sym.proof.wire import register

LIT = Symbol("x", real=True)


@register
class PhaseLambertSphere(OnTheRing):
    """The light that a white Lambertian sphere sends out, per steradian; the argument is the cosine of the deviation.

    A normal at the cosine x to the light gets the irradiance x, and each of its rings, x from 0 to 1, is lit as a
    whole. It sends out 1 / pi of that per steradian and per projected area. The light goes on in the direction
    opposite to the one it comes from, which is why the ring is seen at minus the cosine. One 1 / pi more makes the
    light that the disk of the sphere takes in 1.

    >>> PhaseLambertSphere(Symbol("mu", real=True)).definition()
    Integral(x*RingCrossSection(-mu, x), (x, 0, 1))/pi**2
    """

    nargs, symbol = 1, "p"

    @classmethod
    def eval(cls, mu: Any) -> None:  # type: ignore[override]
        return None

    def definition(self) -> Expr:
        (mu,) = self.args
        return Integral(LIT * RingCrossSection(-mu, LIT), (LIT, 0, 1)) / pi**2


@register
class CharacteristicTrial(OnTheRing):
    """A characteristic function Psi, of mu in (0, 1), for b > 1.

    >>> CharacteristicTrial(Symbol("mu", real=True), 1).definition()
    Piecewise((sqrt((1 - mu**2)/(mu**2 - 1))/(pi*mu), mu > 1), (0, True))
    """

    symbol = r"\Psi"

    def definition(self) -> Expr:
        mu, b = self.args
        return Piecewise((sqrt((1 - mu**2) / (b**2 * mu**2 - 1)) / (pi * mu), b * mu > 1), (0, True))


@register
class HTrial(OnTheRing):
    """The H function that belongs to `CharacteristicTrial`.

    >>> HTrial(0, Symbol("b", real=True)).definition()
    1
    """

    symbol = "H"

    def definition(self) -> Expr:
        mu, b = self.args
        return sqrt((1 + b * mu) / (1 + mu))


@register
class DispersionTrial(OnTheRing):
    """The function K of t that belongs to `CharacteristicTrial`.

    >>> DispersionTrial(0, Symbol("b", positive=True)).definition()
    1/b
    """

    symbol = "K"

    def definition(self) -> Expr:
        t, b = self.args
        return sqrt((1 + t**2) / (b**2 + t**2))


__all__ = ["LIT", "CharacteristicTrial", "DispersionTrial", "HTrial", "PhaseLambertSphere"]
