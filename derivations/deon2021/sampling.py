"""Section 2.1: the cosine of the deviation from three random numbers.

Light meets the sphere as a uniform disk, so that the squared cosine of the lit normal, to the light, is uniform; it
leaves by Lambert's law, and the squared cosine to the normal is uniform too. The azimuth between the two is uniform.
"""

from sympy import Function, Integral, cos, exp, oo, pi, sin, sqrt, symbols

from xsec_sym.exact import PhaseLambertSphere as p
from xsec_sym.exact.lambert_sphere import LIT
from xsec_sym.exact.ring import AZIMUTH
from xsec_sym.proof import Source, interval

paper = Source("deon2021", section="2.1")
project = Source("xsec", section="circle")

mu, psi, a, b = symbols("mu psi a b", real=True)
xi_1, xi_2, xi_3 = symbols("xi_1 xi_2 xi_3", real=True)
g = Function("g", real=True, nonnegative=True)
TRIED = {g: (lambda v: exp(v), lambda v: (1 + v) ** 3, lambda v: (1 - v) ** 2)}

quarter = project.claim(
    "circle-quarter-turn",
    "over a whole circle a cosine may be taken for a sine",
    left=Integral(g(a * cos(AZIMUTH) + b), (AZIMUTH, 0, 2 * pi)),
    corrected=2 * pi * Integral(g(a * sin(2 * pi * xi_3) + b), (xi_3, 0, 1)),
    where=[interval(a, -oo, oo), interval(b, -oo, oo)],
    instances={g: (lambda v: 1 / (1 + v**2), lambda v: exp(-(v**2)))},
    reading="g is any function that is not negative and integrable over the circle",
)


@quarter.proof
def pieces_change_places(step):
    """The last quarter of the cosine's circle is the first of the sine's."""
    step.split(3 * pi / 2)
    step.substitute(psi, psi - pi / 2, pi / 2, 2 * pi, step.over(0, 3 * pi / 2))
    step.substitute(psi, psi + 3 * pi / 2, 0, pi / 2, step.over(3 * pi / 2, 2 * pi))
    step.swap().substitute(psi, psi / (2 * pi), 0, 2 * pi).split(pi / 2)


drawn = sqrt((1 - xi_1) * (1 - xi_2)) * sin(2 * pi * xi_3) - sqrt(xi_1 * xi_2)

exact = paper.claim(
    "6",
    "the cosine of the deviation from three uniform numbers",
    left=Integral(2 * pi * p(mu) * g(mu), (mu, -1, 1)),
    printed=Integral(g(drawn), (xi_3, 0, 1), (xi_2, 0, 1), (xi_1, 0, 1)),
    instances=TRIED,
    reduces=("deon2021:1.1",),
    reading="both are the mean of any g >= 0 of the cosine, which says that the cosine drawn has the density 2 pi p",
)


@exact.proof
def the_other_pole(step):
    """Turn the sphere of outgoing directions: its pole goes from the way of the light to the normal."""
    step.unfold("PhaseLambertSphere").unfold().exchange()

    def over(symbol):
        return next(i for i in step.left.atoms(Integral) if [limit[0] for limit in i.limits] == [symbol])

    step.turn(-LIT, integral=over(mu)).split(0, integral=over(mu))
    step.lemma(quarter, {a: sqrt(1 - mu**2) * sqrt(1 - LIT**2), b: -mu * LIT})
    step.substitute(xi_2, sqrt(xi_2), 0, 1, over(mu)).substitute(xi_1, sqrt(xi_1), 0, 1, over(LIT))
    step.swap().rewrite(drawn, sqrt(1 - xi_1) * sqrt(1 - xi_2) * sin(2 * pi * xi_3) - sqrt(xi_1) * sqrt(xi_2))
