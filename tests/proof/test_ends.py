"""Infinite and singular ends, the whole plane, the signs they need: what is true passes, and no attack does."""

from __future__ import annotations

import pytest
from sympy import (
    Function,
    Heaviside,
    Integral,
    Max,
    Rational,
    Symbol,
    atan,
    cos,
    erf,
    exp,
    log,
    oo,
    pi,
    sin,
    sqrt,
    symbols,
    sympify,
)

from xsec_sym.exact import AZIMUTH, NormalsBeckmann, RingCrossSection, SigmaBeckmann
from xsec_sym.proof import Refused, Source, interval
from xsec_sym.proof.checker import replay
from xsec_sym.proof.domain import domain
from xsec_sym.proof.ends import end_value, tends_to
from xsec_sym.proof.examine import examine
from xsec_sym.proof.numeric import reduced
from xsec_sym.proof.piece import Piece
from xsec_sym.proof.rules import Goal
from xsec_sym.proof.steps import Step, derive

a, p, q, r, t, u, v, x, y = symbols("a p q r t u v x y", real=True)


def on(*ranges):
    return Piece.of(domain(ranges))


def step_on(left, right, *ranges):
    return Step(Goal(left, sympify(right), on(*ranges)), {}, [])


def integral(f, low, high, primitive, value, *ranges):
    step_on(Integral(f, (x, low, high)), value, *ranges).antiderivative(primitive).close()


def refused(attack, *args, match=None):
    with pytest.raises(Refused, match=match):
        attack(*args)


POSITIVE = interval(a, 0, oo, open=True)


# --- infinite and singular ends -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("f", "low", "high", "primitive", "value"),
    [
        (exp(-(x**2)), -oo, oo, sqrt(pi) / 2 * erf(x), sqrt(pi)),
        (x * exp(-x / a), 0, oo, -a * (x + a) * exp(-x / a), a**2),
        (1 / (x**2 + a**2), 0, oo, atan(x / a) / a, pi / (2 * a)),
        (1 / (1 + x**2) ** Rational(3, 2), -oo, 0, x / sqrt(1 + x**2), 1),
        (exp(1 / x) / x**2, -1, 0, -exp(1 / x), exp(-1)),
        (exp(-1 / x) / x**2, 1, 0, exp(-1 / x), -exp(-1)),
        (exp(-a * x) * (a * log(1 + 1 / a) + 0 * x), oo, 0, -exp(-a * x) * log(1 + 1 / a), -log(1 + 1 / a)),
    ],
    ids=str,
)
def test_integrals_up_to_such_an_end(f, low, high, primitive, value):
    integral(f, low, high, primitive, value, POSITIVE)


@pytest.mark.parametrize(
    ("f", "low", "high", "primitive"),
    [
        (1 / x, 1, oo, log(x)),
        (1 / x**2, 0, 1, -1 / x),
        (cos(x), 0, oo, sin(x)),
        (exp(x), 0, oo, exp(x)),
        (exp(1 / x) / x**2, 0, 1, -exp(1 / x)),
        (1 / (1 + x**2), -1, 1, -atan(1 / x)),
        (2 * x * sin(1 / x) - cos(1 / x), 0, 1, x**2 * sin(1 / x)),
        (x, -oo, oo, x**2 / 2),
        (1, 0, oo, x),
    ],
    ids=str,
)
def test_divergent_and_oscillating_ends_have_no_value(f, low, high, primitive):
    refused(integral, f, low, high, primitive, 0)


def test_a_sign_at_infinity_must_show():
    either = interval(a, -1, 1)
    refused(integral, 2 * a / sqrt(pi) * exp(-(a**2) * x**2), 0, oo, erf(a * x), 1, either)
    refused(integral, -a * exp(-a * x), 0, oo, exp(-a * x), -1, either)
    refused(integral, exp(-a / x) * a / x**2, 0, 1, exp(-a / x), exp(-a), either)


