"""Table 1, the powers: 1, u, u^2, u^4 and every even and odd power at once.

For even p the cross-section turns out to be the binomial series of |u| = sqrt(1 - (1 - u^2)), cut off after p/2 terms.
"""

from sympy import Abs, Rational, Sum, asin, binomial, pi, sqrt, symbols

from derivations.deon2016.cells import AT, BARS, Cells, mean, spread, t, tau, tilt, total, u, u_n, x
from xsec_sym.proof import Source, parity

paper = Source("deon2016", section="2.1.1, Table 1")
cell = Cells(paper).cell

p = symbols("p", integer=True, nonnegative=True)
n = symbols("n_p", integer=True, nonnegative=True)  # p = 2 n in the even row, 2 n + 1 in the odd row
j = symbols("j", integer=True, positive=True)
y = 1 - u**2


# --- even powers, p = 0, 2, 4, ... ---------------------------------------------------------------------

EVEN, ODD = (parity(p, even=True),), (parity(p, odd=True),)
amplitude = pi * binomial(2 * n, n) / 4**n / (n + 1)  # of s2: amplitude (1 - u^2)^(n + 1)
coefficient = binomial(2 * j, j) / 4**j / (1 - 2 * j)  # of (1 - u^2)^j in |u| = sqrt(1 - (1 - u^2))


def truncated(order, of=y):
    """The binomial series of sqrt(1 - y) up to y^order."""
    return 1 + Sum(coefficient * of**j, (j, 1, order))


s1_even = cell("even", "s1", x**p, 2 * pi / (p + 2) * u, 2 * pi / (p + 2) * Abs(u), edit=BARS, parity=EVEN)
s2_even = cell(
    "even",
    "s2",
    x**p,
    printed=(-1) ** (p / 2 + 1) * pi * binomial(p, p / 2) * 2 ** (-p) / (p / 2 + 1) * (-1 + u**2) ** (p / 2 + 1),
    parity=EVEN,
)
s3_even = cell(
    "even",
    "s3",
    x**p,
    corrected=2 * pi / (p + 2) * (truncated(p / 2) - Abs(u))
    - pi * binomial(p, p / 2) / 2**p / (p / 2 + 1) * y ** (p / 2 + 1),
    parity=EVEN,
)
s_even = cell("even", "s", x**p, parity=EVEN, corrected=2 * pi / (p + 2) * truncated(p / 2))

mean(s1_even, x ** (2 * n + 2) / (2 * n + 2))


def induction_in_x(step):
    """x^(2n+1) (tau^2 - x^2)^(3/2) vanishes at both edges of the band and ties neighbours together."""
    root = sqrt(y - x**2)
    step.recurrence(
        n,
        amplitude * y ** (n + 1),
        base=x * root + y * asin(x / tau),
        primitive=x ** (2 * n + 1) * root**3,
        following=-(n + 2),
        present=(n + Rational(1, 2)) * y,
    )


spread(s2_even, induction_in_x)


def induction_in_t(step, distance):
    step.recurrence(
        n,
        4**n / binomial(2 * n, n) * (truncated(n) - distance) / distance,
        base=-1 / t,
        primitive=(1 - t**2) ** (n + 1) / t,
        following=2 * n + 1,
        present=-2 * (n + 1),
    )


def even_third(step, distance):
    inner = step.integrals[0]
    step.linear(amplitude * (1 - t**2) ** n / t**2, integral=inner)
    induction_in_t(step, distance)


def partial_sums(step):
    """At u = 0 the partial sums of the series telescope."""
    step.swap().telescope(binomial(2 * j, j) / 4**j)


tilt(s3_even, x ** (2 * n), s2_even, even_third, at_equator=partial_sums)
total(s_even, s1_even, s2_even, s3_even)


# --- odd powers ----------------------------------------------------------------------------------------

