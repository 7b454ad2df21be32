"""Upper bounds on |f| over a rectangle, from the values of f at a few points and a crude bound in the complex plane.

A function that is holomorphic, and at most M in modulus, on the Bernstein ellipse of parameter rho about an interval
differs from its interpolant at n + 1 Chebyshev points by at most 4 M rho^-n / (rho - 1) (Trefethen, Approximation
Theory and Approximation Practice, theorem 8.2). In two variables f - I_x I_y f = (f - I_x f) + I_x (f - I_y f), and
I_x has a norm of at most 1 + (2 / pi) log(n + 1). The supremum of a polynomial of degree n is at most its largest
modulus at the zeros of T_N divided by cos(n pi / 2N) (Ehlich and Zeller 1964). So the values may be as sharp as the
truth, while M may be wrong by orders of magnitude: it costs a few points more.

The polynomials are summed in double precision; the allowance for that is part of the bound.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, cos, inf, log, pi
from typing import Any

import numpy as np
from flint import acb, arb

from xsec_sym.proof.ball_compile import NoEnclosure, precision

BITS, ROUGH = 96, 60  # for values and for bounds
ELLIPSES = (5.0, 3.5, 2.6, 2.0, 1.6, 1.3, 1.12)
MOST = 48  # the highest degree; beyond it the rectangle is to be divided
USELESS = 1e15  # a bound that is larger costs more points than a smaller ellipse
DEPTH = 7  # how often a box is halved on which the function has no finite bound


class NoBound(NoEnclosure):
    """No bound could be had; the message says why in one sentence."""


@dataclass(frozen=True)
class Surface:
    """A real function of two variables: its balls at points, and a bound on its modulus on complex boxes.

    ``majorant`` is not finite where the function may fail to be holomorphic. ``removable`` is a value of the second
    variable at which that does not count: the function is bounded there, and holomorphic all around.
    """

    value: Callable[[arb, arb], arb]
    majorant: Callable[[acb, acb], arb]
    removable: float | None = None


@dataclass(frozen=True)
class Panel:
    """An interpolant of a surface on a rectangle, and by how much it may be wrong."""

    x: tuple[float, float]
    y: tuple[float, float]
    coefficients: np.ndarray
    error: float

    def at(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """The interpolant on the grid of all pairs."""
        n, k = self.coefficients.shape
        across = np.polynomial.chebyshev.chebvander(_to_unit(x, self.x), n - 1)
        return across @ self.coefficients @ np.polynomial.chebyshev.chebvander(_to_unit(y, self.y), k - 1).T

    def bound(self, y: tuple[float, float] | None = None, sharp: int = 60) -> float:
        """An upper bound on |f| where the second variable is in ``y``; ``sharp`` points are spent per degree."""
        y = self.y if y is None else y
        degrees = [d - 1 for d in self.coefficients.shape]
        counts = [max(1, sharp * d) for d in degrees]
        loss = np.prod([cos(d * pi / (2 * n)) for d, n in zip(degrees, counts, strict=True)])
        top = np.abs(self.at(_zeros(counts[0], self.x), _zeros(counts[1], y))).max()
        return float(top / loss * (1 + 1e-12) + self.error)

    def peak(self, y: tuple[float, float]) -> tuple[float, float, float]:
        """About the largest |f|, with where it is."""
        xs, ys = np.linspace(*self.x, 1201), np.linspace(*y, 41)
        found = np.abs(self.at(xs, ys))
        i, j = np.unravel_index(found.argmax(), found.shape)
        return float(found[i, j]), float(xs[i]), float(ys[j])

    def largest(self, y: float) -> tuple[float, float]:
        """About the largest |f| on one line, with where it is."""
        size, x, _ = self.peak((y, y))
        return size, x


def panels(f: Surface, x: tuple[float, float], y: tuple[float, float], error: float, depth: int = 6) -> Iterator[Panel]:
    """Interpolants with at most this error that cover a rectangle, which is halved as long as none can be had.

    >>> from flint import arb, acb
    >>> sine = Surface(lambda x, y: x.sin(), lambda x, y: arb(x.sin().abs_upper()))
    >>> [panel] = panels(sine, (0.0, 1.5), (0.0, 0.0), 1e-9)
    >>> 0 < panel.bound() - 0.99749498660405 < 1e-3
    True
    """
    try:
        with precision(BITS):
            made = _panel(f, x, y, error)
    except NoBound:
        if not depth:
            raise
        # an interval is halved where that helps: in proportion for the second variable, which may run over decades
        first, second = _degree(f, x, y, error, True)[0], _degree(f, x, y, error, False)[0]
        if first >= second:
            middle = (x[0] + x[1]) / 2
            halves = [((x[0], middle), y), ((middle, x[1]), y)]
        else:
            middle = (y[0] * y[1]) ** 0.5 if y[0] > 0 else (y[0] + y[1]) / 2
            halves = [(x, (y[0], middle)), (x, (middle, y[1]))]
        for a, b in halves:
            yield from panels(f, a, b, error, depth - 1)
        return
    yield made


def _panel(f: Surface, x: tuple[float, float], y: tuple[float, float], error: float) -> Panel:
    n, off_x = _degree(f, x, y, error / 3, True)
    k, off_y = _degree(f, x, y, error / (3 * _norm(n)), False)
    if n > MOST or k > MOST:
        raise NoBound(f"no interpolant of degree {MOST} reaches {error:.1e} on x in {x}, y in {y}")
    xs, ys = _nodes(n, x), _nodes(k, y)
    balls = [[f.value(a, b) for b in ys] for a in xs]
    if not all(v.is_finite() for row in balls for v in row):
        raise NoBound(f"a value on x in {x}, y in {y} is not finite")
    values = np.array([[float(v.mid()) for v in row] for row in balls])
    blur = max(float(v.rad()) for row in balls for v in row)
    coefficients = _transform(n) @ values @ _transform(k).T
    top = float(np.abs(values).max())
    # sums of products of values and cosines: each is exact to a few units in the last place of the largest term
    rounding = 2.0**-52 * 16 * (n + k + 2) * (n + 1) * (k + 1) * top
    whole = off_x + _norm(n) * off_y + _norm(n) * _norm(k) * (blur + 2.0**-52 * top) + rounding
    if whole > error:
        raise NoBound(f"the values on x in {x}, y in {y} are too wide")
    return Panel(x, y, coefficients, whole)


def _norm(n: int) -> float:
    return 1 + 2 / pi * log(n + 1) if n else 1.0


def _transform(n: int) -> np.ndarray:
    """From the values at the zeros of T_{n+1} to the coefficients of T_0 ... T_n."""
    angles = (np.arange(n + 1) + 0.5) * pi / (n + 1)
    found = 2 / (n + 1) * np.cos(np.outer(np.arange(n + 1), angles))
    found[0] /= 2
    return found


def _nodes(n: int, ends: tuple[float, float]) -> list[arb]:
    middle, half = _middle(ends)
    return [middle + half * ((arb(2 * i + 1) / (2 * n + 2)) * arb.pi()).cos() for i in range(n + 1)]


def _middle(ends: tuple[float, float]) -> tuple[arb, arb]:
    return (arb(ends[0]) + arb(ends[1])) / 2, (arb(ends[1]) - arb(ends[0])) / 2


def _zeros(n: int, ends: tuple[float, float]) -> np.ndarray:
    angles = (np.arange(n) + 0.5) * pi / n
    return (ends[0] + ends[1]) / 2 + (ends[1] - ends[0]) / 2 * np.cos(angles)


def _to_unit(t: np.ndarray, ends: tuple[float, float]) -> np.ndarray:
    low, high = ends
    return np.zeros_like(t) if low == high else np.clip((2 * t - low - high) / (high - low), -1, 1)


# --- bounds on ellipses -------------------------------------------------------------------------------


def _degree(f: Surface, x: tuple[float, float], y: tuple[float, float], error: float, first: bool) -> tuple[int, float]:
    """The degree that is enough in one variable, with its error, the other variable being real."""
    own, other = (x, y) if first else (y, x)
    if own[0] == own[1]:
        return 0, 0.0
    best: tuple[int, float] = (10**9, inf)
    for rho in ELLIPSES:
        limit = float(min(USELESS, rho ** min(best[0], MOST) * (rho - 1) * error / 4))
        with precision(ROUGH):
            size = _on_ellipse(f, own, other, rho, first, limit)
        if size == inf:
            continue
        n = max(1, ceil(log(max(4 * size / ((rho - 1) * error), 1.0)) / log(rho) + 1e-9))
        if n < best[0]:
            best = n, 4 * size * rho**-n / (rho - 1) * (1 + 1e-9)
        elif n > best[0] + 4:
            break
    return best


def _on_ellipse(
    f: Surface, own: tuple[float, float], other: tuple[float, float], rho: float, first: bool, limit: float
) -> float:
    """A bound on |f| in the ellipse about one interval while the other variable runs over its own interval.

    Infinity as soon as it is seen to exceed the limit, beyond which this ellipse is of no use.
    """
    middle, half = _middle(own)
    across = _strips(f, other, first)
    largest = 0.0
    arcs, layers = 12, 2
    top = arb(rho).log()
    # the top of the ellipse first, where most functions are largest
    for i in sorted(range(arcs), key=lambda i: abs(2 * i + 1 - arcs)):
        for j in reversed(range(layers)):
            for strip in across:
                box = (arb.pi() * i / arcs, arb.pi() * (i + 1) / arcs, top * j / layers, top * (j + 1) / layers)
                here = _in_box(f, box, middle, half, strip, first, 0)
                if here > limit:
                    return inf
                largest = max(largest, here)
    return largest


def _strips(f: Surface, ends: tuple[float, float], first: bool) -> list[acb]:
    """Boxes that cover an interval; about the removable point, a circle whose maximum bounds all that is inside."""
    if ends[0] == ends[1]:
        return [acb(arb(ends[0]))]
    cuts = [arb(ends[0]) + (arb(ends[1]) - arb(ends[0])) * i / 4 for i in range(5)]
    found: list[acb] = []
    for low, high in pairwise(cuts):
        if first and f.removable is not None and not (low > f.removable or high < f.removable):
            radius = 3 * (high - low) / 2
            angles = [arb.pi() * i / 12 for i in range(13)]
            found += [f.removable + radius * acb(0, a.union(b)).exp() for a, b in pairwise(angles)]
        else:
            found.append(acb(low.union(high)))
    return found


def _in_box(f: Surface, box: tuple[arb, ...], middle: arb, half: arb, strip: acb, first: bool, depth: int) -> float:
    a, b, c, d = box
    z = middle + half * acb(a.union(b), c.union(d)).cos()
    size = f.majorant(z, strip) if first else f.majorant(strip, z)
    if size.is_finite():
        return float(size.upper()) * (1 + 1e-15)
    if f.removable is not None and not first and abs(z - f.removable) < half / 16:
        return 0.0  # by the maximum principle the boxes around this one bound the function here as well
    if depth == DEPTH:
        return inf
    p, q = (a + b) / 2, (c + d) / 2
    quarters = ((a, p, c, q), (a, p, q, d), (p, b, c, q), (p, b, q, d))
    sizes = []
    for quarter in quarters:
        sizes.append(_in_box(f, quarter, middle, half, strip, first, depth + 1))
        if sizes[-1] == inf:
            return inf
    return max(sizes)


def compiled(run: Callable[..., Any]) -> tuple[Callable[[arb, arb], arb], Callable[[acb, acb], arb]]:
    """Value and majorant of a compiled expression of two variables."""

    def value(x: arb, y: arb) -> arb:
        out = run((acb(x), acb(y)), False)
        return out.real if out.imag.contains(0) else arb("nan")

    def majorant(x: acb, y: acb) -> arb:
        out = run((x, y), True)
        return arb(abs(out).upper()) if out.is_finite() else arb("nan")

    return value, majorant
