"""The half-space with the three-term phase function 1 - 4/3 P_1 + 5/16 P_2, solved in two ways that share nothing.

The light of the azimuthal mode m that comes back is

    f^(m) = (2 - delta_0m) (-1)^m c / (4 pi) sum over l of A_l (-1)^(l + m) phi_l(mu_i) phi_l(mu_o) / (mu_i + mu_o),

phi_l of Ambartsumian, with Legendre functions P_l^m scaled by sqrt((l - m)! / (l + m)!).

`transport` finds phi_l from the transport equation: discrete directions and a singular value decomposition, then
Newton's method on Ambartsumian's equations. It knows no H. `by_fock` and `by_equation` find H from its characteristic
function, by the integral over log K and by the nonlinear equation; `polynomials` finds phi_l / H, which are polynomials
q_l, from moments of H. Every quadrature has Gauss-Legendre nodes in a root of mu, as all is smooth but for mu log mu.
"""

from __future__ import annotations

from functools import lru_cache
from math import factorial, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
FLIGHT = (1.0, -4 / 3, 5 / 16)
NODES, POWER = 64, 5
STEPS = 60


@lru_cache(maxsize=16)
def nodes(count: int = NODES, power: int = POWER) -> tuple[Array, Array]:
    """Nodes and weights on [0, 1], crowded at 0.

    >>> mu, weight = nodes()
    >>> bool(abs(np.sum(weight * np.sqrt(mu)) - 2 / 3) < 1e-14)
    True
    """
    x, weight = np.polynomial.legendre.leggauss(count)
    x = (1 + x) / 2
    return x**power, power * x ** (power - 1) * weight / 2


def legendre(m: int, orders: list[int], mu: Array) -> Array:
    """sqrt((l - m)! / (l + m)!) P_l^m, without the sign (-1)^m: one row for each order.

    >>> float(legendre(1, [2], np.array([0.6]))[0, 0].round(12))  # 3 mu sqrt(1 - mu^2) / sqrt(6)
    0.587877538268
    """
    rows = np.zeros((max(orders) + 1, *mu.shape))
    rows[m] = np.sqrt((1 - mu) * (1 + mu)) ** m * sqrt(factorial(2 * m)) / (2**m * factorial(m))
    for l in range(m + 1, max(orders) + 1):
        rows[l] = (2 * l - 1) * mu * rows[l - 1]
        if l > m + 1:
            rows[l] -= sqrt((l - 1) ** 2 - m**2) * rows[l - 2]
        rows[l] /= sqrt(l**2 - m**2)
    return rows[orders]


# --- H from its characteristic function -----------------------------------------------------------------


def characteristic(m: int, c: Any) -> tuple[Any, Any, Any]:
    """Psi of order m as coefficients of 1, mu^2 and mu^4, for any kind of number."""
    b = 4 * c + 9
    return (
        (207 * c / 384, (c * (20 * c + 281) - 346) * c / 384, 15 * (1 - c) * b * c / 384),
        (-64 * c / 192, (64 + 5 * b) * c / 192, -5 * b * c / 192),
        (15 * c / 256, -30 * c / 256, 15 * c / 256),
    )[m]


def at_rest(m: int, c: Any) -> Any:
    """K(0) = 1 - 2 int Psi, for any kind of number, without cancellation where c = 1 makes it 0."""
    return ((16 - c) * (1 - c) * (4 * c + 9) / 144, 1 + c * (55 - 4 * c) / 144, 1 - c / 16)[m]


def psi(m: int, c: float, mu: Array) -> Array:
    a, b, d = characteristic(m, c)
    return a + mu**2 * (b + mu**2 * d)


@lru_cache(maxsize=4096)
def _on_nodes(m: int, c: float) -> Array:
    """H at the nodes by Newton's method on H (sqrt(K(0)) + int H Psi x / (mu + x) dx) = 1."""
    mu, weight = nodes()
    mass, kernel, rest = weight * psi(m, c, mu), mu / (mu[:, None] + mu), sqrt(at_rest(m, c))
    h = np.ones(mu.size)
    for _ in range(STEPS):
        below = rest + kernel @ (mass * h)
        step = np.linalg.solve(np.diag(below) + h[:, None] * kernel * mass, 1 - h * below)
        h = h + step
        if abs(step).max() < 1e-15 * h.max():
            break
    return h


def by_equation(m: int, mu: Array, c: float) -> Array:
    """H^(m) from the nonlinear equation, for mu >= 0 and c in [0, 1].

    >>> [round(float(h), 10) for h in by_equation(0, np.array([0.0, 1.0]), 1.0)]
    [1.0, 2.9761518814]
    """
    x, weight = nodes()
    mass = weight * psi(m, c, x) * _on_nodes(m, c)
    return 1 / (sqrt(at_rest(m, c)) + (x / (mu[:, None] + x)) @ mass)


