"""What a scene asks for, and whatever is wrong with its file, in a line that names the file and the key."""

from __future__ import annotations

import builtins
import keyword
import math
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import numpy as np

from xsec_sym.study.method import Argument, Columns, Quantity, UnknownQuantity, registered

ERRORS = ("relative", "absolute")
DTYPES = ("float64", "float32")
EVALUATIONS = 1_000_000
SCENE_KEYS = ("name", "tolerance", "error", "dtype")
MATERIAL_KEYS = ("name", "quantity", "tolerance", "error", "dtype", "evaluations")
# Names that the written module has for itself.
TAKEN = frozenset({"np", "math", "special", "annotations", *dir(builtins), *keyword.kwlist, *keyword.softkwlist})


class BadScene(ValueError):
    """A scene that cannot be planned for: the message names the file and the key.

    >>> Scene.of({"material": [{"name": "frost", "quantity": "sigma_gxx", "tolerance": 1e-3}]})
    Traceback (most recent call last):
    ...
    xsec_sym.planner.scene.BadScene: scene: ...sigma_gxx...
    """


@dataclass(frozen=True)
class Material:
    """A function that the scene needs.

    constants: the arguments that are numbers; ranges: those that stay arguments, (low, high). Between them they are all
    arguments of the quantity. error: "relative" or "absolute". evaluations: how often it is computed a frame.

    >>> glass = {"name": "foggy glass", "quantity": "sigma_ggx", "alpha": 0.1, "tolerance": 1e-3}
    >>> scene = Scene.of({"material": [glass]})
    >>> scene.materials[0].function, scene.materials[0].arguments, dict(scene.materials[0].constants)
    ('foggy_glass', ['u'], {'alpha': 0.1})
    """

    name: str
    function: str
    quantity: Quantity
    constants: Mapping[str, float]
    ranges: Mapping[str, tuple[float, float]]
    tolerance: float
    error: str = "relative"
    dtype: str = "float64"
    evaluations: int = EVALUATIONS

    @property
    def running(self) -> list[str]:
        """The kernel's running arguments; they are not the quantity's where those are embedded, as angles are."""
        if self.quantity.embed is None:
            return [a.name for a in self.quantity.running]
        from inspect import signature

        from xsec_sym import kernels

        names = list(signature(getattr(kernels, self.quantity.name)).parameters)
        return names[: len(names) - len(self.quantity.set)]

    @property
    def arguments(self) -> list[str]:
        """Those of the written function, in the kernel's order."""
        left = [name for name in self.running if name in self.ranges or self.quantity.embed is not None]
        return left + [a.name for a in self.quantity.set if a.name in self.ranges]

    def inputs(self, columns: Columns) -> list[np.ndarray]:
        """What the written function gets at these points of the quantity."""
        running, others = self.quantity.given(columns, self.dtype)
        every = dict(zip([*self.running, *(a.name for a in self.quantity.set)], (*running, *others), strict=True))
        return [every[name] for name in self.arguments]

    @property
    def folded(self) -> tuple[float, ...] | None:
        """The set arguments where all of them are constant."""
        if all(a.name in self.constants for a in self.quantity.set):
            return tuple(self.constants[a.name] for a in self.quantity.set)
        return None

    @property
    def spans(self) -> dict[str, tuple[float, float]]:
        """The range of every argument; a constant's is a point."""
        return {
            a.name: self.ranges[a.name] if a.name in self.ranges else (self.constants[a.name],) * 2
            for a in self.quantity.arguments
        }

    def wanted(self) -> str:
        """
        >>> Scene.of({"material": [{"name": "a", "quantity": "sigma_spherical_gaussian", "alpha": 0.1, "u": [0, 1],
        ...     "tolerance": 1e-3}]}).materials[0].wanted()
        'sigma_spherical_gaussian(u in [0, 1], alpha = 0.1), relative error 0.001, float64'
        """
        said = [
            f"{name} in [{low:g}, {high:g}]" if name in self.ranges else f"{name} = {low:g}"
            for name, (low, high) in self.spans.items()
        ]
        return f"{self.quantity.name}({', '.join(said)}), {self.error} error {self.tolerance:g}, {self.dtype}"


