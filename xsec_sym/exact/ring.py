"""The Dirac ring: all normals at one inclination, with its cross-section and the three parts of it.

Everything is taken per steradian and over the whole circle of azimuths, so that a ring at the pole, x = 1, has the
cross-section 2 pi max(0, u).
"""

from __future__ import annotations

from typing import Any

from sympy import Expr, Function, Heaviside, Integral, Max, Symbol, cos, pi, sqrt

from xsec_sym.proof.wire import register

AZIMUTH = Symbol("varphi", real=True)


def facing(u: Expr, x: Expr) -> Expr:
    """The cosine between the viewing direction and the normal at azimuth varphi of the ring at inclination x."""
    return u * x + sqrt(1 - u**2) * sqrt(1 - x**2) * cos(AZIMUTH)


class OnTheRing(Function):
    nargs = 2
    symbol = ""

    @classmethod
    def eval(cls, u: Any, x: Any) -> None:
        return None

    def _latex(self, printer: Any, exp: Any = None) -> str:
        arguments = ", ".join(printer._print(a) for a in self.args)
        power = f"^{{{exp}}}" if exp is not None else ""
        return rf"{self.symbol}{power}\left({arguments}\right)"

    def _eval_is_real(self) -> bool:
        return True


@register
class RingCrossSection(OnTheRing):
    """The clamped cosine, integrated over the ring: the cross-section of D = delta(x - u_n).

    >>> from sympy import symbols
    >>> u, x = symbols("u x", real=True)
    >>> RingCrossSection(u, x).definition().function
    Max(0, u*x + sqrt(1 - u**2)*sqrt(1 - x**2)*cos(varphi))
    """

    symbol = r"\sigma_{\delta}"

    def definition(self) -> Expr:
        u, x = self.args
        return Integral(Max(0, facing(u, x)), (AZIMUTH, 0, 2 * pi))


@register
class RingMean(OnTheRing):
    """The ring seen as if all of it lay at its centre: the mean cosine, where that is positive."""

    symbol = r"\sigma_{\delta 1}"

    def definition(self) -> Expr:
        u, x = self.args
        return Integral(Heaviside(u * x) * u * x, (AZIMUTH, 0, 2 * pi))


@register
class RingSpread(OnTheRing):
    """The part of the cosine that changes with azimuth, over the visible arc."""

    symbol = r"\sigma_{\delta 2}"

    def definition(self) -> Expr:
        u, x = self.args
        c = facing(u, x)
        return Integral(Heaviside(c) * (c - u * x), (AZIMUTH, 0, 2 * pi))


@register
class RingTilt(OnTheRing):
    """The mean cosine over the visible arc, less what `RingMean` has already counted."""

    symbol = r"\sigma_{\delta 3}"

    def definition(self) -> Expr:
        u, x = self.args
        return Integral((Heaviside(facing(u, x)) - Heaviside(u * x)) * u * x, (AZIMUTH, 0, 2 * pi))
