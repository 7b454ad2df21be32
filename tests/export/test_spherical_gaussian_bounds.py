"""The proved bounds on the errors of the spherical Gaussian's tables."""

import numpy as np
import pytest
from flint import acb, arb
from mpmath import besseli, cosh, coth, erfc, exp, mp, mpc, mpf, pi, quad, sinh, sqrt

from tests.kernels import gaussian
from xsec_sym.export import spherical_gaussian as generator
from xsec_sym.export import spherical_gaussian_bounds as bounds
from xsec_sym.export import spherical_gaussian_functions as functions
from xsec_sym.export.remainders import ELLIPSES, Span
from xsec_sym.kernels import _spherical_gaussian_tables as tables
from xsec_sym.proof.ball_compile import precision

REGIONS = functions.REGIONS
# Cells that are proved within half a second each, and narrow parts of others, next to where a table is singular.
PART = [("ROUND", 0), ("RIM", 0), ("EDGE", 2)]
NARROW = [("LAYER", 1, 0.01, 1e-9), ("EDGE", 0, 1e-9, 0.05)]


def made(name, i):
    return {prefix: getattr(tables, prefix + name)[i] for prefix in generator.ALLOWED}


def stored(name, i):
    return {prefix: tables.BOUND[prefix + name][i] for prefix in generator.ALLOWED}


@pytest.mark.parametrize(("name", "i"), PART)
def test_bounds_are_proved_again(name, i):
    assert bounds.cell_bounds(name, REGIONS[name].cells()[i], made(name, i)) == pytest.approx(stored(name, i), rel=0.01)


@pytest.mark.parametrize(("name", "i", "width", "height"), NARROW)
def test_a_narrow_part_next_to_where_a_table_is_singular_is_proved_again(name, i, width, height):
    x, y = bounds.spans(name, REGIONS[name].cells()[i])[0]
    assert bounds.START[name] in (x.low, y.low)
    x, y = x._replace(high=x.low + width), y._replace(high=y.low + height)
    for prefix, bound in bounds.proved(name, x, y, made(name, i)).items():
        assert bound <= stored(name, i)[prefix]


def test_lines_are_proved_again():
    for bare in ("HALF_LAYER", "MEAN_COSINE"):
        for name in (bare, f"FAST_{bare}"):
            assert tables.BOUND[name] == [pytest.approx(bounds.line_bound(bare, getattr(tables, name)[0]), rel=0.01)]


def test_every_table_has_a_bound_within_what_is_allowed():
    assert tables.START == bounds.START
    for prefix, allowed in generator.ALLOWED.items():
        for name, region in REGIONS.items():
            assert len(tables.BOUND[prefix + name]) == len(region.cells())
            assert all(0 < bound <= allowed for bound in tables.BOUND[prefix + name])
        for name in ("HALF_LAYER", "MEAN_COSINE"):
            assert len(tables.BOUND[prefix + name]) == 1
            assert 0 < tables.BOUND[prefix + name][0] <= allowed
    assert len(tables.BOUND) == 2 * (len(REGIONS) + 2)


def test_start_leaves_no_roughness_out_from_1e_4_to_1e4():
    square = 1e-4**2
    kappa, sine = 2 / square, REGIONS["EDGE"].y[-1] ** 0.5
    assert bounds.START["LAYER"] <= square
    assert bounds.START["EDGE"] <= 1 / (kappa * sine)
    w = kappa * (1 - (1 / REGIONS["LAYER"].x[-1] - functions.SHIFT))
    assert bounds.START["HALF_LAYER"] <= functions.HALF / (functions.HALF + w**0.5)


def test_a_coefficient_changed_by_a_part_in_1e13_is_refused():
    cell, altered = REGIONS["EVEN"].cells()[0], made("EVEN", 0)
    assert bounds.cell_bounds("EVEN", cell, altered) == pytest.approx(stored("EVEN", 0), rel=0.01)
    altered[""] = [list(row) for row in altered[""]]
    altered[""][0][0] *= 1 + 1e-13
    with pytest.raises(ArithmeticError, match=r"^EVEN is not proved"):
        generator.kept("EVEN", cell, bounds.cell_bounds("EVEN", cell, altered))


def test_a_table_that_is_nowhere_near_has_no_bound():
    x, y = bounds.spans("EVEN", REGIONS["EVEN"].cells()[0])[0]
    assert bounds.proved("EVEN", x, y, {"": [[-1.0]]})[""] == arb("inf")
    assert bounds.rounded_up(arb("inf")) == float("inf")


@pytest.mark.parametrize(("name", "i"), [("RIM", 0), ("RIM", 1), ("EDGE", 2)])
def test_errors_count_relative_to_sigma_itself_at_the_rim(name, i):
    """Of which q has more, by what lies beyond t = 1: 0.3 % at kappa = 8 and u = -1."""
    x, y = bounds.spans(name, REGIONS[name].cells()[i])[0]
    with precision(functions.BITS), mp.workdps(30):
        scales = bounds._scales(name, made(name, i)[""], x, y)
        for row, column in ((0, 0), (127, 0), (64, 0), (0, 64), (127, 127)):
            here, there = x.place(bounds.boxes(128)[row]).mid(), y.place(bounds.boxes(128)[column]).mid()
            ks, kappa = (here, 2 / there.sqrt()) if name == "RIM" else (1 / here, 1 / (here * there.sqrt()))
            s, factor = ks / kappa, 1 if name == "RIM" else ks.sqrt()
            whole = functions.enclosed((1 - s * s).sqrt(), s, kappa) * (1 - (-2 * kappa).exp()) * kappa * factor
            assert scales[row][column].lower() <= whole * arb("1.000000000000001")