def test_an_end_is_approached_from_inside():
    """erf(1 / x) is 1 to the right of 0 and -1 to the left, whichever limit is written first."""
    bell = -2 / sqrt(pi) * exp(-1 / x**2) / x**2
    integral(bell, 0, 1, erf(1 / x), erf(1) - 1)
    integral(bell, 1, 0, erf(1 / x), 1 - erf(1))
    integral(bell, -1, 0, erf(1 / x), erf(1) - 1)
    refused(integral, bell, 1, 0, erf(1 / x), -1 - erf(1))
    unordered = bell.subs(x, x - a)
    refused(integral, unordered, a, u, erf(1 / (x - a)), erf(1 / (u - a)) - 1, interval(a, -1, 1), interval(u, -1, 1))


def test_a_pole_that_may_sit_at_the_end():
    both = on(interval(a, -1, 1), interval(u, -1, 1))
    refused(end_value, erf(1 / (x - a)), x, u, "low", both)
    assert end_value(erf(1 / (x - a)), x, a, "low", both) == 1


def test_leading_terms_that_cancel_are_not_taken_for_granted():
    refused(end_value, sqrt(x**2 + x) - x, x, oo, "high", Piece())
    refused(end_value, erf(x * (sqrt(x**2 + 1) - x)), x, oo, "high", Piece())
    assert end_value((x**3 - x) / (2 * x**3), x, oo, "high", Piece()) == Rational(1, 2)
    assert end_value(x**5 * exp(-x) * atan(x), x, oo, "high", Piece()) == 0
    assert tends_to(x / sqrt(1 - x**2), x, 1, "high", oo, Piece())
    assert not tends_to(x / sqrt(1 - x**2), x, 1, "high", -oo, Piece())


def test_a_substitution_reaches_its_limits():
    step = step_on(Integral(exp(-x), (x, 0, oo)), 1)
    step.substitute(y, y / (1 - y), 0, 1)
    refused(step_on(Integral(exp(-x), (x, 0, oo)), 1).substitute, y, y, 0, 1)
    refused(step_on(Integral(exp(-x), (x, 0, oo)), 1).substitute, y, -y / (1 - y), 0, 1)
    refused(step_on(Integral(x, (x, 0, 2)), 2).substitute, y, 1 / (1 + y**2), oo, 0, match="do not match")
    refused(step_on(Integral(x, (x, 0, 1)), 2).substitute, y, 1 / (1 + y**2), oo, -oo)


def test_limits_at_infinity_are_in_order():
    assert Piece().order(-oo, u) == "+" and Piece().order(oo, u) == "-" and Piece().order(u, oo) == "+"
    assert Piece().order(u, v) is None


# --- the plane ------------------------------------------------------------------------------------------

BELL = exp(-(p**2) - q**2)


def over_the_plane(f, ends=((-oo, oo), (-oo, oo))):
    (a1, b1), (a2, b2) = ends
    return step_on(Integral(f, (p, a1, b1), (q, a2, b2)), pi)


def test_polar_coordinates():
    phi = Symbol("phi", real=True)
    step = over_the_plane(BELL).polar(r, phi)
    step.antiderivative(phi * exp(-(r**2)), next(i for i in step.left.atoms(Integral) if i.limits[0][0] == phi))
    step.antiderivative(-pi * exp(-(r**2))).close()


def test_polar_coordinates_want_the_whole_plane_one_sign_and_new_names():
    phi = Symbol("phi", real=True)
    refused(over_the_plane(BELL, ((0, oo), (-oo, oo))).polar, r, phi, match="whole plane")
    refused(over_the_plane(BELL, ((-oo, oo), (-1, 1))).polar, r, phi, match="whole plane")
    refused(over_the_plane(BELL * p).polar, r, phi, match="one sign")
    refused(over_the_plane(BELL * (p**2 - q**2)).polar, r, phi, match="one sign")
    refused(over_the_plane(BELL).polar, p, phi, match="already")
    refused(over_the_plane(BELL).polar, r, r, match="already")
    refused(over_the_plane(BELL).polar, r, Symbol("z"), match="real")
    refused(step_on(Integral(BELL * r**2, (p, -oo, oo), (q, -oo, oo)), pi).polar, r, phi, match="already")
    hidden = Integral(p**2 * x, (x, 0, 1))
    refused(step_on(Integral(BELL * hidden, (p, -oo, oo), (q, -oo, oo)), pi).polar, r, phi)


# --- signs and steps ------------------------------------------------------------------------------------


