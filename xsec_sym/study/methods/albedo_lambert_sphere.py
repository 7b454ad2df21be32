"""The Bond albedo of a half-space of Lambertian spheres by the spheres' albedo, and the other way round."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import optimize

from xsec_sym import kernels
from xsec_sym.exact import bond
from xsec_sym.study.method import Argument, Columns, Field, Function, Method, Quantity, along
from xsec_sym.study.methods.common import loop
from xsec_sym.study.references import half_space

ABOUT = (
    "No 30 digits are to be had: the reference is a solver in double precision that shares no step with the kernel's, "
    "and agrees with it to 1e-12."
)


def to_0(rng: np.random.Generator, n: int) -> Columns:
    return (10 ** rng.uniform(-30, -2, n),)


def to_1(rng: np.random.Generator, n: int) -> Columns:
    return (1 - 10 ** rng.uniform(-16, -2, n),)


ALBEDO = Quantity(
    "albedo_lambert_sphere",
    "Bond albedo of the half-space of Lambertian spheres",
    running=(Argument("c", (0.0, 0.01, 0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.97, 0.99, 0.999, 1.0)),),
    set=(),
    reference=half_space.albedo,
    trouble={"black": to_0, "white": to_1},
    per_cell=(1, 20),
    about=ABOUT,
)
INVERSE = Quantity(
    "albedo_lambert_sphere_inverse",
    "albedo of Lambertian spheres by the Bond albedo of their half-space",
    running=(Argument("k_d", (0.0, 0.001, 0.01, 0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.99, 0.999, 1.0)),),
    set=(),
    reference=half_space.inverse,
    trouble={"black": to_0, "white": to_1},
    per_cell=(1, 20),
    about=ABOUT,
)

# --- there ------------------------------------------------------------------------------------------------


def paper(c: Any) -> Any:
    """`deon2021:47`."""
    s = np.sqrt(1 - c)
    return (1 - 0.453029 * (1 - c) - 0.544162 * s) / (1.42931 * s + 1)


# The mean cosine of the deviation.
G = -4 / 9


def similar(c: Any) -> Any:
    """Van de Hulst's, for isotropic scattering, at the s of the mean cosine."""
    s = np.sqrt((1 - c) / (1 - c * G))
    return (1 - s) * (1 - 0.139 * s) / (1 + 1.17 * s)


def isotropic(c: Any) -> Any:
    s = np.sqrt(1 - c)
    return (1 - s) * (1 - 0.139 * s) / (1 + 1.17 * s)


def solved(n: int) -> Function:
    """`HalfSpace` with n nodes, and with the orders that they can hold."""
    orders = 2 * n // 3

    def albedo(c: float) -> float:
        table = kernels.lambert_sphere_coefficients(orders)
        return kernels.HalfSpace(table, c, modes=1, core=orders, nodes=n).bond_albedo()

    return albedo


def lost(s: np.ndarray) -> np.ndarray:
    return np.array([half.absorbed() for half in (kernels.HalfSpace(TABLE, 1 - x * x, modes=1) for x in s)])


TABLE = kernels.lambert_sphere_coefficients(32)


def polynomial(n: int) -> Function:
    """Chebyshev's polynomial of sqrt(1 - c) with n coefficients for (1 - k_d)/sqrt(1 - c)."""
    points = np.cos(np.pi * (np.arange(n) + 0.5) / n)
    s = (points + 1) / 2
    table = np.polynomial.chebyshev.chebfit(points, lost(s) / s, n - 1)

    def albedo(c: np.ndarray) -> np.ndarray:
        s = np.sqrt(1 - c)
        return 1 - s * np.polynomial.chebyshev.chebval(2 * s - 1, table)

    return albedo


def lattice(n: int) -> Function:
    """n values even in c, with lines between them."""
    c = np.linspace(0, 1, n)
    values = polynomial(20)(c)
    return lambda x: np.interp(x, c, values)


def doubled(c: float) -> float:
    return float(bond.by_doubling.__wrapped__(c))


ALBEDOS = (
    Method("kernel", "deon2021:47", lambda: kernels.albedo_lambert_sphere, single=True, ours=True),
    Method("fit", "this project's fit", lambda: kernels.albedo_lambert_sphere_fit, kind="approximation", single=True,
           ours=True),
    Method("paper's fit", "deon2021:47", lambda: paper, kind="approximation", single=True),
    Method("paper's fit, compiled", "deon2021:47", loop(paper), kind="approximation", needs="numba"),
    Method("similarity", "H. C. van de Hulst, 1980, at the mean cosine", lambda: similar, kind="approximation"),
    Method("isotropic scatterers", "H. C. van de Hulst, 1980", lambda: isotropic, kind="other model",
           model="albedo_isotropic"),
    Method("HalfSpace", "discrete directions", solved, kind="solver", curve=along(n=(6, 12, 24, 48)), serial=True,
           most=60),
    Method("doubling", "layers that are doubled", lambda: doubled, kind="solver", serial=True, most=40),
    Method("Chebyshev polynomial", "interpolation of HalfSpace", polynomial, kind="table",
           curve=along(n=(3, 5, 8, 12, 20))),
    Method("linear table", "interpolation of HalfSpace", lattice, kind="table", curve=along(n=(16, 256, 4096))),
)  # fmt: skip

