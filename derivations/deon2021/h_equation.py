"""Section 3.1: the BRDF of isotropic scattering (21), the H function's equation (20), and H from K (22).

The last two are proved on a family of functions Psi with one parameter, for which H and K have roots and nothing else:
K follows from Psi by (23); H is shown to solve (20), and to be what (22) says. For the paper's own Psi they are
confirmed: H by (22) solves (20), under the integral too. `xsec_sym/exact/h_lambert_sphere.py` encloses it by the
trapezoidal rule in log t, and 22.0 to 22.2 hold the solution against the integral as an adaptive rule encloses it.
"""

from sympy import Function, Integral, Rational, atan, cos, exp, log, oo, pi, sin, sqrt, symbols, tan

from derivations.deon2021 import characteristic
from xsec_sym.exact import CharacteristicTrial as Psi
from xsec_sym.exact import DispersionLambertSphere as K_of
from xsec_sym.exact import DispersionTrial as K
from xsec_sym.exact import HIsotropic, HLambertSphere, HLambertTransform, HTransform
from xsec_sym.exact import HTrial as H
from xsec_sym.proof import Source, interval

paper = Source("deon2021", section="3.1")
project = Source("xsec", section="H functions")

mu, x, t, b, c, w, y, theta = symbols("mu x t b c w y theta", real=True)
UP, BEYOND, WIDTH = interval(mu, 0, 1, open="left"), interval(t, 0, oo, open=True), interval(b, 1, oo, open=True)
FAMILY = "for Psi(x) = sqrt((1 - x^2) / (b^2 x^2 - 1)) / (pi x) beyond x = 1 / b, and 0 up to there"

C, C_0, K_C = (Function(name, real=True) for name in ("C", "C_0", "K_C"))

paper.definition(
    "19",
    "the density of collisions in a half-space that scatters isotropically",
    left=C(x),
    printed=C_0(x) + c * Integral(C(y) * K_C(x - y), (y, 0, oo)),
    reading="x is the optical depth; K_C is not given",
)

# --- K and H of the family ------------------------------------------------------------------------------

kernel = project.claim(
    "h-trial.dispersion",
    "K of the family with an elementary H",
    left=1 - 2 * Integral(Psi(x, b) / (1 + t**2 * x**2), (x, 0, 1)),
    corrected=K(t, b),
    where=[BEYOND, WIDTH],
    reading="(23) with mu = 1/s and its two fractions added; " + FAMILY,
)


@kernel.proof
def roots_rationalised(step):
    """w^2 = (1 - x^2) / (b^2 x^2 - 1)."""
    step.unfold().split(1 / b)
    step.substitute(w, sqrt((1 + w**2) / (1 + b**2 * w**2)), oo, 0)
    step.antiderivative((atan(w) - K(t, b).definition() * atan(w / K(t, b).definition())) / pi)


nonlinear = paper.claim(
    "20.elementary",
    "the equation of an H function that is elementary",
    left=1 / sqrt((1 + b * mu) / (1 + mu)),
    printed=1 - mu * Integral((H(x, b) + Psi(x, b)) / (mu + x), (x, 0, 1)),
    corrected=1 - mu * Integral(H(x, b) * Psi(x, b) / (mu + x), (x, 0, 1)),
    edit="the product H(x) Psi(x) for the sum",
    where=[UP, WIDTH],
    reading=FAMILY,
)


@nonlinear.proof
def root_rationalised(step):
    """w^2 = (1 - x) / (b x - 1)."""
    step.unfold().swap().split(1 / b)
    step.substitute(w, (1 + w**2) / (1 + b * w**2), oo, 0)
    root = sqrt((1 + mu) / (1 + b * mu))
    step.antiderivative(2 * (atan(w) - root * atan(w / root)) / (pi * mu))


spread = project.claim(
    "h-trial.logarithm",
    "the logarithm of K of the family",
    left=-Integral(y / (y**2 + t**2), (y, 1, b)),
    corrected=log(K(t, b)),
    where=[BEYOND, WIDTH],
)


@spread.proof
def of_the_sum_of_squares(step):
    step.unfold().antiderivative(log(y**2 + t**2) / 2)


integral_form = paper.claim(
    "22.elementary",
    "an H function that is elementary, from K",
    left=sqrt((1 + b * mu) / (1 + mu)),
    printed=exp(-mu / pi * Integral(log(K(t, b)) / (1 + mu**2 * t**2), (t, 0, oo))),
    where=[UP, WIDTH],
    reading=FAMILY + "; its K is that of xsec:h-trial.dispersion, and its H solves (20) as mended",
)


@integral_form.proof
def as_an_integral_over_poles(step):
    """The two poles of the integrand over t fall together at y = 1 / mu, where the integral over y is cut."""
    step.swap().lemma(spread, back=True).exchange()
    for branch in step.cases(b * mu - 1, b, 1 / mu, mu):
        if branch.goal.piece.sign(b * mu - 1) == "+":
            branch.split(1 / mu).substitute(w, w, 1 / mu, b, branch.over(1 / mu, b))
            residues(branch, y, 1, 1 / mu)
            residues(branch, w, 1 / mu, b)
        else:
            residues(branch, y, *branch.integrals[0].limits[0][1:])


