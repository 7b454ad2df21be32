"""Section 2.2: Beckmann's distribution, its cross-section, and its second component.

The cross-section is derived twice: from the distribution of slopes, as in the paper, and from the second component by
the ring lemma.
"""

from sympy import Heaviside, Integral, Max, Piecewise, erf, exp, oo, pi, sqrt, symbols

from derivations.deon2016.cells import CLOSED, superpose, u, x
from xsec_sym.exact import AZIMUTH, NormalsBeckmann, RingSpread, SigmaBeckmann, beckmann
from xsec_sym.proof import Source, interval

paper = Source("deon2016", section="2.2")

u_i, u_n, alpha, p, q, r, t, w, y = symbols("u_i u_n alpha p q r t w y", real=True)
AREA = "D per steradian, with unit projected area"
ROUGH = interval(alpha, 0, oo, open=True)

s = sqrt(1 - u_i**2)
cosine = 1 / sqrt(p**2 + q**2 + 1)  # (21)


# --- the distribution -----------------------------------------------------------------------------------

paper.definition(
    "19",
    "Beckmann's distribution of normals",
    left=NormalsBeckmann(u, alpha),
    printed=Piecewise((exp(-(1 / u**2 - 1) / alpha**2) / (pi * alpha**2 * u**4), u > 0), (0, True)),
    reading=AREA,
)

area = paper.claim(
    "19.norm",
    "its normalisation: the projected area of all normals is 1",
    left=Integral(2 * pi * x * NormalsBeckmann(x, alpha), (x, -1, 1)),
    corrected=1,
    where=[ROUGH],
    reading=AREA,
)


@area.proof
def exponential_of_the_slopes(step):
    step.unfold().split(0).antiderivative(exp(-(1 / x**2 - 1) / alpha**2))


# --- by slopes ------------------------------------------------------------------------------------------

slopes = paper.claim(
    "20",
    "the cross-section as an integral over slopes",
    left=SigmaBeckmann(u_i, alpha),
    printed=Integral(
        (u_i - p * s)
        * Heaviside(u_i - p * s)
        / sqrt(p**2 + q**2 + 1)
        * (NormalsBeckmann(cosine, alpha) + NormalsBeckmann(-cosine, alpha))
        * cosine**3,
        (p, -oo, oo),
        (q, -oo, oo),
    ),
    where=[interval(u_i, -1, 1), ROUGH],
    reading=AREA,
    points={p: [u_i / s]},
)


@slopes.proof
def rings_of_slopes(step):
    step.unfold().substitute(r, 1 / sqrt(1 + r**2), oo, 0)
    step.swap().nest()
    inner = step.left.function.atoms(Integral).pop()
    step.rewrite(inner.function, Max(0, u_i - p * s) * exp(-(p**2 + q**2) / alpha**2))
    step.substitute(w, -w, oo, -oo, step.left.function.atoms(Integral).pop())
    step.polar(r, AZIMUTH)


paper.definition("21", "the change of variables from cosine to slopes", left=u, printed=cosine,
                 reading="the normal is (-p, -q, 1) over its length, and u is its cosine")  # fmt: skip

jacobian = paper.claim(
    "21.jacobian",
    "its Jacobian is u^3: the slopes up to any steepness fill the cone of normals that they belong to",
    left=Integral(1, (x, 1 / sqrt(1 + y**2), 1)),
    corrected=Integral(cosine.subs({p: r, q: 0}) ** 3 * r, (r, 0, y)),
    where=[interval(y, 0, oo, open="right")],
    reading="d omega = u^3 dp dq, written in polar slopes: -du = u^3 r dr",
    statement=True,
)


@jacobian.proof
def cone_of_normals(step):
    step.antiderivative(x)
    step.swap().antiderivative(-1 / sqrt(1 + r**2))


ERF = erf(u_i / (alpha * s))
PRINTED_TAIL = alpha * s * exp(u_i**2 / (alpha**2 * (1 - u_i**2))) / sqrt(pi)
TAIL = alpha * s * exp(-(u_i**2) / (alpha**2 * (1 - u_i**2))) / sqrt(pi)

closed = paper.claim(
    "22",
    "the cross-section of Beckmann's distribution",
    left=SigmaBeckmann(u_i, alpha),
    printed=(u_i * (1 + ERF) + PRINTED_TAIL) / 2,
    corrected=(u_i * (1 + ERF) + TAIL) / 2,
    edit="put back the minus sign of the exponent: exp(-u^2 / (alpha^2 (1 - u^2)))",
    where=[interval(u_i, -1, 1, open=True), ROUGH],
    reading=AREA + "; at the poles the form has no value: its limits are deon2016:22.pole.above and "
    "deon2016:22.pole.below",
    reduces=CLOSED,
)