def test_the_generator_leaves_out_less_where_the_bound_is_exceeded(monkeypatch):
    cell = REGIONS["EVEN"].cells()[0]
    with precision(generator.BITS), mp.workdps(generator.DIGITS):
        values = generator.sampled(REGIONS["EVEN"], cell)
    monkeypatch.setattr(generator, "sampled", lambda region, cell: values)
    monkeypatch.setitem(generator.LEFT_OUT, "", mpf("8e-16"))
    found, off = generator.settled("EVEN", cell)
    assert off[""] <= generator.ALLOWED[""]
    assert found[""] != generator.tables(REGIONS["EVEN"], cell)[""]
    monkeypatch.setattr(bounds, "cell_bounds", lambda *_: {"": 4.01e-16, "FAST_": 1e-8})
    with pytest.raises(ArithmeticError, match=r"^EVEN is not proved to be better than 4\.01e-16"):
        generator.settled("EVEN", cell)


# --- what the proofs rest on -------------------------------------------------------------------------------


@pytest.mark.parametrize(("points", "beyond"), [(64, 84), (5, 84), (64, 6)])
def test_the_ball_holds_the_integral_however_poor_the_rule(monkeypatch, points, beyond):
    monkeypatch.setattr(functions, "PROVED_POINTS", points)
    monkeypatch.setattr(functions, "BEYOND", beyond)
    u, alpha = gaussian.points(np.random.default_rng(8), 3)
    with precision(functions.BITS), mp.workdps(40):
        for v, rough in zip(np.abs(u), alpha, strict=True):
            at = arb(float(v))
            ball = functions.enclosed(at, ((1 - at) * (1 + at)).sqrt(), 2 / arb(float(rough)) ** 2)
            exact = gaussian.scaled_sigma(-v, rough)
            assert ball.overlaps(arb(mp.nstr(exact, 36)) * arb(1, "1e-30")), (v, rough)
            if (points, beyond) == (64, 84):
                assert ball.rad() < ball.mid() * arb("1e-24")


def even(square, kappa_square):
    u, kappa, s = sqrt(square), sqrt(kappa_square), sqrt(1 - square)
    whole = quad(lambda t: t * cosh(kappa * u * t) * besseli(0, kappa * s * sqrt(1 - t * t)), [0, 1])
    return kappa / (2 * sinh(kappa)) * whole


def round_(v, kappa):
    s = sqrt(1 - v * v)
    return exp(kappa * (v - 1)) * quad(
        lambda t: t * exp(-kappa * v * t) * besseli(0, kappa * s * sqrt(1 - t * t)), [0, 1]
    )


def layer(shifted, square):
    s, kappa = 1 / shifted - mpf(functions.SHIFT), 2 / square
    v = sqrt(1 - s * s)
    z = v * sqrt(kappa / (1 + s))
    whole = quad(lambda t: t * exp(-kappa * (v * t + s)) * besseli(0, kappa * s * sqrt(1 - t * t)), [0, 0.2, 1])
    flat = (coth(kappa) - 1 / kappa) / 2 * sqrt(1 + s) * (1 / sqrt(pi) - z * exp(z * z) * erfc(z))
    return kappa * (sqrt(kappa) ** 3 * whole / (1 - exp(-2 * kappa)) - flat)


def half_line(ks, square):
    v = sqrt(1 - square)
    ends = [0, 2, 10, 40 / (v.real - abs(sqrt(square).imag))]
    return quad(lambda t: t * exp(-v * t - ks) * besseli(0, sqrt(ks * ks - square * t * t)), ends)


def rim(ks, fourth):
    return half_line(ks, ks * ks * fourth / 4)


def edge(inverse, square):
    return half_line(1 / inverse, square) / sqrt(inverse)


def number(z):
    return mpc(*(generator.number(arb(part.mid())) for part in (z.real, z.imag)))


@pytest.mark.parametrize("function", [even, round_, layer, rim, edge])
def test_majorants_exceed_the_functions_on_their_ellipses(function):
    """Of complex variables, by the definitions; and these are the functions at real ones."""
    name = function.__name__.rstrip("_").upper()
    rng, region, majorant = np.random.default_rng(2), REGIONS[name], bounds.MAJORANTS[name]
    x, y = bounds.spans(name, region.cells()[-1])[-1]
    with precision(100), mp.workdps(15):
        here, there = x.place(arb(0.25)), y.place(arb(-0.5))
        value = generator.number(region.value(here, there)[0])
        assert abs(function(number(acb(here)), number(acb(there))) / value - 1) < 1e-11
        for rho in (ELLIPSES[0], ELLIPSES[2]):
            size = majorant.size(majorant.x(x.arcs(rho)), majorant.y(y.arcs(rho)))
            for _ in range(3):
                at = [arb(turn) for turn in rng.uniform(-1, 1, 2)]
                units = [acb((rho + 1 / rho) / 2 * turn.cos_pi(), (rho - 1 / rho) / 2 * turn.sin_pi()) for turn in at]
                assert abs(function(number(x.place(units[0])), number(y.place(units[1])))) <= float(size)


def test_the_lines_majorants_exceed_their_functions():
    line = Span(1e-4, 1.0, (0.0, 1.0), True)
    with precision(100):
        for t in (line.place(acb(0.3, 0.2)), line.place(acb(1.1, 0.15)), line.place(acb(1.3, -0.01))):
            z = functions.HALF / t - functions.HALF
            exact = 1 / arb.pi().sqrt() - z * (z * z).exp() * z.erfc()
            assert abs(exact) <= bounds._half_layer(z)
        square = acb(-2, 3)
        kappa = square.sqrt()
        assert abs((kappa.coth() - 1 / kappa) / kappa) <= bounds._pale_size([square])
