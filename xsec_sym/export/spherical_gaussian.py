"""Write the tables behind `sigma_spherical_gaussian`: `python -m xsec_sym.export.spherical_gaussian`.

What they tabulate stands in `spherical_gaussian_functions`. A table is an interpolant at Chebyshev nodes whose smallest
terms are left out as long as they add up to less than LEFT_OUT of sigma(-v), anywhere in the cell. How far off it is,
rounded as it is, `spherical_gaussian_bounds` proves: where that is more than ALLOWED, less is left out, and where it
helps nothing, there is no table. What was proved is written beside the tables. `error` looks at points.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping
from pathlib import Path

from flint import arb
from mpmath import mp, mpf

import xsec_sym
from xsec_sym.export import spherical_gaussian_bounds as bounds
from xsec_sym.export.polynomials import chebyshev_nodes, coefficients, packed, polynomial, powers, shortened
from xsec_sym.export.spherical_gaussian_functions import (
    BITS,
    DIGITS,
    HALF,
    LIT,
    REGIONS,
    SHIFT,
    Cell,
    Region,
    between,
    far_half_layer,
    number,
    pale_cosine,
)
from xsec_sym.proof.ball_compile import precision
from xsec_sym.record.files import writing

ROOT = Path(xsec_sym.__file__).parent
# What the terms left out may add up to, relative to sigma(-v), and the error that is allowed in the end.
LEFT_OUT = {"": mpf("1.2e-16"), "FAST_": mpf("5e-8")}
ALLOWED = {"": 4e-16, "FAST_": 1e-7}
# The parts of LEFT_OUT that are tried, until the bound is kept.
SHARES = (1, mpf("0.5"), mpf("0.25"))


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


def tables(region: Region, cell: Cell, share: mpf | int = 1) -> dict[str, list[list[float]]]:
    """The precise and the fast table of a cell, with that share of LEFT_OUT."""
    with precision(BITS), mp.workdps(DIGITS):
        values, scale = sampled(region, cell)
        return {prefix: polynomial(values, share * room * scale) for prefix, room in LEFT_OUT.items()}


def kept(name: str, where: object, found: Mapping[str, float]) -> None:
    """Raises ArithmeticError unless all proved bounds, by prefix, are within ALLOWED."""
    for prefix, bound in found.items():
        if not bound <= ALLOWED[prefix]:
            raise ArithmeticError(f"{prefix}{name} is not proved to be better than {bound:.3g} in {where}")


def settled(name: str, cell: Cell) -> tuple[dict[str, list[list[float]]], dict[str, float]]:
    """The tables of a cell, and what is proved on their errors; ArithmeticError where that exceeds ALLOWED."""
    for share in SHARES:
        made = tables(REGIONS[name], cell, share)
        found = bounds.cell_bounds(name, cell, made)
        if all(bound <= ALLOWED[prefix] for prefix, bound in found.items()):
            break
    kept(name, cell, found)
    return made, found


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


def lines() -> dict[str, list[float]]:
    """h(z) (1 + z)^2 in HALF/(HALF + z), and c/kappa in kappa^2 where EVEN is."""
    found = {}
    for prefix, left_out in LEFT_OUT.items():
        # One term more costs little, and the odd part is to be right to a place or two.
        room = left_out / 10
        found[f"{prefix}HALF_LAYER"] = line(far_half_layer, 0, 1, 40, room)
        found[f"{prefix}MEAN_COSINE"] = line(pale_cosine, 0, REGIONS["EVEN"].y[-1], 20, room)
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
    proved: dict[str, list[float]] = {}
    for name, row in lines().items():
        prefix = name.removesuffix(bare := name.removeprefix("FAST_"))
        proved[name] = [bounds.line_bound(bare, row)]
        kept(bare, "its range", {prefix: proved[name][0]})
        parts.append(f"{name} = [\n{packed(row, 4)}],\n]\n")
    found: dict[str, list[str]] = {}
    for name, region in REGIONS.items():
        for cell in region.cells():
            made, off = settled(name, cell)
            for prefix, table in made.items():
                text = "    [\n" + "".join(f"{packed(row, 6)}],\n" for row in table) + "    ],\n"
                found.setdefault(prefix + name, []).append(text)
                proved.setdefault(prefix + name, []).append(off[prefix])
    parts += [f"{name} = [\n{''.join(cells)}]\n" for name, cells in found.items()]
    parts.append(
        "# Proved bounds on the errors by cell, relative to sigma(-v) or to the function of a line; where that is\n"
        "# singular at 0, from START on: of alpha^2 in LAYER, of 1/(kappa s) in EDGE, and of t in HALF_LAYER.\n"
        f"START = {bounds.START!r}\nBOUND = {{\n"
        + "".join(f'    "{name}":\n{packed(row, 8)}],\n' for name, row in proved.items())
        + "}\n"
    )
    return "\n".join(parts)


def main() -> None:
    with writing(ROOT / "kernels" / "_spherical_gaussian_tables.py") as out:
        out.write(module())


if __name__ == "__main__":
    main()
