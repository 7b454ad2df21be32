"""A plan: for every material the cheapest candidate that keeps to its tolerance, written as a module and checked."""

from __future__ import annotations

import importlib.util
import math
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from xsec_sym.planner import told, writing
from xsec_sym.planner.candidates import (
    FRESH,
    FRESH_SEED,
    MARGIN,
    PROBE_SEED,
    PROBES,
    Candidate,
    Stale,
    candidates,
    general,
    largest,
    points,
)
from xsec_sym.planner.scene import BadScene, Material, Scene
from xsec_sym.study.method import registered
from xsec_sym.study.points import Points

Tick = Callable[[str], None]
# So much less than the general kernel's time is no gain that another machine, or day, would show.
GAIN = 0.97


class Unmet(ValueError):
    """No candidate keeps to a tolerance, or the written module does not; the message names the best there is.

    >>> plan({"material": [{"name": "frost", "quantity": "lambda_ggx", "alpha": [0.1, 0.5], "tolerance": 1e-18}]})
    Traceback (most recent call last):
    ...
    xsec_sym.planner.planning.Unmet: frost: ...
    """


@dataclass(frozen=True)
class Rejected:
    """A method turned down; error: None where it was not looked at."""

    method: str
    error: float | None
    ns_per_value: float | None
    reason: str


@dataclass(frozen=True)
class PlannedMaterial:
    """What was chosen for a material; errors are relative or absolute, as its tolerance is.

    model: what is computed, the quantity itself or another in its place. expected_error: the largest known, with the
    margin; found_error: that of the written module at `points` fresh points. ns_general: the general kernel's time.

    >>> scene = {"material": [{"name": "frost", "quantity": "lambda_ggx", "alpha": 0.5, "tolerance": 1e-6}]}
    >>> chosen = plan(scene).materials[0]
    >>> chosen.name, chosen.quantity, chosen.found_error < 1e-6, len(chosen.rejected) > 0
    ('frost', 'lambda_ggx', True, True)
    """

    material: Material
    method: str
    source: str
    model: str
    expected_error: float
    found_error: float
    ns_per_value: float
    ns_general: float
    points: int
    rejected: tuple[Rejected, ...]

    @property
    def name(self) -> str:
        return self.material.name

    @property
    def function(self) -> str:
        return self.material.function

    @property
    def quantity(self) -> str:
        return self.material.quantity.name

    def as_dict(self) -> dict[str, Any]:
        return {
            "name": self.name,
            "function": self.function,
            "quantity": self.quantity,
            "method": self.method,
            "model": self.model,
            "source": self.source,
            "tolerance": self.material.tolerance,
            "error": self.material.error,
            "dtype": self.material.dtype,
            "expected_error": _short(self.expected_error),
            "found_error": _short(self.found_error),
            "points": self.points,
            "ns_per_value": _short(self.ns_per_value),
            "ns_general": _short(self.ns_general),
            "rejected": [
                {
                    "method": r.method,
                    "error": _short(r.error),
                    "ns_per_value": _short(r.ns_per_value),
                    "reason": r.reason,
                }
                for r in self.rejected
            ],
        }


@dataclass(frozen=True)
class Plan:
    """The choices for a scene, and `source`, the text of the module with a function for each material.

    >>> made = plan({"material": [{"name": "frost", "quantity": "lambda_ggx", "alpha": 0.5, "tolerance": 1e-6}]})
    >>> "def frost(u" in made.source
    True
    """

    scene: Scene
    materials: tuple[PlannedMaterial, ...]
    source: str = field(repr=False)

    def write(self, path: str | Path) -> Path:
        """Write the module, whole or not at all."""
        from xsec_sym.record.files import writing as opened

        with opened(path) as out:
            out.write(self.source)
        return Path(path)

    def as_dict(self) -> dict[str, Any]:
        """What `--json` writes."""
        return {"scene": self.scene.name, "materials": [m.as_dict() for m in self.materials]}

    def lines(self) -> list[str]:
        return told.lines(self)

    def __str__(self) -> str:
        return "\n".join(self.lines())

    def _repr_html_(self) -> str:
        return told.html(self)


def plan(scene: str | Path | Mapping[str, Any] | Scene, measure: bool = False, tick: Tick = lambda said: None) -> Plan:
    """The cheapest kernels that keep to a scene's tolerances, written as one module and checked.

    scene: the path of a TOML file, a dictionary with its keys, or a `Scene`. measure: time and measure every method of
    the scene's quantities on this machine, which takes minutes, instead of using the stored measurements. tick: is
    called with what is being done.

    Raises `BadScene` for a scene that is not understood, `Unmet` where nothing keeps to a tolerance.

    >>> scene = {"material": [{"name": "matt", "quantity": "sigma_spherical_gaussian", "alpha": 2, "tolerance": 1e-3}]}
    >>> chosen = plan(scene).materials[0]
    >>> chosen.function, chosen.method, chosen.found_error < chosen.expected_error < 1e-3
    ('matt', 'harmonics to l = 2', True)
    """
    if not isinstance(scene, Scene):
        scene = Scene.of(scene) if isinstance(scene, Mapping) else Scene.load(scene)
    data, costs = _measurements(scene, measure, tick)
    chosen: list[tuple[Candidate, float, Candidate, list[Rejected], Points]] = []
    for material in scene.materials:
        tick(material.name)
        chosen.append(_chosen(material, data[material.quantity.name], costs))
    source = writing.module(
        [c for c, *_ in chosen], [e for _, e, *_ in chosen], [g.ns for _, _, g, *_ in chosen], scene.name
    )
    module = loaded(source)
    planned = []
    for candidate, error, kernel, rejected, fresh in chosen:
        found = checked(module, candidate.material, fresh)
        if not found <= candidate.material.tolerance:
            raise Unmet(f"{candidate.material.name}: the written module is off by {found:.2g}, by {candidate.name}")
        planned.append(
            PlannedMaterial(
                candidate.material,
                candidate.name,
                candidate.source,
                candidate.model,
                error,
                found,
                candidate.ns,
                kernel.ns,
                len(fresh),
                tuple(rejected),
            )
        )
    return Plan(scene, tuple(planned), source)


