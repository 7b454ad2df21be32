"""References for the derivatives of the spherical Gaussian's cross-section: its definition, differentiated by rings.

Neither the kernel nor its tables go that way: theirs is a single integral of Bessel functions.
"""

from functools import cache

from mpmath import mp, mpf

DIGITS = 20  # with the digits below, 22 hold at the least, of which the tests need 17
GUARD = 25  # what the moments lose where the lobe is wide


def _over_rings(u, alpha, weight, lit):
    """Of rings x on the side turned away: N/(2 pi) exp(-kappa (1 - x)) times `weight`(x), and `lit` over -1 < x < -s.

    weight(x, root, turn): of a ring that is lit in part, by the angle `turn` to each side, where x = s cos(eta) and
    root = s sin(eta). Both get what may be wanted of the density.
    """
    v, kappa = abs(mpf(float(u))), 2 / mpf(float(alpha)) ** 2
    s = mp.sqrt((1 - v) * (1 + v))
    total = lit(v, s, kappa)

    def partly(eta):
        x, root = s * mp.cos(eta), s * mp.sin(eta)
        return mp.exp(-kappa * (1 - x)) * root * weight(v, s, kappa, x, root, mp.atan2(root, v * x))

    end = mp.pi
    if kappa * s > 4 * DIGITS:
        end = min(end, 2 * mp.asin(min(mpf(1), mp.sqrt(mpf(3) * DIGITS / (2 * kappa * s)))))
    edges = [end * mpf(k) / 8 for k in (0, 1, 2, 4, 8)]
    layer = v / s if s else mpf(1)
    edges = sorted({*edges, *(layer * k for k in (1, 8) if layer * k < end)})
    if s:
        # `quad` stops at an absolute error, so the integrand must not be small.
        unit = max(abs(partly(edge)) for edge in edges[1:-1])
        total += unit * mp.quad(lambda eta: partly(eta) / unit, edges)
    return total * kappa / (2 * mp.pi * -mp.expm1(-2 * kappa))


def _moment(order, low, high, kappa):
    """The integral of x^order exp(-kappa (1 - x))."""

    def antiderivative(x):
        series = {1: x - 1 / kappa, 2: x * x - 2 * x / kappa + 2 / kappa**2}[order]
        return mp.exp(-kappa * (1 - x)) * series / kappa

    return antiderivative(high) - antiderivative(low)


@cache
def by_u(u, alpha):
    """A ring lit in part: d/du int (u x + s cos(phi) sqrt(1 - x^2)) dphi = 2 (x turn - u/s^2 root)."""
    with mp.workdps(DIGITS + GUARD):
        kappa = 2 / mpf(float(alpha)) ** 2

        def weight(v, s, kappa, x, root, turn):
            return 2 * (x * turn + v * root / s**2)

        def lit(v, s, kappa):
            # What the rings that are lit in part come to as they shrink to the equator.
            limit = mp.pi * mp.exp(-kappa) if s == 0 else 0
            return limit + 2 * mp.pi * _moment(1, -mpf(1), -s, kappa)

        dark = _over_rings(u, alpha, weight, lit)
        return mp.coth(kappa) - 1 / kappa - dark if u > 0 else dark


@cache
def parts_by_alpha(u, alpha):
    """Of the side turned away, and of what is added facing; d/dkappa of the density is x - c times it."""
    with mp.workdps(DIGITS + GUARD):
        rough = mpf(float(alpha))
        kappa = 2 / rough**2
        c = mp.coth(kappa) - 1 / kappa

        def weight(v, s, kappa, x, root, turn):
            return 2 * (root - v * x * turn) * (x - c)

        def lit(v, s, kappa):
            return -2 * mp.pi * v * (_moment(2, -mpf(1), -s, kappa) - c * _moment(1, -mpf(1), -s, kappa))

        scale = -2 * kappa / rough
        fading = 1 / kappa**2 - 1 / mp.sinh(kappa) ** 2
        return scale * _over_rings(u, alpha, weight, lit), scale * fading * max(mpf(float(u)), mpf(0))


def by_alpha(u, alpha):
    return sum(parts_by_alpha(u, alpha))
