"""The half-space solver against Fock's integral for H functions, which shares none of its steps."""

import functools

import numpy as np
import pytest
from mpmath import mp, mpf

from xsec_sym.kernels import HalfSpace, lambert_sphere_coefficients
from xsec_sym.kernels.half_space import crowded_nodes

MU = np.array([0.0, 1e-20, 1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 1.0])
ALBEDOS = [1e-3, 0.3, 0.5, 0.899, 0.901, 0.99, 1 - 1e-6, 1 - 1e-12, 1.0]


@functools.cache
def fock_nodes():
    """Gauss-Legendre panels on [0, pi/4], crowded at 0: for theta, t = tan theta, and for pi/2 - theta."""
    x, weight = np.polynomial.legendre.leggauss(14)
    edges = np.concatenate([[0.0], np.pi / 4 * 0.25 ** np.arange(40)[::-1]])
    middle, half = (edges[1:] + edges[:-1]) / 2, (edges[1:] - edges[:-1]) / 2
    return (middle[:, None] + half[:, None] * x).ravel(), (half[:, None] * weight).ravel()


@functools.lru_cache(maxsize=64)
def log_kernel(psi, c):
    """log K(t) at the nodes, K = 1 - 2 integral of psi(mu)/(1 + mu^2 t^2), psi the coefficients of 1, mu^2, mu^4 as
    functions of c, in 300 digits; the powers' integrals J obey J_{k+1} = (1/(2 k + 1) - J_k)/t^2."""
    angles, _ = fock_nodes()
    with mp.workdps(300):
        coefficients = psi(mpf(c))

        def log_k(t):
            integral, total = mp.atan(t) / t, mpf(0)
            for k, coefficient in enumerate(coefficients):
                total += coefficient * integral
                integral = (mpf(1) / (2 * k + 1) - integral) / t**2
            return float(mp.log(1 - 2 * total))

        tangents = [mp.tan(mpf(float(angle))) for angle in angles]
        return np.array([log_k(t) for t in tangents]), np.array([log_k(1 / t) for t in tangents])


def fock_h(psi, c, mu):
    """`deon2021:22`: H(mu) = exp(-mu/pi integral over theta of log K/(cos^2 + mu^2 sin^2))."""
    angles, weight = fock_nodes()
    low, high = log_kernel(psi, c)
    m, sin, cos = mu[:, None] ** 2, np.sin(angles) ** 2, np.cos(angles) ** 2
    total = (low * weight / (cos + m * sin)).sum(1) + (high * weight / (sin + m * cos)).sum(1)
    return np.exp(-mu / np.pi * total)


def psi_isotropic(c):
    return (c / 2,)


def psi_0(c):
    return tuple(c / 384 * x for x in (mpf(207), c * (20 * c + 281) - 346, -15 * (c - 1) * (4 * c + 9)))


def psi_1(c):
    return tuple(-c / 192 * x for x in (mpf(64), -64 - 5 * (4 * c + 9), 5 * (4 * c + 9)))


def psi_2(c):
    return tuple(15 * c / 256 * x for x in (1, -2, 1))


def test_fock_integral_solves_the_nonlinear_equation():
    """1/H = 1 - mu integral of psi H/(mu + x): the reference has no other leg to stand on."""
    for psi, c in ((psi_isotropic, 0.5), (psi_0, 0.9), (psi_2, 1.0)):
        x, weight = crowded_nodes(60, 6)
        mu = np.array([1e-3, 0.1, 0.5, 1.0])
        characteristic = np.polynomial.polynomial.polyval(x * x, [float(a) for a in psi(mpf(c))])
        integral = (weight * characteristic * fock_h(psi, c, x) / (mu[:, None] + x)).sum(1)
        assert np.allclose(fock_h(psi, c, mu) * (1 - mu * integral), 1, rtol=0, atol=1e-13)


@pytest.mark.parametrize("c", ALBEDOS)
def test_isotropic(c):
    """The excess is H - 1. Found: 3e-13 at most, near c = 1."""
    half = HalfSpace([1.0], c)
    (p,), (x,) = half.mode(0).excess(MU)
    h = fock_h(psi_isotropic, c, MU)
    assert np.allclose(p + x, h, rtol=1e-12, atol=0)
    assert np.allclose(half.albedo_at(MU), 1 - np.sqrt(1 - c) * h, rtol=0, atol=1e-12)


@pytest.mark.parametrize("c", ALBEDOS)
def test_diffuse_light_that_is_lost_from_isotropic_scatterers(c):
    """2 sqrt(1 - c) times the first moment of H, relative, however close c is to 1."""
    x, weight = crowded_nodes(60, 6)
    lost = 2 * np.sqrt(1 - c) * np.sum(weight * x * fock_h(psi_isotropic, c, x))
    half = HalfSpace([1.0], c)
    assert half.absorbed() == pytest.approx(lost, rel=1e-12, abs=0)
    assert half.bond_albedo() == pytest.approx(1 - lost, rel=1e-12 if c > 0.1 else 1e-12 / c)


THREE = [1.0, -4 / 3, 5 / 16]


