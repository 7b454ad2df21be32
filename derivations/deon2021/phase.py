"""Section 2: the phase function of a white Lambertian sphere, its Legendre coefficients, and how they enter (14), (15).

mu is the cosine of the deviation, 1 straight on. The phase function p is per steradian: 2 pi times its integral over mu
is 1, and the coefficients A_k are those of 4 pi p. All of them are in `coefficients.py`.
"""

from sympy import (
    Function,
    Integral,
    Rational,
    Sum,
    Symbol,
    acos,
    cos,
    legendre,
    oo,
    pi,
    sin,
    sqrt,
    symbols,
)

from xsec_sym.exact import PhaseLambertSphere as p
from xsec_sym.exact.lambert_sphere import LIT
from xsec_sym.proof import Source, interval

paper = Source("deon2021", section="2")
project = Source("xsec", section="Lambertian spheres")

mu, theta, v, c = symbols("mu theta v c", real=True)
u, u_n = symbols("u u_n", real=True)
k = Symbol("k", integer=True, nonnegative=True)
COSINE, ALBEDO = interval(mu, -1, 1), interval(c, 0, 1)
RING = ("deon2016:9", "deon2016:10", "deon2016:11", "deon2016:12")
PER_STERADIAN = "p per steradian"

# --- the phase function ---------------------------------------------------------------------------------

form = 2 * (sqrt(1 - mu**2) - mu * acos(mu)) / (3 * pi**2)
short = paper.claim(
    "1.1",
    "the phase function of a white Lambertian sphere, by the cosine of the deviation",
    left=p(mu),
    printed=2 * (sqrt(1 - mu**2) - mu * acos(mu)) / (2 * pi**2),
    corrected=form,
    edit="3 pi^2 for 2 pi^2 below the line, as in the second form",
    where=[COSINE],
    reduces=RING,
    reading=PER_STERADIAN,
)


@short.proof
def rings_around_the_light(step):
    """The rings that the viewer sees in part reach from the light out to the cosine s."""
    x, s = LIT, sqrt(1 - mu**2)
    step.unfold("PhaseLambertSphere")
    for name in RING:
        step.lemma(name, {u: -mu, u_n: x})
    for above in step.cases(1 - mu, mu, 1, -1):
        if not at_a_pole(above):
            for branch in above.cases(1 + mu, mu, -1):
                if not at_a_pole(branch):
                    branch.fact(1 - mu**2, (1 - mu) * (1 + mu))
                    for low, high in ((0, s), (s, 1)):
                        branch.fact(1 - mu**2 - x**2, (s - x) * (s + x), inside=(x, low, high))
                    for side in branch.cases(mu):
                        across_the_rings(side)


def at_a_pole(step):
    """Straight on or straight back no ring is seen in part."""
    if step.is_empty:
        step.vacuous()
    elif not step.goal.piece.facts_about(mu):
        step.split()
        for integral in step.integrals:
            step.antiderivative(2 * pi * LIT**3 / 3, integral)
    else:
        return False
    return True


def across_the_rings(step):
    """By parts: what the slope of the one arc leaves is w, and the other arc."""
    x, s = LIT, sqrt(1 - mu**2)
    sign = step.goal.piece.sign(mu)
    if not step.goal.piece.facts_about(mu):
        step.split()
        step.antiderivative(-2 * sqrt(1 - x**2) ** 3 / 3)
        return
    distance = mu if sign == "+" else -mu
    step.split(s)
    w = sqrt(1 - mu**2 - x**2)
    arc, beyond = acos(mu * x / (s * sqrt(1 - x**2))), acos(distance / sqrt(1 - x**2))
    step.antiderivative(-2 * w**3 / 3 - 2 * mu * (x**3 * arc / 3 + mu * (w - beyond / distance) / 3), step.over(0, s))
    if sign == "-":
        step.antiderivative(-2 * pi * mu * x**3 / 3)


