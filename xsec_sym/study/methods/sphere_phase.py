"""The phase function of a Lambertian sphere, and its cosine of deviation from a uniform number."""

from __future__ import annotations

import math
import warnings

import numpy as np
from mpmath import mp, mpf
from scipy import integrate, optimize

from xsec_sym import kernels
from xsec_sym.study.method import Argument, Columns, Field, Function, Method, Quantity, along
from xsec_sym.study.methods.common import cosine, loop, near
from xsec_sym.study.references import sphere

SCALE = 2 / (3 * np.pi**2)

PHASE = Quantity(
    "phase_lambert_sphere",
    "phase function of a Lambertian sphere",
    running=(cosine("mu"),),
    set=(),
    reference=sphere.phase,
    trouble={
        "straight on": lambda rng, n: (np.minimum(near(rng, n, 1.0), 1),),
        "straight back": lambda rng, n: (near(rng, n, -1.0),),
        "sideways": lambda rng, n: (near(rng, n, 0.0, reach=20),),
    },
    per_cell=(1, 20),
    unit="1/sr",
)

XI = (0.0, 1e-3, 0.01, 0.1, 0.3, 0.5, 0.7, 0.8, 0.83, 0.84, 0.9, 0.97, 0.99, 0.999, 1.0)


def to_0(rng: np.random.Generator, n: int) -> Columns:
    return (10 ** rng.uniform(-30, -2, n),)


def to_1(rng: np.random.Generator, n: int) -> Columns:
    return (1 - 10 ** rng.uniform(-16, -2, n),)


def to_sideways(rng: np.random.Generator, n: int) -> Columns:
    return (5 / 6 + rng.choice([-1.0, 1.0], n) * 10 ** rng.uniform(-16, -2, n),)


SAMPLE = Quantity(
    "sample_lambert_sphere",
    "cosine of deviation from a uniform number",
    running=(Argument("xi", XI),),
    set=(),
    reference=sphere.sample,
    trouble={"xi near 0": to_0, "xi near 1": to_1, "xi near 5/6": to_sideways},
    per_cell=(1, 20),
    about="near xi = 5/6 the cosine is 0, and its relative error is not what matters.",
)

# --- the phase function -----------------------------------------------------------------------------------


def naive(mu: np.ndarray) -> np.ndarray:
    """The second form of `deon2021:1`."""
    return SCALE * (np.sqrt(1 - mu * mu) - mu * np.arccos(mu))


def naive_number(mu: float) -> float:
    return 2.0 / (3.0 * 9.869604401089358) * (math.sqrt(1.0 - mu * mu) - mu * math.acos(mu))


def by_angle(mu: np.ndarray) -> np.ndarray:
    theta = np.arccos(mu)
    return SCALE * (np.sin(theta) - theta * np.cos(theta))


def legendre(n: int) -> Function:
    """`deon2021:4` up to the order n."""
    table = kernels.lambert_sphere_coefficients(n) / (4 * np.pi)
    return lambda mu: np.polynomial.legendre.legval(mu, table)


def definition(mu: float) -> float:
    """Points of the sphere that are lit and seen: the arc they share, by `scipy.integrate.quad`."""
    back = math.pi - math.acos(mu)
    arc, _ = integrate.quad(lambda angle: math.cos(angle) * math.cos(angle - back), back - math.pi / 2, math.pi / 2)
    return 4 / 3 * arc / math.pi**2


def definition_exactly(digits: int) -> Function:
    def phase(mu: float) -> float:
        with mp.workdps(digits):
            back = mp.pi - mp.acos(mpf(mu))
            return float(
                mpf(4)
                / 3
                * mp.quad(lambda angle: mp.cos(angle) * mp.cos(angle - back), [back - mp.pi / 2, mp.pi / 2])
                / mp.pi**2
            )

    return phase


def tabled(n: int) -> Function:
    """n values, even in the angle's cosine, with lines between them."""
    mu = np.linspace(-1, 1, n)
    values = naive(mu)
    return lambda x: np.interp(x, mu, values)


def gauss(n: int) -> Function:
    """The same arc by n nodes."""
    x, weight = np.polynomial.legendre.leggauss(n)

    def phase(mu: np.ndarray) -> np.ndarray:
        back = np.pi - np.arccos(mu)
        middle, half = back / 2, (np.pi - back) / 2
        arc = sum(
            w * np.cos(middle + half * node) * np.cos(middle + half * node - back)
            for node, w in zip(x, weight, strict=True)
        )
        return 4 / (3 * np.pi**2) * half * arc

    return phase