# --- and back ---------------------------------------------------------------------------------------------


def paper_inverse(k_d: Any) -> Any:
    """`deon2021:46`."""
    rest = 1 - k_d
    return (1 - rest**2.73556) / (1 - 0.184096 * rest**2.48423)


def forward_inverted(k_d: Any) -> Any:
    """The quadratic equation for sqrt(1 - c) that `deon2021:47` is."""
    half, goal = 0.5 * (0.544162 + 1.42931 * k_d), 1 - k_d
    s = goal / (half + np.sqrt(half * half + 0.453029 * goal))
    return 1 - s * s


def similar_inverted(k_d: Any) -> Any:
    half, goal = 0.5 * (1.139 + 1.17 * k_d), 1 - k_d
    s = goal / (half + np.sqrt(half * half - 0.139 * goal))
    return (1 - s * s) / (1 - G * s * s)


def rooted(n: int) -> Function:
    """`scipy.optimize.brentq` of `HalfSpace` with n nodes, in sqrt(1 - c)."""
    forward = solved(n)

    def c(k_d: float) -> float:
        if k_d in (0.0, 1.0):
            return k_d
        s = optimize.brentq(lambda s: forward(1 - s * s) - k_d, 0, 1, xtol=1e-15, rtol=1e-14)
        return 1 - s * s

    return c


def newton(n: int) -> Function:
    """n steps on the kernel for the other direction, by its differences, from `deon2021:46`."""

    def c(k_d: np.ndarray) -> np.ndarray:
        s = np.sqrt(np.clip(1 - paper_inverse(k_d), 0, 1))
        for _ in range(n):
            here, step = kernels.albedo_lambert_sphere(1 - s * s), np.where(s > 0.5, -1e-5, 1e-5)
            slope = (kernels.albedo_lambert_sphere(1 - (s + step) ** 2) - here) / step
            s = np.clip(s - (here - k_d) / slope, 0, 1)
        return 1 - s * s

    return c


def polynomial_inverse(n: int) -> Function:
    """Chebyshev's polynomial of 1 - k_d with n coefficients for sqrt(1 - c)/(1 - k_d)."""
    points = np.cos(np.pi * (np.arange(n) + 0.5) / n)
    rest = (points + 1) / 2
    s = np.sqrt(1 - newton(6)(1 - rest))
    table = np.polynomial.chebyshev.chebfit(points, s / rest, n - 1)

    def c(k_d: np.ndarray) -> np.ndarray:
        rest = 1 - k_d
        s = rest * np.polynomial.chebyshev.chebval(2 * rest - 1, table)
        return 1 - s * s

    return c


def lattice_inverse(n: int) -> Function:
    k_d = np.linspace(0, 1, n)
    values = newton(6)(k_d)
    return lambda x: np.interp(x, k_d, values)


INVERSES = (
    Method("kernel", "deon2021:46", lambda: kernels.albedo_lambert_sphere_inverse, single=True, ours=True),
    Method("fit", "this project's fit", lambda: kernels.albedo_lambert_sphere_inverse_fit, kind="approximation",
           single=True, ours=True),
    Method("paper's fit", "deon2021:46", lambda: paper_inverse, kind="approximation", single=True),
    Method("paper's fit, compiled", "deon2021:46", loop(paper_inverse), kind="approximation", needs="numba"),
    Method("paper's other fit, inverted", "deon2021:47", lambda: forward_inverted, kind="approximation"),
    Method("similarity, inverted", "H. C. van de Hulst, 1980, at the mean cosine", lambda: similar_inverted,
           kind="approximation"),
    Method("Newton's method", "root of the kernel of the other direction", newton, kind="iteration",
           curve=along(n=(1, 2, 4))),
    Method("HalfSpace and brentq", "root of discrete directions", rooted, kind="solver", curve=along(n=(12, 24)),
           serial=True, most=20),
    Method("Chebyshev polynomial", "interpolation of the roots", polynomial_inverse, kind="table",
           curve=along(n=(3, 5, 8, 12, 20))),
    Method("linear table", "interpolation of the roots", lattice_inverse, kind="table", curve=along(n=(16, 256, 4096))),
)  # fmt: skip

FIELDS = (Field(ALBEDO, ALBEDOS), Field(INVERSE, INVERSES))
