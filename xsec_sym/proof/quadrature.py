"""Quadrature with mpmath numbers that refuses what it cannot sum, a divergent integral above all.

Both rules use a lopsided change of variable first, lest the poles of an odd integrand cancel.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from math import asinh, log

from mpmath import mp, mpf

Function = Callable[[mpf], mpf]


class NoValue(ArithmeticError):
    """Two evaluations disagree, or an expression cannot be evaluated; the message says which."""


class AtEnd(NoValue):
    """What an integrand does at the end of its range is not yet negligible."""


@dataclass
class Memory:
    """What earlier integrals of a family showed: the size that was enough, and the largest integral of a modulus."""

    size: int = 1
    peak: mpf = field(default_factory=lambda: mpf(0))


def _step(level: int, stride: int) -> mpf:
    return mpf(13 if stride == 0 else 10) / 13 / 2**level


@lru_cache(maxsize=64)
def _steps(level: int, reach: tuple[int, int], stride: int) -> list[tuple[int, mpf, mpf]]:
    """The new nodes of a level, inside out: the end they belong to, their distance from it, their weight."""
    with mp.workprec(max(reach)):
        pi, h = +mp.pi, _step(level, stride)
        last = [int(asinh(bits * log(2) / float(pi)) / float(h)) for bits in reach]
        nodes = []
        for k in range(0 if level == 2 else 1, max(last) + 1, 1 if level == 2 else 2):
            e = mp.exp(k * h)
            q = mp.exp(-pi * (e - 1 / e) / 2)
            near = q / (1 + q)
            weight = pi * (e + 1 / e) / 2 * near * (1 - near)
            nodes += [(end, near, weight / 2 if k == 0 else weight) for end in (0, 1) if k <= last[end]]
        return nodes


def tanh_sinh(f: Function, a: mpf, b: mpf, digits: int, stride: int = 0, seen: Memory | None = None) -> mpf:
    """The integral of ``f`` from a to b, which may be infinite, to ``digits`` relative to that of its modulus.

    Two values of ``stride``, 0 and 1, share no node, so that they may check one another.  What is negligible
    beside the integrals already ``seen`` need not settle by itself.

    >>> tanh_sinh(lambda x: 1 / x, mpf(0), mpf(1), 12)
    Traceback (most recent call last):
    ...
    xsec_sym.proof.quadrature.AtEnd: the terms at an end of (0.0, 1.0) are not negligible
    """
    if mp.isinf(a) and mp.isinf(b):
        return tanh_sinh(f, a, mpf(0), digits, stride, seen) + tanh_sinh(f, mpf(0), b, digits, stride, seen)
    if mp.isinf(a):
        return tanh_sinh(lambda x: f(-x), -b, mpf("inf"), digits, stride, seen)
    seen = seen or Memory()
    bits, deep = mp.prec, (a == 0, b == 0 or mp.isinf(b))
    try:
        return _sums(f, a, b, digits, (bits, bits), stride, seen)
    except (AtEnd, ZeroDivisionError):
        pass
    try:
        # a slow singularity: nodes nearer to an end at 0 or infinity than the working precision could tell
        return _sums(f, a, b, digits, (4 * bits if deep[0] else bits, 4 * bits if deep[1] else bits), stride, seen)
    except (AtEnd, ZeroDivisionError):
        # an integrand that cancels at its end, as (exp(x) - 1 - x)/x^2 does
        with mp.workprec(3 * bits):
            return _sums(f, a, b, digits, (bits, bits), stride, seen)


def _sums(f: Function, a: mpf, b: mpf, digits: int, reach: tuple[int, int], stride: int, seen: Memory) -> mpf:
    tol, width, half, before = mpf(10) ** -digits, b - a, mp.isinf(b), mpf(0)
    tilt = mpf(1) / 11

    def term(end: int, d: mpf, w: mpf) -> mpf:
        if half:
            # x - a = s / (1 - s), with s counted from the nearer end
            s = d / (1 - d) if end == 0 else (1 - d) / d
            return f(a + s) * w * (1 + s) ** 2
        if end == 0:
            return f(a + width * d * (1 + tilt - tilt * d)) * w * (1 + tilt - 2 * tilt * d) * width
        return f(b - width * d * (1 - tilt + tilt * d)) * w * (1 - tilt + 2 * tilt * d) * width

    total = size = mpf(0)
    change = mpf(1)
    for level in range(2, 10):
        h = _step(level, stride)
        nodes = _steps(level, reach, stride)
        terms = [term(*node) for node in nodes]
        total += mp.fsum(terms)
        size += mp.fsum(terms, absolute=True)
        if not mp.isfinite(size):
            raise NoValue(f"the integrand is infinite or undefined inside ({a}, {b})")
        ends = [[abs(t) for t, node in zip(terms, nodes, strict=True) if node[0] == end][-2:] for end in (0, 1)]
        last, change = change, abs(total * h - before) / (max(size * h, seen.peak) or 1)
        # the error nearly squares from level to level once it has begun to
        settled = level > 3 and (change <= tol or (change <= last**1.6 and change**1.7 <= tol))
        outer = max(map(max, ends))
        if outer > tol * max(size * h, seen.peak) * (1 if settled else 10**6) and level > (3 if settled else 4):
            raise AtEnd(f"the terms at an end of ({a}, {b}) are not negligible")
        if settled:
            seen.peak = max(seen.peak, size * h)
            return total * h
        before = total * h
    raise NoValue(f"the sums over ({a}, {b}) do not settle")


_SIZES = ((10, 16, 24, 36, 54, 80), (11, 17, 26, 39, 58, 86))


@lru_cache(maxsize=64)
def _legendre_nodes(n: int, bits: int) -> list[tuple[mpf, mpf]]:
    with mp.workprec(bits + 20):
        nodes = []
        for k in range(n):
            x = mp.cos(mp.pi * (k + mpf(3) / 4) / (n + mpf(1) / 2))
            for _ in range(60):
                p, q = mpf(1), mpf(0)
                for j in range(n):
                    p, q = ((2 * j + 1) * x * p - j * q) / (j + 1), p
                slope = n * (x * p - q) / (x * x - 1)
                step = p / slope
                x -= step
                if abs(step) < mpf(2) ** (-bits // 2 - 12):
                    break
            p, q = mpf(1), mpf(0)
            for j in range(n):
                p, q = ((2 * j + 1) * x * p - j * q) / (j + 1), p
            slope = n * (x * p - q) / (x * x - 1)
            s = (1 + x) / 2
            w = 1 / ((1 - x * x) * slope * slope)
            nodes.append((s * (mpf(11) / 10 - s / 10), w * (mpf(11) / 10 - s / 5)))
        return nodes


def legendre(f: Function, a: mpf, b: mpf, digits: int, seen: Memory, stride: int = 0) -> mpf:
    """As ``tanh_sinh``, for a family of integrands smooth up to both ends, to ``digits`` relative to the largest."""
    tol, width, before = mpf(10) ** -digits, b - a, None
    for i in range(max(0, seen.size - 1), len(_SIZES[0])):
        terms = [f(a + width * s) * w for s, w in _legendre_nodes(_SIZES[stride][i], mp.prec)]
        total = mp.fsum(terms)
        size = mp.fsum(terms, absolute=True)
        if size == 0:
            return total
        seen.peak = max(seen.peak, size * width)
        if before is not None and (abs(total - before) * width / seen.peak) ** 1.4 <= tol:
            seen.size = i
            return total * width
        before = total
    seen.size = 1
    return tanh_sinh(f, a, b, digits, stride, seen)
