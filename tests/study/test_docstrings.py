"""The errors that docstrings of kernels state: what the stored measurements found, and what fresh points find."""

import re

import numpy as np
import pytest

from xsec_sym import kernels
from xsec_sym.study import files
from xsec_sym.study.errors import deviations, values
from xsec_sym.study.method import HOMES, registered
from xsec_sym.study.points import right, within

FOUND = re.compile(r"[Ll]argest error found: ([\d.]+) ulp in float64, ([\d.]+) ulp in float32")
STATED = {
    name: dict(zip(("float64", "float32"), map(float, said.groups()), strict=True))
    for name in HOMES
    if hasattr(kernels, name) and (said := FOUND.search(" ".join(getattr(kernels, name).__doc__.split())))
}


def the_kernel(methods):
    (found,) = [m for m in methods if m.name == "kernel"]
    return found


def test_there_are_such_docstrings():
    assert len(STATED) >= 9


@pytest.mark.parametrize("name", STATED)
def test_measurements_stay_below_what_is_stated(name):
    rows = [row for row in files.stored(name)["points"] if row["method"] == "kernel" and not row["parameters"]]
    assert {row["dtype"] for row in rows} == {"float64", "float32"}
    assert {row["dtype"]: row["max_ulp"] for row in rows if row["max_ulp"] > STATED[name][row["dtype"]] + 0.05} == {}


@pytest.mark.parametrize("name", STATED)
def test_fresh_points_stay_below_what_is_stated(name):
    field = registered(name)
    for dtype, most in STATED[name].items():
        drawn = within(field.quantity, {}, np.random.default_rng([2311, len(dtype)]), 1000)
        points = right(field.quantity, "fresh", drawn, dtype)
        found = values(field.quantity, the_kernel(field.methods), {}, points.columns, dtype)
        ulps = deviations(found, points, dtype)[2]
        assert np.isfinite(ulps).sum() > 20 and np.nanmax(ulps) <= most + 0.05
