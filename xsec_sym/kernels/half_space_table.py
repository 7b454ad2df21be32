"""A half-space's BRDF for many directions at once: products of few functions of one cosine each, from tables.

Without single scattering, a mode of R(mu, mu') (mu + mu') is mu A(mu, mu') + mu' A(mu', mu), with

    A(mu, mu') = sum over l of (phi_l - P_l)(mu)/mu w_l (phi_l + P_l)(mu')/2,     w_l the weights of `Mode`,

which is as smooth as log mu, and whose absolute error is R's. On a product of nodes its singular values fall fast: a
few pairs of functions remain of hundreds of orders, and polynomials on panels that narrow toward 0 give them between
the nodes.
"""

import numpy as np

from xsec_sym.kernels.half_space import HalfSpace

# Every lower panel is a quarter of the one above; the upper ones are narrower, as Legendre's polynomials of high order
# turn fastest there.
EDGES = np.concatenate([[0.0], 0.25 ** np.arange(13, 0, -1), [0.5, 0.75, 1.0]])
NODES = 24
# Below it there is no panel, for there is no end to them.
LOWEST = float(EDGES[1])
# Singular values that count, of a table whose largest element is 1, for each node.
NEGLIGIBLE = 1e-14
# Columns that are tried first for the image of such a table.
WIDTH = 40
# Directions in a turn: their functions stay in a second-level cache.
BATCH = 512


def _nodes() -> tuple[np.ndarray, np.ndarray]:
    """Chebyshev's points of every panel but the first, a row each, and the matrix from values there to coefficients."""
    angle = np.pi * (np.arange(NODES) + 0.5) / NODES
    low, high = EDGES[1:-1, None], EDGES[2:, None]
    transform = 2.0 / NODES * np.cos(np.arange(NODES)[:, None] * angle)
    transform[0] /= 2.0
    return (low + high) / 2.0 + (high - low) / 2.0 * np.cos(angle), transform


def _polynomials(z: np.ndarray) -> np.ndarray:
    """T_0 to T_{NODES - 1} of Chebyshev's, a column each."""
    rows = np.empty((NODES, z.size))
    rows[0], rows[1] = 1.0, z
    twice = 2.0 * z
    for k in range(2, NODES):
        np.multiply(twice, rows[k - 1], out=rows[k])
        rows[k] -= rows[k - 2]
    return np.ascontiguousarray(rows.T)


def _factors(a: np.ndarray, least: float) -> tuple[np.ndarray, np.ndarray]:
    """Two narrow matrices whose product is a, but for singular values below `least`.

    The image of a few vectors at random holds all larger ones, if there are fewer of them by far.
    """
    rng, width = np.random.default_rng(0), WIDTH
    while True:
        whole = width >= a.shape[0]
        basis = np.eye(a.shape[0]) if whole else np.linalg.qr(a @ rng.normal(size=(a.shape[0], width)))[0]
        left, values, right = np.linalg.svd(basis.T @ a, full_matrices=False)
        kept = int(np.count_nonzero(values > least))
        if whole or kept <= width // 2:
            root = np.sqrt(values[:kept])
            return basis @ left[:, :kept] * root, right[:kept].T * root
        width *= 4


class HalfSpaceTable:
    """`HalfSpace.multiple` from tables, for cosines from `LOWEST` on: some 2 us a value.

    >>> grey = HalfSpace([1.0], 0.5)
    >>> mu_i, mu_o, phi = np.array([0.5]), np.array([0.7]), np.zeros(1)
    >>> bool(abs(HalfSpaceTable(grey).multiple(mu_i, mu_o, phi) / grey.multiple(mu_i, mu_o, phi) - 1) < 1e-12)
    True
    """

    def __init__(self, half_space: HalfSpace):
        nodes, transform = _nodes()
        mu = nodes.ravel()
        sine = np.sqrt((1.0 - mu) * (1.0 + mu))
        first, last, modes = [], [], []
        largest = 0.0
        for mode in half_space.modes:
            solution = half_space.mode(mode)
            p, x = solution.excess(mu)
            if mode % 2:
                # its square root at mu = 1, which no polynomial follows
                p, x = p / sine, x / sine
            a = (x / mu).T @ (half_space.scale(mode) * solution.weights[:, None] * (p + x / 2.0))
            largest = max(largest, float(np.abs(a).max()))
            left, right = _factors(a, NEGLIGIBLE * largest * mu.size)
            first.append(left)
            last.append(right)
            modes += [mode] * left.shape[1]
        self.modes = np.array(modes, dtype=int)
        self._modes = 1 + max(modes, default=0)
        self._sum = (self.modes[:, None] == np.arange(self._modes)).astype(np.float64)
        functions = np.concatenate(first + last, axis=1).reshape(*nodes.shape, -1)
        self._coefficients = transform @ functions

    def _functions(self, mu: np.ndarray) -> np.ndarray:
        """The first and the last functions at these cosines, a row each."""
        panel = np.searchsorted(EDGES[2:-1], mu, side="right")
        order = np.argsort(panel, kind="stable")
        mu, panel = mu[order], panel[order]
        low, high = EDGES[1 + panel], EDGES[2 + panel]
        polynomials = _polynomials((2.0 * mu - (low + high)) / (high - low))
        ends = np.searchsorted(panel, np.arange(EDGES.size - 1))
        sorted_values = np.empty((mu.size, self._coefficients.shape[2]))
        for coefficients, start, end in zip(self._coefficients, ends[:-1], ends[1:], strict=True):
            if end > start:
                np.matmul(polynomials[start:end], coefficients, out=sorted_values[start:end])
        values = np.empty_like(sorted_values)
        values[order] = sorted_values
        return values

    def _batch(self, mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray) -> np.ndarray:
        functions = self._functions(np.concatenate([mu_i, mu_o]))
        n, k = mu_i.size, self.modes.size
        products = mu_i[:, None] * functions[:n, :k]
        products *= functions[n:, k:]
        others = mu_o[:, None] * functions[n:, :k]
        others *= functions[:n, k:]
        products += others
        cosines = np.empty((self._modes, n))
        cosines[0] = 1.0
        cosines[1:2] = np.cos(phi)
        for mode in range(2, self._modes):
            np.multiply(2.0 * cosines[1], cosines[mode - 1], out=cosines[mode])
            cosines[mode] -= cosines[mode - 2]
        cosines[1::2] *= np.sqrt((1.0 - mu_i) * (1.0 + mu_i) * (1.0 - mu_o) * (1.0 + mu_o))
        return np.einsum("nm,mn->n", products @ self._sum, cosines) / (mu_i + mu_o)

    def multiple(self, mu_i: np.ndarray, mu_o: np.ndarray, phi: np.ndarray) -> np.ndarray:
        """The BRDF (1/sr) without the light scattered once: three vectors of one length, cosines in [LOWEST, 1]."""
        value = np.empty(mu_i.size)
        for start in range(0, mu_i.size, BATCH):
            part = slice(start, start + BATCH)
            value[part] = self._batch(mu_i[part], mu_o[part], phi[part])
        return value
