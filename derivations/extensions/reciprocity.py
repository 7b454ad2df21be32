"""For which distributions of normals is the transport that emerges from a half-space of flakes reciprocal?

dupuy2016, section 4.1, leaves this open. The answer, with M = the integral of m D(m) dm, the flakes' area as a vector,
and a micro-BSDF that is reciprocal itself, f(m, i, o) = f(m, o, i):

*If M is parallel to the macroscopic normal*, every path has the throughput of its reverse, so that the BRDF is
reciprocal in every order of scattering, whatever the albedo. Opposite directions differ in the cross-section by
omega . M (`reciprocity-odd`), so a path and its reverse differ in the attenuation by exp(M . (end - start))
(`reciprocity-path`), which is 1 between two points of the interface. The vertices contribute the same both ways
(`reciprocity-vertex`), and so do the squared distances and the lateral shifts over which a BRDF is summed.

*Only if.* Let the flakes' albedo be a: the BRDF is a power series in a, which begins with single scattering. Reciprocal
for all a in some interval from 0, it is reciprocal term by term. Swapping i and o changes single scattering by
`reciprocity-single.difference`, which is not 0 where M's lateral part M_t is not orthogonal to tan(i) - tan(o), the
lateral parts of i / cos and o / cos, and the flakes scatter from i to o at all, K > 0. So M_t = 0, provided that such a
pair of directions exists. It does for diffuse flakes: M_t is not 0 only if some flakes have a normal m other than the
axis's opposite, and these see a whole open set of pairs above the horizon (`reciprocity.only-if.pair`). It does for
mirrors, if D is a density that is not 0 everywhere above the horizon: they scatter between all pairs about m. So the
emerging transport is reciprocal for *every* reciprocal micro-BSDF and albedo exactly where M is parallel to the
macroscopic normal.

The proviso is needed. Black flakes are reciprocal for any D; so are flakes that return light where it came from, since
i = o; so are mirrors that all face down, since nothing emerges (`reciprocity-proviso.down`). And one fixed albedo is
not settled by the power series: there higher orders could cancel single scattering in the BRDF. In the BSSRDF they
cannot: all paths from one point of the interface to another differ from their reverse by the same factor,
exp(M_t . shift), so that it is reciprocal between the two exactly where M_t is orthogonal to their distance, or no
light passes.

Heights whose mean slope is 0 (M is the normal) and symmetric distributions (M = 0) are special cases;
`reciprocity_examples.py` has others, and distributions that are not reciprocal.
"""

from sympy import Abs, Function, Integral, Max, Rational, Sum, diff, exp, oo, symbols

from xsec_sym.exact.reciprocity import (
    TRIED,
    dot,
    less,
    mean_normal,
    opposite,
    projected_area,
)
from xsec_sym.proof import Source, integers, interval

project = Source("xsec", section="reciprocity")

ANY = "any D, as a list of normals; omega is the direction of travel, and the medium is as dense everywhere"
BOTH_WAYS = "sigma(omega) and sigma(-omega) are written as E -+ omega . M / 2, E = |omega . m| / 2 over all flakes"


def reals(*names):
    return [interval(v, -oo, oo) for v in names]


omega = symbols("omega_x omega_y omega_z", real=True)
M = symbols("M_x M_y M_z", real=True)
ell, s = symbols("ell s", real=True)


# --- opposite directions --------------------------------------------------------------------------------

odd = project.claim(
    "reciprocity-odd",
    "opposite directions differ in the cross-section by omega . M",
    left=projected_area(opposite(omega)) - projected_area(omega),
    corrected=dot(omega, mean_normal()),
    where=reals(*omega),
    instances=TRIED,
    reading=ANY + "; max(0, c) - max(0, -c) = c",
)

cosine = symbols("c", real=True)

even = project.claim(
    "reciprocity-even",
    "the mean of opposite directions is the cross-section of flakes with two sides, of half the area each",
    left=Max(0, cosine) + Max(0, -cosine),
    corrected=Abs(cosine),
    where=reals(cosine),
    reading="flake by flake, c = omega . m",
)

