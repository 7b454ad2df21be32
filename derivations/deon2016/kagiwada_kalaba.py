"""Section 2.4: the ellipsoidal distribution of Kagiwada and Kalaba, and its cross-section.

The cross-section follows twice: from the second component by the ring lemma, and, as in the paper, from a uniform
disk of parallel rays. A form that is regular at both poles comes first; the printed one is 0 / 0 at u = 1.
"""

from sympy import Abs, Integral, Max, asin, cos, log, pi, sqrt, symbols

from derivations.deon2016.cells import CLOSED, superpose, t, u, x
from derivations.extensions.circle import A, B, circle
from derivations.extensions.ring_lemma import over_the_band
from xsec_sym.exact import NormalsKagiwadaKalaba, RingSpread, SigmaEllipsoidal, ellipsoidal
from xsec_sym.proof import Source, interval

paper = Source("deon2016", section="2.4")

u_i, b, xi_1, xi_2, y = symbols("u_i b xi_1 xi_2 y", real=True)
SHAPE = interval(b, 0, 1, open=True)
SPHERE = interval(u_i, -1, 1)
PER_STERADIAN = "D per steradian, unit mass: the paper's (26) over 2 pi"
PER_COSINE = "with D per unit cosine, as (26) has it, the display gives 2 pi times the cross-section per steradian"

tau = sqrt(1 - u_i**2)
R = sqrt(b**2 * (u_i**2 - 1) + 1)
L = log((1 + b) / (1 - b))


# --- the distribution -----------------------------------------------------------------------------------

paper.definition(
    "26",
    "the distribution of Kagiwada and Kalaba",
    left=NormalsKagiwadaKalaba(u, b),
    printed=b / ((1 - b * u) * log((1 + b) / (1 - b))),
    reading="per unit cosine",
)

mass = paper.claim(
    "26.norm",
    "its normalisation per unit cosine",
    left=Integral(NormalsKagiwadaKalaba(x, b), (x, -1, 1)),
    corrected=1,
    where=[SHAPE],
    reading="per unit cosine, as in (5)",
)


def dense(step, v, low=-1, high=1):
    """1 - b v is positive."""
    step.fact(1 - b * v, 1 - b, b * (1 - v), inside=(v, low, high))


@mass.proof
def logarithm(step):
    dense(step.unfold(), x)
    step.antiderivative(-log(1 - b * x) / L)


isotropic = paper.claim(
    "claim.kk-isotropic",
    "the distribution becomes the isotropic one, D = 1/2 per unit cosine, as b goes to 0",
    left=1 / (2 * NormalsKagiwadaKalaba(u, b)),
    corrected=(1 - b * u) * Integral(1 / (1 - b**2 * t**2), (t, 0, 1)),
    where=[interval(u, -1, 1), SHAPE],
    reading="per unit cosine; the right side is continuous at b = 0, where it is 1: the integral lies between 1 and "
    "1 / (1 - b^2)",
    statement=True,
)


@isotropic.proof
def logarithm_as_an_integral(step):
    dense(step.unfold(), t, 0)
    step.swap().antiderivative(log((1 + b * t) / (1 - b * t)) / (2 * b))


# --- the cross-section by the ring lemma ----------------------------------------------------------------

second = paper.claim(
    "27.spread",
    "the second component of the cross-section",
    left=Integral(RingSpread(x, u_i) * ellipsoidal(x, b), (x, -1, 1)),
    corrected=(1 - R) / (b * L),
    where=[SPHERE, SHAPE],
    reading=PER_STERADIAN,
    reduces=CLOSED,
    points={x: [-tau, tau]},
)


