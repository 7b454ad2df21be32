"""The cross-section of the spherical Gaussian: the kernel, the series, the paper's approximations, and the fits in use.

The fits are of the irradiance E = N sigma, N = 2 pi (1 - exp(-2 kappa))/kappa; c is the cosine and k is kappa.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy import special

from xsec_sym import kernels
from xsec_sym.study.method import Field, Method, Quantity, along
from xsec_sym.study.methods.common import cosine, decades, facing, grazing, quadratures
from xsec_sym.study.references import spherical_gaussian as reference
from xsec_sym.study.references import surfaces

ALPHA = decades(-4, 4)


def in_the_layer(rng: np.random.Generator, n: int) -> tuple[np.ndarray, np.ndarray]:
    """The dark side as far as it falls off by e^-600 or so."""
    alpha = 10 ** rng.uniform(-4, 0, n)
    return rng.uniform(-1, 0, n) * np.minimum(1, 26 * alpha), alpha


def sharp(rng: np.random.Generator, n: int) -> tuple[np.ndarray, np.ndarray]:
    """kappa above 700, where sinh(kappa) overflows."""
    return rng.uniform(-1, 1, n), 10 ** rng.uniform(-4, -1.3, n)


QUANTITY = Quantity(
    "sigma_spherical_gaussian",
    "cross-section of the spherical Gaussian",
    running=(cosine(),),
    set=(ALPHA,),
    reference=reference.sigma,
    trouble={
        "grazing": grazing(ALPHA),
        "facing": facing(ALPHA),
        "dark layer": in_the_layer,
        "kappa > 700": sharp,
    },
    typical=((0.02,), (0.1,), (0.3,), (1.0,), (10.0,)),
    per_cell=(2, 2),
    usual={"alpha": (0.01, 10.0)},
)

# --- the paper --------------------------------------------------------------------------------------------


def beckmann_with_odd_part(u: np.ndarray, m: np.ndarray) -> np.ndarray:
    """`deon2016:40`, mended."""
    inverse = m**-2.0
    odd = u * (1 / np.tanh(inverse) - m**2 - 2) + (u - m**2 * np.abs(u)) * np.tanh(inverse)
    s = np.sqrt(1 - u**2)
    a = u / (m * s)
    return odd / 4 + (u * special.erf(a) + m * s * np.exp(-a * a) / np.sqrt(np.pi) + u) / 2


def fitted_at_the_equator(u: np.ndarray, m: np.ndarray) -> np.ndarray:
    """`deon2016:41`, mended: the second component, and an error function with slope and curvature at u = 0."""
    k = 2 / m**2
    i0, i1, i2 = special.i0e(k), special.i1e(k), special.ive(2, k)
    mean = 2 / np.tanh(k) - m**2
    scale = np.sqrt(np.pi) * 2 / -np.expm1(-2 * k) / mean
    a1 = scale * (k * i0 - i1)
    a3 = a1**3 / 3 - scale * k * (k * i1 - i2) / 6
    s = np.sqrt(1 - u * u)
    second = s * special.i1e(k * s) * np.exp(k * (s - 1)) / -np.expm1(-2 * k)
    return mean * u * (special.erf(a1 * u + a3 * u**3) + 1) / 4 + second


def harmonics(n: int) -> Callable[..., np.ndarray]:
    """`deon2016:38` up to l = n, the moments by scaled spherical Bessel functions of imaginary argument."""
    orders = np.array([l for l in range(n + 1) if l % 2 == 0 or l == 1])
    factors = np.sqrt(np.pi) * (2 * orders + 1) / 8 / special.gamma(orders / 2 + 2) * special.rgamma(1.5 - orders / 2)

    def sigma(u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
        k = 2 / alpha**2
        lowest = special.ive(0.5, k)
        return sum(
            factor * special.ive(l + 0.5, k) / lowest * special.eval_legendre(l, u)
            for l, factor in zip(orders, factors, strict=True)
        )

    return sigma


def three_harmonics(u: np.ndarray, m: np.ndarray) -> np.ndarray:
    """`deon2016:44`: the expansion up to l = 2 in closed form."""
    square = m * m
    coth = 1 / np.tanh(2 / square)
    curved = 3 * square * square - 6 * square * coth + 4
    return 0.25 + (2 * coth - square) * u / 4 + 5 / 128 * (3 * u * u - 1) * curved


# --- exact, in series -------------------------------------------------------------------------------------


def chebyshev(alpha: float, n: int) -> Callable[[np.ndarray], np.ndarray]:
    """`xsec:sg-chebyshev` with n terms: sigma for one roughness, as a polynomial in the angle's sine and multiples."""
    k = 2 / alpha**2
    bessel = special.ive(np.arange(n + 2), k / 2)
    here, after = bessel[:-1], bessel[1:]
    odd = (k / 2 * (here**2 + after**2) - here * after) / (2 * np.arange(n + 1) + 1)
    scale = 1 / -np.expm1(-2 * k)
    mean = (1 + np.exp(-2 * k)) / 2 + np.expm1(-2 * k) / (2 * k)
    # the odd multiples of psi, which are (-1)^j T_{2j+1}(u)
    series = np.zeros(2 * n + 2)
    series[1::2] = 2 * odd[: n + 1] * (-1.0) ** np.arange(n + 1)

    def sigma(u: np.ndarray) -> np.ndarray:
        s = np.sqrt(1 - u * u)
        sweep = s * special.i1e(k * s) * np.exp(k * (s - 1))
        return scale * (sweep + u * (mean + np.polynomial.chebyshev.chebval(u, series)))

    return sigma


