"""Write the tables behind `sigma_spherical_gaussian`: `python -m xsec_sym.export.spherical_gaussian`.

With kappa = 2/alpha^2, v = |u|, s = sqrt(1 - v^2) and w = kappa (1 - s), all comes from the side turned away,

    sigma(-v) = kappa/(2 sinh kappa) int_0^1 t exp(-kappa v t) I0(kappa s sqrt(1 - t^2)) dt        (`xsec:sg-positive`)

which is positive throughout, as is the odd part sigma(v) - sigma(-v) = c v, c = coth kappa - 1/kappa. Its shape changes
from a few spherical harmonics at small kappa to a boundary layer at large kappa, which ends at v = 1 where kappa s is
of the order of 1. Five regions of the plane, each with a smooth function instead of sigma, polynomial cell by cell:

- EVEN, kappa < 1.5: (sigma(u) + sigma(-u))/2, an even function of u and of kappa, hence one of u^2 and kappa^2;
- ROUND, 1.5 < kappa < 8: exp(kappa v) sigma(-v) (1 - exp(-2 kappa))/kappa, entire in v and kappa;
- LAYER, kappa > 8, v < 0.9: C in sigma(-v) = exp(-w)/sqrt(kappa) [c/2 sqrt(1 + s) h(sqrt w) + C/kappa], where h(z) =
  1/sqrt(pi) - z erfcx(z) is the boundary layer of a flat surface (`xsec:sg-rim.layer`): C depends on s
  and alpha^2 and knows no layer;
- RIM and EDGE, kappa > 8, v > 0.9: q = kappa^2 exp(-kappa s) int_0^inf t exp(-kappa v t) I0(kappa s sqrt(1 - t^2)) dt,
  whose surplus over the integral up to t = 1 is the elementary v exp(-kappa) (1 + 1/kappa)/kappa (`xsec:sg-rim`): for
  kappa s < 4 as a function of kappa s and alpha^4, beyond of 1/(kappa s) and s^2, times sqrt(kappa s).

A table is an interpolant at Chebyshev nodes whose smallest terms are left out as long as they add up to less than
LEFT_OUT of sigma(-v), anywhere in the cell; `error` compares it, rounded as it is, with the integral at other points.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

from flint import arb, ctx
from mpmath import mp, mpf

import xsec_sym
from xsec_sym.export.polynomials import chebyshev_nodes, coefficients, packed, polynomial, powers, shortened
from xsec_sym.proof.ball_compile import precision
from xsec_sym.record.files import writing

ROOT = Path(xsec_sym.__file__).parent
BITS = 160
DIGITS = 36
# Points of the rule, and where its integrand is left out as exp(-NEGLIGIBLE): 1e-26 together, 1e-31 at 120 and 80.
POINTS, NEGLIGIBLE = 96, 66
# What the terms left out may add up to, relative to sigma(-v), and the error that is allowed in the end.
LEFT_OUT = {"": mpf("1.2e-16"), "FAST_": mpf("5e-8")}
ALLOWED = {"": mpf("4e-16"), "FAST_": mpf("1e-7")}
# The cells' edges, in the variables of their tables; doubles in the kernel too.
LIT = 0.9
SHIFT = 0.2
LAYER_EDGES = [1.0 / (1.0 + SHIFT), 1.0 / (0.7 + SHIFT), 1.0 / (0.435 + SHIFT)]
HALF = 3.0

Cell = tuple[float, float, float, float]


class Region(NamedTuple):
    """The edges of its cells in two variables, the numbers of nodes, and the function, with the scale of its errors."""

    x: Sequence[float]
    y: Sequence[float]
    nodes: tuple[int, int]
    value: Callable[[arb, arb], tuple[arb, arb]]

    def cells(self) -> list[Cell]:
        """By y first: the number of a cell is that of its interval of x plus len(x) - 1 times that of y."""
        return [(*across, *along) for along in pairwise(self.y) for across in pairwise(self.x)]


@cache
def rule(points: int) -> list[tuple[arb, arb]]:
    """Gauss-Legendre's nodes and weights on [0, 1]."""
    nodes = (arb.legendre_p_root(points, k, weight=True) for k in range(points))
    return [((1 + x) / 2, weight / 2) for x, weight in nodes]


