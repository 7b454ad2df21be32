"""Where the squared ellipsoidal lobe of tokuyoshi_harada lies above or below the anisotropic GGX that it stands for.

K is the lobe, and G the anisotropic GGX at the half vector, scaled to 1 on the axis. The x axis is the one of the
larger roughness. U, the paper's, is the length of the direction once it is stretched by alpha_x / alpha_y along y, and
everything hangs on it: 1 / sqrt(G) - 1 / sqrt(K) is a product of two factors, U - 1, which is never negative, and
U - P with P = z + alpha_x^2 (1 + z), which changes its sign.
"""

from sympy import pi, sqrt, symbols

from derivations.tokuyoshi_harada.ellipsoid import alpha_max, alpha_x, alpha_y, distance, dot, omega
from derivations.tokuyoshi_harada.lobe import lobe, stretched_length
from derivations.tokuyoshi_harada.spheroid import AREA, ROUGH, alpha
from xsec_sym.exact import LobeGGX, ggx_anisotropic
from xsec_sym.proof import Source, interval

project = Source("xsec", section="ellipsoidal lobe")

y, z = symbols("y z", real=True)
EITHER = [interval(alpha_x, 0, 1, open="left"), interval(alpha_y, 0, alpha_x, open="left")]
SPHERE = [interval(z, -1, 1, open="left"), interval(y, -1, 1), y**2 + z**2 <= 1]
LARGER = (
    "alpha_x >= alpha_y; where it is the other way round, x and y change places. The direction has the unit length, "
    "and the sign of x does not matter"
)
ROOTS = LARGER + ". The claim is on the roots of the two lobes, which are positive"
x = sqrt(1 - y**2 - z**2)

# --- the two lobes --------------------------------------------------------------------------------------

U = stretched_length(x, y, z).subs(alpha_max, alpha_x)
half = tuple(w / sqrt(2 * (1 + z)) for w in (x, y, 1 + z))  # the half vector of the direction and the axis
slopes = (half[0] / alpha_x, half[1] / alpha_y, half[2])
root_K = 2 * alpha_x**2 / ((1 + alpha_x**2) * U - z * (1 - alpha_x**2))
root_G = 1 / dot(slopes, slopes)
P = z + alpha_x**2 * (1 + z)

# 1 / sqrt(K) and 1 / sqrt(G), written out
slim = ((1 + alpha_x**2) * U - z * (1 - alpha_x**2)) / (2 * alpha_x**2)
thick = ((x**2 / alpha_x**2 + y**2 / alpha_y**2) / (1 + z) + 1 + z) / 2
apart = (U - 1) * (U - P) / (2 * alpha_x**2 * (1 + z))


def ready(step):
    """U >= 1, by how much its square exceeds 1; and both inverse roots are positive."""
    excess = y**2 * (alpha_x - alpha_y) * (alpha_x + alpha_y) / alpha_y**2
    step.fact(U**2, 1, excess)
    step.fact(U - 1, excess / (U + 1))
    shares = (1 + alpha_x**2) * (U - 1) / (2 * alpha_x**2), 1, (1 - alpha_x**2) * (1 - z) / (2 * alpha_x**2)
    step.fact(slim, *shares)
    step.fact(thick, (1 - z) / (2 * alpha_x**2), excess / (2 * alpha_x**2 * (1 + z)), (1 + z) / 2)


isotropic = project.claim(
    "sel-isotropic",
    "for one roughness the ellipsoidal lobe is GGX at half the angle",
    left=LobeGGX(z, alpha),
    corrected=lobe(x, y, z).subs({alpha_x: alpha, alpha_y: alpha}),
    where=[*SPHERE, ROUGH],
    reading=AREA,
)
isotropic.proof(lambda step: step.unfold())

project.claim(
    "sel-axis",
    "the ellipsoidal lobe is 1 on its axis",
    left=distance.subs(dict(zip(omega, (0, 0, 1), strict=True))) ** 2,
    corrected=1,
    where=EITHER,
).proof(lambda step: step.settle())

project.claim(
    "sel-stands-for",
    "the anisotropic GGX at the half vector, scaled to 1 on the axis, by the root that it has there",
    left=pi * alpha_x * alpha_y * ggx_anisotropic(*half, alpha_x, alpha_y),
    corrected=thick**-2,
    where=[*SPHERE, *EITHER],
    reading=LARGER + "; D per steradian with unit projected area. The lobe itself is the square of t.5 for alpha_x >= "
    "alpha_y; both being positive, they compare as their roots do",
).proof(lambda step: None)

gap = project.claim(
    "sel-gap",
    "by how much the ellipsoidal lobe and GGX differ, in their inverse roots",
    left=dot(slopes, slopes) - 1 / distance.subs(alpha_max, alpha_x).subs(dict(zip(omega, (x, y, z), strict=True))),
    corrected=apart,
    where=[*SPHERE, *EITHER],
    reading=LARGER + ". The left side is the square of the half vector, divided by the roughness, less the inverse of "
    "the distance to the ellipsoid: 1 / sqrt(G) - 1 / sqrt(K). So the lobe equals GGX where U = 1, which is the plane "
    "of the larger roughness, y = 0, and all of the sphere for one roughness; and where U = P. Elsewhere it lies above "
    "GGX where U > P, and below where U < P",
)


