"""The half-space of Lambertian spheres with all of their phase function, by discrete ordinates and interpolation.

No 30 digits are to be had. This shares with the kernel the equations and no step that solves them: the states that
decay with depth are singular vectors, of which the slowest is found apart, without cancellation at c = 1; what
Ambartsumian's equations make of them, with up to 480 orders, is interpolated in a root of mu. It has more orders, more
modes and other nodes than the kernel, and agrees with it as `tests/study/test_methods_half_space.py` says.
"""

from functools import cache, lru_cache

import numpy as np
from scipy import linalg

MODES = 36
HIGHEST = {0: 480, 1: 240, 2: 400}
EVEN, ODD = 112, 80
# The uniform state is found apart where it decays more slowly than all others.
SLOW = 0.9
POWER = 5
STEPS = 30
KEPT = 40


@cache
def coefficients(last):
    """A_l from moments 2 int_0^1 mu P_l dmu = P_l(0) times -2/((l - 1)(l + 2)), for even l > 0; 4/3 of one odd l."""
    a = np.zeros(last + 1)
    at_0 = 1.0
    for l in range(0, last + 1, 2):
        a[l] = (2 * l + 1) * (2 * at_0 / ((l - 1) * (l + 2))) ** 2
        at_0 *= -(l + 1) / (l + 2)
    a[1:2] = -4 / 3
    return a


@cache
def orders(mode, last):
    return np.array([l for l in range(mode, last + 1) if l % 2 == 0 or l == 1])


@cache
def rule(n, power):
    """Nodes x on [0, 1], mu = x^power, and weights of the integral over mu."""
    x, weight = np.polynomial.legendre.leggauss(n)
    x = (1 + x) / 2
    return x, x**power, power * x ** (power - 1) * weight / 2


def associated(mode, last, mu):
    """sqrt((l - m)!/(l + m)!) P_l^m without (-1)^m, for `orders`."""
    rows = np.zeros((last + 1, mu.size))
    sine = np.sqrt((1 - mu) * (1 + mu))
    rows[mode] = np.prod([np.sqrt((2 * k - 1) / (2 * k)) for k in range(1, mode + 1)]) * sine**mode
    for l in range(mode + 1, last + 1):
        rows[l] = (2 * l - 1) * mu * rows[l - 1] / np.sqrt(l * l - mode * mode)
        if l > mode + 1:
            rows[l] -= np.sqrt(((l - 1) ** 2 - mode**2) / (l * l - mode * mode)) * rows[l - 2]
    return rows[orders(mode, last)]


@lru_cache(maxsize=256)
def tabled(mode, last, n, power):
    return associated(mode, last, rule(n, power)[1])


def slowest(scatter, travel, uniform, rest):
    """The state v with scatter v = lambda^2 travel v, nearly uniform, and lambda^2/(1 - c): by power iteration.

    scatter takes `uniform` to rest times itself, which is 1 - c and may be 0.
    """
    definite = linalg.cho_factor(scatter + (1 - rest) * np.outer(uniform, uniform))
    y = np.zeros(uniform.size)
    for _ in range(200):
        moved = travel @ (uniform + rest * y)
        ratio = 1 / (uniform @ moved)
        before, y = y, linalg.cho_solve(definite, ratio * moved - uniform)
        y -= uniform * (uniform @ y)
        if abs(y - before).max() < 1e-16 * abs(y).max():
            break
    return uniform + rest * y, ratio


def decaying(mode, c, last, n):
    """Nodes, weights, P_l and phi_l there, and what is lost of uniform light, from the states that decay with depth.

    Sums s and differences d of the light down and up, times roots of weights: mu s' = -D d and mu d' = -S s, and
    d = lambda D^-1 mu s for a state exp(-lambda depth), where S s = lambda^2 (mu D^-1 mu) s.
    """
    _, mu, weight = rule(n, 2)
    l, p, root = orders(mode, last), tabled(mode, last, n, 2), np.sqrt(weight)
    rows = root * p * np.sqrt(2 * l + 1)[:, None]
    share = c * coefficients(last)[l] / (2 * l + 1)
    even = (l + mode) % 2 == 0
    scatter = np.eye(n) - (rows[even].T * share[even]) @ rows[even]
    # D^(-1/2), as the rows are orthonormal
    thin = np.eye(n) + (rows[~even].T * ((1 - share[~even]) ** -0.5 - 1)) @ rows[~even]
    path = thin * mu
    basis = image = np.eye(n)
    apart = mode == 0 and c > SLOW
    if apart:
        state, ratio = slowest(scatter, path.T @ path, root, 1 - c)
        across = path.T @ (path @ state)
        # no other state has a part along the first, nor its differences along those of the first
        basis, image = (linalg.qr(first[:, None])[0][:, 1:] for first in (across, path @ state))
    within = basis.T @ scatter @ basis
    lower = linalg.cholesky((within + within.T) / 2, lower=True)
    turned = linalg.solve_triangular(lower, basis.T, lower=True)
    left, _, right = linalg.svd(image.T @ path @ turned.T)
    z = path.T @ image @ left @ (right @ turned @ scatter)
    z = (z + z.T) / 2
    if apart:
        slow = np.sqrt((1 - c) * ratio) * across
        z += np.outer(slow, across) / (state @ across)
        # z is symmetric but for rounding, which must not move what z makes of the slow state
        off = slow - z @ state
        unit = state / (state @ state)
        z += np.outer(off, unit) + np.outer(unit, off) - (state @ off) * np.outer(unit, unit)
    both = np.diag(mu) + z
    source = np.where(even[:, None], root * p, (root * p / mu) @ z)
    phi = 2 * mu * np.linalg.solve(both, source.T).T / root
    lost = 4 * float(root * mu @ np.linalg.solve(both, z @ root)) if mode == 0 else None
    return mu, weight, p, phi, lost