s1_odd = cell("odd", "s1", x**p, 2 * pi / (p + 2) * u, parity=ODD)
s2_odd = cell("odd", "s2", x**p, 0, parity=ODD)
s3_odd = cell("odd", "s3", x**p, 0, parity=ODD)
s_odd = cell("odd", "s", x**p, 2 * pi / (p + 2) * u, parity=ODD)

mean(s1_odd, x ** (2 * n + 3) / (2 * n + 3))


def halves_cancel(step):
    """The band is symmetric and the component even in x, so an odd power integrates to 0."""
    lower = step.over(-tau, 0)
    step.substitute(t, -t, tau, 0, lower)


@s2_odd.proof
def even_component(step):
    by_halves(step, "deon2016:11")


@s3_odd.proof
def even_component_too(step):
    by_halves(step, "deon2016:12")


def by_halves(step, component):
    for side in step.cases(u):
        if not side.goal.piece.facts_about(u):
            side.lemma(component, {u: x, u_n: 0})
            if side.left.has(sqrt(1 - x**2)):
                side.split(0).substitute(t, -t, 1, 0, side.over(-1, 0))
            continue
        side.lemma(component, AT)
        pole = 1 if side.goal.piece.sign(u) == "+" else -1
        for where, branch in enumerate(side.cases(1 - u**2, u, pole, -(u + pole))):
            if where == 1:
                branch.vacuous()
            elif where == 2:
                branch.split()
            else:
                for low, high in ((-1, -tau), (-tau, 0), (0, tau), (tau, 1)):
                    branch.fact(1 - u**2 - x**2, (tau - x) * (tau + x), inside=(x, low, high))
                branch.fact(1 - u**2 - t**2, (tau - t) * (tau + t), inside=(t, 0, tau))
                branch.split(-tau, 0, tau)
                halves_cancel(branch)


total(s_odd, s1_odd, s2_odd, s3_odd)


# --- 1, u, u^2, u^4: the even and odd rows at p = 0, 1, 2, 4 ---------------------------------------------


def special(claim, row, power):
    @claim.proof
    def from_the_general_row(step):
        step.lemma(row, {p: power})
        for branch in step.cases(u):
            branch.settle()


special(cell("1", "s1", x**0, pi * u, pi * Abs(u), edit=BARS), s1_even, 0)
special(cell("1", "s2", x**0, pi * (1 - u**2)), s2_even, 0)
special(cell("1", "s3", x**0, pi * (u**2 - u), pi * (u**2 - Abs(u)), edit=BARS), s3_even, 0)
special(cell("1", "s", x**0, pi), s_even, 0)

special(cell("u", "s1", x, 2 * pi / 3 * u), s1_odd, 1)
special(cell("u", "s2", x, 0), s2_odd, 1)
special(cell("u", "s3", x, 0), s3_odd, 1)
special(cell("u", "s", x, 2 * pi / 3 * u), s_odd, 1)

special(cell("u2", "s1", x**2, pi / 2 * u, pi / 2 * Abs(u), edit=BARS), s1_even, 2)
special(cell("u2", "s2", x**2, pi * (-1 + u**2) ** 2 / 4), s2_even, 2)
printed = -pi * (2 * u + u**4 - 3 * u**2) / 4
special(cell("u2", "s3", x**2, printed, -pi * (2 * Abs(u) + u**4 - 3 * u**2) / 4, edit=BARS), s3_even, 2)
special(cell("u2", "s", x**2, pi * (u**2 + 1) / 4), s_even, 2)

special(cell("u4", "s1", x**4, pi / 3 * u, pi / 3 * Abs(u), edit=BARS), s1_even, 4)
special(cell("u4", "s2", x**4, -pi * (-1 + u**2) ** 3 / 8), s2_even, 4)
special(cell("u4", "s3", x**4, corrected=pi * (3 * u**6 - 10 * u**4 + 15 * u**2 - 8 * Abs(u)) / 24), s3_even, 4)
special(cell("u4", "s", x**4, -pi * (u**4 - 6 * u**2 - 3) / 24), s_even, 4)


if __name__ == "__main__":
    paper.tell()
