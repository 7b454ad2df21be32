"""Section 2.5.1: approximations of the spherical Gaussian's cross-section, and how near they are.

The section writes m for the roughness alpha, and mixes u and u_i; both are u here. The error of every form is bounded
over all u and a whole range of roughness, by interpolation with a proved remainder; what a chart does not cover, the
far side of the lobe and the limit of a flat surface, is settled by monotony and a line of argument, tried at points.

The cross-section grows with u, is positive, and its odd part is (coth(kappa) - 1 / kappa) u / 2 (`xsec:sg-odd`).
Where an approximant A has that odd part too, its error is even, A(u) - sigma(u) = A(-u) - sigma(-u), and beyond some
u = u_1 > 0 it is at most the one at u_1 plus the largest |A(-u)| there.
"""

from dataclasses import replace

from sympy import (
    Abs,
    Integer,
    Integral,
    Rational,
    besseli,
    coth,
    csch,
    diff,
    erf,
    erfc,
    exp,
    gamma,
    hyper,
    legendre,
    oo,
    pi,
    sqrt,
    symbols,
    tanh,
)

from xsec_sym.exact import SigmaSphericalGaussian, spherical_gaussian
from xsec_sym.exact.distributions import INCLINATION as x
from xsec_sym.proof import Source, interval
from xsec_sym.proof.accuracy import Accuracy, Chart, Limit, Tail
from xsec_sym.proof.scaled import ScaledBesselI

paper = Source("deon2016", section="2.5.1")

u, m = symbols("u m", real=True)
ANY = interval(u, -1, 1)
sigma = SigmaSphericalGaussian(u, m)
s = sqrt(1 - u**2)

READING = "per steradian, unit mass; m is the roughness alpha of (28)"
EVEN = "the error is even in u: the form's odd part is that of the cross-section (xsec:sg-odd)"
FALLING = "sigma(-u) falls with u, so that beyond the chart the error is at most the one on its edge plus |A(-u)|"
FLAT = (
    "as m goes to 0: the error at u and -u is at most the larger of sigma(-u) and A(-u), u >= 0, and both fall from "
    "about m / (2 sqrt(pi)) at u = 0, sigma(0) = I_1(kappa) / (2 sinh(kappa)) with I_1(kappa) < exp(kappa) / "
    "sqrt(2 pi kappa)"
)

# --- small roughness: tan(theta) = m v, so that everything varies with v at the same rate for all m ------

v, r = symbols("v r", positive=True)
k = 2 / r**2
cosine = 1 / sqrt(1 + r**2 * v**2)  # s
seen = r * v * cosine  # u
beckmann_seen = (seen * (1 + erf(v)) + r * cosine * exp(-(v**2)) / sqrt(pi)) / 2
flat = r / (2 * sqrt(pi)) * (1 + r**2)


def beckmann(sign):
    """(22), which prints the exponent with the wrong sign."""
    slope = u / (m * s)
    return (u * (1 + erf(slope)) + m * s * exp(sign * u**2 / (m**2 * (1 - u**2))) / sqrt(pi)) / 2


paper.accuracy(
    "claim.beckmann-0.001",
    "the Beckmann cross-section is within 0.001 for m < 0.044",
    left=sigma,
    printed=beckmann(-1),
    where=[ANY, interval(m, 0, Rational(44, 1000), open=True)],
    reading=READING + "; (22) with its exponent mended, the paper refers to (20)",
    accuracy=Accuracy(
        within=Rational(1, 1000),
        chart=Chart(v, r, seen, r, m, (Integer(-4), Integer(4)), beckmann_seen),
        start=Rational(3, 1000),
        end=Rational(44, 1000),
        tail=Tail(
            Integer(-4),
            r * exp(-16) / (2 * sqrt(pi)) + r**2 / 2,
            "for u > 0 the error at u is the one at -u plus (1 - coth(kappa) + m^2 / 2) u; " + FALLING,
        ),
        limit=Limit(Rational(3, 1000), flat + r**2 / 2, FLAT + ", plus m^2 / 2 for the odd part"),
    ),
)


