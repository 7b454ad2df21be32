"""Section 2.1.1: powers of the inclination, odd and even, and what the odd ones say about every distribution."""

from sympy import Abs, Function, Heaviside, Integral, pi, sqrt, symbols

from derivations.deon2016.dirac_ring import INSTANCES
from xsec_sym.exact import RingCrossSection, RingMean
from xsec_sym.proof import Source, interval, parity

paper = Source("deon2016", section="2.1.1")

u, u_i, x, u_n = symbols("u u_i x u_n", real=True)
p = symbols("p", integer=True, nonnegative=True)
n = symbols("n_p", integer=True, nonnegative=True)  # p = 2 n

VIEWER = interval(u_i, -1, 1)
READING = "D = u^p per steradian; p a natural number, as in a polynomial (for p < 0 the integral need not exist)"
CLOSED = ("deon2016:9", "deon2016:10", "deon2016:11", "deon2016:12")
EDGES = {u: [-sqrt(1 - u_i**2), 0, sqrt(1 - u_i**2)]}

odd_power = paper.claim(
    "16",
    "an odd power of the inclination has a cross-section linear in u_i",
    left=Integral(RingCrossSection(u, u_i) * u**p, (u, -1, 1)),
    printed=2 * pi / (p + 2) * u_i,
    where=[VIEWER, parity(p, odd=True)],
    reading=READING,
    reduces=CLOSED,
    points=EDGES,
)


@odd_power.proof
def odd_row(step):
    """The odd row of Table 1, with the integration variable renamed."""
    step.substitute(x, x, -1, 1).lemma("deon2016:T1.odd.s", {u: u_i})


first_component_even = paper.claim(
    "17",
    "the first component of an even power",
    left=Integral(RingMean(u, u_i) * u**p, (u, -1, 1)),
    printed=pi / (p / 2 + 1) * Abs(u_i),
    where=[VIEWER, parity(p, even=True)],
    reading=READING,
    reduces=CLOSED,
    points=EDGES,
)


@first_component_even.proof
def even_row(step):
    step.substitute(x, x, -1, 1).lemma("deon2016:T1.even.s1", {u: u_i})


part_of_the_third = paper.claim(
    "18",
    "the step term of the third component, for an even power",
    left=Integral(-2 * pi * u * u_i * Heaviside(u * u_i) * u**p, (u, -sqrt(1 - u_i**2), sqrt(1 - u_i**2))),
    printed=(-1) ** (p / 2) * pi * (u_i - 1) ** (p / 2 + 1) / (p / 2 + 1) * Abs(u_i),
    corrected=(-1) ** (p / 2) * pi * (u_i**2 - 1) ** (p / 2 + 1) / (p / 2 + 1) * Abs(u_i),
    edit="square the u_i in the bracket: (u_i^2 - 1) for (u_i - 1)",
    where=[VIEWER, parity(p, even=True)],
    reading=READING,
)


@part_of_the_third.proof
def one_half_of_the_band(step):
    """The step keeps the half of the band on the viewer's side."""
    for branch in step.cases(u_i):
        if not branch.goal.piece.facts_about(u_i):
            continue
        branch.split(0)
        branch.antiderivative(-2 * pi * u_i * u ** (2 * n + 2) / (2 * n + 2))


D = Function("D", real=True)

even_plus_linear = paper.claim(
    "claim.even-plus-linear",
    "the cross-section of any distribution is an even function plus a linear function of u_i",
    left=Integral(RingCrossSection(x, u_i) * D(x), (x, -1, 1)) - Integral(RingCrossSection(x, -u_i) * D(x), (x, -1, 1)),
    printed=2 * pi * u_i * Integral(x * D(x), (x, -1, 1)),
    where=[VIEWER],
    instances={D: INSTANCES},
    reduces=CLOSED,
    points={x: [-sqrt(1 - u_i**2), 0, sqrt(1 - u_i**2)]},
    reading="of any integrable distribution with azimuthal symmetry: opposite views differ by a linear function; "
    "that function is 0 when the mean cosine is",
    statement=True,
)


@even_plus_linear.proof
def clamp_cancels(step):
    """Two integrals over the same range make one; in it, opposite views of each ring differ by 2 pi u x."""
    both = (RingCrossSection(x, u_i) - RingCrossSection(x, -u_i)) * D(x)
    step.rewrite(step.left, Integral(both, (x, -1, 1)), because="both integrals exist")
    step.lemma("xsec:ring-odd-part", {x: x, u: u_i})


if __name__ == "__main__":
    paper.tell()
