"""Measurements as files: those that are committed, new ones, and what is drawn from them."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from xsec_sym.record.files import layout, plain
from xsec_sym.study.method import registered

DATA = Path(__file__).parent / "data"
KINDS = (".svg", ".png", ".json")
Tick = Callable[[str], None]
# What only the planner and the maps read.
INNER = ("cells", "by_label")


class Unmeasured(LookupError):
    """There is no stored measurement of the quantity; the message says how to make one.

    >>> str(Unmeasured("sigma_ggx has no stored measurement"))
    'sigma_ggx has no stored measurement'
    """


def known(name: str) -> None:
    """Raises `UnknownQuantity` unless the quantity is registered."""
    registered(name)


def steps(name: str) -> int:
    """How often a measurement says what it begins."""
    from xsec_sym.study import measure

    return measure.steps(name)


def stored(name: str) -> dict[str, Any]:
    """The committed measurements of a quantity. Raises `UnknownQuantity`, `Unmeasured`.

    >>> data = stored("sigma_ggx")
    >>> data["quantity"], "max_rel" in data["points"][0], "ns_median" in data["points"][0]
    ('sigma_ggx', True, True)
    """
    known(name)
    path = DATA / f"{name}.json"
    if not path.exists():
        raise Unmeasured(f"{name} has no stored measurement; --measure makes one")
    found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return found


def measured(
    name: str, seed: int = 1, jobs: int = 1, tick: Callable[[str], None] = lambda said: None
) -> dict[str, Any]:
    """New measurements, on this machine."""
    from xsec_sym.study.measure import measure

    found: dict[str, Any] = plain(measure(name, seed, jobs, tick))
    return found


def text(data: Mapping[str, Any]) -> str:
    return layout(data, depth=2) + "\n"


LEGEND = (
    "call: with arrays, or with a constant for what a method may fold in; ns: median nanoseconds a value, as measured",
    "max rel, p99 rel: the largest relative error found, and that which 99 of 100 points keep to; max abs: the largest",
    "absolute one; failures: points where the value is not finite though the right one is",
)


def table(data: Mapping[str, Any]) -> list[str]:
    """Measurements as the lines of a table, one a method.

    >>> "method" in table(stored("sigma_ggx"))[0]
    True
    """
    from xsec_sym.study import chart

    return chart.table(data)


def write(data: Mapping[str, Any], path: str | Path, kind: str, stability: bool = False) -> None:
    """The data, or what is drawn of them, in a file of this kind: .json, .svg or .png.

    ``stability`` draws the map of lost digits instead of speed against accuracy. OSError where it cannot be written.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as room:
    ...     write(stored("sigma_ggx"), f"{room}/ggx.json", ".json")
    ...     "sigma_ggx" in Path(room, "ggx.json").read_text()
    True
    """
    from xsec_sym.study import chart
    from xsec_sym.study import stability as maps

    if kind == ".json":
        points = [{key: value for key, value in row.items() if key not in INNER} for row in data["points"]]
        Path(path).write_text(text({**data, "points": points}), encoding="utf-8")
    else:
        (maps if stability else chart).draw(data, path)
