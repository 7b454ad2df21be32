"""The cross-sections of Beckmann's distribution, of GGX and of the ellipsoidal one.

a stands for u/(alpha sqrt(1 - u^2)), the slope of the direction of view over the roughness.
"""

from __future__ import annotations

from collections.abc import Callable
from math import atanh, erf, erfc, exp, log, log1p, sqrt
from typing import Any

import numpy as np
from scipy import special

from xsec_sym import kernels
from xsec_sym.study.method import Argument, Columns, Field, Method, Quantity, along
from xsec_sym.study.methods import smith
from xsec_sym.study.methods.common import NODES, cosine, decades, facing, grazing, loop, near, quadratures
from xsec_sym.study.methods.rings import clamped_cosine, even_orders
from xsec_sym.study.references import surfaces as reference

ALPHA = decades(-4, 4, parts=2)
USUAL = {"alpha": (0.01, 3.16)}
ROOT_PI = np.sqrt(np.pi)


def with_ring_lemma(ndf: Callable[..., Any], breakpoints: tuple[float, ...] = ()) -> Method:
    """The library's own adaptive integral of any distribution."""

    def make(shape: float) -> Callable[..., Any]:
        return kernels.cross_section(lambda x: ndf(x, shape), rtol=1e-6, breakpoints=breakpoints)

    return Method(
        "cross_section",
        "deon2016:15",
        make,
        kind="quadrature",
        folds=True,
        most=25,
        ours=True,
    )


def both_sides(lambda_: Callable[..., Any]) -> Callable[..., Any]:
    """sigma(u) = max(u, 0) + |u| Lambda(|u|)."""
    return lambda u, alpha: np.maximum(u, 0) + np.abs(u) * lambda_(np.abs(u), alpha)


def with_mitsuba(kind: str) -> Callable[[], Callable[[float, float], float]]:
    def make() -> Callable[[float, float], float]:
        lambda_ = smith.mitsuba(kind)()
        return lambda u, alpha: max(u, 0.0) + abs(u) * lambda_(abs(u), alpha)

    return make


# --- Beckmann ---------------------------------------------------------------------------------------------


def in_the_dark(rng: np.random.Generator, n: int) -> Columns:
    """Dark sides with -26 < a < -3."""
    alpha = ALPHA.draw(rng, n)
    return -smith.cosine_of(rng.uniform(3, 26, n), alpha), alpha


BECKMANN = Quantity(
    "sigma_beckmann",
    "cross-section of Beckmann's distribution",
    running=(cosine(),),
    set=(ALPHA,),
    usual=USUAL,
    reference=reference.sigma_beckmann,
    trouble={"grazing": grazing(ALPHA), "facing": facing(ALPHA), "dark side": in_the_dark},
    typical=((0.1,), (0.5,)),
    per_cell=(2, 2),
)


def beckmann_printed(u: Any, alpha: Any) -> Any:
    """`deon2016:22`, mended: the printed exponent is +a^2."""
    s = np.sqrt(1 - u * u)
    a = u / (alpha * s)
    return (u * (1 + special.erf(a)) + alpha * s * np.exp(-a * a) / ROOT_PI) / 2


def beckmann_by_erfc(u: Any, alpha: Any) -> Any:
    s = np.sqrt((1 - u) * (1 + u))
    a = u / (alpha * s)
    return (u * special.erfc(-a) + alpha * s * np.exp(-a * a) / ROOT_PI) / 2


def beckmann_by_erfcx(u: Any, alpha: Any) -> Any:
    v, spread = np.abs(u), alpha * np.sqrt((1 - u) * (1 + u))
    a = v / spread
    return np.maximum(u, 0) + spread * np.exp(-a * a) * (1 / ROOT_PI - a * special.erfcx(a)) / 2


def over_slopes(n: int) -> Callable[..., Any]:
    """The mean of max(0, u - s p) over Gaussian slopes p, by n Gauss-Hermite nodes."""
    nodes, weights = np.polynomial.hermite.hermgauss(n)

    def sigma(u: Any, alpha: Any) -> Any:
        spread = alpha * np.sqrt((1 - u) * (1 + u))
        return sum(w * np.maximum(0, u - spread * p) for p, w in zip(nodes, weights, strict=True)) / ROOT_PI

    return sigma


