"""What the forty cells of Table 1 have in common: what a cell is, and how each column is proved.

Columns: s1, s2, s3 integrate one component of the ring against D, s is their sum, the cross-section. Every s1 and s2
is one antiderivative in the inclination x; every s3 follows from s2 by the ring lemma, with one antiderivative in t;
every s is a sum. Cells that are finite seen from one side and infinite from the other are split by the sign of u.
"""

from sympy import Abs, Integral, pi, sqrt, symbols

from derivations.extensions.ring_lemma import over_the_band
from xsec_sym.exact import RingCrossSection, RingMean, RingSpread, RingTilt
from xsec_sym.proof import interval

u, x, t, u_n = symbols("u x t u_n", real=True)

AT = {u: x, u_n: u}
COMPONENT = {"s1": RingMean, "s2": RingSpread, "s3": RingTilt, "s": RingCrossSection}
CLOSED = ("deon2016:9", "deon2016:10", "deon2016:11", "deon2016:12")
SPHERE = [interval(u, -1, 1)]
SIDES = {"neg": [interval(u, -1, 0, open="right")], "zero": [], "pos": [interval(u, 0, 1, open="left")]}
SIGN = {"neg": ", u < 0", "zero": ", u = 0", "pos": ", u > 0", "": ""}
READING = "D per steradian; a column's integral runs over all inclinations"
BARS = "put back the bars: |u| for u"

tau = sqrt(1 - u**2)
kernel = 1 / (t**2 * (1 - t**2))


class Cells:
    """The cells that one module of the table claims."""

    def __init__(self, paper):
        self.paper = paper

    def cell(self, row, column, distribution, printed=None, corrected=None, edit="", side="", parity=()):
        """One cell: a component of the ring, integrated against the row's distribution."""
        viewer = 0 if side == "zero" else u
        return self.paper.claim(
            f"T1.{row}.{column}" + (f".{side}" if side else ""),
            f"Table 1: {distribution}, column {column}{SIGN[side]}",
            left=Integral(COMPONENT[column](x, viewer) * distribution, (x, -1, 1)),
            printed=printed,
            corrected=corrected,
            where=[*(SIDES[side] if side else SPHERE), *parity],
            edit=edit,
            reading=READING,
            reduces=CLOSED,
            points={x: [-tau, 0, tau]} if side != "zero" else {},
        )

    def split_cell(self, row, column, distribution, printed=None):
        """A cell whose sides have verdicts of their own."""
        self.paper.whole(
            f"T1.{row}.{column}",
            f"Table 1: {distribution}, column {column}",
            [f"T1.{row}.{column}.{side}" for side in SIDES],
            printed=printed,
            left=Integral(COMPONENT[column](x, u) * distribution, (x, -1, 1)),
            reading=READING,
        )


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
    """s2: the band |x| < sqrt(1 - u^2), by whatever ``across`` does with the integral over it."""
    claim.proof(lambda step: over_the_band(step, across))


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


def superpose(step, sigma, viewer, density, s2, mean, beyond, low=-1, ready=None):
    """A cross-section by the ring lemma: its mean cosine, and its second component integrated beyond the viewer.

    ``mean`` is a primitive of 2 pi x D(x), ``beyond`` one of sigma_2(t) / (t^2 (1 - t^2)); ``ready`` notes the signs
    that they need. Seen from the equator only the second component is left.
    """
    constant, shape = density.as_independent(x, as_Add=False)
    for branch in step.cases(viewer):
        if not branch.goal.piece.facts_about(viewer):
            branch.unfold(sigma.func.__name__).lemma("xsec:ring-lemma.zero").lemma(s2, {viewer: 0})
            continue
        positive = branch.goal.piece.sign(viewer) == "+"
        distance = viewer if positive else -viewer
        branch.unfold(sigma.func.__name__).lemma("xsec:ring-lemma", {x: x, u: viewer}).settle()
        inner = Integral(RingSpread(x, t) * kernel, (t, distance, 1))
        clamped = [pi * (viewer * x + distance * Abs(x)) * density] if positive or low < 0 else []
        branch.linear(*clamped, distance * density * inner)
        branch.exchange(next(i for i in branch.integrals if i.has(t)), by="deon2016:11", mapping={u: x, u_n: t})
        whole = Integral(RingSpread(x, t) * density, (x, low, 1))
        branch.rewrite(Integral(RingSpread(x, t) * shape, (x, low, 1)), whole / constant).lemma(s2, {viewer: t})
        if ready:
            ready(branch, distance)
        if clamped:
            branch.split(*([0] if low < 0 else []), integral=next(i for i in branch.integrals if not i.has(t)))
            half = next(i for i in branch.integrals if not i.has(t))
            branch.antiderivative(mean * (half.function / mean.diff(x)).simplify(), half)
        branch.antiderivative(beyond / constant)