def test_a_step_forgets_positive_factors_only():
    here = on(interval(u, -1, 1), interval(v, -1, 1), POSITIVE)
    assert here.is_zero(Heaviside(a * u) - Heaviside(u))
    assert here.is_zero(Heaviside(-u / a) - 1 + Heaviside(u))
    assert here.is_zero(Max(0, u / a) - Max(0, u) / a)
    assert not here.is_zero(Heaviside(u * v) - Heaviside(u))
    assert not here.is_zero(Heaviside(u**2 * v) - Heaviside(v))
    assert not on(interval(a, 0, 1), interval(u, -1, 1)).is_zero(Heaviside(a * u) - Heaviside(u))
    assert not here.is_zero(Heaviside(a * u, 0) - Heaviside(u, 1))


def test_signs_of_a_maximum_and_of_a_square():
    here = on(interval(u, -1, 1), interval(v, 0, 1, open=True))
    assert here.sign(Max(0, u)) == ">=" and here.sign(Max(v, u)) == "+" and here.sign(Max(-1, u)) is None
    assert here.sign((u - v) ** 2) == ">=" and here.sign((u - v) ** 3) is None
    assert here.sign((u + sqrt(v - 2)) ** 2) is None


# --- definitions and lemmas -----------------------------------------------------------------------------


def test_a_definition_binds_no_name_of_its_arguments():
    refused(step_on(RingCrossSection(cos(AZIMUTH), u), 0).unfold, match="captured")
    refused(step_on(SigmaBeckmann(x, a), 0).unfold, match="captured")


def test_a_lemma_meets_its_left_side_written_out():
    proven = Source("ends").claim("1", "a name", left=NormalsBeckmann(u, a), corrected=7, where=[interval(u, 0, 1)])
    step = Step(Goal(NormalsBeckmann(t, a).definition(), 7 + 0 * t, on(interval(t, 0, 1))), {proven.id: proven}, [])
    step.lemma(proven, {u: t}).close()
    f = Function("f")
    other = Step(Goal(f(t), 7 + 0 * t, on(interval(t, 0, 1))), {proven.id: proven}, [])
    refused(other.lemma, proven, {u: t}, match="does not occur")


def test_such_a_proof_is_written_down_and_replayed():
    claim = Source("ends").claim(
        "1", "a bell", left=Integral(exp(-(x**2) / a**2), (x, -oo, oo)), printed=a * sqrt(pi), where=[POSITIVE]
    )
    claim.proof(lambda step: step.antiderivative(a * sqrt(pi) / 2 * erf(x / a)))
    certificate, _ = derive(claim, {})
    assert replay(claim, certificate, {}) == len(certificate["moves"])
    wrong = Source("ends").claim("1", "a bell", left=claim.left, printed=a * sqrt(pi), where=[interval(a, -1, 1)])
    refused(replay, wrong, certificate, {})


# --- the numeric half -----------------------------------------------------------------------------------


def test_a_side_that_is_not_real_is_refuted():
    verdict = examine(Source("ends").claim("1", "a root", left=u, printed=u + sqrt(-u), where=[interval(u, 1, 2)]))
    assert verdict.verdict == "refuted" and "j" in verdict.witness["right"]


def test_an_inner_integral_is_recognised_only_where_it_has_the_form():
    A, B = symbols("A B", real=True)
    circle = Source("ends").claim(
        "1", "a circle", left=Integral(1 / (A - B * cos(2 * pi * y)), (y, 0, 1)), corrected=1 / sqrt(A**2 - B**2)
    )
    inner = t / (3 - u * (t + 2 * cos(2 * pi * x)))
    assert reduced(Integral(inner, (x, 0, 1), (t, 0, 1)), [circle]).atoms(Integral).pop().limits == ((t, 0, 1),)
    for other, ends in (
        (1 / (3 - cos(2 * pi * x) ** 2), (0, 1)),
        (1 / (3 - cos(pi * x)), (0, 1)),
        (x / (3 - cos(2 * pi * x)), (0, 1)),
        (1 / (3 - x * cos(2 * pi * x)), (0, 1)),
        (1 / (3 - cos(2 * pi * x)), (0, 2)),
    ):
        whole = Integral(other, (x, *ends), (t, 0, 1))
        assert reduced(whole, [circle]) == whole