arc = Integral(1 / sqrt(1 - v**2), (v, cos(theta), 1))
ANGLE = interval(theta, 0, pi)
length = project.claim("arc.length", "the length of an arc", left=arc, corrected=theta, where=[ANGLE])
inverse = project.claim(
    "arc.cosine",
    "the length of an arc is the arc cosine of its cosine",
    left=arc,
    corrected=acos(cos(theta)),
    where=[ANGLE],
)


@length.proof
def along_the_arc(step):
    step.substitute(u, cos(u), theta, 0).antiderivative(u)


@inverse.proof
def by_its_derivative(step):
    step.antiderivative(-acos(v))


by_angle = paper.claim(
    "1.2",
    "the phase function by the angle of deviation",
    left=p(cos(theta)),
    printed=2 * (sin(theta) - theta * cos(theta)) / (3 * pi**2),
    where=[ANGLE],
    reduces=(short.id,),
    reading=PER_STERADIAN + "; the bracket that the print leaves open is closed at the end",
)


@by_angle.proof
def angle_of_its_cosine(step):
    step.lemma(short, {mu: cos(theta)}).lemma(inverse, back=True).lemma(length)
    for branch in step.cases(theta):
        if branch.is_empty:
            branch.vacuous()
        elif branch.goal.piece.facts_about(theta):
            for side in branch.cases(pi - theta, theta, pi, -1):
                if side.is_empty:
                    side.vacuous()


paper.whole("1", "the phase function of a white Lambertian sphere", ["1.1", "1.2"], left=p(mu), printed=short.printed)

# --- Legendre coefficients ------------------------------------------------------------------------------

A = Function("A", real=True)

paper.definition(
    "2",
    "the phase function as a Legendre series",
    left=p(mu),
    printed=Sum(A(k) * legendre(k, mu), (k, 0, oo)) / (4 * pi),
    reading=PER_STERADIAN + "; it introduces the A_k, which (3) gives",
)


def coefficient(degree):
    """(3)."""
    return 2 * pi * (2 * degree + 1) * Integral(p(v) * legendre(degree, v), (v, -1, 1))


paper.definition("3", "the Legendre coefficients", left=A(k), printed=coefficient(k), reading=PER_STERADIAN)


def primitive(polynomial):
    """An antiderivative of a polynomial times sqrt(1 - v^2) - v acos(v): the arc cosine goes by parts."""
    weight = (v * polynomial).integrate(v)
    return over_the_root((polynomial * (1 - v**2) - weight).expand()) - weight * acos(v)


def over_the_root(polynomial):
    """An antiderivative of a polynomial over r = sqrt(1 - v^2), the arc sine written as an arc cosine.

    (r v^(d - 1))' r = (d - 1) v^(d - 2) - d v^d takes off one power after the other.
    """
    degree, lead = polynomial.as_poly(v).degree(), polynomial.as_poly(v).LC()
    if degree <= 0:
        return -polynomial * acos(v)
    power = v ** (degree - 1)
    rest = polynomial + lead / degree * (power.diff(v) * (1 - v**2) - v * power)
    return over_the_root(rest.expand()) - lead / degree * power * sqrt(1 - v**2)


VALUES = (1, -Rational(4, 3), Rational(5, 16), 0, Rational(1, 64), 0)

for degree, printed in enumerate(VALUES):
    paper.claim(
        f"4.{degree}",
        f"the Legendre coefficient of degree {degree}",
        left=coefficient(degree),
        printed=printed,
        reduces=(short.id,),
        reading=PER_STERADIAN + (": its integral over the sphere is 1" if degree == 0 else ""),
    ).proof(lambda step, degree=degree: against(step, legendre(degree, v)))


def against(step, polynomial):
    """The phase function in closed form under the integral, times a polynomial."""
    step.lemma(short, {mu: v}).antiderivative(2 * primitive(polynomial) / (3 * pi**2))


paper.whole(
    "4",
    "the first Legendre coefficients",
    [f"4.{degree}" for degree in range(len(VALUES))],
    left=A(k),
    reading=PER_STERADIAN,
)

