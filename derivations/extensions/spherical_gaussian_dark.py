"""The dark side of the spherical Gaussian, u = -v with v > 0, where the cross-section is Smith's masking times v.

It dies off like exp(-kappa (1 - s)), s being the sine of the view: the exponential of the distance to the nearest
normal that is still seen. What is left of it is a boundary layer in v sqrt(kappa).
"""

from sympy import Integral, Rational, besseli, cos, erfc, exp, pi, sinh, sqrt, symbols

from derivations.extensions.spherical_gaussian import alpha, kappa, positive, t, tau, u
from derivations.extensions.spherical_gaussian_bounds import WIDTH, z
from xsec_sym.exact import SigmaSphericalGaussian
from xsec_sym.proof import Source, interval
from xsec_sym.proof.magnitude import Magnitude

project = Source("xsec", section="spherical Gaussian, dark side")

v, y = symbols("v y", real=True)
s = sqrt(1 - v**2)
DARK = [interval(v, 0, 1, open=True), interval(alpha, 0, 2, open="left")]
scale = kappa / (2 * sinh(kappa))

excess = project.claim(
    "bessel-excess",
    "how much the exponential exceeds I_0",
    left=exp(z) - besseli(0, z),
    corrected=Integral(exp(z) - exp(z * cos(y)), (y, 0, pi)) / pi,
    where=[WIDTH],
)


@excess.proof
def mean_over_the_circle(step):
    step.swap().linear(exp(z), -exp(z * cos(y))).bessel(0, z, 1, Integral(exp(z * cos(y)), (y, 0, pi)))
    step.antiderivative(y)


below = project.inequality("bessel-below", "I_0 lies below the exponential", exp(z), besseli(0, z), where=[WIDTH])


@below.proof
def sum_of_positive_parts(step):
    step.fact(exp(z) - exp(z * cos(y)), inside=(y, 0, pi))
    step.fact(step.right, by=excess, mapping={z: z}).settle()


ceiling = scale * exp(kappa * s) * (1 - (1 + kappa * v) * exp(-kappa * v)) / (kappa * v) ** 2
integrand = t * exp(-kappa * v * t) * (exp(kappa * s) - besseli(0, kappa * s * tau))

room = project.claim(
    "sg-dark-gap",
    "how far the dark side lies below its bound",
    left=ceiling - SigmaSphericalGaussian(-v, alpha),
    corrected=scale * Integral(integrand, (t, 0, 1)),
    where=DARK,
    reduces=("xsec:sg-positive",),
)


@room.proof
def positive_integral(step):
    step.lemma(positive, {u: -v}).swap()
    step.linear(t * exp(-kappa * v * t) * exp(kappa * s), -t * exp(-kappa * v * t) * besseli(0, kappa * s * tau))
    step.antiderivative(
        -exp(-kappa * v * t) * (t / (kappa * v) + 1 / (kappa * v) ** 2), Integral(t * exp(-kappa * v * t), (t, 0, 1))
    )


dark = project.inequality(
    "sg-dark",
    "the dark side is at most exp(-kappa (1 - s)) / (kappa v^2 (1 - exp(-2 kappa)))",
    ceiling,
    SigmaSphericalGaussian(-v, alpha),
    where=DARK,
    reduces=("xsec:sg-positive",),
    reading="the bound proved is smaller still, by the factor 1 - (1 + kappa v) exp(-kappa v)",
)


@dark.proof
def exponential_above_bessel(step):
    """I_0(x) <= e^x, and e^(kappa s tau) <= e^(kappa s)."""
    rim = kappa * s
    shadow = exp(rim * tau) - besseli(0, rim * tau)
    step.fact(shadow, by=below, mapping={z: rim * tau}, inside=(t, 0, 1), back=True)
    step.fact(exp(rim) - besseli(0, rim * tau), exp(rim) - exp(rim * tau), shadow, inside=(t, 0, 1))
    step.fact(step.right, by=room).settle()


a = v * sqrt(kappa / (2 * s))
layer = exp(-kappa * (1 - s)) / (s * sqrt(2 * pi * kappa * s)) * (1 - sqrt(pi) * a * exp(a**2) * erfc(a))

boundary = project.inequality(
    "sg-dark-layer",
    "the boundary layer exp(-kappa (1 - s)) / sqrt(2 pi kappa s^3) (1 - sqrt(pi) a erfcx(a)) to within 1 / (2 kappa s)",
    1 / (2 * kappa * s),
    Magnitude(SigmaSphericalGaussian(-v, alpha) / layer - 1),
    where=[interval(v, Rational(1, 100), Rational(19, 20)), interval(alpha, Rational(1, 5), 1)],
    reduces=("xsec:sg-positive",),
    reading="a = v sqrt(kappa / (2 s)), from Laplace's method on sg-positive; no proof: the bound is tried at "
    "witnesses (the largest error found, relative to the layer, is 0.44 / (kappa s), for alpha = 1 and v towards 0)",
)

if __name__ == "__main__":
    project.tell()
