"""The spherical Gaussian's cross-section: a positive integral, one without cancellation, and what follows from them.

What is closed form here, and what is not. The odd part, the second Dirac component, the second derivative of the even
part and the values at u = -1, 0 and 1 are elementary or a single Bessel function. What is left of the cross-section is
one integral, of kappa I_0(kappa tau) - I_1(kappa tau) / tau over t from 0 to u, tau^2 = 1 - t^2. It has a name, but the
name is a series: the integral of I_0(kappa tau) is 2 / kappa times (L(u) - sinh(kappa) / 2), where L(u) = sum of
r^(2 m + 1) I_(2 m + 1)(kappa s) with r^2 = (1 + u) / (1 - u) is a Lommel function of two variables with imaginary
arguments. Both parities of that sum together are exp(kappa) times Marcum's Q function of sqrt(kappa (1 + u)) and
sqrt(kappa (1 - u)); the odd part alone is not, and the symmetry u -> -u only returns sinh(kappa). Tried without
success: Legendre's equation by variation of parameters (it leads back to the same integral), reduction to Marcum's Q,
the generating functions of I_n. No elementary closed form is known to us; none is shown not to exist. The explicit
series stand in `spherical_gaussian_series.py`: theirs are exact coefficients, and `spherical_gaussian_bounds.py`
proves how many of them are enough.
"""

from sympy import (
    Abs,
    Integral,
    besseli,
    cos,
    cosh,
    coth,
    diff,
    exp,
    hyper,
    oo,
    pi,
    sin,
    sinh,
    sqrt,
    symbols,
)

from derivations.extensions.ring_lemma import CLOSED, over_the_band
from xsec_sym.exact import AZIMUTH, RingSpread, SigmaSphericalGaussian, spherical_gaussian
from xsec_sym.exact.distributions import INCLINATION
from xsec_sym.proof import Source, interval

project = Source("xsec", section="spherical Gaussian")

u, t, y, v, w, u_n, alpha = symbols("u t y v w u_n alpha", real=True)
x = INCLINATION
kappa = 2 / alpha**2
s, tau = sqrt(1 - u**2), sqrt(1 - t**2)
ROUGHNESS = interval(alpha, 0, oo, open=True)
SEEN = [interval(u, -1, 1), ROUGHNESS]

positive = project.claim(
    "sg-positive",
    "the cross-section as an integral of positive terms only",
    left=SigmaSphericalGaussian(u, alpha),
    corrected=kappa / (2 * sinh(kappa)) * Integral(t * exp(kappa * u * t) * besseli(0, kappa * s * tau), (t, 0, 1)),
    where=SEEN,
    reading="per steradian, unit mass; t is the cosine between normal and viewer, so that the disk of parallel rays "
    "has the area element t dt",
)


def inner(step):
    """The integral under the first integral."""
    return step.integrals[0].function.atoms(Integral).pop()


@positive.proof
def the_viewer_as_pole(step):
    """Round the viewer's axis the clamped cosine is constant, and the azimuth only meets one exponential."""
    step.unfold().turn(u).split(0)
    step.bessel(0, kappa * s * sqrt(1 - x**2), exp(kappa * u * x), inner(step))


# --- the mean of an exponential over the sphere -----------------------------------------------------------

k = symbols("k", real=True)
CONCENTRATION = interval(k, 0, oo, open=True)

sphere = project.claim(
    "sg-sphere",
    "the mean of exp(k cos) over the sphere, about an axis at right angles",
    left=Integral(besseli(0, k * tau), (t, -1, 1)) / 2,
    corrected=sinh(k) / k,
    where=[CONCENTRATION],
)


@sphere.proof
def the_other_axis(step):
    step.wave(besseli(0, k * tau), AZIMUTH).turn(0, w, exp(k * w) / (2 * pi))
    step.antiderivative(AZIMUTH, inner(step))
    step.antiderivative(exp(k * t) / k)


hemisphere = project.claim(
    "sg-hemisphere",
    "half of it",
    left=Integral(besseli(0, k * tau), (t, 0, 1)),
    corrected=sinh(k) / k,
    where=[CONCENTRATION],
)


@hemisphere.proof
def mirror(step):
    step.swap().lemma(sphere, {k: k}, back=True).split(0)
    step.substitute(w, -w, 1, 0, step.over(-1, 0))


growth = project.claim(
    "sg-growth",
    "how the next order grows with the concentration",
    left=2 * besseli(1, k * tau) / (k * tau),
    corrected=2 * Integral(y * besseli(0, y * tau), (y, 0, k)) / k**2,
    where=[CONCENTRATION, interval(t, 0, 1, open=True)],
)