def compiled_erf(u: float, alpha: float) -> float:
    s = sqrt(1.0 - u * u)
    a = u / (alpha * s)
    return 0.5 * (u * (1.0 + erf(a)) + alpha * s * exp(-a * a) / 1.772453850905516)


def compiled_erfc(u: float, alpha: float) -> float:
    s = sqrt((1.0 - u) * (1.0 + u))
    a = u / (alpha * s)
    return 0.5 * (u * erfc(-a) + alpha * s * exp(-a * a) / 1.772453850905516)


P, Q = smith.P, smith.Q


def compiled_quotient(u: float, alpha: float) -> float:
    """The kernel's rational function of the slope, without the exponent's second double."""
    v = abs(u)
    spread = alpha * sqrt((1.0 - v) * (1.0 + v))
    if spread == 0.0 or v > 28.0 * spread:
        return max(u, 0.0)
    a = v / spread
    top, bottom = 0.0, 0.0
    for coefficient in P:
        top = top * a + coefficient
    for coefficient in Q:
        bottom = bottom * a + coefficient
    return max(u, 0.0) + 0.5 * spread * exp(-a * a) * top / bottom


BECKMANN_METHODS = (
    Method("kernel", "deon2016:22", lambda: kernels.sigma_beckmann, single=True, ours=True),
    Method("erf", "deon2016:22", lambda: beckmann_printed),
    Method("erfc", "deon2016:22 with erfc", lambda: beckmann_by_erfc),
    Method("erfcx", "deon2016:22 with erfcx", lambda: beckmann_by_erfcx),
    Method(
        "Gaussian slopes", "Gauss-Hermite quadrature", over_slopes, kind="quadrature", curve=along(n=(4, 8, 16, 32, 64))
    ),
    Method(
        "rational Lambda", "B. Walter et al., 2007", lambda: both_sides(smith.rational_lambda), kind="fit in use"
    ),
    Method("Mitsuba 3", "smith_g1", with_mitsuba("Beckmann"), "fit in use", serial=True, most=500, needs="mitsuba"),
    Method("GGX", "deon2016:25", lambda: kernels.sigma_ggx, model="sigma_ggx", kind="other model"),
    Method(
        "spherical Gaussian",
        "xsec:sg-integral",
        lambda: kernels.sigma_spherical_gaussian,
        model="sigma_spherical_gaussian",
        kind="other model",
    ),
    Method("compiled erf", "deon2016:22 in a loop", loop(compiled_erf), needs="numba"),
    Method("compiled erfc", "with erfc, in a loop", loop(compiled_erfc), needs="numba"),
    Method("compiled, stable", "the kernel's quotient in a loop", loop(compiled_quotient), needs="numba", ours=True),
    with_ring_lemma(kernels.ndf_beckmann, (0.0,)),
    *quadratures(kernels.ndf_beckmann, reference.ndf_beckmann.__wrapped__, 0.0, most=(30, 10), nodes=NODES),
)  # fmt: skip

# --- GGX --------------------------------------------------------------------------------------------------


def small(rng: np.random.Generator, n: int) -> Columns:
    """Dark sides where alpha tan(theta) is below 1e-3."""
    u, alpha = smith.small(rng, n)
    return -u, alpha


GGX = Quantity(
    "sigma_ggx",
    "cross-section of GGX",
    running=(cosine(),),
    set=(ALPHA,),
    usual=USUAL,
    reference=reference.sigma_ggx,
    trouble={"grazing": grazing(ALPHA), "facing": facing(ALPHA), "alpha tan < 1e-3": small},
    typical=((0.1,), (0.5,)),
    per_cell=(2, 2),
)


def ggx_printed(u: Any, alpha: Any) -> Any:
    """`deon2016:25`, as it stands."""
    return u / 2 + np.sqrt(alpha**2 - alpha**2 * u**2 + u**2) / 2


def ggx_stretched(u: Any, alpha: Any) -> Any:
    """The length of the stretched vector."""
    return (u + np.hypot(u, alpha * np.sqrt((1 - u) * (1 + u)))) / 2


