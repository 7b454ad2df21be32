"""How a claim about a quantity is judged that only a solver gives: at many points, and by two methods that must agree.

No enclosure is to be had, so that nothing is proved here. An error is the largest one *found*, on a grid that crowds
where the claim says and again and again around the worst point. Two methods must agree on every value that is used, to
`AGREED` digits at least; what they disagree by is counted against the claim.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import product
from math import floor, log10
from typing import TYPE_CHECKING, Any

import numpy as np
from sympy import Expr, Symbol, sympify

from xsec_sym.exact.solved import heads
from xsec_sym.proof.accuracy import Measure, T
from xsec_sym.proof.domain import Interval
from xsec_sym.proof.mutants import mutants
from xsec_sym.proof.say import said
from xsec_sym.proof.values import ROUTES, Array, NoValues, compiled
from xsec_sym.proof.verdict import Verdict

if TYPE_CHECKING:
    from xsec_sym.proof.claim import Claim

AGREED = 10
MUTANTS = 8
UNSTATED = 10  # times its own error is what a form may miss by where the source states no accuracy
GRID = {1: (241,), 2: (61, 61), 3: (17, 17, 17), 4: (9, 9, 9, 9)}
# rounds of points around the worst, and how many each way: no nearer to an end than a solver can bear
ROUNDS, AROUND = {1: 3, 2: 4, 3: 4, 4: 4}, {1: 9, 2: 5, 3: 3, 4: 3}
OPEN = 2.0**-12  # how near to an end that does not belong to the domain, as a share of its length in t


class Unmeasured(ArithmeticError):
    """The claim cannot be judged; the message says why in one sentence."""


def judged(claim: Claim, seed: int = 0) -> Verdict:
    """The verdict on a measured claim; the points depend on ``seed``."""
    try:
        return _judged(claim, seed)
    except (Unmeasured, NoValues) as reason:
        return Verdict("inconclusive", note=str(reason))


@dataclass
class _Points:
    """Points in t, the claim's variables at them, and the left side by both routes."""

    t: Array
    given: list[Array]
    left: list[Array]


@dataclass
class _Errors:
    """The error of one form: its largest value, where, and by how much the routes leave it open."""

    size: float
    point: dict[Symbol, float]
    left: float
    right: float
    slack: float
    share: float