def corrected_odd(sign):
    """The odd part of (22) exchanged for that of the spherical Gaussian."""
    odd = tanh(1 / m**2) * (u - m**2 * Abs(u)) + (-(m**2) - 2) * u + u * coth(1 / m**2)
    slope = u / (m * s)
    return odd / 4 + (u * erf(slope) + m * s * exp(sign * u**2 / (m**2 * (1 - u**2))) / sqrt(pi) + u) / 2


near_flat = Accuracy(
    within=Rational(1, 1000),
    chart=Chart(
        v, r, seen, r, m, (Integer(0), Integer(4)),
        beckmann_seen + seen * (tanh(k / 2) * (1 - r**2) - r**2 - 2 + coth(k / 2)) / 4,
        even=EVEN,
    ),
    start=Rational(3, 1000),
    end=Rational(1, 4),
    tail=Tail(Integer(4), r * exp(-16) / (2 * sqrt(pi)) + (1 + r**2) * exp(-k), FALLING),
    limit=Limit(Rational(3, 1000), flat, FLAT),
)  # fmt: skip
BELOW_QUARTER = [ANY, interval(m, 0, Rational(1, 4), open=True)]

paper.approximation(
    "40",
    "Beckmann's cross-section with the odd part of the spherical Gaussian's",
    left=sigma,
    printed=corrected_odd(1),
    corrected=corrected_odd(-1),
    edit="the exponent is negative, as in (22): exp(-u^2 / (m^2 (1 - u^2)))",
    where=BELOW_QUARTER,
    reading=READING,
    accuracy=replace(near_flat, by="deon2016:claim.40-accuracy"),
)

paper.accuracy(
    "claim.40-accuracy",
    "(40) is within 0.001 for m < 0.25",
    left=sigma,
    printed=corrected_odd(-1),
    where=BELOW_QUARTER,
    reading=READING + "; (40) with its exponent mended",
    accuracy=near_flat,
)

# --- an error function fitted at the equator ------------------------------------------------------------

kappa = 2 / m**2
mean_cosine = 2 * coth(kappa) - m**2


def f(b):
    """0F1(; b; 1 / m^4)."""
    return hyper((), (b,), 1 / m**4)


def regular(b, x):
    return hyper((), (b,), x) / gamma(b)


def cubic(first, second):
    """(42) from its first bracket and the second one, cubed."""
    bracket = m**12 * first * (m**2 - 2 * coth(kappa)) ** 2 - pi * second**3 * csch(kappa) ** 2
    return sqrt(pi) * u**3 * csch(kappa) * bracket / (3 * m**18 * (m**2 - 2 * coth(kappa)) ** 3)


second = m**4 * f(2) + f(3)
linear = sqrt(pi) * second * u * csch(kappa) / (m**8 - 2 * m**6 * coth(kappa))

# the slope and the third derivative at u = 0 of sigma_even - sigma_2 = mean_cosine u erf(a_1 u + a_3 u^3 + ...) / 4
bessel = [besseli(n, kappa) for n in range(3)]
a_1 = sqrt(pi) * csch(kappa) * (kappa * bessel[0] - bessel[1]) / mean_cosine
a_3 = a_1**3 / 3 - sqrt(pi) * csch(kappa) * kappa * (kappa * bessel[1] - bessel[2]) / (6 * mean_cosine)
PLAUSIBLE = interval(m, 0, oo, open=True)