def scaled(v: arb, s: arb, kappa: arb) -> arb:
    """exp(w) sigma(-v): t = sin(phi), and the exponents of I0 and of w combined."""
    ks, kv = kappa * s, kappa * v
    reach = 2 * NEGLIGIBLE / (kv + (kv * kv + 2 * NEGLIGIBLE * ks).sqrt())
    reach = reach.mid() if reach < 1.2 else arb.pi() / 2
    total = arb(0)
    for node, weight in rule(POINTS):
        half_sine, half_cosine = (node * reach / 2).sin_cos()
        t = 2 * half_sine * half_cosine
        root = (half_cosine - half_sine) * (half_cosine + half_sine)
        rest = (-(2 * ks * half_sine * half_sine + kv * t)).exp()
        total += weight * t * root * rest * (ks * root).bessel_i(0, scaled=True)
    return reach * total * kappa / (1 - (-2 * kappa).exp())


def half_layer(z: arb) -> arb:
    """h(z) = 1/sqrt(pi) - z erfcx(z)."""
    with precision(3 * ctx.prec):
        value = 1 / arb.pi().sqrt() - z * (z * z).exp() * z.erfc()
    return value


def mean_cosine(kappa: arb) -> arb:
    return kappa.coth() - 1 / kappa


def even(square: arb, kappa_square: arb) -> tuple[arb, arb]:
    u, kappa, s = square.sqrt(), kappa_square.sqrt(), (1 - square).sqrt()
    dark = scaled(u, s, kappa) * (-kappa * (1 - s)).exp()
    # The table is subtracted from, and its error counts relative to the difference.
    return dark + mean_cosine(kappa) * u / 2, dark


def round_(v: arb, kappa: arb) -> tuple[arb, arb]:
    s = ((1 - v) * (1 + v)).sqrt()
    value = scaled(v, s, kappa) * (kappa * (v - (1 - s))).exp() * (1 - (-2 * kappa).exp()) / kappa
    return value, value


def layer(shifted: arb, alpha_square: arb) -> tuple[arb, arb]:
    s, kappa = 1 / shifted - SHIFT, 2 / alpha_square
    whole = scaled(((1 - s) * (1 + s)).sqrt(), s, kappa) * kappa.sqrt()
    flat = mean_cosine(kappa) / 2 * (1 + s).sqrt() * half_layer((kappa * (1 - s)).sqrt())
    return (whole - flat) * kappa, whole * kappa


def rim(s: arb, kappa: arb) -> arb:
    v = ((1 - s) * (1 + s)).sqrt()
    surplus = v * (1 + 1 / kappa) * (-kappa * (1 + s)).exp()
    return kappa * (scaled(v, s, kappa) * (1 - (-2 * kappa).exp()) + surplus)


def near_rim(ks: arb, alpha_fourth: arb) -> tuple[arb, arb]:
    kappa = 2 / alpha_fourth.sqrt()
    value = rim(ks / kappa, kappa)
    return value, value


def far_rim(inverse: arb, s_square: arb) -> tuple[arb, arb]:
    s = s_square.sqrt()
    value = rim(s, 1 / (inverse * s)) / inverse.sqrt()
    return value, value


REGIONS = {
    "EVEN": Region([0.0, 1.0], [0.0, 0.25, 1.0, 2.25], (16, 20), even),
    "ROUND": Region([0.0, 0.25, 0.5, 0.75, 1.0], [1.5, 2.3, 3.5, 5.3, 8.0], (22, 22), round_),
    "LAYER": Region(LAYER_EDGES, [0.0, 0.025, 0.0625, 0.1, 1.0 / 6.0, 0.25], (24, 22), layer),
    "RIM": Region([0.0, 2.0, 4.0], [0.0, 0.0625], (26, 18), near_rim),
    "EDGE": Region([0.0, 1.0 / 12.0, 1.0 / 7.0, 0.25], [0.0, 0.19], (26, 20), far_rim),
}


def number(ball: arb) -> mpf:
    """The middle of a ball that is narrow enough for every table."""
    if ball.rad() > abs(ball.mid()) * arb("1e-24") + arb("1e-30"):
        raise ArithmeticError(f"{ball} is too wide")
    mantissa, exponent = ball.mid().man_exp()
    return mp.ldexp(int(mantissa), int(exponent))


def between(low: float, high: float, node: mpf) -> arb:
    """The place of a node of [-1, 1] in a cell: a binary number of 100 bits, so that balls start as points."""
    with mp.workprec(100):
        place = mpf(low) + (mpf(high) - mpf(low)) * (1 + node) / 2
    return arb((int(place.man), int(place.exp)))


def sampled(region: Region, cell: Cell) -> tuple[list[list[mpf]], mpf]:
    """The function at the cell's nodes, and the least scale of its errors there."""
    found = [
        [
            region.value(between(cell[0], cell[1], x), between(cell[2], cell[3], y))
            for y in chebyshev_nodes(region.nodes[1])
        ]
        for x in chebyshev_nodes(region.nodes[0])
    ]
    values = [[number(value) for value, _ in row] for row in found]
    return values, min(number(scale) for row in found for _, scale in row)