def positive(n: int) -> Callable[..., np.ndarray]:
    """`xsec:sg-positive` with n Gauss-Legendre nodes: nothing cancels, even on the dark side."""
    nodes, weights = np.polynomial.legendre.leggauss(n)
    t, w = 0.5 * (nodes + 1), 0.5 * weights
    root = np.sqrt(1 - t * t)

    def sigma(u: np.ndarray, alpha: np.ndarray) -> np.ndarray:
        k = 2 / np.asarray(alpha) ** 2
        total = np.zeros(np.broadcast_shapes(np.shape(u), np.shape(alpha)))
        s = np.sqrt(1 - u * u)
        for a, b, c in zip(t, root, w, strict=True):
            total += c * a * special.i0e(k * s * b) * np.exp(k * (u * a + s * b - 1))
        return k / -np.expm1(-2 * k) * total

    return sigma


# --- fits in use ------------------------------------------------------------------------------------------


def punctual(c: np.ndarray, k: np.ndarray) -> np.ndarray:
    return 2 * np.pi * np.maximum(c, 0) / k


def inner_product(c: np.ndarray, k: np.ndarray) -> np.ndarray:
    """With the cosine lobe 1.17 exp(2.133 (cos - 1)) as the clamped cosine."""
    length = np.sqrt(k * k + 2.133**2 + 2 * 2.133 * k * c)
    return 2 * np.pi * 1.17 * np.exp(length - k - 2.133) * -np.expm1(-2 * length) / length


def hill(c: np.ndarray, k: np.ndarray) -> np.ndarray:
    c0, c1 = 0.36, 1 / (4 * 0.36)
    once, twice = np.exp(-k), np.exp(-2 * k)
    scale, bias = 1 + 2 * twice - 1 / k, (once - twice) / k - twice
    x = np.sqrt(1 - scale)
    x0, x1 = c0 * c, c1 * x
    y = np.where(np.abs(x0) <= x1, (x0 + x1) ** 2 / x, np.maximum(c, 0))
    return (scale * y + bias) * 2 * np.pi / k


