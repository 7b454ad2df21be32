"""Table 1: the three Dirac components and the cross-section of ten distributions, forty cells, blanks filled.

Columns: s1, s2, s3 integrate one component of the ring against D, s is their sum, the cross-section. Every s2 is one
antiderivative in the inclination x; every s3 follows from s2 by the ring lemma, with one antiderivative in t; every s
is a sum. Cells that are finite seen from one side and infinite from the other are split by the sign of u.
"""

from itertools import pairwise

from sympy import Abs, Integral, Ne, Piecewise, Rational, Sum, asin, binomial, log, oo, pi, sqrt, symbols

from derivations.extensions.ring_lemma import shut
from xsec_sym.exact import RingCrossSection, RingMean, RingSpread, RingTilt
from xsec_sym.proof import Source, interval, parity

paper = Source("deon2016", section="2.1.1, Table 1")

u, x, t, u_n = symbols("u x t u_n", real=True)
p, k = symbols("p k", integer=True, nonnegative=True)
n = symbols("n_p", integer=True, nonnegative=True)  # p = 2 n in the even row, 2 n + 1 in the odd row
j = symbols("j", integer=True, positive=True)

AT = {u: x, u_n: u}
COMPONENT = {"s1": RingMean, "s2": RingSpread, "s3": RingTilt, "s": RingCrossSection}
CLOSED = ("deon2016:9", "deon2016:10", "deon2016:11", "deon2016:12")
SPHERE = [interval(u, -1, 1)]
SIDES = {"neg": [interval(u, -1, 0, open="right")], "zero": [], "pos": [interval(u, 0, 1, open="left")]}
READING = "D per steradian; a column's integral runs over all inclinations"

facing = 1 / (1 + x)  # infinite at the pole x = -1, which only u < 0 sees
away = 1 / (1 - x)
steep = 1 / (1 - x) ** 2
bowl = 1 / (1 + x**2)

tau = sqrt(1 - u**2)
y = 1 - u**2
kernel = 1 / (t**2 * (1 - t**2))


def cell(row, column, distribution, printed=None, corrected=None, where=SPHERE, edit="", side="", parity=()):
    """One cell: a component of the ring, integrated against the row's distribution."""
    viewer = 0 if side == "zero" else u
    return paper.claim(
        f"T1.{row}.{column}" + (f".{side}" if side else ""),
        f"Table 1: {distribution}, column {column}"
        + (f", u {dict(neg='< 0', zero='= 0', pos='> 0')[side]}" if side else ""),
        left=Integral(COMPONENT[column](x, viewer) * distribution, (x, -1, 1)),
        printed=printed,
        corrected=corrected,
        where=[*(SIDES[side] if side else where), *parity],
        edit=edit,
        reading=READING,
        reduces=CLOSED,
        points={x: [-tau, 0, tau]} if side != "zero" else {},
    )


def split_cell(row, column, distribution, printed=None):
    paper.whole(f"T1.{row}.{column}", f"Table 1: {distribution}, column {column}",
                [f"T1.{row}.{column}.{side}" for side in SIDES], printed=printed,
                left=Integral(COMPONENT[column](x, u) * distribution, (x, -1, 1)), reading=READING)  # fmt: skip


def mean(claim, primitive):
    """s1: the half of the sphere on the viewer's side, by an antiderivative of 2 pi u x D(x)."""

    @claim.proof
    def one_half_counts(step):
        for branch in step.cases(u):
            if branch.is_empty:
                branch.vacuous()
            elif branch.goal.piece.facts_about(u):
                branch.lemma("deon2016:10", AT).split(0).antiderivative(2 * pi * u * primitive)
            else:
                branch.lemma("deon2016:10", {u: x, u_n: 0})


def spread(claim, across):
    """s2: cut at the edges of the band |x| < sqrt(1 - u^2), which shrinks to nothing at u = 1 and u = -1."""

    @claim.proof
    def band_only(step):
        step.lemma("deon2016:11", AT)
        for above in step.cases(1 - u, u, 1, -1):
            if not shut(above):
                for branch in above.cases(1 + u, u, -1):
                    if not shut(branch):
                        branch.fact(1 - u**2, (1 - u) * (1 + u))
                        for low, high in ((-1, -tau), (-tau, tau), (tau, 1)):
                            branch.fact(1 - u**2 - x**2, (tau - x) * (tau + x), inside=(x, low, high))
                        branch.split(-tau, tau)
                        across(branch)


