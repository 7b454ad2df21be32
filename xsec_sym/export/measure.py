"""The largest error of a kernel against many digits of the verified form, and that form against its definition."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from mpmath import mp, mpf
from sympy import Expr, Integral, lambdify

from xsec_sym.exact import RingCrossSection
from xsec_sym.export import floats
from xsec_sym.export.kernel import Branch
from xsec_sym.export.special import plain
from xsec_sym.record.entry import Entry

SEED = 2016
POINTS = 1500
TYPES = (np.float64, np.float32)
# Where more is lost, the docstring tells errors as numbers too.
POOR = 1e4


def largest(function: Callable[..., Any], found: Sequence[Branch], count: int = POINTS) -> tuple[float, float]:
    """The largest error in units of the last place, for float64 and for float32, rounded up to a tenth."""
    return tuple(_largest(function, found, count, dtype) for dtype in TYPES)  # type: ignore[return-value]


def _largest(function: Callable[..., Any], found: Sequence[Branch], count: int, dtype: type[np.floating]) -> float:
    worst, _, _ = _judged(function, found, count, dtype)
    return math.ceil(10 * worst) / 10 if math.isfinite(worst) else worst


def judged(function: Callable[..., Any], found: Sequence[Branch], count: int) -> tuple[tuple[float, float], str]:
    """As `largest`, and what else is to be said of float64 where many digits are lost: errors as numbers, and NaN."""
    worst, (absolute, at), failed = _judged(function, found, count, np.float64)
    names = [s.name for s in found[0].domain.symbols]

    def said(point: floats.Point) -> str:
        return ", ".join(f"{name} = {x:.3g}" for name, x in zip(names, point, strict=True))

    told = ""
    if worst > POOR:
        told = f" As a number, the largest error in float64 is {absolute:.1e}, at {said(at)}."
    if failed:
        told += f" At {len(failed)} of {count} points a step leaves the range of numbers, such as {said(failed[0])}."
    rounded = math.ceil(10 * worst) / 10 if math.isfinite(worst) else worst
    return (rounded, _largest(function, found, count, np.float32)), told


def _judged(
    function: Callable[..., Any], found: Sequence[Branch], count: int, dtype: type[np.floating]
) -> tuple[float, tuple[float, floats.Point], list[floats.Point]]:
    """The largest error in units of the last place, the largest as a number with its point, and what gives none."""
    worst = 0.0
    absolute: tuple[float, floats.Point] = (0.0, ())
    failed: list[floats.Point] = []
    for branch in found:
        points = floats.points(branch.domain, count, SEED, dtype)
        if not points:
            continue
        values = function(*np.array(points, dtype).T)
        if values.dtype != dtype:
            raise AssertionError(f"{branch.label}: {values.dtype} came out for {np.dtype(dtype)}")
        for point, value in zip(points, values.tolist(), strict=True):
            if branch.form.is_infinite:
                worst = max(worst, 0.0 if value == float(branch.form) else math.inf)
                continue
            reference = floats.exact(plain(branch.form), branch.domain.symbols, point)
            # beside a bound that is itself computed, rounding may put an argument outside
            lost = value != value and bool(branch.domain.conditions)
            if reference is not None and not lost:
                worst = max(worst, floats.ulps(value, reference, dtype))
                if math.isfinite(value):
                    absolute = max(absolute, (float(abs(value - reference)), point))
                elif value != float(reference):
                    failed.append(point)
    return worst, absolute, failed


def integrand(entry: Entry) -> tuple[Expr, Any, Any] | None:
    """D, its variable and the viewer's cosine, of an entry that defines a cross-section over rings."""
    left = entry.side("left")
    if not isinstance(left, Integral) or len(left.limits) != 1:
        return None
    x = left.limits[0][0]
    rings = [a for a in left.function.atoms(RingCrossSection) if a.args[0] == x]
    if len(rings) != 1 or left.limits[0][1:] != (-1, 1):
        return None
    return left.function / rings[0], x, rings[0].args[1]


def by_definition(density: Callable[[mpf], mpf], u: float, places: int = 20) -> mpf:
    """The projected area of all normals on the viewer's side, with the polar axis turned toward the viewer.

    Nothing is clamped there, and nothing is shared with the proof that led to the closed form.

    >>> with mp.workdps(15):
    ...     print(mp.nstr(by_definition(lambda x: x**2, 1.0) / mp.pi, 12))
    0.5
    """
    with mp.workdps(places):
        seen = mpf(u)
        tilt = mp.sqrt((1 - seen) * (1 + seen))

        def over_azimuth(mu: mpf) -> mpf:
            height = tilt * mp.sqrt((1 - mu) * (1 + mu))
            return 2 * mu * mp.quad(lambda phi: density(seen * mu + height * mp.cos(phi)), [0, mp.pi / 2, mp.pi])

        return mp.quad(over_azimuth, [0, 0.5, 1])


def disagreement(entry: Entry, branch: Branch, at: Sequence[float]) -> float:
    """The largest relative difference between a verified form and the definition on the entry's left side."""
    found = integrand(entry)
    if found is None:
        raise ValueError(f"{entry.id} is no integral over rings")
    density, x, _ = found
    function = lambdify(x, density, modules="mpmath")
    worst = 0.0
    for u in at:
        closed = floats.exact(branch.form, branch.domain.symbols, (u,))
        if closed is None:
            raise ValueError(f"{entry.id} has no value at {u}")
        worst = max(worst, float(abs(by_definition(function, u) / closed - 1)))
    return worst
