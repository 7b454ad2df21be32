"""The spherical Gaussian's cross-section as a series: Fourier in the viewer's elevation, which is Chebyshev in u."""

from sympy import Integral, Sum, besseli, cos, cosh, exp, oo, pi, sin, sinh, symbols

from derivations.extensions.spherical_gaussian import ROUGHNESS, alpha, kappa, u, whole
from xsec_sym.exact import SigmaSphericalGaussian
from xsec_sym.proof import Source, integers, interval

project = Source("xsec", section="spherical Gaussian, series")

a, b, t, psi, z = symbols("a b t psi z", real=True)
y = symbols("y", real=True)
j = symbols("j", integer=True, nonnegative=True)
WIDTH = interval(z, 0, oo, open=True)
CIRCLE = (0, 2 * pi)

# --- the harmonics of a Bessel function of a cosine --------------------------------------------------------

even_harmonic = project.claim(
    "bessel-harmonics.even",
    "the even harmonics of I_0(2 z cos y)",
    left=Integral(besseli(0, 2 * z * cos(y)) * cos(2 * j * y), (y, *CIRCLE)),
    corrected=2 * pi * besseli(j, z) ** 2,
    where=[WIDTH, integers(j)],
)


@even_harmonic.proof
def two_equal_waves(step):
    """On the torus of y and t, 2 z cos(y) cos(t) is z cos(y + t) + z cos(y - t): the double integral falls apart."""
    n = step.right.atoms(besseli).pop().args[0]
    step.wave(besseli(0, 2 * z * cos(y)), t)
    both = exp(z * cos(a)) * cos(n * a) * exp(z * cos(b)) * cos(n * b)
    step.shear(a, b, both / (2 * pi))
    step.nest().bessel(n, z, 1, step.integrals[0].function.atoms(Integral).pop()).bessel(n, z, besseli(n, z))


odd_harmonic = project.claim(
    "bessel-harmonics.odd",
    "the odd harmonics of I_1(2 z cos y)",
    left=Integral(besseli(1, 2 * z * cos(y)) * cos((2 * j + 1) * y), (y, *CIRCLE)),
    corrected=2 * pi * besseli(j, z) * besseli(j + 1, z),
    where=[WIDTH, integers(j)],
)


@odd_harmonic.proof
def two_neighbours(step):
    n = min((f.args[0] for f in step.right.atoms(besseli)), key=lambda order: order.as_coeff_Add()[0])
    step.wave(besseli(1, 2 * z * cos(y)), t)
    pair = cos(n * a) * cos((n + 1) * b) + cos((n + 1) * a) * cos(n * b)
    step.shear(a, b, exp(z * cos(a)) * exp(z * cos(b)) * pair / (4 * pi))
    step.nest()
    around_a = step.integrals[0].function.atoms(Integral).pop()
    first, second = (exp(z * cos(a)) * cos(m * a) for m in (n, n + 1))
    step.linear(first * cos((n + 1) * b), second * cos(n * b), integral=around_a)
    step.bessel(n, z, 1, Integral(first, (a, *CIRCLE))).bessel(n + 1, z, 1, Integral(second, (a, *CIRCLE)))
    low, high = (exp(z * cos(b)) * cos(m * b) for m in (n, n + 1))
    step.linear(besseli(n, z) / 2 * high, besseli(n + 1, z) / 2 * low)
    step.bessel(n + 1, z, 1, Integral(high, (b, *CIRCLE))).bessel(n, z, 1, Integral(low, (b, *CIRCLE)))


# what the elevation psi adds to the slope of the cross-section, and its harmonics
rate = 2 * z * cos(y) * besseli(0, 2 * z * cos(y)) - besseli(1, 2 * z * cos(y))


def weight(m, z):
    return z * (besseli(m, z) ** 2 + besseli(m + 1, z) ** 2) - besseli(m, z) * besseli(m + 1, z)


coefficient = project.claim(
    "sg-harmonics",
    "the odd harmonics of the integrand of sg-integral",
    left=Integral(rate * cos((2 * j + 1) * y), (y, *CIRCLE)),
    corrected=2 * pi * weight(j, z),
    where=[WIDTH, integers(j)],
    reading="every even harmonic is 0, since the integrand changes its sign from y to pi - y",
)


@coefficient.proof
def cosine_shifts_the_harmonic(step):
    """cos(y) times an odd harmonic is the mean of the two even ones beside it."""
    n = min((f.args[0] for f in step.right.atoms(besseli)), key=lambda order: order.as_coeff_Add()[0])
    even, odd = (besseli(m, 2 * z * cos(y)) for m in (0, 1))
    step.linear(2 * z * even * cos(y) * cos((2 * n + 1) * y), -odd * cos((2 * n + 1) * y))
    step.lemma(odd_harmonic, {z: z, j: n})
    step.beats().linear(even * cos(2 * n * y) / 2, even * cos(2 * (n + 1) * y) / 2)
    step.lemma(even_harmonic, {z: z, j: n})
    step.rewrite(step.integrals[0], even_harmonic.left.subs(j, n + 1)).lemma(even_harmonic, {z: z, j: n + 1})


chebyshev = project.claim(
    "sg-chebyshev",
    "the cross-section as a Chebyshev series with explicit coefficients",
    left=SigmaSphericalGaussian(sin(psi), alpha),
    corrected=(
        cos(psi) * besseli(1, kappa * cos(psi))
        + sin(psi)
        * (
            cosh(kappa)
            - sinh(kappa) / kappa
            + 2 * Sum(weight(j, kappa / 2) * sin((2 * j + 1) * psi) / (2 * j + 1), (j, 0, oo))
        )
    )
    / (2 * sinh(kappa)),
    where=[interval(psi, -pi / 2, pi / 2), ROUGHNESS],
    reading="u = sin(psi), so that sin((2 j + 1) psi) = (-1)^j T_(2j+1)(u); the series converges like exp(-j^2 / z)",
)


@chebyshev.proof
def fourier_series_of_the_slope(step):
    for branch in step.cases(psi):
        if not branch.goal.piece.facts_about(psi):
            branch.lemma(whole, {u: 0})
            continue
        branch.lemma(whole, {u: sin(psi)}).substitute(y, sin(y), 0, psi)
        branch.rewrite(branch.integrals[0], Integral(rate.subs(z, kappa / 2), (y, 0, psi)))
        branch.harmonics(j, coefficient, {z: kappa / 2, j: j})


if __name__ == "__main__":
    project.tell()