@second.proof
def chord(step):
    """Both inverse sines run from -pi/2 to pi/2 across the band."""

    def across(branch):
        branch.fact(R**2, 1 - b**2, b**2 * u_i**2)
        branch.fact(1 - b * tau, (1 - b**2 + b**2 * u_i**2) / (1 + b * tau))
        branch.fact(1 - b * x, 1 - b * tau, b * (tau - x), inside=(x, -tau, tau))
        inverse = (x - b * tau**2) / (tau * (1 - b * x))
        branch.fact(1 - inverse, (1 + b * tau) * (tau - x) / (tau * (1 - b * x)), inside=(x, -tau, tau))
        branch.fact(1 + inverse, (1 - b * tau) * (tau + x) / (tau * (1 - b * x)), inside=(x, -tau, tau))
        whole = -sqrt(tau**2 - x**2) / b + asin(x / tau) / b**2 - R / b**2 * asin(inverse)
        branch.antiderivative(b / (pi * L) * whole)

    over_the_band(step, across, viewer=u_i)


regular = paper.claim(
    "27.regular",
    "the cross-section, regular at both poles",
    left=SigmaEllipsoidal(u_i, b),
    corrected=Max(0, u_i) / b
    + (1 - R - b * u_i + Abs(u_i) * log((R + Abs(u_i)) / ((1 + b) * (1 + Abs(u_i))))) / (b * L),
    where=[SPHERE, SHAPE],
    reading=PER_STERADIAN,
    reduces=CLOSED,
)


@regular.proof
def by_the_ring_lemma(step):
    root = R.subs(u_i, t)

    def ready(branch, distance):
        branch.fact(R**2, 1 - b**2, b**2 * u_i**2)
        branch.fact(root**2, 1 - b**2, b**2 * t**2, inside=(t, distance, 1))
        for low, high in ((-1, 0), (0, 1)):
            dense(branch, x, low, high)

    mean = (-x - log(1 - b * x) / b) / L
    beyond = (log((1 + t) / (root + t)) - (1 - root) / t) / (b * L)
    superpose(step, SigmaEllipsoidal(u_i, b), u_i, ellipsoidal(x, b), second, mean, beyond, ready=ready)


flat = paper.claim(
    "claim.kk-flat",
    "the cross-section becomes that of a flat surface, max(0, u), as b goes to 1",
    left=b * SigmaEllipsoidal(u_i, b) - Max(0, u_i),
    corrected=(1 - R - b * u_i + Abs(u_i) * log((R + Abs(u_i)) / ((1 + b) * (1 + Abs(u_i))))) / L,
    where=[SPHERE, SHAPE],
    reading=PER_STERADIAN + "; the numerator is bounded, since |u| <= R + |u| <= (1 + b) (1 + |u|) and |u log u| < 1, "
    "while L = log((1 + b) / (1 - b)) goes to infinity",
    statement=True,
    reduces=CLOSED,
)


@flat.proof
def bounded_over_a_logarithm(step):
    step.lemma(regular)


closed = paper.claim(
    "27.2",
    "the cross-section in closed form",
    left=2 * pi * SigmaEllipsoidal(u_i, b),
    printed=2
    * pi
    * (
        (sqrt(b**2 * (u_i**2 - 1)) + 1)
        + u_i * log(sqrt(b**2 * (u_i**2 - 1)) + 1 - u_i)
        + b * u_i
        - u_i * log((-b - 1) * (u_i - 1) - 1)
    )
    / (b * log(2 / (b**2 - 1))),
    corrected=2
    * pi
    * (R + u_i * log(R - u_i) + b * u_i - u_i * log((-b - 1) * (u_i - 1)) - 1)
    / (b * log(2 / (b + 1) - 1)),
    edit="draw both roots over the + 1, take the - 1 out of the last logarithm, and read log(2 / (b + 1) - 1) below",
    where=[interval(u_i, -1, 1, open="right"), SHAPE],
    reading=PER_COSINE + "; as printed it is not real: the logarithm below is one of a negative number",
    reduces=CLOSED,
)


