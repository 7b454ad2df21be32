"""One lemma behind every axisymmetric cross-section: it follows from its second Dirac component alone.

On the sphere, the clamped cosine solves a Legendre equation whose source is a line on the great circle. Reduction of
order turns that into a single integral. Here the lemma is proved for one ring, by differentiating the closed form;
superposition then carries it to every distribution.
"""

from itertools import pairwise

from sympy import Abs, Function, Integral, acos, exp, pi, sqrt, symbols

from xsec_sym.exact import RingCrossSection, RingSpread, RingTilt
from xsec_sym.proof import Source, interval

project = Source("xsec", section="ring lemma")

u, x, y, t, u_n = symbols("u x y t u_n", real=True)
SQUARE = [interval(x, -1, 1), interval(u, -1, 1)]
CLOSED = ("deon2016:9", "deon2016:10", "deon2016:11", "deon2016:12")  # the ring without an integral
AT = {u: x, u_n: u}  # the ring's first argument is the inclination x of the normals, as in Table 1

rim = sqrt(1 - x**2)
kernel = 1 / (t**2 * (1 - t**2))
primitive = -2 * sqrt(1 - t**2 - x**2) / t - 2 * x * acos(-t * x / (sqrt(1 - t**2) * rim))

third = project.claim(
    "ring-lemma.third",
    "the third component of a ring follows from the second",
    left=RingTilt(x, u),
    corrected=-RingSpread(x, u) + Abs(u) * Integral(RingSpread(x, t) * kernel, (t, Abs(u), 1)),
    where=[*SQUARE, (u > 0) | (u < 0)],
    reduces=CLOSED,
)


@third.proof
def differentiate_the_closed_form(step):
    """Up to the rim the closed form of the ring, over t, is a primitive of sigma_2 / (t^2 (1 - t^2))."""
    for first in step.cases(u):
        if first.is_empty:
            first.vacuous()
            continue
        distance = u if first.goal.piece.sign(u) == "+" else -u
        first.lemma("deon2016:12", AT).swap().lemma("deon2016:11", AT).lemma("deon2016:11", {u: x, u_n: t})
        for branch in first.cases(x):
            if branch.goal.piece.facts_about(x):
                root = sqrt(1 - x**2) * (distance / u)
                for where, position in enumerate(branch.cases(1 - x**2 - u**2, u, root, -(u + root))):
                    up_to_the_rim(position, where, distance if where < 2 else rim)
            else:
                seen_edge_on(branch, distance / u)


def seen_edge_on(step, pole):
    """x = 0: the rim is the pole, where the range of t ends."""
    for where, branch in enumerate(step.cases(1 - u**2, u, pole, -(u + pole))):
        if where == 1:
            branch.vacuous()
        elif where == 0:
            branch.settle().split()
            branch.antiderivative(primitive.subs(x, 0))


def up_to_the_rim(step, where, distance):
    """Cut the integral at the rim if it lies inside; beyond it sigma_2 is 0."""
    step.settle()
    if where == 0:
        step.fact(rim - distance, (1 - x**2 - u**2) / (rim + distance))
        step.fact(1 - x**2 - t**2, (rim - t) * (rim + t), inside=(t, distance, rim))
        step.fact(1 - x**2 - t**2, -(t - rim) * (t + rim), inside=(t, rim, 1))
        step.split(rim)
        step.antiderivative(primitive)
    elif where == 1:
        step.fact(1 - x**2 - t**2, (1 - x**2 - u**2), -(t - distance) * (t + distance), inside=(t, distance, 1))
        step.split()
    else:
        step.fact(1 - x**2 - t**2, -(t - rim) * (t + rim), inside=(t, rim, 1))
        step.split()


lemma = project.claim(
    "ring-lemma",
    "the cross-section of a ring, from its mean and its second component",
    left=RingCrossSection(x, u),
    corrected=pi * u * x + Abs(u) * (pi * Abs(x) + Integral(RingSpread(x, t) * kernel, (t, Abs(u), 1))),
    where=[*SQUARE, (u > 0) | (u < 0)],
    reduces=CLOSED,
    reading="D = delta(x - inclination) per steradian; at u = 0 the cross-section is the second component itself",
)


@lemma.proof
def add_the_mean(step):
    """The first component is (u x + |u x|) pi; the second cancels."""
    for first in step.cases(u):
        if first.is_empty:
            first.vacuous()
            continue
        first.lemma("deon2016:9", AT).lemma(third, {x: x, u: u}).lemma("deon2016:10", AT)
        for branch in first.cases(x):
            branch.close()


at_zero = project.claim(
    "ring-lemma.zero",
    "seen from the equator only the second component is left",
    left=RingCrossSection(x, 0),
    corrected=RingSpread(x, 0),
    where=[interval(x, -1, 1)],
)


