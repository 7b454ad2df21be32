"""Section 3.1: the homogeneous half-space as a Smith microsurface, (12)-(16).

P_1 is the density of the heights zeta, C_1 the share of heights below zeta. What is said of every P_1 is tried on four:
heights spread evenly over (-1, 1), Gaussian ones, logistic ones, and exponential ones below 0, for which the Smith
medium is the homogeneous half-space itself.
"""

from sympy import Function, Integral, Piecewise, diff, erf, erfc, exp, log, oo, pi, sqrt, symbols

from xsec_sym.exact import BelowExponential, BelowGaussian, BelowLogistic, BelowUniform
from xsec_sym.exact.smith import HEIGHT, exponential, gaussian, logistic, uniform
from xsec_sym.proof import Source, interval

paper = Source("dupuy2016", section="3.1")

zeta, zeta_1, h, x, y, z, U, k, share = symbols("zeta zeta_1 h x y z U k C", real=True)
P = Function("P_1", real=True, nonnegative=True)
C, inverse, rho = Function("C_1", real=True), Function("C_1^{-1}", real=True), Function("rho", real=True)
TRIED = {P: (lambda v: exp(-(v**2)), lambda v: 1 / (1 + v**2) ** 2, lambda v: exp(-(v**2) - v))}


def medium(height):
    """The density of the half-space, (3)."""
    return Piecewise((0, height > 0), (1, True))


REACH = {"gaussian": 4, "logistic": 6, "exponential": 20}


class Heights:
    """One distribution: its density, C_1 from the definition and in closed form, and where zeta runs."""

    def __init__(self, name, density, below, closed, back, low, high):
        self.name, self.density, self.below, self.closed, self.back = name, density, below, closed, back
        self.low, self.high = low, high

    def where(self, v=zeta, low=None):
        return interval(v, self.low if low is None else low, self.high, open=True)

    def tried(self, v=zeta, low=None):
        """Heights within reach, beyond which the balls take too long; the proofs go everywhere."""
        reach = REACH.get(self.name)
        if reach is None:
            return self.where(v, low)
        return interval(v, -reach if low is None else low, min(reach, self.high), open=True)

    def medium(self, v):
        """P_1 / C_1, C_1 from the definition."""
        return self.density(v) / self.below(v)

    def dense(self, v):
        """P_1 / C_1 with the C_1 that is proved above."""
        return self.density(v) / self.closed.subs(zeta, v)


logit = exp(zeta) / (1 + exp(zeta))
FAMILIES = (
    Heights("uniform", uniform, BelowUniform, (1 + zeta) / 2, 2 * U - 1, -1, 1),
    Heights("gaussian", gaussian, BelowGaussian, (1 + erf(zeta / sqrt(2))) / 2, None, -oo, oo),
    Heights("logistic", logistic, BelowLogistic, logit, log(U / (1 - U)), -oo, oo),
    Heights("exponential", exponential, BelowExponential, exp(zeta), log(U), -oo, 0),
)
INVERTIBLE = [f for f in FAMILIES if f.back is not None]
UNIT = "P_1 is normalised; C_1 is its integral from below"


# --- the share of heights below -------------------------------------------------------------------------

PRIMITIVES = {
    "uniform": HEIGHT / 2,
    "gaussian": erf(HEIGHT / sqrt(2)) / 2,
    "logistic": -1 / (1 + exp(HEIGHT)),
    "exponential": exp(HEIGHT),
}
C1 = {}
for f in FAMILIES:
    C1[f.name] = paper.claim(
        f"12.{f.name}.below",
        f"the share of heights below zeta, {f.name} heights",
        left=f.below(zeta),
        corrected=f.closed,
        where=[f.where()],
        reading=UNIT,
    )
    C1[f.name].proof(lambda step, f=f: step.unfold().antiderivative(PRIMITIVES[f.name]))

peaks = paper.claim(
    "12.gaussian.peaks",
    "the share of Gaussian heights below a peak, without the cancellation in 1 + erf",
    left=BelowGaussian(zeta),
    corrected=1 - erfc(zeta / sqrt(2)) / 2,
    where=[interval(zeta, -4, 4)],
    reading=UNIT,
)

tail = paper.claim(
    "12.gaussian.tail",
    "how much the share of Gaussian heights below a valley exceeds its leading tail",
    left=(1 + erf(x)) + 2 * x * exp(-(x**2)) / (sqrt(pi) * (1 + 2 * x**2)),
    corrected=Integral(4 * exp(-(y**2)) / (sqrt(pi) * (1 + 2 * y**2) ** 2), (y, -oo, x)),
    where=[interval(x, -oo, oo)],
    reading="x = zeta / sqrt(2); for x < 0 the second term on the left is negative, so that C_1 > 0 wherever we look",
)


@tail.proof
def leading_tail(step):
    step.fact(1 + 2 * y**2, 1, 2 * y**2, inside=(y, -oo, x))
    step.fact(1 + 2 * x**2, 1, 2 * x**2)
    step.swap().antiderivative(erf(y) + 2 * y * exp(-(y**2)) / (sqrt(pi) * (1 + 2 * y**2)))


