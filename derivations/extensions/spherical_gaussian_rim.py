"""The spherical Gaussian near the rim of the dark side, u = -v with v near 1, and how the rim goes over into the layer.

At the rim the positive integral of sg-positive is best taken over the whole half-line: beyond t = 1, where I_0 of an
imaginary argument is J_0, it adds an elementary term, and what is then left is smooth in kappa s and in 1 / kappa.
"""

from sympy import Integral, Piecewise, Rational, besseli, besselj, erfc, exp, hyper, oo, pi, sinh, sqrt, symbols

from derivations.extensions.spherical_gaussian import ROUGHNESS, alpha, entire, k, kappa, rest, t, tau, u, whole
from xsec_sym.exact import SigmaBeckmann, SigmaSphericalGaussian
from xsec_sym.proof import Source, interval

project = Source("xsec", section="spherical Gaussian, rim")

v, w, x = symbols("v w x", real=True)
s = sqrt(1 - v**2)

# --- the half-line -----------------------------------------------------------------------------------------

NEAR = interval(v, Rational(1, 2), 1)
beyond = sqrt(t**2 - 1)

surplus = project.claim(
    "sg-rim.surplus",
    "what the integral of sg-positive adds beyond its end is elementary",
    left=Integral(t * exp(k * (1 - v * t)) * besselj(0, k * s * beyond), (t, 1, oo)),
    corrected=v * (1 + 1 / k) / k,
    where=[NEAR, interval(k, Rational(1, 8), 32)],
    reading="both sides times exp(k), so that neither is small; no proof: tried at witnesses",
)

half_line = project.claim(
    "sg-rim",
    "the integral of sg-positive over the half-line, by the cross-section's dark side",
    left=Integral(
        t
        * exp(-kappa * v * t)
        * Piecewise((besseli(0, kappa * s * tau), t < 1), (besselj(0, kappa * s * beyond), True)),
        (t, 0, oo),
    ),
    corrected=2 * sinh(kappa) / kappa * SigmaSphericalGaussian(-v, alpha) + v * exp(-kappa) * (1 + 1 / kappa) / kappa,
    where=[NEAR, interval(alpha, Rational(1, 4), 4)],
    reduces=("xsec:sg-positive",),
    reading="per steradian, unit mass; J_0 is I_0 of an imaginary argument, so that the integrand is an entire "
    "function of t; no proof: tried at witnesses",
)

# --- the slope of the shadow -------------------------------------------------------------------------------

slope = project.claim(
    "sg-rim.slope",
    "the dark side per cosine is its value at the pole and a positive integral up to the sine of the view",
    left=SigmaSphericalGaussian(-v, alpha) / v,
    corrected=(1 - (1 + kappa) * exp(-kappa)) / (2 * kappa * sinh(kappa))
    + Integral(besseli(1, kappa * x) / (1 - x**2) ** Rational(3, 2), (x, 0, s)) / (2 * sinh(kappa)),
    where=[interval(v, 0, 1, open="left"), ROUGHNESS],
    reduces=("xsec:sg-positive",),
    reading="per steradian, unit mass; nothing cancels, so that Lambda = sigma(-v) / v falls with v",
)


@slope.proof
def derivative_along_the_sine(step):
    """I_1(kappa x) / (1 - x^2)^(3/2) is, in t = sqrt(1 - x^2), an exact derivative and the integrand of sg-integral."""
    here = entire.subs(k, kappa)
    step.lemma(whole, {u: -v}).substitute(w, -w, 0, v)
    step.rewrite(step.integrals[0], -Integral(here, (t, 0, v)))
    step.lemma(rest, {u: v, k: kappa})
    step.swap().substitute(t, tau, 1, v)
    step.linear(-(tau * besseli(1, kappa * tau) / t).diff(t), -here)
    step.antiderivative(-tau * besseli(1, kappa * tau) / t, next(i for i in step.integrals if not i.has(hyper)))


# --- the layer of a flat surface ---------------------------------------------------------------------------

a = v / (alpha * s)

layer = project.claim(
    "sg-rim.layer",
    "seen from below, a flat surface has the boundary layer h(a) = 1 / sqrt(pi) - a erfcx(a)",
    left=SigmaBeckmann(-v, alpha),
    corrected=alpha * s / 2 * exp(-(a**2)) * (1 / sqrt(pi) - a * exp(a**2) * erfc(a)),
    where=[interval(v, 0, 1, open="right"), ROUGHNESS],
    reading="projected area 1; Beckmann's slopes are those of the spherical Gaussian for small alpha, where the "
    "cross-section tends to this",
    reduces=("deon2016:22",),
)


@layer.proof
def beckmann_with_erfcx(step):
    step.lemma("deon2016:22", {symbols("u_i", real=True): -v})


if __name__ == "__main__":
    project.tell()