def tilt(claim, distribution, s2, finish, here=None, at_equator=lambda step: None):
    """s3: the ring lemma, -s2 + |u| times the integral of s2(t) / (t^2 (1 - t^2)) from |u| to 1."""

    @claim.proof
    def from_the_second_component(step):
        for branch in step.cases(u):
            if branch.is_empty:
                branch.vacuous()
            elif not branch.goal.piece.facts_about(u):
                branch.lemma("deon2016:12", {u: x, u_n: 0})
                at_equator(branch)
            else:
                distance = u if branch.goal.piece.sign(u) == "+" else -u
                inner = Integral(RingSpread(x, t) * kernel, (t, Abs(u), 1))
                branch.lemma("xsec:ring-lemma.third", {x: x, u: u})
                branch.linear(-RingSpread(x, u) * distribution, Abs(u) * distribution * inner)
                branch.exchange(next(i for i in branch.integrals if i.has(t)), by="deon2016:11", mapping={u: x, u_n: t})
                branch.lemma((here or {}).get(distance / u, s2), {u: u}).lemma(s2, {u: t}).settle()
                finish(branch, distance)


def total(claim, *columns):
    """s: the sum of the three components."""

    @claim.proof
    def sum_of_columns(step):
        viewer = u if step.left.has(u) else 0
        parts = [COMPONENT[c](x, viewer) for c in ("s1", "s2", "s3")]
        distribution = step.left.function / RingCrossSection(x, viewer)
        step.lemma("deon2016:9", {u: x, u_n: viewer}).linear(*(part * distribution for part in parts))
        for column in columns:
            step.lemma(column, {u: viewer})


# --- even powers, p = 0, 2, 4, ... ---------------------------------------------------------------------

EVEN, ODD = (parity(p, even=True),), (parity(p, odd=True),)
BARS = "put back the bars: |u| for u"
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


# --- 1 / (1 + u) ----------------------------------------------------------------------------------------

s1_pos = cell("inv1p", "s1", facing, corrected=2 * pi * u * (1 - log(2)), side="pos")
s1_zero = cell("inv1p", "s1", facing, corrected=0, side="zero")
s1_neg = cell("inv1p", "s1", facing, corrected=oo, side="neg")
split_cell("inv1p", "s1", facing)
s2_inv1p = cell("inv1p", "s2", facing, 2 * pi * (1 - u), 2 * pi * (1 - Abs(u)), edit=BARS)
third_reciprocal = Piecewise((2 * pi * Abs(u) * log(2 * Abs(u) / (1 + Abs(u))), Ne(u, 0)), (0, True))
s3_inv1p = cell("inv1p", "s3", facing, corrected=third_reciprocal)
s_pos = cell("inv1p", "s", facing, corrected=2 * pi * (1 - u * log(1 + 1 / u)), side="pos")
s_zero = cell("inv1p", "s", facing, corrected=2 * pi, side="zero")
s_neg = cell("inv1p", "s", facing, corrected=oo, side="neg")
split_cell("inv1p", "s", facing)

mean(s1_pos, x - log(1 + x))


@s1_zero.proof
def nothing_at_the_equator(step):
    step.lemma("deon2016:10", {u: x, u_n: 0})


@s1_neg.proof
def pole_in_view(step):
    step.lemma("deon2016:10", AT).split(-Rational(1, 2), 0)
    step.diverges(-pi * u / (1 + x), -pi * u, end="low", integral=step.over(-1, -Rational(1, 2)))


def chord(sign):
    """Both inverse sines run from -pi/2 to pi/2 across the band."""

    def across(step):
        for branch in step.cases(u):
            if not branch.goal.piece.facts_about(u):
                branch.antiderivative(2 * asin(x) + 2 * sign * sqrt(1 - x**2))
                continue
            seen = branch.goal.piece.sign(u)
            distance = u if seen == "+" else -u
            inverse = (tau**2 + sign * x) / (tau * (1 + sign * x))
            branch.fact(1 - tau, u**2 / (1 + tau))
            branch.fact(1 - inverse, (1 - tau) * (tau - sign * x) / (tau * (1 + sign * x)), inside=(x, -tau, tau))
            branch.fact(1 + inverse, (1 + tau) * (tau + sign * x) / (tau * (1 + sign * x)), inside=(x, -tau, tau))
            branch.antiderivative(
                2 * asin(x / tau) + 2 * sign * sqrt(tau**2 - x**2) - 2 * sign * distance * asin(inverse)
            )

    return across


spread(s2_inv1p, chord(1))


def reciprocal_third(step, distance):
    step.antiderivative(2 * pi * (-1 / t - log(t) + log(1 + t)))


