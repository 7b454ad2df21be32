"""What the half-spaces have in common: their arguments' cells, and H functions from what they are characterised by.

H of the characteristic function Psi = p_0 + p_1 mu^2 + p_2 mu^4 has K(t) = 1 - 2 int_0^1 Psi/(1 + t^2 mu^2) dmu, which
is K(0) + p_0 g_0(t) + p_1 g_1(t) + p_2 g_2(t) with functions g_k that know no albedo.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from mpmath import mp, mpf
from scipy import integrate

from xsec_sym.study.method import Argument, Columns, Function, Method, along
from xsec_sym.study.methods.common import blocked

COSINES = (0.0, 1e-3, 0.01, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1.0)
ALBEDO = Argument("c", (0.01, 0.2, 0.5, 0.8, 0.9, 0.97, 0.99, 0.999, 1.0))
# Those of neighbourhoods of trouble, to the last digit in single precision too: what solves for one has few to solve.
FEW = (0.25, 0.75, 1 - 2.0**-10, 1.0)
WHITE = (1 - 2.0**-7, 1 - 2.0**-12, 1 - 2.0**-17, 1 - 2.0**-22, 1 - 2.0**-24, 1.0)


def cosine(name: str = "mu", edges: tuple[float, ...] = COSINES) -> Argument:
    return Argument(name, edges)


def some(values: Sequence[float]) -> Callable[[np.random.Generator, int], np.ndarray]:
    return lambda rng, n: rng.choice(np.asarray(values), n)


def inside(rng: np.random.Generator, n: int) -> np.ndarray:
    return rng.uniform(0, 1, n)


def grazing(rng: np.random.Generator, n: int) -> np.ndarray:
    """Cosines from 1e-12 to 1e-3, and 0."""
    mu = 10 ** rng.uniform(-12, -3, n)
    mu[rng.random(n) < 0.05] = 0
    return mu


def near_1(rng: np.random.Generator, n: int) -> np.ndarray:
    return 1 - 10 ** rng.uniform(-16, -2, n)


def drawn(*draws: Callable[[np.random.Generator, int], np.ndarray]) -> Callable[[np.random.Generator, int], Columns]:
    return lambda rng, n: tuple(draw(rng, n) for draw in draws)


# --- what characterises H ---------------------------------------------------------------------------------

TERMS = 3
# Below it arctan and its like would cancel.
SMALL = 0.6


def parts(t: Any) -> np.ndarray:
    """g_k(t) = 2 t^2 int_0^1 mu^(2 k + 2)/(1 + t^2 mu^2) dmu for k = 0, 1, 2, t > 0, as rows."""
    t = np.asarray(t, float)
    square, small = t * t, np.minimum(t, SMALL) ** 2
    closed = np.arctan(t) / t
    rows = []
    for k in range(TERMS):
        closed = 1 / (2 * k + 1) - closed  # t^2 int mu^(2 k + 2)/(1 + t^2 mu^2)
        series = sum((-small) ** j / (2 * j + 2 * k + 3) for j in range(36)) * small
        rows.append(2 * np.where(t < SMALL, series, closed))
        closed = closed / square
    return np.array(rows)


def part(t: float, terms: int) -> list[float]:
    """The first of these for one t."""
    row, closed = [], math.atan(t) / t if t > SMALL else 0.0
    for k in range(terms):
        if t > SMALL:
            closed = 1 / (2 * k + 1) - closed
            row.append(2 * closed)
            closed /= t * t
        else:
            total, j = 1 / (71 + 2 * k), 33
            while j >= 0:
                total = 1 / (2 * j + 2 * k + 3) - t * t * total
                j -= 1
            row.append(2 * t * t * total)
    return row


def parts_exactly(t: mpf) -> list[mpf]:
    with mp.extradps(20 + max(0, int(-5 * mp.log10(t)))):
        closed, rows = mp.atan(t) / t, []
        for k in range(TERMS):
            closed = mpf(1) / (2 * k + 1) - closed
            rows.append(2 * closed)
            closed = closed / t**2
        return rows


@dataclass(frozen=True)
class Characteristic:
    """K(0) and p_0, p_1, p_2 for the set arguments, which are numbers of any kind or arrays."""

    rest: Function
    psi: Function

    def _rows(self, table: np.ndarray, *fixed: np.ndarray) -> np.ndarray:
        """K at some t, of which `table` has the parts: one row for each choice of the set arguments."""
        total = np.asarray(self.rest(*fixed), float)[..., None]
        for p, row in zip(self.psi(*fixed), table, strict=False):
            total = total + np.asarray(p, float)[..., None] * row
        return total

    # --- the rules ---

    def trapezoidal(self, n: int) -> Function:
        """Fock's integral by n nodes in log t: as far out as the step h lets the error exp(-pi^2/h) be."""
        far = np.pi * np.sqrt(n / 2)
        t = np.exp(np.linspace(-far, far, n))
        return self._fock(t, 2 * far / (n - 1) * t)

    def gauss(self, n: int) -> Function:
        """Fock's integral by Gauss-Legendre with n nodes in arctan t."""
        x, weight = np.polynomial.legendre.leggauss(n)
        angle = np.pi / 4 * (x + 1)
        return self._fock(np.tan(angle), np.pi / 4 * weight / np.cos(angle) ** 2)

    def _fock(self, t: np.ndarray, weight: np.ndarray) -> Function:
        table = parts(t)

        def h(mu: np.ndarray, *fixed: np.ndarray) -> np.ndarray:
            x = mu[:, None] * t
            return np.exp(-mu / np.pi * ((np.log(self._rows(table, *fixed)) / (1 + x * x)) @ weight))

        return blocked(h)

    def iterated(self, *fixed: float, n: int) -> Callable[[np.ndarray], np.ndarray]:
        """1/H = sqrt(K(0)) + int_0^1 H Psi x/(mu + x) dx with n Gauss-Legendre nodes, from H = 1 on."""
        x, weight = np.polynomial.legendre.leggauss(n)
        x, weight = (x + 1) / 2, weight / 2
        root = np.sqrt(float(self.rest(*fixed)))
        mass = weight * x * sum(float(p) * x ** (2 * k) for k, p in enumerate(self.psi(*fixed)))
        kernel, h = mass / (x[:, None] + x), np.ones(n)
        for _ in range(200):
            before, h = h, (h + 1 / (root + kernel @ h)) / 2
            if abs(h - before).max() < 1e-16:
                break
        mass = mass * h

        def at(mu: np.ndarray) -> np.ndarray:
            total = np.full(np.shape(mu), root)
            for node, part in zip(x, mass, strict=True):
                total += part / (mu + node)
            return 1 / total

        return at

    def compiled(self, n: int) -> Function:
        """The trapezoidal rule as a compiled loop, for numbers that broadcast: needs numba."""
        import numba

        far = np.pi * np.sqrt(n / 2)
        t = np.exp(np.linspace(-far, far, n))
        g0, g1, g2 = parts(t)
        step = 2 * far / (n - 1) / np.pi

        @numba.vectorize(["float64(float64, float64, float64, float64, float64)"])
        def h(mu: float, rest: float, p0: float, p1: float, p2: float) -> float:
            total = 0.0
            for j in range(t.size):
                x = mu * t[j]
                total += x / (1.0 + x * x) * np.log(rest + p0 * g0[j] + p1 * g1[j] + p2 * g2[j])
            return np.exp(-step * total)

        def over(mu: np.ndarray, *fixed: np.ndarray) -> np.ndarray:
            psi = [*self.psi(*fixed), 0.0, 0.0][:TERMS]
            return h(mu, self.rest(*fixed), *psi)

        return over

    def adaptive(self, mu: float, *fixed: float) -> float:
        """Fock's integral in arctan t by `scipy.integrate.quad` with its default tolerances."""

        rest, psi = float(self.rest(*map(np.float64, fixed))), [float(p) for p in self.psi(*map(np.float64, fixed))]

        def integrand(angle: float) -> float:
            t = math.tan(angle)
            k = rest + math.fsum(p * g for p, g in zip(psi, part(t, len(psi)), strict=True))
            return math.log(k) / (math.cos(angle) ** 2 + (mu * math.sin(angle)) ** 2)

        with warnings.catch_warnings():
            warnings.simplefilter("ignore", integrate.IntegrationWarning)
            return float(np.exp(-mu / np.pi * integrate.quad(integrand, 0, np.pi / 2)[0]))

    def arbitrary(self, digits: int) -> Function:
        """The same by mpmath with so many digits, cut where 1/t is mu."""

        def h(mu: float, *fixed: float) -> float:
            if mu == 0:
                return 1.0
            with mp.workdps(digits):
                m, exact = mpf(mu), [mpf(x) for x in fixed]
                rest, psi = self.rest(*exact), self.psi(*exact)

                def integrand(angle: mpf) -> mpf:
                    t = mp.tan(angle)
                    k = rest + mp.fsum(p * g for p, g in zip(psi, parts_exactly(t), strict=False))
                    return mp.log(k) / (mp.cos(angle) ** 2 + (m * mp.sin(angle)) ** 2)

                edges = [0, mp.pi / 4, *([mp.atan(1 / m)] if m < 1 else []), mp.pi / 2]
                return float(mp.exp(-m / mp.pi * mp.quad(integrand, edges)))

        return h

    def tabled(self, *fixed: float, n: int) -> Function:
        """Chebyshev's polynomial in mu^(1/4) with n coefficients, for one choice of the set arguments."""
        rule = self.trapezoidal(256)
        points = np.cos(np.pi * (np.arange(n) + 0.5) / n)
        mu = ((points + 1) / 2) ** 4
        values = np.log(rule(mu, *(np.full(n, float(x)) for x in fixed)))
        table = np.polynomial.chebyshev.chebfit(points, values, n - 1)
        return lambda mu: np.exp(np.polynomial.chebyshev.chebval(2 * np.sqrt(np.sqrt(mu)) - 1, table))


