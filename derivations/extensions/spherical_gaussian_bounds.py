"""How many terms of the Chebyshev series of `spherical_gaussian_series.py` are enough: a proved bound.

An inequality X >= 0 is the equation |X| = X.
"""

from sympy import Integral, Rational, Sum, besseli, exp, oo, pi, sin, symbols

from derivations.extensions.spherical_gaussian_series import WIDTH, coefficient, rate, weight, z
from xsec_sym.proof import Source, integers, interval

project = Source("xsec", section="spherical Gaussian, bounds")

y, psi = symbols("y psi", real=True)
j = symbols("j", integer=True, nonnegative=True)
n = symbols("n", integer=True, nonnegative=True)
N = symbols("N", integer=True, nonnegative=True)
half = Rational(1, 2)


def order_in(step):
    """The index that stands for j in the goal."""
    return min((f.args[0] for f in step.right.atoms(besseli)), key=lambda order: order.as_coeff_Add()[0])


# --- neighbours in order ---------------------------------------------------------------------------------

decrease = project.claim(
    "bessel-decrease",
    "how much a Bessel function exceeds the next one",
    left=besseli(j, z) - besseli(j + 1, z),
    corrected=exp(-z)
    * (besseli(j, 0) + Integral(exp(y) * (j * besseli(j, y) + (j + 1) * besseli(j + 1, y)) / y, (y, 0, z))),
    where=[WIDTH, integers(j)],
)


@decrease.proof
def growth_of_the_difference(step):
    m = order_in(step.swap().swap())
    step.swap().antiderivative(exp(y) * (besseli(m, y) - besseli(m + 1, y)))


ordered = project.inequality(
    "bessel-order", "a Bessel function is not smaller than the next one",
    besseli(j, z) - besseli(j + 1, z), where=[WIDTH, integers(j)],
)  # fmt: skip


@ordered.proof
def positive_parts(step):
    m = order_in(step)
    step.fact(step.right, by=decrease, mapping={z: z, j: m}).settle()


slack = project.claim(
    "bessel-slack",
    "how much the ratio of neighbours falls short of z / (z + j + 1/2)",
    left=z * besseli(j, z) - (z + j + half) * besseli(j + 1, z),
    corrected=exp(-z)
    * Integral(
        exp(y) * ((besseli(j, y) - besseli(j + 1, y)) / 2 + (j + half) * (j + 1) * besseli(j + 1, y) / y), (y, 0, z)
    ),
    where=[WIDTH, integers(j)],
)


@slack.proof
def growth_of_the_slack(step):
    m = order_in(step)
    step.swap().antiderivative(exp(y) * (y * besseli(m, y) - (y + m + half) * besseli(m + 1, y)))


ratio = project.inequality(
    "bessel-ratio", "the ratio of neighbours is at most z / (z + j + 1/2)",
    z * besseli(j, z) - (z + j + half) * besseli(j + 1, z), where=[WIDTH, integers(j)],
)  # fmt: skip


@ratio.proof
def positive_slack(step):
    m = order_in(step)
    gap = besseli(m, y) - besseli(m + 1, y)
    step.fact(gap, by=ordered, mapping={z: y, j: m}, inside=(y, 0, z), back=True)
    step.fact(step.right, by=slack, mapping={z: z, j: m}).settle()


fall = project.inequality(
    "bessel-fall", "from order N on, Bessel functions fall at least geometrically",
    besseli(N, z) * (z / (z + N + half)) ** n - besseli(N + n, z), where=[WIDTH, integers(N), integers(n)],
)  # fmt: skip


@fall.proof
def step_by_step(step):
    """Each step multiplies by at most z / (z + N + n + 1/2), which is at most the first of them."""
    first, index = (v for v in sorted(step.right.free_symbols - {z}, key=str))
    m = first + index
    q = z / (z + first + half)
    slack_there = z * besseli(m, z) - (z + m + half) * besseli(m + 1, z)
    share = 1 / (z + first + half)
    step.induct(index, q, share * slack_there, share * index * besseli(m + 1, z), by=ratio, mapping={z: z, j: m})


smaller = project.inequality(
    "sg-weight", "a weight of the series is at most 2 z I_j^2",
    2 * z * besseli(j, z) ** 2 - weight(j, z), where=[WIDTH, integers(j)],
)  # fmt: skip


@smaller.proof
def neighbours_in_order(step):
    m = order_in(step)
    here, after = besseli(m, z), besseli(m + 1, z)
    step.fact(here - after, by=ordered, mapping={z: z, j: m}, back=True)
    step.fact(step.right, z * (here - after) * (here + after), here * after).settle()


positive = project.inequality(
    "sg-weight-positive", "a weight of the series is not negative", weight(j, z), where=[WIDTH, integers(j)]
)


@positive.proof
def three_term_recurrence(step):
    """I_j I_(j+1) is z I_j (I_j - I_(j+2)) / (2 j + 2), so that z I_j^2 exceeds it."""
    m = order_in(step)
    here, after, next_but_one = (besseli(m + i, z) for i in range(3))
    share = z / (2 * (m + 1))
    step.fact(step.right, (2 * m + 1) * share * here**2, share * here * next_but_one, z * after**2).settle()