@dataclass
class _Bench:
    claim: Claim
    seed: int
    maps: list[Any] = field(default_factory=list)
    ends: list[tuple[float, float]] = field(default_factory=list)
    sets: list[_Points] = field(default_factory=list)
    scale: float = 1.0
    typical: float = 1.0
    digits: int = 0

    def __post_init__(self) -> None:
        domain, measure = self.claim.domain, self.claim.measure
        assert measure is not None
        ranges = [v for v in domain.variables if isinstance(v, Interval)]
        if domain.conditions or not ranges or len(ranges) < len(domain.variables):
            raise Unmeasured("only ranges of real variables can be measured")
        self.symbols = domain.symbols
        self.relative, self.exact = measure.relative, measure.exact
        along = dict(measure.along)
        for v in ranges:
            expr = along.get(v.symbol, v.low + (v.high - v.low) * T)
            ends = {sympify(expr).subs(T, e) for e in (0, 1)}
            if ends != {v.low, v.high}:
                raise Unmeasured(f"the points for {v.symbol} do not run over its whole range")
            # an open end may be at either end of t
            low_first = sympify(expr).subs(T, 0) == v.low
            opened = (v.low_open, v.high_open) if low_first else (v.high_open, v.low_open)
            self.maps.append((compiled(expr, [T], 0), OPEN if opened[0] else 0.0, 1 - OPEN if opened[1] else 1.0))
            self.ends.append((float(v.low), float(v.high)))
        self.left = [compiled(self.claim.left, self.symbols, route) for route in ROUTES]
        self._add(self._grid())

    # --- points -----------------------------------------------------------------------------------------

    def _grid(self) -> Array:
        sizes = GRID.get(len(self.maps))
        if sizes is None:
            raise Unmeasured(f"{len(self.maps)} variables are too many")
        random, axes = np.random.default_rng(self.seed), []
        for n, (_, first, last) in zip(sizes, self.maps, strict=True):
            inner = (np.arange(1, n - 1) + random.uniform(-0.4, 0.4, n - 2)) / (n - 1)
            axes.append(np.concatenate([[first], inner, [last]]))
        return np.array(list(product(*axes))).T

    def _add(self, t: Array) -> _Points:
        given = [np.clip(run([x]), *ends) for (run, _, _), ends, x in zip(self.maps, self.ends, t, strict=True)]
        left = [run(given) for run in self.left]
        if not all(np.isfinite(v).all() for v in (*given, *left)):
            bad = int(np.argmin(np.isfinite(np.array([*given, *left])).all(axis=0)))
            raise Unmeasured(f"a method has no value at {self.shown(self._at(given, bad))}")
        points = _Points(t, given, left)
        self.sets.append(points)
        if len(self.sets) == 1:
            self.typical = max(float(np.median(abs(left[0]))), 1e-300)
        self.scale = max(self.scale if len(self.sets) > 1 else 0.0, float(abs(left[0]).max()))
        self._agree()
        return points

    def _agree(self) -> None:
        """To how many digits both routes agree, where they agree least."""
        worst = 0.0
        for points in self.sets:
            first, second = points.left
            over = self._over(first, second)
            with np.errstate(all="ignore"):
                gap = np.where(first == second, 0.0, abs(first - second) / over)
            worst = max(worst, float(gap.max()))
        self.digits = 15 if worst == 0 else min(15, floor(-log10(worst)))
        if not worst < 10.0**-AGREED:
            raise Unmeasured(f"the two methods agree on {max(self.digits, 0)} digits only")

    def _over(self, first: Array, second: Array) -> Any:
        """What a difference is taken over: the larger value, or a typical one where both vanish; where errors are
        absolute, the largest value of all."""
        if not (self.relative or self.exact):
            return self.scale
        return np.maximum(np.maximum(abs(first), abs(second)), 1e-3 * self.typical if self.exact else 0.0)

    def refine(self, t: Array, width: float) -> None:
        """More points around one."""
        n = AROUND[len(self.maps)]
        axes = [np.clip(x + width * np.linspace(-1, 1, n), a, b) for x, (_, a, b) in zip(t, self.maps, strict=True)]
        self._add(np.array(list(product(*axes))).T)

    @property
    def count(self) -> int:
        return sum(p.t.shape[1] for p in self.sets)

    # --- errors -----------------------------------------------------------------------------------------

    def errors(self, form: Expr, *, partial: bool = False, tolerance: float | None = None) -> _Errors | None:
        """Of a form, over all points; None where it has no value somewhere, or with ``partial`` nowhere."""
        runs = [compiled(form, self.symbols, route) for route in ROUTES[: 2 if heads(form) else 1]]
        best: _Errors | None = None
        slack, below, seen = 0.0, 0, 0
        for points in self.sets:
            rights = [run(points.given) for run in runs]
            sizes = np.array([self._size(left, right) for left, right in product(points.left, rights)])
            finite = np.isfinite(sizes).all(axis=0)
            if not finite.all() and not partial:
                return None
            if not finite.any():
                continue
            size = np.where(finite, sizes.max(axis=0), -1.0)
            with np.errstate(all="ignore"):
                spread = np.where(finite, sizes.max(axis=0) - sizes.min(axis=0), 0.0)
            slack = max(slack, float(spread.max()))
            k = int(size.argmax())
            if tolerance is not None and points is self.sets[0]:
                below, seen = below + int((size[finite] <= tolerance).sum()), seen + int(finite.sum())
            if best is None or size[k] > best.size:
                best = _Errors(float(size[k]), self._at(points.given, k), float(points.left[0][k]),
                               float(rights[0][k]), 0.0, 0.0)  # fmt: skip
                self.worst = points.t[:, k]
        if best is not None:
            best.slack, best.share = slack, below / seen if seen else 0.0
        return best

    def _size(self, left: Array, right: Array) -> Array:
        with np.errstate(all="ignore"):
            gap = abs(right - left)
            if self.exact:
                return gap / self._over(left, right)
            return gap / abs(left) if self.relative else gap

    def searched(self, form: Expr, *, partial: bool = False) -> _Errors:
        """The largest error that can be found."""
        found = self.errors(form, partial=partial)
        width = 1.5 / (GRID[len(self.maps)][0] - 1)
        for _ in range(ROUNDS[len(self.maps)]):
            if found is None:
                break
            self.refine(self.worst, width)
            width *= 2 / (AROUND[len(self.maps)] - 1)
            found = self.errors(form, partial=partial)
        if found is None:
            raise Unmeasured(f"{said(form)} has no value at some of the points")
        return found

    def _at(self, given: Sequence[Array], k: int) -> dict[Symbol, float]:
        return {s: float(g[k]) for s, g in zip(self.symbols, given, strict=True)}

    @staticmethod
    def shown(point: dict[Symbol, float]) -> dict[str, str]:
        return {str(s): f"{v:.9g}" for s, v in point.items()}


