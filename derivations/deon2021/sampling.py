"""Section 2.1: the cosine of the deviation from three random numbers.

Light meets the sphere as a uniform disk, so that the squared cosine of the lit normal, to the light, is uniform; it
leaves by Lambert's law, and the squared cosine to the normal is uniform too. The azimuth between the two is uniform.
"""

from sympy import Function, Integral, cos, exp, oo, pi, sin, sqrt, symbols

from xsec_sym.exact import AZIMUTH, RingCrossSection
from xsec_sym.exact import PhaseLambertSphere as p
from xsec_sym.proof import Source, interval

paper = Source("deon2021", section="2.1")
project = Source("xsec", section="circle")

mu, psi, a, b = symbols("mu psi a b", real=True)
xi_1, xi_2, xi_3 = symbols("xi_1 xi_2 xi_3", real=True)
g = Function("g", real=True, nonnegative=True)
RING = ("deon2016:9", "deon2016:10", "deon2016:11", "deon2016:12")
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

UNIT = interval(xi_1, 0, 1)
MEAN = "it gives the mean of any g >= 0 of the cosine, that is, the density of the cosine"

one_ring = paper.claim(
    "6.1",
    "the cosine of the deviation by a ring of lit normals, from two uniform numbers",
    left=Integral(g(mu) * RingCrossSection(-mu, sqrt(xi_1)), (mu, -1, 1)) / pi,
    printed=Integral(g(drawn), (xi_3, 0, 1), (xi_2, 0, 1)),
    where=[UNIT],
    instances=TRIED,
    reduces=RING,
    reading="the ring's normals have the cosine sqrt(xi_1) to the light; seen from -mu it has its cross-section, of "
    "which 1 / pi goes out per steradian and, as to the azimuth, 2 pi / (2 pi) per cosine; " + MEAN,
)


@one_ring.proof
def the_normal_becomes_the_pole(step):
    """Turn the sphere of outgoing directions: its pole goes from the way of the light to the normal."""
    step.unfold()

    def over(symbol):
        return next(i for i in step.left.atoms(Integral) if [limit[0] for limit in i.limits] == [symbol])

    step.turn(-sqrt(xi_1)).split(0, integral=over(mu))
    step.lemma(quarter, {a: sqrt(1 - mu**2) * sqrt(1 - xi_1), b: -mu * sqrt(xi_1)})
    step.substitute(xi_2, sqrt(xi_2), 0, 1, over(mu)).linear(over(xi_2).function, integral=over(xi_2))
    step.swap().rewrite(drawn, sqrt(1 - xi_1) * sqrt(1 - xi_2) * sin(2 * pi * xi_3) - sqrt(xi_1) * sqrt(xi_2))


all_rings = paper.claim(
    "6.2",
    "the light of all rings, of which each gets the same share of xi_1",
    left=2 * pi * p(mu),
    printed=Integral(RingCrossSection(-mu, sqrt(xi_1)) / pi, (xi_1, 0, 1)),
    where=[interval(mu, -1, 1)],
    reduces=RING,
    reading="the density of the cosine, 2 pi p, as the mean over xi_1 of what 6.1 finds for one ring",
)


@all_rings.proof
def uniform_disk(step):
    """Seen from the light the sphere is a disk, and xi_1 = x^2 is uniform on it."""
    step.unfold("PhaseLambertSphere").substitute(xi_1, sqrt(xi_1), 0, 1)


paper.whole(
    "6",
    "the cosine of the deviation from three uniform numbers",
    ["6.1", "6.2"],
    left=Function("mu", real=True)(xi_1, xi_2, xi_3),
    printed=drawn,
    reading="by Tonelli the mean over xi_1 of 6.1 is the integral of 2 pi p g",
)

if __name__ == "__main__":
    project.tell()
    paper.tell()