# --- the tail of the series --------------------------------------------------------------------------------

fraction = z / (z + N + half)
bound = 2 * z * besseli(N, z) ** 2 / ((2 * N + 1) * (1 - fraction**2))
partial = Sum(weight(j, z) * sin((2 * j + 1) * psi) / (2 * j + 1), (j, 0, N - 1))

truncated = project.inequality(
    "sg-tail",
    "the error of N terms of the series is at most 2 z I_N^2 / ((2 N + 1) (1 - q^2)), q = z / (z + N + 1/2)",
    bound,
    Integral(rate, (y, 0, psi)) / 2 - partial,
    where=[WIDTH, integers(N), interval(psi, -pi / 2, pi / 2)],
    reading="both sides change their sign with psi, so that this bounds the error's absolute value; in sg-chebyshev "
    "the sum has the factor u / sinh(2 z) and z = 1 / alpha^2, so the cross-section's error is at most |u| / sinh(2 z) "
    "times the bound; sg-terms says how many terms that makes",
)


@truncated.proof
def geometric(step):
    """A weight is at most 2 z I_(N+n)^2, which falls like q^(2 n) at least; a sine is at most 1."""
    (first,) = step.right.free_symbols - {z, psi}
    for _ in range(2):
        step.harmonics(n, coefficient, {z: z, j: n}).peel(first, next(t for t in step.left.atoms(Sum) if t.has(oo)))
        step.swap()
    m, q = first + n, fraction.subs(N, first)
    there = besseli(m, z)
    step.fact(besseli(first, z) * q**n - there, by=fall, mapping={z: z, N: first, n: n}, back=True)
    step.fact(2 * z * there**2 - weight(m, z), by=smaller, mapping={z: z, j: m}, back=True)
    step.fact(weight(m, z), by=positive, mapping={z: z, j: m}, back=True)
    start = 2 * z * besseli(first, z) ** 2 / (2 * first + 1)
    rest = next(t for t in step.right.atoms(Sum) if t.has(oo))
    for side in (1, -1):
        step.fact(
            start * q ** (2 * n) + side * rest.function / 2,
            2 * z / (2 * first + 1) * (besseli(first, z) * q**n - there) * (besseli(first, z) * q**n + there),
            2 * z * there**2 * 2 * n / ((2 * first + 1) * (2 * m + 1)),
            (2 * z * there**2 - weight(m, z)) / (2 * m + 1),
            weight(m, z) * (1 + side * sin((2 * m + 1) * psi)) / (2 * m + 1),
        )
    step.dominate(2 * start, q**2, rest).settle()


# --- how many terms ----------------------------------------------------------------------------------------

M = symbols("M", integer=True, nonnegative=True)
half_way = z / (z + M + half)

largest = project.inequality(
    "bessel-largest", "no Bessel function exceeds the first", besseli(0, z) - besseli(N, z), where=[WIDTH, integers(N)]
)


@largest.proof
def down_the_orders(step):
    (index,) = step.right.free_symbols - {z}
    drop = besseli(index, z) - besseli(index + 1, z)
    step.induct(index, 1, drop, by=ordered, mapping={z: z, j: index})


deep = project.inequality(
    "bessel-deep",
    "order 2 M lies below I_0 by the power M of z / (z + M + 1/2), so that M need only grow like sqrt(z)",
    besseli(0, z) * half_way**M - besseli(2 * M, z),
    where=[WIDTH, integers(M)],
)


@deep.proof
def down_the_second_half(step):
    (m,) = step.right.free_symbols - {z}
    q = half_way.subs(M, m)
    upper, lower = besseli(0, z) - besseli(m, z), besseli(m, z) * q**m - besseli(2 * m, z)
    step.fact(upper, by=largest, mapping={z: z, N: m}, back=True)
    step.fact(lower, by=fall, mapping={z: z, N: m, n: m}, back=True)
    step.fact(step.right, upper * q**m, lower).settle()


enough = project.inequality(
    "sg-terms",
    "after 2 M terms the tail is at most 2 z I_0^2 r^(2 M) / ((4 M + 1) (1 - q^2)), r = z / (z + M + 1/2)",
    2 * z * besseli(0, z) ** 2 * half_way ** (2 * M) / ((4 * M + 1) * (1 - fraction.subs(N, 2 * M) ** 2))
    - bound.subs(N, 2 * M),
    where=[WIDTH, integers(M)],
    reading="with I_0(z)^2 <= cosh(z)^2 the error of the cross-section after 2 M terms is at most "
    "coth(z) z r^(2 M) / ((4 M + 1) (1 - q^2)): some sqrt(z log(1 / tolerance)) terms, z = 1 / alpha^2",
)


@enough.proof
def square_of_the_deep_one(step):
    (m,) = step.right.free_symbols - {z}
    q, last = half_way.subs(M, m), fraction.subs(N, 2 * m)
    gap = besseli(0, z) * q**m - besseli(2 * m, z)
    step.fact(gap, by=deep, mapping={z: z, M: m}, back=True)
    share = 2 * z / ((4 * m + 1) * (1 - last**2))
    step.fact(step.right, share * gap * (besseli(0, z) * q**m + besseli(2 * m, z))).settle()


if __name__ == "__main__":
    project.tell()
