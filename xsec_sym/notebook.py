"""What the notebooks share: one look for figures, one table, and sliders that fall back to a picture.

>>> from xsec_sym.notebook import slider, table, use_style
>>> table(("u", "sigma"), [(0.5, 1)]).data
"<table><tr><th style='text-align:left'>u</th><th style='text-align:left'>sigma</th></tr>\
<tr><td style='text-align:left'>0.5</td><td style='text-align:left'>1</td></tr></table>"
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from importlib import import_module
from io import BytesIO
from math import floor, log10
from typing import Any

import matplotlib.pyplot as plt
from IPython import get_ipython
from IPython.display import HTML, Image, display
from matplotlib.figure import Figure

from xsec_sym.proof.claim import REGISTRY, Claim

# Four colours of different lightness, so that they differ in grey as well: what is drawn, lit, dark, and wrong.
INK, LIT, DARK, WARM = "#22223b", "#e09f3e", "#335c67", "#9e2a2b"
LOOK: Any = {
    "figure.constrained_layout.use": True,
    "figure.facecolor": "white",  # readable on a dark page too
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.alpha": 0.25,
    "legend.frameon": False,
}
STEPS = 100


def use_style() -> None:
    """Give every figure the one look; called once, at the top of a notebook.

    In a kernel figures are no longer trimmed: their layout fills them already, and to measure what to trim would draw
    each of them twice.

    >>> use_style()
    >>> plt.rcParams["axes.grid"]
    True
    """
    plt.rcParams.update(LOOK)
    shell = get_ipython()
    if shell is not None and "inline" in plt.get_backend():
        # a backend takes hold with the first figure that pyplot makes, and a `Figure` made without it was not shown
        plt.switch_backend(plt.get_backend())
        shell.run_line_magic("config", "InlineBackend.print_figure_kwargs = {'bbox_inches': None}")


def known(*modules: str) -> dict[str, Claim]:
    """The claims by id, once these derivations are imported; `discover` imports them all, which takes seconds.

    modules: their names within `derivations`.

    >>> known("deon2016.dirac_ring")["deon2016:11"].id
    'deon2016:11'
    """
    for name in modules:
        import_module(f"derivations.{name}")
    return REGISTRY


def table(head: Iterable[object], rows: Iterable[Iterable[object]]) -> HTML:
    """A table, aligned to the left. Cells are HTML and may hold formulas between dollars: escape what is not yours."""
    left = " style='text-align:left'"
    cells = "".join(f"<tr>{''.join(f'<td{left}>{cell}</td>' for cell in row)}</tr>" for row in rows)
    return HTML(f"<table><tr>{''.join(f'<th{left}>{name}</th>' for name in head)}</tr>{cells}</table>")


def slider(draw: Callable[..., Figure], **ranges: tuple[float, float, float]) -> None:
    """Show the figure that ``draw`` makes, with a slider for each of its arguments.

    draw: takes the arguments by name, as floats, and returns a new Matplotlib figure. ranges: least, largest and first
    value of each argument. The figure at the first values is an ordinary picture, which stays where no front end or no
    ipywidgets is there: in an export to HTML, in a test. A slider replaces it in place.

    Raises ValueError for a first value out of its range, and TypeError if ``draw`` returns no figure.

    >>> def line(alpha):
    ...     figure, axes = plt.subplots(figsize=(2, 1))
    ...     axes.plot([0, 1], [0, alpha])
    ...     return figure
    >>> slider(line, alpha=(0.05, 1.0, 0.3))
    <IPython.core.display.Image object>
    >>> slider(line, alpha=(0.05, 1.0, 3.0))
    Traceback (most recent call last):
    ...
    ValueError: alpha starts at 3, which is not between 0.05 and 1.0
    """
    for name, (low, high, first) in ranges.items():
        if not low <= first <= high or not low < high:
            raise ValueError(f"{name} starts at {first:g}, which is not between {low} and {high}")
    values = {name: float(first) for name, (_, _, first) in ranges.items()}
    picture = display(_picture(draw, values), display_id=True)
    controls = _controls(ranges) if picture is not None else None
    if controls is None:
        return

    def moved(change: Any) -> None:
        values[change["owner"].description] = change["new"]
        picture.update(_picture(draw, values))

    for control in controls.children:
        control.observe(moved, "value")
    display(controls)


def _picture(draw: Callable[..., Figure], values: dict[str, float]) -> Image:
    figure = draw(**values)
    if not isinstance(figure, Figure):
        raise TypeError(f"draw must return a Matplotlib figure, not {type(figure).__name__}")
    out = BytesIO()
    figure.savefig(out, format="png", dpi=100)
    plt.close(figure)  # or Jupyter shows it once more at the end of the cell
    said = ", ".join(f"{name} = {value:g}" for name, value in values.items())
    return Image(out.getvalue(), format="png", alt=f"a figure at {said}")


def _step(width: float) -> float:
    """About a hundredth of the range, of one digit: 1, 2 or 5 times a power of 10.

    A slider shows the nearest of its own places, so that a first value between two would not be what is drawn.

    >>> _step(1.5 - 0.1), _step(360.0)
    (0.01, 2.0)
    """
    power = 10.0 ** floor(log10(width / STEPS))
    return round(max(k for k in (1, 2, 5) if k * power <= width / STEPS * (1 + 1e-9)) * power, 12)


def _controls(ranges: dict[str, tuple[float, float, float]]) -> Any:
    """A column of sliders, or None without ipywidgets."""
    try:
        import ipywidgets
    except ImportError:
        return None
    return ipywidgets.VBox(
        [
            ipywidgets.FloatSlider(first, min=low, max=high, step=_step(high - low), description=name)
            for name, (low, high, first) in ranges.items()
        ]
    )
