"""What sections 1, 2.5 and 3 say of the spherical Gaussian in words: its two limits, and what nobody can compute.

D_SG is to be asymptotic to D_B for small roughness. At the scale on which both vary it is: with tan(theta) = alpha v
their ratio goes to 1 for every v, with an error of the order alpha^2. At a fixed angle it is not: there both vanish
faster than any power of alpha, and their ratio goes to infinity.
"""

from sympy import Integer, Rational, Symbol, coth, exp, oo, pi, sqrt, symbols

from xsec_sym.exact import beckmann, spherical_gaussian
from xsec_sym.proof import Source, interval

paper = Source("deon2016", section="2.5")

x = symbols("x", real=True)
v = Symbol("v", real=True)
alpha = Symbol("alpha", real=True)
kappa = 2 / alpha**2
ROUGH = interval(alpha, 0, 10, open="left")
mass = 1 - exp(-2 * kappa)
across = 1 / sqrt(1 + alpha**2 * v**2)

paper.claim(
    "claim.sg-beckmann-asymptotic.scaled",
    "at slopes of the size of the roughness, tan(theta) = alpha v, the two distributions agree for small alpha",
    left=spherical_gaussian(across, alpha) / beckmann(across, alpha),
    printed=across**4 * exp(alpha**2 * v**4 * (1 + 2 * across) / (1 + 1 / across) ** 2) / mass,
    where=[interval(v, 0, 6), interval(alpha, Rational(1, 20), 1)],
    statement=True,
    reading="both per steradian; the right side goes to 1 with alpha, uniformly for v in any bounded range, and is "
    "1 + O(alpha^2 (v^2 + v^4)); as both are at most of the size exp(-v^2) / alpha^2, this is their whole mass",
)

fixed = paper.claim(
    "claim.sg-beckmann-asymptotic.fixed",
    "at a fixed angle off the pole they do not: the ratio goes to infinity as alpha goes to 0",
    left=spherical_gaussian(x, alpha) / beckmann(x, alpha),
    printed=x**4 * exp((1 - x) ** 2 * (1 + 2 * x) / (alpha * x) ** 2) / mass,
    where=[interval(x, Rational(1, 5), 1), interval(alpha, Rational(1, 10), 2)],
    statement=True,
    reading="both per steradian; for 0 < x < 1 the exponent is positive, and for x <= 0 there is no D_B at all",
)

paper.whole(
    "claim.sg-beckmann-asymptotic",
    "D_SG is asymptotic to D_B for small roughness: true at every slope v = tan(theta) / alpha, not at a fixed angle",
    ["claim.sg-beckmann-asymptotic.scaled", "claim.sg-beckmann-asymptotic.fixed"],
    left=Integer(0),
    reading="read at the scale of the lobe, as it is meant: alpha was chosen so that the lobes agree",
)

isotropic = paper.claim(
    "claim.sg-isotropic",
    "D_SG goes to the isotropic 1 / (4 pi) as alpha goes to infinity: its largest value, over that, is "
    "kappa + kappa coth(kappa)",
    left=4 * pi * spherical_gaussian(1, alpha),
    printed=kappa + kappa * coth(kappa),
    where=[interval(alpha, 0, oo, open=True)],
    statement=True,
    reading="per steradian; D_SG grows with u and has the mean 1 / (4 pi), its least value is smaller than that by "
    "1 - kappa (coth(kappa) - 1) <= kappa, and kappa coth(kappa) <= 1 + kappa^2 / 3: so 4 pi D_SG - 1 is at most "
    "kappa + kappa^2 / 3 in modulus for all u, kappa = 2 / alpha^2",
)

paper.out_of_scope(
    "claim.compact-form",
    "a simple compact form of the cross-section is suspected to exist or not to exist, and was not found",
    because="what counts as simple or compact is not defined, and that somebody failed to find a form proves nothing; "
    "the project's own forms are under xsec:sg-positive, xsec:sg-integral and xsec:sg-chebyshev",
)
paper.out_of_scope(
    "claim.canonical-extension",
    "the spherical Gaussian is the canonical extension of Beckmann's distribution to the sphere",
    because="a choice of words; what can be tested of it is claim.sg-beckmann-asymptotic",
)
differ = paper.claim(
    "claim.distributions-differ",
    "for large roughness the two distributions differ: at the pole their ratio is 1 / (1 - exp(-2 kappa))",
    left=spherical_gaussian(1, alpha) / beckmann(1, alpha),
    printed=1 / mass,
    where=[interval(alpha, 0, oo, open=True)],
    statement=True,
    reading="the ratio grows like alpha^2 / 4 with the roughness, since D_SG goes to 1 / (4 pi) there and D_B to 0; "
    "below the horizon there is no D_B at any roughness",
)

paper.out_of_scope(
    "claim.efficient",
    "the approximate forms are efficient, one improvement is easy, others are useful or reasonable",
    because="no cost or criterion is stated; the accuracies are claims of their own, and speed is measured elsewhere",
)


@fixed.proof
@isotropic.proof
@differ.proof
def exponents_collected(step):
    step.close()


conclusion = Source("deon2016", section="3")

conclusion.out_of_scope(
    "claim.two-steps",
    "a new distribution needs its cross-section and the sampling of its visible normals",
    because="a plan of work",
)
conclusion.out_of_scope(
    "claim.plausible",
    "the ellipsoidal and the spherical Gaussian distributions are plausible and desirable extensions",
    because="a matter of appearance and taste; that both end in a flat surface and in an isotropic medium is "
    "claim.flat-limit, claim.sg-isotropic and what section 2.4 says of b",
)
if __name__ == "__main__":
    paper.tell()
    conclusion.tell()