@closed.proof
def gather_the_logarithms(step):
    """R - u = (1 - b^2) (1 - u^2) / (R + u) where u is positive."""
    step.lemma(regular)
    step.fact(R**2, 1 - b**2, b**2 * u_i**2)
    for branch in step.cases(u_i):
        branch.swap()
        if branch.goal.piece.facts_about(u_i) and branch.goal.piece.sign(u_i) == "+":
            apart = (1 - b**2) * (1 - u_i**2)
            branch.fact(apart, (1 - b) * (1 + b) * (1 - u_i) * (1 + u_i))
            branch.fact(R - u_i, (R - u_i) ** 2 / (2 * R), apart / (2 * R))
            branch.rewrite(R - u_i, apart / (R + u_i))


# --- a disk of parallel rays ----------------------------------------------------------------------------

Q = sqrt(1 - 2 * b * t * u_i + b**2 * (t**2 + u_i**2 - 1))  # of one circle of the disk
MEAN = Integral(1 / (1 - b**2 * t**2), (t, 0, 1))

gray = paper.claim(
    "claim.kk-isotropic.sigma",
    "the cross-section becomes that of the isotropic distribution, 1/4, as b goes to 0",
    left=SigmaEllipsoidal(u_i, b),
    corrected=Integral(t / Q, (t, 0, 1)) / (2 * MEAN),
    where=[SPHERE, SHAPE],
    reading=PER_STERADIAN + "; the integrals are continuous at b = 0, where they are 1/2 and 1",
    statement=True,
    reduces=CLOSED,
)


@gray.proof
def radius_of_the_disk(step):
    step.lemma(regular).swap()
    step.fact(1 - b * t, 1 - b, b * (1 - t), inside=(t, 0, 1))
    step.antiderivative(log((1 + b * t) / (1 - b * t)) / (2 * b), next(i for i in step.integrals if not i.has(u_i)))
    for below in step.cases(1 - u_i, u_i, 1, -1):
        if below.is_empty:
            below.vacuous()
        elif not below.goal.piece.facts_about(u_i):
            below.antiderivative(-t / b - log(1 - b * t) / b**2)
        else:
            for branch in below.cases(1 + u_i, u_i, -1):
                if branch.is_empty:
                    branch.vacuous()
                elif not branch.goal.piece.facts_about(u_i):
                    branch.antiderivative(t / b - log(1 + b * t) / b**2)
                else:
                    along_the_radius(branch)


def along_the_radius(step):
    """Q and b t - u are the sides of a hyperbola: their sum is positive, and so is R - u."""
    apart = (1 - b**2) * (1 - u_i**2)
    step.fact(apart, (1 - b) * (1 + b) * (1 - u_i) * (1 + u_i))
    step.fact(R**2, 1 - b**2, b**2 * u_i**2)
    step.fact(R - u_i, (R - u_i) ** 2 / (2 * R), apart / (2 * R))
    step.fact(1 - u_i * b, 1 - b, b * (1 - u_i))
    offset = b * t - u_i
    step.fact(Q**2, offset**2, apart, inside=(t, 0, 1))
    step.fact(Q + offset, (Q + offset) ** 2 / (2 * Q), apart / (2 * Q), inside=(t, 0, 1))
    step.antiderivative((Q + u_i * log(offset + Q)) / b**2)
    step.swap()
    for branch in step.cases(u_i):
        if branch.goal.piece.facts_about(u_i) and branch.goal.piece.sign(u_i) == "+":
            branch.settle().swap().rewrite(R - u_i, apart / (R + u_i))


printed_root = sqrt(xi_1 - xi_1 * u_i**2 + sqrt(1 - xi_1) * u_i)
DISK = ((xi_2, 0, 1), (xi_1, 0, 1))

