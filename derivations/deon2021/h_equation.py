"""Section 3.1: the H function's equation (20), and H from K (22), for characteristic functions with an elementary H.

The two equations are tried on a family of functions Psi with one parameter, for which H and K have roots and nothing
else. K follows from Psi by (23); H is shown to solve (20), and to be what (22) says. That they hold for every Psi is
not shown here.
"""

from sympy import Function, Integral, atan, exp, log, oo, pi, sqrt, symbols

from xsec_sym.exact import CharacteristicTrial as Psi
from xsec_sym.exact import DispersionTrial as K
from xsec_sym.exact import HTrial as H
from xsec_sym.proof import Source, interval

paper = Source("deon2021", section="3.1")
project = Source("xsec", section="H functions")

mu, mu_i, mu_o, x, t, b, c, w, y = symbols("mu mu_i mu_o x t b c w y", real=True)
UP, BEYOND, WIDTH = interval(mu, 0, 1, open="left"), interval(t, 0, oo, open=True), interval(b, 1, oo, open=True)
FAMILY = "for Psi(x) = sqrt((1 - x^2) / (b^2 x^2 - 1)) / (pi x) beyond x = 1 / b, and 0 up to there"

C, C_0, K_C, f_r, H_ = (Function(name, real=True) for name in ("C", "C_0", "K_C", "f_r", "H"))

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
    "20",
    "the equation of the H function",
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
    "22",
    "the H function from K",
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


paper.definition(
    "21",
    "the BRDF of a half-space that scatters isotropically",
    left=f_r(mu_i, mu_o),
    printed=c / (4 * pi) * H_(mu_i) * H_(mu_o) / (mu_i + mu_o),
    reading="it introduces H by the BRDF; that this H solves (20) with Psi = c/2 belongs to dupuy2016:30",
)

if __name__ == "__main__":
    paper.tell()
    project.tell()
