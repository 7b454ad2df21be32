"""How long a method takes: nanoseconds a value, warmed, beside np.exp and a copy of the same array in the same run."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from xsec_sym.study.method import Method, Quantity

SIZES = (10**3, 10**5, 10**6)
# Seconds for one size of one method, and the fewest and most repeats.
BUDGET, FEWEST, MOST = 0.12, 3, 15


@dataclass(frozen=True)
class Time:
    """Nanoseconds a value: the median and the quartiles over repeats of arrays of n values; seconds of set-up."""

    n: int
    median: float
    q1: float
    q3: float
    setup: float = 0.0


def timed(run: Callable[[], object], n: int, budget: float = BUDGET) -> Time:
    run()
    laps: list[float] = []
    start = time.perf_counter()
    while len(laps) < FEWEST or (len(laps) < MOST and time.perf_counter() - start < budget):
        before = time.perf_counter()
        run()
        laps.append(time.perf_counter() - before)
    q1, median, q3 = np.quantile(laps, [0.25, 0.5, 0.75]) * 1e9 / n
    return Time(n, float(median), float(q1), float(q3))


def yardsticks(n: int, dtype: str = "float64") -> dict[str, float]:
    """What memory and the processor allow for so many values, in nanoseconds a value."""
    from scipy import special

    x = np.random.default_rng(0).uniform(0.1, 1, n).astype(dtype)
    runs: dict[str, Callable[[], object]] = {
        "copy": x.copy,
        "np.exp": lambda: np.exp(x),
        "scipy.special.erf": lambda: special.erf(x),
        "scipy.special.i0e": lambda: special.i0e(x),
    }
    return {name: timed(run, n).median for name, run in runs.items()}


def times(
    quantity: Quantity,
    method: Method,
    parameters: Mapping[str, Any],
    fixed: tuple[float, ...] = (),
    dtype: str = "float64",
    sizes: tuple[int, ...] = SIZES,
    seed: int = 0,
) -> list[Time]:
    """The times at arrays of these sizes, as far as a single call stays within some seconds.

    fixed: values of the set arguments that are constant; without them they are arrays as well.
    """
    before = time.perf_counter()
    function = method.function(parameters, fixed)
    setup = time.perf_counter() - before
    rng = np.random.default_rng(seed)
    found: list[Time] = []
    cost = 0.0
    for n in (10, *sizes) if method.serial else [n for n in sizes if n >= method.least]:
        if (method.serial and n > 10**3) or cost * n > 3e9:
            break
        running, others = quantity.given(quantity.columns(rng, n), dtype)
        columns = running if fixed else (*running, *others)
        with np.errstate(all="ignore"):
            lap = timed(lambda columns=columns: function(*columns), n)  # type: ignore[misc]
        cost = lap.median
        found.append(Time(lap.n, lap.median, lap.q1, lap.q3, setup))
    return found[-len(sizes) :] if not method.serial else found[-1:]
