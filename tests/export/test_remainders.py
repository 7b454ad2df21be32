"""Bounds on what tables of powers miss, against functions whose errors are known."""

from itertools import pairwise

import numpy as np
import pytest
from flint import acb, arb

from xsec_sym.export.remainders import (
    ELLIPSES,
    Majorant,
    Plan,
    Span,
    boxes,
    decades,
    greatest,
    half_turn,
    missed,
    missed_on_line,
    planned,
)
from xsec_sym.proof.ball_compile import precision

UNIT = Span(-1.0, 1.0, (-1.0, 1.0))
GOAL = arb("1e-22")


def exponential(arcs):
    return (greatest([z.real.exp() for z in arcs]),)


PRODUCT = Majorant(exponential, exponential, lambda x, y: x[0] * y[0])
TAYLOR = [1.0, 1.0, 0.5, 1 / 6, 1 / 24]


@pytest.fixture(autouse=True)
def digits():
    with precision(128):
        yield


def largest(found):
    return float(greatest([value for row in found for value in row]))


def test_a_series_on_a_line_misses_its_tail():
    """Of exp, least at -1, most at 1: e - 65/24."""
    found = missed_on_line(UNIT, lambda arcs: exponential(arcs)[0], lambda x: x.exp(), TAYLOR, GOAL)
    assert largest(found.on(256, 1)) == pytest.approx(np.e - 65 / 24, rel=1e-3)
    assert largest(found.on(256, 1)) >= np.e - 65 / 24


def test_a_table_of_two_variables_is_bounded_from_above_and_closely():
    table = [[a * b for a in TAYLOR] for b in TAYLOR]
    plan = planned(UNIT, UNIT, PRODUCT, [table], GOAL)
    (found,) = missed(UNIT, UNIT, plan, lambda x, y: (x + y).exp(), [table])
    exact = np.e**2 - (65 / 24) ** 2
    assert exact <= largest(found.on(128, 128)) <= 1.01 * exact


def test_the_remainder_covers_what_too_few_nodes_miss():
    """With 2 nodes each the interpolant alone is far below the error."""
    few = {}
    table = [[0.0]]
    for rho in (arb(2), arb(4)):
        size = exponential(UNIT.arcs(rho))[0] ** 2
        few[rho] = 8 * size * 2 * rho**-2 / (1 - 1 / rho) ** 2
        (found,) = missed(UNIT, UNIT, Plan((2, 2), few[rho]), lambda x, y: (x + y).exp(), [table])
        alone = largest(found._replace(remainder=arb(0)).on(64, 64))
        assert alone < np.e**2 < alone + float(few[rho])


def test_the_logarithm_reaches_down_to_where_a_function_is_singular():
    """sqrt(x), whose error as a table is that of x."""
    x = Span(1e-6, 1e-3, (0.0, 1.0), True)

    def size(arcs):
        return greatest([abs(z).sqrt() for z in arcs]) if all(z.real > 0 for z in arcs) else None

    found = missed_on_line(x, size, lambda z: z.sqrt(), [0.5, 0.5], arb("1e-12"))
    # the table's variable is 2 x - 1, so that this is x
    assert largest(found.on(256, 1)) == pytest.approx(1e-3**0.5 - 1e-3, rel=1e-3)
    with pytest.raises(ArithmeticError, match="no ellipse"):
        missed_on_line(Span(0.0, 1.0, (0.0, 1.0)), size, lambda z: z.sqrt(), [0.5, 0.5], GOAL)


def test_a_function_without_a_bound_is_refused():
    nowhere = PRODUCT._replace(size=lambda x, y: None)
    with pytest.raises(ArithmeticError, match="no ellipses about -1"):
        planned(UNIT, UNIT, nowhere, [[[1.0]]], GOAL)


def test_arcs_cover_the_boundary_of_an_ellipse_and_boxes_their_interval():
    span = Span(0.5, 2.0, (0.5, 2.0), True)
    rho = ELLIPSES[5]
    for turn in np.linspace(0, 1, 77):
        at = arb(turn)
        point = span.place(acb((rho + 1 / rho) / 2 * at.cos_pi(), (rho - 1 / rho) / 2 * at.sin_pi()))
        assert any(arc.overlaps(point) for arc in span.arcs(rho))
    for x in np.linspace(-1, 1, 50):
        assert sum(box.contains(arb(x)) for box in boxes(9)) >= 1
        assert sum(box.contains(arb(abs(x))) for box in half_turn(9)) >= 1


def test_decades_share_their_ends():
    cut = decades(1e-8, 1 / 12)
    assert (cut[0][0], cut[-1][1]) == (1e-8, 1 / 12)
    assert all(one[1] == next_one[0] for one, next_one in pairwise(cut))
    assert all(high < 20.001 * low for low, high in cut)
    assert decades(0.5, 1.0) == [(0.5, 1.0)]