def residues(step, pole, low, high):
    """The integral over t, between poles that are apart, and then the one over the pole."""
    apart = 1 - mu**2 * pole**2
    step.fact(pole, pole - low, low, inside=(pole, low, high))
    step.fact(apart, mu * (1 / mu - pole) * (1 + mu * pole), inside=(pole, low, high))
    inner = next(i for i in step.left.atoms(Integral) if i.limits[0][0] == t and i.has(pole))
    step.antiderivative((atan(t / pole) / pole - mu * atan(mu * t)) / apart, inner)
    step.antiderivative(pi * log(1 + mu * pole) / (2 * mu), step.over(low, high))


# --- the paper's own functions Psi ----------------------------------------------------------------------

ALBEDO = interval(c, 0, 1)
PRODUCT = "the product H(x) Psi(x) for the sum"


def with_product(order):
    """1 / H by (20) as mended, H under the integral being that of (22)."""
    terms = characteristic.PSI[order].expand().as_poly(mu).terms()
    return 1 - mu * sum(value * HLambertTransform(order, power, mu, c) for (power,), value in terms)


def with_sum(order):
    """The same as it is printed."""
    psi = characteristic.PSI[order].subs(mu, x)
    return 1 - mu * (HLambertTransform(order, 0, mu, c) + Integral(psi / (mu + x), (x, 0, 1)))


for order in range(3):
    for label, beside, at, where in (
        ("", "", {}, [UP, ALBEDO]),
        (".conservative", ", without absorption", {c: 1}, [UP]),
    ):
        paper.claim(
            f"20.{order}{label}",
            f"the equation of the H function of order {order}{beside}",
            left=1 / HLambertSphere(order, mu, c).subs(at),
            printed=with_sum(order).subs(at),
            corrected=with_product(order).subs(at),
            edit=PRODUCT,
            where=where,
            reading="H is that of (22), on both sides; Psi of the paper, its powers taken out of the integral; "
            + characteristic.THREE_TERMS,
        )

for order, psi in enumerate(characteristic.PSI):
    project.claim(
        f"h-lambert-sphere.dispersion.{order}",
        f"K of order {order} at t = tan(theta)",
        left=1 - 2 * Integral(psi.subs(mu, x) / (1 + tan(theta) ** 2 * x**2), (x, 0, 1)),
        corrected=K_of(order, theta, c),
        where=[interval(theta, 0, pi / 2, open=True), ALBEDO],
        reading="(23) with mu = 1/s; it is what H is enclosed by, a series near theta = 0 and (24) to (26) elsewhere",
    )
    paper.claim(
        f"22.{order}",
        f"the H function of order {order} from K",
        left=-log(with_product(order)),
        printed=-mu / pi * Integral(log(K_of(order, theta, c)) / (cos(theta) ** 2 + mu**2 * sin(theta) ** 2),
                                    (theta, 0, pi / 2)),
        where=[UP, interval(c, 0, 1 if order else Rational(99, 100), open="left")],
        reading="the logarithm of both sides, t = tan(theta). The left side is H(mu) by (20) as mended, with the H "
        "of (22) under its integral"
        + ("" if order else "; at c = 1 the logarithm is infinite at t = 0: from c = 0.99 on, 20.0 tells the same")
        + "; " + characteristic.THREE_TERMS,
    )  # fmt: skip

h, psi_, k = (Function(name, real=True) for name in ("H", "Psi", "K"))

paper.whole(
    "22",
    "the H function from K",
    ["22.elementary", *(f"22.{order}" for order in range(3))],
    left=h(mu),
    printed=exp(-mu / pi * Integral(log(k(t)) / (1 + mu**2 * t**2), (t, 0, oo))),
    reading="proved for a family of Psi, and confirmed for those of the paper",
)

paper.whole(
    "20",
    "the equation of the H function",
    ["20.elementary", *(f"20.{order}{label}" for order in range(3) for label in ("", ".conservative"))],
    left=1 / h(mu),
    printed=1 - mu * Integral((h(x) + psi_(x)) / (mu + x), (x, 0, 1)),
    reading="proved for a family of Psi, and confirmed for those of the paper; mended by " + PRODUCT,
)

# --- isotropic scattering -------------------------------------------------------------------------------

mu_i, mu_o = symbols("mu_i mu_o", real=True)


def amplified(cosine):
    """The light at the surface, for each unit that comes from outside: the right side of (20) with Psi = c / 2."""
    return 1 / (1 - c * cosine / 2 * HTransform(cosine, c))


paper.claim(
    "21",
    "the BRDF of a half-space that scatters isotropically",
    left=c / (4 * pi) * amplified(mu_i) * amplified(mu_o) / (mu_i + mu_o),
    printed=c / (4 * pi) * HIsotropic(mu_i, c) * HIsotropic(mu_o, c) / (mu_i + mu_o),
    where=[interval(mu_i, 0, 1, open="left"), interval(mu_o, 0, 1, open="left"), interval(c, 0, 1, open="left")],
    reading="as dupuy2016:30. A layer on top changes nothing, so that 4 pi (mu_i + mu_o) f_r is c N(mu_i) N(mu_o) with "
    "N(mu) = 1 + 2 pi mu times the integral of f_r over the other cosine (Ambartsumian); with f_r as printed, N is "
    "the left side's, which is (20) as mended for Psi = c / 2. H is that of (22), with K(t) = 1 - c arctan(t) / t",
)

if __name__ == "__main__":
    paper.tell()
    project.tell()
