"""A white Lambertian sphere lit by parallel light and seen from afar: the phase function of a cloud of such spheres."""

from __future__ import annotations

from typing import Any

from sympy import Expr, Integral, Symbol, pi

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


__all__ = ["LIT", "PhaseLambertSphere"]
