"""Smith's Lambda for Beckmann's distribution and for GGX: kernels, forms in print, and what renderers compute.

a stands for 1/(alpha tan(theta)), the slope of the direction of view over the roughness.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache
from math import erf, erfc, exp, sqrt
from typing import Any

import numpy as np
from scipy import special

from xsec_sym import kernels
from xsec_sym.kernels import beckmann
from xsec_sym.study.method import Columns, Field, Method, Quantity, along
from xsec_sym.study.methods.common import NODES, cosine, decades, loop, near, quadratures
from xsec_sym.study.references import surfaces as reference

ROOT_PI = np.sqrt(np.pi)
# Where the rational fit of Beckmann's masking ends.
END = 1.6
ALPHA = decades(-4, 4, parts=2)
USUAL = {"alpha": (0.01, 3.16)}


def slope(u: Any, alpha: Any) -> Any:
    return u / (alpha * np.sqrt(1 - u * u))


def cosine_of(a: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """The cosine with this slope."""
    return a * alpha / np.hypot(1, a * alpha)


def slopes(low: float, high: float) -> Callable[[np.random.Generator, int], Columns]:
    """Cosines whose slopes fill a range, whatever the roughness."""

    def draw(rng: np.random.Generator, n: int) -> Columns:
        alpha = ALPHA.draw(rng, n)
        return cosine_of(rng.uniform(low, high, n), alpha), alpha

    return draw


def horizon(rng: np.random.Generator, n: int) -> Columns:
    return 10 ** rng.uniform(-20, -2, n), ALPHA.draw(rng, n)


def axis(rng: np.random.Generator, n: int) -> Columns:
    return np.abs(near(rng, n, 1.0)), ALPHA.draw(rng, n)


# --- Beckmann ---------------------------------------------------------------------------------------------

BECKMANN = Quantity(
    "lambda_beckmann",
    "Smith's Lambda of Beckmann's distribution",
    running=(cosine(both=False),),
    set=(ALPHA,),
    usual=USUAL,
    reference=reference.lambda_beckmann,
    trouble={
        "1.548 < a < 1.6": slopes(1.548, END),
        "3 < a < 26": slopes(3, 26),
        "horizon": horizon,
        "axis": axis,
    },
    typical=((0.1,), (0.5,)),
    per_cell=(2, 3),
)


def beckmann_by_erf(u: Any, alpha: Any) -> Any:
    """`xsec:smith.beckmann.lambda`, as it stands."""
    a = slope(u, alpha)
    return (special.erf(a) - 1 + np.exp(-a * a) / (a * ROOT_PI)) / 2


def beckmann_by_erfc(u: Any, alpha: Any) -> Any:
    a = slope(u, alpha)
    return (np.exp(-a * a) / (a * ROOT_PI) - special.erfc(a)) / 2


def beckmann_by_erfcx(u: Any, alpha: Any) -> Any:
    a = slope(u, alpha)
    return np.exp(-a * a) * (1 / (a * ROOT_PI) - special.erfcx(a)) / 2


def beckmann_far(n: int) -> Callable[..., Any]:
    """The asymptotic series for large a, n terms: the second term of erfc's is the first that is left."""
    coefficients = np.cumprod([0.5, *(-(k + 0.5) for k in range(1, n))])

    def value(u: Any, alpha: Any) -> Any:
        a = slope(u, alpha)
        return np.exp(-a * a) / (2 * ROOT_PI * a**3) * np.polynomial.polynomial.polyval(a**-2.0, coefficients)

    return value


def rational_lambda(u: Any, alpha: Any) -> Any:
    a = slope(u, alpha)
    return np.where(a < END, ((0.396 * a - 1.259) * a + 1) / ((2.181 * a + 3.535) * a), 0.0)


def rational_masking(u: Any, alpha: Any) -> Any:
    """The fit of G1, turned into Lambda."""
    a = slope(u, alpha)
    g1 = np.where(a < END, (3.535 + 2.181 * a) * a / (1 + (2.276 + 2.577 * a) * a), 1.0)
    return 1 / g1 - 1


def from_cross_section(sigma: Callable[..., Any]) -> Callable[[], Callable[..., Any]]:
    return lambda: lambda u, alpha: sigma(u, alpha) / u - 1


