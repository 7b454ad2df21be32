"""The H functions of the three-term half-space at 30 digits: Fock's integral of the K that deon2021 prints.

log H(mu) = -(mu/pi) int_0^inf log K(t)/(1 + mu^2 t^2) dt, by the trapezoidal rule in log t, for all of log K: nothing
is taken out of it, as the kernel does, and K is (24) to (26), in as many digits as t^5 cancels. `by_parts` is the same
integral by another rule.
"""

from functools import cache

from mpmath import mp, mpf

DIGITS = 40
STEP = mpf(1) / 8
TAIL = 75


@cache
def node(j):
    """t and arctan t, in digits to spare for the differences in K."""
    with mp.workdps(DIGITS + max(0, int(-4 * j * STEP))):
        t = mp.exp(j * STEP)
        return t, mp.atan(t)


def k_of(mode, c, t, arctan):
    if mode == 0:
        q = (c - 1) * (4 * c + 9)
        inner = (256 * c - 301) * t**3 + 15 * q * t
        inner += ((346 - c * (20 * c + 281)) * t**2 - 15 * q + 207 * t**4) * arctan
        return 1 - c * inner / (192 * t**5)
    if mode == 1:
        inner = (40 * c + 282) * t**3 - 3 * (t**2 + 1) * (20 * c + 64 * t**2 + 45) * arctan + 15 * (4 * c + 9) * t
        return 1 - c * inner / (288 * t**5)
    return 1 - 5 * c * (3 * (t**2 + 1) ** 2 * arctan - t * (5 * t**2 + 3)) / (128 * t**5)


def characteristic(mode, c, x):
    if mode == 0:
        return c / 384 * (-15 * (c - 1) * (4 * c + 9) * x**4 + (c * (20 * c + 281) - 346) * x**2 + 207)
    if mode == 1:
        return -c / 192 * (x**2 - 1) * (5 * (4 * c + 9) * x**2 - 64)
    return 15 * c / 256 * (x**2 - 1) ** 2


class Solution:
    """H of one order at one albedo, with the logarithms kept."""

    def __init__(self, c, mode):
        self.c, self.mode, self.logarithms = mpf(float(c)), mode, {}

    def logarithm(self, j):
        if j not in self.logarithms:
            with mp.workdps(DIGITS + max(0, int(-4 * j * STEP))):
                self.logarithms[j] = mp.log(k_of(self.mode, self.c, *node(j)))
        return self.logarithms[j]

    def h(self, mu):
        mu = mu if isinstance(mu, mpf) else mpf(float(mu))
        with mp.workdps(DIGITS):
            if mu < mpf("1e-35"):
                return mpf(1)
            size = mp.log(mu)
            low, high = -TAIL - max(size, 0), (TAIL - min(size, 0)) / 2
            total = mpf(0)
            for j in range(int(low / STEP) - 1, int(high / STEP) + 2):
                x = mu * node(j)[0]
                total += x / (1 + x * x) * self.logarithm(j)
            return mp.exp(-total * STEP / mp.pi)


@cache
def at(c, mode):
    return Solution(c, mode)


def h(mu, c, mode):
    return at(float(c), int(mode)).h(mu)


def by_parts(mu, c, mode):
    """The same integral with t = tan(theta), by the tanh-sinh rule in pieces: to 20 digits, for mu near 1."""
    mu, c = mpf(mu), mpf(float(c))

    def integrand(theta):
        with mp.workdps(150):
            t = mp.tan(theta)
            k = k_of(mode, c, t, mp.atan(t))
        return mp.log(k) / (mp.cos(theta) ** 2 + mu**2 * mp.sin(theta) ** 2)

    with mp.workdps(25):
        edges = [mpf(0), mpf("1e-8"), mpf("1e-4"), mpf("0.05"), mp.pi / 4, mp.pi / 2]
        return mp.exp(-mu / mp.pi * mp.quad(integrand, edges))