mean = paper.claim(
    "claim.mean-cosine",
    "the mean cosine of the phase function is -4/9",
    left=2 * pi * Integral(v * p(v), (v, -1, 1)),
    printed=-Rational(4, 9),
    reduces=(short.id,),
    reading=PER_STERADIAN,
    statement=True,
)
mean.proof(lambda step: against(step, v))

forward = paper.claim(
    "claim.no-forward",
    "no light goes straight on",
    left=p(1),
    printed=0,
    reduces=RING,
    reading=PER_STERADIAN,
    statement=True,
)
forward.proof(lambda step: step.lemma(short, {mu: 1}))


def three_terms(cosine):
    """(2) with the terms A_0, A_1 and A_2."""
    return sum(VALUES[degree] * legendre(degree, cosine) for degree in range(3)) / (4 * pi)


most = paper.inequality(
    "claim.three-terms",
    "the first three terms hold most of the phase function: 0.9999 of the integral of its square",
    Integral(three_terms(v) ** 2, (v, -1, 1)),
    Rational(9999, 10000) * Integral(p(v) ** 2, (v, -1, 1)),
    reduces=(short.id,),
    reading=PER_STERADIAN + "; Legendre polynomials are orthogonal, so that the squares of the terms add up",
)


@most.proof
def squares(step):
    cube, arc, root = v - v**3 / 3, acos(v), sqrt(1 - v**2)
    swing = -Rational(2, 3) * root**3 * arc - Rational(2, 3) * cube  # of 2 v root arc
    moment = v**3 * arc**2 / 3 - Rational(2, 9) * (root * (v**2 + 2) * arc + v**3 / 3 + 2 * v)  # of v^2 arc^2
    for _ in range(2):
        step.lemma(short, {mu: v})
        whole, cut = sorted(step.integrals, key=lambda i: not i.has(acos))
        step.antiderivative(4 * (cube - swing + moment) / (9 * pi**4), whole)
        step.antiderivative((three_terms(v) ** 2).expand().integrate(v), cut)
        step.swap()
    step.settle()


# --- the three-term phase function of Section 3 ---------------------------------------------------------

later = Source("deon2021", section="3")

folded = later.claim(
    "14",
    "the phase function, its albedo folded in, as three Legendre terms",
    left=c * three_terms(mu),
    printed=sum(c * VALUES[degree] * legendre(degree, mu) for degree in range(3)),
    corrected=sum(c * VALUES[degree] * legendre(degree, mu) for degree in range(3)) / (4 * pi),
    edit="4 pi c p on the left: a phase function with the mean 1, as in (2)",
    where=[COSINE, ALBEDO],
    reading="p per steradian, as in (1), (2), (5) and (17); the coefficients are those of (15)",
)
folded.proof(lambda step: None)

for degree in range(3):
    later.claim(
        f"15.{degree}",
        f"the coefficient of degree {degree} with the albedo folded in",
        left=c * coefficient(degree),
        printed=c * VALUES[degree],
        where=[ALBEDO],
        reduces=(short.id,),
        reading="c times A_k of (3), p per steradian",
    ).proof(lambda step, degree=degree: against(step, legendre(degree, v)))

later.whole(
    "15",
    "the coefficients with the albedo folded in",
    [f"15.{degree}" for degree in range(3)],
    left=Function("omega", real=True)(k),
    reading="c times A_k of (3)",
)

# --- the distribution function --------------------------------------------------------------------------

distribution = project.claim(
    "lambert-sphere.cdf",
    "the share of the light that goes into cosines up to mu",
    left=Integral(2 * pi * p(v), (v, -1, mu)),
    corrected=1 + (3 * mu * sqrt(1 - mu**2) - (1 + 2 * mu**2) * acos(mu)) / (3 * pi),
    where=[COSINE],
    reduces=(short.id,),
    reading=PER_STERADIAN,
)


@distribution.proof
def by_parts(step):
    step.lemma(short, {mu: v}).antiderivative(4 * primitive(Rational(1)) / (3 * pi))


if __name__ == "__main__":
    for section in (paper, later, project):
        section.tell()
