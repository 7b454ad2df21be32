"""Sections 2.1, 3.4 and 3.5: sampling by one random number, the energy that the model loses, and albedo maps.

The Bond albedo is that of the half-space with the whole phase function, by two solvers that agree.
"""

from sympy import Float, Integral, Max, Min, Rational, acos, cos, pi, sqrt, symbols

from derivations.deon2021 import h_fits
from derivations.deon2021.fourier import three_terms
from xsec_sym.exact.solved import AlbedoLambertSphere, ParticleAlbedo, SampledCosine
from xsec_sym.proof import Source, interval
from xsec_sym.proof.accuracy import T

sampling = Source("deon2021", section="2.1")
zeroth = Source("deon2021", section="3.4")
mapping = Source("deon2021", section="3.5")
project = Source("xsec", section="Lambertian spheres")

xi, mu_i, mu_o, phi, c, k_d = symbols("xi mu_i mu_o phi c k_d", real=True)
d = Float
share = h_fits.share

# --- sampling -------------------------------------------------------------------------------------------

inverse = 1 - 2 * (1 - xi ** (d("0.0401885") * xi + d("1.01938"))) ** d("0.397225")
STRAIGHT_ON = {xi: 1 - (1 - T) ** 5}

SHARE = "xi is the share of the light that is scattered to smaller cosines"

sampling.measured(
    "7",
    "the cosine of the deviation by one random number",
    left=SampledCosine(xi),
    printed=inverse,
    where=[interval(xi, 0, 1)],
    along=STRAIGHT_ON,
    reading=SHARE + "; the accuracy stated for it is a claim of its own",
)
sampling.measured(
    "claim.sampling-accuracy",
    "the largest absolute error of (7) is below 0.0005",
    left=SampledCosine(xi),
    printed=inverse,
    where=[interval(xi, 0, 1)],
    within=Rational(5, 10000),
    along=STRAIGHT_ON,
    statement=True,
    reading=SHARE + "; it holds but for 0.9978 < xi < 0.9999, where little light goes; no other digit in "
    "place of one makes it much better, though with 0.397325 for 0.397225 it would pass, by 0.0000009",
)

# --- energy ---------------------------------------------------------------------------------------------


def whole(v):
    """The phase function (1), as mended."""
    v = Max(v, -1)  # against rounding
    return 2 * (sqrt(1 - v**2) - v * acos(v)) / (3 * pi**2)


H = h_fits.hapke.subs(h_fits.c, 1)
A, E = Rational(69, 128), 0
B, C, D, F = ((corrected or printed).subs(h_fits.c, 1) for _, _, printed, corrected, _ in h_fits.FITS.values())
total, product = mu_i + mu_o, mu_i * mu_o
mode = (
    H.subs(h_fits.mu, mu_i) * H.subs(h_fits.mu, mu_o) / (2 * pi * total)
    * (A + B * total + C * product + D * product * total + E * product**2 + F * (mu_i**2 + mu_o**2))
)  # fmt: skip
deviation = -product - sqrt(1 - mu_i**2) * sqrt(1 - mu_o**2) * cos(phi)
tail = Integral((whole(deviation) - three_terms(deviation)) / (pi * total), (phi, 0, pi))
returned = 2 * pi * mu_o * (mode + tail)

zeroth.measured(
    "claim.energy",
    "without absorption the model loses less than 1 percent of the light",
    left=Integral(returned, (mu_o, 0, mu_i)) + Integral(returned, (mu_o, mu_i, 1)),
    printed=1,
    where=[interval(mu_i, 0, 1, open="left")],
    within=Rational(1, 100),
    along={mu_i: T**2},
    statement=True,
    reading="the light of (18) that leaves, with the fits as mended; what is scattered once and has the whole phase "
    "function replaces what has three terms of it; modes other than that of order 0 carry none. The text speaks of "
    "grazing angles: the loss is 0.6 percent in the limit mu_i = 0, 1.5 percent at 0.05, 0.9 percent at 0.5 and "
    "largest at normal incidence, most of it by (39), whose error is largest at c = 1",
)

# --- albedo ---------------------------------------------------------------------------------------------

WHOLE = "for the whole phase function; the source fits a table of its own model's albedo"

particle = (1 - (1 - k_d) ** d("2.73556")) / (1 - d("0.184096") * (1 - k_d) ** d("2.48423"))
material = (1 - share(d("0.453029"), 1 - c) - d("0.544162") * sqrt(1 - c)) / (d("1.42931") * sqrt(1 - c) + 1)

mapping.measured(
    "46",
    "the single-scattering albedo by the albedo of the material",
    left=ParticleAlbedo(k_d),
    printed=particle,
    where=[interval(k_d, 0, 1)],
    reading=WHOLE + ". Beyond k_d = 0.9988 it is above 1, by 4e-10 at most",
)
mapping.measured(
    "47",
    "the albedo of the material by the single-scattering albedo",
    left=AlbedoLambertSphere(c),
    printed=material,
    where=[interval(c, 0, 1)],
    along={c: 1 - T**2},
    reading=WHOLE + ". At c = 0 it is 0.0012, where nothing returns",
)
project.measured(
    "lambert-sphere.albedo-maps.inverse",
    "(46) takes back what (47) gives",
    left=ParticleAlbedo(AlbedoLambertSphere(c)),
    corrected=particle.subs(k_d, material),
    where=[interval(c, 0, 1)],
    within=Rational(6, 1000),
    along={c: 1 - T**2},
    reading="in c; the left side is c by either solver. The text has them as map and inverse, without an accuracy",
)
project.measured(
    "lambert-sphere.albedo-maps.round-trip",
    "the albedo of the material that (46) gives, against the one that was asked for",
    left=AlbedoLambertSphere(Min(particle, 1)),
    corrected=k_d,
    where=[interval(k_d, 0, 1)],
    within=Rational(37, 1000),
    reading="in k_d, for the whole phase function; worst near k_d = 0.86, as the albedo rises steeply toward c = 1",
)

if __name__ == "__main__":
    for section in (sampling, zeroth, mapping, project):
        section.tell()
