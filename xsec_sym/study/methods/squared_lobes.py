"""The squared spheroidal and ellipsoidal lobes: kernels, forms in print, and the lobes that they stand in for."""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt
from typing import Any

import numpy as np
from mpmath import mp, mpf

from xsec_sym import kernels
from xsec_sym.study.method import Argument, Columns, Field, Method, Quantity, along
from xsec_sym.study.methods.common import cosine, decades, loop, near
from xsec_sym.study.references import squared_lobes as reference

# --- the spheroid -----------------------------------------------------------------------------------------

ALPHA = decades(-4, 0, parts=4)
USUAL = {"alpha": (0.01, 1.0)}


def peak(rng: np.random.Generator, n: int) -> Columns:
    """Within some widths of the axis."""
    alpha = ALPHA.draw(rng, n)
    return np.cos(np.minimum(np.pi, 2 * alpha * 10 ** rng.uniform(-3, 1, n))), alpha


def opposite(rng: np.random.Generator, n: int) -> Columns:
    return near(rng, n, -1.0), ALPHA.draw(rng, n)


SSL = Quantity(
    "ssl",
    "squared spheroidal lobe",
    running=(cosine("cos_theta"),),
    set=(ALPHA,),
    usual=USUAL,
    reference=reference.ssl,
    trouble={
        "peak": peak,
        "axis": lambda rng, n: (near(rng, n, 1.0), ALPHA.draw(rng, n)),
        "opposite": opposite,
    },
    typical=((0.1,), (0.5,)),
    per_cell=(2, 2),
)


def ssl_printed(m: Any, alpha: Any) -> Any:
    return 4 * alpha**4 / (alpha**2 * (m + 1) - m + 1) ** 2


def ssl_collected(m: Any, alpha: Any) -> Any:
    """The denominator as 1 + alpha^2 - m (1 - alpha^2)."""
    square = alpha * alpha
    return (2 * square / (1 + square - m * (1 - square))) ** 2


def ssl_half_angle(m: Any, alpha: Any) -> Any:
    """GGX in its customary form, with the cosine of half the angle, over its peak."""
    half = np.sqrt((1 + m) / 2)
    return (alpha * alpha / (half * half * (alpha * alpha - 1) + 1)) ** 2


def ssl_tangent(m: Any, alpha: Any) -> Any:
    """With tan^2 of half the angle, from the angle."""
    t = np.tan(np.arccos(m) / 2) ** 2
    return ((1 + t) * alpha**2 / (alpha**2 + t)) ** 2


def ssl_by_sel(m: Any, alpha: Any) -> Any:
    """The kernel of the ellipsoidal lobe, in the direction with this cosine."""
    return kernels.sel(np.sqrt((1 - m) * (1 + m)), 0.0, m, alpha, alpha)


def ssl_chebyshev(alpha: float, n: int) -> Callable[[Any], Any]:
    interpolate: Callable[..., Any] = np.polynomial.chebyshev.chebinterpolate
    series = interpolate(lambda m: kernels.ssl(m, alpha), n - 1)
    return lambda m: np.polynomial.chebyshev.chebval(m, series)


def gaussian(m: Any, alpha: Any) -> Any:
    """The spherical Gaussian with the same peak and curvature there."""
    return np.exp((m - 1) / alpha**2)


def arbitrary(function: Callable[..., Any], digits: int) -> Callable[..., float]:
    def value(*arguments: float) -> float:
        with mp.workdps(digits):
            return float(function(*map(mpf, arguments)))

    return value


def ssl_mpmath(m: Any, alpha: Any) -> Any:
    return 4 * alpha**4 / (alpha**2 * (1 + m) + 1 - m) ** 2


def compiled_ssl(m: float, alpha: float) -> float:
    square = alpha * alpha
    root = 2.0 * square / (square * (1.0 + m) + (1.0 - m))
    return root * root


