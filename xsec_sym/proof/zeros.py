"""Signs of exact constants, and the real zeros of the expressions that switches compare.

A sign is established by ball arithmetic or proved to be zero, never read off a float.
"""

from __future__ import annotations

from functools import lru_cache

from sympy import (
    Dummy,
    Expr,
    Mul,
    Poly,
    PolynomialError,
    Pow,
    S,
    Symbol,
    acos,
    asin,
    atan,
    atan2,
    cos,
    exp,
    log,
    minimal_polynomial,
    nan,
    oo,
    pi,
    real_roots,
    sin,
    sqrt,
    sympify,
    tan,
    together,
)

from xsec_sym.proof.ball_compile import NoEnclosure, compile_ball, precision
from xsec_sym.proof.say import said

_MOST_POINTS = 400


class Undecided(ArithmeticError):
    """A branch, a sign or a switch point that could not be established."""


@lru_cache(maxsize=20_000)
def sign_of(c: Expr) -> int:
    """The sign of a real constant: -1, 0 or 1.

    >>> from sympy import Rational, sqrt
    >>> sign_of(sqrt(2) - Rational(707, 500)), sign_of(sqrt(3 + 2 * sqrt(2)) - 1 - sqrt(2))
    (1, 0)
    """
    c = sympify(c)
    if c.is_Rational or c in (oo, -oo):
        return int(bool(c > 0)) - int(bool(c < 0))
    if c.free_symbols or c is nan:
        raise Undecided(f"{said(c)} has no sign")
    try:
        evaluate = compile_ball(c, ())
    except NoEnclosure as error:
        raise Undecided(f"the sign of {said(c)} could not be established: {error}") from error
    for bits in (64, 256, 1024):
        with precision(bits):
            ball = evaluate((), False)
            if ball.is_finite() and not ball.imag.contains(0):
                raise Undecided(f"{said(c)} is not real, so it has no sign")
            if ball.is_finite() and not ball.real.contains(0):
                return 1 if ball.real > 0 else -1
    if _vanishes(c):
        return 0
    raise Undecided(f"the sign of {said(c)} could not be established")


def _vanishes(c: Expr) -> bool:
    if c.expand() == 0:
        return True
    if c.is_algebraic:
        t = Dummy("t")
        return bool(minimal_polynomial(c, t) == t)
    from xsec_sym.proof.piece import Piece  # the normal form asks here for signs of its own

    return Piece().is_zero(c)


def less(p: Expr, q: Expr) -> bool:
    """p < q, where -oo and oo are allowed."""
    if p == -oo or q == oo:
        return p != q
    return False if p == oo or q == -oo else sign_of(q - p) > 0


# --- real zeros ------------------------------------------------------------------------------------------------


def zeros(g: Expr, x: Symbol, a: Expr, b: Expr, depth: int = 0) -> list[Expr]:
    """Points of (a, b) that include every sign change of ``g``."""
    if depth > 8:
        raise Undecided(f"the zeros of {g} are nested too deeply")
    if not g.has(x) or isinstance(g, exp):
        return []
    g = together(g)
    if isinstance(g, Mul):
        return [r for factor in g.args for r in zeros(factor, x, a, b, depth + 1)]
    if isinstance(g, Pow) and not g.exp.has(x):
        return zeros(g.base, x, a, b, depth + 1)
    gens = [s for s in Poly(g).gens if s.has(x)] if g != x else [x]
    if not gens:
        return []
    if len(gens) == 1:
        values = _polynomial_roots(g, gens[0])
        return [r for v in values for r in _preimages(gens[0], v, x, a, b, depth)]
    radicals = [s for s in gens if isinstance(s, Pow) and s.exp in (S.Half, -S.Half)]
    if radicals:
        return _without_radical(g, radicals[0], x, a, b, depth)
    waves = {type(s): s for s in gens}
    if len(gens) == 2 and set(waves) == {sin, cos} and waves[sin].args == waves[cos].args:
        return _harmonic(g, waves[cos], waves[sin], x, a, b)
    raise Undecided(f"the zeros of {g} could not be found")


