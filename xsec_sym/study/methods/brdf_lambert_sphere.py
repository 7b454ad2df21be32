"""The BRDF of a half-space of Lambertian spheres: solvers, the paper's models, this project's fits, other models."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np
from scipy import interpolate

from xsec_sym import kernels
from xsec_sym.kernels.lambert_sphere_fits import FAST
from xsec_sym.study.method import Argument, Field, Function, Method, Quantity, along
from xsec_sym.study.methods.common import loop
from xsec_sym.study.methods.half_spaces import ALBEDO, FEW, cosine, drawn, grazing, inside, some
from xsec_sym.study.references import half_space

PAIR = (0.0, 0.01, 0.1, 0.3, 0.6, 0.8, 1.0)
WHITE = (1 - 2.0**-10, 1 - 2.0**-22, 1.0)


def reference(mu_i: float, mu_o: float, phi: float, c: float) -> float:
    return float(half_space.brdf(*([x] for x in (mu_i, mu_o, phi, c)))[0])


def around(rng: np.random.Generator, n: int) -> np.ndarray:
    return rng.uniform(0, np.pi, n)


def forward(rng: np.random.Generator, n: int) -> np.ndarray:
    return np.pi - np.where(rng.random(n) < 0.3, 0, 10 ** rng.uniform(-9, -1, n))


def skimming(rng: np.random.Generator, n: int) -> np.ndarray:
    return 10 ** rng.uniform(-7, -1.3, n)


def straight_back(rng: np.random.Generator, n: int) -> tuple[np.ndarray, ...]:
    mu = rng.uniform(0.01, 0.999, n)
    near = 10 ** rng.uniform(-12, -2, (2, n))
    return mu, np.clip(mu + near[0] * (rng.random(n) < 0.7), 0, 1), near[1] * (rng.random(n) < 0.7), some(FEW)(rng, n)


QUANTITY = Quantity(
    "brdf_lambert_sphere",
    "BRDF of a half-space of Lambertian spheres",
    running=(cosine("mu_i", PAIR), cosine("mu_o", PAIR), Argument("phi", (0.0, 0.8, 1.6, 2.4, float(np.pi)))),
    set=(ALBEDO,),
    reference=reference,
    references=half_space.brdf,
    trouble={
        "nearly white": drawn(inside, inside, around, some(WHITE)),
        "grazing": drawn(grazing, inside, around, some(FEW)),
        "grazing both": drawn(skimming, skimming, around, some(FEW)),
        "grazing both, forward": drawn(skimming, skimming, forward, some(FEW)),
        "straight back": straight_back,
    },
    typical=((0.9,),),
    per_cell=(1, 2),
    unit="1/sr",
    about="phi = 0 is backscattering. No 30 digits are to be had: the reference is a solver in double precision, with "
    "the whole phase function, that shares no step of its solution with the kernel's; the two agree to 1e-11, and to "
    "1e-10 forward where both directions graze the surface.",
)

# --- solvers ----------------------------------------------------------------------------------------------


def kernel(c: float) -> Function:
    return lambda mu_i, mu_o, phi: kernels.brdf_lambert_sphere(mu_i, mu_o, phi, c)


def single(mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray, c: Any) -> np.ndarray:
    """`deon2021:17` alone."""
    sines = np.sqrt((1 - mu_i) * (1 + mu_i) * (1 - mu_o) * (1 + mu_o))
    cosine = np.clip(mu_i * mu_o + sines * np.cos(phi), -1, 1)
    return c * kernels.phase_lambert_sphere(-cosine) / (mu_i + mu_o)


@lru_cache(maxsize=64)
def solution(c: float, n: int) -> kernels.HalfSpace:
    table = kernels.lambert_sphere_coefficients(n)
    half = kernels.HalfSpace(table, c, modes=n + 1, core=n, nodes=max(20, 3 * n // 2))
    for mode in half.modes:
        half.mode(mode)
    return half


def solved(c: float, n: int) -> Function:
    """`HalfSpace` with the orders up to n, its single scattering exact."""
    half = solution.__wrapped__(c, n)
    return lambda mu_i, mu_o, phi: single(mu_i, mu_o, phi, c) + half.multiple(mu_i, mu_o, phi)


def series(c: float, n: int) -> Function:
    """The same with the single scattering of the series that is cut."""
    half = solution.__wrapped__(c, n)
    return lambda mu_i, mu_o, phi: half.single(mu_i, mu_o, phi) + half.multiple(mu_i, mu_o, phi)


def tabled(c: float, n: int) -> Function:
    """n by n by n values, even in sqrt(mu_i), sqrt(mu_o) and phi, of mu_i + mu_o times what is multiply scattered."""
    half, root, angle = solution(c, 16), np.linspace(1e-4, 1, n), np.linspace(0, np.pi, n)
    mu = root * root
    modes = np.array([half.fourier(mode, mu, mu) for mode in half.modes])
    turns = np.cos(np.array(half.modes)[:, None] * angle)
    values = np.einsum("mij,mk->ijk", modes, turns) * (mu[:, None] + mu)[:, :, None]
    table = interpolate.RegularGridInterpolator((root, root, angle), values, bounds_error=False, fill_value=None)

    def brdf(mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray) -> np.ndarray:
        at = np.stack([np.sqrt(mu_i), np.sqrt(mu_o), phi], axis=-1)
        return single(mu_i, mu_o, phi, c) + table(at) / (mu_i + mu_o)

    return brdf


# --- formulas ---------------------------------------------------------------------------------------------


def fast_number(mu_i: float, mu_o: float, phi: float, c: float) -> float:
    """`brdf_lambert_sphere_fast` for numbers."""
    total, product = mu_i + mu_o, mu_i * mu_o
    turned = math.sqrt((1.0 - mu_i * mu_i) * (1.0 - mu_o * mu_o)) * math.cos(phi)
    cosine = min(1.0, max(-1.0, product + turned))
    phase = max(0.0, math.sqrt(1.0 - cosine * cosine) + cosine * math.acos(-cosine))
    s = math.sqrt(1.0 - c)
    lift = (FAST[3] * s + FAST[4] * product) / (s + FAST[5] * total) + FAST[0] + FAST[1] * s + FAST[2] * total
    shade = 1.0 + FAST[6] * s + FAST[7] * total + (FAST[8] + FAST[9] * total) * turned
    return max(0.0, 0.06754745576155852 * c * phase / total + lift * shade * (1.0 - s))


def lambert(mu_i: Any, mu_o: Any, phi: Any, c: Any) -> Any:
    return kernels.albedo_lambert_sphere(c) / np.pi + 0 * (mu_i + mu_o + phi)


def isotropic(mu_i: Any, mu_o: Any, phi: Any, c: Any) -> Any:
    return kernels.brdf_isotropic(mu_i, mu_o, c) + 0 * phi


METHODS = (
    Method("kernel", "deon2021:18", kernel, kind="solver", folds=True, ours=True, least=10**5),
    Method("HalfSpace", "exact single scattering, orders up to n", solved, kind="solver",
           curve=along(n=(2, 4, 8, 16, 32)), folds=True),
    Method("HalfSpace, series throughout", "deon2021:4", series, kind="solver",
           curve=along(n=(2, 8)), folds=True),
    Method("table for one albedo", "interpolation of HalfSpace", tabled, kind="table", curve=along(n=(8, 32)),
           folds=True),
    Method("fit", "this project's fit", lambda: kernels.brdf_lambert_sphere_fit, kind="approximation", single=True,
           ours=True),
    Method("fast fit", "this project's fit", lambda: kernels.brdf_lambert_sphere_fast, kind="approximation",
           single=True, ours=True),
    Method("fast fit, compiled", "this project's fit", loop(fast_number), kind="approximation", needs="numba",
           ours=True),
    Method("paper's model, mended", "deon2021:18", lambda: kernels.brdf_lambert_sphere_paper, kind="approximation"),
    Method("paper's model, printed", "deon2021:18", lambda: kernels.brdf_lambert_sphere_printed, kind="approximation"),
    Method("paper's fast model", "deon2021:48", lambda: kernels.brdf_lambert_sphere_fast_paper, kind="approximation"),
    Method("Hapke", "B. Hapke, 1981", lambda: kernels.brdf_lambert_sphere_hapke, kind="approximation"),
    Method("single scattering", "deon2021:17", lambda: single, kind="approximation"),
    Method("Lambert", "k_d/pi of the same Bond albedo", lambda: lambert, kind="other model", model="brdf_lambert"),
    Method("isotropic scatterers", "dupuy2016:30", lambda: isotropic, kind="other model", model="brdf_isotropic"),
)  # fmt: skip

FIELDS = (Field(QUANTITY, METHODS),)