@at_zero.proof
def nothing_else(step):
    step.lemma("deon2016:9", {u: x, u_n: 0}).lemma("deon2016:10", {u: x, u_n: 0}).lemma("deon2016:12", {u: x, u_n: 0})


odd_part = project.claim(
    "ring-odd-part",
    "opposite views of a ring differ by a linear function",
    left=RingCrossSection(x, u) - RingCrossSection(x, -u),
    corrected=2 * pi * u * x,
    where=SQUARE,
)


@odd_part.proof
def clamp_cancels(step):
    """max(0, c) - max(0, -c) = c: what one view clamps away the other sees."""
    opposite = {u: x, u_n: -u}
    step.lemma("deon2016:9", AT).lemma("deon2016:9", opposite)
    for name in ("10", "11", "12"):
        step.lemma(f"deon2016:{name}", AT).lemma(f"deon2016:{name}", opposite)
    for first in step.cases(u):
        for second in first.cases(x):
            if not (second.goal.piece.facts_about(u) and second.goal.piece.facts_about(x)):
                second.close()
                continue
            root = sqrt(1 - x**2) * (1 if second.goal.piece.sign(u) == "+" else -1)
            for position in second.cases(1 - x**2 - u**2, u, root, -(u + root)):
                position.close()


# --- from one ring to every distribution ---------------------------------------------------------------

D = Function("D", real=True, nonnegative=True)
SEEN = {D: (lambda v: v**2, lambda v: exp(v), lambda v: 1 / (2 - v), lambda v: 1 / (1 + v**2))}

tau = sqrt(1 - u**2)

second = project.claim(
    "second-component",
    "the second component of a distribution is an integral over its band",
    left=Integral(RingSpread(x, u) * D(x), (x, -1, 1)),
    corrected=(1 - u**2) * Integral(2 * sqrt(1 - y**2) * D(tau * y), (y, -1, 1)),
    where=[interval(u, -1, 1)],
    instances=SEEN,
    reduces=CLOSED,
    points={x: [-tau, tau]},
)


@second.proof
def stretched_to_unit_width(step):
    over_the_band(step, lambda branch: branch.substitute(y, tau * y, -1, 1))


def over_the_band(step, across, low=-1, viewer=u):
    """Cut an integral of the second component at the edges of the band, which shrinks to nothing at the poles."""
    edge = sqrt(1 - viewer**2)
    ends = (-1, -edge, edge, 1) if low == -1 else (low, edge, 1)
    step.lemma("deon2016:11", {u: x, u_n: viewer})
    for above in step.cases(1 - viewer, viewer, 1, -1):
        if not shut(above, viewer):
            for branch in above.cases(1 + viewer, viewer, -1):
                if not shut(branch, viewer):
                    branch.fact(1 - viewer**2, (1 - viewer) * (1 + viewer))
                    for here, there in pairwise(ends):
                        branch.fact(1 - viewer**2 - x**2, (edge - x) * (edge + x), inside=(x, here, there))
                    branch.split(*ends[1:-1])
                    across(branch)


def shut(step, viewer):
    """Whether a branch is done with: no point of the domain lies there, or the band has no width."""
    if step.is_empty:
        step.vacuous()
    elif not step.goal.piece.facts_about(viewer):
        step.split()
    else:
        return False
    return True


distribution = project.claim(
    "ring-lemma.distribution",
    "the cross-section of a distribution, from its mean cosine and its second component",
    left=Integral(RingCrossSection(x, u) * D(x), (x, -1, 1)),
    corrected=pi * u * Integral(x * D(x), (x, -1, 1))
    + Abs(u)
    * (
        pi * Integral(Abs(x) * D(x), (x, -1, 1))
        + Integral(2 / t**2 * Integral(sqrt(1 - y**2) * D(sqrt(1 - t**2) * y), (y, -1, 1)), (t, Abs(u), 1))
    ),
    where=[interval(u, -1, 1), (u > 0) | (u < 0)],
    instances=SEEN,
    reduces=CLOSED,
    points={x: [-sqrt(1 - u**2), 0, sqrt(1 - u**2)]},
    reading="D per steradian, not negative and integrable against |x|; a signed D by its positive and negative part. "
    "The exchange of integrals is Tonelli's: nothing else is assumed",
)


@distribution.proof
def superpose(step):
    for first in step.cases(u):
        if first.is_empty:
            first.vacuous()
            continue
        distance = u if first.goal.piece.sign(u) == "+" else -u
        mass = D(x)
        inner = Integral(RingSpread(x, t) * kernel, (t, distance, 1))
        first.lemma(lemma, {x: x, u: u}).settle()
        first.linear(pi * u * x * mass, distance * pi * Abs(x) * mass, distance * mass * inner)
        nested = next(i for i in first.integrals if i.has(RingSpread))
        first.exchange(nested, by="deon2016:11", mapping={u: x, u_n: t}).lemma(second, {u: t})


if __name__ == "__main__":
    project.tell()
