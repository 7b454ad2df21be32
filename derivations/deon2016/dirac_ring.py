"""Section 2.1: a flat surface, the Dirac ring, its three components, symmetry, normalisation, superposition.

The paper's D(u) is normalised per unit cosine in (5) and (7), while the ring family sigma_delta of (8)-(15) is per
steradian over the whole circle: the two differ by 2 pi. Each claim names its reading.
"""

from sympy import (
    Abs,
    And,
    DiracDelta,
    Function,
    Heaviside,
    Integral,
    Max,
    Or,
    Piecewise,
    acos,
    cos,
    exp,
    pi,
    sin,
    sqrt,
    symbols,
)

from xsec_sym.exact import AZIMUTH, RingCrossSection, RingMean, RingSpread, RingTilt, facing
from xsec_sym.proof import Source, interval

paper = Source("deon2016", section="2.1")

u, u_n, u_i, x = symbols("u u_n u_i x", real=True)
SQUARE = [interval(u, -1, 1), interval(u_n, -1, 1)]
CLOSED = ("deon2016:9", "deon2016:10", "deon2016:11", "deon2016:12")  # the ring without an integral
PER_STERADIAN = "D = delta(u - u_n) per steradian: a ring at the pole has the cross-section 2 pi max(0, u)"

c = facing(u, u_n)  # the cosine towards one normal of the ring
swing = sqrt(1 - u**2) * sqrt(1 - u_n**2)  # how far it moves about its mean u u_n
horizon = acos(-u * u_n / swing)  # the azimuth at which the ring crosses the viewer's horizon
band = 1 - u**2 - u_n**2  # positive where it crosses at all


# --- a flat surface -----------------------------------------------------------------------------------

paper.definition("6", "a flat surface", left=Function("D")(u), printed=DiracDelta(u - 1),
                 reading="per unit cosine; the whole of the delta at u = 1 counts")  # fmt: skip

flat = paper.claim(
    "7",
    "the cross-section of a flat surface",
    left=RingCrossSection(u, 1) / (2 * pi),
    printed=(u + Abs(u)) / 2,
    where=[interval(u, -1, 1)],
    reading="per unit cosine, as in (5): the ring at the pole, over 2 pi",
)


@flat.proof
def clamp_only(step):
    """All normals are the same one, so the integral over azimuth is 2 pi times one clamped cosine."""
    for branch in step.cases(u):
        branch.unfold()
        if branch.integrals:
            branch.split()
        if branch.integrals:
            branch.antiderivative(u * AZIMUTH)


# --- the three components -----------------------------------------------------------------------------

paper.definition("8", "the Dirac ring", left=Function("D")(u), printed=DiracDelta(u - u_n), reading=PER_STERADIAN)


def visible_arc(step):
    """Cut the circle where the ring dips below the horizon, for every position of viewer and ring.

    Yields each branch with a primitive's scale: on the visible arc the cosine is mean + swing cos(azimuth).
    """
    for first in step.cases(u):
        viewer = first.goal.piece.sign(u) if first.left.has(u) else "0"
        for second in first.cases(u_n):
            ring = second.goal.piece.sign(u_n) if second.left.has(u_n) else "0"
            root = {"+": 1, "-": -1, "0": 0}[viewer] * sqrt(1 - u_n**2)
            if viewer == ring == "0":
                yield at_equator_both(second)
            elif viewer == "0":
                yield from seen_from_the_equator(second, ring)
            elif ring == "0":
                yield from ring_at_the_equator(second, viewer)
            else:
                for where, branch in enumerate(second.cases(band, u, root, -(u + root))):
                    yield cut(branch.unfold(), where, viewer == ring)


def cut(step, where, bright):
    """Band, cap or join, with u and u_n of equal (bright) or opposite signs."""
    if where == 0:
        return step.split(horizon, pi, 2 * pi - horizon)
    if where == 2:
        return step.split(pi)
    if bright:
        step.fact(u * u_n - swing, -band / (u * u_n + swing))
        step.fact(c, u * u_n - swing, swing * (1 + cos(AZIMUTH)), inside=(AZIMUTH, 0, 2 * pi))
    else:
        step.fact(u * u_n + swing, band / (swing - u * u_n))
        step.fact(c, u * u_n + swing, -swing * (1 - cos(AZIMUTH)), inside=(AZIMUTH, 0, 2 * pi))
    return step.split()


def at_equator_both(step):
    return step.unfold().split(pi / 2, pi, 3 * pi / 2)


def seen_from_the_equator(step, ring):
    """u = 0: half the ring is visible unless it has shrunk to a pole, where the cosine is 0 throughout."""
    pole = 1 if ring == "+" else -1
    for where, branch in enumerate(step.cases(1 - u_n**2, u_n, pole, -(u_n + pole))):
        if where == 1:
            branch.vacuous()
        else:
            yield branch.unfold().split(pi / 2, pi, 3 * pi / 2) if where == 0 else branch.unfold()


