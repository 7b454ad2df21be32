"""What ties the sources together: one GGX under three names, one Lambda, and the isotropic medium.

Smith's Lambda is defined by the slopes along a ray, Lambda(u) = 1 / mu times the integral of (q - mu) P(q) over
q > mu = cot(theta). dupuy2016 (18) and (19) say that the cross-section is u Lambda(u) from below and u (1 + Lambda(u))
from above.
"""

from sympy import Integral, Rational, acos, cos, erf, exp, oo, pi, sqrt, symbols, tan

from derivations.deon2016.cells import CLOSED, u, x
from xsec_sym.exact import NormalsGGX, RingCrossSection, SigmaBeckmann, SigmaGGX
from xsec_sym.proof import Source, interval

project = Source("xsec", section="Smith")

alpha, m, q = symbols("alpha m q", real=True)
ROUGH = interval(alpha, 0, oo, open=True)
AREA = "D per steradian, with unit projected area"

mu = u / sqrt(1 - u**2)
root = sqrt(1 - u**2)


# --- Lambda in closed form ------------------------------------------------------------------------------

a = u / (alpha * root)
LAMBDA_BECKMANN = (erf(a) - 1) / 2 + exp(-(u**2) / (alpha**2 * (1 - u**2))) / (2 * a * sqrt(pi))
LAMBDA_GGX = (sqrt(1 + alpha**2 * (1 - u**2) / u**2) - 1) / 2

gauss = exp(-(q**2) / alpha**2)
bell = sqrt(alpha**2 + q**2)
SPHEROID = (alpha**2 * (1 - u**2) + u**2, alpha**2 * (1 - u) * (1 + u), u**2)


def smith(name, slopes, form, primitive):
    """Lambda from the distribution of slopes along the ray."""
    claim = project.claim(
        f"smith.{name}.lambda",
        f"Smith's Lambda for the slopes of {name}",
        left=Integral((q - mu) * slopes, (q, mu, oo)) / mu,
        corrected=form,
        where=[interval(u, 0, 1, open=True), ROUGH],
    )
    claim.proof(lambda step: step.fact(*SPHEROID).antiderivative(primitive))
    return claim


smith(
    "beckmann",
    gauss / (alpha * sqrt(pi)),
    LAMBDA_BECKMANN,
    -alpha / (2 * sqrt(pi)) * gauss - mu / 2 * erf(q / alpha),
)
smith("ggx", alpha**2 / (2 * bell**3), LAMBDA_GGX, -(alpha**2 + mu * q) / (2 * bell))


def link(name, sigma, closed, form, high):
    """Both halves of the relation, from the closed form of the cross-section."""
    for side, viewer, factor in (("below", -u, form), ("above", u, 1 + form)):
        claim = project.claim(
            f"smith.{name}.{side}",
            f"the cross-section of {name} from {side} by Smith's Lambda",
            left=sigma(viewer, alpha),
            corrected=u * factor,
            where=[interval(u, 0, 1, open=high), ROUGH],
            reading=AREA,
            reduces=[closed],
        )
        claim.proof(lambda step, viewer=viewer: step.fact(*SPHEROID).lemma(closed, {u_i: viewer}))


u_i = symbols("u_i", real=True)
link("beckmann", SigmaBeckmann, "deon2016:22", LAMBDA_BECKMANN, True)
link("ggx", SigmaGGX, "deon2016:25", LAMBDA_GGX, "left")


# --- one GGX --------------------------------------------------------------------------------------------

theta = acos(u)

kenha = project.claim(
    "ggx-forms.kenha2018",
    "the GGX of kenha2018 (1), written with the tangent, is that of deon2016 (24)",
    left=NormalsGGX(u, alpha),
    corrected=alpha**2 / (pi * cos(theta) ** 4 * (alpha**2 + tan(theta) ** 2) ** 2),
    where=[interval(u, 0, 1, open="left"), ROUGH],
    reading=AREA + " in both",
)

tokuyoshi = project.claim(
    "ggx-forms.tokuyoshi_harada",
    "the lobe of tokuyoshi_harada is pi alpha^2 times the GGX of deon2016 (24) at half the angle",
    left=pi * alpha**2 * NormalsGGX(sqrt((1 + m) / 2), alpha),
    corrected=4 * alpha**4 / (1 - m + alpha**2 * (1 + m)) ** 2,
    where=[interval(m, -1, 1, open="left"), interval(alpha, 0, 1, open="left")],
    reading="m = cos(theta), D per steradian with unit projected area; the lobe itself is 1 on its axis",
)


def same_quotient(step):
    step.unfold().settle()


kenha.proof(same_quotient)
tokuyoshi.proof(same_quotient)


# --- the isotropic medium -------------------------------------------------------------------------------

isotropic = project.claim(
    "isotropic",
    "a medium of all normals alike has the cross-section 1/4 from everywhere",
    left=Integral(RingCrossSection(x, u) / (4 * pi), (x, -1, 1)),
    corrected=Rational(1, 4),
    where=[interval(u, -1, 1)],
    reading="D = 1 / (4 pi) per steradian, unit mass",
    reduces=CLOSED,
    points={x: [-root, root]},
)


@isotropic.proof
def first_row_of_the_table(step):
    step.linear(RingCrossSection(x, u) / (4 * pi)).lemma("deon2016:T1.1.s")


if __name__ == "__main__":
    project.tell()
