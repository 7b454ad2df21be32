"""Confirm by simulation that both media scatter alike: `python -m xsec_sym.walks`; exit code 1 where a test fails."""

import sys
import time
from collections.abc import Iterator
from functools import partial

import click
import numpy as np
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn
from rich.table import Table

from xsec_sym.kernels import lambda_ggx
from xsec_sym.walks.compare import Check, Medium, first_order, holds, same_directions, same_orders, share, visibility
from xsec_sym.walks.heights import SmithMedium
from xsec_sym.walks.homogeneous import HomogeneousMedium, TwoSidedMedium
from xsec_sym.walks.paths import Told

# flakes, heights, roughness, cosines of the directions of light and of view
CASES = (("mirror", "gaussian", 0.7, 0.5, 0.4), ("diffuse", "uniform", 1.0, 0.6, 0.3))
LEVEL = 1e-4
WIDTH = 120
HEADINGS = ("quantity", "medium", "closed form", "estimate", "± error", "z or χ²", "p", "")

Row = tuple[str, Check]


def case(
    flakes: str, heights: str, alpha: float, cosine_i: float, cosine_o: float, n: int, seed: int, told: Told
) -> tuple[list[Row], list[Row]]:
    """The tests of one case, and its controls, which must fail; three walks of n paths tell of their progress."""
    # Independent generators, as the walks must be.
    one, two, three, points = (np.random.default_rng(child) for child in np.random.SeedSequence(seed).spawn(4))
    homogeneous, smith = HomogeneousMedium(alpha, flakes), SmithMedium(alpha, flakes, heights)
    emerged = {
        "homogeneous": homogeneous.walk(cosine_i, n, one, told=told),
        f"{heights} heights": smith.walk(cosine_i, n, two, told=told),
    }
    rows: list[Row] = []
    controls: list[Row] = []
    lam_i, lam_o = (float(lambda_ggx(cosine, alpha)) for cosine in (cosine_i, cosine_o))
    media: tuple[Medium, ...] = (homogeneous, smith)
    for (name, walk), medium in zip(emerged.items(), media, strict=True):
        rows += [(name, check) for check in visibility(medium, cosine_i, cosine_o, n, points)]
        hits = round(n * (rows[-1][1].estimate or 0.0))
        controls.append((name, share("G2 / G1, (22) line 2", lam_i / (lam_i + lam_o), hits, n)))
        if flakes == "mirror":
            rows += [(name, check) for check in first_order(walk, cosine_i, alpha)]
    rows += [("both", same_directions(*emerged.values())), ("both", same_orders(*emerged.values()))]
    wrong = TwoSidedMedium(alpha, flakes).walk(cosine_i, n, three, told=told)
    against = emerged[f"{heights} heights"]
    controls += [("two-sided flakes", test(wrong, against)) for test in (same_directions, same_orders)]
    inside = sum(walk.inside for walk in emerged.values())
    click.echo(
        f"{flakes} flakes, α = {alpha}, light from cos θ = {cosine_i}, view along {cosine_o}; orders up to "
        f"{max(int(walk.orders.max(initial=0)) for walk in emerged.values())}, {inside} paths cut off inside",
        err=True,
    )
    return rows, controls


def cells(name: str, check: Check) -> Iterator[str]:
    yield check.quantity
    yield name
    yield from ("" if part is None else f"{part:.6f}" for part in (check.exact, check.estimate))
    yield "" if check.error is None else f"{check.error:.6f}"
    yield f"{check.score:+.2f}" if check.score is not None else f"{check.statistic:.1f} / {check.freedom}"
    yield f"{check.p_value:.2g}"


@click.command()
@click.option("--paths", default=1_000_000, show_default=True, type=click.IntRange(1000), help="Paths a walk.")
@click.option("--seed", default=2016, show_default=True, type=click.IntRange(0))
def main(paths: int, seed: int) -> None:
    """Simulate the homogeneous medium and Smith's, compare them with the closed forms and with each other."""
    # Rich cuts what is not shown on a terminal to 80 columns.
    console, start = Console(width=None if sys.stdout.isatty() else WIDTH), time.perf_counter()
    columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeElapsedColumn())
    rows: list[Row] = []
    controls: list[Row] = []
    with Progress(*columns, console=Console(stderr=True), disable=not sys.stderr.isatty()) as progress:
        for number, parameters in enumerate(CASES):
            task = progress.add_task(" ".join(map(str, parameters[:3])), total=3 * paths)
            tests, wrong = case(*parameters, paths, seed + number, partial(progress.advance, task))
            rows += tests
            controls += wrong
    good = holds([check for _, check in rows], LEVEL)
    caught = [not kept for kept in holds([check for _, check in controls], LEVEL)]
    for title, part, fine in (("Tests", rows, good), ("Controls, which must be rejected", controls, caught)):
        table = Table(title=title, title_justify="left", box=SIMPLE_HEAD)
        for heading in HEADINGS:
            table.add_column(heading, justify="left" if heading in HEADINGS[:2] else "right", no_wrap=True)
        for (name, check), right in zip(part, fine, strict=True):
            table.add_row(*cells(name, check), "" if right else "FAILS")
        console.print(table)
    wrong_ones = good.count(False) + caught.count(False)
    console.print(
        f"{len(rows)} tests at the level {LEVEL:g}/{len(rows)}, {len(controls)} controls: "
        f"{'all as they should be' if not wrong_ones else f'{wrong_ones} fail'} "
        f"({paths:,} paths a walk, {time.perf_counter() - start:.1f} s)"
    )
    if caught.count(False) and all(good):
        console.print("A control that is not rejected says that there are too few paths.")
    sys.exit(1 if wrong_ones else 0)


if __name__ == "__main__":
    main()