def ring_at_the_equator(step, viewer):
    """u_n = 0: the same with the roles exchanged."""
    pole = 1 if viewer == "+" else -1
    for where, branch in enumerate(step.cases(1 - u**2, u, pole, -(u + pole))):
        if where == 1:
            branch.vacuous()
        else:
            yield branch.unfold().split(pi / 2, pi, 3 * pi / 2) if where == 0 else branch.unfold()


mean = paper.claim(
    "10",
    "first component: the mean cosine of the ring, clamped",
    left=RingMean(u, u_n),
    printed=Piecewise((2 * pi * u * u_n, u * u_n > 0), (0, True)),
    where=SQUARE,
    reading=PER_STERADIAN,
)


@mean.proof
def constant_over_the_ring(step):
    for first in step.cases(u):
        for branch in first.cases(u_n):
            branch.unfold()
            if branch.integrals:
                branch.split()
            for integral in branch.integrals:
                branch.antiderivative(integral.function * AZIMUTH, integral)


spread = paper.claim(
    "11",
    "second component: the swing of the cosine over the visible arc",
    left=RingSpread(u, u_n),
    printed=Piecewise((2 * sqrt(-(u_n**2) - u**2 + 1), Abs(u) < sqrt(1 - u_n**2)), (0, True)),
    where=SQUARE,
    reading=PER_STERADIAN,
)


@spread.proof
def sine_of_the_horizon(step):
    for branch in visible_arc(step):
        for integral in branch.integrals:
            branch.antiderivative(integral.function.subs(cos(AZIMUTH), sin(AZIMUTH)), integral)


tilt = paper.claim(
    "12",
    "third component: the mean cosine over the visible arc, less the first component",
    left=RingTilt(u, u_n),
    printed=Piecewise(
        (
            2 * u * u_n * acos(-u * u_n / (sqrt(1 - u**2) * sqrt(1 - u_n**2))) - 2 * pi * u * u_n * Heaviside(u * u_n),
            Abs(u) < sqrt(1 - u_n**2),
        ),
        (0, True),
    ),
    where=SQUARE,
    reading=PER_STERADIAN,
)


@tilt.proof
def length_of_the_arc(step):
    for branch in visible_arc(step):
        for integral in branch.integrals:
            branch.antiderivative(integral.function * AZIMUTH, integral)


ring = paper.claim(
    "9",
    "the ring's cross-section is the sum of its three components",
    left=RingCrossSection(u, u_n),
    printed=RingMean(u, u_n) + RingSpread(u, u_n) + RingTilt(u, u_n),
    where=SQUARE,
    reading=PER_STERADIAN,
)


@ring.proof
def visible_part(step):
    """max(0, c) is c where c > 0; c is its mean and its swing; the step of c is the step of the mean and the rest."""
    step.unfold()
    seen = Heaviside(c)
    step.linear(Heaviside(u * u_n) * u * u_n, seen * (c - u * u_n), (seen - Heaviside(u * u_n)) * u * u_n)


# --- the closed form of the ring ----------------------------------------------------------------------

CAPS = Or(And(u_n < 0, u < -sqrt(1 - u_n**2)), And(u_n > 0, u > sqrt(1 - u_n**2)))
BAND = And(u > -sqrt(1 - u_n**2), u < sqrt(1 - u_n**2))


def by_components(step):
    """Sum the three components, with one branch for each sign of u, of u_n and of 1 - u^2 - u_n^2."""
    step.lemma(ring).lemma(mean).lemma(spread).lemma(tilt)
    for first in step.cases(u):
        for second in first.cases(u_n):
            yield from positions(second)


def positions(step):
    """Band, cap, join; where u or u_n is 0 the join is the pole."""
    piece = step.goal.piece
    viewer, here = (piece.sign(s) if step.goal.piece.facts_about(s) else "0" for s in (u, u_n))
    if viewer == here == "0":
        yield step
        return
    if viewer == "0":
        pole = 1 if here == "+" else -1
        found = step.cases(1 - u_n**2, u_n, pole, -(u_n + pole))
    elif here == "0":
        pole = 1 if viewer == "+" else -1
        found = step.cases(1 - u**2, u, pole, -(u + pole))
    else:
        root = sqrt(1 - u_n**2) * (1 if viewer == "+" else -1)
        found = step.cases(band, u, root, -(u + root))
    yield from found


