"""Section 3.6: the fast variant of the model.

It stands for the model of the sections before, (18): the truth here is that model without its fits.
"""

from sympy import Abs, Float, Max, Rational, acos, cos, pi, sqrt, symbols

from derivations.deon2021.fourier import three_terms
from xsec_sym.exact.solved import AlbedoLambertSphere, ModeLambertSphere
from xsec_sym.proof import Source, interval
from xsec_sym.proof.accuracy import T

paper = Source("deon2021", section="3.6")

mu_i, mu_o, phi, c = symbols("mu_i mu_o phi c", real=True)
d = Float

S = sqrt(1 - mu_i**2) * sqrt(1 - mu_o**2)
total = mu_i + mu_o
deviation = -mu_i * mu_o - S * cos(phi)
seen = Max(deviation, -1)  # against rounding
single = c * 2 * (sqrt(1 - seen**2) - seen * acos(seen)) / (3 * pi**2 * total)
modes = sum(ModeLambertSphere(order, mu_i, mu_o, c) * cos(order * phi) for order in range(3))

k_d = AlbedoLambertSphere(c)
spread = acos(S) / S + d("0.113706")
multiple = d("0.234459") * k_d ** d("1.85432") + d("0.0151829") * (
    (c - d("0.249978")) * (Abs(phi) + sqrt(mu_i * mu_o)) / spread
)

SMALLEST = Rational(1, 20)
AWAY = {v: SMALLEST + (1 - SMALLEST) * T**2 for v in (mu_i, mu_o)}

paper.measured(
    "48",
    "the whole BRDF in one formula",
    left=single + modes - c * three_terms(deviation) / total,
    printed=Max(0, single + multiple),
    where=[interval(mu_i, SMALLEST, 1), interval(mu_o, SMALLEST, 1), interval(phi, 0, pi), interval(c, 0, 1)],
    within=Rational(11, 100),
    along={**AWAY, c: 1 - T**2},
    reading="per steradian, phi = 0 sending light back, k_d the Bond albedo that belongs to c. The text states no "
    "accuracy: 0.11 is what was found, a third of what is scattered more than once there; where both cosines are below "
    "0.002 the error grows like a logarithm. The truth is (18) without fits: what is scattered once has the whole "
    "phase function, what is scattered more often has three terms of it",
)

if __name__ == "__main__":
    paper.tell()
