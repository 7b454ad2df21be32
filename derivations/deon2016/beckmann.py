"""Section 2.2: Beckmann's distribution, its cross-section, and its second component.

The cross-section is derived twice: from the distribution of slopes, as in the paper, and from the second component by
the ring lemma.
"""

from sympy import Heaviside, Integral, Max, Piecewise, erf, exp, pi, sqrt, symbols

from derivations.deon2016.cells import AT, CLOSED, u, x
from xsec_sym.exact import AZIMUTH, NormalsBeckmann, RingSpread, SigmaBeckmann, beckmann
from xsec_sym.proof import Source, interval
from sympy import oo

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

if __name__ == "__main__":
    paper.tell()
