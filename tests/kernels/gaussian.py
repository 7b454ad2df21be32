"""The references of the spherical Gaussian's cross-section, and the arguments to try kernels at."""

import numpy as np
from mpmath import mp, mpf

from xsec_sym.study.references.spherical_gaussian import BITS as BITS
from xsec_sym.study.references.spherical_gaussian import least_exponent as least_exponent
from xsec_sym.study.references.spherical_gaussian import log_sigma as log_sigma
from xsec_sym.study.references.spherical_gaussian import odd as odd
from xsec_sym.study.references.spherical_gaussian import scaled_sigma as scaled_sigma
from xsec_sym.study.references.spherical_gaussian import sigma as sigma


def points(rng, n):
    """Cosines and roughnesses: anywhere, in the layer on the dark side, at its rim, facing and grazing; 5 n of them."""
    alpha = 10 ** rng.uniform(-4, 4, n)
    u = [rng.uniform(-1, 1, n)]
    rough = [alpha]
    u.append(rng.uniform(-1, 0.3, n) * np.minimum(1, 26 * alpha))
    rough.append(alpha)
    u.append(-1 + 10 ** rng.uniform(-17, -1, n))
    rough.append(rng.uniform(0.06, 0.7, n))
    u.append(rng.choice([-1, 1], n) * (1 - 10 ** rng.uniform(-17, 0, n)))
    rough.append(10 ** rng.uniform(-1, 1, n))
    u.append(rng.choice([-1, 1], n) * 10 ** rng.uniform(-20, 0, n))
    rough.append(10 ** rng.uniform(-3, 1, n))
    return np.concatenate(u), np.concatenate(rough)


def worst(values, reference, u, alpha, floor=0.0):
    """The largest relative error where the reference exceeds `floor`, and where it occurs."""
    largest = (0.0, None)
    with mp.workdps(40):
        for value, *point in zip(np.broadcast_to(values, np.shape(u)), u, alpha, strict=True):
            exact = reference(*point)
            if abs(exact) > floor:
                error = float(abs(mpf(float(value)) / exact - 1))
                largest = max(largest, (error, tuple(map(float, point))), key=lambda pair: pair[0])
    return largest