SSL_METHODS = (
    Method("kernel", "tokuyoshi_harada:ssl", lambda: kernels.ssl, single=True, ours=True),
    Method("as printed", "tokuyoshi_harada:ssl", lambda: ssl_printed),
    Method("collected", "1 + alpha^2 - m (1 - alpha^2)", lambda: ssl_collected),
    Method("GGX at half the angle", "xsec:ggx-forms.tokuyoshi_harada", lambda: ssl_half_angle),
    Method("through the angle", "tan of half the angle", lambda: ssl_tangent),
    Method("sel", "tokuyoshi_harada:K.U", lambda: ssl_by_sel, ours=True),
    Method(
        "Chebyshev interpolant",
        "interpolation of the kernel",
        ssl_chebyshev,
        kind="table",
        curve=along(n=(4, 16, 64)),
        folds=True,
    ),
    Method("spherical Gaussian", "dupuy2016:28", lambda: gaussian, model="spherical Gaussian", kind="other model"),
    Method(
        "mpmath",
        "tokuyoshi_harada:ssl",
        lambda digits: arbitrary(ssl_mpmath, digits),
        kind="arbitrary precision",
        curve=along(digits=(15, 30)),
        serial=True,
        most=500,
    ),
    Method("compiled", "the kernel's form in a loop", loop(compiled_ssl), needs="numba", ours=True),
)

# --- the ellipsoid ----------------------------------------------------------------------------------------

ANGLES = (0.0, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.05, 0.2, 0.6, 1.0, np.pi / 2, 2.0, 2.6, 3.0, np.pi)


def direction(theta: Any, phi: Any) -> Columns:
    """The unit vector of a polar angle and an azimuth."""
    s = np.sin(theta)
    return s * np.cos(phi), s * np.sin(phi), np.cos(theta)


def roughnesses(rng: np.random.Generator, n: int) -> Columns:
    return 10 ** rng.uniform(-4, 0, n), 10 ** rng.uniform(-4, 0, n)


def around(rng: np.random.Generator, n: int) -> np.ndarray:
    return rng.uniform(0, 2 * np.pi, n)


def sharp_peak(rng: np.random.Generator, n: int) -> Columns:
    """Within some widths of the axis."""
    alpha_x, alpha_y = roughnesses(rng, n)
    theta = np.minimum(1.5, np.minimum(alpha_x, alpha_y) * 10 ** rng.uniform(-3, 1, n))
    return theta, around(rng, n), alpha_x, alpha_y


def behind(rng: np.random.Generator, n: int) -> Columns:
    return np.pi - 10 ** rng.uniform(-9, 0, n), around(rng, n), *roughnesses(rng, n)


def round_lobe(rng: np.random.Generator, n: int) -> Columns:
    alpha = 10 ** rng.uniform(-4, 0, n)
    return np.pi * rng.random(n), around(rng, n), alpha, alpha


SEL = Quantity(
    "sel",
    "squared ellipsoidal lobe",
    running=(Argument("theta", ANGLES), Argument("phi", (0.0, np.pi, 2 * np.pi))),
    set=(decades(-4, 0, parts=1, name="alpha_x"), decades(-4, 0, parts=1, name="alpha_y")),
    usual={"alpha_x": (0.01, 1.0), "alpha_y": (0.01, 1.0)},
    reference=reference.sel,
    trouble={"peak": sharp_peak, "behind": behind, "alpha_x = alpha_y": round_lobe},
    typical=((0.1, 0.1), (0.5, 0.05)),
    per_cell=(2, 2),
    embed=direction,
)


def parts(x: Any, y: Any, z: Any, alpha_x: Any, alpha_y: Any) -> tuple[Any, Any]:
    """alpha_max^2 and U."""
    square = np.maximum(alpha_x, alpha_y) ** 2
    return square, np.sqrt(square * ((x / alpha_x) ** 2 + (y / alpha_y) ** 2) + z * z)


def sel_printed(x: Any, y: Any, z: Any, alpha_x: Any, alpha_y: Any) -> Any:
    """`tokuyoshi_harada:K.U`, as it stands."""
    square, U = parts(x, y, z, alpha_x, alpha_y)
    return 4 * square**2 / (-z + (z + U) * square + U) ** 2


def sel_collected(x: Any, y: Any, z: Any, alpha_x: Any, alpha_y: Any) -> Any:
    """`tokuyoshi_harada:K.E`, as it stands."""
    square, U = parts(x, y, z, alpha_x, alpha_y)
    return 4 * square**2 / (-z * (1 - square) + (square + 1) * U) ** 2