disk = paper.claim(
    "27.1",
    "the cross-section by a uniform disk of parallel rays that meet the sphere",
    left=2 * pi * SigmaEllipsoidal(u_i, b),
    printed=pi * Integral(NormalsKagiwadaKalaba(cos(2 * pi * xi_2) * printed_root, b), *DISK),
    corrected=pi
    * Integral(NormalsKagiwadaKalaba(cos(2 * pi * xi_2) * sqrt(xi_1 - xi_1 * u_i**2) + sqrt(1 - xi_1) * u_i, b), *DISK),
    edit="end the root after xi_1 u^2: sqrt(1 - xi_1) u is added to the cosine term",
    where=[SPHERE, SHAPE],
    reading=PER_COSINE,
    reduces=(*CLOSED, "xsec:mean-over-a-circle"),
)


@disk.proof
def circle_by_circle(step):
    """xi_1 = 1 - t^2 is the square of the distance from the disk's centre; each circle is one azimuthal mean."""
    step.lemma(gray)
    step.fact(1 - b * t, 1 - b, b * (1 - t), inside=(t, 0, 1))
    step.antiderivative(log((1 + b * t) / (1 - b * t)) / (2 * b), next(i for i in step.integrals if not i.has(u_i)))
    step.swap().unfold().nest()
    step.substitute(t, 1 - t**2, 1, 0)
    mean, swing = 1 - b * t * u_i, b * tau * sqrt(1 - t**2)
    for below in step.cases(1 - u_i, u_i, 1, -1):
        if not below.goal.piece.facts_about(u_i):
            seen_along_the_axis(below)
            continue
        for branch in below.cases(1 + u_i, u_i, -1):
            if branch.is_empty:
                branch.vacuous()
            elif not branch.goal.piece.facts_about(u_i):
                seen_along_the_axis(branch)
            else:
                apart = (1 - b**2) * (1 - u_i**2)
                branch.fact(apart, (1 - b) * (1 + b) * (1 - u_i) * (1 + u_i))
                branch.fact(mean, 1 - b, b * (1 - t), b * t * (1 - u_i), inside=(t, 0, 1))
                total = mean + swing
                branch.fact(mean - swing, (b * t - u_i) ** 2 / total, apart / total, inside=(t, 0, 1))
                inner = next(i for i in branch.left.atoms(Integral) if i.limits[0][0] == xi_2)
                branch.rewrite(inner, circle.left.subs({A: mean, B: swing, y: xi_2}))
                branch.lemma(circle, {A: mean, B: swing})
                branch.fact(Q**2, (b * t - u_i) ** 2, apart, inside=(t, 0, 1))


def seen_along_the_axis(step):
    """Every circle of the disk has one inclination."""
    if step.is_empty:
        step.vacuous()
        return
    inner = next(i for i in step.left.atoms(Integral) if i.limits[0][0] == xi_2)
    step.antiderivative(inner.function.subs(Abs(t), t) * xi_2, inner)


paper.whole(
    "27",
    "the cross-section of the ellipsoidal distribution",
    ["27.1", "27.2"],
    left=2 * pi * SigmaEllipsoidal(u_i, b),
    printed=closed.printed,
    reading=PER_COSINE,
)


# --- the conclusion -------------------------------------------------------------------------------------

paper.whole(
    "claim.blending.ellipsoidal",
    "the ellipsoidal distribution blends continuously between a flat mirror and an isotropic medium",
    ["claim.kk-isotropic", "claim.kk-isotropic.sigma", "claim.flat-limit.kagiwada-kalaba", "claim.kk-flat"],
    left=SigmaEllipsoidal(u_i, b),
    reading="in between, (27) is continuous in b",
)

paper.out_of_scope(
    "claim.new-behaviours",
    "such distributions define new surface-like and semi-porous reflectance",
    because="a statement about appearance",
)

paper.out_of_scope(
    "claim.simple-forms",
    "among the new distributions only the ellipsoidal one has a simple closed form",
    because="it tells what its author found; whether a form is simple is no equation",
)

if __name__ == "__main__":
    paper.tell()
