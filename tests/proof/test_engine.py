"""The engine must prove what is true, refute what is false, and know the difference from what it cannot tell."""

from __future__ import annotations

import pytest
from sympy import (
    Abs,
    Function,
    Heaviside,
    I,
    Integral,
    Piecewise,
    Rational,
    Sum,
    Symbol,
    atan,
    binomial,
    cos,
    cosh,
    coth,
    exp,
    gamma,
    log,
    oo,
    pi,
    sin,
    sinh,
    sqrt,
    symbols,
    tan,
)  # fmt: skip

from xsec_sym.proof import EmptyDomain, Refused, Source, interval
from xsec_sym.proof.domain import domain
from xsec_sym.proof.examine import examine
from xsec_sym.proof.piece import Piece
from xsec_sym.proof.rules import Goal
from xsec_sym.proof.steps import Step
from xsec_sym.proof.verdict import Verdict
from xsec_sym.proof.verify import verify

a, u, x, t, phi = symbols("a u x t varphi", real=True)
n = Symbol("n_p", integer=True, nonnegative=True)
k = Symbol("k", integer=True)


def equation(left, right, *where, **rest):
    return Source("test").claim("1", "a test", left=left, printed=right, where=where, **rest)


def on(*ranges):
    return Piece.of(domain(ranges))


# --- verdicts on whole equations -----------------------------------------------------------------------


def test_the_arctangents_are_proved_on_one_side_of_the_pole():
    verdict = examine(equation(atan(a) + atan(1 / a), pi / 2, interval(a, Rational(1, 10), 5)))
    assert verdict.verdict == "proved"


def test_the_arctangents_are_refuted_across_the_pole():
    verdict = examine(equation(atan(a) + atan(1 / a), pi / 2, interval(a, -5, 5, open=True)))
    assert verdict.verdict == "refuted"
    assert Rational(verdict.witness["point"]["a"]) < 0


def test_a_witness_with_free_functions_is_told_with_their_instances():
    f, g = Function("f", real=True), Function("g", real=True)
    many = {f: (lambda *v: v[0] - 2 * v[2],), g: (lambda a, b: a * b,)}
    verdict = examine(equation(f(u, 1, u) + g(u, 2), 2 * u, interval(u, 0, 1), instances=many))
    assert verdict.verdict == "refuted"
    assert verdict.witness["point"].items() >= {"f": "x_1 - 2*x_3", "g": "x_1*x_2"}.items()


def test_a_root_of_a_square_is_not_its_base():
    verdict = examine(equation(sqrt(u**2), u, interval(u, -1, 1)))
    assert verdict.verdict == "refuted"
    assert Rational(verdict.witness["point"]["u"]) < 0


def test_a_root_of_a_square_is_the_absolute_value():
    assert examine(equation(sqrt(u**2), Abs(u), interval(u, -1, 1))).verdict in ("proved", "confirmed")


def test_an_empty_domain_is_an_error():
    with pytest.raises(EmptyDomain):
        interval(u, 1, -1)
    with pytest.raises(EmptyDomain):
        examine(equation(u, u**2, interval(u, -1, 1), u > 2))


def test_a_divergent_integral_is_never_given_a_value():
    for right in (0, 1, 10, log(10**6)):
        verdict = examine(equation(Integral(1 / x, (x, 0, a)), right, interval(a, 1, 2)))
        assert verdict.verdict == "inconclusive", right


def test_a_small_difference_is_seen():
    almost = sin(a) ** 2 + cos(a) ** 2 + Rational(1, 10**25)
    assert examine(equation(almost, 1, interval(a, -3, 3))).verdict == "refuted"


def test_a_proof_that_a_witness_refutes_is_never_a_verdict(monkeypatch):
    claim = equation(u, u + 1, interval(u, -1, 1))
    claim.proof(lambda step: None)
    monkeypatch.setattr(Piece, "is_zero", lambda self, e: True)
    verdict = verify(claim, {claim.id: claim})
    assert verdict.verdict == "inconclusive" and "witness" in verdict.note


def test_a_correction_of_a_print_that_holds_is_rejected():
    claim = equation(u + u, 2 * u, interval(u, -1, 1), corrected=2 * u + 0 * u, edit="nothing")
    assert verify(claim, {claim.id: claim}).verdict == "inconclusive"


