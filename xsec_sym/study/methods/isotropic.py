"""Isotropic scattering in a half-space: H, and the BRDF that it makes, by the same methods."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from xsec_sym import kernels
from xsec_sym.study.method import Field, Function, Method, Quantity, along
from xsec_sym.study.methods.common import loop
from xsec_sym.study.methods.half_spaces import (
    ALBEDO,
    FEW,
    WHITE,
    Characteristic,
    cosine,
    drawn,
    grazing,
    inside,
    near_1,
    quadratures,
    some,
)
from xsec_sym.study.references import chandrasekhar

OF = Characteristic(rest=lambda c: 1 - c, psi=lambda c: (c / 2,))
TYPICAL = ((0.5,), (0.9,), (1.0,))

H = Quantity(
    "h_isotropic",
    "Chandrasekhar's H of isotropic scattering",
    running=(cosine(),),
    set=(ALBEDO,),
    reference=chandrasekhar.h,
    trouble={
        "nearly white": drawn(inside, some(WHITE)),
        "white": drawn(inside, some((1.0,))),
        "grazing": drawn(grazing, some(FEW)),
    },
    typical=TYPICAL,
    per_cell=(2, 4),
)

PAIR = (0.0, 0.01, 0.1, 0.3, 0.6, 0.8, 1.0)

BRDF = Quantity(
    "brdf_isotropic",
    "BRDF of an isotropically scattering half-space",
    running=(cosine("mu_i", PAIR), cosine("mu_o", PAIR)),
    set=(ALBEDO,),
    reference=chandrasekhar.brdf,
    trouble={
        "nearly white": drawn(inside, inside, some(WHITE)),
        "white": drawn(inside, inside, some((1.0,))),
        "grazing": drawn(grazing, inside, some(FEW)),
        "grazing both": drawn(lambda rng, n: 10 ** rng.uniform(-12, -3, n), grazing, some(FEW)),
        "facing": drawn(near_1, near_1, some(FEW)),
    },
    typical=TYPICAL,
    per_cell=(2, 2),
    unit="1/sr",
)


def hapke(mu: Any, c: Any) -> Any:
    """Of 1981."""
    return (1 + 2 * mu) / (1 + 2 * mu * np.sqrt(1 - c))


def hapke_improved(mu: Any, c: Any) -> Any:
    """Of 2002: the integral of the equation of H with a line for H."""
    root = np.sqrt(1 - c)
    r = (1 - root) / (1 + root)
    return 1 / (1 - c * mu * (r + (0.5 - r * mu) * np.log1p(1 / np.maximum(mu, 1e-300))))


def hapke_number(mu: float, c: float) -> float:
    return (1.0 + 2.0 * mu) / (1.0 + 2.0 * mu * np.sqrt(1.0 - c))


def hapke_improved_number(mu: float, c: float) -> float:
    root = np.sqrt(1.0 - c)
    r = (1.0 - root) / (1.0 + root)
    return 1.0 / (1.0 - c * mu * (r + (0.5 - r * mu) * np.log1p(1.0 / max(mu, 1e-300))))


def polynomial(n: int) -> Function:
    """Chebyshev's polynomials of mu^(1/4) and sqrt(1 - c), n of each, for log H."""
    points = np.cos(np.pi * (np.arange(n) + 0.5) / n)
    x, s = np.meshgrid((points + 1) / 2, (points + 1) / 2, indexing="ij")
    values = np.log(OF.trapezoidal(256)(x**4, 1 - s * s))
    inverse = np.linalg.inv(np.polynomial.chebyshev.chebvander(points, n - 1))
    table = inverse @ values @ inverse.T

    def h(mu: np.ndarray, c: np.ndarray) -> np.ndarray:
        y = 2 * np.sqrt(1 - c) - 1
        rows = np.polynomial.chebyshev.chebval(y, table.T)
        return np.exp(np.polynomial.chebyshev.chebval(2 * np.sqrt(np.sqrt(mu)) - 1, rows, tensor=False))

    return h


def lattice(n: int) -> Function:
    """A table of n by n values, even in sqrt(mu) and sqrt(1 - c), between which it is linear in each."""
    at = np.linspace(0, 1, n)
    x, s = np.meshgrid(at, at, indexing="ij")
    table = OF.trapezoidal(256)((x * x).ravel(), (1 - s * s).ravel()).reshape(n, n)

    def h(mu: np.ndarray, c: np.ndarray) -> np.ndarray:
        x, y = np.sqrt(mu) * (n - 1), np.sqrt(1 - c) * (n - 1)
        i, j = np.minimum(x.astype(int), n - 2), np.minimum(y.astype(int), n - 2)
        x, y = x - i, y - j
        low = table[i, j] * (1 - y) + table[i, j + 1] * y
        return low * (1 - x) + (table[i + 1, j] * (1 - y) + table[i + 1, j + 1] * y) * x

    return h


HAPKE = "B. Hapke, 1981", "B. Hapke, 2002"
FOCK = "Fock's integral, as in deon2021:22"


def brdf(h: Function) -> Function:
    """`dupuy2016:30` with any H."""

    def value(mu_i: Any, mu_o: Any, c: Any) -> Any:
        return c / (4 * np.pi) * h(mu_i, c) * h(mu_o, c) / (mu_i + mu_o)

    return value


def brdf_for_one(make: Callable[..., Function]) -> Callable[..., Function]:
    def folded(c: float, **parameters: Any) -> Function:
        h = make(c, **parameters)
        return lambda mu_i, mu_o: c / (4 * np.pi) * h(mu_i) * h(mu_o) / (mu_i + mu_o)

    return folded


def methods(kernel: Function, source: str, after: Callable[[Function], Function], fold: Any) -> tuple[Method, ...]:
    def compiled(number: Callable[..., float]) -> Callable[[], Function]:
        return lambda: after(loop(number)())

    return (
        Method("kernel", source, lambda: kernel, single=True, ours=True),
        Method("Hapke", HAPKE[0], lambda: after(hapke), kind="approximation"),
        Method("Hapke, improved", HAPKE[1], lambda: after(hapke_improved), kind="approximation"),
        Method("Hapke, compiled", HAPKE[0], compiled(hapke_number), kind="approximation", needs="numba"),
        Method("Hapke, improved, compiled", HAPKE[1], compiled(hapke_improved_number), kind="approximation",
               needs="numba"),
        Method("Chebyshev polynomial", "interpolation of Fock's integral", lambda n: after(polynomial(n)),
               kind="table", curve=along(n=(4, 8, 16))),
        Method("linear table", "interpolation of Fock's integral", lambda n: after(lattice(n)), kind="table",
               curve=along(n=(16, 64, 256))),
        *quadratures(OF, FOCK, after, fold),
    )  # fmt: skip


FIELDS = (
    Field(H, methods(kernels.h_isotropic, "dupuy2016:31", lambda h: h, None)),
    Field(BRDF, methods(kernels.brdf_isotropic, "dupuy2016:30", brdf, brdf_for_one)),
)
