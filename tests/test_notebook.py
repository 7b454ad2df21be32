"""The helpers of the notebooks: a slider is a picture first."""

import sys

import matplotlib.pyplot as plt
import pytest
from IPython.display import Image

from xsec_sym import notebook


class Shown:
    """Stands in for Jupyter: keeps what is displayed, and what replaces it."""

    def __init__(self):
        self.objects, self.updates = [], []

    def __call__(self, thing, display_id=False):
        self.objects.append(thing)
        return self if display_id else None

    def update(self, thing):
        self.updates.append(thing)


@pytest.fixture
def shown(monkeypatch):
    there = Shown()
    monkeypatch.setattr(notebook, "display", there)
    return there


@pytest.fixture
def line():
    drawn = []

    def draw(alpha, u):
        drawn.append((alpha, u))
        figure, axes = plt.subplots(figsize=(1, 1))
        axes.plot([0, 1], [alpha, u])
        return figure

    draw.at = drawn
    return draw


RANGES = {"alpha": (0.0, 1.0, 0.3), "u": (-1.0, 1.0, 0.5)}


def test_a_slider_draws_at_once_and_again_where_it_is_moved(shown, line):
    notebook.slider(line, **RANGES)
    picture, controls = shown.objects
    assert isinstance(picture, Image) and picture.data.startswith(b"\x89PNG") and picture.alt.endswith("u = 0.5")
    assert [(c.min, c.max, c.value) for c in controls.children] == [(0, 1, 0.3), (-1, 1, 0.5)]
    assert line.at == [(0.3, 0.5)] and not shown.updates
    controls.children[1].value = -1.0
    assert line.at[-1] == (0.3, -1.0)  # the other argument stays
    (update,) = shown.updates
    assert update.data != picture.data
    assert not plt.get_fignums()


@pytest.mark.parametrize(("low", "high", "first"), [(0.1, 1.5, 0.5), (0.2, 3.0, 0.6), (-0.99, 0.99, 0.6), (0, 180, 50)])
def test_a_slider_stands_where_the_first_picture_was_drawn(low, high, first):
    """The front end rounds what it shows to a place that is a whole number of steps from the least value."""
    (control,) = notebook._controls({"alpha": (low, high, first)}).children
    places = (first - low) / control.step
    assert abs(places - round(places)) < 1e-9 and 50 <= (high - low) / control.step <= 250


def test_without_ipywidgets_the_picture_stays(shown, line, monkeypatch):
    monkeypatch.setitem(sys.modules, "ipywidgets", None)
    notebook.slider(line, **RANGES)
    (picture,) = shown.objects
    assert isinstance(picture, Image) and line.at == [(0.3, 0.5)]


def test_what_is_refused(shown, line):
    with pytest.raises(ValueError, match=r"^alpha starts at 2, which is not between 0.0 and 1.0$"):
        notebook.slider(line, alpha=(0.0, 1.0, 2.0), u=(0.0, 1.0, 0.5))
    with pytest.raises(TypeError, match=r"^draw must return a Matplotlib figure, not NoneType$"):
        notebook.slider(lambda alpha: None, alpha=(0.0, 1.0, 0.5))
    assert not line.at and not shown.objects
