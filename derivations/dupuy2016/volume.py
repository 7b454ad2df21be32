"""Section 2: the semi-infinite homogeneous volume of microflakes, (1)-(7).

(1) says in which direction the radiance L(omega) travels: along omega. Light that travels along omega meets the flakes
with omega . omega_m < 0, so (4) is the extinction of light travelling along omega. Where one direction matters, A(c) is
the distribution of normals summed over the azimuths about it: any distribution can be written so.
"""

from sympy import Function, Heaviside, Integral, Max, Piecewise, cos, diff, exp, oo, pi, sqrt, symbols

from derivations.kenha2018.surface import normal as mirror_normal
from derivations.kenha2018.surface import on_the_sphere, phi, reflected
from derivations.kenha2018.surface import theta as half
from xsec_sym.exact import ahead, behind
from xsec_sym.exact.smith import COSINE as c
from xsec_sym.proof import Source, interval

paper = Source("dupuy2016", section="2")

u, x, y, t, p, q, ell, z, albedo = symbols("u x y t p q ell z a", real=True)
sigma, source, radiance = symbols("sigma S L_0", real=True)
up, down = symbols("D_+ D_-", real=True)
omega, omega_1, omega_2, omega_m = symbols("omega omega_1 omega_2 omega_m", real=True)
facing = symbols("(-omega_1.omega_m)", real=True)
leaving = symbols("(omega_2.omega_m)", real=True)

A = Function("A", real=True, nonnegative=True)
L = Function("L", real=True, nonnegative=True)
D, D_vis, f_p, f_s, S = (Function(n, real=True) for n in ("D", "D_vis", "f_p", "f_s", "S"))
sigma_s, sigma_t, L_e = (Function(n, real=True) for n in ("sigma_s", "sigma_t", "L_e"))
FACETS = {A: (lambda v: exp(v), lambda v: (1 + v) ** 2, lambda v: 1 / (2 - v))}
BEAMS = {L: (lambda v: exp(v), lambda v: (1 + v) ** 2, lambda v: 1 / (2 - v))}

DENSE = interval(sigma, 0, oo, open=True)
LONG = interval(ell, 0, oo)
AROUND = "A(c) is D summed over the azimuths about -omega_1, c = -omega_1 . omega_m"


# --- the equation of transfer ---------------------------------------------------------------------------

paper.definition(
    "1",
    "the equation of radiative transfer",
    left=Function("omega_1.grad", real=True)(L(omega_1)) + sigma_t(omega_1) * L(omega_1),
    printed=S(omega_1),
    reading="L(omega_1) is the radiance that travels along omega_1; the equation introduces the source term",
)

along = radiance * exp(-sigma * ell) + source / sigma * (1 - exp(-sigma * ell))

paper.claim(
    "1.solution",
    "along a ray in a homogeneous medium: what starts is attenuated as in (11), what is emitted on the way too",
    left=diff(along, ell) + sigma * along,
    corrected=source,
    where=[DENSE, LONG, interval(source, 0, oo), interval(radiance, 0, oo)],
    reading="L = L_0 exp(-sigma l) + the integral of S exp(-sigma (l - l')) from 0 to l, S constant along the ray",
).proof(lambda step: None)

# Flakes of two kinds, facing up and facing down, diffuse, that reflect all light. u is the cosine of omega_1, x that
# of omega_2, both with the upward direction, and L is the same all around.


def extinction(v):
    """(4) for light with the cosine v: falling light meets the flakes that face up."""
    return up * Max(0, -v) + down * Max(0, v)


def scattering(v, v_out):
    """sigma(v) f_p(v -> v_out), by (5) and (6) with f_s = 1 / pi."""
    return (up * Max(0, -v) * Max(0, v_out) + down * Max(0, v) * Max(0, -v_out)) / pi


falling = Integral(2 * pi * (-x) * L(x), (x, -1, 0))  # what an upward face receives, per area
rising = Integral(2 * pi * x * L(x), (x, 0, 1))
FLAKES = "tried on diffuse one-sided flakes of albedo 1, D_+ of them facing up and D_- down, in light that is the same "
FLAKES += "all around the vertical; u is the cosine of omega_1, x that of omega_2"
AMOUNTS = [interval(up, 0, oo), interval(down, 0, oo)]

inscattered = paper.claim(
    "2",
    "the light that is scattered into omega_1",
    left=(up * Max(0, u) * falling + down * Max(0, -u) * rising) / pi,
    printed=Integral(2 * pi * scattering(u, x) * L(x), (x, -1, 1)),
    corrected=Integral(2 * pi * scattering(x, u) * L(x), (x, -1, 1)),
    edit="exchange omega_1 and omega_2 in sigma_s f_p and put sigma_s under the integral: the light comes along "
    "omega_2 and is scattered into omega_1, so sigma_s(omega_2) f_p(omega_2 -> omega_1) L(omega_2)",
    where=[interval(u, -1, 1), *AMOUNTS],
    instances=BEAMS,
    reading=FLAKES + ". On the left each face sends out what it receives as a Lambertian emitter. As printed, the "
    "source would be the adjoint one, for importance; it is right where D is symmetric. L_e = 0",
)

