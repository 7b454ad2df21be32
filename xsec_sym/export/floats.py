"""How well an expression rounds: double arithmetic with correctly rounded functions against values of many digits.

The elementary functions of NumPy differ in their last bits from one processor to the next. The choice between forms
must not, or generated files could not be compared; so it is made with functions that are rounded correctly everywhere.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from functools import cache, lru_cache
from typing import Any

import gmpy2
import mpmath
import numpy as np
import scipy.special
from mpmath import mp, mpf
from mpmath.libmp import NoConvergence
from sympy import And, Expr, Symbol, coth, erf, erfc, lambdify, oo, tanh

from xsec_sym.export import functions
from xsec_sym.proof.domain import Domain, Interval

Point = tuple[float, ...]
DOUBLE = gmpy2.context(precision=53, emax=1024, emin=-1073, subnormalize=True)
# Far enough to see 1 + u for the smallest u there is.
MOST_PLACES = 1100
# 1 + u is not 1 with so many digits, however small a double u is.
ZERO_SEEN = 400
SMALL = 1e-12
SATURATING = (erf, erfc, coth, tanh)
AGREED = 25
ROUNDED = ("exp", "expm1", "log", "log1p", "sin", "cos", "tan", "sinh", "cosh", "tanh", "arcsin", "arccos", "arctan",
           "arcsinh", "arccosh", "arctanh")  # fmt: skip


# What printed source may call beside NumPy; the same on every machine only to a few last bits.
SPECIAL: dict[str, Any] = {"scipy": scipy, "langevin": functions.langevin, "ierfc": functions.ierfc,
                           "i2e": functions.i2e}  # fmt: skip


class CorrectlyRounded:
    """Stands for the module numpy in printed source: the same results on every machine."""

    def __getattr__(self, name: str) -> Any:
        if name == "power":
            return np.vectorize(_power, otypes=[float])
        return _vector(name) if name in ROUNDED else getattr(np, name)


@cache
def _vector(name: str) -> Any:
    function = getattr(gmpy2, name.replace("arc", "a"))

    @lru_cache(maxsize=200_000)
    def one(x: float) -> float:
        with gmpy2.context(DOUBLE):
            return float(function(gmpy2.mpfr(x)))

    return lambda x: np.array([one(v) for v in np.asarray(x, float).ravel().tolist()]).reshape(np.shape(x))


@lru_cache(maxsize=200_000)
def _power(x: float, y: float) -> float:
    with gmpy2.context(DOUBLE):
        return float(gmpy2.mpfr(x) ** gmpy2.mpfr(y))


def values(body: Sequence[str], symbols: Sequence[Symbol], points: Sequence[Point]) -> np.ndarray:
    """What the printed lines give at the points."""
    if not points:
        return np.empty(0)
    head = f"def f({', '.join(s.name for s in symbols)}):\n"
    space: dict[str, Any] = {**SPECIAL, "np": CorrectlyRounded()}
    exec(head + "".join(f"    {line}\n" for line in body), space)
    columns = np.array(points, float).T
    with np.errstate(all="ignore"):
        return np.broadcast_to(np.asarray(space["f"](*columns), float), (len(points),))


@lru_cache(maxsize=500)
def compiled(e: Expr, symbols: tuple[Symbol, ...]) -> Callable[..., Any]:
    return lambdify(symbols, e, modules="mpmath")


def exact(e: Expr, symbols: Sequence[Symbol], point: Point) -> mpf | None:
    """The value at a point of doubles, by mpmath at growing precision until two agree; None where there is none."""
    function = compiled(e, tuple(symbols))
    last = None
    # erf x and its kind round to 1 where what they are added to is small: few digits would agree on a wrong value
    wary = e.has(*SATURATING)
    places = 40
    while places <= MOST_PLACES:
        with mp.workdps(places):
            try:
                value = mpmath.mpmathify(function(*(mpf(x) for x in point)))
            except (ZeroDivisionError, ValueError, OverflowError, TypeError, NoConvergence):
                return None
            if mp.isnan(value) or mp.im(value):
                return None
            value = mp.re(value)
            # two zeros do not agree: both may have lost the same small number
            doubtful = wary and places < ZERO_SEEN and abs(value) < SMALL
            if last and abs(value - last) <= abs(value) * mpf(10) ** -AGREED and not doubtful:
                return value
            last = value
        places = 3 * places - 20 if last and not doubtful else max(3 * places - 20, ZERO_SEEN)
    return mpf(0) if last is not None and abs(last) < mpf(10) ** (-MOST_PLACES // 3) else last


def ulps(value: float, reference: mpf, dtype: type[np.floating] = np.float64) -> float:
    """The error in units of the last place of the reference, as ``dtype`` has it.

    >>> ulps(1.0 + 2.0**-52, mpf(1))
    1.0
    >>> ulps(float("inf"), mpf(10) ** 400)
    0.0
    """
    with np.errstate(over="ignore"):
        # mpmath's own conversion turns what is too large into infinity
        nearest = dtype(float(reference))
    if not np.isfinite(nearest) or not np.isfinite(value):
        return 0.0 if float(nearest) == value else float("inf")
    place = float(np.spacing(np.abs(nearest)))
    return float(abs(mpf(float(value)) - reference) / mpf(place))


def points(domain: Domain, count: int, seed: int = 0, dtype: type[np.floating] = np.float64) -> list[Point]:
    """Points of a domain of real intervals, as floats: spread out, close to every bound and to 0, and at the bounds.

    >>> from xsec_sym.proof.domain import domain, interval
    >>> points(domain([interval(Symbol("u"), 0, 1, open="left")]), 8)[:3]
    [(1.0,), (0.5,), (1e-300,)]
    """
    draw = random.Random(seed)
    symbols = domain.symbols
    holds = _membership(domain)
    found: dict[Point, None] = {}
    for k in range(40 * count):
        if len(found) == count:
            break
        point: list[float] = []
        for variable in domain.variables:
            assert isinstance(variable, Interval)
            known = dict(zip(symbols, point, strict=False))
            low, high = (float(b.subs(known).evalf(30)) for b in (variable.low, variable.high))
            # one variable is tried at special places one after the other, several at random ones
            place = k if len(symbols) == 1 else draw.randrange(4 * count)
            point.append(float(dtype(_one(low, high, place, draw))))
        if all(np.isfinite(point)) and holds(tuple(point)):
            found[tuple(point)] = None
    return list(found)


def _one(low: float, high: float, place: int, draw: random.Random) -> float:
    """A number between the bounds; the first few places are special ones."""
    ends = [b for b in (low, high) if np.isfinite(b)]
    middle = 0.0
    if ends:
        middle = sum(ends) / 2 if len(ends) == 2 else ends[0] + (1 if high == np.inf else -1)
    reach = high - low if len(ends) == 2 else max(1.0, abs(middle))
    special = [*sorted(ends, reverse=True), middle, 0.0]
    for tiny in (1e-300, 5e-324, 1e-40, 1e-16, 1e-8):
        special += [tiny, -tiny]
    special += [np.nextafter(b, middle) for b in ends]
    if place < len(special):
        return float(special[place])
    kind = draw.randrange(8)
    if kind < 4 or (kind < 6 and not ends):
        if len(ends) == 2:
            return draw.uniform(low, high)
        out = 10 ** draw.uniform(-3, 3)
        return ends[0] + (out if high == np.inf else -out) if ends else draw.choice((-1, 1)) * out
    if kind < 6:
        end = draw.choice(ends)
        return end + np.copysign(reach * 10 ** draw.uniform(-17, 0), middle - end)
    return draw.choice((-1, 1)) * 10 ** (draw.uniform(-20, 0) if kind == 6 else draw.uniform(-308, 0))


def _membership(domain: Domain) -> Callable[[Point], bool]:
    conditions = list(domain.conditions)
    for v in domain.variables:
        assert isinstance(v, Interval)
        if v.low != -oo:
            conditions.append(v.symbol > v.low if v.low_open else v.symbol >= v.low)
        if v.high != oo:
            conditions.append(v.symbol < v.high if v.high_open else v.symbol <= v.high)
    test = lambdify(domain.symbols, And(*conditions), modules="mpmath")

    def holds(point: Point) -> bool:
        with mp.workdps(40):
            return bool(test(*(mpf(x) for x in point)))

    return holds
