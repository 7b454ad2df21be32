"""Section 3.2: Smith's functions from exponential attenuation, (20)-(22).

Light that leaves towards omega_i is attenuated by sigma(omega_i) = Lambda cos(theta_i), (18), and light that enters
from there by sigma(-omega_i) = (1 + Lambda) cos(theta_i), (19).
"""

from sympy import Abs, Function, Integral, exp, log, oo, symbols

from xsec_sym.proof import Source, interval

paper = Source("dupuy2016", section="3.2")

x, z, U, ell = symbols("x z U ell", real=True)
c_i, c_o = symbols("c_i c_o", real=True)  # cos(theta_i), cos(theta_o)
s_i, s_o = symbols("sigma_i sigma_o", real=True)  # sigma(omega_i), sigma(omega_o)
L_i, L_o = symbols("Lambda_i Lambda_o", real=True)

V, W = Function("V_i", real=True), Function("V_o", real=True)
SEEN = {V: (lambda v: exp(v), lambda v: 1 / (1 + v**2)), W: (lambda v: exp(3 * v), lambda v: 1 / (2 - v))}


# --- masking --------------------------------------------------------------------------------------------

OUTWARD = "V(r -> infinity) = exp(-sigma l) by (11), over the length l = -z / cos(theta); the depth -z is exponential, "
OUTWARD += "by (16)"
SLANTED = [interval(c_i, 0, 1, open="left"), interval(s_i, 0, oo)]
BOTH = [*SLANTED, interval(c_o, 0, 1, open="left"), interval(s_o, 0, oo)]
LAMBDAS = [interval(L_i, 0, oo), interval(L_o, 0, oo)]
COSINES = [interval(c_i, 0, 1, open="left"), interval(c_o, 0, 1, open="left")]


def visible(area, cosine):
    """From the height z, by (11)."""
    return exp(-area * (-z / cosine))


def mean(seen):
    """Over the heights of (16), whose density is exp(z)."""
    return Integral(exp(z) * seen, (z, -oo, 0))


DEPTH = Abs(log(U))
mask, pair = visible(s_i, c_i), visible(s_i, c_i) * visible(s_o, c_o)

sampled_one = paper.claim(
    "20.1",
    "the mean visibility as an integral over uniform numbers",
    left=mean(V(z)),
    printed=Integral(V(log(U)), (U, 0, 1)),
    instances=SEEN,
    reading="r(U) is the point at the height log(U); V is any visibility of its height",
)
sampled_two = paper.claim(
    "21.1",
    "the mean of both visibilities as an integral over uniform numbers",
    left=mean(V(z) * W(z)),
    printed=Integral(V(log(U)) * W(log(U)), (U, 0, 1)),
    instances=SEEN,
    reading="r(U) is the point at the height log(U)",
)
attenuated_one = paper.claim(
    "20.2",
    "the masking function by the attenuation",
    left=mean(mask),
    printed=Integral(exp(-DEPTH * (s_i / c_i)), (U, 0, 1)),
    where=SLANTED,
    reading=OUTWARD,
)
attenuated_two = paper.claim(
    "21.2",
    "the masking-shadowing function by the attenuation",
    left=mean(pair),
    printed=Integral(exp(-DEPTH * (s_i / c_i + s_o / c_o)), (U, 0, 1)),
    where=BOTH,
    reading=OUTWARD,
)


@sampled_one.proof
@sampled_two.proof
@attenuated_one.proof
@attenuated_two.proof
def height_for_number(step):
    """U = exp(z)."""
    step.swap().substitute(z, exp(z), -oo, 0)