def ggx_rationalised(u: Any, alpha: Any) -> Any:
    spread = alpha * alpha * (1 - u * u)
    return np.maximum(u, 0) + spread / (2 * (np.sqrt(u * u + spread) + np.abs(u)))


def compiled_ggx(u: float, alpha: float) -> float:
    return 0.5 * (u + sqrt(alpha * alpha * (1.0 - u * u) + u * u))


def compiled_stable_ggx(u: float, alpha: float) -> float:
    v = abs(u)
    spread = alpha * alpha * (1.0 - v) * (1.0 + v)
    return max(u, 0.0) + 0.5 * spread / (sqrt(v * v + spread) + v)


GGX_METHODS = (
    Method("kernel", "deon2016:25", lambda: kernels.sigma_ggx, single=True, ours=True),
    Method("as printed", "deon2016:25", lambda: ggx_printed),
    Method("stretched vector", "deon2016:25 with hypot", lambda: ggx_stretched),
    Method("rationalised", "deon2016:25 with alpha^2 (1 - u^2) above", lambda: ggx_rationalised),
    Method("through tan", "xsec:smith.ggx.above", lambda: both_sides(smith.ggx_by_angle)),
    Method("linear root", "k = alpha/2", lambda: both_sides(smith.schlick(lambda a: a / 2)()), kind="fit in use"),
    Method("Mitsuba 3", "smith_g1", with_mitsuba("GGX"), serial=True, most=500, needs="mitsuba"),
    Method("Beckmann", "deon2016:22", lambda: kernels.sigma_beckmann, model="sigma_beckmann", kind="other model"),
    Method("compiled", "deon2016:25 in a loop", loop(compiled_ggx), needs="numba"),
    Method("compiled, stable", "the kernel's form in a loop", loop(compiled_stable_ggx), needs="numba", ours=True),
    with_ring_lemma(kernels.ndf_ggx, (0.0,)),
    *quadratures(kernels.ndf_ggx, reference.ndf_ggx.__wrapped__, 0.0, most=(30, 10), nodes=NODES),
)

# --- Kagiwada and Kalaba ----------------------------------------------------------------------------------

NEAR = (1e-9, 1e-7, 1e-5, 1e-3, 0.01)
B_SHAPE = Argument("b", (0.0, *NEAR, 0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.95, *(1 - x for x in NEAR[::-1])))


def toward(limit: float) -> Callable[[np.random.Generator, int], Columns]:
    """b near 0 or 1, on a logarithmic scale."""

    def draw(rng: np.random.Generator, n: int) -> Columns:
        away = 10 ** rng.uniform(-12, -3, n)
        return rng.uniform(-1, 1, n), 1 - away if limit else away

    return draw


def facing_disk(rng: np.random.Generator, n: int) -> Columns:
    return near(rng, n, 1.0), 1 - 10 ** rng.uniform(-12, -1, n)


ELLIPSOIDAL = Quantity(
    "sigma_ellipsoidal",
    "cross-section of the ellipsoidal distribution",
    running=(cosine(),),
    set=(B_SHAPE,),
    reference=reference.sigma_ellipsoidal,
    trouble={
        "b toward 0": toward(0.0),
        "b toward 1": toward(1.0),
        "facing": facing(B_SHAPE),
        "facing, b toward 1": facing_disk,
        "grazing": grazing(B_SHAPE),
    },
    typical=((0.1,), (0.9,)),
    per_cell=(2, 2),
)


def ellipsoidal_printed(u: Any, b: Any) -> Any:
    """`deon2016:27`, mended, over 2 pi."""
    R = np.sqrt(1 - b * b * (1 - u * u))
    numerator = 1 - b * u - R + u * np.log((1 + b) * (1 - u)) - u * np.log(R - u)
    return numerator / (b * np.log((1 + b) / (1 - b)))


def ellipsoidal_regular(u: Any, b: Any) -> Any:
    """`deon2016:27.regular`, as it stands: no 0/0 at u = 1."""
    R, v = np.sqrt(b * b * (u * u - 1) + 1), np.abs(u)
    numerator = 1 - b * u - R + v * np.log((R + v) / ((b + 1) * (v + 1)))
    return numerator / (b * np.log((b + 1) / (1 - b))) + np.maximum(0, u) / b


