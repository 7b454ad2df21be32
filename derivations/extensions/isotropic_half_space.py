"""What follows from the H function of the isotropic half-space: its moments, and how much light comes back.

With alpha_n the moments of H, the integral of v H(v) / (u + v) is alpha_0 - u times that of H(v) / (u + v), since
v / (u + v) = 1 - u / (u + v). So dupuy2016 (30), weighed with the cosine, gives the albedo below.
"""

from sympy import Integral, Rational, atan, oo, sqrt, symbols

from xsec_sym.exact import HIsotropic, HMoment, HTransform
from xsec_sym.proof import Source, interval

project = Source("xsec", section="isotropic half-space")

a, tau, u, y = symbols("a tau u y", real=True)
ALBEDO = interval(a, 0, 1, open="left")
REACH = interval(u, 0, 20, open="left")
H = "H as in dupuy2016 (31), a the single-scattering albedo"

below = project.claim(
    "iso.arctangent",
    "how far the arctangent stays below its argument",
    left=tau - atan(tau) - tau**3 / (3 * (1 + tau**2)),
    corrected=Integral(2 * y**4 / (3 * (1 + y**2) ** 2), (y, 0, tau)),
    where=[interval(tau, 0, oo, open=True)],
    reading="so that K(t) = 1 - a arctan(t) / t is positive for 0 < a <= 1 and t > 0, and has a logarithm",
)


@below.proof
def its_own_derivative(step):
    step.swap().antiderivative(y - atan(y) - y**3 / (3 * (1 + y**2)))


project.claim(
    "iso.mean",
    "the integral of H over the cosines",
    left=HMoment(0, a),
    corrected=2 / (1 + sqrt(1 - a)),
    where=[ALBEDO],
    reading=H + "; it is 2 (1 - sqrt(1 - a)) / a. The integral equation times H, integrated, only says that it is "
    "1 + a / 4 times its square: the other root, 2 (1 + sqrt(1 - a)) / a, belongs to the solution with a pole",
)

project.claim(
    "iso.second",
    "what ties the first moment to the second",
    left=sqrt(1 - a) * HMoment(2, a) + a / 4 * HMoment(1, a) ** 2,
    corrected=Rational(1, 3),
    where=[ALBEDO],
    reading=H,
)

project.claim(
    "iso.albedo",
    "the share of a beam that the half-space sends back",
    left=a / 2 * HIsotropic(u, a) * (HMoment(0, a) - u * HTransform(u, a)),
    corrected=1 - sqrt(1 - a) * HIsotropic(u, a),
    where=[interval(u, 0, 1, open="left"), ALBEDO],
    reading=H + "; the directional albedo, the integral of (30) with the cosine over all directions out. It is 1 "
    "without absorption",
)

project.claim(
    "iso.alternative",
    "the equation for H that suits weak absorption",
    left=sqrt(1 - a) + a / 2 * (HMoment(0, a) - u * HTransform(u, a)),
    corrected=1 / HIsotropic(u, a),
    where=[REACH, ALBEDO],
    reading=H,
)

if __name__ == "__main__":
    project.tell()