coefficient_a = paper.claim(
    "42",
    "A is the cubic term of the fit",
    left=a_3 * u**3,
    printed=cubic(regular(2, 1 / m**4) - regular(3, 1 / m**4), second),
    corrected=cubic(2 * regular(2, 1 / m**4) - regular(3, 1 / m**4), second),
    edit="the first bracket begins with 2 0F1~(; 2; 1/m^4), where 2F1(; 2; 1/m^4) is printed, and the factor after it "
    "is squared outside of the bracket, which the print does not close",
    where=[ANY, PLAUSIBLE],
    reading="2F1 without its upper parameters means nothing and is read as 0F1~ (the same as 0F1 for b = 2), so that "
    "the 2 must be a factor; u_i is u. The left side is the term in u^3 of "
    "erf^-1(4 (sigma_even - sigma_2) / ((2 coth(kappa) - m^2) u)). Measured at m = 0.299, the error of (41) is 9.2e-5 "
    "with this A, 8.9e-3 without the factor 2, 1.0e-3 with 0F1 not regularised, and 1.0e-3 without any A",
)

coefficient_b = paper.claim(
    "43",
    "-B is the linear term of the fit",
    left=-a_1 * u,
    printed=linear,
    where=[ANY, PLAUSIBLE],
    reading="with 0F1 not regularised, as printed; u_i is u",
)


@coefficient_a.proof
@coefficient_b.proof
def bessel_functions_in_disguise(step):
    """0F1(; n; 1 / m^4) is a Bessel function of order n - 1 at kappa, and kappa I_0 - I_1 = kappa I_2 + I_1."""
    step.close()


def fitted(last):
    """(41) with (42) and (43) put in."""
    argument = cubic(2 * regular(2, 1 / m**4) - regular(3, 1 / m**4), second) - linear
    side = (u**2 - 1) * csch(kappa) * regular(2, (1 - u**2) / m**4) / (2 * m**2)
    return mean_cosine * (u * erf(argument) + last) / 4 - side


E = exp(-2 * k)
near = (2 * (1 + E) / (1 - E) - r**2) / 4
scale = 2 * sqrt(pi) / (1 - E) / (4 * near)
b_1 = scale * (k * ScaledBesselI(0, k) - ScaledBesselI(1, k))
b_3 = b_1**3 / 3 - scale * k * (k * ScaledBesselI(1, k) - ScaledBesselI(2, k)) / 6
sweep = cosine * ScaledBesselI(1, k * cosine) * exp(-2 * v**2 * cosine / (1 + 1 / cosine)) / (1 - E)
c_1, c_3 = symbols("c_1 c_3", real=True)
fit = near * seen * (erf(c_1 * seen + c_3 * seen**3) + 1) + sweep
EDGE = Integer(4)

fine = Accuracy(
    within=Rational(1, 10000),
    chart=Chart(v, r, seen, r, m, (Integer(0), EDGE), fit, ((c_1, b_1), (c_3, b_3)), EVEN),
    start=Rational(35, 100000),
    end=Rational(3, 10),
    tail=Tail(
        EDGE,
        near * erfc((b_1 * seen + b_3 * seen**3).subs(v, EDGE)) + sweep.subs(v, EDGE),
        FALLING + ", of which both terms fall, since A - B grows with u",
    ),
    limit=Limit(Rational(35, 100000), flat, FLAT),
)
BELOW_THREE_TENTHS = [ANY, interval(m, 0, Rational(3, 10), open=True)]

paper.approximation(
    "41",
    "the second component exactly, and an error function for the rest",
    left=sigma,
    printed=fitted(1),
    corrected=fitted(u),
    edit="u erf(A - B) + u in the first bracket, where + 1 is printed",
    where=BELOW_THREE_TENTHS,
    reading=READING + "; u and u_i are the same, A is (42) mended, B is (43)",
    accuracy=replace(fine, by="deon2016:claim.41-accuracy"),
)

paper.accuracy(
    "claim.41-accuracy",
    "(41) is within 0.0001 for m < 0.3",
    left=sigma,
    printed=fitted(u),
    where=BELOW_THREE_TENTHS,
    reading=READING + "; (41) and (42) mended",
    accuracy=fine,
)

# --- spherical harmonics --------------------------------------------------------------------------------

w, q = symbols("w q", positive=True)  # q is kappa, which is 0 for the isotropic distribution


