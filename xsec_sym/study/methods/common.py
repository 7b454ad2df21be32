"""What the cross-sections have in common: quadrature over rings of normals, loops, and cells of their arguments."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
from mpmath import mp, mpf
from scipy import integrate

from xsec_sym import kernels
from xsec_sym.study.method import Argument, Columns, Method, along
from xsec_sym.study.references import ring as by_definition

BLOCK = 2**14
COSINES = (0.0, 1e-3, 0.01, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.75, 0.9, 0.97, 0.999, 1.0)


def cosine(name: str = "u", both: bool = True) -> Argument:
    """A cosine in [-1, 1], or in [0, 1]; the cells are narrow where methods change."""
    negative = tuple(-x for x in reversed(COSINES[1:])) if both else ()
    return Argument(name, negative + COSINES)


def decades(low: int, high: int, parts: int = 3, name: str = "alpha") -> Argument:
    """A roughness from 10^low to 10^high, so many cells a decade."""
    edges = 10.0 ** (np.arange(low * parts, high * parts + 1) / parts)
    return Argument(name, tuple(float(f"{e:.6g}") for e in edges), scale="log")


def blocked(function: Callable[..., np.ndarray]) -> Callable[..., np.ndarray]:
    """The function on blocks of at most `BLOCK` values, so that what it needs for each stays in the cache."""

    def over(*columns: Any) -> np.ndarray:
        arrays = np.broadcast_arrays(*columns)
        flat = [a.ravel() for a in arrays]
        found = np.empty(flat[0].shape)
        step = BLOCK // 16
        for start in range(0, found.size, step):
            part = slice(start, start + step)
            found[part] = function(*(a[part] for a in flat))
        return found.reshape(arrays[0].shape)

    return over


def over_rings(ndf: Callable[..., Any], n: int, low: float = -1.0) -> Callable[..., np.ndarray]:
    """sigma(u) = int D(x) ring(u, x) dx by Gauss-Legendre with n nodes in x from `low` to 1."""
    nodes, weights = np.polynomial.legendre.leggauss(n)
    x, w = 0.5 * (1 - low) * nodes + 0.5 * (1 + low), 0.5 * (1 - low) * weights

    def sigma(u: np.ndarray, shape: np.ndarray) -> np.ndarray:
        return (ndf(x, shape[:, np.newaxis]) * kernels.sigma_dirac_ring(u[:, np.newaxis], x)) @ w

    return blocked(sigma)


def adaptive(ndf: Callable[..., Any], low: float = -1.0) -> Callable[[float, float], float]:
    """The same by `scipy.integrate.quad`, with its default tolerances, in two pieces at which the ring is lit anew."""

    def integrand(x: float, u: float, shape: float) -> float:
        # with `math`, as calls of the kernel with single numbers would be most of the time
        a, d = u * x, 1.0 - u * u - x * x
        if d <= 0.0:
            return float(ndf(x, shape)) * 2.0 * math.pi * max(a, 0.0)
        root = math.sqrt(d)
        return float(ndf(x, shape)) * 2.0 * (root + a * (0.5 * math.pi + math.atan(a / root)))

    def sigma(u: float, shape: float) -> float:
        s = np.sqrt(1.0 - u * u)
        cuts = sorted({low, 1.0, *(x for x in (-s, s) if low < x < 1.0)})
        pieces = pairwise(cuts)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", integrate.IntegrationWarning)
            return sum(integrate.quad(integrand, a, b, args=(u, shape))[0] for a, b in pieces)

    return sigma


def arbitrary(ndf: Callable[..., Any], digits: int, low: float = -1.0) -> Callable[[float, float], float]:
    """The same by mpmath with so many digits."""

    def sigma(u: float, shape: float) -> float:
        with mp.workdps(digits):
            cuts = (low,) if low > -1 else ()
            return float(by_definition.cross_section_over_rings(lambda x: ndf(x, mpf(shape)), u, cuts))

    return sigma


def quadratures(
    ndf: Callable[..., Any], exact: Callable[..., Any], low: float = -1.0, most: tuple[int, int] = (500, 60)
) -> tuple[Method, ...]:
    """The three of them as methods; `exact` is the distribution in mpmath. most: points that the slow ones get."""
    return (
        Method(
            "Gauss-Legendre over rings",
            "quadrature of the definition",
            lambda n: over_rings(ndf, n, low),
            kind="quadrature",
            curve=along(n=(8, 16, 32, 64, 128)),
        ),
        Method(
            "scipy.integrate.quad",
            "quadrature of the definition",
            lambda: adaptive(ndf, low),
            kind="quadrature",
            serial=True,
            most=most[0],
        ),
        Method(
            "mpmath.quad",
            "quadrature of the definition",
            lambda digits: arbitrary(exact, digits, low),
            kind="arbitrary precision",
            curve=along(digits=(15, 30)),
            serial=True,
            most=most[1],
        ),
    )


def loop(scalar: Callable[..., Any], parallel: bool = False) -> Callable[[], Any]:
    """A formula of numbers as a compiled loop over arrays."""

    @cache
    def make() -> Any:
        import numba

        types = len(scalar.__code__.co_varnames[: scalar.__code__.co_argcount])
        signature = f"float64({', '.join(['float64'] * types)})"
        return numba.vectorize([signature], target="parallel" if parallel else "cpu")(scalar)

    return make


def near(rng: np.random.Generator, n: int, *values: float, reach: float = 17.0) -> np.ndarray:
    """Numbers as near to these as doubles can be, on both sides, within [-1, 1]."""
    away = rng.choice([-1.0, 1.0], n) * 10 ** rng.uniform(-reach, -2, n)
    return np.clip(rng.choice(np.asarray(values, float), n) + away, -1, 1)


def grazing(roughness: Argument) -> Callable[[np.random.Generator, int], Columns]:
    return lambda rng, n: (near(rng, n, 0.0, reach=20), roughness.draw(rng, n))


def facing(roughness: Argument) -> Callable[[np.random.Generator, int], Columns]:
    return lambda rng, n: (near(rng, n, -1.0, 1.0), roughness.draw(rng, n))
