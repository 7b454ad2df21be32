"""Chandrasekhar's H for isotropic scattering at 30 digits, by the integral of V. A. Fock.

log H(mu) = -(mu/pi) int_0^inf log(1 - c arctan(t)/t)/(1 + mu^2 t^2) dt shares nothing with the kernel's tables: neither
the cut, nor the pole, nor a point. With t = exp(s) every singularity of the integrand is at Im s = pi/2 or beyond,
however near c is to 1 and mu to 0, so that the trapezoidal rule of step h is right to exp(-pi^2/h).
"""

from functools import cache

import numpy as np
from mpmath import mp, mpf

DIGITS = 45
STEP = mpf(1) / 8  # exp(-8 pi^2) = 5e-35
# The trapezoidal sum is cut where what is left out is below exp(-TAIL) = 1e-35, of log H.
TAIL = 81
FLOOR = mpf("1e-40")


@cache
def node(j):
    """t = exp(j h), and 1 - arctan(t)/t, by its series where digits would cancel."""
    with mp.workdps(DIGITS):
        t = mp.exp(j * STEP)
        if t > mpf("1e-3"):
            return t, 1 - mp.atan(t) / t
        square = t * t
        return t, mp.fsum((-1) ** (n + 1) * square**n / (2 * n + 1) for n in range(1, 9))


@cache
def weights(mu):
    """The first j, and mu t/(1 + mu^2 t^2) from there on."""
    size = mp.log(mu)
    low, high = -TAIL - 5 - max(size, 0), (TAIL - min(size, 0)) / 2
    span = range(int(mp.floor(low / STEP)), int(mp.ceil(high / STEP)) + 1)
    arguments = (mu * node(j)[0] for j in span)
    return span.start, [x / (1 + x * x) for x in arguments]


class Albedo:
    """H at one albedo c, with the logarithms kept."""

    def __init__(self, c):
        self.c = mpf(float(c))
        self.logarithms = {}

    def logarithm(self, j):
        if j not in self.logarithms:
            self.logarithms[j] = mp.log((1 - self.c) + self.c * node(j)[1])
        return self.logarithms[j]

    def h(self, mu):
        """H(mu) for mu >= 0, a float, an mpf or infinite."""
        mu = mu if isinstance(mu, mpf) else mpf(float(mu))
        with mp.workdps(DIGITS):
            if mp.isinf(mu):
                return 1 / mp.sqrt(1 - self.c) if self.c < 1 else mp.inf
            if mu < FLOOR:
                # log H < 51 mu, which changes no digit of 30.
                return mpf(1)
            first, factors = weights(mu)
            total = mp.fdot((factor, self.logarithm(j)) for j, factor in enumerate(factors, first))
            return mp.exp(-total * STEP / mp.pi)


@cache
def at(c):
    return Albedo(c)


def h(mu, c):
    return at(float(c)).h(mu)


def brdf(mu_i, mu_o, c):
    with mp.workdps(DIGITS):
        return mpf(float(c)) / (4 * mp.pi) * h(mu_i, c) * h(mu_o, c) / (mpf(float(mu_i)) + mpf(float(mu_o)))


@cache
def unit_rule():
    """The tanh-sinh rule on [0, 1], right to 1e-30 for v H(v)/(mu + v) and mu >= 0.01."""
    nodes = []
    with mp.workdps(DIGITS):
        step = mpf(1) / 20
        for j in range(-80, 81):
            s, slope = mp.pi / 2 * mp.sinh(j * step), mp.pi / 2 * mp.cosh(j * step)
            v, rest = 1 / (1 + mp.exp(-2 * s)), 1 / (1 + mp.exp(2 * s))
            nodes.append((v, step * slope * 2 * v * rest))
    return nodes


def relative(value, exact):
    """|value/exact - 1|, 0 where both are infinite."""
    value = float(value)
    if mp.isinf(exact) or exact > np.finfo(float).max:
        return 0.0 if value == np.inf else np.inf
    with mp.workdps(DIGITS):
        return float(abs(mpf(value) / exact - 1)) if np.isfinite(value) else np.inf