def solved_for(mode, c, known, last, mu):
    """phi_l at other cosines: each is a small linear system in Ambartsumian's equations."""
    x, weight, p, phi, _ = known
    l = orders(mode, last)
    signs = np.where((l + mode) % 2 == 0, 1.0, -1.0)
    kernel = mu[:, None] / (mu[:, None] + x) * weight
    factors = c / 2 * signs[:, None] * signs * coefficients(last)[l]
    pairs = p[:, None] * phi * factors[:, :, None]
    matrix = np.eye(l.size) - (kernel @ pairs.reshape(l.size**2, -1).T).reshape(-1, l.size, l.size)
    return np.linalg.solve(matrix, associated(mode, last, mu).T[:, :, None])[:, :, 0].T


class Mode:
    """phi_l of one azimuthal mode at fine nodes, with all orders."""

    def __init__(self, mode, c):
        self.mode, self.last = mode, HIGHEST.get(mode, ODD if mode % 2 else EVEN)
        core = min(48, self.last)
        self.n = 3 * self.last // 2 + 60
        self.x, self.mu, self.weight = rule(self.n, POWER)
        l = orders(mode, self.last)
        self.signs = np.where((l + mode) % 2 == 0, 1.0, -1.0)
        self.factors = c / 4 * coefficients(self.last)[l] * self.signs
        p = tabled(mode, self.last, self.n, POWER)
        phi = p.copy()
        known = decaying(mode, c, core, 100)
        phi[: orders(mode, core).size] = solved_for(mode, c, known, core, self.mu)
        self.projected = 2 * self.signs[:, None] * p * self.weight
        step = np.inf
        for _ in range(STEPS):
            before, phi = phi, p + self.returned(self.mu, phi, phi)
            last, step = step, abs(phi - before).max()
            if step < 1e-15 or (step < 1e-12 and step > last / 2):
                break
        self.phi, self.smooth = phi, (phi - p) / self.sine(self.mu)

    def sine(self, mu):
        """What is not smooth at mu = 1."""
        return np.sqrt((1 - mu) * (1 + mu)) ** (self.mode % 2)

    def returned(self, mu, here, phi):
        """+-2 mu times the integral of R(mu, x) P_l(x), with phi_l at mu and at the nodes."""
        reflection = (here.T * self.factors) @ phi * (mu[:, None] / (mu[:, None] + self.mu))
        return self.projected @ reflection.T

    def at(self, mu, interpolation):
        """P_l and phi_l - P_l: once more through the integral, which keeps its relative error where mu is small."""
        p = associated(self.mode, self.last, mu)
        return p, self.returned(mu, p + (self.smooth @ interpolation.T) * self.sine(mu), self.phi)

    def multiple(self, first, second):
        """R (mu + mu') without light scattered once, for pairs."""
        (p, x), (q, y) = first, second
        return self.factors @ (x * (q + y) + p * y)


@cache
def lagrange(n):
    """The factors of Lagrange's polynomials of Gauss-Legendre nodes, in their barycentric form."""
    ends, weight = np.polynomial.legendre.leggauss(n)
    return (-1.0) ** np.arange(n) * np.sqrt((1 - ends) * (1 + ends) * weight)


def interpolation(n, power, mu):
    """The matrix of Lagrange's polynomials of the nodes x at mu^(1/power)."""
    x, _, _ = rule(n, power)
    gap = mu[:, None] ** (1 / power) - x
    hit = gap == 0
    matrix = lagrange(n) / np.where(hit, 1.0, gap)
    matrix[hit.any(1)] = hit[hit.any(1)]
    return matrix / matrix.sum(1)[:, None]


@lru_cache(maxsize=KEPT)
def solution(c):
    return [Mode(mode, c) for mode in range(MODES)]


