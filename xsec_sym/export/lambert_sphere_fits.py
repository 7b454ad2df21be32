"""Write the numbers behind the fits of Lambertian spheres: `python -m xsec_sym.export.lambert_sphere_fits`.

The reflection of the half-space with the phase function's first three terms, `deon2021:16`, consists of H functions of
one cosine and c, and of constants of c. Each is fitted by a quotient of polynomials of least largest error:

- H - 1 is c mu times such a quotient in sqrt(mu). Near mu = 0 it is mu log mu, which no polynomial in mu follows; with
  mu in front its error vanishes there, and what is left of H H - 1 can be divided by mu_i + mu_o.
- H of mode 0, the constants and the albedo depend on sqrt(1 - c), the other H on c itself.
- POLISH is what the fit lacks of energy at c = 1, for a beam from mu: the phase function's terms beyond the third,
  scattered once only, and the errors of the rest.

Everything is computed from the definitions with no random numbers, so that the same numbers come out again.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

import xsec_sym
from xsec_sym.kernels import lambert_sphere_fits as kernel
from xsec_sym.kernels.half_space import HalfSpace, crowded_nodes
from xsec_sym.kernels.lambert_sphere import albedo_lambert_sphere
from xsec_sym.record.files import writing

ROOT = Path(xsec_sym.__file__).parent
TERMS = (1.0, -4.0 / 3.0, 5.0 / 16.0)
NODES, WEIGHTS = crowded_nodes(160, 4)
# H - 1 may be off by a few 1e-6 everywhere, and below this cosine in proportion to mu only
GRAZING = 1e-3
ROUNDS = 60

Table = list[list[float]]


def psi(mode: int, mu: np.ndarray, c: float) -> np.ndarray:
    """The characteristic functions `deon2021:Psi.0` to `deon2021:Psi.2`."""
    square = mu * mu
    if mode == 0:
        return c / 384 * (15 * (1 - c) * (4 * c + 9) * square**2 + (c * (20 * c + 281) - 346) * square + 207)
    if mode == 1:
        return c / 192 * (1 - square) * (5 * (4 * c + 9) * square - 64)
    return 15 / 256 * c * (1 - square) ** 2


def h(mode: int, mu: np.ndarray, s: float) -> np.ndarray:
    """H of a mode for c = 1 - s^2: `deon2021:20` with the product that it misprints, by Newton's method.

    In the form 1/H = 1/H(infinity) + integral of x Psi H/(mu + x), all whose terms are positive for mode 0; its
    constant is known without the difference that it is of 1 and nearly 1.
    """
    c = 1.0 - s * s
    weighed = NODES * WEIGHTS * psi(mode, NODES, c)
    if mode == 0:
        rest = s * np.sqrt((16 - c) * (4 * c + 9)) / 12
    else:
        rest = np.sqrt(1 - 2 * np.sum(WEIGHTS * psi(mode, NODES, c)))
    kernel_ = 1.0 / (NODES[:, None] + NODES)
    values = np.ones(NODES.size)
    for _ in range(60):
        inverse = rest + kernel_ @ (weighed * values)
        slope = np.diag(inverse) + values[:, None] * kernel_ * weighed
        step = np.linalg.solve(slope, 1.0 - values * inverse)
        values = values + step
        if abs(step).max() < 1e-15:
            break
    return 1.0 / (rest + (1.0 / (mu[:, None] + NODES)) @ (weighed * values))


def constants(s: float) -> tuple[float, float, float, float]:
    """B, D, F of `deon2021:36` and l of `deon2021:27`, from the solved half-space and the H functions."""
    c = 1.0 - s * s
    half = HalfSpace(TERMS, c, core=2, nodes=60)
    a, b = half.mode(0).mu[:, None], half.mode(0).mu

    def bracket(mode: int, scale: float) -> np.ndarray:
        solution = half.mode(mode)
        both = np.outer(*[h(mode, solution.mu, s)] * 2)
        return scale * (solution.phi.T * solution.weights) @ solution.phi / both

    known = 69 * c / 128 + 15 / 128 * (1 - c) * c * (4 * c / 3 + 3) * (a * b) ** 2
    known = known - a * b * c * (20 * c * c + 281 * c - 346) / 384
    shapes = [a + b, a * b * (a + b), a * a + b * b + 2 * a * b]
    columns = np.stack([shape.ravel() for shape in shapes], axis=1)
    b_, d, f = np.linalg.lstsq(columns, (bracket(0, 2.0) - known).ravel(), rcond=None)[0]
    # mode 1: -c/3 sqrt sqrt (1 + 5(4c + 9)/64 mu mu' + l (mu + mu')), with the sign of the azimuth
    first = bracket(1, 6.0 / c) / np.sqrt((1 - a * a) * (1 - b * b))
    sign = np.sign(first[0, 0])
    rest = sign * first - 1 - 5 * (4 * c + 9) / 64 * a * b
    l = np.sum(rest * (a + b)) / np.sum((a + b) ** 2)
    return float(b_), float(d), float(f), float(l)


def quotient(
    upper: np.ndarray, lower: np.ndarray, target: np.ndarray, weight: np.ndarray
) -> tuple[np.ndarray, np.ndarray, float]:
    """p, q and the largest of weight |upper p/(1 + lower q) - target|, after Lawson: weights grow with the error."""
    lawson, below = np.ones(target.size), np.ones(target.size)
    best = (np.zeros(0), np.zeros(0), np.inf)
    for turn in range(ROUNDS):
        row = np.sqrt(lawson) * weight / below
        matrix = np.concatenate([upper, -target[:, None] * lower], axis=1) * row[:, None]
        found = np.linalg.lstsq(matrix, target * row, rcond=1e-13)[0]
        p, q = found[: upper.shape[1]], found[upper.shape[1] :]
        below = np.maximum(1.0 + lower @ q, 1e-2)
        error = abs(upper @ p / below - target) * weight
        if error.max() < best[2] and below.min() > 1e-2:
            best = (p, q, float(error.max()))
        if turn >= 4:
            lawson = lawson * (error / error.max() + 1e-3)
            lawson = np.maximum(lawson / lawson.max(), 1e-12)
    return best


def products(x: np.ndarray, y: np.ndarray, powers: range, degree: int) -> np.ndarray:
    return np.stack([x**j * y**k for j in powers for k in range(degree + 1)], axis=1)


def chebyshev(n: int) -> np.ndarray:
    return (1.0 - np.cos(np.pi * (np.arange(n) + 0.5) / n)) / 2.0


def h_tables(mode: int) -> tuple[Table, Table]:
    """Rows by powers of sqrt(mu), from 0 above and from 1 below the line; columns by powers of s, or of c."""
    rows, upper_degree, lower_degree, count = {0: (3, 1, 3, 4), 1: (3, 0, 1, 3), 2: (2, 0, 1, 3)}[mode]
    roots = np.append(chebyshev(60), 1.0)
    roots = roots[roots > 0]
    mu = roots**2
    albedos = 1.0 - np.append(0.0, chebyshev(24)) ** 2 if mode == 0 else np.append(1.0, chebyshev(16))
    u, c = (grid.ravel() for grid in np.meshgrid(roots, albedos))
    values = np.concatenate([h(mode, mu, float(np.sqrt(1.0 - albedo))) for albedo in albedos])
    variable = np.sqrt(1.0 - c) if mode == 0 else c
    scale = c * u * u
    weight = scale / values * (1.0 + GRAZING / (u * u + GRAZING / 10))
    upper = products(u, variable, range(rows), upper_degree)
    lower = products(u, variable, range(1, count + 1), lower_degree)
    p, q, _ = quotient(upper, lower, (values - 1.0) / scale, weight)
    return p.reshape(rows, -1).tolist(), q.reshape(count, -1).tolist()


def polynomial(x: np.ndarray, y: np.ndarray, degree: int, weight: np.ndarray) -> list[float]:
    return quotient(products(x, x, range(degree + 1), 0), np.zeros((x.size, 0)), y, weight)[0].tolist()


def constant_tables() -> dict[str, Table]:
    """B/c, D/(c s), F/(c s) and l/c by powers of s: what vanishes with c, or at c = 1, does so exactly."""
    s = np.append(chebyshev(40), 0.999)
    c = 1.0 - s * s
    b, d, f, l = np.array([constants(float(x)) for x in s]).T
    return {
        "B": [polynomial(s, b / c, 5, c)],
        "D": [polynomial(s, d / (c * s), 5, c * s)],
        "F": [polynomial(s, f / (c * s), 5, c * s)],
        "L": [polynomial(s, l / c, 2, c)],
    }


def albedo_tables() -> dict[str, Table]:
    """k_d = c P(s) with P(0) = 1, and the inverse s = 1 - k_d P(r)/Q(r), r = 1 - k_d: exact at both ends."""
    s = np.append(chebyshev(80), 0.0)
    s = s[s < 1.0]
    c = 1.0 - s * s
    k_d = np.asarray(albedo_lambert_sphere(c))
    r = 1.0 - k_d
    inside = s > 0.0
    x = s[inside]
    albedo = [1.0, *polynomial(x, (k_d / c - 1.0)[inside] / x, 5, x * np.maximum(c[inside], 0.15))]

    def through_one(x: np.ndarray, y: np.ndarray, weight: np.ndarray) -> tuple[Table, Table]:
        # y (1 + Q) = 1 + P, with the 1 on the other side
        ratio = (y - 1.0) / np.where(x > 0.0, x, 1.0)
        inside = x > 0.0
        x, ratio, weight = x[inside], ratio[inside], weight[inside]
        p, q, _ = quotient(products(x, x, range(3), 0), products(x, x, range(1, 3), 0), ratio, weight)
        # 1 + x p/(1 + q)
        above = [1.0, *(float(v) for v in np.append(q, 0.0) + p)]
        return [above], [[1.0, *q.tolist()]]

    # the change of c by that of s is 2 s
    inverse_up, inverse_down = through_one(r, (1.0 - s) / k_d, r * k_d * 2.0 * s / np.maximum(c, 0.2))
    return {"ALBEDO": [albedo], "INVERSE": [*inverse_up, *inverse_down]}


def polish() -> Table:
    """What a beam from mu loses at c = 1, as a polynomial in sqrt(mu); adding it to both directions mends the sum."""
    root, share = crowded_nodes(120, 4)
    phi = np.arange(96) * (2 * np.pi / 96)
    mu = np.append(chebyshev(30), [1.0]) ** 2
    values = kernel.brdf_lambert_sphere_fit(mu[:, None, None], root[:, None], phi, 1.0)
    lost = 1.0 - 2 * np.pi * values.mean(axis=-1) @ (share * root)
    # a sum p(mu_i) + p(mu_o) gives pi (p(mu) + 2 integral of p x)
    powers = np.arange(6)
    columns = np.pi * (mu[:, None] ** (powers / 2) + 4.0 / (powers + 4.0))
    return [np.linalg.lstsq(columns, lost, rcond=None)[0].tolist()]


def tables(before: Callable[[dict[str, Table]], None]) -> dict[str, Table]:
    """All tables; `before` is given those that the last one is computed with."""
    found: dict[str, Table] = {}
    for mode in range(3):
        found[f"H{mode}_UPPER"], found[f"H{mode}_LOWER"] = h_tables(mode)
    found |= constant_tables() | albedo_tables() | {"POLISH": [[0.0, 0.0]]}
    before(found)
    return found | {"POLISH": polish()}


def use(found: dict[str, Table]) -> None:
    for name, table in found.items():
        setattr(kernel.tables, name, table)


def module(found: dict[str, Table]) -> str:
    lines = [
        '"""The numbers of `lambert_sphere_fits`: lists by powers of one variable, of lists by those of the other.\n\n'
        "Lowest powers first. Generated by `python -m xsec_sym.export.lambert_sphere_fits`, which explains them: do "
        'not edit.\n"""\n\n# fmt: off\n'
    ]
    for name, table in found.items():
        rows = "".join(f"    [{', '.join(f'{entry:.9g}' for entry in row)}],\n" for row in table)
        lines.append(f"{name}: list[list[float]] = [\n{rows}]\n")
    return "\n".join(lines)


def main() -> None:
    found = tables(use)
    with writing(ROOT / "kernels" / "_lambert_sphere_fits_tables.py") as out:
        out.write(module(found))


if __name__ == "__main__":
    main()
