"""The four distributions of normals in mpmath, their cross-sections, and the arguments to try them at.

The cross-sections are the closed forms of deon2016, mended, which `test_lobes` compares with the definition; that of
the spherical Gaussian is the definition.
"""

import numpy as np
from mpmath import mp, mpf

from tests.kernels import oracle

ULPS = 8


def exactly(function):
    """The function of the numbers that the doubles or singles are, at 180 digits or more."""

    def reference(*arguments):
        with mp.workdps(max(180, mp.dps)):
            return function(*(mpf(float(argument)) for argument in arguments))

    reference.inner = function
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
    return sigma_beckmann(-float(u), alpha) / mpf(float(u))


def lambda_ggx(u, alpha):
    return sigma_ggx(-float(u), alpha) / mpf(float(u))


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


def worst(kernel, reference, u, roughness):
    """The largest error in ulps, where the value overflows only if the reference does; and where it occurs."""
    values = kernel(u, roughness)
    largest = (0.0, None)
    for value, *point in zip(values, u, roughness, strict=True):
        exact = reference(*point)
        if exact > float(np.finfo(values.dtype).max):
            error = 0.0 if value == np.inf else np.inf
        else:
            error = oracle.ulps(value, exact)
        largest = max(largest, (error, tuple(map(float, point))), key=lambda pair: pair[0])
    return largest


def cosines(rng, n):
    """Cosines of both signs: uniform, toward 0 and toward 1, in equal numbers."""
    near = np.concatenate([rng.uniform(0, 1, n), 10 ** rng.uniform(-18, 0, n), 1 - 10 ** rng.uniform(-16, 0, n)])
    return near * rng.choice([-1, 1], near.size)


def slopes(rng, n):
    """Pairs (u, alpha) with u/(alpha sqrt(1 - u^2)) between 0 and 28, where Beckmann's functions fall off."""
    alpha = 10 ** rng.uniform(-4, 4, n)
    t = rng.uniform(0, 28, n) * alpha
    return t / np.sqrt(1 + t * t), alpha


CORNERS = np.array([0.0, 5e-324, 1e-300, 1e-160, 1e-30, 1e-8, 0.5, np.sqrt(0.5), 1 - 1e-8, np.nextafter(1, 0), 1.0])
CORNERS = np.unique(np.concatenate([CORNERS, -CORNERS]))
ROUGHNESSES = np.array([1e-4, 0.01, 0.0707, 0.3, np.nextafter(1, 0), 1.0, 3.0, 100.0, 1e4])


def corners(dtype, roughnesses=ROUGHNESSES):
    u, roughness = np.meshgrid(np.unique(CORNERS.astype(dtype)), roughnesses.astype(dtype))
    return u.ravel(), roughness.ravel()


def assert_joined(kernel, reference, u, roughness):
    """Value and slope are continuous along a short path, in a relative measure against the smooth reference.

    The path crosses a switch in its middle. A jump would show there in the relative error, and so would a kink: over a
    path of 2e-4, relatively, one of 2e-11 of the slope is more than the tolerance.
    """
    values = kernel(u, roughness)
    ratio = [
        float(mpf(float(value)) / reference(*point) - 1) for value, *point in zip(values, u, roughness, strict=True)
    ]
    assert np.isfinite(ratio).all()
    assert np.abs(ratio).max() <= ULPS * np.finfo(float).eps
    middle = len(ratio) // 2
    left, right = np.mean(ratio[:middle]), np.mean(ratio[middle:])
    assert abs(left - right) <= 4 * np.finfo(float).eps
