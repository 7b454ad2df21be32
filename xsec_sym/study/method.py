"""What is compared: a quantity of several arguments, and the named ways to compute it.

A quantity has running arguments, such as a cosine, and set ones, such as a roughness: those that a scene may fix once
and a method may prepare for. In a call the running ones come first, as in the kernels.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from importlib.util import find_spec
from itertools import product
from math import ceil, floor
from typing import Any

import numpy as np

Function = Callable[..., Any]
# Points as columns: one array an argument of the quantity.
Columns = tuple[np.ndarray, ...]


@dataclass(frozen=True)
class Argument:
    """A name, the edges of the cells in which errors are kept, and the scale on which points are drawn within a cell.

    >>> roughness = Argument("alpha", (0.1, 1.0, 10.0), scale="log")
    >>> roughness.low, roughness.high
    (0.1, 10.0)
    >>> roughness.cells(0.2, 1.0)
    range(0, 1)
    """

    name: str
    edges: tuple[float, ...]
    scale: str = "linear"  # or "log"
    integer: bool = False

    @property
    def low(self) -> float:
        return self.edges[0]

    @property
    def high(self) -> float:
        return self.edges[-1]

    def cells(self, low: float, high: float) -> range:
        """The cells that [low, high] meets in more than an end; the one that holds it where it is a single number."""
        inner = np.asarray(self.edges[1:-1])
        first = int(np.searchsorted(inner, low, side="right"))
        last = int(np.searchsorted(inner, high, side="left"))
        return range(first, max(first, last) + 1)

    def draw(self, rng: np.random.Generator, n: int, low: float | None = None, high: float | None = None) -> np.ndarray:
        """Points between two values, the ends of the domain where none are given."""
        low, high = self.low if low is None else low, self.high if high is None else high
        if self.integer:
            return rng.integers(ceil(low), floor(high), n, endpoint=True).astype(float)
        if self.scale == "log":
            return np.exp(rng.uniform(np.log(low), np.log(high), n)).clip(low, high)
        return rng.uniform(low, high, n)


@dataclass(frozen=True)
class Quantity:
    """Something to compute: `reference` gives it as an mpmath number for floats, by a route that no method takes.

    trouble: named neighbourhoods where methods are known to fail; each draws about n points, as columns.
    typical: values of the set arguments at which constant ones are timed.
    per_cell: points drawn in a cell of the set arguments, and in each cell of the running ones for every one of those.
    usual: ranges that scenes are made of, where the whole domain is much wider; charts show the errors there.
    references: the reference of columns of doubles at once, as doubles, where that is the better part of its cost.
    embed: makes the running arguments of the methods out of those here, where they fill no box: a unit vector out of
    two angles. Points and cells are in the latter; `given` is what methods and the reference get.

    >>> import mpmath
    >>> u, alpha = Argument("u", (0.0, 0.5, 1.0)), Argument("alpha", (0.1, 1.0), scale="log")
    >>> quantity = Quantity("sine", "alpha sin(u)", (u,), (alpha,), lambda u, alpha: alpha * mpmath.sin(u))
    >>> quantity.shape, [a.name for a in quantity.arguments]
    ((2, 1), ['u', 'alpha'])
    """

    name: str
    title: str
    running: tuple[Argument, ...]
    set: tuple[Argument, ...]
    reference: Function
    trouble: Mapping[str, Callable[[np.random.Generator, int], Columns]] = field(default_factory=dict)
    typical: tuple[tuple[float, ...], ...] = ((),)
    per_cell: tuple[int, int] = (2, 2)
    usual: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    unit: str = ""
    about: str = ""
    references: Function | None = None
    embed: Function | None = None

    @property
    def arguments(self) -> tuple[Argument, ...]:
        return self.running + self.set

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(len(a.edges) - 1 for a in self.arguments)

    def box(self, ranges: Mapping[str, tuple[float, float]]) -> np.ndarray:
        """Which cells these ranges meet, in the order in which errors are kept."""
        meets = []
        for argument in self.arguments:
            inside = np.zeros(len(argument.edges) - 1, bool)
            inside[list(argument.cells(*ranges.get(argument.name, (argument.low, argument.high))))] = True
            meets.append(inside)
        return np.ravel(np.prod(np.meshgrid(*meets, indexing="ij"), axis=0)).astype(bool)

    def columns(self, rng: np.random.Generator, n: int) -> Columns:
        """n points anywhere in the domain, on which methods are timed."""
        return tuple(a.draw(rng, n) for a in self.arguments)

    def given(self, columns: Columns, dtype: str = "float64") -> tuple[Columns, Columns]:
        """The running and the set arguments of a method at these points, as numbers of `dtype`."""
        n = len(self.running)
        running = tuple(self.embed(*columns[:n])) if self.embed else columns[:n]
        typed = [np.ascontiguousarray(column, dtype=dtype) for column in (*running, *columns[n:])]
        return tuple(typed[: len(running)]), tuple(typed[len(running) :])


@dataclass(frozen=True)
class Method:
    """A way to compute a quantity. `make(**parameters)` returns the function of all its arguments; a method that
    `folds` is made for set arguments, `make(*set, **parameters)`, and returns a function of the running ones.

    source: an entry of the record, such as "deon2016:40", or a citation, or what it is.
    curve: the values of its parameters along which it becomes slower and more accurate; each is a mapping.
    serial: it takes one number at a time. most: it is so slow that no more points than these are tried.
    least: the smallest array that it is timed at, where it prepares for many values only.
    needs: a package without which it is left out. model: what it computes, if it stands for a quantity that is another.

    >>> taylor = Method("Taylor", "a sum", lambda n: lambda u: u - u**3 / 6 * (n > 1), "series", along(n=(1, 2)))
    >>> [float(taylor.function(parameters)(np.array(0.6))) for parameters in taylor.curve]
    [0.6, 0.564]
    """

    name: str
    source: str
    make: Function
    kind: str = "closed form"
    curve: tuple[Mapping[str, Any], ...] = ({},)
    folds: bool = False
    serial: bool = False
    most: int | None = None
    least: int = 0
    single: bool = False
    needs: str = ""
    model: str = ""
    ours: bool = False

    @property
    def available(self) -> bool:
        return not self.needs or find_spec(self.needs) is not None

    def function(self, parameters: Mapping[str, Any], fixed: Sequence[float] = ()) -> Function:
        """The function of the arguments that are not fixed, on arrays."""
        made = self.make(*fixed, **parameters) if self.folds else self.make(**parameters)
        if self.serial:
            made = one_by_one(made)
        if fixed and not self.folds:
            return lambda *running: made(*running, *fixed)
        return made


def one_by_one(function: Function) -> Function:
    """A function of numbers, as one of arrays. What it cannot do is NaN."""

    def over(*columns: Any) -> np.ndarray:
        found = np.empty(np.broadcast_shapes(*(np.shape(c) for c in columns)))
        for place, numbers in enumerate(zip(*(np.broadcast_to(c, found.shape).flat for c in columns), strict=True)):
            try:
                found.flat[place] = function(*map(float, numbers))
            except (ArithmeticError, ValueError):
                found.flat[place] = np.nan
        return found

    return over


# The module of `methods` for each quantity; in the order in which they are told.
HOMES = {
    "sigma_dirac_ring": "rings",
    "sigma_power": "rings",
    "sigma_beckmann": "surfaces",
    "sigma_ggx": "surfaces",
    "sigma_ellipsoidal": "surfaces",
    "sigma_spherical_gaussian": "spherical_gaussian",
    "lambda_beckmann": "smith",
    "lambda_ggx": "smith",
    "ssl": "squared_lobes",
    "sel": "squared_lobes",
    "phase_lambert_sphere": "sphere_phase",
    "sample_lambert_sphere": "sphere_phase",
    "h_isotropic": "isotropic",
    "h_lambert_sphere": "h_lambert_sphere",
    "brdf_isotropic": "isotropic",
    "brdf_lambert_sphere": "brdf_lambert_sphere",
    "albedo_lambert_sphere": "albedo_lambert_sphere",
    "albedo_lambert_sphere_inverse": "albedo_lambert_sphere",
}


class UnknownQuantity(KeyError):
    """There is no quantity of this name.

    >>> registered("sigma_gxx")
    Traceback (most recent call last):
    ...
    xsec_sym.study.method.UnknownQuantity: there is no quantity sigma_gxx; did you mean sigma_ggx?
    """

    def __str__(self) -> str:
        return str(self.args[0])


@dataclass(frozen=True)
class Field:
    """A quantity with all its methods. ValueError where two of them have one name.

    >>> field = registered("lambda_ggx")
    >>> field.quantity.name, field[field.methods[0].name] is field.methods[0]
    ('lambda_ggx', True)
    """

    quantity: Quantity
    methods: tuple[Method, ...]

    def __post_init__(self) -> None:
        names = [m.name for m in self.methods]
        if len(set(names)) < len(names):
            raise ValueError(f"{self.quantity.name} has two methods of one name: {names}")

    def __getitem__(self, name: str) -> Method:
        return next(m for m in self.methods if m.name == name)

    def variants(self) -> Iterator[tuple[Method, Mapping[str, Any]]]:
        """Every method that can run here, at every point of its curve."""
        for method in self.methods:
            if method.available:
                for parameters in method.curve:
                    yield method, parameters


def registered(name: str) -> Field:
    """The quantity of this name and its methods. Raises `UnknownQuantity`.

    >>> [a.name for a in registered("sigma_ggx").quantity.arguments]
    ['u', 'alpha']
    """
    if name not in HOMES:
        from difflib import get_close_matches

        near = get_close_matches(name, HOMES, n=1, cutoff=0.5)
        hint = f"; did you mean {near[0]}?" if near else "; there are " + ", ".join(HOMES)
        raise UnknownQuantity(f"there is no quantity {name}{hint}")
    module = import_module(f"xsec_sym.study.methods.{HOMES[name]}")
    return next(f for f in module.FIELDS if f.quantity.name == name)


def along(**values: Sequence[Any]) -> tuple[dict[str, Any], ...]:
    """The curve of one or more parameters: every combination.

    >>> along(n=(2, 4))
    ({'n': 2}, {'n': 4})
    """
    return tuple(dict(zip(values, chosen, strict=True)) for chosen in product(*values.values()))
