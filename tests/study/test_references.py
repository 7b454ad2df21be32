"""The references against the definition, by quadrature or by a root of the defining equation."""

import numpy as np
import pytest
from mpmath import mp, mpf

from xsec_sym.study.references import ring, squared_lobes, surfaces


@pytest.mark.parametrize("p", [0, 1, 2, 7, 20, 101, 200])
def test_powers(p):
    with mp.workdps(50):
        for u in (-0.9, 0.03, 0.4):
            exact = ring.cross_section_over_rings(lambda x: x**p, u)
            assert mp.almosteq(ring.sigma_power(u, p), exact, mpf("1e-40"), mpf("1e-40"))


def test_ring_next_to_the_edge():
    """Where the closed form cancels 80 digits; the definition is the area of the visible arc."""
    x = -0.6
    for u in (np.sqrt(1 - x * x) * (1 - 1e-15), np.nextafter(0.8, 0), 0.5):
        with mp.workdps(180):
            assert mp.almosteq(ring.sigma_dirac_ring(u, x), ring.ring_from_definition(u, x), mpf("1e-50"), 0)


@pytest.mark.parametrize("b", [0.3, 0.9])
def test_ellipsoid(b):
    for u in (-0.7, 0.2, 1.0):
        with mp.workdps(40):
            exact = ring.cross_section_over_rings(lambda x: surfaces.ndf_ellipsoidal.__wrapped__(x, mpf(b)), u)
            assert mp.almosteq(surfaces.sigma_ellipsoidal(u, b), exact, mpf("1e-25"))


def test_ends():
    """The sphere, the disk, and the horizon."""
    assert surfaces.sigma_ellipsoidal(0.5, 0.0) == 0.25
    assert abs(surfaces.sigma_ellipsoidal(0.5, 1e-9) - mpf(0.25)) < 1e-9
    assert [surfaces.sigma_ellipsoidal(u, 1.0) for u in (-0.5, 0.5)] == [0, 0.5]
    assert abs(surfaces.sigma_ellipsoidal(0.5, 1 - 1e-15) - mpf(0.5)) < 0.1
    assert surfaces.lambda_beckmann(0.0, 0.5) == surfaces.lambda_ggx(0.0, 0.5) == mp.inf


@pytest.mark.parametrize(("lambda_", "ndf"), [
    (surfaces.lambda_beckmann, surfaces.ndf_beckmann), (surfaces.lambda_ggx, surfaces.ndf_ggx)
])  # fmt: skip
def test_lambda(lambda_, ndf):
    """Lambda is what faces away, over the cosine."""
    u, alpha = 0.4, 0.7
    with mp.workdps(30):
        away = ring.cross_section_over_rings(lambda x: ndf.__wrapped__(x, mpf(alpha)), -u, (0,))
        assert mp.almosteq(lambda_(u, alpha), away / mpf(u), mpf("1e-15"))


def test_ellipsoidal_lobe():
    """t (x, y, z) lies on the ellipsoid."""
    x, y, z, alpha_x, alpha_y = 0.48, 0.64, 0.6, 0.3, 0.8
    with mp.workdps(40):
        t = squared_lobes.distance(x, y, z, alpha_x, alpha_y)
        a = mpf(alpha_y)
        point = (t * mpf(x) / mpf(alpha_x)) ** 2 + (t * mpf(y) / a) ** 2
        point += ((t * mpf(z) - (1 - a * a) / 2) / ((1 + a * a) / 2)) ** 2
        assert abs(point - 1) < mpf("1e-35") and squared_lobes.sel(x, y, z, alpha_x, alpha_y) == t * t