def compiled_beckmann(u: float, alpha: float) -> float:
    a = u / (alpha * sqrt(1.0 - u * u))
    return 0.5 * (erf(a) - 1.0 + exp(-a * a) / (a * 1.772453850905516))


def compiled_complement(u: float, alpha: float) -> float:
    a = u / (alpha * sqrt((1.0 - u) * (1.0 + u)))
    return 0.5 * (exp(-a * a) / (a * 1.772453850905516) - erfc(a))


P, Q = beckmann._P, beckmann._Q


def compiled_quotient(u: float, alpha: float) -> float:
    """The kernel's rational function of the slope, without the exponent's second double."""
    if u == 1.0 or alpha == 0.0:
        return 0.0
    a = u / (alpha * sqrt((1.0 - u) * (1.0 + u)))
    if a > 28.0:
        return 0.0
    top, bottom = 0.0, 0.0
    for coefficient in P:
        top = top * a + coefficient
    for coefficient in Q:
        bottom = bottom * a + coefficient
    return 0.5 * exp(-a * a) * top / (bottom * a)


def compiled_rational(u: float, alpha: float) -> float:
    a = u / (alpha * sqrt(1.0 - u * u))
    if a >= 1.6:
        return 0.0
    return ((0.396 * a - 1.259) * a + 1.0) / ((2.181 * a + 3.535) * a)


# --- GGX --------------------------------------------------------------------------------------------------


def small(rng: np.random.Generator, n: int) -> Columns:
    """Where alpha tan(theta) is below 1e-3."""
    alpha = 10 ** rng.uniform(-4, 1, n)
    return 1 / np.hypot(1, 10 ** rng.uniform(-7, -3, n) / alpha), alpha


GGX = Quantity(
    "lambda_ggx",
    "Smith's Lambda of GGX",
    running=(cosine(both=False),),
    set=(ALPHA,),
    usual=USUAL,
    reference=reference.lambda_ggx,
    trouble={"alpha tan < 1e-3": small, "horizon": horizon, "axis": axis},
    typical=((0.1,), (0.5,)),
    per_cell=(2, 3),
)


def ggx_printed(u: Any, alpha: Any) -> Any:
    """`xsec:smith.ggx.lambda`, as it stands."""
    return np.sqrt(1 + alpha**2 * (1 - u * u) / u**2) / 2 - 0.5


def ggx_by_angle(u: Any, alpha: Any) -> Any:
    return (np.sqrt(1 + (alpha * np.tan(np.arccos(u))) ** 2) - 1) / 2


def ggx_by_cosine(u: Any, alpha: Any) -> Any:
    square = alpha * alpha
    return (np.sqrt(square + (1 - square) * u * u) / u - 1) / 2


def ggx_rationalised(u: Any, alpha: Any) -> Any:
    x = alpha * alpha * (1 - u * u) / (u * u)
    return x / (2 * (np.sqrt(1 + x) + 1))


def schlick(k: Callable[[Any], Any]) -> Callable[[], Callable[..., Any]]:
    """G1 = u/(u (1 - k) + k)."""
    return lambda: lambda u, alpha: k(alpha) * (1 - u) / u


def compiled_ggx(u: float, alpha: float) -> float:
    return 0.5 * (sqrt(1.0 + alpha * alpha * (1.0 - u * u) / (u * u)) - 1.0)


def compiled_stable_ggx(u: float, alpha: float) -> float:
    spread = alpha * alpha * (1.0 - u) * (1.0 + u)
    return 0.5 * spread / (u * (sqrt(u * u + spread) + u))


# --- both -------------------------------------------------------------------------------------------------


@cache
def _of_mitsuba(kind: str, alpha: float) -> Any:
    import mitsuba

    mitsuba.set_variant("scalar_rgb")
    return mitsuba.MicrofacetDistribution(getattr(mitsuba.MicrofacetType, kind), alpha, False)


def mitsuba(kind: str) -> Callable[[], Callable[[float, float], float]]:
    """1/G1 - 1 with Mitsuba's masking, which it computes in float32, for a direction at a time."""

    def value(u: float, alpha: float) -> float:
        g1 = _of_mitsuba(kind, alpha).smith_g1([sqrt((1 - u) * (1 + u)), 0.0, u], [0.0, 0.0, 1.0])
        return 1 / float(g1) - 1 if g1 > 0 else np.inf

    return lambda: value


