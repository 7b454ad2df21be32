"""Section 2: every Legendre coefficient of the phase function, not only the first ones of (4).

A_k = (-1)^k (2 k + 1) a_k^2, a_k being the coefficient of the clamped cosine: the sphere takes light in by one clamped
cosine and sends it out by another one, backwards. Beyond the first, the odd ones vanish.
"""

from sympy import Integral, Rational, Symbol, acos, factorial, gamma, legendre, pi, sqrt

from derivations.deon2021.phase import coefficient, mu, short, v
from xsec_sym.proof import Source, integers

project = Source("xsec", section="Lambertian spheres")

n = Symbol("n", integer=True, nonnegative=True)

# --- the moments of a clamped cosine and of a half circle -----------------------------------------------


def clamped(degree):
    """The moment of the clamped cosine with a Legendre polynomial; the coefficient is twice that."""
    return Integral(v * legendre(degree, v), (v, 0, 1))


def bent(degree):
    """(1 - v^2) (P - v P'); its derivative is (l - 1) (l + 2) v P, by Legendre's equation."""
    here, before = legendre(degree, v), legendre(degree - 1, v)
    return (1 - v**2) * here - v * degree * (before - v * here)


even_cosine = project.claim(
    "lambert-sphere.clamped",
    "the Legendre moments of the clamped cosine, of even degree",
    left=clamped(2 * n + 2),
    corrected=(-1) ** n * gamma(n + Rational(1, 2)) / (4 * sqrt(pi) * gamma(n + 3)),
    where=[integers(n)],
    reading="the degree is 2 n + 2",
)


@even_cosine.proof
def from_two_degrees_less(step):
    (m,) = step.right.free_symbols
    low = 2 * m + 2
    step.recurrence(
        m,
        step.right,
        base=3 * v**4 / 8 - v**2 / 4,
        primitive=(low + 2) * bent(low + 2) + (low + 1) * bent(low),
        following=(low + 2) * (low + 1) * (low + 4),
        present=(low + 1) * (low - 1) * (low + 2),
    )


half_circle = project.claim(
    "lambert-sphere.half-circle",
    "the Legendre moments of a half circle, of even degree",
    left=Integral(sqrt(1 - v**2) * legendre(2 * n, v), (v, -1, 1)),
    corrected=-gamma(n + Rational(1, 2)) * gamma(n - Rational(1, 2)) / (4 * factorial(n) * factorial(n + 1)),
    where=[integers(n)],
    reading="the degree is 2 n",
)
no_half_circle = project.claim(
    "lambert-sphere.half-circle.odd",
    "the Legendre moments of a half circle, of odd degree",
    left=Integral(sqrt(1 - v**2) * legendre(2 * n + 1, v), (v, -1, 1)),
    corrected=0,
    where=[integers(n)],
    reading="the degree is 2 n + 1",
)


@half_circle.proof
@no_half_circle.proof
def by_the_circle(step):
    (m,) = step.left.free_symbols
    odd = int(step.left.has(legendre(2 * m + 1, v)))
    low, root = 2 * m + odd, sqrt(1 - v**2)
    step.recurrence(
        m,
        step.right,
        base=-(root**3) / 3 if odd else (v * root - acos(v)) / 2,
        primitive=-(2 * low + 3) * root**3 * legendre(low + 1, v),
        following=(low + 4) * (low + 2),
        present=-(low + 1) * (low - 1),
    )


# --- of the phase function ------------------------------------------------------------------------------

for label, first, moments in (("even", 2, half_circle), ("odd", 3, no_half_circle)):
    general = project.claim(
        f"lambert-sphere.legendre.{label}",
        f"every Legendre coefficient of {label} degree beyond the first",
        left=coefficient(2 * n + first),
        corrected=(-1) ** first * (4 * n + 2 * first + 1) * (2 * clamped(2 * n + first)) ** 2,
        where=[integers(n)],
        reduces=(short.id,),
        reading=f"(3), the degree being 2 n + {first}" + ("; both sides are 0" if first == 3 else ""),
    )

    @general.proof
    def by_legendres_equation(step, first=first, moments=moments):
        """f = sqrt(1 - v^2) - v acos(v) solves ((1 - v^2) f')' + 2 f = 3 sqrt(1 - v^2), and f' = - acos(v)."""
        (m,) = step.left.free_symbols
        degree, root = 2 * m + first, sqrt(1 - v**2)
        here, before = legendre(degree, v), legendre(degree - 1, v)
        size = (degree - 1) * (degree + 2)
        step.lemma(short, {mu: v})
        f, scale = root - v * acos(v), 2 / (3 * pi**2)
        step.linear(scale * (f + 3 * root / size) * here, -scale * 3 * root * here / size)
        exact = next(i for i in step.integrals if i.has(acos))
        slope = degree * (before - v * here)
        step.antiderivative((-(1 - v**2) * acos(v) * here - f * slope) / size, exact)
        step.lemma(moments, {n: m + 1})
        step.swap()
        if first == 2:
            step.lemma(even_cosine, {n: m})
        else:
            step.antiderivative(bent(degree) / ((degree - 1) * (degree + 2)))


if __name__ == "__main__":
    project.tell()
