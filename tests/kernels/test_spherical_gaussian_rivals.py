"""What renderers use for the irradiance of a spherical Gaussian, E = N sigma, N = 2 pi (1 - exp(-2 kappa))/kappa.

The published fits fail where they are known to: each is held against the kernel, whose own error is a few eps.
"""

import numpy as np
import pytest

from xsec_sym.kernels import sigma_spherical_gaussian
from xsec_sym.study.methods import spherical_gaussian as fits

SHARPNESS = 10 ** np.linspace(np.log10(0.05), 4, 60)[:, np.newaxis]
VIEWS = np.linspace(-1, 1, 401)


def normalisation(k):
    return -2 * np.pi * np.expm1(-2 * k) / k


RIVALS = {
    f.__name__: f
    for f in (
        fits.punctual,
        fits.inner_product,
        fits.hill,
        fits.meder_bruederlin,
        fits.tokuyoshi_2022,
        fits.tokuyoshi_2024,
    )
}


def errors(rival, sharpness=SHARPNESS, views=VIEWS):
    """The absolute error of sigma, and the factor by which it is off on the dark side."""
    with np.errstate(all="ignore"):
        found = rival(views, sharpness) / normalisation(sharpness)
        exact = sigma_spherical_gaussian(views, np.sqrt(2 / sharpness))
        dark = (exact > 1e-250) & (views < 0)
        ratio = np.where(dark, found / exact, 1.0)
    return np.abs(found - exact), np.maximum(ratio, 1 / np.maximum(ratio, 1e-300))


# The least and the largest worst absolute error over all views, and a range of kappa: transcribed right, and as bad.
KNOWN = [
    ("punctual", 0.05, 1.0, 0.2, 11.0),
    ("punctual", 5e3, 1e4, 1e-3, 1e-2),
    ("inner_product", 0.05, 1e4, 0.15, 0.2),
    ("hill", 0.05, 1.0, 1.0, 1e3),
    ("hill", 3.0, 1e4, 5e-3, 0.1),
    ("meder_bruederlin", 0.05, 1e4, 5e-3, 2e-2),
    ("tokuyoshi_2022", 0.05, 1e4, 3e-3, 5e-3),
    ("tokuyoshi_2024", 0.05, 1e4, 1e-3, 1.4e-3),
]


@pytest.mark.parametrize(("name", "low", "high", "least", "most"), KNOWN)
def test_a_rival_is_off_by_as_much_as_is_known(name, low, high, least, most):
    error, _ = errors(RIVALS[name], np.geomspace(low, high, 40)[:, np.newaxis])
    assert least < error.max() < most


@pytest.mark.parametrize("name", RIVALS)
def test_every_rival_is_off_by_a_factor_of_thousands_on_the_dark_side(name):
    """sigma(-u)/u is Smith's Lambda, so it is the relative error that counts there."""
    _, factor = errors(RIVALS[name], np.geomspace(2, 200, 40)[:, np.newaxis])
    assert factor.max() > 2000