tilt(s3_inv1p, facing, s2_inv1p, reciprocal_third)
total(s_pos, s1_pos, s2_inv1p, s3_inv1p)
total(s_zero, s1_zero, s2_inv1p, s3_inv1p)


@s_neg.proof
def pole_in_view_still(step):
    """The ring's cross-section is at least its first component."""
    above_the_mean(step, facing, -pi * u / (1 + x), pi * u * (2 * x + 1) / (1 + x), (-1, -Rational(1, 2), 0, 1))


def above_the_mean(step, distribution, minorant, excess, cuts):
    """The ring lemma adds something not negative to the mean, and the mean alone exceeds a divergent minorant."""
    step.lemma("xsec:ring-lemma", {x: x, u: u}).settle()
    (added,) = (i for i in step.left.atoms(Integral) if i.limits[0][0] == t)
    for low, high in pairwise(cuts):
        step.fact(added, inside=(x, low, high), by="deon2016:11", mapping={u: x, u_n: t})
    end, pole = ("low", cuts[:2]) if distribution == facing else ("high", cuts[-2:])
    order = 1 if distribution == steep else 0
    gain = Abs(u) * added * distribution
    step.fact(2 * pi * u * x * distribution + gain - minorant, excess, gain, inside=(x, *pole))
    step.split(*cuts[1:-1])
    step.diverges(minorant, Abs(u) * pi, order=order, end=end, integral=step.over(*pole))


# --- 1 / (1 - u): the same seen from the other side -------------------------------------------------------

t1_pos = cell("inv1m", "s1", away, corrected=oo, side="pos")
t1_zero = cell("inv1m", "s1", away, corrected=0, side="zero")
t1_neg = cell("inv1m", "s1", away, corrected=-2 * pi * u * (1 - log(2)), side="neg")
split_cell("inv1m", "s1", away)
s2_inv1m = cell("inv1m", "s2", away, 2 * pi * (1 - u), 2 * pi * (1 - Abs(u)), edit=BARS)
s3_inv1m = cell("inv1m", "s3", away, corrected=third_reciprocal)
t_pos = cell("inv1m", "s", away, corrected=oo, side="pos")
t_zero = cell("inv1m", "s", away, corrected=2 * pi, side="zero")
t_neg = cell("inv1m", "s", away, corrected=2 * pi * (1 + u * log(1 - 1 / u)), side="neg")
split_cell("inv1m", "s", away)

mean(t1_neg, -x - log(1 - x))
t1_zero.proof(nothing_at_the_equator)


@t1_pos.proof
def near_pole_in_view(step):
    step.lemma("deon2016:10", AT).split(0, Rational(1, 2))
    step.diverges(pi * u / (1 - x), pi * u, integral=step.over(Rational(1, 2), 1))


spread(s2_inv1m, chord(-1))
tilt(s3_inv1m, away, s2_inv1m, reciprocal_third)
total(t_neg, t1_neg, s2_inv1m, s3_inv1m)
total(t_zero, t1_zero, s2_inv1m, s3_inv1m)


@t_pos.proof
def near_pole_in_view_still(step):
    above_the_mean(step, away, pi * u / (1 - x), pi * u * (2 * x - 1) / (1 - x), (-1, 0, Rational(1, 2), 1))


# --- 1 / (1 - u)^2: at u = 0 even the second component is infinite ----------------------------------------

r1_pos = cell("inv1m2", "s1", steep, corrected=oo, side="pos")
r1_zero = cell("inv1m2", "s1", steep, corrected=0, side="zero")
r1_neg = cell("inv1m2", "s1", steep, corrected=-2 * pi * u * (log(2) - Rational(1, 2)), side="neg")
split_cell("inv1m2", "s1", steep)
r2_pos = cell("inv1m2", "s2", steep, 2 * pi * (-1 + 1 / u), side="pos")
r2_zero = cell("inv1m2", "s2", steep, corrected=oo, side="zero")
r2_neg = cell("inv1m2", "s2", steep, 2 * pi * (-1 + 1 / u), 2 * pi * (-1 + 1 / Abs(u)), edit=BARS, side="neg")
split_cell("inv1m2", "s2", steep, printed=2 * pi * (-1 + 1 / u))
r3 = cell("inv1m2", "s3", steep,
          corrected=Piecewise((pi * (Abs(u) - 1 / Abs(u) + 2 * Abs(u) * log((1 + Abs(u)) / (2 * Abs(u)))), Ne(u, 0)),
                              (0, True)))  # fmt: skip
