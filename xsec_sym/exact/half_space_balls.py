"""Enclosures of the integrals over Chandrasekhar's H function, with all errors bounded.

With v = exp(-s) and t = exp(y) the Wiener-Hopf factor is a convolution,

    log H(exp(-s)) = -1 / (2 pi) int log K(exp(y)) sech(y - s) dy,   K(t) = 1 - a arctan(t) / t.

The trapezoidal rule of step h sums it. The outer integral over s uses Gauss-Legendre panels whose width is a multiple
of h, so that the values of log K are shared by all of them, and those of sech by all panels: every H on all panels
comes out of one product of matrices.

Bounds, for |arg t| <= 3 pi / 8. K is the mean over y in (0, 1) of (1 - a + p) / (1 + p), p = t^2 y^2. All these lie in
the sector between the directions 0 and arg p, whose half is at most 3 pi / 8, so that |K| is at least cos(3 pi / 8)
times the mean of their sizes. Since |1 - a + p| >= |p| / sqrt 2 and |1 + p| <= 1 + |p|, that is at least
min(1, |t|^2) / 23. From above |1 + p| >= cos(3 pi / 8) (1 + |p|) gives |K| <= 2.62. The argument of K is at most
3 pi / 4. So |log K| <= 5.5 + 2 max(0, -log|t|).

At its end the sum takes |log K| <= pi / t for real t > 0. Another K that keeps within these bounds may take the place
of this one (`h_lambert_sphere.py`).

Along the convolution this gives |H(z)| <= 9 max(1, |z|) for |arg z| <= 3 pi / 8, as int_0^oo y sech y dy < 1.84.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import lru_cache, wraps
from typing import Any

from flint import arb, arb_mat, ctx

from xsec_sym.proof.ball_compile import precision

RATIO = 27  # the width of a panel over the step
SHIFT = "1.178"  # a little less than 3 pi / 8, the half width of the strip in which all is bounded
LARGEST = 9  # of |H| / max(1, |z|) in that strip
LEVELS = (76, 134, 200)  # bits that are worked with, so that the meshes are few; their cost grows with the third power
LogK = Callable[[arb, arb], arb]  # log K of t and a, the bounds above holding for it
SMALL = arb(2) ** -6  # below this t, 1 - arctan(t) / t cancels and is summed as a series


class Mesh:
    """Nodes, weights and the errors that they leave, for results of about 2^-bits."""

    def __init__(self, bits: int) -> None:
        nats = (bits - 4) * arb(2).log()
        d = arb(SHIFT)
        self.h = h = _rounded(2 * arb.pi() * d / (nats + 6))
        half = RATIO * h / 2  # of a panel
        self.panels = int(float((nats + 4) / (2 * half))) + 1
        long = (half * half + d * d).sqrt()
        rho = (long + d) / half
        self.count = int(float((nats + 6) / (2 * rho.log()))) + 1
        self.below = int(float((nats + 8) / h)) + 1
        self.above = int(float((nats + 8) / (2 * h))) + 1 + RATIO
        # |f| <= size on an ellipse with the sum rho of its half-axes: a Chebyshev series cut off at 2 n terms is
        # wrong by 2 size rho^(-2 n) / (1 - 1 / rho), the rule with n nodes is exact on it, and its weights sum to 2
        self.gauss = half * 8 * rho ** (-2 * self.count) / (1 - 1 / rho) * self.panels
        self.overshoot = (long - half).exp()  # |z| on the ellipses is at most this
        self.offsets, self.weights = _gauss_legendre(self.count, half)
        # the cosines v = exp(-s), one row a node, one column a panel, and where they end
        self.places = [[(-(s + p * 2 * half)).exp() for p in range(self.panels)] for s in self.offsets]
        self.end = (-self.panels * 2 * half).exp()
        self.kernel = self._kernel()

    def error(self, u: arb) -> arb:
        """A ball about 0 for what the sum leaves out of log H(u)."""
        h, d, q = self.h, arb(SHIFT), (-self.h).exp()
        above = arb.max(arb(1), u)
        flat = arb("5.5") + 2 * above.log()  # |log K| <= flat + 2 max(0, s - y)
        # over the whole line, with |sech(y + i d)| <= sech(y) / cos(d) ...
        whole = 2 / d.cos() * (flat * arb.pi() + 2 * arb("1.84")) / ((2 * arb.pi() * d / h).exp() - 1)
        # ... and at its two ends, at the upper of which -log K <= pi u exp(s - y)
        low, high = (self.below + 1) * h, (self.above + 1 - RATIO) * h
        ends = h * 2 * (-low).exp() * ((flat + 2 * low) / (1 - q) + 2 * h * q / (1 - q) ** 2)
        ends += 2 * arb.pi() * above * h * (-2 * high).exp() / (1 - q * q)
        return arb(0, 1) * ((whole + ends) / (2 * arb.pi())).upper()

    def _kernel(self) -> arb_mat:
        """h / (2 pi) sech(k h - offset), one row a node, one column an index k of the window."""
        step, rows = self.h.exp(), []
        for offset in self.offsets:
            e = (-self.below * self.h - offset).exp()
            row = []
            for _ in range(-self.below, self.above + 1):
                row.append(self.h / (arb.pi() * (e + 1 / e)))
                e *= step
            rows.append(row)
        return arb_mat(rows)


def _rounded(x: arb) -> arb:
    """A nearby exact number, so that multiples of it are sharp."""
    return arb(int(float(x) * 2**20)) / 2**20


@lru_cache(maxsize=4)
def _gauss_legendre(count: int, half: arb) -> tuple[list[arb], list[arb]]:
    """Nodes and weights for the integral from 0 to 2 half."""
    nodes, weights = [], []
    for k in range(count):
        x, w = arb.legendre_p_root(count, k, weight=True)
        nodes.append(half * (1 + x))
        weights.append(half * w)
    return nodes, weights


@lru_cache(maxsize=4)
def mesh(bits: int) -> Mesh:
    return Mesh(bits)


def _log_dispersion(t: arb, a: arb) -> arb:
    if t > SMALL:
        return (1 - a * t.atan() / t).log()
    square, total, sign, k = t * t, arb(0), 1, 3
    term = square
    tiny = arb(2) ** (-ctx.prec - 8)
    while not term < tiny * square:
        total += sign * term / k
        term, sign, k = term * square, -sign, k + 2
    total += arb(0, 1) * term.upper()  # the terms alternate and fall
    return ((1 - a) + a * total).log()


@lru_cache(maxsize=64)
def _found(log_k: LogK, middle: arb, radius: arb, bits: int) -> dict[int, arb]:
    return {}


def _logarithms(log_k: LogK, a: arb, low: int, high: int) -> list[arb]:
    """log K(exp(k h)) for low <= k < high."""
    m, known = mesh(ctx.prec), _found(log_k, arb(a.mid()), arb(a.rad()), ctx.prec)
    missing = [k for k in range(low, high) if k not in known]
    if missing:
        step, t = m.h.exp(), (missing[0] * m.h).exp()
        for k in range(missing[0], missing[-1] + 1):
            if k not in known:
                known[k] = log_k(t, a)
            t *= step
    return [known[k] for k in range(low, high)]


def _values(log_k: LogK, middle: arb, radius: arb, bits: int) -> list[list[arb]]:
    """H at every node of the mesh, by rows as its `places`."""
    m = mesh(bits)
    window = m.below + m.above + 1
    logs = _logarithms(log_k, arb(middle, radius), -m.below, m.above + 1 + (m.panels - 1) * RATIO)
    # on panel p, y - s = k h - offset with y = (k + p RATIO) h
    sums = m.kernel * arb_mat([[logs[p * RATIO + k] for p in range(m.panels)] for k in range(window)])
    error = m.error(arb(1))
    return [[(error - sums[i, p]).exp() for p in range(m.panels)] for i in range(m.count)]


def _at_a_level(f: Callable[..., arb]) -> Callable[..., arb]:
    """f at the next level of precision; beyond the last there is no enclosure."""

    @wraps(f)
    def worked(x: arb, a: arb, *rest: Any) -> arb:
        bits = next((level for level in LEVELS if level >= ctx.prec), None)
        if bits is None:
            return arb("nan")
        with precision(bits):
            return f(x, a, *rest)

    return worked


@_at_a_level
def value(u: arb, a: arb, log_k: LogK = _log_dispersion) -> arb:
    """H(u) for u > 0 and 0 <= a <= 1, from the Wiener-Hopf factor of K, the isotropic one or another one.

    >>> from flint import arb
    >>> value(arb(3), arb(0)).overlaps(arb(1))
    True
    """
    if not (u > 0 and a >= 0 and a <= 1):
        return arb("nan")
    m = mesh(ctx.prec)
    s = -u.log()
    first = int(float((s / m.h).floor().mid()))
    step, e = m.h.exp(), ((first - m.below) * m.h - s).exp()
    total = arb(0)
    for logarithm in _logarithms(log_k, a, first - m.below, first + m.above + 1):
        total += logarithm / (e + 1 / e)
        e *= step
    return (m.error(u) - m.h / arb.pi() * total).exp()


def _weighted(a: arb, log_k: LogK) -> list[tuple[arb, arb]]:
    """Every node v, with H(v) dv."""
    return _masses(log_k, arb(a.mid()), arb(a.rad()), ctx.prec)


@lru_cache(maxsize=64)
def _masses(log_k: LogK, middle: arb, radius: arb, bits: int) -> list[tuple[arb, arb]]:
    m, values = mesh(bits), _values(log_k, middle, radius, bits)
    return [
        (v, weight * v * h)
        for weight, places, row in zip(m.weights, m.places, values, strict=True)
        for v, h in zip(places, row, strict=True)
    ]


def _summed(terms: Iterable[arb], size: arb, rest: arb) -> arb:
    """A sum over the nodes, with the errors of a function that ``size`` bounds on the ellipses, and a tail."""
    error = (mesh(ctx.prec).gauss * size + rest).upper()
    return sum(terms, arb(0)) + arb(0, 1) * error


@_at_a_level
def transform(u: arb, a: arb, n: int = 0, log_k: LogK = _log_dispersion) -> arb:
    """The integral of v^n H(v) / (u + v) over v from 0 to 1, for u > 0 and 0 <= a <= 1.

    >>> from flint import arb
    >>> transform(arb(2), arb(0)).overlaps(arb(1.5).log())
    True
    """
    if not (u > 0 and a >= 0 and a <= 1):
        return arb("nan")
    m = mesh(ctx.prec)
    # Re v > 0 on the ellipses, so that |u + v| exceeds both u and |v|
    most = arb.min(arb(1), m.overshoot / u)
    size, rest = LARGEST * m.overshoot ** (n + 1) * most, LARGEST * m.end ** (n + 1) / u
    return _summed((f * v**n / (u + v) for v, f in _weighted(a, log_k)), size, rest)


@_at_a_level
def moment(n: arb, a: arb) -> arb:
    """The integral of v^n H(v) over v from 0 to 1, for n = 0, 1, 2, ... and 0 <= a <= 1."""
    if not (n.is_integer() and n >= 0 and a >= 0 and a <= 1):
        return arb("nan")
    m = mesh(ctx.prec)
    size = LARGEST * m.overshoot ** (n + 2)
    return _summed((f * v**n for v, f in _weighted(a, _log_dispersion)), size, LARGEST * m.end ** (n + 1))
