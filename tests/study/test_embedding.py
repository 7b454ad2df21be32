"""Running arguments that fill no box: directions, drawn as angles."""

import numpy as np

from tests.study import rivals
from xsec_sym.study import times as clock
from xsec_sym.study.errors import by_cell, values
from xsec_sym.study.method import Argument, Method, Quantity, registered
from xsec_sym.study.points import bulk, condition, right


def plane(angle):
    return np.cos(angle), np.sin(angle)


PLANE = Quantity(
    "plane",
    "a point of a circle, stretched",
    running=(Argument("angle", (0.0, 1.0, 2.0)),),
    set=(Argument("scale", (1.0, 2.0, 4.0, 8.0)),),
    reference=lambda x, y, scale: (x + y) * scale,
    typical=((2.0,),),
    embed=plane,
)
SUM = Method("sum", "", lambda: lambda x, y, scale: (x + y) * scale)
FOLDED = Method("folded", "", lambda scale: lambda x, y: (x + y) * scale, folds=True)
BOX = Method("box", "", lambda: lambda x, y, scale: np.arctan2(y, x))


def points():
    columns = bulk(PLANE, np.random.default_rng(1))
    return columns, right(PLANE, "bulk", columns)


def test_points_are_kept_as_drawn_and_methods_get_what_they_stand_for():
    columns, tried = points()
    assert len(tried.columns) == 2 and np.array_equal(tried.columns[0], columns[0])
    assert np.allclose(values(PLANE, BOX, {}, tried.columns, "float64"), columns[0], rtol=0, atol=1e-15)
    for method in (SUM, FOLDED):
        found = values(PLANE, method, {}, tried.columns, "float64")
        assert np.allclose(found, tried.high, rtol=1e-14, atol=1e-15)
        told = by_cell(PLANE, found, tried, "float64")
        assert len(told["max_rel"]) == 6 and None not in told["max_rel"]


def test_singles_are_rounded_after_the_embedding():
    columns, _ = points()
    tried = right(PLANE, "bulk", columns, "float32")
    (x, y), (scale,) = PLANE.given(tried.columns, "float32")
    assert {a.dtype for a in (x, y, scale)} == {np.dtype("float32")}
    exact = (x.astype(float) + y.astype(float)) * scale.astype(float)
    assert np.allclose(tried.high, exact, rtol=1e-15, atol=0)


def test_condition_is_of_what_was_drawn():
    """d log((cos t + sin t) s): |t (cos t - sin t)/(cos t + sin t)| + 1."""
    columns, _ = points()
    t = columns[0]
    exact = np.abs(t * (np.cos(t) - np.sin(t)) / (np.cos(t) + np.sin(t))) + 1
    assert np.allclose(condition(PLANE, columns), exact, rtol=1e-5)


def test_times_with_set_arguments_as_arrays_and_constant():
    for method, fixed in [(SUM, ()), (SUM, (2.0,)), (FOLDED, (2.0,))]:
        found = clock.times(PLANE, method, {}, fixed, sizes=(1000,))
        assert [one.n for one in found] == [1000] and found[0].median > 0


def test_without_an_embedding_nothing_changes():
    quantity = registered("sigma_ggx").quantity
    columns = rivals.box(1, 5, (-1.0, 1.0), (0.1, 1.0))
    running, fixed = quantity.given(columns)
    assert np.array_equal(running[0], columns[0]) and np.array_equal(fixed[0], columns[1])


def test_directions_of_the_lobe_are_unit_vectors():
    quantity = registered("sel").quantity
    columns = bulk(quantity, np.random.default_rng(2))
    for dtype, eps in (("float64", 4e-16), ("float32", 2e-7)):
        (x, y, z), alphas = quantity.given(columns, dtype)
        assert len(alphas) == 2
        assert np.abs(np.sqrt(x.astype(float) ** 2 + y.astype(float) ** 2 + z.astype(float) ** 2) - 1).max() < eps
    assert [a.name for a in quantity.set] == ["alpha_x", "alpha_y"]