@lru_cache(maxsize=1)
def _trapezium() -> tuple[Array, Array, Array]:
    """t and dt of the doubly exponential rule on (0, oo); the integrals of mu^n / (1 + t^2 mu^2), n = 2, 4, 6."""
    u = np.arange(-4.2, 4.2, 0.04)
    t = np.exp(np.pi / 2 * np.sinh(u))
    small = np.minimum(t, 0.3)
    series = [sum((-1) ** j * small ** (2 * j) / (2 * j + n + 1) for j in range(18)) for n in (2, 4, 6)]
    found, closed = [], np.arctan(t) / t
    for n, s in zip((2, 4, 6), series, strict=True):
        closed = (1 / (n - 1) - closed) / t**2
        found.append(np.where(t < 0.3, s, closed))
    return t, 0.04 * np.pi / 2 * np.cosh(u) * t, np.array(found)


def by_fock(m: int, mu: Array, c: float) -> Array:
    """H^(m) by Fock's integral of log K, with K(t) - K(0) = 2 t^2 int Psi mu^2 / (1 + t^2 mu^2) dmu.

    >>> [round(float(h), 10) for h in by_fock(0, np.array([0.0, 1.0]), 1.0)]
    [1.0, 2.9761518814]
    """
    t, dt, integrals = _trapezium()
    log_k = np.log(at_rest(m, c) + 2 * t**2 * (np.array(characteristic(m, c)) @ integrals))
    return np.exp(-(mu[:, None] / (1 + (mu[:, None] * t) ** 2)) @ (log_k * dt) / np.pi)


# --- phi from the transport equation --------------------------------------------------------------------


def _stretched(rows: Array, factors: Array) -> Array:
    """The matrix that multiplies each of these orthonormal rows by its factor, and leaves the rest alone."""
    return np.eye(rows.shape[1]) + rows.T @ ((factors - 1)[:, None] * rows)


def discrete(m: int, coefficients: tuple[float, ...], c: float, count: int = NODES, power: int = POWER) -> Any:
    """phi_l at nodes, from discrete directions: orders, A_l, nodes, weights, P_l and phi_l.

    With sums s and differences d of the light down and up, mu s' = -D d and mu d' = -S s; in what decays with depth
    mu d = Z s, Z the geometric mean of S and the inverse of D / mu^2. Loses digits where c is near 1, by 1 / (1 - c).
    """
    orders = [l for l in range(m, len(coefficients)) if coefficients[l]]
    o, a = np.array(orders), np.array([coefficients[l] for l in orders])
    mu, weight = nodes(count, power)
    root, p = np.sqrt(weight), legendre(m, orders, mu)
    rows, factors, even = np.sqrt(2 * o + 1)[:, None] * root * p, 1 - c * a / (2 * o + 1), (o + m) % 2 == 0
    outer = _stretched(rows[even], np.sqrt(factors[even]))
    inner = mu[:, None] * _stretched(rows[~even], factors[~even] ** -0.5)
    left, values, _ = np.linalg.svd(_stretched(rows[even], factors[even] ** -0.5) @ inner)
    z = outer @ (left * values) @ left.T @ outer
    right = np.where(even[:, None], root * p, (root * p / mu) @ z)
    return orders, a, mu, weight, p, 2 * mu * np.linalg.solve(np.diag(mu) + z, right.T).T / root


@lru_cache(maxsize=4096)
def transport(m: int, c: float) -> Any:
    """`discrete`, and then Newton's method on phi_l = P_l + c/2 sum over k of +-A_k phi_k mu int phi_k P_l / (mu + x).

    At c = 1 the two solutions of these equations meet, in mode 0: there phi_1 = 0, as all light returns, and the
    integrals of phi_0 and phi_2 are 2 and 0.
    """
    conservative = m == 0 and c == 1
    orders, a, mu, weight, p, phi = discrete(m, FLIGHT, 1 - 1e-8 if conservative else c)
    if conservative:
        orders, a, p, phi = [0, 2], a[[0, 2]], p[[0, 2]], phi[[0, 2]]
    signs = np.array([(-1.0) ** (l + m) for l in orders])
    count, ranks = mu.size, range(len(orders))
    kernel = mu[:, None] / (mu[:, None] + mu) * weight
    for _ in range(8):
        image = np.array([[kernel @ (phi[k] * p[l]) for l in ranks] for k in ranks])
        residual = p - phi + c / 2 * signs[:, None] * np.einsum("k,kn,kln->ln", signs * a, phi, image)
        slope = np.zeros((len(ranks), count, len(ranks), count))
        for l in ranks:
            for k in ranks:
                factor = c / 2 * signs[l] * signs[k] * a[k]
                slope[l, :, k] = factor * (np.diag(image[k, l]) + phi[k][:, None] * kernel * p[l])
            slope[l, :, l] -= np.eye(count)
        matrix, right = slope.reshape(residual.size, -1), residual.ravel()
        if conservative:
            rows = np.kron(np.eye(2), weight)
            matrix, right = np.vstack([matrix, rows]), np.r_[right, rows @ phi.ravel() - (2, 0)]
            step = -np.linalg.lstsq(matrix, right, rcond=None)[0]
        else:
            step = -np.linalg.solve(matrix, right)
        phi = phi + step.reshape(phi.shape)
        if abs(step).max() < 1e-14:
            break
    return orders, a, mu, weight, p, phi


