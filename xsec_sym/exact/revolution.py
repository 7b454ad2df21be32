"""Mirrors of revolution: a surface z(b) that falls away from its axis, b the distance from it.

The spheroid x^2 + y^2 + z^2 / alpha^2 = 1 is given here by its normals: the gradient (x, y, z / alpha^2) points along
the normal at the inclination theta, which fixes the point. So nothing rests on the slope dz/db, by which the source
finds the same point.
"""

from __future__ import annotations

from sympy import Dummy, Expr, cos, diff, sin, sqrt

from xsec_sym.exact.ring import OnTheRing
from xsec_sym.proof.wire import register


def spheroid(theta: Expr, alpha: Expr) -> tuple[Expr, Expr]:
    """Distance from the axis and height of the point whose normal is inclined by theta.

    >>> from sympy import Rational, pi
    >>> spheroid(pi / 4, Rational(3, 4))
    (4/5, 9/20)
    """
    length = sqrt(sin(theta) ** 2 + alpha**2 * cos(theta) ** 2)
    return sin(theta) / length, alpha**2 * cos(theta) / length


def profile(b: Expr, alpha: Expr) -> Expr:
    """The upper half of the spheroid as a height."""
    return alpha * sqrt(1 - b**2)


@register
class SpheroidSlope(OnTheRing):
    """dz/db of the spheroid's upper half, as a function of b and alpha."""

    symbol = "z'"

    def definition(self) -> Expr:
        b, alpha = self.args
        v = Dummy("b", real=True)
        return diff(profile(v, alpha), v).xreplace({v: b})


@register
class SpheroidRadius(OnTheRing):
    """The distance from the axis at which the spheroid's normal is inclined by theta.

    >>> from sympy import Rational, pi
    >>> SpheroidRadius(pi / 4, Rational(3, 4)).definition()
    4/5
    """

    symbol = "b"

    def definition(self) -> Expr:
        return spheroid(*self.args)[0]


@register
class SpheroidRate(OnTheRing):
    """db/dtheta of the spheroid."""

    symbol = r"\frac{db}{d\theta_m}"

    def definition(self) -> Expr:
        theta, alpha = self.args
        v = Dummy("v", real=True)
        return diff(spheroid(v, alpha)[0], v).xreplace({v: theta})


@register
class SpheroidFacets(OnTheRing):
    """Area of the spheroid per solid angle of its normals: length of the meridian times the circle's radius."""

    symbol = r"\frac{d\sigma_m}{d\omega_m}"

    def definition(self) -> Expr:
        theta, alpha = self.args
        v = Dummy("v", real=True)
        radius, height = spheroid(v, alpha)
        density = radius * sqrt(diff(radius, v) ** 2 + diff(height, v) ** 2) / sin(v)
        return density.xreplace({v: theta})


__all__ = ["SpheroidFacets", "SpheroidRadius", "SpheroidRate", "SpheroidSlope", "profile", "spheroid"]