def over_cosine(methods: Iterable[Method]) -> tuple[Method, ...]:
    """Methods for sigma as ones for Lambda, sigma(-u)/u."""

    def divided(make: Callable[..., Any]) -> Callable[..., Any]:
        def made(**parameters: Any) -> Callable[..., Any]:
            sigma = make(**parameters)
            return lambda u, alpha: sigma(-u, alpha) / u

        return made

    return tuple(replace(method, make=divided(method.make)) for method in methods)


BECKMANN_METHODS = (
    Method("kernel", "xsec:smith.beckmann.lambda", lambda: kernels.lambda_beckmann, single=True, ours=True),
    Method("erf", "xsec:smith.beckmann.lambda", lambda: beckmann_by_erf),
    Method("erfc", "xsec:smith.beckmann.lambda with erfc", lambda: beckmann_by_erfc),
    Method("erfcx", "xsec:smith.beckmann.lambda with erfcx", lambda: beckmann_by_erfcx),
    Method("sigma/u - 1", "dupuy2016:19", from_cross_section(kernels.sigma_beckmann)),
    Method("asymptotic series", "large a", beckmann_far, kind="series", curve=along(n=(1, 2, 4, 8))),
    Method("rational Lambda", "B. Walter et al., 2007, as Lambda", lambda: rational_lambda, kind="fit in use"),
    Method("rational G1", "B. Walter et al., 2007", lambda: rational_masking, kind="fit in use"),
    Method("Mitsuba 3", "smith_g1", mitsuba("Beckmann"), kind="fit in use", serial=True, most=500, needs="mitsuba"),
    Method("GGX", "xsec:smith.ggx.lambda", lambda: kernels.lambda_ggx, model="lambda_ggx", kind="other model"),
    Method("compiled erf", "xsec:smith.beckmann.lambda in a loop", loop(compiled_beckmann), needs="numba"),
    Method("compiled erfc", "with erfc, in a loop", loop(compiled_complement), needs="numba"),
    Method(
        "compiled rational Lambda",
        "B. Walter et al., 2007, in a loop",
        loop(compiled_rational),
        kind="fit in use",
        needs="numba",
    ),
    Method("compiled, stable", "the kernel's quotient in a loop", loop(compiled_quotient), needs="numba", ours=True),
    *over_cosine(quadratures(kernels.ndf_beckmann, reference.ndf_beckmann.__wrapped__, 0.0, (30, 10), NODES)),
)

GGX_METHODS = (
    Method("kernel", "xsec:smith.ggx.lambda", lambda: kernels.lambda_ggx, single=True, ours=True),
    Method("(sqrt(1 + x) - 1)/2", "xsec:smith.ggx.lambda", lambda: ggx_printed),
    Method("through the angle", "xsec:smith.ggx.lambda with tan and arccos", lambda: ggx_by_angle),
    Method("without the tangent", "sqrt(alpha^2 + (1 - alpha^2) u^2)/u", lambda: ggx_by_cosine),
    Method("rationalised", "x/(2 (sqrt(1 + x) + 1))", lambda: ggx_rationalised),
    Method("sigma/u - 1", "dupuy2016:19", from_cross_section(kernels.sigma_ggx)),
    Method("Schlick, alpha/2", "k = alpha/2", schlick(lambda alpha: alpha / 2), kind="fit in use"),
    Method("Schlick", "C. Schlick, 1994", schlick(lambda alpha: alpha * np.sqrt(2 / np.pi)), kind="fit in use"),
    Method("Mitsuba 3", "smith_g1", mitsuba("GGX"), serial=True, most=500, needs="mitsuba"),
    Method("compiled", "xsec:smith.ggx.lambda in a loop", loop(compiled_ggx), needs="numba"),
    Method("compiled, stable", "the kernel's form in a loop", loop(compiled_stable_ggx), needs="numba", ours=True),
    *over_cosine(quadratures(kernels.ndf_ggx, reference.ndf_ggx.__wrapped__, 0.0, (30, 10), NODES)),
)

FIELDS = (Field(BECKMANN, BECKMANN_METHODS), Field(GGX, GGX_METHODS))
