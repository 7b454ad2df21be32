"""The cross-section of the spherical Gaussian, by routes that share nothing with the kernel's tables.

The tables come from a positive integral. Here it is the explicit Chebyshev series, in balls, as far as that is short,
and the definition, ring by ring, beyond.
"""

from functools import cache

from flint import arb, ctx
from mpmath import mp, mpf

from xsec_sym.exact import gaussian_balls
from xsec_sym.study.references import surfaces

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
            return surfaces.sigma_spherical_gaussian(u, alpha)
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