def tables(region: Region, cell: Cell) -> dict[str, list[list[float]]]:
    """The precise and the fast table of a cell."""
    with precision(BITS), mp.workdps(DIGITS):
        values, scale = sampled(region, cell)
        return {prefix: polynomial(values, room * scale) for prefix, room in LEFT_OUT.items()}


def error(region: Region, cell: Cell, table: list[list[float]], points: int, seed: int) -> mpf:
    """The largest error of a table, relative to sigma(-v), at random points of its cell."""
    chance, largest = random.Random(seed), mpf(0)
    with precision(BITS), mp.workdps(DIGITS):
        for _ in range(points):
            x, y = (mpf(chance.choice([-1, 1, chance.uniform(-1, 1), chance.uniform(-1, 1)])) for _ in range(2))
            # Not the ends themselves, where variables degenerate.
            x, y = x * mpf("0.999999"), y * mpf("0.999999")
            value, scale = region.value(between(cell[0], cell[1], x), between(cell[2], cell[3], y))
            table_there = mp.polyval([mp.polyval(row[::-1], x) for row in table][::-1], y)
            largest = max(largest, abs(table_there - number(value)) / number(scale))
    return largest


def line(function: Callable[[arb], arb], low: float, high: float, count: int, left_out: mpf) -> list[float]:
    """A polynomial in one variable of [-1, 1], relatively accurate where the function hardly changes."""
    with precision(BITS), mp.workdps(DIGITS):
        values = [number(function(between(low, high, node))) for node in chebyshev_nodes(count)]
        series = shortened([coefficients(values)], left_out * min(map(abs, values)))[0]
        while not series[-1]:
            series.pop()
        return [float(entry) for entry in powers(series)]


def lines() -> dict[str, list[list[float]]]:
    """h(z) (1 + z)^2 in HALF/(HALF + z), and c/kappa in kappa^2 where EVEN is."""
    found = {}
    for prefix, left_out in LEFT_OUT.items():
        # One term more costs little, and the odd part is to be right to a place or two.
        room = left_out / 10
        far = line(lambda t: half_layer(HALF / t - HALF) * (1 + HALF / t - HALF) ** 2, 0, 1, 40, room)
        found[f"{prefix}HALF_LAYER"] = [far]
        found[f"{prefix}MEAN_COSINE"] = [
            line(lambda square: mean_cosine(square.sqrt()) / square.sqrt(), 0, REGIONS["EVEN"].y[-1], 20, room)
        ]
    return found


def all_tables() -> dict[str, list[list[list[float]]]]:
    """Every table by its name, a list of cells each; ArithmeticError where one misses what is allowed."""
    found: dict[str, list[list[list[float]]]] = {}
    for name, region in REGIONS.items():
        for cell in region.cells():
            for prefix, table in tables(region, cell).items():
                off = error(region, cell, table, 24, 1)
                if off > ALLOWED[prefix]:
                    raise ArithmeticError(f"{prefix}{name} is off by {mp.nstr(off, 3)} in {cell}")
                found.setdefault(prefix + name, []).append(table)
    return found


def module() -> str:
    parts = [
        '"""The polynomials of `spherical_gaussian`: for every region its cells, and by powers of y those of x.\n\n'
        "Lowest powers first, both variables scaled to [-1, 1]. Generated by\n"
        "`python -m xsec_sym.export.spherical_gaussian`, which explains them: do not edit.\n"
        '"""\n\n'
        f"# fmt: off\n\nLIT = {LIT!r}\nSHIFT = {SHIFT!r}\nHALF = {HALF!r}\n"
    ]
    for name, region in REGIONS.items():
        parts.append(f"{name}_X = {list(region.x)!r}\n{name}_Y = {list(region.y)!r}\n")
    for name, rows in lines().items():
        parts.append(f"{name} = [\n" + "".join(f"{packed(row, 4)}],\n" for row in rows) + "]\n")
    for name, cells in all_tables().items():
        text = "".join("    [\n" + "".join(f"{packed(row, 6)}],\n" for row in cell) + "    ],\n" for cell in cells)
        parts.append(f"{name} = [\n{text}]\n")
    return "\n".join(parts)


def main() -> None:
    with writing(ROOT / "kernels" / "_spherical_gaussian_tables.py") as out:
        out.write(module())


if __name__ == "__main__":
    main()