def sel_summed(x: Any, y: Any, z: Any, alpha_x: Any, alpha_y: Any) -> Any:
    """U - z as (U^2 - z^2)/(U + z), where z > 0."""
    square = np.maximum(alpha_x, alpha_y) ** 2
    S = square * ((x / alpha_x) ** 2 + (y / alpha_y) ** 2)
    U = np.sqrt(S + z * z)
    above = U + np.abs(z)
    plus, minus = np.where(z > 0, above, S / above), np.where(z > 0, S / above, above)
    return (2 * square / (minus + square * plus)) ** 2


def sel_by_ray(x: Any, y: Any, z: Any, alpha_x: Any, alpha_y: Any) -> Any:
    """`tokuyoshi_harada:3`: the intersection of a ray with a unit sphere."""
    square = np.maximum(alpha_x, alpha_y) ** 2
    d = x / alpha_x, y / alpha_y, 2 * z / (square + 1)
    s = (square - 1) / (square + 1)
    dd, ds = d[0] ** 2 + d[1] ** 2 + d[2] ** 2, d[2] * s
    return ((np.sqrt(ds * ds - dd * (s * s - 1)) - ds) / dd) ** 2


def sel_as_round(x: Any, y: Any, z: Any, alpha_x: Any, alpha_y: Any) -> Any:
    return kernels.ssl(np.clip(z, -1, 1), np.sqrt(alpha_x * alpha_y))


def anisotropic_gaussian(x: Any, y: Any, z: Any, alpha_x: Any, alpha_y: Any) -> Any:
    """The anisotropic spherical Gaussian with the same peak and curvatures there."""
    return np.maximum(z, 0) * np.exp(-0.5 * (x / alpha_x) ** 2 - 0.5 * (y / alpha_y) ** 2)


def compiled_printed(x: float, y: float, z: float, alpha_x: float, alpha_y: float) -> float:
    square = max(alpha_x, alpha_y) ** 2
    U = sqrt(square * ((x / alpha_x) ** 2 + (y / alpha_y) ** 2) + z * z)
    root = 2.0 * square / (U - z + (U + z) * square)
    return root * root


def compiled_summed(x: float, y: float, z: float, alpha_x: float, alpha_y: float) -> float:
    square = max(alpha_x, alpha_y) ** 2
    S = square * ((x / alpha_x) ** 2 + (y / alpha_y) ** 2)
    above = sqrt(S + z * z) + abs(z)
    root = 2.0 * square / (S / above + square * above if z > 0.0 else above + square * S / above)
    return root * root


def sel_mpmath(*arguments: Any) -> Any:
    return reference.distance.__wrapped__(*arguments) ** 2


SEL_METHODS = (
    Method("kernel", "tokuyoshi_harada:K.U", lambda: kernels.sel, single=True, ours=True),
    Method("as printed", "tokuyoshi_harada:K.U", lambda: sel_printed),
    Method("collected", "tokuyoshi_harada:K.E", lambda: sel_collected),
    Method("U - z as a sum", "(U^2 - z^2)/(U + z)", lambda: sel_summed),
    Method("ray and sphere", "tokuyoshi_harada:3", lambda: sel_by_ray),
    Method("geometric mean", "tokuyoshi_harada:ssl", lambda: sel_as_round, model="ssl", kind="other model"),
    Method(
        "anisotropic Gaussian",
        "K. Xu et al., 2013",
        lambda: anisotropic_gaussian,
        model="anisotropic spherical Gaussian",
        kind="other model",
    ),
    Method(
        "mpmath",
        "ray and ellipsoid",
        lambda digits: arbitrary(sel_mpmath, digits),
        kind="arbitrary precision",
        curve=along(digits=(15, 30)),
        serial=True,
        most=500,
    ),
    Method("compiled", "tokuyoshi_harada:K.U in a loop", loop(compiled_printed), needs="numba"),
    Method("compiled, stable", "U - z as a sum, in a loop", loop(compiled_summed), needs="numba", ours=True),
)

FIELDS = (Field(SSL, SSL_METHODS), Field(SEL, SEL_METHODS))