symmetric = paper.claim(
    "2.symmetric",
    "as printed, the source is right where D is symmetric",
    left=inscattered.left.subs(down, up),
    corrected=inscattered.printed.subs(down, up),
    where=[interval(u, -1, 1), interval(up, 0, oo)],
    instances=BEAMS,
    reading=FLAKES + "; D_+ = D_-",
)


@inscattered.proof
@symmetric.proof
def face_by_face(step):
    """Falling light meets upward faces, rising light downward ones."""
    for branch in step.cases(u):
        branch.settle().swap().split(0)


sent = inscattered.left
taken = Integral(2 * pi * extinction(x) * L(x), (x, -1, 1))

balance = paper.claim(
    "2.balance",
    "the corrected source sends out all that the flakes take, as albedo 1 asks",
    left=Integral(2 * pi * sent, (u, -1, 1)),
    corrected=taken,
    where=AMOUNTS,
    instances=BEAMS,
    reading=FLAKES + "; the left side is the corrected source over all omega_1",
)


@balance.proof
def hemispheres(step):
    step.split(0)
    for _ in range(2):
        over_u = next(i for i in step.integrals if i.limits[0][0] == u)
        step.linear(over_u.function, integral=over_u)
        over_u = next(i for i in step.integrals if i.limits[0][0] == u)
        step.antiderivative(u**2 / 2, over_u)
    step.swap().split(0)


as_printed = paper.claim(
    "2.as-printed",
    "the source as printed, written out: falling light would light the downward faces",
    left=inscattered.printed,
    corrected=(up * Max(0, -u) * rising + down * Max(0, u) * falling) / pi,
    where=[interval(u, -1, 1), *AMOUNTS],
    instances=BEAMS,
    reading=FLAKES,
)


@as_printed.proof
def face_by_wrong_face(step):
    for branch in step.cases(u):
        branch.split(0).swap().settle()


paper.claim(
    "claim.balance",
    "the source as printed sends out all that the flakes take, as albedo 1 asks",
    left=Integral(2 * pi * as_printed.corrected, (u, -1, 1)),
    printed=taken,
    where=AMOUNTS,
    instances=BEAMS,
    reading=FLAKES + "; written out by 2.as-printed. With flakes that only face up (D_- = 0), light that only falls "
    "would be lost",
    statement=True,
)


# --- the medium -----------------------------------------------------------------------------------------


def medium(height):
    return Piecewise((0, height > 0), (1, True))


paper.definition("3", "the density of flakes", left=Function("rho")(z), printed=medium(z))

paper.definition(
    "4",
    "the projected area of the flakes for light that travels along omega_1",
    left=Function("sigma")(omega_1),
    printed=Integral(facing * Heaviside(facing) * D(omega_m), omega_m),
    reading="over the whole sphere, D per steradian; seen by a viewer in the direction -omega_1",
)

paper.claim(
    "claim.visible-from",
    "sigma(omega_1) is the area that is visible from the direction omega_1",
    left=ahead(A),
    printed=behind(A),
    instances=FACETS,
    reading="A(c) is D summed over the azimuths about omega_1. What a viewer in the direction omega_1 sees has normals "
    "towards omega_1; (4) counts those away from it, which a viewer in the direction -omega_1 sees, where the light "
    "comes from. It matters only where D is not symmetric",
    statement=True,
)

THREE = (p, (-p + sqrt(3) * q) / 2, (-p - sqrt(3) * q) / 2)  # cosines with omega of three normals at right angles to z
TRIANGLE = "three flakes alike, their normals at 120 degrees in a plane, (p, q) being omega in that plane"

hidden = paper.claim(
    "4.hidden-asymmetry",
    "a distribution that is not symmetric, with a projected area that is",
    left=sum(Max(0, -cosine_m) for cosine_m in THREE),
    corrected=sum(Max(0, cosine_m) for cosine_m in THREE),
    where=[interval(p, -1, 1), interval(q, -1, 1)],
    reading=TRIANGLE
    + "; sigma(omega) on the left, sigma(-omega) on the right. They differ by omega . M, and here M = 0",
)
hidden.proof(lambda step: None)

paper.claim(
    "claim.asymmetric",
    "whenever D is not symmetric, sigma is not symmetric",
    left=sum(cosine_m**3 for cosine_m in THREE),
    printed=0,
    where=[interval(p, -1, 1), interval(q, -1, 1)],
    reading="tried the other way round: a D with a symmetric sigma would be symmetric, and have no third moment along "
    "any omega; " + TRIANGLE + ": sigma is symmetric (4.hidden-asymmetry), D is not. What shows in sigma is M alone",
    statement=True,
)


# --- the phase function ---------------------------------------------------------------------------------

