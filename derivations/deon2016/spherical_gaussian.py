"""Section 2.5: the spherical Gaussian, its end points, its even and odd parts, its series.

Everything here is per steradian with unit mass, 2 pi times the integral of D over u being 1. The project's own forms of
the cross-section, on which the proofs lean, stand in `derivations/extensions/spherical_gaussian.py`.
"""

from sympy import (
    Function,
    Integral,
    Max,
    Rational,
    Sum,
    besseli,
    cosh,
    coth,
    csch,
    exp,
    factorial,
    gamma,
    hyper,
    legendre,
    oo,
    sinh,
    sqrt,
    symbols,
)
from sympy import pi as circle

from derivations.extensions.spherical_gaussian import (
    ROUGHNESS,
    SEEN,
    alpha,
    band,
    k,
    kappa,
    mean,
    positive,
    s,
    second,
    t,
    u,
)
from xsec_sym.exact import SigmaSphericalGaussian, SpreadSphericalGaussian, spherical_gaussian
from xsec_sym.exact.distributions import INCLINATION as x
from xsec_sym.proof import Source, integers

paper = Source("deon2016", section="2.5")

xi, y, z = symbols("xi y z", real=True)
j = symbols("j", integer=True, nonnegative=True)
sigma = SigmaSphericalGaussian
PER_STERADIAN = "D per steradian, unit mass; u_i is written u"

paper.definition("28", "the spherical Gaussian", left=Function("D_SG")(u), printed=spherical_gaussian(u, alpha),
                 reading="per steradian: its mass is a claim of its own")  # fmt: skip

mass = paper.claim(
    "28.norm",
    "the spherical Gaussian has unit mass on the sphere",
    left=Integral(2 * circle * spherical_gaussian(x, alpha), (x, -1, 1)),
    printed=1,
    where=[ROUGHNESS],
    reading="per steradian; the paper's (5), which is per unit cosine, does not hold for (28) without the 2 pi",
)


@mass.proof
def exponential(step):
    step.antiderivative(csch(kappa) * exp(kappa * x) / 2)


disk = paper.claim(
    "29",
    "a uniform disk of parallel rays",
    left=sigma(u, alpha),
    printed=csch(kappa)
    / (2 * alpha**2)
    * Integral(exp(2 * sqrt(1 - xi) * u / alpha**2) * hyper((), (1,), (xi - xi * u**2) / alpha**4), (xi, 0, 1)),
    where=SEEN,
    reduces=("xsec:sg-integral",),
    reading=PER_STERADIAN + "; the regularised 0F1 is 0F1 itself here, since Gamma(1) = 1",
)


@disk.proof
def area_of_the_disk(step):
    """t = sqrt(1 - xi) is the cosine at which a ray at the distance sqrt(xi) from the axis meets the sphere."""
    for branch, _ in poles(step):
        branch.lemma(positive, {u: branch.left.args[0]}).substitute(xi, sqrt(1 - xi), 1, 0)


def poles(step):
    """Inside, and at either pole."""
    for branch in step.cases(1 - u, u, 1, -1):
        if branch.is_empty:
            branch.vacuous()
        elif not branch.goal.piece.facts_about(u):
            yield branch, 1
        else:
            for where, below in enumerate(branch.cases(1 + u, u, -1)):
                if where == 1:
                    below.vacuous()
                else:
                    yield below, -1 if where == 2 else u


ENDS = "the print has the values of (30) and (32) the wrong way round"

behind = paper.claim(
    "30",
    "seen from behind",
    left=sigma(-1, alpha),
    printed=(alpha**2 - exp(kappa) * (alpha**2 - 2)) * csch(kappa) / 4,
    corrected=(alpha**2 - exp(-kappa) * (alpha**2 + 2)) * csch(kappa) / 4,
    edit="exchange the right sides of (30) and (32): exp(-2 / alpha^2) (alpha^2 + 2) belongs to sigma(-1)",
    where=[ROUGHNESS],
    reduces=("xsec:sg-integral",),
    reading=PER_STERADIAN,
)

