"""The four distributions of normals and their cross-sections.

The cross-sections are the closed forms of deon2016, mended, which `tests/kernels/test_lobes.py` compares with the
definition; that of the spherical Gaussian is the definition.
"""

from functools import wraps

from mpmath import mp, mpf


def exactly(function):
    """The function of the numbers that the doubles or singles are, at 180 digits or more."""

    @wraps(function)
    def reference(*arguments):
        with mp.workdps(max(180, mp.dps)):
            return function(*(mpf(float(argument)) for argument in arguments))

    return reference


@exactly
def sigma_beckmann(u, alpha):
    s = mp.sqrt(1 - u * u)
    if not alpha * s:
        return max(u, mpf(0))
    a = u / (alpha * s)
    return (u * mp.erfc(-a) + alpha * s * mp.exp(-a * a) / mp.sqrt(mp.pi)) / 2


@exactly
def sigma_ggx(u, alpha):
    return (u + mp.sqrt(u * u + alpha * alpha * (1 - u * u))) / 2


@exactly
def sigma_ellipsoidal(u, b):
    if b in (0, 1):
        return max(u, mpf(0)) if b else mpf(1) / 4
    R, L = mp.sqrt(1 - b * b * (1 - u * u)), mp.log((1 + b) / (1 - b))
    # (1 - u)/(R - u) at its limit
    quotient = (1 - u) / (R - u) if u != 1 else 1 / (1 - b * b)
    return (1 - b * u - R + u * mp.log((1 + b) * quotient)) / (b * L)


@exactly
def ndf_beckmann(u, alpha):
    return mp.exp(-(1 / u**2 - 1) / alpha**2) / (mp.pi * alpha**2 * u**4) if u > 0 else mpf(0)


@exactly
def ndf_ggx(u, alpha):
    return alpha**2 / (mp.pi * u**4 * (alpha**2 + 1 / u**2 - 1) ** 2) if u > 0 else mpf(0)


@exactly
def ndf_ellipsoidal(u, b):
    return b / (2 * mp.pi * (1 - b * u) * mp.log((1 + b) / (1 - b)))


@exactly
def ndf_spherical_gaussian(u, alpha):
    kappa = 2 / alpha**2
    return kappa * mp.exp(-kappa * (1 - u)) / (2 * mp.pi * -mp.expm1(-2 * kappa))


def lambda_beckmann(u, alpha):
    return sigma_beckmann(-float(u), alpha) / mpf(float(u)) if u else mp.inf


def lambda_ggx(u, alpha):
    return sigma_ggx(-float(u), alpha) / mpf(float(u)) if u else mp.inf


def sigma_spherical_gaussian(u, alpha, digits=30):
    """The definition, ring by ring, with panels where exp(-kappa (1 - x)) and the lit arc change.

    For u < 0 the rings that are lit in part, x = s cos(eta); the rest follows from the odd part, the mean cosine.
    """
    with mp.workdps(digits + 15):
        u, kappa = mpf(float(u)), 2 / mpf(float(alpha)) ** 2
        v = abs(u)
        s = mp.sqrt(1 - v * v)
        scale = kappa / (2 * mp.pi * -mp.expm1(-2 * kappa))
        # The rings -1 < x < -s are fully lit.
        total = 2 * mp.pi * v * (moment(-mpf(1), kappa) - moment(-s, kappa))

        def partly(eta):
            x, root = s * mp.cos(eta), s * mp.sin(eta)
            a = v * x
            return mp.exp(-kappa * (1 - x)) * root * 2 * (root - a * mp.atan2(root, a))

        end = mp.pi
        if kappa * s > 4 * digits:
            end = min(end, 2 * mp.asin(min(mpf(1), mp.sqrt(mpf(3) * digits / (2 * kappa * s)))))
        edges = [end * mpf(k) / 8 for k in (0, 1, 2, 4, 8)]
        layer = v / s if s else mpf(1)
        edges = sorted({*edges, *(layer * k for k in (1, 8) if layer * k < end)})
        if s:
            # `quad` stops at an absolute error, so the integrand must not be small.
            unit = max(map(partly, edges[1:-1]))
            total += unit * mp.quad(lambda eta: partly(eta) / unit, edges)
        dark = scale * total
        return dark + (mp.coth(kappa) - 1 / kappa) * u if u > 0 else dark


def moment(x, kappa):
    """The antiderivative of x exp(-kappa (1 - x))."""
    return mp.exp(-kappa * (1 - x)) * (x / kappa - 1 / kappa**2)
