"""Switch points are complete and ordered, branches are chosen exactly, and what is not known is refused."""

import pytest
from sympy import (
    Abs,
    Function,
    Heaviside,
    Max,
    Min,
    Piecewise,
    Rational,
    acos,
    atan,
    cos,
    exp,
    floor,
    log,
    oo,
    pi,
    sign,
    sin,
    sqrt,
    symbols,
)

from xsec_sym.proof.branches import Undecided, breakpoints, resolve, settle
from xsec_sym.proof.zeros import sign_of

x = symbols("x", real=True)
c = Rational(4, 5)


@pytest.mark.parametrize(
    "f, a, b, points",
    [
        (Abs(x - 1), 0, 3, [1]),
        (Abs(x - 1), 1, 3, []),
        (Abs(x**2 - 2), -2, 2, [-sqrt(2), sqrt(2)]),
        (Max(x, 1 / x), -2, 2, [-1, 0, 1]),
        (Min(x, x**2, 2), -3, 3, [-sqrt(2), 0, 1, sqrt(2), 2]),
        (Heaviside(x * c) + sign(3 - x), -1, oo, [0, 3]),
        (Piecewise((1, Abs(x) < sqrt(1 - c**2)), (2, True)), -1, 1, [-Rational(3, 5), 0, Rational(3, 5)]),
        (Max(0, 1 + 2 * cos(x)), 0, 2 * pi, [2 * pi / 3, 4 * pi / 3]),
        (Max(0, 2 + cos(x)), 0, 2 * pi, []),
        (Heaviside(sin(x) - Rational(1, 3)), 0, pi, None),
        (Heaviside(sin(x) + 2 * cos(x)), 0, 2 * pi, [pi / 2 + atan(Rational(1, 2)), 3 * pi / 2 + atan(Rational(1, 2))]),
        (Heaviside(cos(2 * x + 1)), 0, pi, [pi / 4 - Rational(1, 2), 3 * pi / 4 - Rational(1, 2)]),
        (Heaviside(exp(-(x**2)) - Rational(1, 3)), -oo, oo, [-sqrt(log(3)), sqrt(log(3))]),
        (Max(0, 3 * x + 4 * sqrt(1 - x**2)), -1, 1, [-c, c]),
        (sin(x) * exp(x), 0, 9, []),
    ],
)
def test_switch_points(f, a, b, points):
    found = breakpoints(f, x, a, b)
    if points is None:
        assert [p.evalf(30) for p in found] == [p.evalf(30) for p in breakpoints(sign(3 * sin(x) - 1), x, 0, pi)]
    else:
        assert len(found) == len(points) and all(sign_of(p - q) == 0 for p, q in zip(found, points, strict=True))


def test_a_quintic_switches_at_its_real_roots():
    (root,) = breakpoints(Max(x**5 - x - 1, 0), x, -2, 2)
    assert root**5 - root - 1 == 0 or abs((root**5 - root - 1).evalf(40)) < 1e-38


@pytest.mark.parametrize("f", [Abs(cos(x) - x), floor(x), Heaviside(cos(x**2)), Max(x, symbols("y"))])
def test_unknown_switch_points_are_refused(f):
    with pytest.raises(Undecided):
        breakpoints(f, x, 0, 5)


def test_an_endless_range_holds_too_many_switches():
    with pytest.raises(Undecided):
        breakpoints(Abs(sin(x)), x, 0, oo)


def test_resolve_picks_the_branch_between_switches():
    f = Piecewise((x, Abs(x) < sqrt(1 - c**2)), (Max(x**2, x), True))
    assert resolve(f, x, 0, Rational(3, 5)) == x
    assert resolve(f, x, Rational(3, 5), 1) == x
    assert resolve(f, x, -1, -Rational(3, 5)) == x**2
    assert resolve(Abs(x) * Heaviside(x), x, -oo, 0) == 0


def test_resolve_is_exact_where_a_float_would_err():
    tiny = Rational(1, 10**40)
    assert resolve(Heaviside(x - tiny), x, tiny, 2 * tiny) == 1
    assert resolve(Heaviside(x - tiny), x, 0, tiny) == 0


def test_a_tie_is_settled_exactly():
    assert settle(Piecewise((1, Abs(Rational(3, 5)) < sqrt(1 - c**2)), (2, True))) == 2
    assert settle(Piecewise((1, Abs(Rational(3, 5)) <= sqrt(1 - c**2)), (2, True))) == 1
    assert settle(Heaviside(sqrt(3 + 2 * sqrt(2)) - 1 - sqrt(2))) == Rational(1, 2)
    assert settle(Max(pi, acos(-1) + Rational(1, 10**60), evaluate=False)) == pi + Rational(1, 10**60)


def test_only_the_branch_taken_is_looked_into():
    class Unknown(Function):
        pass

    assert settle(Piecewise((1, sqrt(2) < Rational(3, 2)), (sign(Unknown(1)), True), evaluate=False)) == 1


def test_a_sign_that_cannot_be_established_is_refused():
    with pytest.raises(Undecided):
        sign_of(sqrt(-2) + 1)
    with pytest.raises(Undecided):
        sign_of(x)