rational_one = paper.claim(
    "20.3",
    "the masking function by the projected area",
    left=mean(mask),
    printed=1 / (1 + s_i / c_i),
    where=SLANTED,
    reading=OUTWARD,
)
rational_two = paper.claim(
    "21.3",
    "the masking-shadowing function by the projected areas",
    left=mean(pair),
    printed=1 / (1 + s_i / c_i + s_o / c_o),
    where=BOTH,
    reading=OUTWARD,
)
masking = paper.claim(
    "20.4",
    "the masking function by Lambda",
    left=mean(visible(L_i * c_i, c_i)),
    printed=1 / (1 + L_i),
    where=[LAMBDAS[0]],
    reading=OUTWARD + "; sigma(omega_i) = Lambda cos(theta_i), by (18)",
)
bistatic = paper.claim(
    "21.4",
    "the masking-shadowing function by Lambda",
    left=mean(visible(L_i * c_i, c_i) * visible(L_o * c_o, c_o)),
    printed=1 / (1 + L_i + L_o),
    where=LAMBDAS,
    reading=OUTWARD + "; sigma(omega) = Lambda cos(theta), by (18)",
)


def decaying(claim, rate):
    """exp(rate z) from -oo to 0."""
    claim.proof(lambda step: step.antiderivative(exp(rate * z) / rate))


decaying(rational_one, 1 + s_i / c_i)
decaying(rational_two, 1 + s_i / c_i + s_o / c_o)
decaying(masking, 1 + L_i)
decaying(bistatic, 1 + L_i + L_o)

for number, title, left, printed in (
    ("20", "Smith's masking function", mean(V(z)), 1 / (1 + L_i)),
    ("21", "Smith's masking-shadowing function", mean(V(z) * W(z)), 1 / (1 + L_i + L_o)),
):
    paper.whole(number, title, [f"{number}.{line}" for line in (1, 2, 3, 4)], left=left, printed=printed)


# --- shadowing of what is seen --------------------------------------------------------------------------

# The path comes in along -omega_i: its collisions are spaced by sigma(-omega_i) = cos(theta_i) + sigma(omega_i).
s_in = c_i + s_i
PATH = "the path enters along -omega_i, so its first collision lies at the length l with the density "
PATH += "sigma(-omega_i) exp(-sigma(-omega_i) l), by (9), and at the depth l cos(theta_i); "
PATH += "sigma(-omega_i) = cos(theta_i) + sigma(omega_i), by (18) and (19)"
EDIT = "sigma(-omega_i) for sigma(omega_i): the path that originates from omega_i travels along -omega_i"


def along_the_path(area, seen):
    """Over the length of the first free path, by (9)."""
    return Integral(area * exp(-area * ell) * seen, (ell, 0, oo))


def from_the_path(area, beyond, cosine, other):
    """The mean visibility towards the other direction from where the path collides."""
    return along_the_path(area, visible(beyond, other).subs(z, -ell * cosine))


shadowed = from_the_path(s_in, s_o, c_i, c_o)

by_numbers = paper.claim(
    "22.1",
    "shadowing given masking as an integral over uniform numbers",
    left=shadowed,
    printed=Integral(exp(-DEPTH * (c_i / s_i) * (s_o / c_o)), (U, 0, 1)),
    corrected=Integral(exp(-DEPTH * (c_i / s_in) * (s_o / c_o)), (U, 0, 1)),
    edit=EDIT,
    where=[COSINES[0], interval(s_i, 0, oo, open="left"), COSINES[1], interval(s_o, 0, oo)],
    reading=PATH,
)

by_areas = paper.claim(
    "22.2",
    "shadowing given masking by the projected areas",
    left=shadowed,
    printed=1 / (1 + c_i / s_i * (s_o / c_o)),
    corrected=1 / (1 + c_i / s_in * (s_o / c_o)),
    edit=EDIT,
    where=[COSINES[0], interval(s_i, 0, oo, open="left"), COSINES[1], interval(s_o, 0, oo)],
    reading=PATH,
)

by_lambdas = paper.claim(
    "22.3",
    "shadowing given masking by Lambda",
    left=from_the_path((1 + L_i) * c_i, L_o * c_o, c_i, c_o),
    printed=(1 + L_i) / (1 + L_i + L_o),
    where=[*LAMBDAS, COSINES[0]],
    reading=PATH,
)


