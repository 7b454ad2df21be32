"""Names that are bound, taken or mapped, and lemmas: nothing is known of one name that was said of another."""

from __future__ import annotations

from sympy import (
    Abs,
    Function,
    Heaviside,
    I,
    Integral,
    Limit,
    Rational,
    S,
    Sum,
    Symbol,
    besseli,
    cos,
    exp,
    log,
    oo,
    pi,
)

from tests.proof.goals import (
    CIRCLE_OF,
    LATE,
    POSITIVE,
    a,
    b,
    claim,
    j,
    m,
    n,
    refused,
    series,
    step_on,
    t,
    w,
    x,
    y,
    z,
)
from xsec_sym.proof import integers, interval, parity
from xsec_sym.proof.magnitude import Magnitude


def test_one_integral_in_two_places():
    """On the left y is positive, on the right negative; the same inner integral stands on both sides."""
    inner = Integral(Abs(y) * x, (x, 0, 1))
    left = Integral((1 + y) * inner, (y, 0, 1)) + Integral((1 + y) * inner, (y, -1, 0))
    refused(step_on(left, 0).antiderivative, y * x**2 / 2, inner, match="two places")
    free = inner + Integral((1 + y) * inner, (y, -1, 0))
    refused(step_on(free, 0, interval(y, 0, 1, open=True)).antiderivative, y * x**2 / 2, inner, match="two places")
    twice = inner + inner**2
    step_on(twice, 0, interval(y, 0, 1, open=True)).antiderivative(y * x**2 / 2, inner)


def test_what_is_noted_of_an_integrand_speaks_of_no_other_variable():
    """Noted between x = 0 and 1 where y > 0, it is not so where y runs from -1 to 0."""
    inner = Integral(Abs(y) * x, (x, 0, 1))
    left = y + Integral((2 + y) * inner, (y, -1, 0))
    step = step_on(left, 0, interval(y, 0, 1, open=True)).fact(y * x, inside=(x, 0, 1))
    refused(step.rewrite, Abs(y) * x, y * x)
    limits = Integral(Abs(x) + x, (x, 0, y))
    left = y + Integral((2 + y) * limits, (y, -1, 0))
    step = step_on(left, 0, interval(y, 0, 1, open=True)).fact(x, inside=(x, 0, y))
    refused(step.rewrite, Abs(x), x)


def test_a_case_captures_no_name():
    """x is also the name of a variable of integration."""
    left = Integral(x * y, (x, 0, 1)) + x
    on_y = step_on(left, 0, interval(x, 0, 1), interval(y, 0, 1))
    refused(lambda: next(on_y.cases(y - x, y, x)), match="captured")


def test_a_substitution_captures_no_name():
    inner = Integral(x * y, (y, 0, 1))
    left = y + Integral(exp(x) * inner, (x, 0, 1))
    bent = t + y * t * (1 - t) / 2
    refused(step_on(left, 0, interval(y, 0, 1)).substitute, t, bent, 0, 1, match="captured")


def test_nothing_comes_from_nothing():
    """Two sums, or integrals, without a value cancel; brought in from nowhere, they would prove anything."""
    ones = series(1) - series(S.One, m)
    refused(step_on(0, 1).rewrite, 0, ones, match="brings in")
    pole = Integral(1 / x, (x, 0, 1)) - Integral(1 / y, (y, 0, 1))
    refused(step_on(0, log(2)).rewrite, 0, pole, match="brings in")


def test_a_mapping_maps_names():
    square = claim("square", (w + 1) ** 2, w**2 + 2 * w + 1)
    refused(step_on((w + 1) ** 2, 2 * w + 6, claims=[square]).lemma, square, {w**2: 5}, match="name")


def test_a_mapping_keeps_to_what_a_name_stands_for():
    real = claim("real", Abs(w) ** 2, w**2, interval(w, -oo, oo))
    refused(step_on(1, -1, claims=[real]).lemma, real, {w: I})
    above = claim("step", Heaviside(1 / w), 1, interval(w, 0, oo, open=True))
    refused(step_on(Rational(1, 2), 1, claims=[above]).lemma, above, {w: oo})
    order = claim("order", Integral(exp(z * cos(t)) * cos(n * t), CIRCLE_OF(t)), 2 * pi * besseli(n, z))
    half = order.left.subs(n, Rational(1, 2))
    refused(step_on(half, 2 * pi * besseli(S.Half, z), claims=[order]).lemma, order, {n: S.Half})
    refused(step_on(half.subs(S.Half, a), 0, claims=[order]).lemma, order, {n: a})
    step_on(order.left.subs(n, m + 1), 2 * pi * besseli(m + 1, z), claims=[order]).lemma(order, {n: m + 1}).close()


