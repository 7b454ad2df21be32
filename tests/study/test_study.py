"""The measuring itself: on a quantity whose methods have known errors, what is reported is what was put in."""

import time

import numpy as np
import pytest
from mpmath import mpf

from tests.study import toys
from xsec_sym.study import chart, errors, files, measure, points, stability, times
from xsec_sym.study.method import HOMES, Argument, Field, UnknownQuantity, registered

RNG = np.random.default_rng


@pytest.fixture(scope="module")
def data():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(measure, "registered", lambda name: toys.FIELD)
        patch.setattr(times, "BUDGET", 0.0)
        patch.setattr(times, "SIZES", (10, 100))
        return files.plain(measure.measure("toy", seed=3))


def rows(data, method, **parameters):
    return [r for r in data["points"] if r["method"] == method and parameters.items() <= r["parameters"].items()]


# --- points -----------------------------------------------------------------------------------------------


def test_the_bulk_fills_every_cell():
    x, a = points.bulk(toys.QUANTITY, RNG(0))
    counts, *_ = np.histogram2d(x, a, bins=(toys.X.edges, toys.A.edges))
    assert (counts == 10).all()


def test_right_values_are_pairs_of_doubles():
    found = points.right(toys.QUANTITY, "", (np.array([0.1, 0.7]), np.array([3.0, 7.0])))
    for x, a, high, low in zip(*found.columns, found.high, found.low, strict=True):
        assert mpf(high) + mpf(low) == pytest.approx(mpf(a) * mpf(x) ** 2, rel=1e-30)
        assert 0 < abs(low) <= np.spacing(high) / 2


def test_single_precision_is_tried_at_single_numbers():
    found = points.right(toys.QUANTITY, "", (np.array([0.1]), np.array([3.0])), "float32")
    assert found.columns[0][0] == float(np.float32(0.1)) != 0.1
    assert found.high[0] == pytest.approx(3 * float(np.float32(0.1)) ** 2, rel=1e-15)


def test_the_condition_number_of_a_power():
    x = np.array([0.2, 0.4, 0.9])
    assert points.condition(toys.QUANTITY, (x, np.full(3, 20.0))) == pytest.approx(2 + 1, rel=1e-6)


def test_points_of_a_range_stay_in_it_and_have_its_ends():
    x, a = points.within(toys.QUANTITY, {"x": (0.2, 0.3)}, RNG(1), 500)
    assert x.min() == 0.2 and x.max() == 0.3
    assert a.min() == 1 and a.max() == 100


@pytest.mark.parametrize(("ends", "cells"), [((0.0, 0.25), [0]), ((0.3, 0.3), [1]), ((0.2, 0.6), [0, 1, 2])])
def test_the_cells_of_a_range(ends, cells):
    assert list(toys.X.cells(*ends)) == cells


def test_integers_are_drawn_as_integers():
    drawn = Argument("p", (0, 4, 9), integer=True).draw(RNG(0), 300)
    assert set(drawn) == set(range(10))


# --- errors -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("size", [1e-3, 1e-6])
def test_an_error_put_in_is_the_error_found(data, size):
    (row, *_) = rows(data, "off", size=size)
    assert row["max_rel"] == pytest.approx(size, rel=0.02)
    assert row["max_rel"] >= size and row["p99_rel"] == pytest.approx(size, rel=0.02)
    assert 30 * size < row["max_abs"] <= 101 * size
    assert set(row["by_label"]) == {"bulk", "near one half"}
    assert row["by_label"]["near one half"]["points"] == measure.TROUBLE


def test_what_rounds_is_told_in_units_of_the_last_place(data):
    for row in rows(data, "exact"):
        assert 0 < row["max_ulp"] < 3
        assert row["max_rel"] < 3 * np.finfo(row["dtype"]).eps


def test_failures_are_counted_and_kept_to_their_cell(data):
    (row, *_) = rows(data, "broken")
    assert row["failures"] >= 10
    cells = np.array([float(e) for e in row["cells"]["max_rel"]]).reshape(3, 2)
    assert np.argwhere(np.isinf(cells)).tolist() == [[1, 1]]


def test_what_cannot_be_prepared_is_a_failure(data):
    (row, *_) = rows(data, "folded")
    assert 0 < row["failures"] < row["points"]
    assert row["fixed"] == {"a": 2.0}


def test_a_number_at_a_time(data):
    (row, *_) = rows(data, "scalar")
    assert row["by_label"]["bulk"]["points"] == 20
    assert row["failures"] > 0


def test_a_wrong_value_of_nothing_is_an_absolute_error_only():
    tried = points.Points("", (np.array([0.0]), np.array([1.0])), np.array([0.0]), np.array([0.0]))
    found = errors.summary(np.array([1e-3]), tried, "float64")
    assert (found.max_rel, found.max_abs, found.failures) == (0.0, 1e-3, 0)


@pytest.mark.parametrize(("value", "said"), [(1.2341e-5, 1.24e-5), (0.0, 0.0), (float("inf"), "inf"), (2e-3, 2e-3)])
def test_errors_are_rounded_up(value, said):
    assert errors._short(value) == said


# --- times ------------------------------------------------------------------------------------------------


