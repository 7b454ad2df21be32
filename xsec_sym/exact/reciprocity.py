"""A medium of one-sided flakes with any distribution of normals, seen along a direction of travel.

The normals are listed by one parameter t from 0 to 1: m(t), of which there are D(t) dt. That is no restriction, since
every finite measure on the sphere is the image of such a list, the jumps of m included; a single flake is a constant m,
and a ring one turn of it. Directions are vectors of any length: the cross-section of a direction of length l is l times
that of the direction itself, so that along a straight way the optical thickness is the cross-section of the way.
"""

from __future__ import annotations

from collections.abc import Iterable

from sympy import Expr, Function, Integral, Max, Rational, Symbol

Vector = tuple[Expr, ...]

T = Symbol("t", real=True)
D = Function("D", real=True)
NORMAL = tuple(Function(f"m_{axis}", real=True) for axis in "xyz")
# Two lists of flakes, neither symmetric, each with a mean normal of no special direction. What counts as the area of a
# flake is D times the length of its normal.
TRIED = {
    D: (lambda t: 1 + t, lambda t: 2 - t**2),
    NORMAL[0]: (lambda t: t, lambda t: 1 - 2 * t),
    NORMAL[1]: (lambda t: Rational(3, 5), lambda t: t),
    NORMAL[2]: (lambda t: Rational(4, 5) - t, lambda t: Rational(-1, 3)),
}


def dot(a: Iterable[Expr], b: Iterable[Expr]) -> Expr:
    """The scalar product of two vectors.

    >>> dot((1, 2, 3), (4, 5, 6))
    32
    """
    return sum(x * y for x, y in zip(a, b, strict=True))


def less(a: Iterable[Expr], b: Iterable[Expr]) -> Vector:
    """The vector from b to a.

    >>> less((3, 3, 3), (1, 2, 3))
    (2, 1, 0)
    """
    return tuple(x - y for x, y in zip(a, b, strict=True))


def opposite(a: Iterable[Expr]) -> Vector:
    """The same way back.

    >>> opposite((1, 0, -2))
    (-1, 0, 2)
    """
    return tuple(-x for x in a)


def normal() -> Vector:
    """The normal m(t) of the flakes at t."""
    return tuple(m(T) for m in NORMAL)


def over_normals(f: Expr) -> Integral:
    """The integral of f over all flakes, D(t) dt of them at t."""
    return Integral(D(T) * f, (T, 0, 1))


def projected_area(way: Iterable[Expr]) -> Integral:
    """dupuy2016 (4): the area of the flakes that face a traveller along ``way``, times the length of the way.

    >>> from sympy import symbols
    >>> projected_area(symbols("x y z", real=True)).function
    D(t)*Max(0, -x*m_x(t) - y*m_y(t) - z*m_z(t))
    """
    return over_normals(Max(0, -dot(way, normal())))


def mean_normal() -> Vector:
    """M, the integral of m D(m) over all flakes: their area as a vector."""
    return tuple(over_normals(m) for m in normal())


__all__ = ["NORMAL", "TRIED", "D", "T", "dot", "less", "mean_normal", "normal", "opposite", "over_normals",
           "projected_area"]  # fmt: skip
