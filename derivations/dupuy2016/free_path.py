"""Section 2.3: extinction, free paths and attenuation in the half-space of flakes, (8)-(11)."""

from sympy import Function, Integral, diff, exp, log, oo, symbols

from derivations.dupuy2016.volume import DENSE, LONG, ell, medium, omega_1, sigma, sigma_t, t, z
from xsec_sym.proof import Source, interval

paper = Source("dupuy2016", section="2.3")

U, cosine = symbols("U cos(theta)", real=True)


# --- extinction -----------------------------------------------------------------------------------------

paper.definition("8.1", "the extinction coefficient", left=sigma_t(omega_1),
                 printed=Function("rho")(z) * Function("sigma")(omega_1))  # fmt: skip

INSIDE = [interval(z, -oo, 0), DENSE]

inside = paper.claim(
    "8.2",
    "the extinction coefficient in the medium",
    left=medium(z) * sigma,
    printed=sigma,
    where=INSIDE,
    reading="below the interface, where rho = 1 by (3)",
)
inside.proof(lambda step: step.settle())

paper.whole("8", "the extinction coefficient", ["8.1", "8.2"], left=sigma_t(omega_1),
            printed=Function("sigma")(omega_1))  # fmt: skip


# --- free paths -----------------------------------------------------------------------------------------


def survival(area, length=ell):
    """Beer and Lambert's law: exp of minus what is met on the way."""
    return exp(-Integral(area, (t, 0, length)))


PATH = "the density of the first hit, how fast the share that gets through falls; the path stays in the medium"

first_hit = paper.claim(
    "9.1",
    "the density of the free path by the extinction coefficient",
    left=-diff(survival(sigma), ell),
    printed=sigma * exp(-sigma * ell),
    where=[DENSE, LONG],
    reading=PATH,
)
by_area = paper.claim(
    "9.2",
    "the density of the free path by the projected area",
    left=-diff(survival(medium(-t) * sigma), ell),
    printed=sigma * exp(-sigma * ell),
    where=[DENSE, LONG],
    reading=PATH + "; straight down from the interface",
)
paper.whole("9", "the density of the free path", ["9.1", "9.2"], left=Function("p")(ell), printed=by_area.printed)

attenuated = paper.claim(
    "11.1",
    "the attenuation is the share of free paths that are longer",
    left=survival(sigma),
    printed=1 - Integral(sigma * exp(-sigma * t), (t, 0, ell)),
    where=[DENSE, LONG],
)
by_extinction = paper.claim(
    "11.2",
    "the attenuation by the extinction coefficient",
    left=survival(sigma),
    printed=exp(-sigma * ell),
    where=[DENSE, LONG],
)
by_projection = paper.claim(
    "11.3",
    "the attenuation by the projected area",
    left=survival(medium(-t) * sigma),
    printed=exp(-sigma * ell),
    where=[DENSE, LONG],
    reading="for a segment inside the medium, straight down from the interface",
)
paper.whole("11", "the attenuation", ["11.1", "11.2", "11.3"], left=Function("V")(ell),
            printed=by_projection.printed)  # fmt: skip


@first_hit.proof
@by_area.proof
@by_extinction.proof
@by_projection.proof
def constant_extinction(step):
    step.settle().antiderivative(sigma * t)


@attenuated.proof
def both_sides(step):
    step.antiderivative(sigma * t).swap().antiderivative(-exp(-sigma * t))


free = paper.claim(
    "9.norm",
    "the density of the free path is normalised",
    left=Integral(sigma * exp(-sigma * t), (t, 0, oo)),
    corrected=1,
    where=[DENSE],
    reading="for a path that never leaves the medium",
)
SLANT = [DENSE, interval(z, -oo, 0, open=True), interval(cosine, 0, 1, open="left")]
to_the_top = Integral(sigma * exp(-sigma * t), (t, 0, -z / cosine))

leaving_paths = paper.claim(
    "9.escape",
    "a path on its way up collides inside the medium unless it is longer than the way out",
    left=to_the_top,
    corrected=1 - exp(sigma * z / cosine),
    where=SLANT,
    reading="from the height z < 0, the way out being -z / cos(theta)",
)


@free.proof
@leaving_paths.proof
def shorter_paths(step):
    step.antiderivative(-exp(-sigma * t))


paper.claim(
    "claim.any-free-path",
    "any free path has the density (9), l >= 0",
    left=to_the_top,
    printed=1,
    where=SLANT,
    reading="tried on its normalisation: a path on its way up from the height z collides in the medium with a "
    "probability below 1, see 9.escape. Paths on their way down, and a medium without an interface, have (9)",
    statement=True,
)

PATHS = interval(ell, 0, 20 / sigma)
stopped = Integral(sigma * exp(-sigma * t), (t, 0, ell))

inverted = paper.claim(
    "10.1",
    "the free path by its share of shorter ones",
    left=ell,
    printed=-log(1 - stopped) / sigma,
    where=[DENSE, PATHS],
    reading="U is the share of free paths shorter than l, by (9); l up to 20 mean free paths, as the digits allow",
)
through_the_area = paper.claim(
    "10.2",
    "the free path by the projected area",
    left=ell,
    printed=-log(1 - stopped.subs(sigma, medium(-t) * sigma)) / sigma,
    where=[DENSE, PATHS],
    reading="the same with sigma_t = rho sigma, by (8), straight down from the interface",
)
back = paper.claim(
    "10.back",
    "and the share of shorter ones by the free path",
    left=stopped.subs(ell, -log(1 - U) / sigma),
    corrected=U,
    where=[DENSE, interval(U, 0, 1, open="right")],
    reading="U = 1, which the text admits, has no finite path",
)


@inverted.proof
@through_the_area.proof
def logarithm_of_the_rest(step):
    step.settle().swap().antiderivative(-exp(-sigma * t))


@back.proof
def exponential_of_the_logarithm(step):
    step.antiderivative(-exp(-sigma * t))


paper.whole("10", "the free path from a uniform number", ["10.1", "10.2"], left=ell, printed=-log(1 - U) / sigma)


if __name__ == "__main__":
    paper.tell()
