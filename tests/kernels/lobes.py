"""The references of the four distributions of normals, and the arguments to try kernels at."""

import numpy as np
from mpmath import mpf

from tests.kernels import oracle
from xsec_sym.study.references.surfaces import exactly as exactly
from xsec_sym.study.references.surfaces import lambda_beckmann as lambda_beckmann
from xsec_sym.study.references.surfaces import lambda_ggx as lambda_ggx
from xsec_sym.study.references.surfaces import moment as moment
from xsec_sym.study.references.surfaces import ndf_beckmann as ndf_beckmann
from xsec_sym.study.references.surfaces import ndf_ellipsoidal as ndf_ellipsoidal
from xsec_sym.study.references.surfaces import ndf_ggx as ndf_ggx
from xsec_sym.study.references.surfaces import ndf_spherical_gaussian as ndf_spherical_gaussian
from xsec_sym.study.references.surfaces import sigma_beckmann as sigma_beckmann
from xsec_sym.study.references.surfaces import sigma_ellipsoidal as sigma_ellipsoidal
from xsec_sym.study.references.surfaces import sigma_ggx as sigma_ggx
from xsec_sym.study.references.surfaces import sigma_spherical_gaussian as sigma_spherical_gaussian

ULPS = 8


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
