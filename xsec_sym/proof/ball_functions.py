"""Functions on balls, each told whether it must be holomorphic on its whole argument.

Under an integral, Arb asks with ``analytic`` true for values that hold only if the integrand is holomorphic
on the whole ball; a function with a branch cut then answers "not a number" when the ball may touch the cut.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import sympy as sp
from flint import acb, arb
from sympy import S

from xsec_sym.proof.magnitude import Magnitude

NAN = acb(arb("nan"), arb("nan"))


def _meets(z: acb, low: float | None, high: float | None) -> bool:
    """Whether a ball may touch the real points <= low or >= high."""
    if not z.imag.contains(0):
        return False
    return bool((low is not None and not z.real > low) or (high is not None and not z.real < high))


def _cut(call: Callable[..., acb], low: float | None, high: float | None, turned: bool = False) -> Callable[..., acb]:
    def f(a: bool, z: acb, *rest: acb) -> acb:
        w = z * acb(0, 1) if turned else z
        if a:
            return NAN if _meets(w, low, high) else call(z, *rest)
        # on the cut itself libraries choose different sides, so a value there is nobody's definition
        if w.imag.is_zero() and ((low is not None and w.real < low) or (high is not None and w.real > high)):
            return NAN
        return call(z, *rest)

    return f


def whole(n: acb) -> bool:
    return bool(n.is_exact() and n.imag.is_zero() and n.real.is_integer())


def _plain(name: str) -> Callable[..., acb]:
    method = getattr(acb, name)
    return lambda a, z: method(z)


def _order(name: str, entire: bool) -> Callable[..., acb]:
    """Bessel functions: holomorphic off the negative axis, and everywhere for J and I of integer order."""
    method = getattr(acb, name)

    def f(a: bool, n: acb, z: acb) -> acb:
        smooth = entire and whole(n)
        return NAN if a and not smooth and _meets(z, 0, None) else method(z, n)

    return f


def _degree(name: str) -> Callable[..., acb]:
    method = getattr(acb, name)

    def f(a: bool, n: acb, z: acb) -> acb:
        smooth = whole(n)
        return NAN if a and not smooth and _meets(z, -1, None) else method(z, n)

    return f


def real_only(call: Callable[[acb, bool], acb]) -> Callable[..., acb]:
    return lambda a, z: call(z, a) if a or z.imag.contains(0) else NAN


def _abs(a: bool, z: acb) -> acb:
    return z.real_abs(analytic=a) if a or z.imag.is_zero() else acb(abs(z))


def _heaviside(a: bool, z: acb, at_zero: acb) -> acb:
    if z.real > 0:
        return acb(1)
    if z.real < 0:
        return acb(0)
    if a or not z.imag.contains(0):
        return NAN
    return at_zero if z.is_zero() else acb(0).union(acb(1)).union(at_zero)


def _ei(a: bool, z: acb) -> acb:
    # for z < 0, Ei(z) = -E1(-z), which unlike Ei is holomorphic about the negative axis
    if z.real < 0:
        return -(-z).expint(1) if a or z.imag.is_zero() else NAN
    return NAN if a and _meets(z, 0, None) else z.ei()


def _expint(a: bool, n: acb, z: acb) -> acb:
    return NAN if a and _meets(z, 0, None) else z.expint(n)


def _atan2(a: bool, y: acb, x: acb) -> acb:
    if not a and not (x.imag.is_zero() and y.imag.is_zero()):
        return NAN
    if x.real > 0:
        return _CUT_ATAN(a, y / x)
    if y.real > 0:
        return acb.pi() / 2 - _CUT_ATAN(a, x / y)
    if y.real < 0:
        return -acb.pi() / 2 - _CUT_ATAN(a, x / y)
    return NAN if a else acb(arb.atan2(y.real, x.real))


def hyper(a: bool, z: acb, top: Sequence[acb], low: Sequence[acb]) -> acb:
    ends = any(whole(p) and p.real <= 0 for p in top)
    if len(top) > len(low) + 1 and not ends:
        return NAN
    if len(top) > len(low) and not ends and (_meets(z, None, 1) if a else z.imag.is_zero() and z.real > 1):
        return NAN
    if len(top) == 2 and len(low) == 1:
        return z.hypgeom_2f1(top[0], top[1], low[0])
    return z.hypgeom(list(top), list(low))


def _polylog(a: bool, s: acb, z: acb) -> acb:
    return _cut(lambda w: w.polylog(s), None, 1)(a, z)


def _elliptic(*names: str) -> Callable[..., acb]:
    def f(a: bool, *z: acb) -> acb:
        if len(z) == 1:
            return _cut(getattr(acb, names[0]), None, 1)(a, z[0])
        return NAN if a else getattr(acb, names[1])(*z)

    return f


_CUT_ATAN = _cut(acb.atan, -1, 1, turned=True)
_SAME_NAME = (
    *("sin", "cos", "tan", "cot", "sec", "csc", "sinh", "cosh", "tanh", "coth", "sech", "csch"),
    *("erf", "erfc", "erfi", "gamma", "digamma", "sinc"),
)
TABLE: dict[Any, Callable[..., acb]] = {
    sp.exp: _plain("exp"),
    sp.log: lambda a, z: z.log(analytic=a),
    **{getattr(sp, name): _plain(name) for name in _SAME_NAME},
    sp.asin: _cut(acb.asin, -1, 1),
    sp.acos: _cut(acb.acos, -1, 1),
    sp.atan: _CUT_ATAN,
    sp.acot: lambda a, z: _CUT_ATAN(a, 1 / z),
    sp.asinh: _cut(acb.asinh, -1, 1, turned=True),
    sp.acosh: lambda a, z: NAN if a and _meets(z, 1, None) else z.acosh(),
    sp.atanh: _cut(acb.atanh, -1, 1),
    sp.atan2: _atan2,
    sp.loggamma: _cut(acb.lgamma, 0, None),
    sp.polygamma: lambda a, n, z: NAN if a and not whole(n) else z.polygamma(n),
    sp.factorial: lambda a, z: (z + 1).gamma(),
    sp.binomial: lambda a, n, k: (n + 1).gamma() * (k + 1).rgamma() * (n - k + 1).rgamma(),
    sp.RisingFactorial: lambda a, z, n: z.rising(n),
    sp.FallingFactorial: lambda a, z, n: (z - n + 1).rising(n),
    sp.besselj: _order("bessel_j", True),
    sp.besseli: _order("bessel_i", True),
    sp.besselk: _order("bessel_k", False),
    sp.bessely: _order("bessel_y", False),
    sp.polylog: _polylog,
    sp.zeta: lambda a, s, *q: NAN if a and q else s.zeta(*q),
    sp.legendre: _degree("legendre_p"),
    sp.chebyshevt: _degree("chebyshev_t"),
    sp.chebyshevu: _degree("chebyshev_u"),
    sp.Ei: _ei,
    sp.expint: _expint,
    sp.elliptic_k: _elliptic("elliptic_k"),
    sp.elliptic_e: _elliptic("elliptic_e", "elliptic_e_inc"),
    sp.elliptic_f: lambda a, p, m: NAN if a else p.elliptic_f(m),
    sp.Abs: _abs,
    Magnitude: _abs,
    sp.sign: real_only(lambda z, a: z.real_sgn(analytic=a)),
    sp.floor: real_only(lambda z, a: z.real_floor(analytic=a)),
    sp.ceiling: real_only(lambda z, a: z.real_ceil(analytic=a)),
    sp.Heaviside: _heaviside,
    sp.re: lambda a, z: NAN if a else acb(z.real),
    sp.im: lambda a, z: NAN if a else acb(z.imag),
}
CONSTANTS: dict[Any, Callable[[], acb]] = {
    S.Pi: acb.pi,
    S.Exp1: lambda: acb(1).exp(),
    S.EulerGamma: lambda: acb(arb.const_euler()),
    S.Catalan: lambda: acb(arb.const_catalan()),
    S.GoldenRatio: lambda: (1 + acb(5).sqrt()) / 2,
    S.ImaginaryUnit: lambda: acb(0, 1),
}