@gap.proof
def two_factors(step):
    ready(step)


below = project.inequality(
    "sel-below-spheroid",
    "the ellipsoidal lobe is nowhere larger than the spheroidal one of its larger roughness",
    root_K.subs(alpha_y, alpha_x), root_K,
    where=[*SPHERE, *EITHER], reading=ROOTS,
)  # fmt: skip


def by_inverse_roots(step, more, less):
    step.fact(step.right, (more - less) / (more * less)).settle()


@below.proof
def longer_than_one(step):
    ready(step)
    alike = slim.subs(alpha_y, alpha_x)
    step.fact(alike, (1 - alpha_x**2) * (1 - z) / (2 * alpha_x**2), 1)
    step.fact(slim - alike, (1 + alpha_x**2) * (U - 1) / (2 * alpha_x**2))
    by_inverse_roots(step, slim, alike)


# --- above and below by the angle alone ------------------------------------------------------------------------

cone = (1 - alpha_y**2) / (1 + alpha_y**2)  # the cosine at which half the angle has the tangent alpha_y
widest = 2 * alpha_y / (1 + alpha_y**2)  # the sine there, which no y exceeds
tangent = (1 - z) / (1 + z)  # squared, of half the angle to the axis

far = project.inequality(
    "sel-above-far", "beyond tan(theta / 2) = alpha_x, the ellipsoidal lobe is at least GGX", root_K, root_G,
    where=[*SPHERE, *EITHER, tangent >= alpha_x**2], reading=ROOTS,
)  # fmt: skip

near = project.inequality(
    "sel-below-near", "within tan(theta / 2) = alpha_y, the ellipsoidal lobe is at most GGX", root_G, root_K,
    where=[*EITHER, interval(z, cone, 1), interval(y, -widest, widest), SPHERE[2]],
    reading=LARGER + "; by sel-gap the two differ there unless y = 0 or the roughnesses are alike: for two roughnesses "
    "the lobe is no upper bound of GGX, however close they are",
)  # fmt: skip


@far.proof
def outside_the_wider_cone(step):
    ready(step)
    step.fact(U - P, U - 1, (1 + z) * (tangent - alpha_x**2))
    step.fact(thick - slim, apart)
    by_inverse_roots(step, thick, slim)


@near.proof
def inside_the_narrower_cone(step):
    """U - 1 is at most half of U^2 - 1, which is greatest at x = 0."""
    step.fact(1 + z, z - cone, 1 + cone)
    ready(step)
    more = (alpha_x - alpha_y) * (alpha_x + alpha_y) / alpha_y**2
    inside = alpha_x**2 / alpha_y**2 * (1 + alpha_y**2) * (z - cone)
    step.fact(P - U, (U - 1) ** 2 / 2, more * x**2 / 2, inside, more * (1 - z) ** 2 / 2)
    step.fact(slim - thick, -apart)
    by_inverse_roots(step, slim, thick)


# --- how far below --------------------------------------------------------------------------------------

three_quarters = project.inequality(
    "sel-three-quarters", "the ellipsoidal lobe is nowhere less than three quarters of GGX",
    2 * root_K, sqrt(3) * root_G, where=[*SPHERE, *EITHER], reading=ROOTS,
)  # fmt: skip


@three_quarters.proof
def sum_of_what_is_not_negative(step):
    """With w = U - 1, the difference of the inverse roots is a square at w = sqrt(3) - 1, and more that is positive."""
    ready(step)
    c, w, smooth = 2 / sqrt(3), U - 1, 1 - alpha_x**2
    share = 1 / (2 * alpha_x**2 * (1 + z))
    parts = [w * (1 - z), (c - 1) * (1 - z) * (1 + z) * smooth, alpha_x**2 * (1 + z) / 2 * c * (w - sqrt(3) + 1) ** 2]
    for rest in ((1 - z) / 2, smooth * (1 + z) / 2):
        parts += [rest * c * w**2, rest * 2 * (c - 1) * w]
    step.fact(c * thick - slim, *(share * part for part in parts))
    step.fact(step.right, sqrt(3) * (c * thick - slim) / (thick * slim)).settle()


narrow = sqrt((1 - z**2) / (3 - z**2))  # the smaller roughness for which U = sqrt(3) at x = 0

project.claim(
    "sel-three-quarters.sharp",
    "three quarters is the best such bound: a direction for every smaller roughness below 1 / sqrt(3)",
    left=(root_G**2 / root_K**2).subs({y: sqrt(1 - z**2)}).subs({alpha_x: 1, alpha_y: narrow}),
    corrected=3 * (1 + z) ** 2 / (2 + z) ** 2,
    where=[interval(z, 0, 1, open=True)],
    reading="GGX over the lobe for alpha_x = 1 and alpha_y^2 = (1 - z^2) / (3 - z^2), in the plane x = 0; it tends to "
    "4/3 as z goes to 1 and alpha_y to 0",
).proof(lambda step: None)


if __name__ == "__main__":
    project.tell()
