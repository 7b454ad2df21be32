"""The cosine of an angle by that of its half, for every lobe that is a distribution of normals at the half vector."""

from sympy import cos, pi, symbols

from xsec_sym.proof import Source, interval

project = Source("xsec", section="half angle")

theta = symbols("theta", real=True)

half_angle = project.claim(
    "half-angle",
    "the cosine by that of half the angle",
    left=cos(theta),
    corrected=2 * cos(theta / 2) ** 2 - 1,
    where=[interval(theta, -pi, pi)],
)


@half_angle.proof
def oscillation(step):
    step.ode(theta, [1, 0, 1], at=0)


if __name__ == "__main__":
    project.tell()