def test_confirmed_needs_twenty_witnesses_and_a_second_opinion():
    product = exp(log(2) * a) * 2 ** (1 - a)
    verdict = examine(equation(Integral(exp(-x * a), (x, 0, 1)) * a * product / 2, 1 - exp(-a), interval(a, 1, 3)))
    assert verdict.verdict in ("proved", "confirmed")
    if verdict.verdict == "confirmed":
        assert verdict.evidence["witnesses"] >= 20 and verdict.evidence["mpmath"] >= 1 and verdict.mutants >= 8


def test_a_floating_point_number_proves_nothing():
    assert examine(equation(u * 0.5, u / 2, interval(u, 0, 1))).verdict == "inconclusive"


# --- the moves ------------------------------------------------------------------------------------------


def step_on(left, right, *ranges):
    return Step(Goal(left, right, on(*ranges)), {}, [])


def test_an_antiderivative_must_be_one():
    with pytest.raises(Refused, match="derivative"):
        step_on(Integral(x**2, (x, 0, 1)), Rational(1, 3)).antiderivative(x**3)
    step_on(Integral(x**2, (x, 0, 1)), Rational(1, 3)).antiderivative(x**3 / 3).close()


def test_an_antiderivative_must_be_continuous():
    with pytest.raises(Refused):
        step_on(Integral(1 / (1 + x**2), (x, -1, 1)), 0).antiderivative(-atan(1 / x))
    with pytest.raises(Refused):
        step_on(Integral(1 / x**2, (x, -1, 1)), -2).antiderivative(-1 / x)


def test_a_cut_must_lie_inside():
    with pytest.raises(Refused, match="not shown to lie above"):
        step_on(Integral(Abs(x), (x, 0, 1)), 1).split(2)


def test_an_ode_wants_one_connected_piece():
    claim = step_on(atan(a) + atan(1 / a), pi / 2, interval(a, -5, 5))
    with pytest.raises(Refused):
        claim.ode(a, [0, 1], at=1)
    step_on(atan(a) + atan(1 / a), pi / 2, interval(a, Rational(1, 10), 5)).ode(a, [0, 1], at=1)


def test_an_ode_wants_its_initial_values():
    with pytest.raises(Refused, match="derivative 0"):
        step_on(cos(a) + 1, cos(a), interval(a, -1, 1)).ode(a, [0, 1], at=0)
    step_on(exp(a), cosh(a) + sinh(a), interval(a, -1, 1)).ode(a, [-1, 0, 1], at=0)


def test_an_ode_must_not_be_singular():
    with pytest.raises(Refused):
        step_on(a, a, interval(a, -1, 1)).ode(a, [0, a], at=Rational(1, 2))


def test_a_case_must_have_one_root():
    with pytest.raises(Refused):
        list(step_on(u, u, interval(u, -1, 1)).cases(u**2 - Rational(1, 4), u, Rational(1, 2), u + Rational(1, 2)))


def test_a_piece_is_not_empty_for_the_asking():
    with pytest.raises(Refused, match="empty"):
        step_on(u, u, interval(u, -1, 1)).vacuous()


def test_a_sign_must_show():
    with pytest.raises(Refused):
        step_on(u, u, interval(u, -1, 1)).fact(u + Rational(1, 2), u, Rational(1, 2))


def test_a_fact_about_an_integrand_stays_there():
    step = step_on(Integral(Abs(x), (x, -1, 0)) + Integral(Abs(x), (x, 0, 1)), 1)
    step.fact(x, x, inside=(x, 0, 1))
    assert step.goal.piece.inside(x, -1, 0).sign(x) == "-"
    assert step.goal.piece.sign(x) is None


@pytest.mark.parametrize(
    ("script", "said"),
    [
        (
            lambda step: step.lemma("test:2"),
            "there is no claim called test:2; did you mean test:1? (test_engine.py, line",
        ),
        (lambda step: step.antiderivatve(x), "there is no move called antiderivatve; did you mean antiderivative?"),
        (lambda step: step.antiderivative(1 / 0), "ZeroDivisionError: division by zero (test_engine.py, line"),
    ],
)
def test_a_proof_that_cannot_be_run_is_told_and_settles_nothing(script, said):
    claim = equation(Integral(x, (x, 0, u)), u**2 / 2, interval(u, 0, 1))
    claim.proof(script)
    verdict = verify(claim, {claim.id: claim})
    assert verdict.verdict == "inconclusive" and verdict.note.startswith(f"the proof cannot be run: {said}")