def harmonics(terms, moment):
    """(38) up to a number of terms, with ``moment(l)`` for c_l."""
    found = Integer(0)
    for l in range(terms):
        factor = pi ** Rational(3, 2) * (2 * l + 1) / (4 * gamma(Rational(l, 2) + 2))
        if l % 2 == 0 or l < 3:  # 1 / Gamma(3/2 - l/2) is 0 for all other odd l
            found += factor / gamma(Rational(3, 2) - Rational(l, 2)) * moment(l) * legendre(l, u)
    return found


def moment(l, c=kappa):
    """c_l of (39): the mean of P_l, over 2 pi as D is per steradian."""
    return besseli(l + Rational(1, 2), c) / (2 * pi * besseli(Rational(1, 2), c))


def ratio(l):
    """I_{l+1/2}(q) / I_{1/2}(q) by the recurrence of the Bessel functions, a polynomial in 1/q and coth(q)."""
    before, here = Integer(1), coth(q) - 1 / q
    for n in range(l):
        before, here = here, (before - (2 * n + 3) / q * here).expand()
    return before


three = (
    -u * (m**2 - 2 * coth(kappa)) / 4
    + Rational(5, 128) * (3 * u**2 - 1) * (3 * m**4 - 6 * m**2 * coth(kappa) + 4)
    + Rational(1, 4)
)


def mean_of_legendre(l):
    """c_l by its definition, (39)."""
    return Integral(spherical_gaussian(x, m) * legendre(l, x), (x, -1, 1))


up_to_two = paper.claim(
    "44",
    "the spherical harmonics expansion (38) up to l = 2",
    left=harmonics(3, mean_of_legendre),
    printed=three,
    where=[ANY, interval(m, 0, oo, open=True)],
    reading="the moments c_l from their definition (39)",
)


@up_to_two.proof
def exponential_moments(step):
    """Each polynomial times exp(kappa x) has such a product as its primitive: p / kappa - p' / kappa^2 + ..."""
    density = csch(kappa) / (2 * pi * m**2)
    for l in range(3):
        p = legendre(l, x)
        primitive = density * exp(kappa * x) * sum((-1) ** i * diff(p, x, i) / kappa ** (i + 1) for i in range(3))
        step.antiderivative(primitive, mean_of_legendre(l))


isotropic = Accuracy(
    within=Rational(1, 1000),
    chart=Chart(w, q, w, sqrt(2 / q), 2 / m**2, (Integer(0), Integer(1)),
                three.subs({coth(kappa): coth(q)}).subs({m: sqrt(2 / q), u: w}), even=EVEN, removable=0.0),
    start=Integer(0),
    end=Integer(1),
)  # fmt: skip

paper.accuracy(
    "claim.44-accuracy",
    "(44) is within 0.001 for m > 1",
    left=sigma,
    printed=three,
    where=[ANY, interval(m, 1, oo, open=True)],
    reading=READING,
    accuracy=isotropic,
)

twelve = harmonics(12, moment)

paper.accuracy(
    "claim.twelve-terms",
    "(38) up to 12 terms serves between the forms for low and for high roughness: within 0.001 for 0.3 <= m <= 1",
    left=sigma,
    printed=twelve,
    where=[ANY, interval(m, Rational(3, 10), 1)],
    reading=READING + "; 12 terms are l = 0 ... 11, of which 7 are not 0; the tolerance is that of the other forms, as "
    "the paper states none. Measured, not bounded: (41) is nearer below m = 0.34 or so and this form above, (44) "
    "nowhere; its error falls to 1e-4 near m = 0.36; with 12 terms that are not 0 it would be 1.4e-7 at m = 0.3",
    accuracy=Accuracy(
        within=Rational(1, 1000),
        chart=Chart(w, q, w, sqrt(2 / q), 2 / m**2, (Integer(0), Integer(1)),
                    harmonics(12, lambda l: ratio(l) / (2 * pi)).subs(u, w), even=EVEN),
        start=Integer(2),
        end=Rational(3, 10),
    ),
)  # fmt: skip

if __name__ == "__main__":
    paper.tell()
