"""The references of the two squared lobes, and the directions and roughnesses to try kernels at."""

import numpy as np
from mpmath import mpf

from tests.kernels import oracle
from xsec_sym.study.references.squared_lobes import distance as distance
from xsec_sym.study.references.squared_lobes import sel as sel
from xsec_sym.study.references.squared_lobes import ssl as ssl


def worst(kernel, reference, arguments):
    """The largest error in ulps, and where it occurs."""
    largest = (0.0, None)
    for value, *point in zip(kernel(*arguments), *arguments, strict=True):
        error = oracle.ulps(value, reference(*point))
        largest = max(largest, (error, tuple(map(float, point))), key=lambda pair: pair[0])
    return largest


def vectors(angle, azimuth, dtype=np.float64):
    """Directions as they come out of float arithmetic: of unit length to rounding."""
    across = np.sin(angle)
    vector = np.array([across * np.cos(azimuth), across * np.sin(azimuth), np.cos(angle)]).astype(dtype)
    return tuple(vector / np.sqrt((vector * vector).sum(axis=0)))


def directions(rng, alpha):
    """Angles to the axis: anywhere, next to 0, pi/2 and pi, and a few widths of the lobe; some along x or y."""
    n = alpha.size
    tiny = 10 ** rng.uniform(-18, 0, n)
    choices = [
        rng.uniform(0, np.pi, n),
        tiny,
        np.pi / 2 + rng.choice([-1, 1], n) * tiny,
        np.pi - tiny,
        np.minimum(alpha * rng.uniform(0, 5, n), np.pi),
    ]
    azimuth = rng.uniform(0, 2 * np.pi, n)
    azimuth = np.where(rng.random(n) < 0.3, rng.choice([0.0, np.pi / 2], n) + 10 ** rng.uniform(-16, 0, n), azimuth)
    return np.choose(rng.integers(0, len(choices), n), choices), azimuth


def roughnesses(rng, n, smallest=1e-8):
    """Pairs: both small, both large, one far below the other, either way round, and some alike."""
    low = rng.choice([np.log10(smallest), -2.0, -0.3], n)
    first = 10 ** (low * rng.random(n))
    second = np.where(rng.random(n) < 0.5, 10 ** (low * rng.random(n)), first * 10 ** rng.uniform(-3, 0, n))
    second = np.where(rng.random(n) < 0.1, first, second)
    swap = rng.random(n) < 0.5
    return np.where(swap, second, first), np.where(swap, first, second)


def samples(n, dtype=np.float64, seed=11, smallest=1e-8):
    rng = np.random.default_rng(seed)
    pair = roughnesses(rng, n, smallest)
    angle, azimuth = directions(rng, np.where(rng.random(n) < 0.5, *pair))
    return (*vectors(angle, azimuth, dtype), *(alpha.astype(dtype) for alpha in pair))


def cosines(n, dtype=np.float64, seed=12, smallest=1e-8):
    """Pairs (cosine, alpha): uniform, toward both ends, and a few widths of the lobe from the axis."""
    rng = np.random.default_rng(seed)
    alpha = 10 ** (rng.choice([np.log10(smallest), -2.0, -0.3], n) * rng.random(n))
    tiny = 10 ** rng.uniform(-16, 0, n)
    peak = np.maximum(1 - (alpha * rng.uniform(0, 4, n)) ** 2, -1)
    m = np.choose(rng.integers(0, 4, n), [rng.uniform(-1, 1, n), 1 - tiny, tiny - 1, peak])
    return m.astype(dtype), alpha.astype(dtype)


def mpfs(*numbers):
    return [mpf(float(number)) for number in numbers]