def quadratures(of: Characteristic, source: str, after: Callable[[Function], Function] = lambda h: h,
                fold: Callable[..., Any] | None = None) -> tuple[Method, ...]:  # fmt: skip
    """The ways from K or Psi to H, and to what `after` makes of a function H, `fold` of one for set arguments."""
    folded = fold or (lambda make: make)
    return (
        Method("Fock, trapezoidal in log t", source, lambda n: after(of.trapezoidal(n)), kind="quadrature",
               curve=along(n=(16, 32, 64, 128, 256))),
        Method("Fock, compiled", source, lambda n: after(of.compiled(n)), kind="quadrature",
               curve=along(n=(64,)), needs="numba"),
        Method("Fock, Gauss-Legendre", source, lambda n: after(of.gauss(n)), kind="quadrature",
               curve=along(n=(8, 16, 32, 64))),
        Method("nonlinear equation", "iteration of the equation of H", folded(of.iterated), kind="iteration",
               curve=along(n=(4, 8, 16, 32, 64)), folds=True),
        Method("Chebyshev table for one albedo", "interpolation of Fock's integral", folded(of.tabled), kind="table",
               curve=along(n=(4, 8, 16, 32)), folds=True),
        Method("scipy.integrate.quad", source, lambda: after(of.adaptive), kind="quadrature", serial=True, most=100),
        Method("mpmath.quad", source, lambda digits: after(of.arbitrary(digits)), kind="arbitrary precision",
               curve=along(digits=(15, 30)), serial=True, most=10),
    )  # fmt: skip
