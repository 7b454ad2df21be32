"""Short formulas for the half-space of Lambertian spheres, closer than those of `deon2021` at no greater cost."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from xsec_sym.kernels import _lambert_sphere_fits_tables as tables
from xsec_sym.kernels._support import elementwise


def _sum(rows: Sequence[np.ndarray | float], x: np.ndarray) -> np.ndarray:
    """The polynomial in x with these coefficients, lowest power first and at least two: numbers, or arrays like x."""
    total = rows[-1] * x
    total += rows[-2]
    for row in rows[-3::-1]:
        total *= x
        total += row
    return total


def _rows(table: list[list[float]], x: np.ndarray) -> list[np.ndarray | float]:
    return [_sum(row, x) if len(row) > 1 else row[0] for row in table]


class _Excess:
    """H - 1 of one mode for given albedos, at any cosines: sqrt(mu) and arithmetic."""

    def __init__(self, mode: int, c: np.ndarray, s: np.ndarray):
        variable = s if mode == 0 else c
        self.upper = _rows(getattr(tables, f"H{mode}_UPPER"), variable)
        self.lower: list[np.ndarray | float] = [1.0, *_rows(getattr(tables, f"H{mode}_LOWER"), variable)]
        self.c = c

    def __call__(self, mu: np.ndarray, root: np.ndarray) -> np.ndarray:
        return self.c * mu * _sum(self.upper, root) / _sum(self.lower, root)


def _h(mu: np.ndarray, c: np.ndarray, mode: np.ndarray) -> np.ndarray:
    value = np.full_like(mu, np.nan)
    inside = (mu >= 0.0) & (mu <= 1.0) & (c >= 0.0) & (c <= 1.0)
    for m in range(3):
        here = inside & (mode == m)
        if here.any():
            cosine, albedo = mu[here], c[here]
            value[here] = 1.0 + _Excess(m, albedo, np.sqrt(1.0 - albedo))(cosine, np.sqrt(cosine))
    return value


def h_lambert_sphere_fit(
    mu: np.typing.ArrayLike, c: np.typing.ArrayLike, mode: np.typing.ArrayLike
) -> np.ndarray | np.floating:
    """The H functions of the half-space with the first three terms of the Lambertian sphere's phase function, fitted.

    mu: cosine in [0, 1]. c: albedo in [0, 1]. mode: 0, 1 or 2, the Fourier mode of `deon2021:16`. Shapes broadcast;
    anything else, NaN included, gives NaN. float32 where mu and c are, float64 otherwise. TypeError for arguments that
    are no real numbers.

    In place of `deon2021:37` for mode 0, and of `deon2021:28` to 30 for mode 1: 1 + c mu times a quotient of
    polynomials in sqrt(mu), whose coefficients are polynomials in sqrt(1 - c) for mode 0 and in c otherwise. Two square
    roots, or one; no power, exponential or logarithm. Largest relative error found: 2.4e-5 for mode 0, 4e-5 for mode 1,
    1.7e-5 for mode 2. Exact at mu = 0 and at c = 0.

    >>> h_lambert_sphere_fit([0, 0.5, 1], 1.0, 0).round(3).tolist()
    [1.0, 2.051, 2.976]
    """
    return elementwise(_h, orders=("mode",), mu=mu, c=c, mode=mode)


def _multiple(
    mu_i: np.ndarray,
    mu_o: np.ndarray,
    total: np.ndarray,
    product: np.ndarray,
    cos_phi: np.ndarray,
    sines: np.ndarray,
    turned: np.ndarray,
    c: np.ndarray,
) -> np.ndarray:
    """The three modes without their single scattering, whose terms in 1/(mu_i + mu_o) alone cancel exactly."""
    s = np.sqrt(1.0 - c)
    roots = np.sqrt(mu_i), np.sqrt(mu_o)

    def excess(mode: int) -> np.ndarray:
        h = _Excess(mode, c, s)
        x, y = h(mu_i, roots[0]), h(mu_o, roots[1])
        return x + y + x * y

    a = (69.0 / 128.0) * c
    b = c * _sum(tables.B[0], s)
    d, f = c * s * _sum(tables.D[0], s), c * s * _sum(tables.F[0], s)
    c_ = 2.0 * f - c * ((20.0 * c + 281.0) * c - 346.0) / 384.0
    e = (15.0 / 128.0) * (1.0 - c) * c * ((4.0 / 3.0) * c + 3.0)
    # c_ mu_i mu_o + f (mu_i^2 + mu_o^2), and what single scattering has of either
    once = (b + d * product) * total + f * total * total
    mixed = (c_ - 2.0 * f) * product + e * product * product
    lone = c * ((45.0 / 384.0) * total * total - product * ((256.0 + 90.0) / 384.0 + (135.0 / 384.0) * product))
    zeroth = (excess(0) * (a + once + mixed) + once + mixed + lone) / (2.0 * np.pi)

    l = c * _sum(tables.L[0], s)
    slope = (5.0 / 64.0) * (4.0 * c + 9.0)
    first = excess(1) * (1.0 + slope * product + l * total) + (5.0 / 16.0) * c * product + l * total
    second = (15.0 / 256.0) * sines * (2.0 * cos_phi * cos_phi - 1.0) * excess(2)
    both = zeroth + (c / np.pi) * sines * (cos_phi * first / 3.0 + second)
    return both / total + c * c * c * (_sum(tables.POLISH[0], roots[0]) + _sum(tables.POLISH[0], roots[1]))


def _with_single(
    mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray, c: np.ndarray, multiple: Callable[..., np.ndarray]
) -> np.ndarray:
    inside = (mu_i >= 0.0) & (mu_i <= 1.0) & (mu_o >= 0.0) & (mu_o <= 1.0) & np.isfinite(phi) & (c >= 0.0) & (c <= 1.0)
    total = mu_i + mu_o
    sines = np.sqrt((1.0 - mu_i * mu_i) * (1.0 - mu_o * mu_o))
    cos_phi = np.cos(phi)
    product, turned = mu_i * mu_o, sines * cos_phi
    cosine = np.clip(product + turned, -1.0, 1.0)
    # p(-cosine) of `deon2021:1`; its relative error forward, where it vanishes, is of no account in the sum
    phase = np.maximum(np.sqrt(1.0 - cosine * cosine) + cosine * np.arccos(-cosine), 0.0)
    single = (2.0 / (3.0 * np.pi**2)) * c * phase / total
    value = np.maximum(single + multiple(mu_i, mu_o, total, product, cos_phi, sines, turned, c), 0.0)
    value[inside & (c == 0.0)] = 0.0
    value[inside & (total == 0.0)] = np.inf
    value[~inside] = np.nan
    return value


def _brdf_fit(mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray, c: np.ndarray) -> np.ndarray:
    return _with_single(mu_i, mu_o, phi, c, _multiple)


def brdf_lambert_sphere_fit(
    mu_i: np.typing.ArrayLike, mu_o: np.typing.ArrayLike, phi: np.typing.ArrayLike, c: np.typing.ArrayLike
) -> np.ndarray | np.floating:
    """The BRDF of a half-space sparsely filled with Lambertian spheres of albedo c, for any number of c, fitted.

    Per steradian (1/sr): `brdf_lambert_sphere`, to 5e-4 where both cosines are above 0.025, and to 4e-5 root mean
    square for directions and c at random there: largest errors found, of values up to 2.5. Below, to 5e-3 down to
    cosines of 1e-3, and to 0.06 down to 1e-5. The two directions may change places to the last bit. For c = 1 the
    projected integral over mu_o and phi is within 2.5e-5 of 1 for every mu_i.

    mu_i, mu_o: cosines in [0, 1]. phi: azimuth in radians between the two directions, both pointing outward, so that
    phi = 0 is backscattering. c: in [0, 1]. Shapes broadcast; anything else, NaN and infinities included, gives NaN;
    infinite where both cosines are 0. float32 for float32 arguments, float64 otherwise. TypeError for arguments that
    are no real numbers.

    `deon2021:18`, with single scattering exact and all three modes of the rest, in which `deon2021` leaves out the
    third: `h_lambert_sphere_fit` in `deon2021:27`, with 1/(3 pi) for 1/(6 pi), and in `deon2021:36`, polynomials in
    sqrt(1 - c) for its constants, and a term that gives back what light the truncated phase function loses.

    >>> brdf_lambert_sphere_fit(0.5, [0.5, 1.0], 0.0, 1.0).round(3).tolist()
    [0.414, 0.306]
    """
    return elementwise(_brdf_fit, mu_i=mu_i, mu_o=mu_o, phi=phi, c=c)


# Of `xsec_sym.export.search_fast_variant`, whose `form` this is with the constants of `polished(11)`
FAST = (0.21715, -0.13428, -0.040671, 0.19257, 0.48841, 1.3401, -0.84707, -0.16299, -0.28055, 0.17484)


def _fast(
    mu_i: np.ndarray,
    mu_o: np.ndarray,
    total: np.ndarray,
    product: np.ndarray,
    cos_phi: np.ndarray,
    sines: np.ndarray,
    turned: np.ndarray,
    c: np.ndarray,
) -> np.ndarray:
    s = np.sqrt(1.0 - c)
    k = FAST
    value = k[3] * s
    value += k[4] * product
    value /= s + k[5] * total
    value += k[0] + k[1] * s
    value += k[2] * total
    shade = (k[8] + k[9] * total) * turned
    shade += 1.0 + k[6] * s
    shade += k[7] * total
    value *= shade
    value *= 1.0 - s
    return value


def _brdf_fast(mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray, c: np.ndarray) -> np.ndarray:
    return _with_single(mu_i, mu_o, phi, c, _fast)


def brdf_lambert_sphere_fast(
    mu_i: np.typing.ArrayLike, mu_o: np.typing.ArrayLike, phi: np.typing.ArrayLike, c: np.typing.ArrayLike
) -> np.ndarray | np.floating:
    """The BRDF of a half-space of Lambertian spheres by exact single scattering and one short formula for the rest.

    Per steradian (1/sr): `brdf_lambert_sphere`, to 0.04 where both cosines are above 0.025, and to 0.005 root mean
    square for directions and c at random there: largest errors found; those of `deon2021:48` are 0.1 and 0.013.
    For middle values of c `deon2021:48` may be nearer. For c = 1 and cosines from 0.001, 95 % to 103 % of a beam
    returns. Where both cosines are smaller the truth grows as a logarithm, which it does not follow: it is off by up to
    0.7 down to cosines of 1e-5. The two directions may change places to the last bit; never negative. Beside single
    scattering it takes one square root and one division, and no power or arc cosine.

    mu_i, mu_o: cosines in [0, 1]. phi: azimuth in radians between the two directions, both pointing outward, so that
    phi = 0 is backscattering. c: in [0, 1]. Shapes broadcast; anything else, NaN and infinities included, gives NaN;
    infinite where both cosines are 0. float32 for float32 arguments, float64 otherwise. TypeError for arguments that
    are no real numbers.

    In place of `deon2021:48`; found by symbolic regression (`xsec_sym.export.search_fast_variant`).

    >>> brdf_lambert_sphere_fast(0.5, [0.5, 1.0], 0.0, 1.0).round(2).tolist()
    [0.41, 0.3]
    """
    return elementwise(_brdf_fast, mu_i=mu_i, mu_o=mu_o, phi=phi, c=c)


def _albedo(c: np.ndarray) -> np.ndarray:
    s = 1.0 - c
    np.sqrt(s, out=s)
    value = _sum(tables.ALBEDO[0], s)
    value *= c
    # The root is NaN beyond 1.
    if not c.min() >= 0.0:
        value[c < 0.0] = np.nan
    return value


def albedo_lambert_sphere_fit(c: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """The Bond albedo k_d of a half-space of Lambertian spheres of diffuse albedo c, fitted.

    c: in [0, 1]; anything else, NaN included, gives NaN. float32 for float32, float64 otherwise. TypeError for
    arguments that are no real numbers.

    `albedo_lambert_sphere` to 2.6e-5, and to a relative 5.5e-4 near c = 0: largest errors found. Exact at both ends. In
    place of `deon2021:47`, which is off by 2.3e-3 and not 0 at c = 0: c times a polynomial in sqrt(1 - c), without a
    division, in the same time.

    >>> albedo_lambert_sphere_fit([0, 0.5, 0.9, 1]).round(3).tolist()
    [0.0, 0.194, 0.539, 1.0]
    """
    return elementwise(_albedo, c=c)


def _inverse(k_d: np.ndarray) -> np.ndarray:
    r = 1.0 - k_d
    up, down = tables.INVERSE
    part = _sum(up, r)
    part *= k_d
    part /= _sum(down, r)
    # 1 - s^2 for s = 1 - part
    value = 2.0 - part
    value *= part
    if not (k_d.min() >= 0.0 and k_d.max() <= 1.0):
        value[~((k_d >= 0.0) & (k_d <= 1.0))] = np.nan
    return value


def albedo_lambert_sphere_inverse_fit(k_d: np.typing.ArrayLike) -> np.ndarray | np.floating:
    """The diffuse albedo c of Lambertian spheres that give their half-space the Bond albedo k_d, fitted.

    k_d: in [0, 1]; anything else, NaN included, gives NaN. float32 for float32, float64 otherwise. TypeError for
    arguments that are no real numbers.

    `albedo_lambert_sphere_inverse` to 6e-6, and to a relative 5e-5 near k_d = 0: largest errors found. 0 at 0, and 1 at
    1 but for rounding. In place of `deon2021:46`, without its powers: 1 - s^2, with s by a quotient of polynomials.

    >>> albedo_lambert_sphere_inverse_fit([0, 0.1935, 0.53928, 1]).round(4).tolist()
    [0.0, 0.5, 0.9, 1.0]
    """
    return elementwise(_inverse, k_d=k_d)