@closed.proof
def one_slope_after_the_other(step):
    """Across the viewing direction the slopes are Gaussian; along it they are seen up to p = u / sqrt(1 - u^2)."""
    step.lemma(slopes).unfold().nest()
    across = step.left.atoms(Integral)
    step.split(u_i / s, integral=next(i for i in across if i.limits[0][0] == p))
    gauss = exp(-(p**2) / alpha**2)
    step.fact(u_i - p * s, s * (u_i / s - p), inside=(p, -oo, u_i / s))
    step.exchange()
    step.antiderivative(
        alpha * sqrt(pi) / 2 * gauss * erf(q / alpha), next(i for i in step.left.atoms(Integral) if i.limits[0][0] == q)
    )
    step.antiderivative(pi * alpha**2 * (u_i * erf(p / alpha) / 2 + alpha * s * gauss / (2 * sqrt(pi))))


# --- by the second component ----------------------------------------------------------------------------

tau = s
second = paper.claim(
    "23",
    "the second component of Beckmann's cross-section",
    left=Integral(RingSpread(x, u_i) * beckmann(x, alpha), (x, 0, 1)),
    printed=PRINTED_TAIL / 2,
    corrected=TAIL / 2,
    edit="put back the minus sign of the exponent, as in (22)",
    where=[interval(u_i, -1, 1, open=True), ROUGH],
    reading=AREA,
    reduces=CLOSED,
    points={x: [s]},
)


@second.proof
def gaussian_moment(step):
    """With x = tau / sqrt(1 + y^2) the band becomes a Gaussian of the width alpha tau, weighted with y^2."""
    c = alpha * tau
    step.lemma("deon2016:11", {u: x, u_n: u_i})
    step.fact(1 - u_i**2 - x**2, (tau - x) * (tau + x), inside=(x, 0, tau))
    step.fact(1 - u_i**2 - x**2, (tau - x) * (tau + x), inside=(x, tau, 1))
    step.split(tau)
    step.substitute(y, tau / sqrt(1 + y**2), oo, 0)
    gauss = exp(-(y**2) / c**2)
    scale = 2 * exp(-(u_i**2) / c**2) / (pi * c**2)
    step.antiderivative(scale * (-(c**2) / 2 * y * gauss + sqrt(pi) * c**3 / 4 * erf(y / c)))


again = paper.claim(
    "22.rings",
    "the same cross-section from its second component, by the ring lemma",
    left=SigmaBeckmann(u_i, alpha),
    corrected=(u_i * (1 + ERF) + TAIL) / 2,
    where=[interval(u_i, -1, 1, open=True), ROUGH],
    reading=AREA + "; the longer route: it needs (23), the exchange of two integrals, and one case for each side",
    reduces=CLOSED,
)


@again.proof
def by_the_ring_lemma(step):
    root = sqrt(1 - t**2)
    beyond = -alpha * root / (2 * sqrt(pi) * t) * exp(-(t**2) / (alpha * root) ** 2) - erf(t / (alpha * root)) / 2

    mean = exp(-(1 / x**2 - 1) / alpha**2)
    superpose(step, SigmaBeckmann(u_i, alpha), u_i, beckmann(x, alpha), second, mean, beyond, low=0)


for pole, value in ((1, 1), (-1, 0)):
    at_pole = paper.claim(
        f"22.pole.{'above' if pole > 0 else 'below'}",
        f"the limit of (22) at u = {pole} is the cross-section there",
        left=SigmaBeckmann(pole, alpha),
        corrected=value,
        where=[ROUGH],
        reading=AREA,
        reduces=CLOSED,
    )

    @at_pole.proof
    def one_cosine_for_a_ring(step):
        """Seen from a pole a ring has one cosine: the projected area is what is left, or nothing."""
        inner = next(i for i in step.unfold().left.atoms(Integral) if i.limits[0][0] == AZIMUTH)
        for ring in step.split(integral=inner).left.atoms(Integral):
            if ring.limits[0][0] == AZIMUTH:
                step.antiderivative(x * AZIMUTH, ring).antiderivative(exp(-(1 / x**2 - 1) / alpha**2))


# --- the text -------------------------------------------------------------------------------------------

mu = u_i / s  # the steepest slope that a ray at u can graze

smith = paper.claim(
    "claim.beckmann-lambda",
    "the cross-section is related to Smith's Lambda by a cosine: from below it is u Lambda(u)",
    left=SigmaBeckmann(-u_i, alpha),
    printed=u_i * (Integral((q - mu) * exp(-(q**2) / alpha**2) / (alpha * sqrt(pi)), (q, mu, oo)) / mu),
    where=[interval(u_i, 0, 1, open=True), ROUGH],
    reading=AREA + "; Lambda is Smith's integral over the slopes along the ray, with mu = cot(theta)",
    statement=True,
    reduces=["deon2016:22"],
)


@smith.proof
def slopes_beyond_the_ray(step):
    step.lemma(closed, {u_i: -u_i}).swap()
    step.antiderivative(-alpha / (2 * sqrt(pi)) * exp(-(q**2) / alpha**2) - mu / 2 * erf(q / alpha))


if __name__ == "__main__":
    paper.tell()