def _measurements(scene: Scene, measure: bool, tick: Tick) -> tuple[dict[str, Any], dict[str, Any] | None]:
    from xsec_sym.planner import tables
    from xsec_sym.study import files

    data: dict[str, Any] = {}
    for name in dict.fromkeys(m.quantity.name for m in scene.materials):
        if measure:
            data[name] = files.measured(name, tick=lambda said, of=name: tick(f"{of}: {said}"))  # type: ignore[misc]
            continue
        try:
            data[name] = files.stored(name)
        except files.Unmeasured as error:
            raise BadScene(str(error)) from None
    if measure:
        tick("tables")
    return data, tables.measured() if measure else None


def steps(scene: Scene, measure: bool) -> int:
    """How often `plan` says what it begins."""
    from xsec_sym.study import files

    quantities = {m.quantity.name for m in scene.materials} if measure else set()
    return len(scene.materials) + measure + sum(map(files.steps, quantities))


def _chosen(
    material: Material, data: Mapping[str, Any], costs: dict[str, Any] | None
) -> tuple[Candidate, float, Candidate, list[Rejected], Points]:
    try:
        every = candidates(material, data, costs)
        kernel = general(registered(material.quantity.name), material, data)
    except Stale as stale:
        raise BadScene(str(stale)) from None
    probes, fresh = points(material, PROBE_SEED, PROBES), points(material, FRESH_SEED, FRESH)
    rejected: list[Rejected] = []
    best: tuple[float, str] | None = None
    chosen: tuple[Candidate, float] | None = None
    for candidate in _with_kernel_first(every, kernel):
        why, error = _judged(material, candidate, probes, fresh, chosen)
        if not why:
            chosen = (candidate, error or 0.0)
            continue
        rejected.append(Rejected(candidate.name, error, None if math.isnan(candidate.ns) else candidate.ns, why))
        if error is not None and (best is None or error < best[0]) and not why.startswith(_UNWRITABLE):
            best = (error, candidate.name)
    if chosen is None:
        told_best = f"the best is {best[1]}, with {best[0]:.2g}" if best else "nothing can be written"
        raise Unmet(
            f"{material.name}: tolerance: nothing keeps to a {material.error} error of {material.tolerance:g} in "
            f"{material.dtype}, a margin of {MARGIN:g} included; {told_best}"
        )
    return *chosen, kernel, rejected, fresh


_UNWRITABLE = ("takes one", "needs", "is for", "cannot")


def _with_kernel_first(every: list[Candidate], kernel: Candidate) -> list[Candidate]:
    """The cheapest first; what is hardly cheaper than the general kernel comes after it."""

    def cost(candidate: Candidate) -> tuple[bool, float]:
        hardly = GAIN * kernel.cost < candidate.cost < kernel.cost
        return (math.isnan(candidate.cost), kernel.cost * (1 + 1e-12) if hardly else candidate.cost)

    return sorted(every, key=cost)


def _judged(
    material: Material,
    candidate: Candidate,
    probes: Points,
    fresh: Points,
    chosen: tuple[Candidate, float] | None,
) -> tuple[str, float | None]:
    """Why a candidate is turned down, or nothing, and its error; with the margin where it is not."""
    if why := writing.reason_not_to_write(candidate):
        return why, candidate.error
    if chosen is not None:
        off = candidate.error is not None and not candidate.error <= material.tolerance
        return f"slower than {chosen[0].name}" + ", and its error is too large" * off, candidate.error
    # cells are wider than the ranges, so that what fails there may be right here; and their points are few
    error = max(candidate.least, largest(material, candidate.values(probes.columns), probes))
    if not MARGIN * error <= material.tolerance:
        return "its error is too large", error
    if candidate.error is not None and MARGIN * candidate.error <= material.tolerance:
        error = max(error, candidate.error)
    module = loaded(writing.module([candidate], [error], [math.nan], material.name))
    found = checked(module, material, fresh)
    if not found <= material.tolerance:
        return "its error is too large at fresh points", found
    return "", MARGIN * error


def loaded(source: str) -> Any:
    """The module of this text, from a file of its own. Raises `Unmet` if it needs more than NumPy and SciPy."""
    if more := writing.foreign(source):
        raise Unmet(f"the written module imports {', '.join(more)}")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "planned_kernels.py"
        path.write_text(source, encoding="utf-8")
        spec = importlib.util.spec_from_file_location("planned_kernels", path)
        assert spec is not None and spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    return module


def checked(module: Any, material: Material, at: Points) -> float:
    """The largest error of the written function; infinite where its type is not the scene's."""
    found = getattr(module, material.function)(*material.inputs(at.columns))
    if found.dtype != np.dtype(material.dtype):
        return math.inf
    return largest(material, np.broadcast_to(found, at.high.shape), at)


def _short(value: float | None) -> Any:
    if value is None or value != value:
        return None
    return "inf" if math.isinf(value) else float(f"{value:.3g}")