PHASES = (
    Method("kernel", "deon2021:1", lambda: kernels.phase_lambert_sphere, single=True, ours=True),
    Method("closed form", "deon2021:1", lambda: naive, single=True),
    Method("closed form, compiled", "deon2021:1", loop(naive_number), needs="numba"),
    Method("closed form in the angle", "deon2021:1", lambda: by_angle, single=True),
    Method("Legendre series", "deon2021:4", legendre, kind="series", curve=along(n=(2, 4, 8, 16, 32, 64))),
    Method("linear table", "interpolation of the closed form", tabled, kind="table", curve=along(n=(64, 1024, 16384))),
    Method("Gauss-Legendre", "quadrature of the definition", gauss, kind="quadrature", curve=along(n=(2, 4, 8, 16))),
    Method("scipy.integrate.quad", "quadrature of the definition", lambda: definition, kind="quadrature", serial=True,
           most=200),
    Method("mpmath.quad", "quadrature of the definition", definition_exactly, kind="arbitrary precision",
           curve=along(digits=(15, 30)), serial=True, most=40),
)  # fmt: skip

# --- sampling ---------------------------------------------------------------------------------------------


def paper(xi: np.ndarray) -> np.ndarray:
    """`deon2021:7`."""
    return 1 - 2 * (1 - xi ** (0.0401885 * xi + 1.01938)) ** 0.397225


def paper_number(xi: float) -> float:
    return 1.0 - 2.0 * (1.0 - xi ** (0.0401885 * xi + 1.01938)) ** 0.397225


def share(theta: np.ndarray) -> np.ndarray:
    return (2 * theta * (2 + np.cos(2 * theta)) - 3 * np.sin(2 * theta)) / (6 * np.pi)


def bisected(n: int) -> Function:
    """n halvings of [0, pi], by the closed form of the distribution function."""

    def cosine(xi: np.ndarray) -> np.ndarray:
        low, high = np.zeros_like(xi), np.full_like(xi, np.pi)
        for _ in range(n):
            middle = (low + high) / 2
            below = share(middle) < 1 - xi
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        return np.cos((low + high) / 2)

    return cosine


def by_newton(n: int) -> Function:
    """n steps of Newton's method in the angle from the fit of `deon2021:7`."""

    def cosine(xi: np.ndarray) -> np.ndarray:
        theta = np.arccos(np.clip(paper(xi), -1, 1))
        for _ in range(n):
            slope = 2 * np.pi * SCALE * np.sin(theta) * (np.sin(theta) - theta * np.cos(theta))
            theta = np.where(slope > 0, theta - (share(theta) - (1 - xi)) / slope, theta)
        return np.cos(theta)

    return cosine


def quantiles(n: int) -> Function:
    """n values even in xi, with lines between them."""
    xi = np.linspace(0, 1, n)
    values = bisected(60)(xi)
    return lambda x: np.interp(x, xi, values)


def integrated(xi: float) -> float:
    """`scipy.optimize.brentq` of the phase function's integral by `scipy.integrate.quad`."""

    def above(mu: float) -> float:
        return 2 * np.pi * integrate.quad(naive, mu, 1)[0] - (1 - xi)

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return float(optimize.brentq(above, -1, 1)) if 0 < xi < 1 else 2 * xi - 1


def exactly(digits: int) -> Function:
    def cosine(xi: float) -> float:
        with mp.workdps(digits):
            rest = 1 - mpf(xi)
            found = mp.findroot(lambda theta: sphere.beyond(theta) - rest, (mpf(0), mp.pi), solver="illinois",
                                verify=False, maxsteps=400, tol=mpf(10) ** (-2 * digits))  # fmt: skip
            return float(mp.cos(found))

    return cosine


SAMPLES = (
    Method("kernel", "deon2021:7", lambda: kernels.sample_lambert_sphere, single=True, ours=True),
    Method("paper's fit", "deon2021:7", lambda: paper, kind="approximation", single=True),
    Method("paper's fit, compiled", "deon2021:7", loop(paper_number), kind="approximation", needs="numba"),
    Method("Newton from the paper's fit", "root of the closed form", by_newton, kind="iteration",
           curve=along(n=(1, 2, 3))),
    Method("bisection", "root of the closed form", bisected, kind="iteration", curve=along(n=(10, 20, 40, 60))),
    Method("linear table", "interpolation of the roots", quantiles, kind="table", curve=along(n=(64, 1024, 16384))),
    Method("quad and brentq", "root of the integral of deon2021:1", lambda: integrated, kind="quadrature", serial=True,
           most=100),
    Method("mpmath.findroot", "root of the closed form", exactly, kind="arbitrary precision",
           curve=along(digits=(15, 30)), serial=True, most=40),
)  # fmt: skip

FIELDS = (Field(PHASE, PHASES), Field(SAMPLE, SAMPLES))
