"""Sections 1, 2, 4 and 5: what the text says beside its equations, and why most of it is beyond a computation."""

from sympy import Function, Integral, exp, sqrt, symbols

from xsec_sym.proof import Source

paper = Source("deon2021", section="1")

mu, x = symbols("mu x", real=True)
g = Function("g", real=True, nonnegative=True)

mirrors = paper.claim(
    "claim.mirror-spheres",
    "mirror spheres scatter isotropically",
    left=Integral(2 * x * g(1 - 2 * x**2), (x, 0, 1)),
    printed=Integral(g(mu) / 2, (mu, -1, 1)),
    instances={g: (lambda v: exp(v),)},
    reading="light meets the sphere as a uniform disk, so that the cosine x of the lit normal has the density 2 x; the "
    "mirror turns the light by pi - 2 acos(x), whose cosine is 1 - 2 x^2. g >= 0 is any function of the cosine",
    statement=True,
)


@mirrors.proof
def uniform_cosine(step):
    step.substitute(mu, sqrt((1 - mu) / 2), 1, -1)


APPEARANCE = "a judgement of rendered pictures, for which no measure is given"
TIMES = "it depends on a renderer, scenes and a machine that are not given"
HISTORY = "a matter of the literature, not of computation"


def beyond(section, *sentences):
    """One section's sentences that have no verdict but a reason."""
    for slug, title, because in sentences:
        section.out_of_scope(f"claim.{slug}", title, because=because)


beyond(
    paper,
    (
        "height-fields-fall-short",
        "models of height fields cannot show this backscattering and saturation",
        APPEARANCE,
    ),
    ("no-universal-brdf", "no parametric BRDF covers all that is measured", "no set of measurements is given"),
    (
        "equivalence",
        "white spheres in an absorbing medium are as good as absorbing spheres in a void",
        "how the model is meant: both have one single-scattering albedo c, and nothing else of them enters",
    ),
    (
        "faster-than-layers",
        "stochastic and tabulated layers cost more than a simple BRDF",
        TIMES,
    ),
)

phase = Source("deon2021", section="2")
beyond(
    phase,
    ("lambert-1760", "the phase function and exact tables of it are Lambert's, of 1760", HISTORY),
    (
        "unlike-henyey-greenstein",
        "the phase function is unlike that of Henyey and Greenstein",
        "how unlike is not said; with the mean cosine -4/9 that one has the second coefficient 80/81, this one 5/16",
    ),
    ("no-published-sampling", "no way to sample this phase function had been published", HISTORY),
    ("one-number", "the sampling with one number is probably more efficient", TIMES),
)

results = Source("deon2021", section="4")
beyond(
    results,
    ("render-time", "rendering takes up to 30 % longer than with simpler diffuse models", TIMES),
    ("appearance", "more backscattering and saturation, darker silhouettes than other models", APPEARANCE),
    ("sparse-spheres", "the model is close to simulated clouds of sparse spheres", APPEARANCE),
    ("height-field-roughness", "height fields do for packed spheres up to a roughness of about 2.4", APPEARANCE),
    ("dark-artefacts", "beyond that roughness they get too dark", APPEARANCE),
    ("two-bounces", "the Oren-Nayar model counts two bounces only and looks too bright", APPEARANCE),
    (
        "storage",
        "the Fourier representations take 152 KiB and 2 MiB",
        "the size of files in a format, at settings that are given in part",
    ),
    ("doubling", "at equal noise the analytic form renders faster than the tabulated one", TIMES),
    ("position-free", "sampling the phase function in a layer is 130 times slower than the BRDF below it", TIMES),
    (
        "support",
        "sparse spheres must be held by something, so that the model alone is hard to motivate",
        "a remark on physics outside the model",
    ),
)

conclusion = Source("deon2021", section="5")
beyond(
    conclusion,
    ("new-brdf", "a new practical BRDF for dusty and porous surfaces, intuitive for artists", APPEARANCE),
    ("exact-solution-impractical", "the exact solution by itself is impractical", "no cost or criterion is stated"),
    ("new-to-graphics", "pseudo-problems were new to computer graphics", HISTORY),
    ("measured-materials", "whether real materials behave like this is left open", "a plan of work"),
    ("blend", "one model might lead from Lambert's over height fields to this one", "a plan of work"),
)

if __name__ == "__main__":
    for section in (paper, phase, results, conclusion):
        section.tell()
