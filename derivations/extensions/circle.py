"""The mean of a reciprocal cosine over a circle: where an azimuth meets a rational distribution."""

from sympy import Integral, atan, cos, oo, pi, sin, sqrt, symbols

from xsec_sym.proof import Source, interval

project = Source("xsec", section="circle")

A, B, y = symbols("A B y", real=True)

circle = project.claim(
    "mean-over-a-circle",
    "the mean of 1 / (A - B cos) over a circle",
    left=Integral(1 / (A - B * cos(2 * pi * y)), (y, 0, 1)),
    corrected=1 / sqrt(A**2 - B**2),
    where=[interval(A, 0, oo, open=True), interval(B, -A, A, open=True)],
)


@circle.proof
def continuous_primitive(step):
    """The usual tangent of the half angle jumps at half a turn; this primitive keeps to one branch."""
    step.fact(A**2 - B**2, (A - B) * (A + B))
    root = sqrt(A**2 - B**2)
    wave = cos(2 * pi * y)
    for branch in step.cases(B):
        if not branch.goal.piece.facts_about(B):
            branch.antiderivative(y / A)
            continue
        lowest = A - B if branch.goal.piece.sign(B) == "+" else A + B
        branch.fact(A - B * wave, lowest, (A - B * wave - lowest).factor(), inside=(y, 0, 1))
        below = A + root - B * wave
        branch.antiderivative((y + atan(B * sin(2 * pi * y) / below) / pi) / root)


if __name__ == "__main__":
    project.tell()
