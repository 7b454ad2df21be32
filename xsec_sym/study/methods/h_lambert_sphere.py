"""H of the half-space with the first three terms of the Lambertian sphere's phase function, in its three modes."""

from __future__ import annotations

from typing import Any

import numpy as np
from mpmath import mpf

from xsec_sym import kernels
from xsec_sym.kernels import lambert_sphere_models as models
from xsec_sym.study.method import Argument, Field, Function, Method, Quantity
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
    quadratures,
    some,
)
from xsec_sym.study.methods.isotropic import FOCK
from xsec_sym.study.references import three_terms


def _chosen(mode: Any, of: tuple[Any, Any, Any]) -> Any:
    """What belongs to the mode, for a number of any kind or an array."""
    return of[int(mode)] if isinstance(mode, mpf) or np.ndim(mode) == 0 else np.choose(mode.astype(int), of)


def at_rest(c: Any, mode: Any) -> Any:
    """K(0), without cancellation near c = 1."""
    return _chosen(mode, ((16 - c) * (1 - c) * (4 * c + 9) / 144, 1 + c * (55 - 4 * c) / 144, 1 - c / 16))


def psi(c: Any, mode: Any) -> tuple[Any, Any, Any]:
    b = 4 * c + 9
    return (
        _chosen(mode, (207 * c / 384, -64 * c / 192, 15 * c / 256)),
        _chosen(mode, ((c * (20 * c + 281) - 346) * c / 384, (64 + 5 * b) * c / 192, -30 * c / 256)),
        _chosen(mode, (15 * (1 - c) * b * c / 384, -5 * b * c / 192, 15 * c / 256)),
    )


OF = Characteristic(at_rest, psi)
MODE = Argument("mode", (-0.5, 0.5, 1.5, 2.5), integer=True)


def any_mode(rng: np.random.Generator, n: int) -> np.ndarray:
    return rng.integers(0, 3, n).astype(float)


QUANTITY = Quantity(
    "h_lambert_sphere",
    "H functions of the half-space of Lambertian spheres, three terms",
    running=(cosine(),),
    set=(ALBEDO, MODE),
    reference=three_terms.h,
    trouble={
        "nearly white": drawn(inside, some(WHITE), any_mode),
        "white": drawn(inside, some((1.0,)), any_mode),
        "grazing": drawn(grazing, some(FEW), any_mode),
    },
    typical=((0.9, 0.0), (1.0, 0.0), (0.9, 1.0)),
    per_cell=(1, 2),
    about="modes 0, 1, 2; the reference is Fock's integral of the K that deon2021 prints, to 30 digits.",
)


def paper(reading: models.Reading) -> Function:
    """`deon2021:37` for mode 0, `deon2021:28` to 30 for mode 1; the paper has none for mode 2, which is near 1."""

    def h(mu: np.ndarray, c: np.ndarray, mode: np.ndarray) -> np.ndarray:
        zeroth = 1 + models._excess_0(mu, c, np.sqrt(1 - c))
        first = np.exp(models._log_h_1(mu, c, reading))
        return np.where(mode == 0, zeroth, np.where(mode == 1, first, 1.0))

    return h


def hapke(mu: np.ndarray, c: np.ndarray, mode: np.ndarray) -> np.ndarray:
    """The form of Hapke's that `deon2021:37` starts from: right at mu = 0 and infinity; sqrt(K(0)) for sqrt(1 - c)."""
    return (1 + 2 * mu) / (1 + 2 * mu * np.sqrt(at_rest(c, np.asarray(mode))))


def paper_number(mu: float, c: float, mode: float) -> float:
    if mode == 1.0:
        power = mu ** (((-1.12831 * mu + 1.85728) * mu - 1.07879) * mu + 0.459442)
        return np.exp((0.0242851 * c - 0.144839) * c * power)
    if mode == 2.0:
        return 1.0
    s = np.sqrt(1.0 - c)
    a = (1.50112 * s**6.05435 + 8.21644) / (4.17593 - 1.21222 * s)
    d = (7.7731 - 0.565811 * s**0.961546) / (8.65912 - 0.159974 * s**7)
    rise = a * mu**d
    return (1.0 + rise) / (1.0 + rise * np.sqrt((16.0 - c) * (1.0 - c) * (4.0 * c + 9.0)) / 12.0)


METHODS = (
    Method("kernel", "deon2021:22", lambda: kernels.h_lambert_sphere, single=True, ours=True),
    Method("fit", "this project's fit", lambda: kernels.h_lambert_sphere_fit, kind="approximation", single=True,
           ours=True),
    Method("paper's fits, mended", "deon2021:37, deon2021:28", lambda: paper(models.MENDED), kind="approximation"),
    Method("paper's fits, printed", "deon2021:37, deon2021:28", lambda: paper(models.PRINTED), kind="approximation"),
    Method("paper's fits, mended, compiled", "deon2021:37, deon2021:28", loop(paper_number), kind="approximation",
           needs="numba"),
    Method("Hapke's form", "B. Hapke, 1981", lambda: hapke, kind="approximation"),
    *quadratures(OF, FOCK),
)  # fmt: skip

FIELDS = (Field(QUANTITY, METHODS),)