def _judged(claim: Claim, seed: int) -> Verdict:
    measure = claim.measure
    assert measure is not None
    bench = _Bench(claim, seed)
    mended = claim.corrected is not None and claim.printed is not None
    of_form = bench.searched(claim.form)
    of_print = bench.searched(claim.printed, partial=True) if mended and claim.printed is not None else None
    of_form = bench.errors(claim.form) or of_form  # over the points around the print's worst as well
    if measure.exact:
        tolerance, told = 10.0**-AGREED, "equal to the digits agreed on"
    elif measure.within is not None:
        tolerance, told = float(measure.within), f"{float(measure.within):.4g}"
    else:
        tolerance, told = UNSTATED * of_form.size, "no accuracy is stated: ten times the form's own error"
    again = bench.errors(claim.form, tolerance=tolerance)
    assert again is not None
    evidence: dict[str, Any] = {
        "enclosure": False,
        "methods": sorted({m for head in heads(claim.left) | heads(claim.form) for m in head.methods})
        or ["two quadratures"],
        "digits agreed on": bench.digits,
        "points": bench.count,
        "within": told,
        "relative": measure.relative,
        "largest error found": f"{of_form.size:.3g}",
        "at point": bench.shown(of_form.point),
    }
    holds = of_form.size + of_form.slack <= tolerance
    if not holds and not of_form.size - of_form.slack > tolerance:
        raise Unmeasured(f"the error found is {of_form.size:.6g}, too near to {told} to be told apart")
    witness = None
    if of_print is not None:
        if not of_print.size - of_print.slack > tolerance:
            raise Unmeasured("a correction is offered, but the print was not seen to miss the accuracy")
        evidence["error of the print"] = f"{of_print.size:.3g}"
        witness = _witness(bench, of_print)
    if not holds:
        evidence["share of the points within"] = f"{again.share:.3g}"
        witness = _witness(bench, of_form)
        if of_print is not None:
            return Verdict("inconclusive", witness=witness, evidence=evidence, note="the corrected form fails")
    killed = 0
    if holds or claim.kind == "accuracy":
        killed = _fooled(bench, claim, tolerance, measure.exact, evidence)
    word = _word(claim, measure, holds, of_print is not None)
    return Verdict(word, digits=bench.digits if measure.exact else None, witness=witness, evidence=evidence,
                   mutants=killed)  # fmt: skip


def _word(claim: Claim, measure: Measure, holds: bool, mended: bool) -> str:
    if not holds:
        return "claim-fails" if claim.kind in ("accuracy", "statement") else "refuted"
    if mended:
        return "misprint"
    return "confirmed" if measure.exact and claim.kind == "equation" else "claim-holds"


def _fooled(bench: _Bench, claim: Claim, tolerance: float, exact: bool, evidence: dict[str, Any]) -> int:
    """Try to fool the check with altered forms: how many miss the tolerance."""
    killed, near, equal = 0, 0, 0
    for rival in (-claim.form, 2 * claim.form) if claim.form != 0 else ():
        found = bench.errors(rival)
        if found is None or not found.size - found.slack > tolerance:
            raise Unmeasured(f"the check lets {said(rival)} pass")
    for rival in mutants(claim.form, list(claim.domain.symbols)):
        try:
            found = bench.errors(rival)
        except NoValues:
            continue
        if found is None:
            continue
        if found.size - found.slack > tolerance:
            killed += 1
        elif exact:
            if not _same(bench, rival, claim.form):
                raise Unmeasured(f"the check lets {said(rival)} pass")
            equal += 1
        else:
            near += 1
    if killed < MUTANTS:
        raise Unmeasured(f"only {killed} altered forms miss the tolerance")
    if near:
        evidence["altered forms that are as near"] = near
    if equal:
        evidence["mutants equal to the form"] = equal
    return killed


def _same(bench: _Bench, rival: Expr, form: Expr) -> bool:
    """Whether an altered form is the form itself, to rounding."""
    first, second = (compiled(e, bench.symbols, 0) for e in (rival, form))
    near = [np.allclose(first(p.given), second(p.given), rtol=1e-12, atol=1e-13 * bench.typical) for p in bench.sets]
    return all(near)


def _witness(bench: _Bench, error: _Errors) -> dict[str, Any]:
    return {"point": bench.shown(error.point), "left": f"{error.left + 0.0:.12g}", "right": f"{error.right + 0.0:.12g}"}


__all__ = ["AGREED", "judged"]