thickness = project.claim(
    "reciprocity-thickness",
    "the optical thickness of a straight way is the cross-section of the way as a vector",
    left=ell * Max(0, -cosine),
    corrected=Max(0, -ell * cosine),
    where=[*reals(cosine), interval(ell, 0, oo)],
    reading="flake by flake, c = omega . m; ell omega is the way",
)

bound = project.inequality(
    "reciprocity-symmetric.if",
    "where M = 0 the cross-section is symmetric: opposite directions differ by at most |M|",
    greater=dot(omega, omega) * dot(M, M),
    lesser=dot(omega, M) ** 2,
    where=reals(*omega, *M),
    reading="omega . M is the difference by xsec:reciprocity-odd; Cauchy and Schwarz",
)

axes = [tuple(s if i == j else 0 for j in range(3)) for i in range(3)]
along_the_axes = project.claim(
    "reciprocity-symmetric.only-if",
    "where the cross-section is symmetric M = 0: the differences along three axes are its components",
    left=sum((projected_area(opposite(e)) - projected_area(e)) ** 2 for e in axes),
    corrected=s**2 * dot(mean_normal(), mean_normal()),
    where=reals(s),
    instances=TRIED,
    reading=ANY + "; where the left side is 0, each component of M is",
)

odd.proof(lambda step: None)
along_the_axes.proof(lambda step: None)


@even.proof
def either_side(step):
    for side in step.cases(cosine):
        side.settle()


@thickness.proof
def scale(step):
    for long in step.cases(ell):
        if long.is_empty:
            long.vacuous()
        elif long.goal.piece.facts_about(ell):
            for side in long.cases(cosine):
                side.settle()


@bound.proof
def lagrange(step):
    pairs = ((0, 1), (1, 2), (2, 0))
    step.fact(step.right, *((omega[i] * M[j] - omega[j] * M[i]) ** 2 for i, j in pairs)).settle()


project.whole(
    "reciprocity-symmetric",
    "the cross-section is symmetric if and only if M = 0",
    ["reciprocity-symmetric.if", "reciprocity-symmetric.only-if"],
    left=dot(omega, M),
)


# --- paths ----------------------------------------------------------------------------------------------

n = symbols("n", integer=True, nonnegative=True)
j = symbols("j", integer=True, positive=True)
place = tuple(Function(f"r_{axis}", real=True) for axis in "xyz")
E = Function("E", real=True)
PLACES = {
    place[0]: (lambda k: k**2, lambda k: Rational(1, 3) - k),
    place[1]: (lambda k: 1 / (1 + k), lambda k: k / (2 + k)),
    place[2]: (lambda k: -k, lambda k: k**3 - 2),
}


def at(k):
    return tuple(f(k) for f in place)


def leg(k):
    return less(at(k), at(k - 1))


def there(k):
    """The optical thickness of leg k; on the way back M counts the other way."""
    return E(k) - dot(leg(k), M) / 2


def back(k):
    return E(k) + dot(leg(k), M) / 2


path = project.claim(
    "reciprocity-path",
    "by how much the way back is thicker, for a path of any number of segments",
    left=Sum(back(j) - there(j), (j, 1, n)),
    corrected=dot(less(at(n), at(0)), M),
    where=[integers(n, 1), *reals(*M)],
    instances=PLACES,
    reading=BOTH_WAYS + ". So with T the throughput, T(path) = exp(M . (r_n - r_0)) T(reverse): on an interface with "
    "the normal along M, the same; in a bounded medium it is so between all points of its surface only if M = 0",
)
path.proof(lambda step: step.telescope(dot(at(j), M)))


# --- the vertices ---------------------------------------------------------------------------------------

out = symbols("o_x o_y o_z", real=True)
m = symbols("m_x m_y m_z", real=True)
g = Function("g", real=True)
BSDF = {g: (lambda *v: 1 + v[0] + v[3] ** 2 / 5, lambda *v: exp(v[4] - v[1]))}


def micro(i, o):
    """Any reciprocal micro-BSDF is of this form, with itself for g."""
    return (g(*i, *o) + g(*o, *i)) / 2


