"""Chandrasekhar's H function of an isotropic half-space, and the averages of it in which it is nested.

With the single-scattering albedo a in (0, 1] and K(t) = 1 - a arctan(t) / t, H is the Wiener-Hopf factor of 1 / K:

    H(u) = exp(-u / pi int_0^oo log K(t) / (1 + u^2 t^2) dt),   u > 0.

`HTransform` and `HMoment` are integrals over it, so that an integral stands in an exponential under an integral. All
three stand for themselves, as a Bessel function does: balls come from the factor (`half_space_balls.py`, where every
error is bounded), decimal digits from the closed form of Stibbs and Weir and mpmath.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

from flint import acb
from mpmath import mp, mpf
from sympy import Expr, Integral, Symbol, atan, exp, log, oo, pi

from xsec_sym.exact import half_space_balls
from xsec_sym.exact.ring import OnTheRing
from xsec_sym.proof.ball_compile import SPECIAL, Closure
from xsec_sym.proof.ball_functions import NAN
from xsec_sym.proof.digits_compile import HANDLERS, Run, Slots, compile_mp
from xsec_sym.proof.quadrature import NoValue, tanh_sinh
from xsec_sym.proof.wire import register

T = Symbol("tau", real=True)


def dispersion(t: Expr, a: Expr) -> Expr:
    """K of an isotropically scattering medium on the imaginary axis, at the wave number t > 0.

    >>> from sympy import Rational
    >>> dispersion(1, Rational(1, 2))
    1 - pi/8
    """
    return 1 - a * atan(t) / t


def wiener_hopf(u: Expr, a: Expr) -> Expr:
    """The factor as Fock has it.

    >>> from sympy import symbols
    >>> u, a = symbols("u a", real=True)
    >>> wiener_hopf(u, a)
    exp(-u*Integral(log(-a*atan(tau)/tau + 1)/(tau**2*u**2 + 1), (tau, 0, oo))/pi)
    """
    return exp(-u / pi * Integral(log(dispersion(T, a)) / (1 + u**2 * T**2), (T, 0, oo)))


@register
class HIsotropic(OnTheRing):
    """H(u, a): without dimension, H(0+) = 1, and positive for every u > 0, also beyond 1."""

    symbol = "H"


@register
class HTransform(OnTheRing):
    """The integral of H(v, a) / (u + v) over v from 0 to 1, for u > 0."""

    def _latex(self, printer: Any, exp: Any = None) -> str:
        u, a = (printer._print(x) for x in self.args)
        power = f"^{{{exp}}}" if exp is not None else ""
        return rf"\left[\int_{{0}}^{{1}} \frac{{H\left(v, {a}\right)}}{{{u} + v}}\, dv\right]{power}"


@register
class HMoment(OnTheRing):
    """The integral of v^n H(v, a) over v from 0 to 1, with the arguments n = 0, 1, 2, ... and a."""

    def _latex(self, printer: Any, exp: Any = None) -> str:
        n, a = (printer._print(x) for x in self.args)
        power = f"^{{{exp}}}" if exp is not None else ""
        return rf"\left[\int_{{0}}^{{1}} v^{{{n}}} H\left(v, {a}\right) dv\right]{power}"


_BALLS = {HIsotropic: half_space_balls.value, HTransform: half_space_balls.transform, HMoment: half_space_balls.moment}


# --- balls ------------------------------------------------------------------------------------------------------


def _balls(e: Any, build: Any) -> Closure:
    first, second = (build(p) for p in e.args)
    value = _BALLS[type(e)]

    def f(v: Any, analytic: bool) -> acb:
        x, a = first(v, analytic), second(v, analytic)
        if analytic or not (x.imag.is_zero() and a.imag.is_zero()):
            return NAN
        return acb(value(x.real, a.real))

    return f


# --- digits -----------------------------------------------------------------------------------------------------


class StibbsWeir:
    """H by their closed form, of K at tan t.

    Whole numbers take the place of fractions: only the absolute error of log H matters.

    In y = log(tan t) the integrand is log(1 - a t cot t) sech(y + log u), analytic for |Im y| < pi / 2, so that the
    trapezoidal rule of step h is wrong by about exp(-pi^2 / h).
    """

    def __init__(self, of: Callable[[mpf], mpf]) -> None:
        self.bits = bits = int((mp.dps - 8) * mpf("3.33"))  # what `value` works with, less most of its reserve
        nats = bits * mp.log(2)
        self.h = mpf("0.9") * mp.pi**2 / nats
        self.low = -int(nats / self.h)
        ys = [k * self.h for k in range(self.low, -self.low)]  # beyond, the logarithm is negligible, or its weight
        self.logs = [int(mp.ldexp(mp.log(of(mp.exp(y))), bits)) for y in ys]
        self.fall = int(mp.ldexp(mp.exp(-self.h), bits))

    def __call__(self, u: mpf) -> mpf:
        centre = -mp.log(u) / self.h
        first = int(mp.ceil(centre))
        total = self._side(first, 1, mp.exp((centre - first) * self.h))
        total += self._side(first - 1, -1, mp.exp((first - 1 - centre) * self.h))
        return mp.exp(-self.h / mp.pi * mp.ldexp(mpf(total), -2 * self.bits))

    def _side(self, k: int, step: int, q: mpf) -> int:
        bits, one, decay, total = self.bits, 1 << self.bits, int(mp.ldexp(q, self.bits)), 0
        for log_k in self.logs[k - self.low :] if step > 0 else reversed(self.logs[: k - self.low + 1]):
            if not decay:
                break
            total += log_k * ((decay << bits) // (one + (decay * decay >> bits)))
            decay = decay * self.fall >> bits
        return total


def _isotropic(tan: mpf, a: mpf) -> mpf:
    """1 - a t cot t; for a = 1 it would cancel at small t."""
    t = mp.atan(tan)
    if t > mpf(2) ** -20:
        return 1 - a * t / tan
    return (1 - a) + a * (t**2 / 3 + t**4 / 45 + 2 * t**6 / 945 + t**8 / 4725)


@lru_cache(maxsize=32)
def _stibbs_weir(a: mpf, bits: int) -> StibbsWeir:
    return StibbsWeir(lambda tan: _isotropic(tan, a))


def _digits(e: Any, slots: Slots) -> Run:
    first, second = (compile_mp(p, slots) for p in e.args)
    head = type(e)

    def f(v: list[Any]) -> mpf:
        x, a = mpf(first(v)), mpf(second(v))
        if not (0 < a <= 1 and (x >= 0 if head is HMoment else x > 0)):
            raise NoValue(f"{e} is taken outside its domain")
        h = _stibbs_weir(a, mp.prec)
        if head is HIsotropic:
            return h(x)

        def integrand(w: mpf) -> mpf:
            return h(w) * (w**x if head is HMoment else 1 / (x + w))

        return tanh_sinh(integrand, mpf(0), mpf(1), mp.dps - 14)

    return f


for _head in (HIsotropic, HTransform, HMoment):
    SPECIAL[_head] = _balls
    HANDLERS[_head] = _digits

__all__ = ["HIsotropic", "HMoment", "HTransform", "StibbsWeir", "dispersion", "wiener_hopf"]