equator = paper.claim(
    "31",
    "seen from the side",
    left=sigma(0, alpha),
    printed=csch(kappa) * besseli(1, kappa) / 2,
    where=[ROUGHNESS],
    reduces=("xsec:sg-positive",),
    reading=PER_STERADIAN,
)

front = paper.claim(
    "32",
    "seen from the front",
    left=sigma(1, alpha),
    printed=(alpha**2 - exp(-kappa) * (alpha**2 + 2)) * csch(kappa) / 4,
    corrected=(alpha**2 - exp(kappa) * (alpha**2 - 2)) * csch(kappa) / 4,
    edit="exchange the right sides of (30) and (32): exp(2 / alpha^2) (alpha^2 - 2) belongs to sigma(1)",
    where=[ROUGHNESS],
    reduces=("xsec:sg-integral",),
    reading=PER_STERADIAN,
)


@behind.proof
def exponential_fading(step):
    step.lemma(positive, {u: -1}).antiderivative(-exp(-kappa * t) * (t / kappa + 1 / kappa**2))


@equator.proof
def derivative_of_the_next_order(step):
    tau = sqrt(1 - t**2)
    step.lemma(positive, {u: 0}).antiderivative(-tau * besseli(1, kappa * tau) / kappa)


@front.proof
def exponential_growing(step):
    step.lemma(positive, {u: 1}).antiderivative(exp(kappa * t) * (t / kappa - 1 / kappa**2))


paper.claim(
    "33",
    "the distribution as an even and an odd part",
    left=spherical_gaussian(u, alpha),
    printed=csch(kappa) * cosh(kappa * u) / (2 * circle * alpha**2)
    + csch(kappa) * sinh(kappa * u) / (2 * circle * alpha**2),
    where=SEEN,
    reading=PER_STERADIAN,
).proof(lambda step: None)

odd = paper.claim(
    "35",
    "the odd part of the cross-section is linear",
    left=(sigma(u, alpha) - sigma(-u, alpha)) / 2,
    printed=(2 * coth(kappa) - alpha**2) * u / 4,
    where=SEEN,
    reduces=("xsec:sg-positive",),
    reading=PER_STERADIAN,
)


@odd.proof
def half_the_difference(step):
    step.lemma(mean)


printed_even = csch(kappa) * Sum(
    (-1) ** (j + 1) * alpha ** (-2 * j) * besseli(j + 1, kappa) * u ** (2 * j) / (2 * (2 * j - 1) * factorial(j)),
    (j, 0, oo),
)

even = paper.claim(
    "36",
    "the even part of the cross-section as a power series",
    left=(sigma(u, alpha) + sigma(-u, alpha)) / 2,
    printed=printed_even,
    where=SEEN,
    reduces=("xsec:sg-positive",),
    reading=PER_STERADIAN + "; 0^0 = 1 at u = 0; the signs alternate, so that for small alpha it is no way to compute",
)


@even.proof
def series_of_the_second_derivative(step):
    """kappa I_2(kappa tau) / tau^2 is entire in tau^2, and its derivatives at tau = 1 are Bessel functions at kappa."""
    derivative = (
        kappa**3 / (16 * sinh(kappa)) * (-(kappa**2) / 4) ** j * 2 / factorial(j + 2)
        * hyper((), (j + 3,), kappa**2 * (1 - z) / 4)
    )  # fmt: skip
    moment = u ** (2 * j) * (y ** (2 * j + 1) / (2 * j + 1) - y ** (2 * j + 2) / (2 * j + 2))
    for branch in step.cases(u):
        if not branch.goal.piece.facts_about(u):
            branch.lemma(equator).swap().peel()
            continue
        branch.lemma(second).substitute(y, u * y, 0, 1)
        branch.taylor(u**2 * (1 - y), u**2 * y**2, z, j, derivative, u**2 * moment)
        branch.swap().peel()


both = paper.claim(
    "34",
    "the cross-section is the sum of its odd and its even part",
    left=sigma(u, alpha),
    printed=odd.printed + printed_even,
    where=SEEN,
    reduces=("xsec:sg-positive",),
    reading=PER_STERADIAN + "; with (35) and (36) put in",
)


