"""Mirrors of revolution: a surface z(b) that falls away from its axis, b the distance from it, up to a rim at b = 1.

Its facets are the normals of a distribution with unit projected area. The way back takes a distribution without
normals below the horizon: the normals steeper than u cover a disk, so its radius and the slope there are known.

The spheroid x^2 + y^2 + z^2 / alpha^2 = 1 is given here by its normals: the gradient (x, y, z / alpha^2) points along
the normal at the inclination theta, which fixes the point. So nothing rests on the slope dz/db, by which the source
finds the same point.
"""

from __future__ import annotations

from collections.abc import Callable

from sympy import Dummy, Expr, Integral, Symbol, cos, diff, pi, sin, sqrt

from xsec_sym.exact.ring import OnTheRing
from xsec_sym.proof.wire import register

X, Y = Symbol("x", real=True), Symbol("y", real=True)


def cosine(slope: Expr) -> Expr:
    """Of the normal of a surface with this slope."""
    return 1 / sqrt(1 + slope**2)


def normals_of(z: Expr, b: Symbol, rim: Expr | int = 1) -> tuple[Expr, Expr]:
    """The cosine of the normals at b and their density per steradian, with unit projected area, for a profile z(b).

    A profile with one inclination, a cone, has no density but a Dirac ring; the quotient is then infinite.

    >>> from sympy import simplify, symbols
    >>> b, alpha = symbols("b alpha", positive=True)
    >>> cosine_at_b, density = normals_of(-(b**2) / 2, b)
    >>> cosine_at_b, simplify(density)
    (1/sqrt(b**2 + 1), (b**2 + 1)**2/pi)
    """
    u = cosine(diff(z, b))
    return u, b / (pi * rim**2 * u * sqrt(diff(u, b) ** 2))


def covered(ndf: Callable[[Expr], Expr], u: Expr) -> Integral:
    """The share of the projected area that normals steeper than u have: the squared radius of the disk they cover."""
    return Integral(2 * pi * Y * ndf(Y), (Y, u, 1))


def depth_of(ndf: Callable[[Expr], Expr], u: Expr) -> Integral:
    """How far the profile of a distribution has fallen where its normal has the cosine u; the rim is at b = 1.

    At the cosine x the radius is the root of ``covered``, and the slope is the root of 1 - x^2, over x.

    >>> from sympy import Rational
    >>> depth_of(lambda x: 1 / pi, Rational(1, 2)).doit()  # the sphere
    1/2
    """
    return Integral(pi * sqrt(1 - X**2) * ndf(X) / sqrt(covered(ndf, X)), (X, u, 1))


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


__all__ = ["SpheroidFacets", "SpheroidRadius", "SpheroidRate", "SpheroidSlope", "cosine", "covered", "depth_of",
           "normals_of", "profile", "spheroid"]  # fmt: skip