def test_a_proof_that_says_nothing_proves_nothing():
    claim = equation(Integral(x, (x, 0, u)), u**2 / 2, interval(u, 0, 1))
    claim.proof(lambda step: None)
    verdict = verify(claim, {claim.id: claim})
    assert verdict.verdict == "confirmed" and "the proof does not go through" in verdict.note


def test_tonelli_wants_one_sign():
    inner = Integral(t - x, (t, 0, 1))
    with pytest.raises(Refused, match="one sign"):
        step_on(Integral(x * inner, (x, -1, 1)), 0).exchange()


def test_branches_do_not_leave_the_integral_that_binds_them():
    """SymPy pulls a Piecewise out of a nested integral, and the inner variable with it."""
    f = Function("f")
    proven = equation(f(x, t), Piecewise((1, t < x), (0, True)), interval(x, 0, 1), interval(t, 0, 1))
    step = Step(Goal(Integral(x * Integral(f(x, t), (t, 0, 1)), (x, 0, 1)), 0 * x, Piece()), {proven.id: proven}, [])
    with pytest.raises(Refused, match="free"):
        step.lemma(proven)


def test_induction_checks_base_and_step():
    integral = Integral(x ** (2 * n), (x, 0, 1))
    good = dict(base=x, primitive=x ** (2 * n + 1), following=0, present=2 * n + 1)
    with pytest.raises(Refused):
        step_on(integral, 1).recurrence(n, 1 / (2 * n + 1), **good)  # following may vanish: nothing is carried on
    wrong = dict(base=x, primitive=x ** (2 * n + 3), following=2 * n + 3, present=0)
    step_on(integral, 1 / (2 * n + 1)).recurrence(n, 1 / (2 * n + 1), **wrong).close()
    with pytest.raises(Refused, match="closed form"):
        step_on(integral, 1).recurrence(n, 1 / (2 * n + 2), **wrong)


def test_a_telescoping_sum_is_checked():
    j = Symbol("j", integer=True, positive=True)
    total = Sum(1 / (j * (j + 1)), (j, 1, n))
    step_on(total, n / (n + 1)).telescope(-1 / (j + 1)).close()
    with pytest.raises(Refused):
        step_on(total, n / (n + 1)).telescope(1 / (j + 1))


def test_divergence_wants_a_divergent_minorant():
    integral = Integral(1 / sqrt(x), (x, 0, 1))
    with pytest.raises(Refused):
        step_on(integral, oo).diverges(1 / x, 1, end="low")
    with pytest.raises(Refused):
        step_on(Integral(1 / x, (x, 0, 1)), 7).diverges(1 / x, 1, end="low")
    step_on(Integral(2 / x, (x, 0, 1)), oo).diverges(1 / x, 1, end="low")


# --- attacks that once succeeded -----------------------------------------------------------------------


def closes(attack):
    try:
        attack()
    except Refused:
        return False
    return True


def test_a_periodic_primitive_is_not_continuous():
    assert not closes(lambda: step_on(Integral(1, (x, 0, pi)), 0).antiderivative(atan(tan(x))).close())
    assert not closes(lambda: step_on(Integral(1 / sinh(x) ** 2, (x, -1, 1)), 0).antiderivative(-coth(x)).close())
    assert not closes(lambda: step_on(atan(tan(x)), x, interval(x, -5, 5)).ode(x, [0, 1], at=0))


def test_limits_in_the_wrong_order_say_nothing_of_the_variable():
    assert not closes(lambda: step_on(Integral(Abs(x), (x, 0, -1)), Rational(1, 2)).antiderivative(x**2 / 2).close())
    assert Piece().inside(x, 0, -1).sign(x) == "-"
    assert on(interval(a, -1, 1)).inside(x, 0, a).sign(x) is None


def test_an_infinite_end_has_no_distance():
    integral = Integral(sin(x) ** 2 / x**2, (x, 0, oo))
    assert not closes(lambda: step_on(integral, oo).diverges(0, 1, 0, "high"))


def test_a_quotient_of_unknown_sign_keeps_its_root():
    b = Symbol("b", real=True)
    quotient = equation(sqrt(a / b), sqrt(a * b) / b, interval(a, -1, 1), interval(b, -1, 1), a * b > 0)
    assert examine(quotient).verdict == "refuted"


