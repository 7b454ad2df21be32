"""A method that names an entry of the record computes what the entry says: its form, evaluated in many digits."""

import numpy as np
import pytest
import sympy as sp

from tests.study import rivals
from tests.study.test_methods_agree import REGIONS
from xsec_sym import ledger
from xsec_sym.study.method import registered

# The record's names for the arguments; and what its form is multiplied with.
NAMES = {
    "deon2016:8.piecewise": ("u", "u_n"),
    "deon2016:17": ("u_i", "p"),
    "deon2016:T1.even.s": ("u", "p"),
    "deon2016:22": ("u_i", "alpha"),
    "deon2016:25": ("u_i", "alpha"),
    "deon2016:27.regular": ("u_i", "b"),
    "xsec:smith.beckmann.lambda": ("u", "alpha"),
    "xsec:smith.ggx.lambda": ("u", "alpha"),
    "xsec:smith.ggx.above": ("u", "alpha"),
    "xsec:ggx-forms.tokuyoshi_harada": ("m", "alpha"),
    "tokuyoshi_harada:ssl": ("theta", "alpha"),
    "tokuyoshi_harada:K.E": ("x", "y", "z", "alpha_x", "alpha_y"),
    "tokuyoshi_harada:K.U": ("v_x", "v_y", "v_z", "alpha_x", "alpha_y"),
}
MODELS = {"GGX", "Beckmann", "geometric mean", "spherical Gaussian"}
# `sel` stands for the lobe of another quantity there, and the series of powers is built of the record's rows.
OTHERS = {("ssl", "sel"), ("sigma_ellipsoidal", "powers of b")}


def recorded():
    for name in REGIONS:
        for method in registered(name).methods:
            apart = method.name in MODELS or (name, method.name) in OTHERS
            if method.source in NAMES and method.available and not apart:
                yield pytest.param(name, method, id=f"{name}-{method.name}")


def value(source, numbers):
    """The entry's form at these numbers, to 30 digits."""
    form = ledger[source].form
    given = dict(zip(NAMES[source], numbers, strict=True))
    if source == "tokuyoshi_harada:ssl":
        given["theta"] = sp.acos(sp.Float(numbers[0], 40))
    if source.startswith("deon2016:T1.even"):
        given["p"] = int(numbers[1])
    exact = {s: v if isinstance(v := given[s.name], (int, sp.Basic)) else sp.Float(v, 40) for s in form.free_symbols}
    return float(sp.N(form.subs(exact).doit(), 30))


@pytest.mark.parametrize(("name", "method"), list(recorded()))
def test_method_is_the_recorded_form(name, method):
    columns = tuple(np.abs(c[:3]) if name != "sel" else c[:3] for c in REGIONS[name])
    if name == "sigma_power":
        columns = columns[0], np.array([0.0, 4.0, 10.0])
    field = registered(name)
    running, fixed = field.quantity.given(columns)
    found, _ = rivals.tried(name, method.name, columns, **rivals.last(method))
    for got, *numbers in zip(found, *running, *fixed, strict=True):
        assert got == pytest.approx(value(method.source, list(map(float, numbers))), rel=1e-13)


def test_every_named_entry_is_in_the_record():
    for name in REGIONS:
        for method in registered(name).methods:
            source, paper = method.source, method.source.partition(":")[0]
            if paper in ("deon2016", "dupuy2016", "tokuyoshi_harada", "xsec"):
                assert ledger[source.split(" ")[0]].id, (name, method.name)