@dataclass(frozen=True)
class Scene:
    """A name and materials. `Scene.load` reads a TOML file, `Scene.of` takes the same as a dictionary.

    >>> material = {"name": "rust", "quantity": "sigma_beckmann", "alpha": [0.3, 0.5]}
    >>> scene = Scene.of({"scene": {"name": "harbour", "tolerance": 1e-3}, "material": [material]})
    >>> scene.name, [m.name for m in scene.materials], scene.materials[0].tolerance
    ('harbour', ['rust'], 0.001)
    """

    name: str
    materials: tuple[Material, ...]

    @classmethod
    def load(cls, path: str | Path) -> Scene:
        """The scene of a TOML file. Raises `BadScene`."""
        path = Path(path)
        try:
            text = path.read_bytes().decode("utf-8")
        except OSError as error:
            raise BadScene(f"{path}: {error.strerror or error}") from None
        except UnicodeDecodeError as error:
            raise BadScene(f"{path}: this is no UTF-8 text: {error.reason} at byte {error.start}") from None
        try:
            data = tomllib.loads(text)
        except tomllib.TOMLDecodeError as error:
            raise BadScene(f"{path}: {_one_line(error)}") from None
        except RecursionError:
            raise BadScene(f"{path}: this is nested too deeply for a scene") from None
        return cls.of(data, str(path))

    @classmethod
    def of(cls, data: Mapping[str, Any], where: str = "scene") -> Scene:
        """The scene of a dictionary with the keys of a file. Raises `BadScene`, which begins with `where`."""
        head = _table(data.get("scene", {}), f"{where}: scene")
        _no_more(data, ("scene", "material"), where)
        _no_more(head, SCENE_KEYS, f"{where}: scene")
        said = head.get("name", Path(where).stem)
        name = _name(said, f"{where}: scene.name")
        _common(head, f"{where}: scene")
        rows = data.get("material", [])
        if not isinstance(rows, list):
            raise BadScene(f"{where}: material: write [[material]], with two brackets, for each of them")
        if not rows:
            raise BadScene(f"{where}: material: there is none")
        materials: list[Material] = []
        for place, row in enumerate(rows, 1):
            row = _table(row, f"{where}: material {place}")
            label = f"{where}: material {place}"
            if isinstance(row.get("name"), str):
                label += f" ({_one_line(row['name'])})"
            material = _material(row, head, label)
            twin = next((m.name for m in materials if m.function == material.function), None)
            if twin is not None:
                raise BadScene(f"{label}: name: it becomes the function {material.function}, and so does {twin}")
            materials.append(material)
        return cls(name, tuple(materials))