def vertex(before, after):
    """One flake's part in sigma f_p, by (5) and (6): what turns travel along ``before`` into travel along ``after``.

    The axes are the flake's own, the third its normal.
    """
    return micro(opposite(before), after) * Max(0, after[2]) * Max(0, -before[2])


project.claim(
    "reciprocity-vertex",
    "sigma f_p is the same for a path and its reverse, flake by flake",
    left=vertex(omega, out),
    corrected=vertex(opposite(out), opposite(omega)),
    where=[interval(v, -1, 1) for v in (*omega, *out)],
    instances=BSDF,
    reading="f = (g(i, o) + g(o, i)) / 2 with any g is any reciprocal micro-BSDF; it may differ from flake to flake. "
    "The axes are the flake's own. D is a factor on both sides, over which both are integrated",
).proof(lambda step: None)


# --- single scattering ----------------------------------------------------------------------------------

K, z, c_i, c_o, s_i, s_o = symbols("K z c_i c_o s_i s_o", real=True)
COSINES = [interval(v, 0, 1, open="left") for v in (c_i, c_o)]
once = exp(-z * (s_i / c_i + s_o / c_o)) * K / (c_i * c_o)

single = project.claim(
    "reciprocity-single",
    "the BRDF of single scattering, as an integral over depth",
    left=Integral(once, (z, 0, oo)),
    corrected=K / (s_i * c_o + s_o * c_i),
    where=[*COSINES, interval(s_i, 0, oo, open=True), interval(s_o, 0, oo), interval(K, 0, oo)],
    reading="K = sigma f_p from -i to o, s_i = sigma(-i) on the way in, s_o = sigma(o) on the way out",
)
single.proof(lambda step: step.antiderivative(-once / (s_i / c_i + s_o / c_o)))

p = symbols("p_x p_y", real=True)
q = symbols("q_x q_y", real=True)


def in_and_out(a, b):
    """sigma(-i) / cos(theta_i) + sigma(o) / cos(theta_o), with i / cos = (a, 1) and o / cos = (b, 1)."""
    return projected_area(opposite((*a, 1))) + projected_area((*b, 1))


project.claim(
    "reciprocity-single.denominator",
    "what swapping i and o takes off the denominator of single scattering: M_t . (tan(i) - tan(o))",
    left=in_and_out(p, q) - in_and_out(q, p),
    corrected=dot(less(p, q), mean_normal()[:2]),
    where=reals(*p, *q),
    instances=TRIED,
    reading=ANY + "; the denominator is that of K / (c_i c_o); p and q are the lateral parts of i / c_i and o / c_o",
).proof(lambda step: None)

N, B = symbols("N B", real=True)

project.claim(
    "reciprocity-single.difference",
    "what swapping i and o takes off single scattering: nothing exactly where K B = 0",
    left=K / (c_i * c_o) / N - K / (c_i * c_o) / (N - B),
    corrected=-K * B / (c_i * c_o * N * (N - B)),
    where=[*COSINES, interval(B, -oo, oo), interval(N, 0, oo, open=True), interval(K, 0, oo), N > B],
    reading="N = sigma(-i) / c_i + sigma(o) / c_o and B = M_t . (tan(i) - tan(o)), as in "
    "xsec:reciprocity-single.denominator; K is the same both ways by xsec:reciprocity-vertex",
).proof(lambda step: None)


# --- the answer -----------------------------------------------------------------------------------------

height = Function("h", real=True)
up_and_down = {height: (lambda k: -1 - k, lambda k: k**2 / 3 - 5)}


def from_the_interface(k):
    """A height that is 0 at both ends of the path and anything between them."""
    return k * (n - k) * height(k)


M_z = M[2]
outside = project.claim(
    "reciprocity.if.path",
    "M along the normal: a path from the interface to the interface is as thick as its reverse",
    left=Sum(M_z * (from_the_interface(j) - from_the_interface(j - 1)), (j, 1, n)),
    corrected=0,
    where=[integers(n, 1), interval(M_z, -oo, oo)],
    instances=up_and_down,
    reading=BOTH_WAYS + ", and M = (0, 0, M_z): of each segment only the rise counts. The path lies anywhere else",
)


