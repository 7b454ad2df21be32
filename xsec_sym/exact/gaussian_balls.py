"""Fast enclosures of the spherical Gaussian's cross-section, for searches that want thousands of values.

With kappa = 2 / alpha^2, u = sin(psi) and s = cos(psi) (`xsec:sg-integral`),

    sigma = 1 / (2 sinh kappa) { s I1(kappa s) + u [cosh kappa - sinh kappa / kappa + F(u)] },
    F(u) = int_0^u kappa I0(kappa w) - I1(kappa w) / w dt,  w = sqrt(1 - t^2),
         = 2 sum_j (z (I_j^2 + I_{j+1}^2) - I_j I_{j+1}) sin((2j + 1) psi) / (2j + 1),  I_j = I_j(z),  z = kappa / 2.

All is scaled by exp(-kappa). The series is for moderate kappa; it has some 6 sqrt(kappa) terms. The integral is for
the rest. Neither decides any claim by itself: the engine compares them with the definition at points of its own.
"""

from __future__ import annotations

from functools import lru_cache

from flint import acb, arb, ctx

from xsec_sym.proof.scaled import scaled_bessel

RESTS_ON = ("xsec:sg-integral", "xsec:sg-chebyshev")
CHECKED_BY = ("xsec:sg-positive",)  # an integral that shares nothing with these
SERIES = 3_000  # up to this kappa the series is the faster one


@lru_cache(maxsize=256)
def _coefficients(middle: arb, radius: arb, bits: int) -> tuple[tuple[arb, ...], arb]:
    """The series' coefficients, scaled by exp(-2z), and a bound on the sum of all that are left out.

    I_{j+1} / I_j falls with j (Turan's inequality), so the tail is less than a geometric series.
    """
    z = arb(middle, radius)
    last = int(float((z * bits).sqrt().mid())) + bits // 3
    after, this = (z.bessel_i(last + k, scaled=True) for k in (1, 0))
    ratio = (after / this).upper()
    if not ratio < 1:
        raise ArithmeticError("the series of the spherical Gaussian does not end")
    rest = ((2 * z + 1) * this * this / ((2 * last + 1) * (1 - ratio * ratio))).upper()
    found = []
    for j in range(last - 1, -1, -1):
        # downwards all terms are positive, and nothing cancels
        after, this = this, after + 2 * (j + 1) / z * this
        found.append((z * (this * this + after * after) - this * after) / (2 * j + 1))
    return tuple(reversed(found)), arb(0).union(rest).union(-rest)


def _primitive(u: arb, kappa: arb) -> arb:
    """exp(-kappa) F(u)."""
    if kappa < SERIES:
        z = kappa / 2
        coefficients, rest = _coefficients(z.mid(), z.rad(), ctx.prec)
        psi, total = u.asin(), rest
        for j, c in enumerate(coefficients):
            total += c * ((2 * j + 1) * psi).sin()
        return 2 * total

    def integrand(t: acb, analytic: bool) -> acb:
        w = (1 - t * t).sqrt(analytic=analytic)
        if not w.real > 0.5:  # where Re w > 0 the scaled functions are I exp(-kappa w); elsewhere not holomorphic
            return acb(arb("nan"), arb("nan"))
        slow = kappa * scaled_bessel(0, kappa * w) - scaled_bessel(1, kappa * w) / w
        return slow * (-kappa * t * t / (1 + w)).exp()

    # beyond t = 1/2 the integrand, scaled, is below kappa exp(-kappa / 8)
    end = arb.min(abs(u), arb(0.5))
    beyond = (kappa * (-kappa / 8).exp()).upper()
    found = acb.integral(integrand, 0, end, rel_tol=arb(2) ** -50, abs_tol=arb(2) ** -60).real
    return (found + arb(0).union(beyond)) * u.sgn()


def value(u: arb, alpha: arb) -> arb:
    """The cross-section at a point given by narrow balls, -1 <= u <= 1.

    >>> from flint import arb
    >>> bool(abs(value(arb(1), arb("0.1")) - arb("0.995")) < 1e-10)
    True
    """
    kappa = 2 / (alpha * alpha)
    return _scaled(u, kappa) / (1 - (-2 * kappa).exp())


def _scaled(u: arb, kappa: arb) -> arb:
    s = (1 - u * u).sqrt() if not abs(u) >= 1 else arb(0)
    small = (-2 * kappa).exp()
    even = s * (kappa * s).bessel_i(1, scaled=True) * (kappa * (s - 1)).exp()
    return even + u * ((1 + small) / 2 - (1 - small) / (2 * kappa) + _primitive(u, kappa))


def majorant(u: acb, square: acb) -> arb:
    """A number that |sigma| nowhere exceeds on a box of complex u and alpha^2, on which alone it depends.

    About the viewer, sigma = kappa / (4 pi sinh kappa) times the integral over the hemisphere of cosine times
    exp(kappa (u cos t + s sin t cos phi)). The real part of the exponent is the product of a unit vector with one of
    length N, N^2 = Re(kappa u)^2 + Re(kappa s)^2 = Re(kappa)^2 + |kappa|^2 y, y = sinh^2(Im psi) = (|u|^2 + |s|^2 -
    1) / 2. The cosine is at most 1, so |sigma| <= |kappa / sinh kappa| sinh(N) / N, which grows with N.
    """
    kappa = 2 / square
    y = ((abs(u * u) + abs(1 - u * u) - 1) / 2).upper()
    y = y if y > 0 else arb(0)
    size, real = arb(abs(kappa).upper()), arb(kappa.real.abs_upper())
    low = arb(kappa.real.lower())
    if low > 8:
        # |sinh kappa| >= sinh(Re kappa), and sqrt(a^2 + b) <= a + b / (2 a)
        return size / low * (size * size * y / (2 * low)).exp() / (1 - (-2 * low).exp())
    n = (real * real + size * size * y).sqrt()
    growth = n.sinh() / n if n > 0 else arb(1)
    return abs(1 / (kappa * acb(0, 1)).sinc()).upper() * growth