@growth.proof
def product_rule(step):
    step.swap().antiderivative(y * besseli(1, y * tau) / tau)


# I_1(k tau) / tau, written so that it is entire in t
ratio = k / 2 * hyper((), (2,), (k * tau / 2) ** 2)
entire = k * besseli(0, k * tau) - ratio

arch = project.claim(
    "sg-arch",
    "the same for the next order",
    left=Integral(2 * ratio / k, (t, 0, 1)),
    corrected=2 * (cosh(k) - 1) / k**2,
    where=[CONCENTRATION],
)


@arch.proof
def integrate_over_the_concentration(step):
    step.rewrite(step.integrals[0], Integral(2 / k * besseli(1, k * tau) / tau, (t, 0, 1)))
    step.lemma(growth, {k: k, t: t}).exchange().lemma(hemisphere, {k: y}).antiderivative(cosh(y))


rest = project.claim(
    "sg-rest",
    "the integral up to a cosine and the one beyond it",
    left=Integral(entire, (t, 0, u)),
    corrected=sinh(k) - (cosh(k) - 1) / k - Integral(entire, (t, u, 1)),
    where=[CONCENTRATION, interval(u, 0, 1)],
)


@rest.proof
def both_together(step):
    step.extend(1).linear(k * besseli(0, k * tau), -ratio, integral=step.over(0, 1))
    step.lemma(hemisphere).lemma(arch)


# --- the second component and the ring lemma ---------------------------------------------------------------

band = project.claim(
    "sg-band",
    "the second component of an exponential is a Bessel function",
    left=Integral(RingSpread(x, u) * exp(k * x), (x, -1, 1)),
    corrected=2 * pi * s * besseli(1, k * s) / k,
    where=[interval(u, -1, 1), CONCENTRATION],
    reduces=CLOSED,
    points={x: [-s, s]},
)


@band.proof
def by_parts(step):
    """With x = s cos(v) the integral of sin(v)^2 exp(z cos(v)), which is that of cos(v) exp(z cos(v)) over z."""
    z = k * s
    wave = exp(z * cos(v))

    def across(branch):
        branch.substitute(v, s * cos(v), pi, 0)
        branch.linear(2 * s / k * cos(v) * wave, 2 * s / k * (z * sin(v) ** 2 - cos(v)) * wave)
        branch.bessel(1, z, 1, next(i for i in branch.integrals if not i.has(sin)))
        branch.antiderivative(-sin(v) * wave)

    over_the_band(step, across)


whole = project.claim(
    "sg-integral",
    "the cross-section without cancellation at the pole: every part is an entire function of u",
    left=SigmaSphericalGaussian(u, alpha),
    corrected=(
        s * besseli(1, kappa * s)
        + u
        * (
            cosh(kappa)
            - sinh(kappa) / kappa
            + Integral(kappa * besseli(0, kappa * tau) - besseli(1, kappa * tau) / tau, (t, 0, u))
        )
    )
    / (2 * sinh(kappa)),
    where=SEEN,
    reduces=("xsec:sg-positive",),
)


@whole.proof
def from_the_ring_lemma(step):
    """The mean and the second component give it for u > 0 and u < 0; on the great circle only the latter is left."""
    step.unfold("SigmaSphericalGaussian")
    for first in step.cases(u):
        if not first.goal.piece.facts_about(u):
            at_the_equator(first)
            continue
        distance = u if first.goal.piece.sign(u) == "+" else -u
        mass = spherical_gaussian(x, alpha)
        ring = Integral(RingSpread(x, t) / (t**2 * (1 - t**2)), (t, distance, 1))
        first.lemma("xsec:ring-lemma", {x: x, u: u}).settle()
        first.linear(pi * u * x * mass, distance * pi * Abs(x) * mass, distance * mass * ring)
        first.exchange(next(i for i in first.integrals if i.has(RingSpread)), by="deon2016:11", mapping={u: x, u_n: t})
        first.lemma(band, {u: t, k: kappa})
        moment = exp(kappa * x) * (x / kappa - 1 / kappa**2)
        for weighed in first.integrals:
            if weighed.has(Abs):
                first.split(0, integral=weighed)
        for weighed in first.integrals:
            if not weighed.has(besseli):
                _, low, high = weighed.limits[0]
                first.antiderivative(-moment if (low, high) == (-1, 0) else moment, weighed)
        # the rest of the integrand is the derivative of tau I_1 / t, and an entire function of t
        edge = -tau * besseli(1, kappa * tau) / t
        here = entire.subs(k, kappa)
        first.linear(alpha**2 * pi * edge.diff(t), -(alpha**2) * pi * here)
        first.antiderivative(edge, next(i for i in first.integrals if not i.has(hyper)))
        first.swap()
        (sweep,) = first.integrals
        first.rewrite(sweep, Integral(here, (t, 0, u)))
        if distance == -u:
            first.substitute(w, -w, 0, distance).rewrite(first.integrals[0], -Integral(here, (t, 0, distance)))
        first.lemma(rest, {u: distance, k: kappa})