piecewise = paper.claim(
    "8.piecewise",
    "the ring's cross-section, where the print gives a value",
    left=RingCrossSection(u, u_n),
    printed=Piecewise(
        (2 * pi * u * u_n, CAPS),
        (2 * (sqrt(-(u_n**2) - u**2 + 1) + u * u_n * acos(-u * u_n / (sqrt(1 - u**2) * sqrt(1 - u_n**2)))), BAND),
    ),
    where=[*SQUARE, Or(CAPS, BAND)],
    reading=PER_STERADIAN + "; the print is silent on the caps with u u_n < 0 and on |u| = sqrt(1 - u_n^2)",
)


@piecewise.proof
def sum_of_components(step):
    for branch in by_components(step):
        if branch.is_empty:
            branch.vacuous()


rest = paper.claim(
    "8.piecewise.rest",
    "the ring's cross-section where the print is silent: the far caps and the joins",
    left=RingCrossSection(u, u_n),
    corrected=2 * pi * Max(0, u * u_n),
    where=[*SQUARE, u**2 + u_n**2 >= 1],
    reading=PER_STERADIAN + "; read with a default of 0 the print would be wrong on the joins with u u_n > 0",
)


@rest.proof
def no_horizon(step):
    for branch in by_components(step):
        if branch.is_empty:
            branch.vacuous()


# --- symmetry, normalisation, superposition -----------------------------------------------------------

symmetry = paper.claim(
    "13",
    "viewer and ring may be exchanged",
    left=RingCrossSection(u_n, u),
    printed=RingCrossSection(u, u_n),
    where=SQUARE,
    reading=PER_STERADIAN,
)


@symmetry.proof
def same_integrand(step):
    step.unfold()


normalisation = paper.claim(
    "14",
    "each ring has the same mean cross-section",
    left=Integral(RingCrossSection(u, u_n), (u, -1, 1)),
    printed=pi,
    where=[interval(u_n, -1, 1)],
    reduces=CLOSED,
    points={u: [-sqrt(1 - u_n**2), 0, sqrt(1 - u_n**2)]},
    reading=PER_STERADIAN,
)


@normalisation.proof
def isotropic_row(step):
    """By symmetry this is the isotropic row of Table 1: a medium of all normals alike."""
    step.substitute(x, x, -1, 1).lemma("deon2016:T1.1.s", {u: u_n})


D = Function("D", real=True)
INSTANCES = (lambda v: v**2, lambda v: exp(v) * (1 + v**3), lambda v: 1 / (2 - v), lambda v: v - Abs(v) / 3)

superposition = paper.claim(
    "15",
    "any distribution with azimuthal symmetry is a superposition of rings",
    left=Integral(D(x) * Max(0, facing(u_i, x)), (AZIMUTH, 0, 2 * pi), (x, -1, 1)),
    printed=Integral(RingCrossSection(x, u_i) * D(x), (x, -1, 1)),
    where=[interval(u_i, -1, 1)],
    instances={D: INSTANCES},
    points={x: [-sqrt(1 - u_i**2), 0, sqrt(1 - u_i**2)]},
    reading="D per steradian and integrable, so that the order of integration does not matter (Fubini); with D per "
    "unit cosine, as in (4)-(7), the right side is to be divided by 2 pi",
)


@superposition.proof
def azimuth_first(step):
    """D does not depend on azimuth, so the inner integral is the ring's."""
    step.unfold().nest()


# --- the text -----------------------------------------------------------------------------------------

pole = paper.claim(
    "claim.figure-1.pole",
    "Figure 1: one end of the family, the ring at the pole",
    left=RingCrossSection(u, 1),
    printed=pi * (u + Abs(u)),
    where=[interval(u, -1, 1)],
    reading=PER_STERADIAN,
    statement=True,
)


@pole.proof
def no_ring_left(step):
    clamp_only(step)


equator = paper.claim(
    "claim.figure-1.equator",
    "Figure 1: the other end of the family, the ring at the equator",
    left=RingCrossSection(u, 0),
    printed=2 * sqrt(1 - u**2),
    where=[interval(u, -1, 1)],
    reading=PER_STERADIAN,
    statement=True,
)


@equator.proof
def half_the_circle(step):
    at = {u: u, u_n: 0}
    step.lemma(ring, at).lemma(mean, at).lemma(spread, at).lemma(tilt, at)
    for below in step.cases(1 - u, u, 1, -1):
        if below.is_empty:
            below.vacuous()
        elif below.goal.piece.facts_about(u):
            for branch in below.cases(1 + u, u, -1):
                if branch.is_empty:
                    branch.vacuous()


paper.whole(
    "claim.figure-1",
    "Figure 1: normalised functions that blend between pi (u + |u|) and 2 sqrt(1 - u^2)",
    ["claim.figure-1.pole", "claim.figure-1.equator", "14"],
    left=RingCrossSection(u, u_n),
)

if __name__ == "__main__":
    paper.tell()
