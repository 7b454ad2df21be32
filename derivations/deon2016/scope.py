"""Sections 1.1 and 1.2: what a cross-section is, and the normalisation of a distribution with azimuthal symmetry."""

from sympy import Function, Integral, Max, Rational, Symbol, symbols

from xsec_sym.proof import Source

paper = Source("deon2016", section="1")

u = symbols("u", real=True)
omega, omega_i = symbols("omega omega_i")
D, sigma, cosine = Function("D"), Function("sigma"), Function("c")
dot = Symbol("(omega.omega_i)", real=True)
whole_sphere = Symbol("Omega", real=True)

paper.definition("1", "the distribution of normals", left=D(omega), printed=D(omega))
paper.definition(
    "2",
    "the cross-section",
    left=sigma(omega_i),
    printed=Integral(D(omega) * cosine(omega_i, omega), omega),
    reading="over the whole sphere; D per steradian",
)
paper.definition("3", "the clamped cosine", left=cosine(omega_i, omega), printed=Max(0, dot))
paper.definition("4", "all normals alike", left=D(u), printed=Rational(1, 2), reading="per unit cosine")

normalised = paper.claim(
    "5",
    "the isotropic distribution is normalised",
    left=Integral(Rational(1, 2), (u, -1, 1)),
    printed=1,
    reading="per unit cosine; the paper's (5) asks this of every D, here it is tested on (4)",
)


@normalised.proof
def constant(step):
    step.antiderivative(u / 2)


if __name__ == "__main__":
    paper.tell()
