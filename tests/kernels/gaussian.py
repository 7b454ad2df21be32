"""References for the cross-section of the spherical Gaussian: fast ones, which share nothing with the kernel's tables.

The tables come from a positive integral. Here it is the explicit Chebyshev series, in balls, as far as that is short,
and the definition, ring by ring, beyond.
"""

from functools import cache

import numpy as np
from flint import arb, ctx
from mpmath import mp, mpf

from tests.kernels import lobes
from xsec_sym.exact import gaussian_balls

BITS = 120


def least_exponent(u, alpha):
    """w = kappa (1 - s) at the working precision."""
    u, kappa = mpf(float(u)), 2 / mpf(float(alpha)) ** 2
    return kappa * u * u / (1 + mp.sqrt((1 - u) * (1 + u)))


@cache
def sigma(u, alpha):
    """To 30 digits at least."""
    with mp.workdps(40):
        kappa, w = 2 / mpf(float(alpha)) ** 2, least_exponent(u, alpha)
        if kappa < 1e-3 or kappa > gaussian_balls.SERIES or w > 3000:
            return lobes.sigma_spherical_gaussian(u, alpha)
        before, ctx.prec = ctx.prec, BITS + int(1.5 * w)
        try:
            ball = gaussian_balls.value(arb(float(u)), arb(float(alpha)))
            assert ball.rel_accuracy_bits() > 90, (u, alpha)
            mantissa, power = ball.mid().man_exp()
        finally:
            ctx.prec = before
        return mp.ldexp(int(mantissa), int(power))


def log_sigma(u, alpha):
    with mp.workdps(40):
        return mp.log(sigma(u, alpha))


def scaled_sigma(u, alpha):
    with mp.workdps(40):
        return sigma(u, alpha) * (mp.exp(least_exponent(u, alpha)) if u < 0 else 1)


def odd(u, alpha):
    """sigma(u) - sigma(-u)."""
    with mp.workdps(400):
        kappa = 2 / mpf(float(alpha)) ** 2
        return (mp.coth(kappa) - 1 / kappa) * mpf(float(u))


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
