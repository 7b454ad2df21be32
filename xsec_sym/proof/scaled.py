"""The modified Bessel function without its exponential growth, which stays narrow on wide balls."""

from __future__ import annotations

from typing import Any

from flint import acb, arb
from sympy import Function

from xsec_sym.proof.ball_functions import TABLE


class ScaledBesselI(Function):
    """exp(-z) I_n(z) for an integer n >= 0."""

    nargs = 2

    @classmethod
    def eval(cls, n: Any, z: Any) -> None:
        return None


def scaled_bessel(n: int, z: acb) -> acb:
    """The ball of exp(-z) I_n(z), an entire function.

    It is the mean of exp(z (cos t - 1)) cos(nt). So for Re z >= x > 0 its derivative is at most the one at x of
    -exp(-z) I_0(z), which gives wide balls, over which Arb takes seconds, a mean value form.

    >>> scaled_bessel(0, acb(arb(100, 5), arb(0, 5))).real.rad() < 0.004
    True
    """
    if z.real.rad() < 1e-9 and z.imag.rad() < 1e-9:
        return z.bessel_i(n, scaled=True)
    low = arb(z.real.lower())
    if not low > 0:
        return acb(arb("nan"), arb("nan"))
    middle = acb(z.real.mid(), z.imag.mid())
    slope = (low.bessel_i(0, scaled=True) - low.bessel_i(1, scaled=True)).upper()
    steepest = acb(arb(0).union(slope).union(-slope), arb(0).union(slope).union(-slope))
    return middle.bessel_i(n, scaled=True) + (z - middle) * steepest


def _in_table(analytic: bool, n: acb, z: acb) -> acb:
    return scaled_bessel(int(float(n.real.mid())), z)


TABLE[ScaledBesselI] = _in_table