def free_path(claim, area, beyond):
    """Collided at l and seen from outside: area exp(-(area + beyond) l)."""
    rate = area + beyond
    claim.proof(lambda step: step.antiderivative(-area * exp(-rate * ell) / rate))


@by_numbers.proof
def number_for_length(step):
    """U = exp(-sigma(-omega_i) l)."""
    step.swap().substitute(ell, exp(-s_in * ell), oo, 0)


free_path(by_areas, s_in, s_o * c_i / c_o)
free_path(by_lambdas, (1 + L_i) * c_i, L_o * c_i)

paper.whole(
    "22",
    "Smith's shadowing function of a point that is seen from omega_i",
    ["22.1", "22.2", "22.3"],
    left=shadowed,
    printed=by_lambdas.printed,
    reading="the lines 1 and 2 as printed give 1 / (1 + Lambda_o / Lambda_i), which is not line 3",
)

weights = mean(visible(L_i * c_i, c_i) * visible(L_o * c_o, c_o)) / mean(visible(L_i * c_i, c_i))

conditional = paper.claim(
    "22.conditional",
    "line 3 is the conditional mean: both visibilities over the first",
    left=weights,
    corrected=(1 + L_i) / (1 + L_i + L_o),
    where=LAMBDAS,
    reading="heights by (16), weighted by V_i, which is what the left side of (22) says without its path",
)

bayes = paper.claim(
    "22.bayes",
    "the collisions of a path from omega_i lie where points seen from omega_i lie",
    left=(1 + L_i) * exp((1 + L_i) * x),
    corrected=exp(x) * visible(L_i * c_i, c_i).subs(z, x) / mean(visible(L_i * c_i, c_i)),
    where=[interval(x, -oo, 0), LAMBDAS[0]],
    reading="densities over the height: (9) with sigma(-omega_i) = (1 + Lambda) cos(theta_i) on the left, Bayes' rule "
    "with V_i on the right. So the two readings of (22) agree for any shadowing, not only for exponentials",
)

caption = paper.claim(
    "claim.figure5-right",
    "the caption of Figure 5, right: (22) is the probability to be seen from omega_i, given to be seen from omega_o",
    left=mean(visible(L_i * c_i, c_i) * visible(L_o * c_o, c_o)) / mean(visible(L_o * c_o, c_o)),
    printed=(1 + L_i) / (1 + L_i + L_o),
    where=LAMBDAS,
    reading="the caption exchanges omega_i and omega_o: that probability has 1 + Lambda_o above",
    statement=True,
)

exchanged = paper.claim(
    "22.exchanged",
    "what the caption of Figure 5, right, describes",
    left=caption.left,
    corrected=(1 + L_o) / (1 + L_i + L_o),
    where=LAMBDAS,
)


def two_means(claim, above, below):
    def ratio(step):
        first, second = sorted(step.integrals, key=lambda i: len(i.free_symbols), reverse=True)
        step.antiderivative(exp(above * z) / above, first)
        step.antiderivative(exp(below * z) / below, second)

    claim.proof(ratio)


two_means(conditional, 1 + L_i + L_o, 1 + L_i)
two_means(exchanged, 1 + L_i + L_o, 1 + L_o)


@bayes.proof
def normalised(step):
    step.swap().antiderivative(exp((1 + L_i) * z) / (1 + L_i))


for slug, title, because in (
    (
        "smith-shadowing",
        "the Smith shadowing functions arise from the exponential attenuation of a height field's flakes",
        "a summary of this section; what it says has the verdicts of (18)-(22)",
    ),
    (
        "figure5",
        "the caption of Figure 5, left and middle, names what (20) and (21) are the probabilities of",
        "a drawing; the probabilities have the verdicts of (20) and (21)",
    ),
):
    paper.out_of_scope(f"claim.{slug}", title, because=because)

if __name__ == "__main__":
    paper.tell()