def anywhere(m: int, c: float, solution: Any, mu: Array) -> Array:
    """phi_l at any cosines, from phi_l at the nodes: a small linear system for each."""
    orders, a, x, weight, p, phi = solution
    signs = np.array([(-1.0) ** (l + m) for l in orders])
    kernel = mu[:, None] / (mu[:, None] + x) * weight
    matrix = np.einsum("pn,kn,ln->plk", kernel, phi * (signs * a)[:, None], p * signs[:, None]) * c / 2
    return np.linalg.solve(np.eye(len(orders)) - matrix, legendre(m, orders, mu).T[:, :, None])[:, :, 0].T


# --- q = phi / H ----------------------------------------------------------------------------------------

MONOMIALS = ((1, 0, 0), (0, 1, 0), (-0.5, 0, 1.5))  # P_0, P_1, P_2


@lru_cache(maxsize=4096)
def polynomials(m: int, c: float) -> Array:
    """q_l, one row for each order from m to 2, lowest power first, without the factor sqrt(1 - mu^2)^m.

    Ambartsumian's equations with H q_l for phi_l, at seven cosines, and Psi(mu) = c/2 sum over l of +-A_l q_l(mu)
    q_l(-mu), by which the transcendental parts of those cancel. Both are quadratic in the coefficients, and solved by
    the method of Gauss and Newton; H is Fock's.
    """
    mu, weight = nodes()
    size, signs = 3 - m, np.array([(-1.0) ** l for l in range(3 - m)])
    start = (np.array(MONOMIALS), np.array([[1, 0], [0, 3.0]]) / sqrt(2), np.array([[sqrt(3 / 8)]]))[m]
    if m == 1:
        start[1] /= sqrt(3)
    weights = signs * np.array(FLIGHT[m:])
    x = np.linspace(0.15, 1, 7)
    h, kernel = by_fock(m, x, c), x[:, None] / (x[:, None] + mu) * (weight * (1 - mu**2) ** m * by_fock(m, mu, c))
    at_x, at_mu, behind = (v ** np.arange(size)[:, None] for v in (x, mu, -x))
    p, target = start @ at_x, _reduced(m, c, x)
    moments = np.einsum("xn,jn,ln->jlx", kernel, at_mu, start @ at_mu)
    free = np.tile(np.arange(size) > 0, size)
    q = start.copy()
    for _ in range(STEPS if m < 2 else 0):
        here, there = q @ at_x, q @ behind
        inner = np.einsum("kj,jlx->klx", q, moments)
        scattered = h * here - p - c / 2 * signs[:, None] * h * np.einsum("k,kx,klx->lx", weights, here, inner)
        pair = c / 2 * np.einsum("k,kx,kx->x", weights, here, there) - target
        slope, slope_pair = np.zeros((size, x.size, size, size)), np.zeros((x.size, size, size))
        for l in range(size):
            slope[l, :, l] += (h * at_x).T
            slope_pair[:, l] = c / 2 * weights[l] * (at_x * there[l] + here[l] * behind).T
            for k in range(size):
                part = at_x * inner[k, l] + here[k] * moments[:, l]
                slope[l, :, k] -= c / 2 * signs[l] * weights[k] * (h * part).T
        matrix = np.vstack([slope.reshape(size * x.size, -1), slope_pair.reshape(x.size, -1)])
        right = np.r_[scattered.ravel(), pair]
        if m == 0 and c == 1:  # as in `transport`
            rows = np.kron(np.eye(3), at_mu @ (weight * by_fock(m, mu, c)))[[0, 2]]
            matrix, right = np.vstack([matrix, rows]), np.r_[right, rows @ q.ravel() - (2, 0)]
        step = np.zeros(size * size)
        step[free] = -np.linalg.lstsq(matrix[:, free], right, rcond=None)[0]
        q = q + step.reshape(size, size)
        if abs(step).max() < 1e-14:
            break
    return q


def _reduced(m: int, c: float, mu: Array) -> Array:
    """Psi over (1 - mu^2)^m, as a polynomial."""
    if m == 0:
        return psi(m, c, mu)
    return c / 192 * (5 * (4 * c + 9) * mu**2 - 64) if m == 1 else np.full(mu.shape, 15 * c / 256)


def from_transport(m: int, c: float) -> Array:
    """The same polynomials, fitted to phi_l / H at the nodes: H is by its equation and phi_l by transport."""
    orders, _, mu, _, _, phi = transport(m, c)
    ratio = phi / (_on_nodes(m, c) * np.sqrt(1 - mu**2) ** m)
    q = np.zeros((3 - m, 3 - m))
    q[np.array(orders) - m] = np.polynomial.polynomial.polyfit(mu, ratio.T, 2 - m).T
    return q
