"""The light that a half-space of scatterers reflects, for any phase function given by its Legendre coefficients.

A layer without a lower end, of extinction and single-scattering albedo c the same everywhere, lit by a beam. One
Fourier mode in azimuth at a time, `Mode` finds the reflection function R of

    intensity upward(mu) = 2 integral of R(mu, mu') mu' intensity downward(mu') over mu' in [0, 1],

and with it phi_l(mu) = P_l(mu) +- 2 mu integral of R(mu, mu') P_l(mu'), in which R is of finite rank (Ambartsumian):

    R(mu, mu') = c/4 sum over l of (+-A_l) phi_l(mu) phi_l(mu')/(mu + mu'),        +- the sign of (-1)^(l + mode).

Three steps, each for what the one before does badly. (1) Sum s and difference d of the intensities down and up obey
mu s' = -D d and mu d' = -S s, and their ratio Y, d = Y s, is the geometric mean of two positive matrices: Y D/mu Y =
S/mu. No eigenvalues are paired or matched, and nothing is singular at c = 1 once the uniform state, which nothing but
absorption moves, is split off. (2) phi_l at nodes crowded at mu = 0, where it behaves as mu log mu, by Picard steps.
(3) phi_l anywhere from phi_l at the nodes: a small linear system for each cosine, without interpolation.

Fock's H functions, which `tests/kernels/test_half_space.py` compares with, share nothing of this.
"""

from __future__ import annotations

import functools
from collections.abc import Callable

import numpy as np

# R is smooth in all but mu -> 0; a power of a Gauss-Legendre variable crowds the nodes there. The first step loses
# digits by the smallest mu, and gets few nodes near 0; the second needs cosines that no weight is left to notice.
FIRST_POWER, SECOND_POWER = 2, 6
PICARD_STEPS = 40
# Orders that keep this part of the light, at most, are iterated where the others are solved for.
WEAK, WEAK_ROUNDS = 1e-4, 5
# The uniform state is split off where it stands well apart from the others.
SPLIT_ALBEDO = 0.9
CHUNK = 1024


