"""The cross-section of any axisymmetric NDF, by quadrature over Dirac rings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from html import escape

import numpy as np

from xsec_sym.kernels._support import real_array, result_dtype
from xsec_sym.kernels.dirac_ring import BARELY, barely_lit, partly_lit

EPS = np.finfo(float).eps
ORDER = 20
# From the edge of a panel to its outermost node, in halves of its width.
GAP = 1e-12
DEPTH = 40
# Past this many panels for one direction the ndf is noise to the quadrature, and the error estimate says so.
MOST_PANELS = 3000
# Directions integrated together: enough to fill vectors, few enough for the nodes to stay in cache.
TOGETHER = 64
# Cosines are graded toward a pole in steps of a factor 2. Past 2^-36 the rounding of x costs more digits than a
# geometric continuation, and the exponent of a singularity is read where 1 - x is a power of 2, free of rounding.
GRADES = 36
PROBES = np.exp2(-np.arange(40.0, 53.0))
# Angles at which the density is looked at for peaks and gaps that the nodes of panels might miss; and how many of the
# sharpest are cut out, or a density that oscillates would be cut at every turn.
LOOKS, MOST_CUTS = 2**13, 64


@cache
def _chebyshev() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Nodes on [-1, 1], weights (Clenshaw-Curtis), and the map from values to the last four Chebyshev coefficients."""
    k = np.arange(ORDER + 1)
    angles = np.pi * np.outer(k, k) / ORDER
    ends = np.where((k == 0) | (k == ORDER), 0.5, 1.0)
    coefficients = 2.0 / ORDER * ends[:, None] * np.cos(angles) * ends
    moments = np.where(k % 2, 0.0, 2.0 / (1.0 - np.where(k % 2, 0, k) ** 2))
    # The outermost nodes see a jump anywhere in the panel, but not one at its edge, where breakpoints are put.
    nodes = np.cos(angles[1])
    nodes[[0, -1]] *= 1.0 - GAP
    return nodes, moments @ coefficients, coefficients[-4:].T


class _Sums:
    """Integrals over a number of `owners`, each made of panels."""

    def __init__(self, owners: int, offset: np.ndarray | float):
        self.offset = offset
        self.value = np.zeros(owners)
        self.size = np.zeros(owners)
        self.error = np.zeros(owners)
        self.panels = np.zeros(owners, int)

    def add(self, owner: np.ndarray, value: np.ndarray, size: np.ndarray, error: np.ndarray) -> None:
        for total, part in ((self.value, value), (self.size, size), (self.error, error)):
            total += np.bincount(owner, part, minlength=total.size)

    def tolerance(self, rtol: float, owner: np.ndarray, value: np.ndarray, size: np.ndarray) -> np.ndarray:
        """What a panel may be off by, given the panels not yet added."""
        value = self.offset + self.value + np.bincount(owner, value, minlength=self.value.size)
        return np.maximum(rtol / 16 * np.abs(value), EPS * self.all_size(owner, size))

    def all_size(self, owner: np.ndarray, size: np.ndarray) -> np.ndarray:
        return self.size + np.bincount(owner, size, minlength=self.size.size)


def _adaptive(
    rule: Callable,
    left: np.ndarray,
    right: np.ndarray,
    owner: np.ndarray,
    owners: int,
    rtol: float,
    offset: np.ndarray | float = 0.0,
) -> _Sums:
    """Integrate; `rule(left, right, owner)` gives value, size (of |integrand|), error and rounding error by panel.

    Panels are halved until their error is small. One that is not at the last depth counts in full as error, and as
    infinite where so narrow a panel still matters. `offset` is what the caller adds to the value: the tolerance is
    relative to the sum.
    """
    sums = _Sums(owners, offset)
    for depth in range(DEPTH + 1):
        value, size, error, noise = rule(left, right, owner)
        # Rounding excuses no error before the panel is resolved: its estimate is as rough as the panel.
        floor = np.minimum(noise, 1e-3 * size) + 8 * EPS * size
        sums.panels += np.bincount(owner, minlength=owners)
        good = error <= np.maximum(sums.tolerance(rtol, owner, value, size)[owner], floor)
        deepest = ~good & (depth == DEPTH)
        closed = good | deepest | (sums.panels > MOST_PANELS)[owner]
        error = error + noise + 8 * EPS * size + np.where(deepest, size, 0.0)
        value = np.where(deepest & (size > 1e-3 * sums.all_size(owner, size)[owner]), np.copysign(np.inf, value), value)
        sums.add(owner[closed], value[closed], size[closed], error[closed])
        left, right, owner = left[~closed], right[~closed], owner[~closed]
        if not owner.size:
            break
        middle = 0.5 * (left + right)
        left, right, owner = np.r_[left, middle], np.r_[middle, right], np.r_[owner, owner]
    sums.error[~np.isfinite(sums.value)] = np.inf
    return sums