def test_a_step_keeps_its_value_at_zero():
    assert not on(interval(u, -1, 1)).is_zero(Heaviside(u, 0) - Heaviside(u, 1))
    assert on(interval(u, -1, 1)).is_zero(Heaviside(u) + Heaviside(-u) - 1)


def test_an_ode_must_be_regular_where_its_values_are_given():
    assert not closes(lambda: step_on(x, 0 * x, interval(x, -1, 1)).ode(x, [-1 / x, 1], at=0))
    arctangents = step_on(atan(a) + atan(1 / a), -pi / 2, interval(a, -5, 5), a > 0)
    assert not closes(lambda: arctangents.ode(a, [0, 1], at=-1))


def test_divergent_parts_do_not_cancel():
    def attack():
        step = step_on(Integral(1, (x, 0, 1)), 1 - log(2)).linear(1 / x, 1 - 1 / x)
        step.substitute(t, 2 * t, 0, Rational(1, 2), step.integrals[0]).close()

    assert not closes(attack)
    whole = Integral(1, (x, 0, 1)) - Integral(1 / x, (x, 0, 1)) - Integral(1 - 1 / x, (x, 0, 1))
    assert not Piece().is_zero(whole)
    step = step_on(Integral(1, (x, 0, 1)), Integral(1, (x, 0, 1))).linear(1 / x, 1 - 1 / x)
    assert not closes(step.close)


def test_a_bound_variable_is_not_a_free_one():
    inner = Integral(x * t, (x, 0, 1))
    assert not closes(lambda: step_on(inner, Rational(1, 3), interval(t, 0, 1)).substitute(t, t, 0, 1))
    assert not on(interval(u, 0, 1)).is_zero(Integral(Abs(u), (u, -1, 1)) - Integral(u, (u, -1, 1)))
    f = Function("F")
    proven = equation(f(a), Integral(a * t, (t, 0, 1)), interval(a, 0, 1))
    step = Step(Goal(f(t), t / 2, on(interval(t, 0, 1))), {proven.id: proven}, [])
    with pytest.raises(Refused, match="captured"):
        step.lemma(proven, {a: t})


def test_hidden_names_do_not_meet():
    def nested(c):
        return Integral(1 / (2 + Integral(c, (t, 0, 1))), (x, 0, 2))

    assert not Piece().is_zero(nested(exp(x * t**2)) - nested(exp(x**2 * t)))


def test_induction_knows_nothing_of_its_index():
    c = (1 + 7 * Heaviside(n - Rational(5, 2))) / (2 * n + 1)
    step = Step(Goal(Integral(x ** (2 * n), (x, 0, 1)), c, Piece([(n - 3, True)])), {}, [])
    wrong = {"primitive": x ** (2 * n + 3) - x ** (2 * n + 1), "following": 2 * n + 3, "present": -(2 * n + 1)}
    assert not closes(lambda: step.recurrence(n, c, base=x, **wrong))


def test_every_term_beside_a_divergent_one_is_looked_at():
    backwards = Integral(1 / x, (x, 0, 1)) + Integral(1 / t**2, (t, 1, 0))
    assert not closes(lambda: step_on(backwards, oo).diverges(1 / x, 1, 0, "low", backwards.args[0]))
    j = Symbol("j", integer=True, positive=True)
    series = Integral(1 / x, (x, 0, 1)) - Sum(1 / j, (j, 1, oo))
    assert not closes(lambda: step_on(series, oo).diverges(1 / x, 1, 0, "low"))


def test_signs_and_zeros_that_were_taken_for_granted():
    j = Symbol("j", integer=True)
    assert Piece().sign(gamma(Rational(3, 2) - n)) is None
    assert not Piece().is_zero(Sum(Abs(j), (j, -3, n)) - Sum(j, (j, -3, n)))
    assert not Piece().is_zero(sqrt(exp(2 * I * u)) - exp(I * u))
    z = Symbol("z")
    assert not Piece().is_zero(Abs(z) ** 2 - z**2)
    assert not Piece().is_zero(binomial(n - 5, 2) - binomial(n - 5, n - 7))


def test_a_verdict_shows_itself_in_html():
    shown = Verdict("refuted", note="a < b", witness={"point": "a = <1>"})._repr_html_()
    assert shown == "<b>refuted</b> at a = &lt;1&gt; a &lt; b"