def three_terms(c):
    """The modes of the three-term half-space with single scattering, times pi (mu_i + mu_o) over H H: polynomials."""
    mu = MU[5:]
    half = HalfSpace(THREE, c)
    i, o = mu[:, None], mu
    root = np.sqrt((1 - i**2) * (1 - o**2))
    single = (
        c * (207 + 135 * i**2 * o**2 - 45 * (i**2 + o**2) + 256 * i * o) / 768,
        c * (64 + 45 * i * o) * root / 192,
        15 * c * (1 - i**2) * (1 - o**2) / 256,
    )
    for mode, psi in enumerate((psi_0, psi_1, psi_2)):
        h = fock_h(psi, c, mu)
        yield i, o, root, (half.fourier(mode, mu, mu) * np.pi * (i + o) + single[mode]) / (h[:, None] * h)


def test_both_cosines_at_the_horizon():
    """No warning, and the sign with which the modes grow on the way there."""
    half, dark, at, near = HalfSpace(THREE, 0.9), HalfSpace(THREE, 0.0), np.zeros(1), np.full(1, 1e-12)
    for mode in half.modes:
        edge = half.fourier(mode, at, np.array([0.0, 0.5]))[0]
        assert np.isinf(edge[0]) and np.sign(edge[0]) == np.sign(half.fourier(mode, near, near)[0, 0])
        assert np.isfinite(edge[1]) and dark.fourier(mode, at, at) == 0
    for light in (half.single, half.multiple):
        assert light(at, at, at) == np.inf and light(at, at + 0.5, at) < 1
    assert dark.single(at, at, at) == dark.multiple(at, at, at) == 0


@pytest.mark.parametrize("c", [0.3, 0.9, 0.999, 1.0])
def test_three_terms(c):
    """Modes 2, 1 and 0 of `deon2021:16` have 0, 1 and 4 constants besides their H functions: no more are fitted."""
    (i, o, root, mode_0), (*_, mode_1), (*_, mode_2) = three_terms(c)
    assert np.allclose(mode_2, 15 * c / 256 * (1 - i**2) * (1 - o**2), rtol=0, atol=2e-13)

    l_times = mode_1[:-1, :-1] * 3 / (c * root[:-1, :-1]) - 1 - 5 * (4 * c + 9) / 64 * (i * o)[:-1, :-1]
    l = l_times / (i + o)[:-1, :-1]
    assert np.ptp(l[3:, 3:]) < 2e-12

    known = 69 * c / 128 + 15 / 128 * (1 - c) * c * (4 * c / 3 + 3) * (i * o) ** 2
    shapes = np.stack([i + o, i * o, i * o * (i + o), i**2 + o**2])
    b, *_ = np.linalg.lstsq(shapes.reshape(4, -1).T, (2 * mode_0 - known).ravel(), rcond=None)
    assert np.allclose(np.tensordot(b, shapes, 1) + known, 2 * mode_0, rtol=0, atol=2e-12)
    # C = 2 F - c (20 c^2 + 281 c - 346)/384
    assert b[1] == pytest.approx(2 * b[3] - c * (20 * c**2 + 281 * c - 346) / 384, abs=1e-10)


@pytest.mark.parametrize("c", [0.5, 1.0])
def test_other_nodes_and_other_cuts(c):
    """High orders joined by Picard steps, against all of them in the matrices, and on other nodes."""
    mu = np.array([0.003, 0.05, 0.3, 0.7, 1.0])
    a = lambert_sphere_coefficients(120)
    joined, whole = HalfSpace(a, c, core=32, nodes=60), HalfSpace(a, c, core=120, nodes=180)
    for mode in (0, 1, 2, 4):
        scale = whole.fourier(0, mu, mu)
        assert np.all(abs(joined.fourier(mode, mu, mu) - whole.fourier(mode, mu, mu)) < 5e-12 * scale)


def test_conservation():
    mu = np.linspace(0, 1, 41)
    half = HalfSpace(lambert_sphere_coefficients(96), 1.0)
    assert np.allclose(half.albedo_at(mu), 1, rtol=0, atol=1e-12)
    assert half.absorbed() == 0 and half.bond_albedo() == pytest.approx(1, abs=1e-12)
    # forward-peaked scatterers too, of Henyey and Greenstein's g = 0.7
    order = np.arange(60)
    ahead = HalfSpace((2 * order + 1) * 0.7**order, 1.0, core=60, nodes=100)
    assert np.allclose(ahead.albedo_at(mu), 1, rtol=0, atol=1e-11)


def test_mode_by_mode_is_the_sum():
    a = lambert_sphere_coefficients(12)
    half = HalfSpace(a, 0.8, core=12, nodes=50)
    mu_i, mu_o, phi = np.array([0.1, 0.5, 0.9]), np.array([0.4, 0.5, 0.2]), np.array([0.3, 2.0, -1.0])
    by_mode = [half.fourier(m, mu_i, mu_o).diagonal() * np.cos(m * phi) for m in half.modes]
    assert len(by_mode) == 13
    assert np.allclose(half.multiple(mu_i, mu_o, phi), sum(by_mode), rtol=1e-13)
    assert np.allclose(half.multiple(mu_i, mu_o, phi), half.multiple(mu_o, mu_i, phi), rtol=1e-14, atol=0)


def test_refusals():
    for coefficients in ([], [2.0], [[1.0]], [1.0, np.nan]):
        with pytest.raises(ValueError, match="A_0 = 1"):
            HalfSpace(coefficients, 0.5)
    for albedo in (-0.1, 1.1, np.nan):
        with pytest.raises(ValueError, match="albedo"):
            HalfSpace([1.0], albedo)