# --- the density ----------------------------------------------------------------------------------------

paper.definition(
    "12",
    "the density of the Smith medium",
    left=Function("rho_Smith")(zeta),
    printed=P(zeta) / C(zeta),
    reading="per unit height; infinite where C_1 is 0, below all heights",
)

CLOSED = {
    "uniform": 1 / (1 + zeta),
    "gaussian": sqrt(2 / pi) * exp(-(zeta**2) / 2) / (1 + erf(zeta / sqrt(2))),
    "logistic": 1 - logit,
    "exponential": 1,
}
TITLES = {
    "uniform": "Smith's medium for heights spread evenly thins out from below as 1 / (1 + zeta)",
    "gaussian": "Smith's medium for Gaussian heights",
    "logistic": "Smith's medium for logistic heights is 1 - C_1",
    "exponential": "Smith's medium for exponential heights is homogeneous",
}


def positive(step, *inside, at=zeta):
    """C_1 > 0 for Gaussian heights, by its leading tail where zeta < 0."""
    v = inside[0] if inside else at
    leading = -2 * v * exp(-(v**2) / 2) / (sqrt(2 * pi) * (1 + v**2))
    step.fact(1 + v**2, 1, v**2, inside=inside)
    step.fact(1 + erf(v / sqrt(2)), leading, 1 + erf(v / sqrt(2)) - leading, by=tail,
              mapping={x: v / sqrt(2)}, inside=inside)  # fmt: skip


for f in FAMILIES:
    claim = paper.claim(
        f"12.{f.name}",
        TITLES[f.name],
        left=f.medium(zeta),
        corrected=CLOSED[f.name],
        where=[f.where()],
        reading=UNIT,
        reduces=[C1[f.name].id],
    )
    claim.proof(lambda step, f=f: step.lemma(C1[f.name], {zeta: zeta}))


# --- the map to the half-space --------------------------------------------------------------------------

paper.definition("13", "the height in the half-space", left=z, printed=log(C(zeta)))

for f in INVERTIBLE:
    claim = paper.claim(
        f"14.{f.name}",
        f"the way back for {f.name} heights",
        left=log(f.below(f.back.subs(U, exp(z)))),
        corrected=z,
        where=[interval(z, -oo, 0, open=True)],
        reading=f"C_1^-1(U) = {f.back}",
        reduces=[C1[f.name].id],
    )

    @claim.proof
    def inverse_of_the_share(step, f=f):
        step.fact(1 - exp(z))
        step.lemma(C1[f.name], {zeta: f.back.subs(U, exp(z))})


paper.whole(
    "14",
    "the way back",
    [f"14.{f.name}" for f in INVERTIBLE],
    left=zeta,
    printed=inverse(exp(z)),
    reading="it introduces the inverse of (13); tried where the inverse of C_1 is elementary. For Gaussian heights it "
    "is an inverse error function",
)

BELOW = Integral(P(h), (h, -oo, zeta))
ANY = "for any density P_1"

by_chain_rule = paper.claim(
    "15.1",
    "the map carries the half-space's density into Smith's",
    left=P(zeta) / BELOW,
    printed=medium(z) * diff(log(BELOW), zeta),
    where=[interval(zeta, -oo, oo), interval(z, -oo, 0)],
    instances=TRIED,
    reading=ANY + "; the left side is (12), and z = log(C_1) is not positive",
)
by_chain_rule.proof(lambda step: step.swap().settle())

chain = paper.claim(
    "15.2",
    "the same by (13)",
    left=medium(z) * diff(log(BELOW), zeta),
    printed=P(zeta) / BELOW,
    where=[interval(zeta, -oo, oo), interval(z, -oo, 0)],
    instances=TRIED,
    reading=ANY,
)
chain.proof(lambda step: step.settle())

paper.whole("15", "the map carries the half-space's density into Smith's", ["15.1", "15.2"],
            left=P(zeta) / BELOW, printed=P(zeta) / C(zeta))  # fmt: skip


# --- the optical depth ----------------------------------------------------------------------------------

over_shares = paper.claim(
    "claim.optical-depth",
    "the optical depth of the Smith medium down to zeta is -log(C_1)",
    left=Integral(1 / share, (share, k, 1)),
    corrected=-log(k),
    where=[interval(k, 0, 1, open="left")],
    reading=ANY + ": over the share of heights below, d C_1 = P_1 d zeta, P_1 / C_1 d zeta is d C_1 / C_1; "
    "straight down from above, for sigma = 1",
    statement=True,
)
over_shares.proof(lambda step: step.antiderivative(log(share)))

DEPTHS = {
    "uniform": log(1 + h),
    "gaussian": log(1 + erf(h / sqrt(2))),
    "logistic": -log(1 + exp(-h)),
    "exponential": h,
}


def inside_out(step, f):
    """The integral of P_1 / C_1 between two heights."""
    step.antiderivative(DEPTHS[f.name])


