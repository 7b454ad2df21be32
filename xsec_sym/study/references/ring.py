"""The cross-section of a ring of normals, and of a distribution of them, from the definition."""

from functools import cache

from mpmath import mp, mpf

from xsec_sym.study.references.surfaces import exactly


def ring_from_definition(u, x):
    """The clamped integral over phi, as its visible arc, by quadrature of what is left there."""
    u, x = mpf(float(u)), mpf(float(x))
    a, b = u * x, mp.sqrt((1 - u) * (1 + u) * (1 - x) * (1 + x))
    arc = mp.acos(-a / b) if abs(a) < b else mp.pi * (a > 0)
    return 2 * mp.quad(lambda phi: a + b * mp.cos(phi), [0, arc])


def ring(u, x):
    """The closed form, for mass tests; `test_dirac_ring` shows that it agrees with the definition."""
    u, x = mpf(float(u)), mpf(float(x))
    a, d = u * x, 1 - u * u - x * x
    if d <= 0:
        return 2 * mp.pi * max(a, mpf(0))
    return 2 * (mp.sqrt(d) + a * (mp.pi / 2 + mp.atan(a / mp.sqrt(d))))


def cross_section_about_view(ndf, u):
    """sigma(u) with the polar axis turned into the direction of view, where nothing is clamped."""
    u = mpf(float(u))
    tilt = mp.sqrt(1 - u * u)

    def over_azimuth(mu):
        height = tilt * mp.sqrt(1 - mu * mu)
        return 2 * mu * mp.quad(lambda phi: ndf(u * mu + height * mp.cos(phi)), [0, mp.pi / 2, mp.pi])

    return mp.quad(over_azimuth, [0, 0.5, 1])


def cross_section_over_rings(ndf, u, cuts=()):
    """sigma(u) as the integral of ndf(x) ring(u, x), x = s sin(psi) where part of the ring is lit."""
    u = mpf(float(u))
    s = mp.sqrt(1 - u * u)
    cuts = [mpf(float(cut)) for cut in cuts]
    inside = [-mp.pi / 2, mpf(0), mp.pi / 2] + [mp.asin(cut / s) for cut in cuts if abs(cut) < s]

    def partly(psi):
        a, root = u * s * mp.sin(psi), s * mp.cos(psi)
        return ndf(s * mp.sin(psi)) * root * 2 * (root + a * (mp.pi / 2 + mp.atan(a / root)))

    total = mp.quad(partly, sorted(inside)) if s else mpf(0)
    low, high = sorted([mp.sign(u) * s, mp.sign(u)])
    lit = sorted([low, high] + [cut for cut in cuts if low < cut < high])
    return total + 2 * mp.pi * u * mp.quad(lambda x: x * ndf(x), lit)


sigma_dirac_ring = exactly(ring)


@exactly
def sigma_power(u, p):
    """2 pi u/(p + 2) for odd p; for even ones the moments of the ring in powers of u, A_n 2F1(-1/2, -n; 1/2; u^2)."""
    if p % 2:
        return 2 * mp.pi * u / (p + 2)
    return mp.pi * mp.polyval(in_powers(int(p) // 2), u * u)


@cache
def in_powers(n):
    """The coefficients of sigma/pi in u^2, highest first, at more digits than any of them cancel."""
    with mp.workdps(250):
        scale = mp.binomial(2 * n, n) / mpf(4) ** n / (n + 1)
        return [scale * mp.binomial(n, k) * (-1) ** k / (1 - 2 * k) for k in range(n, -1, -1)]