paper.definition(
    "5",
    "the phase function",
    left=f_p(omega_1, omega_2),
    printed=Integral(f_s(omega_m, -omega_1, omega_2) * Max(0, leaving) * D_vis(omega_m, omega_1), omega_m),
    reading="from omega_1 into omega_2; the clamp about omega_2 . omega_m leaves out what a flake lets through",
)

paper.definition(
    "6",
    "the distribution of visible normals",
    left=D_vis(omega_m, omega_1),
    printed=Max(0, facing) * D(omega_m) / Function("sigma")(omega_1),
)

seen = Integral(Max(0, y) * A(y), (y, -1, 1))

paper.claim(
    "6.norm",
    "the distribution of visible normals is normalised",
    left=Integral(Max(0, c) * A(c) / seen, (c, -1, 1)),
    corrected=1,
    instances=FACETS,
    reading=AROUND + "; for any D, where sigma is not 0",
).proof(lambda step: step.linear(step.left.function))

paper.claim(
    "5.mirror.jacobian",
    "mirror flakes: the solid angle of omega_2 is 4 omega_h . omega_2 times that of the normals",
    left=on_the_sphere(reflected) / on_the_sphere(mirror_normal),
    corrected=4 * cos(half),
    where=[interval(half, 0, pi / 2, open=True), interval(phi, 0, 2 * pi)],
    reading="theta_m is the angle between -omega_1 and omega_m = omega_h; so f_p = D_vis(omega_h) / "
    "(4 omega_h . omega_2)",
).proof(lambda step: None)

mirrors = paper.claim(
    "5.mirror.norm",
    "mirror flakes: the phase function is normalised",
    left=Integral(A(sqrt((1 + y) / 2)) / 4, (y, -1, 1)) / Integral(c * A(c), (c, 0, 1)),
    corrected=1,
    instances=FACETS,
    reading=AROUND + ", y = -omega_1 . omega_2 = 2 c^2 - 1; f_p = c A(c) / sigma / (4 c). For any D: the clamp about "
    "omega_2 . omega_m = c loses nothing",
)


@mirrors.proof
def half_vector(step):
    step.substitute(t, 2 * t**2 - 1, 0, 1, step.over(-1, 1))


lambertian = Integral(2 * pi * Max(0, x) * albedo / pi, (x, -1, 1))

diffuse = paper.claim(
    "5.diffuse.norm",
    "diffuse flakes: each sends out the share a of what it takes",
    left=lambertian,
    corrected=albedo,
    where=[interval(albedo, 0, 1)],
    reading="f_s = a / pi, over all omega_2, x = omega_2 . omega_m; averaged over D_vis, whose integral is 1 (6.norm), "
    "it is the integral of f_p. The clamp leaves out the dark half, where f_s = 0",
)
diffuse.proof(lambda step: step.split(0).antiderivative(albedo * x**2))


# --- coefficients ---------------------------------------------------------------------------------------

paper.definition(
    "7",
    "the scattering coefficient",
    left=sigma_s(omega_1),
    printed=albedo * sigma_t(omega_1),
    reading="sigma_r, as printed here and in (8)-(11), is the extinction coefficient sigma_t of (1)",
)

paper.claim(
    "claim.albedo",
    "by (2), (5) and (7) flakes of the albedo a scatter the share a of what they stop",
    left=albedo * lambertian,
    printed=albedo,
    where=[interval(albedo, 0, 1)],
    reading="sigma_s / sigma_t times the integral of f_p, f_p by (5) with a BSDF of the albedo a, f_s = a / pi: the "
    "albedo then counts twice. Either f_s is normalised, or sigma_s = sigma_t and f_p carries the albedo, as in (27)",
    statement=True,
)


# --- sentences ------------------------------------------------------------------------------------------

for slug, title, because in (
    (
        "figure1",
        "the caption of Figure 1: a rough surface and a half-space of one-sided flakes transport light alike",
        "that a surface behaves as Smith's model does is an assumption; that model and the half-space are compared in "
        "claim.identical and (20)-(22)",
    ),
    ("figure2", "the caption of Figure 2: the half-space of flakes", "a drawing of (3)"),
    (
        "uncorrelated",
        "the flakes are uncorrelated in space and their directions do not depend on the place",
        "assumptions of the model, from which (4) and (9) follow",
    ),
    (
        "any-bsdf",
        "the BSDF of the flakes does not affect the results",
        "no BSDF occurs in (8)-(22); nothing is left to compute",
    ),
    (
        "numerical",
        "in general the transport has to be solved numerically",
        "says what is not known",
    ),
    (
        "simpler",
        "the homogeneous medium is simpler and more efficient to evaluate",
        "a rendering time and a matter of taste",
    ),
    (
        "new-phase-function",
        "classical media cannot act like a rough surface accurately; a new phase function is needed",
        "it names no class of media. That a symmetric distribution cannot is claim.symmetric-volume",
    ),
):
    paper.out_of_scope(f"claim.{slug}", title, because=because)

if __name__ == "__main__":
    paper.tell()