@outside.proof
def ends_at_the_interface(step):
    last = step.left.limits[0][2]
    step.telescope((M_z * from_the_interface(j)).subs(n, last))


project.whole(
    "reciprocity.if",
    "the emerging transport is reciprocal in every order of scattering if M is parallel to the macroscopic normal",
    ["reciprocity-odd", "reciprocity-thickness", "reciprocity-path", "reciprocity-vertex", "reciprocity.if.path"],
    left=dot(omega, M),
    reading="assumes a reciprocal micro-BSDF, f(m, i, o) = f(m, o, i), and the same D everywhere in the half-space",
)

eps = symbols("epsilon", real=True)
pair = project.claim(
    "reciprocity.only-if.pair",
    "a pair of directions that every flake other than one that lies face down offers: K > 0 there, and B is not 0",
    left=dot((q[0] + eps * M[0], q[1] + eps * M[1], 1), m) * dot((*q, 1), m),
    corrected=dot((*q, 1), m) ** 2 + eps * dot(M[:2], m[:2]) * dot((*q, 1), m),
    where=reals(*q, *m, *M[:2], eps),
    reading="o / c_o = (q, 1) sees the flake, so q . m_t + m_z > 0: any large multiple of m_t will do for q. With "
    "i / c_i = o / c_o + epsilon M_t and epsilon of the sign of M_t . m_t the product of cosines is positive, and "
    "B = epsilon |M_t|^2",
)
pair.proof(lambda step: None)

project.whole(
    "reciprocity.only-if",
    "and only if, provided that flakes scatter between directions with M_t . (tan(i) - tan(o)) not 0",
    ["reciprocity-vertex", "reciprocity-single", "reciprocity-single.denominator", "reciprocity-single.difference",
     "reciprocity.only-if.pair"],
    left=dot(less(p, q), M[:2]),
    reading="assumes a reciprocal micro-BSDF, and reciprocity for all albedos in an interval from 0, so that the terms "
    "of the power series are reciprocal one by one. Diffuse flakes meet the proviso for every D with M_t not 0, and "
    "mirrors for every density D that is not 0 on the upper hemisphere",
)  # fmt: skip


# --- what non-reciprocity inside amounts to -------------------------------------------------------------

e, b, value, slope = symbols("e b F F'", real=True)
F = Function("F", real=True)


def along_a_ray(f):
    """A derivative along the ray, with a name for the slope of the unknown radiance."""
    return diff(f, ell).subs({diff(F(ell), ell): slope}).subs({F(ell): value})


project.claim(
    "reciprocity-gauge",
    "with L = exp(M . r / 2) L', L' travels through a medium whose extinction is the same both ways",
    left=along_a_ray(exp(b * ell / 2) * F(ell)) + (e - b / 2) * exp(b * ell / 2) * value,
    corrected=exp(b * ell / 2) * (slope + e * value),
    where=[*reals(b, value, slope), interval(ell, 0, oo), interval(e, 0, oo)],
    reading="along one ray, b = omega . M, e the mean of sigma(omega) and sigma(-omega); in-scattering takes the same "
    "factor. On an interface with the normal along M the factor is 1, so one-sided flakes and flakes with two sides of "
    "half the area, which scatter by the same sigma f_p, have the same emerging transport",
).proof(lambda step: None)

heights = symbols("z_1 z_2", real=True)
project.claim(
    "reciprocity-balance",
    "inside the medium: the chance to be above the surface, times the visibility, is the same both ways",
    left=exp(heights[0]) * exp(-(e - (heights[1] - heights[0]) / 2)),
    corrected=exp(heights[1]) * exp(-(e + (heights[1] - heights[0]) / 2)),
    where=[*(interval(v, -oo, 0) for v in heights), interval(e, 0, oo)],
    reading="a height field with M the normal, from z_1 to z_2; by dupuy2016 (13) exp(z) = C_1(zeta) is the "
    "chance that the surface lies below. " + BOTH_WAYS + ", E being the mean thickness e",
).proof(lambda step: None)

if __name__ == "__main__":
    project.tell()