def phase(mu_i, mu_o, phi):
    """The phase function at minus the cosine between the directions, by theta = 2 arcsin |w_i + w_o|/2."""
    sines = np.sqrt((1 - mu_i) * (1 + mu_i)), np.sqrt((1 - mu_o) * (1 + mu_o))
    x, y = sines[0] + sines[1] * np.cos(phi), sines[1] * np.sin(phi)
    theta = 2 * np.arcsin(np.minimum(1, np.sqrt(x * x + y * y + (mu_i + mu_o) ** 2) / 2))
    # near pi arcsin loses digits, by which p is changed little
    series, power = np.zeros_like(theta), theta**3
    for k in range(1, 12):
        series += (-1) ** (k + 1) * 2 * k * power / np.prod(np.arange(1.0, 2 * k + 2))
        power = power * theta**2
    return 2 / (3 * np.pi**2) * np.where(theta < 1, series, np.sin(theta) - theta * np.cos(theta))


def multiple(mu_i, mu_o, phi, c):
    """Light scattered more than once, for vectors of directions and one albedo."""
    cosines, where = np.unique(np.concatenate([mu_i, mu_o]), return_inverse=True)
    i, o = where.reshape(2, -1)
    total, tables = np.zeros(mu_i.size), {}
    for mode in solution(float(c)):
        if mode.n not in tables:
            tables[mode.n] = interpolation(mode.n, POWER, cosines)
        p, x = mode.at(cosines, tables[mode.n])
        scale = (2.0 if mode.mode else 1.0) * (-1) ** mode.mode / np.pi
        total += scale * np.cos(mode.mode * phi) * mode.multiple((p[:, i], x[:, i]), (p[:, o], x[:, o]))
    return total / (mu_i + mu_o)


def brdf(mu_i, mu_o, phi, c):
    """Columns of numbers, as a column."""
    mu_i, mu_o, phi, c = (np.asarray(column, float) for column in (mu_i, mu_o, phi, c))
    found = np.where(mu_i + mu_o > 0, 0.0, np.inf)
    for albedo in np.unique(c[c > 0]):
        here = (c == albedo) & (mu_i + mu_o > 0)
        if here.any():
            a, b, angle = mu_i[here], mu_o[here], phi[here]
            found[here] = albedo * phase(a, b, angle) / (a + b) + multiple(a, b, angle, albedo)
    return found


# --- what returns -----------------------------------------------------------------------------------------

CORE, NODES = 48, 100
DEGREE = 40
HALF = 0.5**0.5


def bond(c):
    """The Bond albedo, and what is lost, neither as a difference from 1."""
    mu, weight, _, phi, lost = decaying(0, c, CORE, NODES)
    l = orders(0, CORE)
    factors = c * coefficients(CORE)[l] * np.where(l % 2 == 0, 1.0, -1.0)
    flux = weight * mu * phi
    kept = float(np.sum(((flux.T * factors) @ flux) / (mu[:, None] + mu)))
    return kept, lost


@cache
def barycentric(low, dark):
    """Chebyshev's points between low and 1, and there k_d/c, or (1 - k_d)/s; and Lagrange's weights."""
    angle = (np.arange(DEGREE) + 0.5) * np.pi / DEGREE
    s = (1 + low) / 2 + (1 - low) / 2 * np.cos(angle)
    values = [bond(1 - x * x)[0] / (1 - x * x) if dark else bond(1 - x * x)[1] / x for x in s]
    return s, np.array(values), (-1.0) ** np.arange(DEGREE) * np.sin(angle)


def ratio(s, dark):
    """k_d/c or (1 - k_d)/s at s = sqrt(1 - c), which are smooth there: for c below 1/2, and above."""
    nodes, values, weights = barycentric(HALF if dark else 0.0, dark)
    gap = s - nodes
    if not gap.all():
        return float(values[gap == 0][0])
    share = weights / gap
    return float(share @ values / share.sum())


def albedo(c):
    c = float(c)
    s = np.sqrt(1 - c)
    return c * ratio(s, True) if c < 0.5 else 1 - s * ratio(s, False)


def inverse(k_d):
    """c with albedo(c) = k_d: c = k_d/(k_d/c) and s = (1 - k_d)/((1 - k_d)/s) by secants."""
    k_d = float(k_d)
    if k_d in (0.0, 1.0):
        return k_d
    dark = k_d < albedo(np.nextafter(0.5, 0))
    goal = k_d if dark else 1 - k_d

    def off(x):
        return x * ratio(np.sqrt(1 - x) if dark else x, dark) / goal - 1

    x = min(0.5, 4.5 * goal) if dark else min(HALF, goal / (1 + goal))
    y = 0.9 * x
    fx, fy = off(x), off(y)
    for _ in range(60):
        if fy == fx or fy == 0:
            break
        x, fx, y = y, fy, y - fy * (y - x) / (fy - fx)
        fy = off(y)
        if abs(y - x) <= 1e-16 * abs(y):
            break
    assert abs(fy) < 1e-14, (k_d, y, fy)
    return y if dark else 1 - y * y
