"""Section 3.1: the characteristic functions of the three pseudo-problems, and K of (23) in closed form, (24)-(26).

The characteristic functions follow from the Legendre moments of a solution that decays with depth. They are also tried
against the determinant of the transport operator (`xsec:lambert-sphere.determinant`), which knows no recurrence.
"""

from sympy import I, Integral, Matrix, Rational, Symbol, atan, legendre, oo, sqrt, symbols

from xsec_sym.proof import Source, interval

paper = Source("deon2021", section="3.1")

mu, t, s, c = symbols("mu t s c", real=True)
ALBEDO = interval(c, 0, 1)
BEYOND = interval(t, 0, oo, open=True)

FLIGHT = (1, -Rational(4, 3), Rational(5, 16))  # A_0, A_1, A_2 of (4)
THREE_TERMS = "for the three-term phase function of (5)"


# --- the functions Psi ----------------------------------------------------------------------------------


def along(l, m):
    """The associated Legendre function of order m over sin^m, without the sign that some authors give it."""
    return legendre(l, mu).diff(mu, m) if m else legendre(l, mu)


def share(l, m):
    """(l - m)! / (l + m)!, for l up to 2."""
    quotient = Rational(1)
    for k in range(l - m + 1, l + m + 1):
        quotient /= k
    return quotient


def moments(m):
    """The Legendre moments of a solution that decays like exp(-x / mu), the first of them 1, from order m to order 2.

    They are the transport equation's own moments: (l + 1 - m) g_(l+1) = (2 l + 1 - c A_l) mu g_l - (l + m) g_(l-1).
    """
    found = [Rational(1)]
    for l in range(m, 2):
        before = found[-2] if len(found) > 1 else 0
        found.append(((2 * l + 1 - c * FLIGHT[l]) * mu * found[-1] - (l + m) * before) / (l + 1 - m))
    return found


def normal(m):
    """Of the first moment of order m: the solution's own density is along(m, m) = (2 m - 1)!!"""
    return along(m, m)


def from_moments(m):
    """c / 2 times the phase function's terms of order m, each with the moment that it scatters."""
    return (
        c / 2 * (1 - mu**2) ** m
        * sum(FLIGHT[l] * share(l, m) * along(l, m) * g * normal(m) for l, g in enumerate(moments(m), start=m))
    )  # fmt: skip


PSI = (
    c / 384 * (-15 * (c - 1) * (4 * c + 9) * mu**4 + (c * (20 * c + 281) - 346) * mu**2 + 207),
    -c / 192 * (mu**2 - 1) * (5 * (4 * c + 9) * mu**2 - 64),
    Rational(15, 256) * c * (mu**2 - 1) ** 2,
)

for order, printed in enumerate(PSI):
    paper.claim(
        f"Psi.{order}",
        f"the characteristic function of order {order}",
        left=from_moments(order),
        printed=printed,
        where=[interval(mu, 0, 1), ALBEDO],
        reading=THREE_TERMS,
    ).proof(lambda step: None)


# --- K --------------------------------------------------------------------------------------------------


def symbol_of(order):
    return Symbol(f"K^({order})", real=True)


paper.definition(
    "23",
    "the function K of the Fock-Chandrasekhar equation",
    left=Symbol("K", real=True),
    printed=1 - Integral((1 / (s - I * t) + 1 / (s + I * t)) * Symbol("Psi", real=True) / s, (s, 1, oo)),
    reading="Psi at 1/s; the two fractions together are 2 s / (s^2 + t^2)",
)

K = (
    1 - c * (((256 * c - 301) * t**3 + ((346 - c * (20 * c + 281)) * t**2 - 15 * (c - 1) * (4 * c + 9) + 207 * t**4)
    * atan(t) + 15 * (c - 1) * (4 * c + 9) * t) / (192 * t**5)),
    1 - c * ((40 * c + 282) * t**3 - 3 * (t**2 + 1) * (20 * c + 64 * t**2 + 45) * atan(t) + 15 * (4 * c + 9) * t)
    / (288 * t**5),
    1 - 5 * c * (3 * (t**2 + 1) ** 2 * atan(t) - t * (5 * t**2 + 3)) / (128 * t**5),
)  # fmt: skip