def _material(row: Mapping[str, Any], head: Mapping[str, Any], label: str) -> Material:
    for key in ("name", "quantity"):
        if key not in row:
            raise BadScene(f"{label}: {key} is missing")
    name = _name(row["name"], f"{label}: name")
    function = function_name(name)
    if not function:
        raise BadScene(f"{label}: name: {name!r} has no letter or digit to name a function by")
    if not isinstance(row["quantity"], str):
        raise BadScene(f"{label}: quantity: {row['quantity']!r} is no name of a kernel")
    try:
        quantity = registered(row["quantity"]).quantity
    except UnknownQuantity as error:
        raise BadScene(f"{label}: quantity: {_one_line(error)}") from None
    _no_more(row, (*MATERIAL_KEYS, *(a.name for a in quantity.arguments)), label)
    found = {key: head[key] for key in ("tolerance", "error", "dtype") if key in head}
    found |= {key: row[key] for key in ("tolerance", "error", "dtype", "evaluations") if key in row}
    if "tolerance" not in found:
        raise BadScene(f"{label}: tolerance is missing, here and in [scene]")
    _common(found, label)
    evaluations = found.get("evaluations", EVALUATIONS)
    if isinstance(evaluations, bool) or not isinstance(evaluations, int) or evaluations < 1:
        raise BadScene(f"{label}: evaluations: {evaluations!r} is no positive integer")
    constants: dict[str, float] = {}
    ranges: dict[str, tuple[float, float]] = {}
    for argument in quantity.arguments:
        if argument.name not in row:
            if argument in quantity.set:
                raise BadScene(f"{label}: {argument.name} is missing: a number, or a range [low, high]")
            ranges[argument.name] = (argument.low, argument.high)
            continue
        given, key = row[argument.name], f"{label}: {argument.name}"
        if isinstance(given, list | tuple):
            if len(given) != 2:
                raise BadScene(f"{key}: {_one_line(given)} is no range: that is [low, high]")
            low, high = (_inside(end, argument, key) for end in given)
            if low > high:
                raise BadScene(f"{key}: the range [{low:g}, {high:g}] is upside down")
            ranges[argument.name] = (low, high)
        else:
            constants[argument.name] = _inside(given, argument, key)
    return Material(
        name=name,
        function=function,
        quantity=quantity,
        constants=constants,
        ranges=ranges,
        tolerance=float(found["tolerance"]),
        error=found.get("error", "relative"),
        dtype=found.get("dtype", "float64"),
        evaluations=evaluations,
    )


def _common(given: Mapping[str, Any], label: str) -> None:
    if "tolerance" in given:
        tolerance = _number(given["tolerance"], f"{label}: tolerance")
        if not 0 < tolerance < math.inf:
            raise BadScene(f"{label}: tolerance: {tolerance:g} is no positive number")
    for key, known in (("error", ERRORS), ("dtype", DTYPES)):
        if key in given and given[key] not in known:
            raise BadScene(f"{label}: {key}: {_one_line(repr(given[key]))} is neither {known[0]} nor {known[1]}")


def _inside(given: Any, argument: Argument, key: str) -> float:
    value = _number(given, key)
    if not argument.low <= value <= argument.high:
        raise BadScene(f"{key}: {value:g} is outside [{argument.low:g}, {argument.high:g}]")
    if argument.integer and value != int(value):
        raise BadScene(f"{key}: {value:g} is no integer")
    return value


def _number(given: Any, key: str) -> float:
    if isinstance(given, bool) or not isinstance(given, int | float):
        raise BadScene(f"{key}: {_one_line(repr(given))} is no number")
    try:
        value = float(given)
    except OverflowError:
        value = math.inf
    if math.isnan(value):
        raise BadScene(f"{key}: NaN is no number")
    return value


def _name(given: Any, key: str) -> str:
    if not isinstance(given, str) or not given.strip() or not given.isprintable():
        raise BadScene(f"{key}: {_one_line(repr(given))} is no name in one line")
    return given.strip()


def _table(given: Any, label: str) -> Mapping[str, Any]:
    if not isinstance(given, Mapping):
        raise BadScene(f"{label}: this is no table of keys")
    return given


def _no_more(given: Mapping[str, Any], known: tuple[str, ...], label: str) -> None:
    for key in given:
        if key not in known:
            near = get_close_matches(str(key), known, n=1, cutoff=0.6)
            hint = f"; did you mean {near[0]}?" if near else "; there are " + ", ".join(known)
            raise BadScene(f"{label}: there is no key {_one_line(key)}{hint}")


def _one_line(said: object) -> str:
    return " ".join(str(said).split())


def function_name(name: str) -> str:
    """The function that a material becomes.

    >>> function_name("Foggy glass, 2nd"), function_name("2nd"), function_name("class")
    ('foggy_glass_2nd', 'material_2nd', 'class_material')
    """
    word = re.sub(r"\W+", "_", name.lower()).strip("_")
    if word[:1].isdigit():
        word = f"material_{word}"
    if word in TAKEN:
        word = f"{word}_material"
    return word if not word or word.isidentifier() else f"material_{word}"