def test_a_lemma_read_backwards_keeps_to_its_domain():
    one = claim("one", w / Abs(w), 1, interval(w, 0, 1, open=True))
    refused(step_on(y, 0, claims=[one]).lemma, one, {w: y}, back=True, match="does not occur")
    refused(step_on(1 + y, 0, interval(y, -1, 0), claims=[one]).lemma, one, {w: y}, back=True, match="not shown")
    refused(step_on(S.One, 0, claims=[one]).lemma, one, back=True)
    step_on(1 + y, 1 + y, interval(y, 0, 1, open=True), claims=[one]).lemma(one, {w: y}, back=True).close()


def test_a_lemma_holds_inside_a_sum():
    square = claim("inside", Abs(w), w, interval(w, 0, oo))
    shifted = series(Abs(j + a, evaluate=False) * b**j)
    step_on(shifted, series((j + a) * b**j), POSITIVE, claims=[square]).lemma(square, {w: j + a}).close()
    index = integers(Symbol("i")).index
    bad = series(Abs(index - 2) * b**index, index) + index
    refused(step_on(bad, 0, index > 2, claims=[square]).lemma, square, {w: index - 2}, match="natural")
    early = Sum(Abs(LATE - 1) * b**LATE, (LATE, 0, oo))
    if early.has(Abs):
        refused(step_on(early, 0, claims=[square]).lemma, square, {w: LATE - 1}, match="natural")


def test_nothing_is_rewritten_under_another_binder():
    under = Limit(Heaviside(x), x, 0) + x
    refused(step_on(under, 0, interval(x, 0, 1, open=True)).rewrite, Heaviside(x), 1)


def test_a_sign_noted_with_a_lemma_read_backwards():
    f = Function("f")(w)
    given = claim("sign", Magnitude(f), f, interval(w, 0, 1))
    step = step_on(Abs(f), f, interval(w, 0, 1), claims=[given]).fact(f, by=given, back=True)
    step.close()
    refused(step_on(Abs(f), f, interval(w, 0, 2), claims=[given]).fact, f, by=given, back=True, match="not shown")
    refused(step_on(Abs(f), f, interval(w, 0, 1), claims=[given]).fact, f, by=given)


def test_a_member_and_its_index_belong_together():
    """The lemma speaks of f at p = 2 n + 1, in p on the left and in n on the right."""
    odd = parity(Symbol("p", integer=True), odd=True)
    f, index, member = Function("f"), odd.index, odd.symbol
    given = claim("member", f(member), f(2 * index + 1), odd)
    false = step_on(f(2 * m + 1) + index, f(2 * index + 1) + index, claims=[given])
    refused(lambda: false.lemma(given, {member: 2 * m + 1}).close())
    false = step_on(f(2 * index + 1) + m, f(2 * m + 1) + m, claims=[given])
    refused(false.lemma, given, {index: m}, match="does not occur")
    refused(false.lemma, given, {member: 2 * index + 1, index: m}, match="counts")
    step_on(f(2 * m + 1), f(2 * m + 1), claims=[given]).lemma(given, {index: m}).close()


def test_nothing_is_reckoned_with_what_is_infinite():
    pole = Integral(1 / x, (x, 0, 1))
    given = claim("infinite", pole, oo)
    f = Function("f")
    refused(step_on(f(1 / pole), f(0), claims=[given]).lemma, given, match="infinite")
    step_on(pole, oo, claims=[given]).lemma(given).close()


def test_the_names_of_a_normal_form_are_its_own():
    typed = Symbol("i#1", integer=True, nonnegative=True)
    refused(step_on, series((typed - m) * a**m, m), 0, match="names")


def test_what_is_known_of_a_name_is_not_known_of_a_bound_one():
    """Telescoping inside an integral over y < 0, where the claim's own y is positive."""
    total = Sum(Abs(y) * j, (j, 0, n))
    left = y + Integral(total, (y, -1, 0))
    refused(step_on(left, 0, interval(y, 0, 1, open=True)).telescope, y * j * (j + 1) / 2, total)