@both.proof
def add_the_parts(step):
    """Half of the sum and half of the difference of the views from u and from -u."""
    step.swap().lemma(even, back=True).lemma(odd, back=True)


component = paper.claim(
    "37",
    "the second Dirac component",
    left=SpreadSphericalGaussian(u, alpha),
    printed=csch(kappa) * (1 - u**2) * hyper((), (2,), (1 - u**2) / alpha**4) / (2 * alpha**2),
    where=SEEN,
    reduces=("deon2016:9", "deon2016:10", "deon2016:11", "deon2016:12"),
    points={x: [-s, s]},
    reading=PER_STERADIAN + "; the regularised 0F1 is 0F1 itself here, since Gamma(2) = 1",
)


@component.proof
def bessel_function_of_the_band(step):
    step.unfold("SpreadSphericalGaussian")
    for branch, here in poles(step):
        branch.linear(branch.integrals[0].function).lemma(band, {u: here, k: kappa})


# --- spherical harmonics -----------------------------------------------------------------------------------

l = symbols("l", integer=True, nonnegative=True)
moment_of_gaussian = Integral(spherical_gaussian(x, alpha) * legendre(l, x), (x, -1, 1))

paper.definition("39", "the moments of the spherical Gaussian", left=Function("c")(l), printed=moment_of_gaussian,
                 reading="per steradian, with no factor of 2 pi and no (2 l + 1) / 2")  # fmt: skip

even_moment = paper.claim(
    "38.even",
    "the moments of the clamped cosine with the even Legendre polynomials",
    left=Integral(Max(0, x) * legendre(2 * l + 2, x), (x, -1, 1)),
    printed=sqrt(circle) / (4 * gamma(Rational(1, 2) - l) * gamma(l + 3)),
    where=[integers(l)],
    reading="degree 2 l + 2; the print has one expression for every degree",
)


def over_the_half_range(step, degree, integral=None):
    """(1 - x^2) (P - x P') has the derivative (l - 1) (l + 2) x P, by Legendre's equation."""
    here, before = legendre(degree, x), legendre(degree - 1, x)
    slope = degree * (before - x * here)  # (1 - x^2) P'
    step.split(0, integral=integral)
    half = next(i for i in step.integrals if i.limits[0][1:] == (0, 1) and not i.has(exp))
    step.antiderivative(((1 - x**2) * here - x * slope) / ((degree - 1) * (degree + 2)), half)


@even_moment.proof
def even_degrees(step):
    (n,) = step.right.free_symbols
    over_the_half_range(step, 2 * n + 2)


harmonics = paper.claim(
    "38",
    "the cross-section in spherical harmonics",
    left=sigma(u, alpha),
    printed=Sum(
        circle ** Rational(3, 2) * (2 * l + 1) * moment_of_gaussian * legendre(l, u)
        / (4 * gamma(Rational(3, 2) - l / 2) * gamma(l / 2 + 2)),
        (l, 0, oo),
    ),
    where=SEEN,
    reduces=("xsec:sg-integral",),
    reading=PER_STERADIAN + "; 1 / Gamma is 0 at the poles, so that every odd term but the first vanishes",
)  # fmt: skip


@harmonics.proof
def funk_and_hecke(step):
    step.unfold().funk_hecke(u, l).parities().swap().parities().swap()
    for _ in range(2):
        for parity in (2, 3):
            step.peel(1, next(t for t in step.left.atoms(Sum) if t.has(legendre(parity - 2 + 2 * l, u))))
        step.swap()
    clamped = Max(0, x)
    step.lemma(even_moment, {l: l})
    over_the_half_range(step, 2 * l + 3, Integral(clamped * legendre(2 * l + 3, x), (x, -1, 1)))
    for degree in (0, 1):
        step.split(0, integral=Integral(clamped * x**degree, (x, -1, 1)))
        step.antiderivative(x ** (degree + 2) / (degree + 2), Integral(x ** (degree + 1), (x, 0, 1)))


if __name__ == "__main__":
    paper.tell()