@functools.lru_cache(maxsize=256)
def crowded_nodes(n: int, power: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and weights on [0, 1] of Gauss-Legendre quadrature in mu^(1/power); nobody may write to them.

    >>> mu, weight = crowded_nodes(20, 4)
    >>> bool(abs(np.sum(weight * np.sqrt(mu)) - 2 / 3) < 1e-14)
    True
    """
    x, weight = np.polynomial.legendre.leggauss(n)
    x, weight = (1.0 + x) / 2.0, weight / 2.0
    mu, weight = x**power, power * x ** (power - 1) * weight
    # every mode of every half-space asks for the same few
    mu.flags.writeable = weight.flags.writeable = False
    return mu, weight


def associated_legendre(mode: int, orders: np.ndarray, mu: np.ndarray) -> np.ndarray:
    """sqrt((l - m)!/(l + m)!) P_l^m at each cosine, m the mode, without the sign (-1)^m: a row for each of `orders`.

    Over [0, 1] the square of each integrates to 1/(2l + 1), and rows of the same parity are orthogonal.

    >>> associated_legendre(1, np.array([1, 2]), np.array([0.6])).round(9).tolist()
    [[0.565685425], [0.587877538]]
    """
    rows = np.zeros((orders.max() + 1, mu.size))
    half = np.arange(1, mode + 1)
    rows[mode] = np.sqrt((1.0 - mu) * (1.0 + mu)) ** mode * np.prod(np.sqrt((2 * half - 1) / (2 * half)))
    for l in range(mode + 1, orders.max() + 1):
        rows[l] = (2 * l - 1) * mu * rows[l - 1]
        if l > mode + 1:
            rows[l] -= np.sqrt((l - 1) ** 2 - mode**2) * rows[l - 2]
        rows[l] /= np.sqrt(l**2 - mode**2)
    return rows[orders]


@functools.lru_cache(maxsize=256)
def _legendre_at_nodes(mode: int, orders: tuple[int, ...], n: int) -> np.ndarray:
    """One table for the half-spaces of all albedos."""
    return associated_legendre(mode, np.array(orders), crowded_nodes(n, SECOND_POWER)[0])


def _scaled(vectors: np.ndarray, factors: np.ndarray) -> np.ndarray:
    """The matrix that multiplies each of these orthonormal rows by its factor, and changes nothing else."""
    return np.eye(vectors.shape[1]) + vectors.T @ ((factors - 1.0)[:, None] * vectors)


def _reflector(direction: np.ndarray) -> np.ndarray:
    """An orthogonal matrix whose first column is this unit vector."""
    sign = 1.0 if direction[0] >= 0.0 else -1.0
    normal = direction.copy()
    normal[0] += sign
    matrix = np.eye(direction.size) - np.outer(normal, normal) * (2.0 / (normal @ normal))
    matrix[:, 0] *= -sign
    return matrix


def _rotation(tangent: float, towards: np.ndarray) -> tuple[float, float, np.ndarray]:
    """cos, sin and the lower right block of the rotation of the first axis by atan(tangent) toward a unit vector."""
    cos = 1.0 / np.hypot(1.0, tangent)
    sin = tangent * cos
    # 1 - cos without the cancellation
    return cos, sin, np.eye(towards.size) - np.outer(towards, towards) * (sin * sin / (1.0 + cos))


def _root(matrix: np.ndarray) -> np.ndarray:
    """The symmetric root of matrix times its transpose, by singular values: eigenvalues lose half the digits."""
    left, values, _ = np.linalg.svd(matrix)
    return (left * values) @ left.T


def _impedance(
    even: np.ndarray, odd: np.ndarray, even_factors: np.ndarray, odd_factors: np.ndarray, mu: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """T with Y = mu^(-1/2) T mu^(-1/2), and T e_0: T = S^(1/2) (F F^T)^(1/2) S^(1/2) with F = S^(-1/2) mu D^(-1/2)."""
    lift = mu[:, None] * _scaled(odd, odd_factors**-0.5)
    stretch = _scaled(even, np.sqrt(even_factors))
    impedance = stretch @ _root(_scaled(even, even_factors**-0.5) @ lift) @ stretch
    return impedance, impedance @ even[0] if even.size else np.zeros_like(mu)


def _impedance_near_conservation(
    even: np.ndarray, odd: np.ndarray, even_factors: np.ndarray, odd_factors: np.ndarray, mu: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """As `_impedance`, where S nearly, or altogether, annihilates the uniform state e_0; its second answer is exact to
    the last digits of sqrt(1 - c), by which both are small.

    In bases that begin with e_0 and with what mu makes of it, F = [[stiff/root, 0], [f, G]] with root = sqrt(1 - c).
    Its one large singular value is found by power iteration on (1, root^2 y) and rotated away. What remains has no
    1/root in it, and neither has any product below.
    """
    root = np.sqrt(even_factors[0])
    lift = mu[:, None] * _scaled(odd, odd_factors**-0.5)
    uniform = even[0] / np.linalg.norm(even[0])
    moved = uniform @ lift
    stiff = np.linalg.norm(moved)
    left_basis, right_basis = _reflector(uniform), _reflector(moved / stiff)
    rest = left_basis[:, 1:]
    stretch = rest.T @ _scaled(even[1:], np.sqrt(even_factors[1:])) @ rest
    lower = rest.T @ _scaled(even[1:], even_factors[1:] ** -0.5) @ lift @ right_basis
    f, g = lower[:, 0], lower[:, 1:]

    y = np.zeros(mu.size - 1)
    for _ in range(1000):
        z = f + root**2 * (g @ y)
        before, y = y, (g.T @ z) / (stiff**2 + root**2 * (f @ z))
        if np.abs(y - before).max() <= 4e-16 * np.abs(y).max():
            break
    z = (f + root**2 * (g @ y)) / stiff
    y_length, z_length = np.linalg.norm(y), np.linalg.norm(z)
    y, z = y / y_length, z / z_length
    right_cos, right_sin, right_block = _rotation(root**2 * y_length, y)
    left_cos, left_sin, left_block = _rotation(root * z_length, z)
    largest = stiff * right_cos / left_cos  # times 1/root
    lower = g @ right_block - np.outer(f, right_sin * y)
    above = -stiff * (root * y_length * right_cos) * y
    others = _root(left_block @ lower - np.outer(left_sin * z, above))

    tilt = z_length * left_cos  # left_sin/root
    stretched, leaning = stretch @ left_block, stretch @ z
    first = np.empty(mu.size)
    first[0] = largest * left_cos**2 + root * left_sin**2 * (z @ others @ z)
    first[1:] = largest * left_cos * tilt * leaning - left_sin * (stretched @ others @ z)
    blocks = np.empty((mu.size, mu.size))
    blocks[0], blocks[:, 0] = root * first, root * first
    blocks[1:, 1:] = largest * tilt * left_sin * np.outer(leaning, leaning) + stretched @ others @ stretched.T
    return left_basis @ blocks @ left_basis.T, root * (left_basis @ first)


class Mode:
    """One Fourier mode of the reflection of a half-space: `excess` gives phi_l - P_l at any cosines.

    The first step is taken with the orders up to `core` only. The others, of small coefficients but visible in light
    that grazes the surface, come in with the Picard steps, which they disturb little.
    """

    def __init__(self, mode: int, coefficients: np.ndarray, albedo: float, core: int, nodes: int):
        self.mode, self.albedo = mode, albedo
        orders = np.flatnonzero(coefficients)
        self.orders = orders[orders >= mode]
        self.core = int(np.count_nonzero(self.orders <= core))
        self.signs = np.where((self.orders + mode) % 2 == 0, 1.0, -1.0)
        # c/4 A_l (-1)^(l + mode): the weight of phi_l phi_l in R (mu + mu')
        self.weights = albedo / 4.0 * coefficients[self.orders] * self.signs
        strong = np.abs(self.weights) > WEAK / 4.0 * (2 * self.orders + 1)
        self.strong = int(np.flatnonzero(strong)[-1]) + 1 if strong.any() else 1
        self._solve(coefficients, nodes)
        self._refine(nodes)

    def _solve(self, coefficients: np.ndarray, nodes: int) -> None:
        orders, signs = self.orders[: self.core], self.signs[: self.core]
        self.mu, self.quadrature = mu, quadrature = crowded_nodes(nodes, FIRST_POWER)
        self.legendre = legendre = associated_legendre(self.mode, orders, mu)
        root = np.sqrt(quadrature)
        orthonormal = np.sqrt(2.0 * orders + 1.0)[:, None] * root * legendre
        factors = 1.0 - self.albedo * coefficients[orders] / (2.0 * orders + 1.0)
        even = signs > 0
        near = self.mode == 0 and self.albedo > SPLIT_ALBEDO
        solve = _impedance_near_conservation if near else _impedance
        impedance, uniform = solve(orthonormal[even], orthonormal[~even], factors[even], factors[~even], mu)
        impedance = (impedance + impedance.T) / 2.0
        both = np.diag(mu) + impedance
        right = np.where(even[:, None], root * legendre, (root * legendre / mu) @ impedance)
        if self.mode == 0:
            kept = np.linalg.solve(both, uniform)
            self.absorbed = 4.0 * float(np.sum(root * mu * kept))
            # mu - 2 mu integral of R mu': the part of a uniform beam's flux that does not return
            right[orders == 1] = uniform
        self.phi = 2.0 * mu * np.linalg.solve(both, right.T).T / root

    def _refine(self, nodes: int) -> None:
        k, orders = self.core, self.orders
        mu, weight = crowded_nodes(max(3 * nodes // 2, 7 * int(orders[-1]) // 4 + 20), SECOND_POWER)
        legendre = _legendre_at_nodes(self.mode, tuple(orders.tolist()), mu.size)
        phi = legendre.copy()
        phi[:k] += self._excess(mu, legendre[:k])
        scattered = 2.0 * self.signs[:, None] * legendre * weight
        step = np.inf
        for _ in range(PICARD_STEPS):
            reflection = (phi.T * self.weights) @ phi / (mu[:, None] + mu)
            before, phi = phi, legendre + scattered @ (reflection * mu)
            last, step = step, np.abs(phi - before).max() / np.abs(phi).max()
            if step < 1e-15 or (step < 1e-12 and step > last / 2):
                break
        self.mu, self.quadrature, self.legendre, self.phi = mu, weight, legendre, phi

    def _excess(self, mu: np.ndarray, legendre: np.ndarray) -> np.ndarray:
        """phi_l - P_l = +-2 mu times the integral of R(mu, mu') P_l(mu'), R by phi_l itself at mu and at the nodes.

        Solved for the strong orders, which leaves a second round nothing to do where there are no weak ones.
        """
        n = legendre.shape[0]
        k = min(n, self.strong)
        scattered = (2.0 * self.quadrature * self.legendre * self.signs[:n, None]).T
        phi = self.weights[:n, None] * self.phi
        pairs = (scattered.T[:k, None] * phi[None, :k]).reshape(k * k, -1).T
        excess = np.zeros((n, mu.size))
        for start in range(0, mu.size, CHUNK):
            part = slice(start, start + CHUNK)
            kernel = mu[part, None] / (mu[part, None] + self.mu)
            rest = np.eye(k) - (kernel @ pairs).reshape(-1, k, k)
            value = np.zeros((kernel.shape[0], n))
            for _ in range(1 if n == k else WEAK_ROUNDS):
                image = (((legendre[:, part].T + value) @ phi) * kernel) @ scattered
                image[:, :k] = value[:, :k] + np.linalg.solve(rest, (image - value)[:, :k, None])[:, :, 0]
                value = image
            excess[:, part] = value.T
        return excess

    def excess(self, mu: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """P_l and phi_l - P_l, one row an order, at cosines in [0, 1]."""
        legendre = associated_legendre(self.mode, self.orders, mu)
        return legendre, self._excess(mu, legendre)

    def multiple(self, first: tuple[np.ndarray, np.ndarray], last: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
        """R (mu + mu') without the light scattered once, elementwise, for two answers of `excess`."""
        (p, x), (q, y) = first, last
        return np.einsum("l,ln->n", self.weights, x * (q + y) + p * y)


class HalfSpace:
    """The half-space of single-scattering albedo c with the phase function 1/(4 pi) sum over l of A_l P_l.

    coefficients: A_0 = 1, A_1, ... of a phase function that is nowhere negative, as far as they matter. albedo: c in
    [0, 1]. modes: how many Fourier modes the light scattered more than once gets, at most core + 1. core: the orders up
    to this one make the matrices of the first step; those above must be small. nodes: of its quadrature, at least 3/2
    core. highest: the highest order for each mode, all where left out.

    Everything is exact but for rounding and these cuts. Azimuth is taken between the outward directions, so phi = 0 is
    backscattering. ValueError for c outside [0, 1], A_0 other than 1, or no finite list of coefficients.

    >>> grey = HalfSpace([1.0], 0.5)
    >>> grey.albedo_at(np.array([0.0, 1.0])).round(9).tolist()
    [0.292893219, 0.115225878]
    """

    def __init__(
        self,
        coefficients: np.typing.ArrayLike,
        albedo: float,
        *,
        modes: int = 40,
        core: int = 48,
        nodes: int = 80,
        highest: Callable[[int], int] | None = None,
    ):
        a = np.asarray(coefficients, dtype=np.float64)
        if a.ndim != 1 or not a.size or not np.isfinite(a).all() or a[0] != 1.0:
            raise ValueError("coefficients must be a list of finite numbers that begins with A_0 = 1")
        if not 0.0 <= albedo <= 1.0:
            raise ValueError(f"a single-scattering albedo lies in [0, 1], and {albedo} does not")
        self.albedo, self.coefficients = float(albedo), a
        self._core, self._nodes, self._highest = core, nodes, highest or (lambda mode: a.size - 1)
        self._solved: dict[int, Mode] = {}
        last = int(np.flatnonzero(a[: core + 1])[-1])
        self.modes = range(min(modes, last + 1))

    def mode(self, mode: int) -> Mode:
        """The solution of one of `modes`, found at its first use."""
        if mode not in self._solved:
            kept = self.coefficients[: self._highest(mode) + 1]
            self._solved[mode] = Mode(mode, kept, self.albedo, self._core, self._nodes)
        return self._solved[mode]

    def fourier(self, mode: int, mu_i: np.ndarray, mu_o: np.ndarray) -> np.ndarray:
        """The factor of cos(mode phi) in the BRDF without single scattering (1/sr), for every pair: a table.

        Infinite where both cosines are 0, with the sign of cos(mode pi), which is that of the light sent straight on
        along the horizon; 0 there for the albedo 0.

        >>> HalfSpace([1.0], 0.5).fourier(0, np.array([0.0, 1.0]), np.array([0.0])).round(9).tolist()
        [[inf], [0.0099973]]
        """
        solution = self.mode(mode)
        (p, x), (q, y) = solution.excess(mu_i), solution.excess(mu_o)
        weighed = solution.weights[:, None]
        total = (weighed * x).T @ (q + y) + (weighed * p).T @ y
        return self.scale(mode) * self._over(total, mu_i[:, None] + mu_o)

    def _over(self, total: np.ndarray, cosines: np.ndarray) -> np.ndarray:
        """total / cosines, and what it grows to where both cosines vanish: without bound, unless nothing scatters."""
        grazing = cosines == 0.0
        return np.where(grazing, self.albedo and np.inf, total / np.where(grazing, 1.0, cosines))

    @staticmethod
    def scale(mode: int) -> float:
        return (1.0 if mode == 0 else 2.0) * (-1.0) ** mode / np.pi

    def multiple(self, mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray) -> np.ndarray:
        """The BRDF (1/sr) without the light scattered once: three vectors of one length, cosines in [0, 1].

        Infinite where both cosines are 0, unless the albedo is.
        """
        cosines, where = np.unique(np.concatenate([mu_i, mu_o]), return_inverse=True)
        # a table of directions at several azimuths has few pairs of cosines
        pairs, pair = np.unique(where.reshape(2, -1), axis=1, return_inverse=True)
        (i, o), pair = pairs, pair.ravel()
        total = np.zeros(mu_i.size)
        for mode in self.modes:
            solution = self.mode(mode)
            p, x = solution.excess(cosines)
            values = np.empty(i.size)
            for start in range(0, i.size, CHUNK):
                part = slice(start, start + CHUNK)
                a, b = i[part], o[part]
                values[part] = solution.multiple((p[:, a], x[:, a]), (p[:, b], x[:, b]))
            total += self.scale(mode) * values[pair] * np.cos(mode * phi)
        return self._over(total, mu_i + mu_o)

    def single(self, mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray) -> np.ndarray:
        """The BRDF (1/sr) of the light scattered once, c p(-w_i . w_o)/(mu_i + mu_o), by the Legendre series.

        Infinite where both cosines are 0, unless the albedo is.
        """
        sines = np.sqrt((1.0 - mu_i) * (1.0 + mu_i) * (1.0 - mu_o) * (1.0 + mu_o))
        cosine = -(mu_i * mu_o + sines * np.cos(phi))
        phase = np.polynomial.legendre.legval(cosine, self.coefficients) / (4.0 * np.pi)
        return self._over(self.albedo * phase, mu_i + mu_o)

    def albedo_at(self, mu: np.ndarray) -> np.ndarray:
        """The part of a beam's power that returns, for a beam from the cosine mu (black-sky albedo)."""
        solution = self.mode(0)
        p, x = solution.excess(mu)
        weighed = 2.0 * solution.quadrature * solution.mu * (solution.weights[:, None] * solution.phi)
        return np.einsum("ln,nj,lj->n", p + x, 1.0 / (mu[:, None] + solution.mu), weighed)

    def absorbed(self) -> float:
        """1 minus the Bond albedo, the part of diffuse light that is lost: small as sqrt(1 - c), and exact so."""
        return self.mode(0).absorbed

    def bond_albedo(self) -> float:
        """The part of light arriving evenly from all directions that returns, without a difference from 1."""
        mu, weight = self.mode(0).mu, self.mode(0).quadrature
        return float(2.0 * np.sum(weight * mu * self.albedo_at(mu)))
