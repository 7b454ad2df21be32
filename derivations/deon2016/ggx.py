"""Section 2.3: the GGX distribution and its cross-section, from the second component by the ring lemma."""

from sympy import Integral, Piecewise, atan, oo, pi, sqrt, symbols

from derivations.deon2016.cells import CLOSED, superpose, t, u, x
from derivations.extensions.ring_lemma import over_the_band
from xsec_sym.exact import NormalsGGX, RingSpread, SigmaGGX, ggx
from xsec_sym.proof import Source, interval

paper = Source("deon2016", section="2.3")

u_i, alpha, y = symbols("u_i alpha y", real=True)
AREA = "D per steradian, with unit projected area"
ROUGH = interval(alpha, 0, oo, open=True)

tau = sqrt(1 - u_i**2)
axis = sqrt(alpha**2 - alpha**2 * u_i**2 + u_i**2)  # the half-axis that the spheroid shows across the view

PRINTED = Piecewise((alpha**2 / (pi * u**4 * (alpha**2 + 1 / u**2 - 1) ** 2), u > 0), (0, True))

paper.definition("24", "the GGX distribution of normals", left=NormalsGGX(u, alpha), printed=PRINTED, reading=AREA)

regular = paper.claim(
    "24.regular",
    "the same without the quotient that has no value at the horizon",
    left=NormalsGGX(u, alpha),
    corrected=PRINTED,
    where=[interval(u, 0, 1, open="left"), ROUGH],
    reading=AREA + "; the project writes D = alpha^2 / (pi (1 - (1 - alpha^2) u^2)^2) for u > 0",
)


@regular.proof
def clear_the_quotient(step):
    below_the_axis(step.unfold().settle(), u)


area = paper.claim(
    "24.norm",
    "its normalisation: the projected area of all normals is 1",
    left=Integral(2 * pi * x * NormalsGGX(x, alpha), (x, -1, 1)),
    corrected=1,
    where=[ROUGH],
    reading=AREA,
)


def below_the_axis(step, v, low=0):
    """1 - (1 - alpha^2) v^2 is positive: what is left of 1 - v^2, and alpha^2 v^2."""
    step.fact(1 - (1 - alpha**2) * v**2, (1 - v) * (1 + v), alpha**2 * v**2, inside=(v, low, 1))


SHARE = alpha**2 * x**2 / (1 - (1 - alpha**2) * x**2)  # of the projected area: normals steeper than x


@area.proof
def rational_in_the_square(step):
    below_the_axis(step.unfold().split(0), x)
    step.antiderivative(SHARE)


second = paper.claim(
    "25.spread",
    "the second component of the GGX cross-section",
    left=Integral(RingSpread(x, u_i) * ggx(x, alpha), (x, 0, 1)),
    corrected=alpha**2 * (1 - u_i**2) / (2 * axis),
    where=[interval(u_i, -1, 1), ROUGH],
    reading=AREA,
    reduces=CLOSED,
    points={x: [tau]},
)


@second.proof
def arctangent(step):
    """With x = tau / sqrt(1 + y^2) the integrand is y^2 / (y^2 + axis^2)^2."""

    def across(branch):
        branch.fact(axis**2, u_i**2, alpha**2 * (1 - u_i**2))
        branch.substitute(y, tau / sqrt(1 + y**2), oo, 0)
        scale = 2 * alpha**2 * tau**2 / pi
        branch.antiderivative(scale * (atan(y / axis) / (2 * axis) - y / (2 * (y**2 + axis**2))))

    over_the_band(step, across, low=0, viewer=u_i)


closed = paper.claim(
    "25",
    "the cross-section of the GGX distribution",
    left=SigmaGGX(u_i, alpha),
    printed=(sqrt(alpha**2 - alpha**2 * u_i**2 + u_i**2) + u_i) / 2,
    where=[interval(u_i, -1, 1), ROUGH],
    reading=AREA,
    reduces=CLOSED,
)


@closed.proof
def by_the_ring_lemma(step):
    seen = axis.subs(u_i, t)

    def ready(branch, distance):
        below_the_axis(branch, x)
        branch.fact(axis**2, u_i**2, alpha**2 * (1 - u_i) * (1 + u_i))
        branch.fact(seen**2, t**2, alpha**2 * (1 - t) * (1 + t), inside=(t, distance, 1))

    superpose(step, SigmaGGX(u_i, alpha), u_i, ggx(x, alpha), second, SHARE, -seen / (2 * t), low=0, ready=ready)


if __name__ == "__main__":
    paper.tell()