r_pos = cell("inv1m2", "s", steep, corrected=oo, side="pos")
r_zero = cell("inv1m2", "s", steep, corrected=oo, side="zero")
r_neg = cell("inv1m2", "s", steep, corrected=-pi * (2 + 1 / u + 2 * u * log(1 - 1 / u)), side="neg")
split_cell("inv1m2", "s", steep)

mean(r1_neg, 1 / (1 - x) + log(1 - x))
r1_zero.proof(nothing_at_the_equator)


@r1_pos.proof
def pole_dominates(step):
    step.lemma("deon2016:10", AT).split(0, Rational(1, 2))
    step.diverges(pi * u / (1 - x) ** 2, pi * u, order=1, integral=step.over(Rational(1, 2), 1))


def steep_chord(step):
    """As for 1 / (1 - u), once more integrated by parts."""
    for branch in step.cases(u):
        if branch.is_empty:
            branch.vacuous()
            continue
        distance = u if branch.goal.piece.sign(u) == "+" else -u
        inverse = (x - tau**2) / (tau * (1 - x))
        branch.fact(1 - tau, u**2 / (1 + tau))
        branch.fact(1 - inverse, (1 + tau) * (tau - x) / (tau * (1 - x)), inside=(x, -tau, tau))
        branch.fact(1 + inverse, (1 - tau) * (tau + x) / (tau * (1 - x)), inside=(x, -tau, tau))
        branch.antiderivative(2 * sqrt(tau**2 - x**2) / (1 - x) - 2 * asin(x / tau) + 2 / distance * asin(inverse))


spread(r2_pos, steep_chord)
spread(r2_neg, steep_chord)


def edge_at_the_pole(step):
    """sqrt(1 - x^2) >= 1 - x on (0, 1), so the integrand lies above 2 / (1 - x)."""
    step.lemma("deon2016:11", {u: x, u_n: 0})
    gap = sqrt(1 - x**2) - (1 - x)
    step.fact(gap, 2 * x * (1 - x) / (sqrt(1 - x**2) + 1 - x), inside=(x, 0, 1))
    step.fact((2 * sqrt(1 - x**2) - 2 * (1 - x)) / (1 - x) ** 2, 2 * gap / (1 - x) ** 2, inside=(x, 0, 1))
    step.split(0)
    step.diverges(2 / (1 - x), 2, integral=step.over(0, 1))


r2_zero.proof(edge_at_the_pole)


def steep_third(step, distance):
    step.antiderivative(2 * pi * (-1 / (2 * t**2) + 1 / t + log(t) - log(1 + t)))


tilt(r3, steep, r2_pos, steep_third, here={-1: r2_neg})
total(r_neg, r1_neg, r2_neg, r3)


@r_pos.proof
def pole_dominates_still(step):
    above_the_mean(step, steep, pi * u * steep, pi * u * (2 * x - 1) * steep, (-1, 0, Rational(1, 2), 1))


@r_zero.proof
def second_component_alone(step):
    step.lemma("xsec:ring-lemma.zero")
    edge_at_the_pole(step)


# --- 1 / (1 + u^2) ----------------------------------------------------------------------------------------

w = sqrt(2 - u**2)
q1 = cell("inv1pu2", "s1", bowl, pi * u * log(2), pi * Abs(u) * log(2), edit=BARS)
q2 = cell("inv1pu2", "s2", bowl, 2 * pi * (-1 + sqrt(2 - u**2)))
q3 = cell("inv1pu2", "s3", bowl, corrected=2 * pi * Abs(u) * log((1 + Abs(u)) / (Abs(u) + w)))
q = cell("inv1pu2", "s", bowl,
         corrected=2 * pi * (w - 1 + Abs(u) * log(sqrt(2) * (1 + Abs(u)) / (Abs(u) + w))))  # fmt: skip

mean(q1, log(1 + x**2) / 2)


def bowl_chord(step):
    inverse = x * w / (tau * sqrt(1 + x**2))
    step.fact(1 - inverse**2, (tau - x) * (tau + x) / (tau**2 * (1 + x**2)), inside=(x, -tau, tau))
    step.antiderivative(-2 * asin(x / tau) + 2 * w * asin(inverse))


spread(q2, bowl_chord)


def bowl_third(step, distance):
    root = sqrt(2 - t**2)
    step.fact(2 - t**2, (1 - t) * (1 + t), 1, inside=(t, distance, 1))
    step.antiderivative(2 * pi * ((1 - root) / t - log((1 + t) / (t + root))))


tilt(q3, bowl, q2, bowl_third)
total(q, q1, q2, q3)


if __name__ == "__main__":
    paper.tell()