def product(c: np.ndarray, k: np.ndarray, about_normal: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The product with exp(about_normal (cos - 1)): its sharpness, its amplitude, and the cosine of its axis."""
    sharpness = np.sqrt(k * k + about_normal**2 + 2 * k * about_normal * c)
    return sharpness, np.exp(sharpness - k - about_normal), (k * c + about_normal) / sharpness


def meder_bruederlin(c: np.ndarray, k: np.ndarray) -> np.ndarray:
    def hemisphere(c: Any, k: Any) -> Any:
        t = k**1.5 * (-1.6988 * k - 10.8438) / ((k + 6.2201) * k + 10.2415)
        v = t * c
        f = np.expm1(t + v) / (np.expm1(t) * (1 + np.exp(v)))
        return (np.exp(-k) - np.expm1(-k) * f) * -np.expm1(-k) / k

    sharpness, amplitude, axis = product(c, k, 0.0315)
    return np.pi * np.maximum(0, 65.416 * hemisphere(axis, sharpness) * amplitude - 63.4006 * hemisphere(c, k))


def tokuyoshi_2022(c: np.ndarray, k: np.ndarray) -> np.ndarray:
    def hemisphere(c: Any, k: Any) -> Any:
        top = 0.5 * k + 0.6517328826907056
        s = k * np.sqrt(top / ((k + 1.3418280033141287) * k + 7.221668779895671))
        f = 0.5 + 0.5 * special.erf(s * c) / special.erf(s)
        return (np.exp(-k) - np.expm1(-k) * f) * -np.expm1(-k) / k

    sharpness, amplitude, axis = product(c, k, 0.00084560872241480124)
    amplitude = amplitude * np.exp(0.00084560872241480124)
    return 2 * np.pi * 1182.2467339678153 * np.maximum(0, hemisphere(axis, sharpness) * amplitude - hemisphere(c, k))


def tokuyoshi_2024(c: np.ndarray, k: np.ndarray) -> np.ndarray:
    top = (k + 2.7360831611272558) * k + 17.021297781741876
    bottom = ((k + 4.010082672851042) * k + 15.21915626314721) * k + 76.08789627236074
    t = k * np.sqrt(0.5 * top / bottom)
    smooth = np.exp(-((t * c) ** 2)) * np.expm1(t * t * (c * c - 1)) / (2 * np.sqrt(np.pi) * t)
    f = 0.5 * (c * special.erfc(-t * c) + special.erfc(t)) - smooth
    once = -np.expm1(-k) / k
    upper, lower = (1 - once) / k, np.exp(-k) * (once - np.exp(-k)) / k
    return 2 * np.pi * (lower + (upper - lower) * f)


def irradiance(fit: Callable[..., Any]) -> Callable[[], Callable[..., Any]]:
    def sigma(u: Any, alpha: Any) -> Any:
        k = 2 / alpha**2
        return fit(u, k) * k / (-2 * np.pi * np.expm1(-2 * k))

    return lambda: sigma


# --- all of them ------------------------------------------------------------------------------------------


def kernel(accuracy: str) -> Callable[..., Any]:
    return lambda u, alpha: kernels.sigma_spherical_gaussian(u, alpha, accuracy=accuracy)


def compiled(threads: int) -> Callable[..., Any]:
    from xsec_sym.kernels import compiled as loops

    return lambda u, alpha: loops.sigma_spherical_gaussian(u, alpha, threads=threads)


RIVALS = {
    "punctual": (punctual, "irradiance of a lobe as that of a direction"),
    "inner product": (inner_product, "product with a cosine lobe of 1.17 and 2.133"),
    "Hill": (hill, "S. Hill, 2016, a fit"),
    "Meder-Brüderlin": (meder_bruederlin, "J. Meder, B. Brüderlin, 2018"),
    "Tokuyoshi 2022": (tokuyoshi_2022, "Y. Tokuyoshi, 2022"),
    "Tokuyoshi 2024": (tokuyoshi_2024, "Y. Tokuyoshi, 2024"),
}

METHODS = (
    Method("kernel", "xsec:sg-integral", kernel, curve=along(accuracy=("fast", "full")), single=True, ours=True),
    Method(
        "kernel for one roughness",
        "xsec:sg-integral",
        kernels.specialize_spherical_gaussian,
        curve=along(tol=(1e-3, 1e-5, 1e-7, 1e-10, 5e-16, None)),
        folds=True,
        single=True,
        ours=True,
    ),
    Method(
        "kernel, compiled",
        "xsec:sg-integral",
        compiled,
        kind="compiled loop",
        curve=along(threads=(1,)),
        single=True,
        needs="numba",
        ours=True,
    ),
    Method(
        "Chebyshev series",
        "xsec:sg-chebyshev",
        chebyshev,
        kind="series",
        curve=along(n=(2, 4, 8, 16, 32, 64, 128)),
        folds=True,
    ),
    Method("positive integral", "xsec:sg-positive", positive, kind="quadrature", curve=along(n=(4, 8, 16, 32, 64))),
    Method("spherical harmonics", "deon2016:38", harmonics, kind="series", curve=along(n=(2, 4, 8, 16, 32))),
    Method("Beckmann", "deon2016:22", lambda: kernels.sigma_beckmann, model="sigma_beckmann", kind="other model"),
    Method("Beckmann, odd part", "deon2016:40", lambda: beckmann_with_odd_part, kind="approximation"),
    Method("harmonics to l = 2", "deon2016:44", lambda: three_harmonics, kind="approximation"),
    Method("error function", "deon2016:41", lambda: fitted_at_the_equator, kind="approximation"),
    *(Method(name, source, irradiance(fit), kind="fit in use") for name, (fit, source) in RIVALS.items()),
    *quadratures(kernels.ndf_spherical_gaussian, surfaces.ndf_spherical_gaussian.__wrapped__),
)

FIELDS = (Field(QUANTITY, METHODS),)