def _polynomial_roots(g: Expr, gen: Expr) -> list[Expr]:
    t = Dummy("t", real=True)
    try:
        p = Poly(g.subs(gen, t), t)
    except PolynomialError as error:
        raise Undecided(f"{g} is not a polynomial in {gen}") from error
    coefficients = p.all_coeffs()
    while coefficients and sign_of(coefficients[0]) == 0:
        coefficients = coefficients[1:]
    if len(coefficients) <= 1:
        return []
    if len(coefficients) == 2:
        return [-coefficients[1] / coefficients[0]]
    if len(coefficients) == 3:
        top, middle, low = coefficients
        discriminant = middle**2 - 4 * top * low
        if sign_of(discriminant) < 0:
            return []
        return [(-middle + s * sqrt(discriminant)) / (2 * top) for s in (-1, 1)]
    if all(c.is_Rational for c in coefficients):
        return list(dict.fromkeys(real_roots(Poly(coefficients, t, domain="QQ"))))
    raise Undecided(f"the roots of {p.as_expr()} have no exact form here")


def _preimages(gen: Expr, v: Expr, x: Symbol, a: Expr, b: Expr, depth: int) -> list[Expr]:
    """Points of (a, b) where ``gen`` takes the value ``v``."""
    if gen == x:
        return [v]
    inner = gen.args[0]
    if isinstance(gen, sin | cos | tan):
        return _periodic(gen, v, x, a, b)
    if isinstance(gen, exp):
        return zeros(inner - log(v), x, a, b, depth + 1) if sign_of(v) > 0 else []
    if isinstance(gen, log):
        # a logarithm also changes sign where it ceases to be real, so the zero of its argument is kept
        return zeros(inner - exp(v), x, a, b, depth + 1) + zeros(inner, x, a, b, depth + 1)
    if isinstance(gen, Pow) and gen.exp.is_Rational:
        ends = zeros(gen.base, x, a, b, depth + 1)
        if sign_of(v) <= 0:
            return ends
        return ends + zeros(gen.base - v ** (1 / gen.exp), x, a, b, depth + 1)
    raise Undecided(f"the points where {gen} takes the value {v} could not be found")


def _without_radical(g: Expr, radical: Expr, x: Symbol, a: Expr, b: Expr, depth: int) -> list[Expr]:
    # A + B sqrt(P) = 0 implies A^2 = B^2 P, whose zeros are a superset
    t = Dummy("t")
    p = Poly(g.subs(radical, t), t)
    even = sum((c * radical.base ** (2 * radical.exp * k / 2) for (k,), c in p.terms() if k % 2 == 0), S.Zero)
    odd = sum((c * radical.base ** (2 * radical.exp * (k - 1) / 2) for (k,), c in p.terms() if k % 2), S.Zero)
    squared = (even**2 - odd**2 * radical.base ** (2 * radical.exp)).expand()
    return zeros(squared, x, a, b, depth + 1) + zeros(radical.base, x, a, b, depth + 1)


def _harmonic(g: Expr, cosine: Expr, sine: Expr, x: Symbol, a: Expr, b: Expr) -> list[Expr]:
    C, D = Dummy("C"), Dummy("D")
    p = Poly(g.subs({cosine: C, sine: D}), C, D)
    if p.total_degree() != 1:
        raise Undecided(f"the zeros of {g} could not be found")
    A, B, constant = p.coeff_monomial(C), p.coeff_monomial(D), p.coeff_monomial(1)
    shifted = cosine.args[0] - atan2(B, A)
    return _periodic(cos(shifted, evaluate=False), -constant / sqrt(A**2 + B**2), x, a, b)


def _periodic(gen: Expr, v: Expr, x: Symbol, a: Expr, b: Expr) -> list[Expr]:
    line = Poly(gen.args[0], x)
    if line.degree() != 1 or {a, b} & {oo, -oo}:
        raise Undecided(f"the points where {gen} = {v} could not be listed between {a} and {b}")
    slope, offset = line.all_coeffs()
    if isinstance(gen, tan):
        starts, period = [atan(v), pi / 2], pi
    elif sign_of(1 - v) < 0 or sign_of(1 + v) < 0:
        return []
    else:
        starts, period = ([acos(v), -acos(v)] if isinstance(gen, cos) else [asin(v), pi - asin(v)]), 2 * pi
    lines = sorted(((slope * end + offset) / period for end in (a, b)), key=float)
    first, last = int(lines[0].evalf(20)) - 2, int(lines[1].evalf(20)) + 2
    if last - first > _MOST_POINTS:
        raise Undecided(f"{gen} = {v} holds at too many points")
    return [(s + period * n - offset) / slope for s in starts for n in range(first, last + 1)]
