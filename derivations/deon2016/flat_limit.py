"""Section 2.1, the sentence after (7): the flat surface is the limit of every distribution of the paper.

For unit mass per steradian, |sigma(u) - max(0, u)| <= integral of D |omega - n| <= sqrt(2 m), by the Lipschitz bound of
the clamped cosine and by Cauchy-Schwarz, where m is the mean of 1 - cos(theta). For a height field, whose projected
area is 1, the mass is 1 + m and the bound (1 + m) sqrt(2 m). So it is enough that m goes to 0, and that is what each
claim here shows, by m itself or by something that exceeds it. The inequalities of this paragraph are an argument in
words; what the engine proves are the values.
"""

from sympy import Integral, Rational, atanh, coth, csch, exp, log, pi, sqrt, symbols

from xsec_sym.exact import beckmann, ellipsoidal, ggx, spherical_gaussian
from xsec_sym.proof import Source, interval

paper = Source("deon2016", section="2.1")

x = symbols("x", real=True)
alpha, b = symbols("alpha b", real=True)

kappa = 2 / alpha**2

gaussian = paper.claim(
    "claim.flat-limit.spherical-gaussian",
    "the spherical Gaussian closes on the pole: m = alpha^2 / 2 - (coth(2 / alpha^2) - 1), at most alpha^2 / 2",
    left=Integral(2 * pi * (1 - x) * spherical_gaussian(x, alpha), (x, -1, 1)),
    printed=alpha**2 / 2 - (coth(kappa) - 1),
    where=[interval(alpha, 0, 10, open="left")],
    reading="D per steradian, unit mass",
    statement=True,
)


@gaussian.proof
def moment_of_the_exponential(step):
    step.antiderivative(csch(kappa) / alpha**2 * exp(kappa * x) * ((1 - x) / kappa + 1 / kappa**2))


pole = paper.claim(
    "claim.flat-limit.kagiwada-kalaba",
    "the ellipsoidal distribution closes on the pole as b goes to 1: m = 2 / log((1 + b) / (1 - b)) - (1 - b) / b",
    left=Integral(2 * pi * (1 - x) * ellipsoidal(x, b), (x, -1, 1)),
    printed=2 / log((1 + b) / (1 - b)) - (1 - b) / b,
    where=[interval(b, 0, 1, open=True)],
    reading="D per steradian, unit mass",
    statement=True,
)


@pole.proof
def moment_of_the_pole(step):
    step.fact(1 - b * x, 1 - b, b * (1 - x), inside=(x, -1, 1))
    step.antiderivative((x + (1 - b) / b * log(1 - b * x)) / log((1 + b) / (1 - b)))


slopes = paper.claim(
    "claim.flat-limit.beckmann",
    "Beckmann flattens: the mean square slope, which is at least 2 m, is alpha^2",
    left=Integral(2 * pi * x * (1 / x**2 - 1) * beckmann(x, alpha), (x, 0, 1)),
    printed=alpha**2,
    where=[interval(alpha, 0, 10, open="left")],
    reading="D per steradian with unit projected area; 1 - x <= (1 - x^2) / (2 x) for 0 < x <= 1 gives 2 m <= alpha^2",
    statement=True,
)


@slopes.proof
def moment_of_the_slopes(step):
    square = 1 / x**2 - 1
    step.antiderivative((square + alpha**2) * exp(-square / alpha**2), flat="low")


roughness = paper.claim(
    "claim.flat-limit.ggx",
    "GGX flattens: m = alpha^2 artanh(h) / h with h^2 = 1 - alpha^2, which goes to 0 with alpha^2 log(1 / alpha)",
    left=Integral(2 * pi * (1 - x) * ggx(x, alpha), (x, 0, 1)),
    printed=alpha**2 * atanh(sqrt(1 - alpha**2)) / sqrt(1 - alpha**2),
    where=[interval(alpha, 0, 1, open=True)],
    reading="D per steradian with unit projected area, so that m is the surface's excess area; artanh(h) = "
    "log((1 + h) / alpha)",
    statement=True,
)


@roughness.proof
def moment_of_a_rational_function(step):
    h = sqrt(1 - alpha**2)
    step.fact(1 - h, alpha**2 / (1 + h))
    step.fact(1 - h * x, 1 - x, x * (1 - h), inside=(x, 0, 1))
    step.antiderivative(alpha**2 * (x / (1 - h**2 * x**2) + atanh(h * x) / h) - alpha**2 / (h**2 * (1 - h**2 * x**2)))


paper.whole(
    "claim.flat-limit",
    "the flat surface is the limit of every parametric distribution of the paper as its roughness goes to 0",
    [f"claim.flat-limit.{name}" for name in ("beckmann", "ggx", "kagiwada-kalaba", "spherical-gaussian")],
    left=Rational(0),
    reading="with m the mean of 1 - cos(theta), |sigma(u) - max(0, u)| <= (1 + m) sqrt(2 m) for every u, "
    "without 1 + m for unit mass: an argument in words (Lipschitz; Cauchy and Schwarz). That m goes to 0 is proved",
)

if __name__ == "__main__":
    paper.tell()