def primitive(power):
    """An antiderivative of mu^power / (1 + t^2 mu^2), for an even power."""
    if power == 0:
        return atan(t * mu) / t
    return (mu ** (power - 1) / (power - 1) - primitive(power - 2)) / t**2


def elementary(psi):
    """An antiderivative of psi / (1 + t^2 mu^2), for an even polynomial."""
    return sum(k * primitive(n) for (n,), k in psi.expand().as_poly(mu).terms())


for order, (psi, printed) in enumerate(zip(PSI, K, strict=True)):
    closed = paper.claim(
        str(24 + order),
        f"K of order {order}",
        left=1 - Integral(2 * s / (s**2 + t**2) * psi.subs(mu, 1 / s) / s, (s, 1, oo)),
        printed=printed,
        where=[BEYOND, ALBEDO],
        reading="(23) with its two fractions added; " + THREE_TERMS,
    )

    @closed.proof
    def arctangents(step, psi=psi):
        """With s = 1/mu the integrand is rational in mu^2."""
        step.substitute(mu, 1 / mu, 1, 0)
        step.antiderivative(2 * elementary(psi))


at_infinity = paper.claim(
    "H0inf",
    "the H function of order 0 at infinity",
    left=1 / sqrt(1 - Integral(2 * PSI[0], (mu, 0, 1))),
    printed=12 / sqrt((c - 16) * (c - 1) * (4 * c + 9)),
    where=[interval(c, 0, 1, open="right")],
    reading="1 / sqrt(K(0)), with K(0) from (23); " + THREE_TERMS,
)


@at_infinity.proof
def at_rest(step):
    step.fact((c - 16) * (c - 1) * (4 * c + 9), (16 - c) * (1 - c) * (4 * c + 9))
    step.antiderivative(2 * PSI[0].expand().integrate(mu))


# --- K without Psi --------------------------------------------------------------------------------------

project = Source("xsec", section="Lambertian spheres")


def transformed(power):
    """The moment of mu^power over the sphere of 1 / (1 + i t mu), up to the factors i that the determinant cancels."""
    even = power + power % 2
    return t ** (power % 2) * Integral(mu**even / (1 + t**2 * mu**2), (mu, -1, 1))


def operator(m):
    """1 less the transport operator of order m, Fourier transformed, between Legendre functions up to order 2.

    A similarity by powers of i makes it real: the entry above the diagonal gets + t, the one below - t.
    """

    def entry(l, k):
        weight = (along(l, m) * along(k, m) * (1 - mu**2) ** m).expand().as_poly(mu)
        seen = sum(value * transformed(n) for (n,), value in weight.terms())
        sign = -1 if k < l and (l - k) % 2 else 1
        turned = (-1) ** ((k - l) // 2) if (k - l) % 2 == 0 else sign
        return (1 if l == k else 0) - turned * c * FLIGHT[k] / 2 * share(k, m) * seen

    return Matrix(3 - m, 3 - m, lambda i, j: entry(i + m, j + m))


for order, closed in enumerate(K):
    whole = project.claim(
        f"lambert-sphere.determinant.{order}",
        f"K of order {order} is the determinant of the transport operator",
        left=operator(order).det(method="berkowitz"),
        corrected=closed,
        where=[BEYOND, ALBEDO],
        reading="the steady transport equation in a medium without borders, in mode t along the depth and in the "
        f"Fourier mode {order} of the azimuth; " + THREE_TERMS,
    )

    @whole.proof
    def moments_of_the_flight(step):
        for integral in list(step.integrals):
            ((power, _),) = [(m[0], v) for m, v in integral.function.as_numer_denom()[0].as_poly(mu).terms()]
            step.antiderivative(primitive(power), integral=integral)


if __name__ == "__main__":
    paper.tell()
    project.tell()