def powers_of_b(n: int) -> Callable[..., Any]:
    """The distribution's geometric series, each power of the cosine with its own cross-section."""

    def sigma(u: Any, b: Any) -> Any:
        total = sum(b**p * kernels.sigma_power(u, p) for p in range(n))
        return total * b / (4 * np.pi * np.arctanh(b))

    return sigma


def ellipsoidal_in_legendre(b: float, n: int) -> Callable[[Any], Any]:
    """sum a_l Q_l(1/b)/Q_0(1/b) P_l(u) up to l = n; the Q_l are the smaller solution of their recurrence."""
    orders = even_orders(n)
    decay = np.arccosh(1 / b)
    # l Q_{l-1} = (2l + 1) x Q_l - (l + 1) Q_{l+1}: upward where the larger solution does not outgrow it
    if n * decay < 1:
        q = np.ones(n + 1)
        q[1] = 1 / b - 1 / np.arctanh(b)
        for l in range(1, n):
            q[l + 1] = ((2 * l + 1) / b * q[l] - l * q[l - 1]) / (l + 1)
    else:
        start = n + int(40 / decay) + 2
        ratios = np.zeros(start + 2)
        for l in range(start, 0, -1):
            ratios[l] = l / ((2 * l + 1) / b - (l + 1) * ratios[l + 1])
        q = np.cumprod(np.concatenate([[1.0], ratios[1 : n + 1]]))
    terms = clamped_cosine(orders) * q[orders]
    return lambda u: sum(c * special.eval_legendre(l, u) for l, c in zip(orders, terms, strict=True))


def compiled_ellipsoidal(u: float, b: float) -> float:
    R = sqrt(1.0 - b * b * (1.0 - u * u))
    numerator = 1.0 - b * u - R + u * log((1.0 + b) * (1.0 - u)) - u * log(R - u)
    return numerator / (b * log((1.0 + b) / (1.0 - b)))


def compiled_stable_ellipsoidal(u: float, b: float) -> float:
    """The kernel's form; c - log(1 + c) by its series where it cancels."""
    if b < 1e-30:
        return 0.25
    v = abs(u)
    c = b if u < 0.0 else -b
    y = (1.0 - v) * b * b / (1.0 + sqrt(b * b * v * v + (1.0 - b) * (1.0 + b)))
    if abs(c) > 0.2:
        defect = c - log1p(c)
    else:
        defect, power = 0.0, c * c
        for k in range(2, 26):
            defect += power / k
            power *= -c
    return (y + v * (y + log1p(-y) + defect)) / (2.0 * b * atanh(b))


ELLIPSOIDAL_METHODS = (
    Method("kernel", "deon2016:27.regular", lambda: kernels.sigma_ellipsoidal, single=True, ours=True),
    Method("as printed", "deon2016:27", lambda: ellipsoidal_printed),
    Method("regular at the pole", "deon2016:27.regular", lambda: ellipsoidal_regular),
    Method("powers of b", "deon2016:T1.even.s", powers_of_b, kind="series", curve=along(n=(4, 16, 48))),
    Method(
        "Legendre series",
        "addition theorem",
        ellipsoidal_in_legendre,
        kind="series",
        curve=along(n=(4, 16, 64)),
        folds=True,
    ),
    Method("compiled", "deon2016:27 in a loop", loop(compiled_ellipsoidal), needs="numba"),
    Method(
        "compiled, stable", "the kernel's form in a loop", loop(compiled_stable_ellipsoidal), needs="numba", ours=True
    ),
    with_ring_lemma(kernels.ndf_ellipsoidal),
    *quadratures(kernels.ndf_ellipsoidal, reference.ndf_ellipsoidal.__wrapped__, most=(30, 10), nodes=NODES),
)

FIELDS = (
    Field(BECKMANN, BECKMANN_METHODS),
    Field(GGX, GGX_METHODS),
    Field(ELLIPSOIDAL, ELLIPSOIDAL_METHODS),
)
