"""Look for a short formula of the light that spheres scatter more than once.

`python -m xsec_sym.export.search_fast_variant [SEED]`, some two minutes; it needs the extra `search` (pyoperon, the
symbolic regression of Operon) and writes nothing. It prints those formulas, of all that it has found, than which no
other is both shorter and closer.

What `deon2021:48` got from TuringBot is sought here among the four operations only, and in quantities that the exact
single scattering beside it needs anyway or nearly so, all of them the same when the two directions change places:

    P = mu_i + mu_o,   M = mu_i mu_o,   G = sqrt(1 - mu_i^2) sqrt(1 - mu_o^2) cos phi,   s = sqrt(1 - c),   c.

`brdf_lambert_sphere_fast` follows the formula of length 29 that seed 1 finds,

    a + (b s + c P + d + (e s + f M)/(s + g P)) (s + (h P + i) (j G + k) + l),

put in order by hand: the factor 1 - s that nearly all of it vanishes by at c = 0 is taken out, the constants that this
makes superfluous are left out, and `polished` chooses the others.
"""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from xsec_sym.kernels.lambert_sphere import brdf_lambert_sphere, phase_lambert_sphere

NAMES = ("P", "M", "G", "s", "c")
ALBEDOS = 32
# Towards grazing the truth grows as a logarithm, of which no short formula should be made to follow the end.
LEAST = 0.025


def sample(seed: int, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Columns mu_i, mu_o, phi, c at random, c with more near 1, and the exact BRDF less its single scattering."""
    rng = np.random.default_rng(seed)
    albedos = 1.0 - np.linspace(0.0, 1.0, ALBEDOS) ** 2
    mu = rng.uniform(LEAST, 1.0, (2, count))
    phi, c = rng.uniform(0.0, np.pi, count), albedos[np.arange(count) % ALBEDOS]
    sines = np.sqrt((1.0 - mu[0] ** 2) * (1.0 - mu[1] ** 2))
    single = c * phase_lambert_sphere(-(mu[0] * mu[1] + sines * np.cos(phi))) / (mu[0] + mu[1])
    return np.stack([*mu, phi, c], axis=1), np.asarray(brdf_lambert_sphere(mu[0], mu[1], phi, c)) - single


def features(points: np.ndarray) -> np.ndarray:
    """The columns of NAMES for those of `sample`."""
    mu_i, mu_o, phi, c = points.T
    turned = np.sqrt((1.0 - mu_i**2) * (1.0 - mu_o**2)) * np.cos(phi)
    return np.stack([mu_i + mu_o, mu_i * mu_o, turned, np.sqrt(1.0 - c), c], axis=1)


def regressor(seed: int, length: int, evaluations: int) -> Any:
    """Operon's estimator with the settings of this search: two aims, the fit and the length."""
    try:
        from pyoperon.sklearn import SymbolicRegressor
    except ImportError as error:
        raise ImportError("the search needs pyoperon: install the extra with pip install 'xsec_sym[search]'") from error
    return SymbolicRegressor(
        allowed_symbols="add,sub,mul,div,constant,variable",
        objectives=["mse", "length"],
        max_length=length,
        max_depth=8,
        optimizer_iterations=4,
        population_size=600,
        pool_size=600,
        generations=100_000,
        max_evaluations=evaluations,
        epsilon=1e-8,
        n_threads=1,
        random_state=seed,
    )


def search(seed: int, length: int = 30, evaluations: int = 800_000, count: int = 960) -> list[tuple[int, float, str]]:
    """(length, root mean square error at fresh points, formula), shortest first and each closer than those before."""
    model = regressor(seed, length, evaluations)
    points, target = sample(seed, count)
    fresh, truth = sample(seed + 1, 4 * count)
    model.fit(features(points), target)
    found = []
    for candidate in model.pareto_front_:
        error = model.evaluate_model(candidate["tree"], features(fresh)).ravel() - truth
        text = model.get_model_string(candidate["tree"], 6, list(NAMES))
        found.append((int(candidate["tree"].Length), float(np.sqrt(np.mean(error**2))), text))
    front: list[tuple[int, float, str]] = []
    for entry in sorted(found):
        if not front or entry[1] < front[-1][1]:
            front.append(entry)
    return front


def form(k: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """The formula of `brdf_lambert_sphere_fast` for the columns of `features`, where it is not negative."""
    p, m, g, s, _ = columns.T
    bright = k[0] + k[1] * s + k[2] * p + (k[3] * s + k[4] * m) / (s + k[5] * p)
    return (1.0 - s) * bright * (1.0 + k[6] * s + k[7] * p + (k[8] + k[9] * p) * g)


def polished(seed: int, count: int = 4000, rounds: int = 6) -> np.ndarray:
    """The constants of `form`, between least squares and least largest error: weights grow with the error."""
    points, target = sample(seed, count)
    columns = features(points)
    k = np.array([0.2, 0.1, -0.05, 0.05, 0.1, 0.15, -0.5, -0.1, -0.1, 0.05])
    weight, best, least = np.ones(count), k, np.inf
    for _ in range(rounds):
        k = least_squares(lambda k, w: (form(k, columns) - target) * w, k, x_scale="jac", args=(weight,)).x
        error = abs(form(k, columns) - target)
        measure = np.sqrt(np.mean(error**2)) + 0.3 * error.max()
        if measure < least:
            best, least = k, measure
        weight = weight * np.sqrt(error / error.max() + 0.3)
        weight /= weight.mean()
    return best


def main() -> None:
    print("constants of brdf_lambert_sphere_fast:", ", ".join(f"{k:.5g}" for k in polished(11)))
    for length, error, formula in search(int(sys.argv[1]) if sys.argv[1:] else 1):
        print(f"{length:3d}  {error:.2e}  {formula}")


if __name__ == "__main__":
    main()