def test_a_known_time():
    lap = times.timed(lambda: time.sleep(0.004), 1000, budget=0.03)
    assert 4000 <= lap.q1 <= lap.median <= lap.q3
    assert lap.median < 40000


def test_set_up_is_timed_apart(monkeypatch):
    def slowly(a):
        time.sleep(0.05)
        return lambda x: a * x * x

    monkeypatch.setattr(times, "BUDGET", 0.0)
    method = toys.METHODS[3].__class__("slow", "", slowly, folds=True)
    (lap,) = times.times(toys.QUANTITY, method, {}, (2.0,), sizes=(100,))
    assert lap.setup >= 0.05 > lap.median * 1e-9 * 100


def test_the_yardsticks():
    found = times.yardsticks(1000)
    assert found["copy"] < found["scipy.special.i0e"]


# --- the whole ----------------------------------------------------------------------------------------------


def test_what_is_not_installed_is_named(data):
    assert data["missing"] == ["absent"]
    assert not rows(data, "absent")


def test_the_front_holds_what_nothing_beats():
    told = [
        {"method": name, "fixed": {}, "dtype": "float64", "n": 10, "max_rel": error, "ns_median": ns}
        for name, error, ns in (("a", 1e-3, 1.0), ("b", 1e-6, 5.0), ("c", 1e-4, 6.0), ("d", "inf", 0.5))
    ]
    measure.mark_pareto(told)
    assert [row["pareto"] for row in told] == [True, True, False, True]


def test_nothing_is_dropped_from_a_chart(data):
    drawn = chart.spots(data) + chart.spots(data, constant=True)
    assert {s.method for s in drawn} == {m.name for m in toys.METHODS} - {"absent"}
    assert {s.method for s in drawn if s.lost} == {"broken", "folded", "scalar"}
    assert all(s.shown <= chart.CEILING for s in drawn)


@pytest.mark.parametrize("name", ["phase_lambert_sphere", "brdf_lambert_sphere"])
def test_foot_and_legend_have_room(name):
    """One column, and the longest names: nothing is cut off or lies over a frame."""
    made = chart.figure(files.stored(name))
    paper, (legend,) = made.bbox, made.legends
    (foot,) = (text for text in made.texts if "one thread" in text.get_text())
    boxes = [thing.get_window_extent() for thing in (foot, legend)]
    assert all(paper.x0 <= b.x0 and b.x1 <= paper.x1 and paper.y0 <= b.y0 and b.y1 <= paper.y1 for b in boxes)
    # another viewer's letters may be wider
    assert boxes[0].x1 < 0.92 * paper.x1
    frames = [frame.get_tightbbox() for frame in made.axes]
    assert not [f for f in frames for b in boxes if f.overlaps(b)]


@pytest.mark.parametrize("picture", [chart, stability])
def test_the_same_data_give_the_same_picture(data, tmp_path, picture):
    for name in ("a.svg", "b.svg"):
        picture.draw(data, tmp_path / name)
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
    text = (tmp_path / "a.svg").read_text()
    assert all(m.name in text for m in toys.METHODS[:5])


def test_every_column_of_maps_has_a_labelled_axis(data):
    """The last row may have fewer maps than the others."""
    made = stability.figure(data)
    maps = [frame for frame in made.axes if frame.get_visible() and frame.get_title()]
    assert len(maps) % stability.COLUMNS and len(maps) > stability.COLUMNS
    lowest = {}
    for frame in maps:
        lowest[round(frame.get_position().x0, 3)] = frame  # row by row: the last one wins
    assert len(lowest) == stability.COLUMNS
    for frame in lowest.values():
        assert frame.get_xlabel() and any(t.get_visible() and t.get_text() for t in frame.get_xticklabels())


def test_a_map_shows_where_a_method_fails(data):
    found = stability.maps(data)
    assert next(iter(found)) == "exact"
    assert np.isinf(found["broken"]).sum() == 1 and np.isinf(found["broken"][1, 1])
    assert found["exact"].max() < 1
    assert found["off size = 1e-06"].min() > 9


def test_a_table_has_every_method(data):
    lines = chart.table(data)
    assert sum("off size = 0.001" in line for line in lines) == 2
    assert "broken" in "\n".join(lines)


def test_methods_of_one_name_are_refused():
    with pytest.raises(ValueError, match="two methods"):
        Field(toys.QUANTITY, toys.METHODS[:1] * 2)


def test_an_unknown_quantity_is_told_with_the_nearest():
    with pytest.raises(UnknownQuantity, match="did you mean sigma_spherical_gaussian"):
        registered("sigma_sperical_gaussian")


@pytest.mark.parametrize("name", HOMES)
def test_what_is_stored_is_what_is_registered(name):
    data, field = files.stored(name), registered(name)
    assert data["quantity"] == name == field.quantity.name
    assert {r["method"] for r in data["points"]} | set(data["missing"]) == {m.name for m in field.methods}
    assert [a["edges"] for a in data["arguments"]] == [list(a.edges) for a in field.quantity.arguments]
    assert len({r["method"] for r in data["points"]}) >= 4
    for row in data["points"]:
        assert row["ns_q1"] <= row["ns_median"] <= row["ns_q3"]
