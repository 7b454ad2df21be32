"""The approximations of a half-space of Lambertian spheres that deon2021 gives or compares with, by their own names.

Rivals of `brdf_lambert_sphere`, which is exact: same arguments, same meaning, and the errors that they state.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from xsec_sym.kernels._support import elementwise
from xsec_sym.kernels.lambert_sphere import _phase_at

Model = Callable[[np.ndarray, np.ndarray, np.ndarray, np.ndarray], np.ndarray]


class Reading(NamedTuple):
    """How the equations are read that cannot hold as they are printed; the default is what mends them."""

    lead: float = 3.0  # (27): c/(lead pi) H H ...
    single: float = 192.0  # (34): c (45 mu_i mu_o + 64) .../(single pi (mu_i + mu_o))
    at_one: float = 0.0242851  # (30): the coefficient of c^2
    separable_logarithm: bool = True  # (28): it is log H(mu), not H(mu), that is a function of c times one of mu
    difference: bool = True  # (39): a minus before the last number, where nothing is printed
    c_root: float = 2567.74  # (40): the coefficient of sqrt(1 - c)


MENDED = Reading()
PRINTED = Reading(6.0, 384.0, 0.242851, False, False, 24567.74)


def _single(mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray, c: np.ndarray) -> np.ndarray:
    """(17), without the division by mu_i + mu_o."""
    sines, total = _sines(mu_i, mu_o), mu_i + mu_o
    # 1 + w_i . w_o as a sum of positive terms
    t = total * total / (1.0 + mu_i * mu_o + sines) + 2.0 * sines * np.cos(phi / 2.0) ** 2
    return c * _phase_at(np.minimum(t, 2.0))


def _sines(mu_i: np.ndarray, mu_o: np.ndarray) -> np.ndarray:
    return np.sqrt(((1.0 - mu_i) * (1.0 + mu_i)) * ((1.0 - mu_o) * (1.0 + mu_o)))


def _excess_0(mu: np.ndarray, c: np.ndarray, s: np.ndarray) -> np.ndarray:
    """(37) less 1"""
    a = (1.50112 * s**6.05435 + 8.21644) / (4.17593 - 1.21222 * s)
    d = (7.7731 - 0.565811 * s**0.961546) / (8.65912 - 0.159974 * s**7)
    rise = a * mu**d
    inverse = np.sqrt((16.0 - c) * (1.0 - c) * (4.0 * c + 9.0)) / 12.0
    return rise * (1.0 - inverse) / (1.0 + rise * inverse)


def _log_h_1(mu: np.ndarray, c: np.ndarray, reading: Reading) -> np.ndarray:
    """The logarithm of (28), from (29) and (30)."""
    power = mu ** (((-1.12831 * mu + 1.85728) * mu - 1.07879) * mu + 0.459442)
    at_one = reading.at_one * c * c - 0.144839 * c
    return at_one * power if reading.separable_logarithm else at_one - 0.0894878 * power


def _mode_0(mu_i: np.ndarray, mu_o: np.ndarray, c: np.ndarray, reading: Reading) -> np.ndarray:
    """(45) times pi (mu_i + mu_o), (44) taken from (36) term by term: at grazing angles the first terms cancel."""
    s = np.sqrt(1.0 - c)
    rest = 1.0 - c
    last = 0.515357 * s - 0.084463 if reading.difference else 0.515357 * s * 0.084463
    b = (0.346689 * s**3 - 0.777574 * rest + last) / (0.182602 * rest - 0.665502 * s + 0.964893)
    c_ = (-5602.45 * s**3 + 7487.99 * rest - reading.c_root * s + 682.848) / (1480.025 * rest - 4008.33 * s + 5850.6)
    d = (166.883 * s**3 - 327.48 * rest + 160.397 * s + 0.285529) / (596.423 * rest - 412.984 * s + 674.191)
    f = (266.063 * s**3 - 21.9141 * rest - 242.16 * s - 1.9209) / (215.773 * rest + 457.42 * s + 1499.9)
    e = 15.0 / 128.0 * rest * c * (4.0 * c / 3.0 + 3.0)

    total, product, squares = mu_i + mu_o, mu_i * mu_o, mu_i * mu_i + mu_o * mu_o
    h_i, h_o = _excess_0(mu_i, c, s), _excess_0(mu_o, c, s)
    excess = h_i + h_o + h_i * h_o
    shape = (b + d * product) * total + (c_ + e * product) * product + f * squares
    single = c / 384.0 * (135.0 * product * product - 45.0 * squares + 256.0 * product)
    return 0.5 * (69.0 / 128.0 * c * excess + (1.0 + excess) * shape - single)


def _mode_1(mu_i: np.ndarray, mu_o: np.ndarray, c: np.ndarray, reading: Reading) -> np.ndarray:
    """(35) times pi (mu_i + mu_o), (34) taken from (27) term by term."""
    l = (-0.00473696 * c - 0.0589037) * c
    m = 0.44038 * c + 1.0
    product = mu_i * mu_o
    excess = np.expm1(_log_h_1(mu_i, c, reading) + _log_h_1(mu_o, c, reading))
    shape = (l * l + 45.0 / 64.0 * m) * product + l * (mu_i + mu_o)
    every = (excess + (1.0 + excess) * shape) / reading.lead
    alike = 1.0 / reading.lead - 64.0 / reading.single
    return c * _sines(mu_i, mu_o) * (every + alike - 45.0 * product / reading.single)


def _modes(reading: Reading) -> Model:
    """(18), its mode of order 2 single scattering alone."""

    def brdf(mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray, c: np.ndarray) -> np.ndarray:
        multiple = _mode_0(mu_i, mu_o, c, reading) + _mode_1(mu_i, mu_o, c, reading) * np.cos(phi)
        return (_single(mu_i, mu_o, phi, c) + multiple / np.pi) / (mu_i + mu_o)

    return brdf


def _fast(mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray, c: np.ndarray) -> np.ndarray:
    """(48) with (47)"""
    s = np.sqrt(1.0 - c)
    k_d = (1.0 - 0.453029 * (1.0 - c) - 0.544162 * s) / (1.42931 * s + 1.0)
    azimuth = np.abs(np.arctan2(np.sin(phi), np.cos(phi)))
    sines = _sines(mu_i, mu_o)
    # acos S with all its digits where S is nearly 1
    product = mu_i * mu_o
    angle = np.arctan2(np.sqrt(mu_i * mu_i + mu_o * mu_o - product * product), sines)
    multiple = 0.0151829 * (c - 0.249978) * (azimuth + np.sqrt(product)) * sines / (angle + 0.113706 * sines)
    return np.maximum(0.0, _single(mu_i, mu_o, phi, c) / (mu_i + mu_o) + 0.234459 * k_d**1.85432 + multiple)


def _hapke(mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray, c: np.ndarray) -> np.ndarray:
    root = np.sqrt(1.0 - c)
    # H - 1
    h_i, h_o = (2.0 * mu * (c / (1.0 + root)) / (1.0 + 2.0 * mu * root) for mu in (mu_i, mu_o))
    multiple = c * (h_i + h_o + h_i * h_o) / (4.0 * np.pi)
    return (_single(mu_i, mu_o, phi, c) + multiple) / (mu_i + mu_o)


def _evaluate(
    model: Model,
    mu_i: np.typing.ArrayLike,
    mu_o: np.typing.ArrayLike,
    phi: np.typing.ArrayLike,
    c: np.typing.ArrayLike,
) -> np.ndarray | np.floating:
    """`model` where its arguments are in the domain: infinite where both cosines are 0, NaN outside."""

    def core(mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray, c: np.ndarray) -> np.ndarray:
        inside = (mu_i >= 0.0) & (mu_i <= 1.0) & (mu_o >= 0.0) & (mu_o <= 1.0) & np.isfinite(phi)
        value = np.where(mu_i + mu_o > 0.0, model(mu_i, mu_o, phi, c), np.inf)
        return np.where(inside & (c >= 0.0) & (c <= 1.0), value, np.nan)

    return elementwise(core, mu_i=mu_i, mu_o=mu_o, phi=phi, c=c)


def brdf_lambert_sphere_paper(
    mu_i: np.typing.ArrayLike, mu_o: np.typing.ArrayLike, phi: np.typing.ArrayLike, c: np.typing.ArrayLike
) -> np.ndarray | np.floating:
    """The analytic model of deon2021, Section 3, with its misprints mended: an approximate `brdf_lambert_sphere`.

    Per steradian (1/sr). Exact single scattering, and what is multiply scattered by fits to the orders 0 and 1 of the
    three-term phase function. Symmetric in the cosines, to the last bit.

    Found for cosines from 0.05 and all azimuths, against the rms of the exact BRDF: rms errors of 0.05 %, 0.21 %,
    0.58 % and 1.5 % for c = 0.1, 0.5, 0.9 and 1, and at most 7.3 % of a value. Where both cosines are 0.001,
    forward, it is two thirds too high. For c = 1, 97.9 % to 99.1 % of a beam returns, the least at normal incidence.

    mu_i, mu_o: cosines in [0, 1]; infinite where both are 0. phi: azimuth in radians between the two directions, both
    pointing outward: 0 is backscattering. c: diffuse albedo of the spheres in [0, 1]. Shapes broadcast; anything else,
    NaN and infinities included, gives NaN. float32 for float32 arguments, float64 otherwise. TypeError for arguments
    that are no real numbers, ValueError for shapes that do not broadcast.

    `deon2021:18`, from `deon2021:17` and `deon2021:27` to `deon2021:45`. Mended: 3 pi in (27) and 192 pi in (34),
    0.0242851 in (30), a minus before 0.084463 in (39), 2567.74 in (40), and (28), in which the logarithms are
    proportional: log H(mu) = log H(1) mu^p(mu), with the exponent of (29).

    >>> brdf_lambert_sphere_paper(0.5, [0.5, 1.0], 0.0, 1.0).round(6).tolist()
    [0.412505, 0.300741]
    """
    return _evaluate(_modes(MENDED), mu_i, mu_o, phi, c)


def brdf_lambert_sphere_printed(
    mu_i: np.typing.ArrayLike, mu_o: np.typing.ArrayLike, phi: np.typing.ArrayLike, c: np.typing.ArrayLike
) -> np.ndarray | np.floating:
    """`brdf_lambert_sphere_paper` with every number as printed: no BRDF, but negative for most c.

    Found as for `brdf_lambert_sphere_paper`: rms errors of 14, 2.2, 0.63 and 0.16 times the exact BRDF's rms for c =
    0.1, 0.5, 0.9 and 1. A beam along the normal returns -1.6 of itself for c = 0.1 and 1.29 for c = 1.

    The arguments, the errors raised and the unit are those of `brdf_lambert_sphere_paper`.

    (27) has 6 pi, (34) 384 pi, (30) 0.242851, (40) 24567.74; (39) has no sign before 0.084463, read as a product; (28)
    reads H(mu) = H(1) H_{c=1}(mu). The phase function in (17) is the second form of (1), as the first has another norm.

    >>> brdf_lambert_sphere_printed(0.5, [0.5, 1.0], 0.0, 0.5).round(6).tolist()
    [-0.192839, -0.344068]
    """
    return _evaluate(_modes(PRINTED), mu_i, mu_o, phi, c)


def brdf_lambert_sphere_fast_paper(
    mu_i: np.typing.ArrayLike, mu_o: np.typing.ArrayLike, phi: np.typing.ArrayLike, c: np.typing.ArrayLike
) -> np.ndarray | np.floating:
    """The fast variant of deon2021, Section 3.6: an approximate `brdf_lambert_sphere`.

    Per steradian (1/sr). Exact single scattering and a short formula for the rest, cut off at 0. Symmetric in the
    cosines.

    Found as for `brdf_lambert_sphere_paper`: rms errors of 16 %, 2.0 %, 1.5 %, 5.8 % and 13 % for c = 0.1, 0.5, 0.9,
    0.99 and 1. For c = 1, 103 % to 124 % of a beam returns, and for c = 0.99 up to 101 %.

    The arguments and the errors raised are those of `brdf_lambert_sphere_paper`. The formula's |phi| is taken between 0
    and pi, 0 for backscattering, which the paper leaves open: the other way round the rms error is 2.5 to 7 times as
    large for c in [0.3, 0.9].

    `deon2021:48` with `deon2021:17` and `deon2021:47`, as printed.

    >>> brdf_lambert_sphere_fast_paper(0.5, [0.5, 1.0], 0.0, 1.0).round(6).tolist()
    [0.451951, 0.320615]
    """
    return _evaluate(_fast, mu_i, mu_o, phi, c)


def brdf_lambert_sphere_hapke(
    mu_i: np.typing.ArrayLike, mu_o: np.typing.ArrayLike, phi: np.typing.ArrayLike, c: np.typing.ArrayLike
) -> np.ndarray | np.floating:
    """Hapke's approximation of 1981 for Lambertian spheres, which deon2021 compares with: an approximate
    `brdf_lambert_sphere`.

    Per steradian (1/sr). Exact single scattering, and the multiple scattering of isotropic scatterers, whatever the
    azimuth: c/(4 pi) (H(mu_i) H(mu_o) - 1)/(mu_i + mu_o), with Hapke's own two-stream H = (1 + 2 mu)/(1 + 2 mu
    sqrt(1 - c)) and neither opposition effect nor roughness. Symmetric in the cosines, to the last bit.

    Found as for `brdf_lambert_sphere_paper`: rms errors of 1.0 %, 4.9 %, 8.0 % and 10 % for c = 0.1, 0.5, 0.9 and 1, up
    to two thirds of a value. For c = 1, 98 % to 118 % of a beam returns, the most at normal incidence.

    The arguments and the errors raised are those of `brdf_lambert_sphere_paper`.

    B. Hapke, "Bidirectional reflectance spectroscopy 1", J. Geophys. Res. 86 (1981).

    >>> brdf_lambert_sphere_hapke(0.5, [0.5, 1.0], 0.0, 1.0).round(6).tolist()
    [0.450939, 0.351414]
    """
    return _evaluate(_hapke, mu_i, mu_o, phi, c)
