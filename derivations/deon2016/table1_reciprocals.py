"""Table 1, the reciprocals: 1/(1+u), 1/(1-u), 1/(1-u)^2, infinite at a pole that only one side sees, and 1/(1+u^2)."""

from itertools import pairwise

from sympy import Abs, Integral, Ne, Piecewise, Rational, asin, log, oo, pi, sqrt

from derivations.deon2016.cells import AT, BARS, Cells, mean, spread, t, tau, tilt, total, u, u_n, x
from xsec_sym.proof import Source

paper = Source("deon2016", section="2.1.1, Table 1")
cell, split_cell = Cells(paper).cell, Cells(paper).split_cell

facing = 1 / (1 + x)  # infinite at the pole x = -1, which only u < 0 sees
away = 1 / (1 - x)
steep = 1 / (1 - x) ** 2
bowl = 1 / (1 + x**2)


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