def _dark(root_d: np.ndarray, a: np.ndarray) -> np.ndarray:
    d = root_d * root_d
    return np.where(d < BARELY * a * a, barely_lit(d, -a), partly_lit(d, -a))


def _nodes(left: np.ndarray, right: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    half_width = 0.5 * (right - left)[:, None]
    return 0.5 * (left + right)[:, None] + half_width * _chebyshev()[0], half_width


class CrossSection:
    """The cross-section of one NDF as a function of u; made by `cross_section`.

    u: cosine in [-1, 1], of any shape; anything else, NaN included, gives NaN.

    >>> sigma = cross_section(lambda x: x**2)
    >>> sigma([-1, 0, 1]).round(12)
    array([1.57079633, 0.78539816, 1.57079633])
    """

    def __init__(self, ndf: Callable, rtol: float, breakpoints: Sequence[float]):
        if not callable(ndf):
            raise TypeError(f"ndf must be a function of x = cos(theta), not {type(ndf).__name__}")
        if not 0.0 < rtol < 1.0:
            raise ValueError(f"rtol must lie between 0 and 1, not {rtol}")
        self.ndf, self.rtol = ndf, rtol
        self.breakpoints = np.unique(real_array("breakpoints", breakpoints).astype(float))
        if not (np.abs(self.breakpoints) <= 1.0).all():
            raise ValueError("breakpoints must be cosines in [-1, 1]")
        self._vectorised = self._takes_arrays()
        self._cuts = np.union1d(self.breakpoints, self._turns())
        # What a fully lit ring adds: 2 pi u x D for x of the sign of u. At u = 0 there is none.
        self._lit = {sign: self._hemisphere(sign, np.abs, 1.0) for sign in (1.0, -1.0)}
        sides = [self._hemisphere(sign, lambda x: 2.0 * np.sqrt((1.0 - x) * (1.0 + x)), 1.5) for sign in (1.0, -1.0)]
        self._edge_on = (sides[0][0] + sides[1][0], sides[0][1] + sides[1][1])

    def __call__(self, u: np.typing.ArrayLike) -> np.ndarray | np.floating:
        """sigma(u), in projected area; NaN outside [-1, 1], infinite where the integral diverges."""
        return self.estimate(u)[0]

    def estimate(self, u: np.typing.ArrayLike) -> tuple[np.ndarray | np.floating, np.ndarray | np.floating]:
        """sigma(u) and an estimate of its absolute error, which is infinite where sigma is."""
        array = real_array("u", u)
        dtype = result_dtype({"u": u})
        cosine = array.astype(float).ravel()
        value, error = np.full_like(cosine, np.nan), np.full_like(cosine, np.nan)
        with np.errstate(all="ignore"):
            for sign in (1.0, -1.0):
                side = (sign * cosine > 0.0) & (np.abs(cosine) <= 1.0)
                total, total_error = self._lit[sign]
                value[side] = 2.0 * np.pi * np.abs(cosine[side]) * total
                error[side] = 2.0 * np.pi * np.abs(cosine[side]) * total_error
            value[cosine == 0.0], error[cosine == 0.0] = self._edge_on
            inside = np.flatnonzero(np.isfinite(value) & (cosine != 0.0) & (np.abs(cosine) < 1.0))
            for start in range(0, inside.size, TOGETHER):
                chosen = inside[start : start + TOGETHER]
                sums = self._partly_lit(np.abs(cosine[chosen]), value[chosen])
                value[chosen] += sums.value
                error[chosen] += sums.error
            error += np.finfo(dtype).eps * np.abs(value) + np.finfo(dtype).tiny
            value, error = value.astype(dtype), error.astype(dtype)
        return value.reshape(array.shape)[()], error.reshape(array.shape)[()]

    def _partly_lit(self, u: np.ndarray, lit: np.ndarray) -> _Sums:
        """The integral of D(x) dark(u, x) for |x| < s = sqrt(1 - u^2), by x = s cos(phi), which leaves no root."""
        s = np.sqrt((1.0 - u) * (1.0 + u))

        def rule(left, right, owner):
            S, U = s[owner, None], u[owner, None]
            phi, width = _nodes(left, right)
            root_d, x = S * np.sin(phi), S * np.cos(phi)
            return self._panel(x, width * root_d * _dark(root_d, U * np.abs(x)))

        inner = np.arccos(np.clip(self._cuts / s[:, None], -1.0, 1.0))
        regular = np.broadcast_to(np.linspace(0.0, np.pi, 9), (u.size, 9))
        edges = np.sort(np.concatenate([regular, inner], axis=1), axis=1)
        owner = np.repeat(np.arange(u.size), edges.shape[1] - 1)
        left, right = edges[:, :-1].ravel(), edges[:, 1:].ravel()
        some = right > left
        return _adaptive(rule, left[some], right[some], owner[some], u.size, self.rtol, lit)

    def _panel(self, x: np.ndarray, weight: np.ndarray) -> tuple[np.ndarray, ...]:
        x = np.clip(x, EPS / 2 - 1.0, 1.0 - EPS / 2)
        D = self._density(x)
        _, rule, tail = _chebyshev()
        f = D * weight
        # A smooth integrand is integrated far better than its last coefficients are small; but those of a jump are
        # never small, wherever it lies, while two rules may agree on it by luck. Those of D show a jump beside an
        # edge where the weight vanishes.
        error = np.maximum(np.abs(f @ tail).sum(axis=1), np.abs(D @ tail).sum(axis=1) * (np.abs(weight) @ rule))
        # x is known to half an ulp, which a steep D turns into an error of its own.
        slope = np.abs(np.diff(D, axis=1)) / np.maximum(np.abs(np.diff(x, axis=1)), EPS / 4)
        steepest = np.maximum(np.pad(slope, ((0, 0), (1, 0))), np.pad(slope, ((0, 0), (0, 1))))
        noise = EPS * (steepest * np.abs(x * weight)) @ rule
        # A jump between an edge and its node is not seen.
        return f @ rule, np.abs(f) @ rule, error, noise + GAP * (np.abs(f[:, 0]) + np.abs(f[:, -1]))

    def _turns(self) -> np.ndarray:
        """Cosines on either side of where the density stops rising or falling: a peak is then within a panel that is
        as narrow, and its neighbours have nodes near its feet.
        """
        x = np.cos((np.arange(LOOKS) + 0.5) * (np.pi / LOOKS))
        D = self._density(x, poles=True)
        with np.errstate(all="ignore"):
            rise, size = np.diff(D), np.abs(D)
            bend = np.abs(np.diff(rise)) / (size[:-2] + size[1:-1] + size[2:])
            # Rounding errors make bends as well.
            turn = (np.sign(rise[1:]) * np.sign(rise[:-1]) <= 0.0) & (bend > 1e-8) & np.isfinite(bend)
        # Panels have an edge at 0 anyway.
        turn[LOOKS // 2 - 2 : LOOKS // 2] = False
        turns = np.flatnonzero(turn)
        chosen = turns[np.argsort(-bend[turns], kind="stable")[:MOST_CUTS]]
        return x[np.r_[chosen, chosen + 2]]

    def _hemisphere(self, sign: float, weigh: Callable, exponent: float) -> tuple[float, float]:
        """The integral of weigh(x) D(x) over the hemisphere x sign > 0, and its error.

        `exponent` is the growth of D toward the pole, as a power of 1/(1 - |x|), from which on it is infinite.
        """
        near = self._density(sign * (1.0 - PROBES), poles=True)
        with np.errstate(all="ignore"):
            growth = np.diff(np.log2(np.abs(near)))[-2:]
            steps = -np.log2(PROBES[-2:])
            # A logarithm beside a power shows as an exponent that drifts like 1/log(1 - x).
            drift = (steps[1] * growth[1] - steps[0] * growth[0]) / (steps[1] - steps[0])
        singular = growth[1] > exponent - 0.2 and max(growth[1], drift) > exponent - 4e-3
        if singular or not np.isfinite(near).all():
            return float(np.copysign(np.inf, near[-1])), np.inf

        grades = sign * (1.0 - np.append(np.exp2(-np.arange(GRADES + 1.0)), EPS / 2))
        cuts = self._cuts[self._cuts * sign > 0.0]
        edges = np.unique(np.clip(np.r_[grades, cuts], *sorted((grades[0], grades[-1]))))
        # The middle of the narrowest panel rounds to its edge at 0.
        owner = np.searchsorted(sign * grades, sign * 0.5 * (edges[1:] + edges[:-1]), side="right") - 1

        def rule(left, right, _):
            x, width = _nodes(left, right)
            return self._panel(x, width * weigh(x))

        with np.errstate(all="ignore"):
            sums = _adaptive(rule, edges[:-1], edges[1:], owner, GRADES + 1, self.rtol)
            *graded, direct = sums.value
            ratios = np.divide(graded[-2:], graded[-3:-1])
            continued = graded[-1] * ratios / (1.0 - ratios)
        total, error = float(np.sum(graded)), float(np.sum(sums.error[:-1]))
        doubt = abs(continued[1] - direct)
        if not ((ratios > 0.0) & (ratios < 1.0)).all():
            return total + direct, error + abs(direct)
        return total + continued[1], error + 4 * abs(np.diff(continued)[0]) + (
            doubt if doubt > 0.1 * abs(direct) else 0
        )

    def __repr__(self) -> str:
        return f"<CrossSection of {getattr(self.ndf, '__name__', type(self.ndf).__name__)}, rtol = {self.rtol:g}>"

    def _repr_html_(self) -> str:
        """A few values with their errors, for Jupyter."""
        views = np.array([-1.0, -0.5, 0.0, 0.5, 1.0])
        found = np.stack([views, *self.estimate(views)], axis=1)
        rows = "".join(f"<tr><td>{u:g}</td><td>{value:.10g}</td><td>{error:.1g}</td></tr>" for u, value, error in found)
        return f"<b>{escape(repr(self))}</b><table><tr><th>u</th><th>sigma</th><th>error</th></tr>{rows}</table>"

    def _takes_arrays(self) -> bool:
        probe = np.array([-0.6, -0.1, 0.3, 0.7])
        try:
            with np.errstate(all="ignore"):
                return np.shape(self.ndf(probe.copy())) == probe.shape
        except Exception:
            # A function of one number fails on an array in its own ways; on one number it must not.
            return False

    def _density(self, x: np.ndarray, poles: bool = False) -> np.ndarray:
        with np.errstate(all="ignore"):
            if self._vectorised:
                D = np.asarray(self.ndf(x.copy()))
            else:
                try:
                    D = np.asarray([self.ndf(one) for one in x.ravel().tolist()])
                except Exception as error:
                    raise ValueError(f"ndf fails on a number in [-1, 1]: {error}") from error
                D = D.reshape(x.shape) if D.size == x.size else D
        if D.shape != x.shape:
            raise ValueError("ndf must return one value for each x")
        if D.dtype.kind not in "buif":
            raise TypeError(f"ndf must return real numbers, not {D.dtype}")
        D = D.astype(float)
        if np.isnan(D).any() or not (poles or np.isfinite(D).all()):
            raise ValueError("ndf must return finite values inside (-1, 1)")
        return D


def cross_section(ndf: Callable, *, rtol: float = 1e-10, breakpoints: Sequence[float] = ()) -> CrossSection:
    """The cross-section of any axisymmetric NDF, as a function sigma(u) with `sigma.estimate(u)` -> (value, error).

    sigma(u) is the integral of D(omega) max(0, omega . omega_i) over the sphere, u the cosine between omega_i and the
    axis. It is computed as the integral over x in [-1, 1] of D(x) times the cross-section of the Dirac ring at x
    (`deon2016:8.piecewise`), cut where a ring begins and ends to be fully lit. The ring lemma's other form, with the
    moments of x D and |x| D beside an integral over slices, says the same, but for u < 0 it subtracts nearly equal
    numbers where D is peaked, while here every term has the sign of D and the dark side keeps its digits.

    ndf: D(x) per steradian at x = cos(theta) in (-1, 1), for an array or for one number; it may grow without bound
    toward the poles only. Where it does so too fast, sigma is infinite on that side and is returned as inf; so are
    integrals that converge more slowly than a growth of (1 - |x|)^-0.995, and those of a density that still grows like
    a non-integrable power at the last cosines below 1, for no double can tell them apart.
    D may be negative: sigma is then that of its positive part less that of its negative one.
    rtol: the relative error aimed at. breakpoints: cosines where D jumps or has a narrow peak away from the poles. A
    jump is found anyway, more slowly, and so is a peak or a gap of 0.0005 or wider; a narrower one may be missed, and
    no error tells.

    The error is absolute, an estimate and no bound; it is large where the aim was missed. u of any shape; NaN outside
    [-1, 1]; float32 for float32. TypeError where ndf is no function or returns no real numbers; ValueError where it
    fails, returns another shape than that of x, or is not finite, and for rtol or breakpoints out of range.

    >>> sigma = cross_section(lambda x: 1 / (1 + x))
    >>> sigma([-0.5, 0, 1])
    array([       inf, 6.28318531, 1.92801313])
    >>> value, error = sigma.estimate(1.0)
    >>> bool(abs(value - 2 * np.pi * (1 - np.log(2))) <= error < 1e-10)
    True
    """
    return CrossSection(ndf, rtol, breakpoints)