depths = {}
for f in FAMILIES:
    depths[f.name] = paper.claim(
        f"claim.optical-depth.{f.name}",
        f"the optical depth of the Smith medium is -log(C_1), {f.name} heights",
        left=Integral(f.medium(h) if f.name == "gaussian" else f.dense(h), (h, zeta, f.high)),
        corrected=-log(f.closed),
        where=[f.tried()],
        reading=UNIT,
        reduces=[peaks.id] if f.name == "gaussian" else [],
        statement=True,
    )
    if f.name == "gaussian":
        continue
    depths[f.name].proof(lambda step, f=f: inside_out(step, f))


@depths["gaussian"].proof
def valleys_and_peaks(step):
    for branch in step.cases(zeta):
        v = zeta
        if not branch.goal.piece.facts_about(zeta):
            v = 0
        elif branch.goal.piece.sign(zeta) == "-":
            branch.lemma(C1["gaussian"], {zeta: h})
            positive(branch)
            positive(branch, h, zeta, 0)
            branch.split(0)
            for low, high in ((zeta, 0), (0, oo)):
                branch.antiderivative(DEPTHS["gaussian"], branch.over(low, high))
            continue
        branch.lemma(C1["gaussian"], {zeta: h}).antiderivative(DEPTHS["gaussian"], branch.over(v, oo))


# --- the same transport ---------------------------------------------------------------------------------

for f in FAMILIES:
    claim = paper.claim(
        f"claim.identical.{f.name}",
        f"between two heights both media have the same optical depth, {f.name} heights",
        left=Integral(f.dense(h), (h, zeta_1, zeta)),
        corrected=log(f.closed) - log(f.closed.subs(zeta, zeta_1)),
        where=[f.tried(zeta_1), f.tried(zeta, zeta_1)],
        reading="on the right z - z_1, the height of the homogeneous medium between z_1 = log C_1(zeta_1) and "
        "z = log C_1(zeta). Times sigma(omega) / |cos(theta)| both are the optical depth of the path between",
        statement=True,
    )
    if f.name != "gaussian":
        claim.proof(lambda step, f=f: inside_out(step, f))
        continue

    @claim.proof
    def valley_or_peak(step):
        whole = DEPTHS["gaussian"]
        for first in step.cases(zeta_1):
            if not first.goal.piece.facts_about(zeta_1) or first.goal.piece.sign(zeta_1) == "+":
                first.antiderivative(whole)
                continue
            for branch in first.cases(zeta):
                positive(branch, at=zeta_1)
                if not branch.goal.piece.facts_about(zeta):
                    positive(branch, h, zeta_1, 0)
                    branch.antiderivative(whole)
                elif branch.goal.piece.sign(zeta) == "-":
                    positive(branch, h, zeta_1, zeta)
                    positive(branch, at=zeta)
                    branch.antiderivative(whole)
                else:
                    positive(branch, h, zeta_1, 0)
                    branch.split(0)
                    branch.antiderivative(whole, branch.over(zeta_1, 0))
                    branch.antiderivative(whole, branch.over(0, zeta))


paper.whole(
    "claim.identical",
    "light transport in both media is identical, as albedo and phase function do not depend on depth",
    [f"claim.identical.{f.name}" for f in FAMILIES],
    left=Integral(P(h) / C(h), (h, zeta_1, zeta)),
    printed=log(C(zeta)) - log(C(zeta_1)),
    reading="the transport along a path is fixed by the optical depths between its corners, by the albedo, and by the "
    "phase function; the last two do not depend on height in either medium",
)


# --- points in the volume -------------------------------------------------------------------------------

paper.definition("16.1", "a point's height, by (13)", left=z, printed=log(C(zeta)))
paper.definition(
    "16.2",
    "a point's height with zeta drawn by inverse transform sampling",
    left=z,
    printed=log(C(inverse(U))),
    reading="U is uniform on [0, 1), as printed; U = 0 would lie infinitely deep, so that (0, 1] fits better",
)

drawn = {}
for f in INVERTIBLE:
    drawn[f.name] = paper.claim(
        f"16.3.{f.name}",
        f"a point's height is log(U), {f.name} heights",
        left=log(f.below(f.back)),
        printed=log(U),
        where=[interval(U, 0, 1, open=True)],
        reading=f"C_1^-1(U) = {f.back}",
        reduces=[C1[f.name].id],
    )
    drawn[f.name].proof(lambda step, f=f: step.lemma(C1[f.name], {zeta: f.back}))

paper.whole(
    "16.3",
    "a point's height is log(U)",
    [f"16.3.{f.name}" for f in INVERTIBLE],
    left=log(C(inverse(U))),
    printed=log(U),
    reading="tried where the inverse of C_1 is elementary",
)
paper.whole("16", "a point's height", ["16.1", "16.2", "16.3"], left=z, printed=log(U))

for slug, title, because in (
    (
        "figure4",
        "the caption of Figure 4: the half-space is mapped to a Smith microsurface",
        "a drawing; the map has the verdicts of (13)-(15)",
    ),
    (
        "optical-depth-analogy",
        "the map is analogous to the optical depth of plane-parallel media",
        "a comparison; that it is one has the verdict of claim.optical-depth",
    ),
):
    paper.out_of_scope(f"claim.{slug}", title, because=because)

if __name__ == "__main__":
    paper.tell()