def at_the_equator(step):
    step.lemma("xsec:ring-lemma.zero", {x: x})
    step.linear(step.integrals[0].function).lemma(band, {u: 0, k: kappa})


mean = project.claim(
    "sg-odd",
    "opposite views differ by a linear function, whose slope is the mean cosine",
    left=(SigmaSphericalGaussian(u, alpha) - SigmaSphericalGaussian(-u, alpha)) / 2,
    corrected=(coth(kappa) - 1 / kappa) * u / 2,
    where=SEEN,
    reduces=("xsec:sg-positive",),
)


def legendre(f):
    """Legendre's operator of degree 1, whose solutions are u and u artanh(u) - 1."""
    return diff((1 - u**2) * diff(f, u), u) + 2 * f


equation = project.claim(
    "sg-ode",
    "the cross-section solves Legendre's equation of degree 1 with a Bessel function as its source",
    left=legendre(whole.corrected),
    corrected=kappa * besseli(0, kappa * s) / (2 * sinh(kappa)),
    where=[interval(u, -1, 1, open=True), ROUGHNESS],
    reading="sigma is put in as sg-integral has it and differentiated there; the source is the mean of the spherical "
    "Gaussian over the great circle that the viewer sees edge-on, times 2 pi",
)


@equation.proof
def differentiated(step):
    """The integral's own derivative is its integrand, and what is left of it cancels."""
    for branch in step.cases(u):
        branch.close()


def both_views(step):
    """The views from u and -u, written with integrals from 0 to u, where u > 0, u < 0, and at either pole."""
    for branch in step.cases(u):
        if not branch.goal.piece.facts_about(u):
            while branch.left.has(SigmaSphericalGaussian):
                branch.lemma(whole, {u: 0})
            continue
        pole = 1 if branch.goal.piece.sign(u) == "+" else -1
        for where, position in enumerate(branch.cases(1 - pole * u, u, pole, -pole)):
            end = pole if where == 2 else u
            if where == 1:
                position.vacuous()
            else:
                position.lemma(whole, {u: end}).lemma(whole, {u: -end})
                yield position.substitute(w, -w, 0, end, position.over(0, -end)), end


@mean.proof
def odd_part(step):
    for _ in both_views(step):
        pass


second = project.claim(
    "sg-second-derivative",
    "the even part is convex, with a second derivative in closed form",
    left=(SigmaSphericalGaussian(u, alpha) + SigmaSphericalGaussian(-u, alpha)) / 2,
    corrected=besseli(1, kappa) / (2 * sinh(kappa))
    + Integral((u - t) * kappa * besseli(2, kappa * tau) / (2 * sinh(kappa) * tau**2), (t, 0, u)),
    where=SEEN,
    reduces=("xsec:sg-positive",),
    reading="twice differentiated, the right side is kappa I_2(kappa s) / (2 sinh(kappa) s^2), which is positive",
)


@second.proof
def twice(step):
    """d/dt of I_1(kappa tau) / tau is -kappa t I_2(kappa tau) / tau^2: one integration by parts on each side."""
    scale = 1 / (2 * sinh(kappa))
    slope, straight = ratio.subs(k, kappa), entire.subs(k, kappa)
    bend = hyper((), (3,), (kappa * tau / 2) ** 2)  # 8 / kappa^2 times I_2(kappa tau) / tau^2
    for branch, end in both_views(step):
        branch.swap().linear(scale * kappa**3 / 8 * end * bend, -scale * kappa**3 / 8 * t * bend)
        branch.antiderivative(-8 / kappa**3 * slope, Integral(t * bend, (t, 0, end)))
        branch.linear(8 / kappa**3 * straight, -8 / kappa**3 * diff(t * slope, t), integral=Integral(bend, (t, 0, end)))
        branch.antiderivative(t * slope, next(i for i in branch.integrals if not i.has(besseli)))


if __name__ == "__main__":
    project.tell()
