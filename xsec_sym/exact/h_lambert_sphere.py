"""Enclosures and decimal digits of the H functions of Lambertian spheres, and of the integrals in their equation.

K(t) = 1 - 2 int_0^1 Psi(y) / (1 + t^2 y^2) dy, Psi = a + b y^2 + d y^4 of order 0, 1 or 2, takes the isotropic one's
place in `half_space_balls.py`, as it keeps within the bounds there, for |arg t| <= 3 pi / 8:

- Order 0, c >= 1/50. Psi >= 0: it falls with y, and Psi(1) = c (206 c - 40 c^2 - 4) / 384. So 1 - 2 int Psi >= 0 and
  the integrals of 2 Psi p / (1 + p), p = t^2 y^2, lie between the directions 0 and arg p, and |K| is at least
  cos(3 pi / 8) min(1, |t|^2) (1 - 2 int Psi + int Psi y^2), whose last factor falls with c, to 5 / 32 at c = 1. That
  is min(1, |t|^2) / 17. From above |1 + p| >= sin(pi / 4) gives |K| <= 1 + sqrt 2. The argument is at most 3 pi / 4.
- Elsewhere |K - 1| <= 2 sqrt 2 int |Psi| <= 0.63, which keeps |log K| below 1.
- For real t, |K - 1| <= pi max |Psi| / t with |Psi| <= 207 / 384, so that |log K| <= pi / t from t = 2.3 on; before
  that the bound of order 0 from below, and elsewhere |K - 1| <= 0.45, are enough.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache, partial
from typing import Any

from flint import acb, arb, ctx
from mpmath import mp, mpf
from sympy import Function

from xsec_sym.exact import half_space_balls
from xsec_sym.exact.half_space import StibbsWeir
from xsec_sym.exact.solved import HLambertSphere
from xsec_sym.exact.three_terms import at_rest, characteristic
from xsec_sym.proof.ball_compile import SPECIAL, Closure
from xsec_sym.proof.ball_functions import NAN
from xsec_sym.proof.digits_compile import HANDLERS, Run, Slots, compile_mp
from xsec_sym.proof.quadrature import NoValue, tanh_sinh
from xsec_sym.proof.wire import register


@register
class HLambertTransform(Function):
    """The integral of v^n H^(m)(v, c) / (u + v) over v from 0 to 1: the arguments are m = 0, 1, 2, n = 0, 1, ..., u > 0
    and c in [0, 1].

    >>> from sympy import symbols, latex
    >>> u, c = symbols("u c")
    >>> latex(HLambertTransform(1, 2, u, c))
    '\\\\left[\\\\int_{0}^{1} \\\\frac{v^{2}}{u + v} H^{(1)}\\\\left(v, c\\\\right)\\\\, dv\\\\right]'
    """

    nargs = 4

    @classmethod
    def eval(cls, *args: Any) -> None:
        return None

    def _latex(self, printer: Any, exp: Any = None) -> str:
        m, n, u, c = (printer._print(x) for x in self.args)
        power = f"^{{{exp}}}" if exp is not None else ""
        inner = rf"\frac{{v^{{{n}}}}}{{{u} + v}} H^{{({m})}}\left(v, {c}\right)"
        return rf"\left[\int_{{0}}^{{1}} {inner}\, dv\right]{power}"

    def _eval_is_real(self) -> bool:
        return True


@register
class DispersionLambertSphere(Function):
    """K^(m)(tan(theta), c): the arguments are m = 0, 1, 2, the angle theta in [0, pi / 2] and c in [0, 1].

    The angle takes infinity to pi / 2. At 0 the parts of the closed forms (24) to (26) are infinite, this is not.
    """

    nargs = 3

    @classmethod
    def eval(cls, *args: Any) -> None:
        return None

    def _latex(self, printer: Any, exp: Any = None) -> str:
        m, theta, c = (printer._print(x) for x in self.args)
        power = f"^{{{exp}}}" if exp is not None else ""
        return rf"\left[K^{{({m})}}\left(\tan {theta}, {c}\right)\right]{power}"

    def _eval_is_real(self) -> bool:
        return True


# --- balls ------------------------------------------------------------------------------------------------------


def _moments(t: arb) -> list[arb]:
    """The integrals of y^n / (1 + t^2 y^2), n = 0, 2, 4, 6."""
    square, found = t * t, []
    if t > 0.5:
        found = [t.atan() / t]
        for n in (1, 3, 5):
            found.append((arb(1) / n - found[-1]) / square)
        return found
    tiny = arb(2) ** (-ctx.prec - 8)
    for n in (1, 3, 5, 7):
        total, term, k = arb(0), arb(1), n
        while not term < tiny:
            total += term / k if (k - n) % 4 == 0 else -term / k
            term, k = term * square, k + 2
        found.append(total + arb(0, 1) * term.upper())  # the terms alternate and fall
    return found


def _log_k(m: int, t: arb, c: arb) -> arb:
    psi, moments = characteristic(m, c), _moments(t)
    if t > 0.5:
        k = 1 - 2 * sum((p * i for p, i in zip(psi, moments, strict=False)), arb(0))
    else:
        k = at_rest(m, c) + 2 * t * t * sum((p * i for p, i in zip(psi, moments[1:], strict=True)), arb(0))
    return k.log()


LOG_K = tuple(partial(_log_k, m) for m in range(3))


def _whole(x: arb, below: int) -> int | None:
    """The number that a ball is, where it is one of 0, 1, ..., below - 1."""
    return next((n for n in range(below) if x == n), None)


def _balls(e: Any, build: Any) -> Closure:
    parts = [build(p) for p in e.args]

    def f(v: Any, analytic: bool) -> acb:
        given = [part(v, analytic) for part in parts]
        if analytic or not all(g.imag.is_zero() for g in given):
            return NAN
        m, *rest, x, c = (g.real for g in given)
        order, power = _whole(m, 3), _whole(rest[0], 9) if rest else 0
        if order is None or power is None:
            return NAN
        if rest:
            return acb(half_space_balls.transform(x, c, power, LOG_K[order]))
        return acb(half_space_balls.value(x, c, LOG_K[order]))

    return f


def _by_angle(m: int, theta: acb, c: acb) -> acb:
    """K at tan(theta), by its series where all of the ball is near 0, and else as the source has it."""
    if theta.abs_upper() < 0.55:
        t = theta.tan()
        square, psi = t * t, characteristic(m, c)
        size, k, term, j = arb(square.abs_upper()), acb(at_rest(m, c)), acb(1), 0
        if not size < 0.6:
            return NAN
        while size**j > arb(2) ** (-ctx.prec - 8) and j < 2 * ctx.prec:
            j, term = j + 1, -term * square
            k -= 2 * term * sum((p / (2 * (i + j) + 1) for i, p in enumerate(psi)), acb(0))
        # each of the terms left out is at most twice a power of the size, as |Psi| < 1
        rest = (2 * size ** (j + 1) / (1 - size)).upper()
        return k + acb(arb(0, 1) * rest, arb(0, 1) * rest)
    q, e = theta.cot(), 4 * c + 9
    if m == 0:
        bracket = (346 - c * (20 * c + 281)) * q**2 - 15 * (c - 1) * e * q**4 + 207
        return 1 - c * ((256 * c - 301) * q**2 + bracket * q * theta + 15 * (c - 1) * e * q**4) / 192
    if m == 1:
        bracket = 3 * (1 + q**2) * ((20 * c + 45) * q**2 + 64)
        return 1 - c * ((40 * c + 282) * q**2 - bracket * q * theta + 15 * e * q**4) / 288
    return 1 - 5 * c * (3 * (1 + q**2) ** 2 * q * theta - q**2 * (5 + 3 * q**2)) / 128


def _dispersion_balls(e: Any, build: Any) -> Closure:
    parts = [build(p) for p in e.args]

    def f(v: Any, analytic: bool) -> acb:
        m, theta, c = (part(v, analytic) for part in parts)
        order = _whole(m.real, 3) if m.imag.is_zero() else None
        return NAN if order is None else _by_angle(order, theta, c)

    return f


# --- digits -----------------------------------------------------------------------------------------------------


def _closed(m: int, t: mpf, c: mpf) -> mpf:
    """K as the source has it."""
    a, e = mp.atan(t), 4 * c + 9
    if m == 0:
        bracket = (346 - c * (20 * c + 281)) * t**2 - 15 * (c - 1) * e + 207 * t**4
        return 1 - c * ((256 * c - 301) * t**3 + bracket * a + 15 * (c - 1) * e * t) / (192 * t**5)
    if m == 1:
        bracket = 3 * (t**2 + 1) * (20 * c + 64 * t**2 + 45)
        return 1 - c * ((40 * c + 282) * t**3 - bracket * a + 15 * e * t) / (288 * t**5)
    return 1 - 5 * c * (3 * (t**2 + 1) ** 2 * a - t * (5 * t**2 + 3)) / (128 * t**5)


def _dispersion(m: int, t: mpf, c: mpf) -> mpf:
    if t > 0.25:
        with mp.extraprec(30):
            return _closed(m, t, c)
    total, term, j = at_rest(m, c), mpf(-1), 0
    psi = characteristic(m, c)
    while abs(term) > mp.eps * t**2:
        j, term = j + 1, -term * t**2
        total += 2 * term * sum(p / (2 * (i + j) + 1) for i, p in enumerate(psi))
    return total


@lru_cache(maxsize=64)
def _fock(m: int, c: mpf, bits: int) -> Callable[[mpf], mpf]:
    return StibbsWeir(lambda t: _dispersion(m, t, c))


def _digits(e: Any, slots: Slots) -> Run:
    parts = [compile_mp(p, slots) for p in e.args]

    def f(v: list[Any]) -> mpf:
        m, *rest, x, c = (mpf(part(v)) for part in parts)
        if not (m in (0, 1, 2) and x > 0 and 0 <= c <= 1):
            raise NoValue(f"{e} is taken outside its domain")
        h = _fock(int(m), c, mp.prec)
        return tanh_sinh(lambda w: h(w) * w ** rest[0] / (x + w), mpf(0), mpf(1), mp.dps - 14) if rest else h(x)

    return f


def _dispersion_digits(e: Any, slots: Slots) -> Run:
    parts = [compile_mp(p, slots) for p in e.args]

    def f(v: list[Any]) -> mpf:
        m, theta, c = (mpf(part(v)) for part in parts)
        if not (m in (0, 1, 2) and 0 <= theta < mp.pi / 2 and 0 <= c <= 1):
            raise NoValue(f"{e} is taken outside its domain")
        return _dispersion(int(m), mp.tan(theta), c)

    return f


SPECIAL[DispersionLambertSphere] = _dispersion_balls
HANDLERS[DispersionLambertSphere] = _dispersion_digits
for _head in (HLambertSphere, HLambertTransform):
    SPECIAL[_head] = _balls
    HANDLERS[_head] = _digits

__all__ = ["DispersionLambertSphere", "HLambertTransform"]
