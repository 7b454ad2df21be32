"""Quantities that only a solver gives: no enclosure is to be had, and two methods must agree instead.

Each class names two `routes`, functions of NumPy arrays that broadcast, and `methods`, what they are. Claims about them
are judged in `proof/measured.py`.
"""

from __future__ import annotations

from collections.abc import Callable
from math import factorial
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.special import spherical_jn
from sympy import Expr, Function
from sympy.printing.pretty.stringpict import prettyForm

from xsec_sym.exact import bond, three_terms
from xsec_sym.exact.three_terms import Array
from xsec_sym.proof.wire import register

Route = Callable[..., NDArray[np.float64]]


class Solved(Function):
    """A function that stands for what two independent solvers return."""

    routes: ClassVar[tuple[Route, Route]]
    methods: ClassVar[tuple[str, str]]
    symbol = ""

    def __init_subclass__(cls, **rest: Any) -> None:
        super().__init_subclass__(**rest)
        if cls.routes[0] is cls.routes[1]:
            raise TypeError(f"{cls.__name__} has one route only")

    @classmethod
    def eval(cls, *args: Any) -> None:
        return None

    def _latex(self, printer: Any, exp: Any = None) -> str:
        name, arguments = self._set()
        # in braces, as the name may have a superscript of its own
        head = name if exp is None else rf"{{{name}}}^{{{exp}}}"
        return rf"{head}\left({', '.join(printer._print(a) for a in arguments)}\right)"

    def _sympystr(self, printer: Any) -> str:
        name, arguments = self._set()
        return f"{_plain(name)}({', '.join(printer._print(a) for a in arguments)})"

    def _pretty(self, printer: Any) -> prettyForm:
        name, arguments = self._set()
        return prettyForm(*printer._print_seq(arguments, "(", ")", ", ").left(_plain(name)))

    def _set(self) -> tuple[str, tuple[Any, ...]]:
        """The name as LaTeX, and the arguments that are shown."""
        return self.symbol, self.args

    def _eval_is_real(self) -> bool:
        return True


def _plain(name: str) -> str:
    return name.translate(str.maketrans("", "", "{}\\"))


def _by_albedo(solve: Callable[..., Any], c: Any, *rest: Any) -> Array:
    """``solve(c, *rest)`` for arrays: once for each albedo that occurs."""
    c, *others = np.broadcast_arrays(np.asarray(c, dtype=np.float64), *rest)
    found = np.full(c.shape, np.nan)
    for value in np.unique(c[np.isfinite(c)]):
        here = c == value
        if 0 <= value <= 1:
            found[here] = solve(float(value), *(np.asarray(r, dtype=np.float64)[here] for r in others))
    return found


# --- the half-space with the three-term phase function --------------------------------------------------


def _h(solve: Callable[..., Array]) -> Route:
    return lambda order, mu, c: _by_albedo(lambda value, here: solve(int(order), here, value), c, mu)


@register
class HLambertSphere(Solved):
    """H^(m)(mu, c): the arguments are m = 0, 1, 2, the cosine mu >= 0 and the single-scattering albedo c in [0, 1].

    >>> from sympy import symbols, latex
    >>> mu, c = symbols("mu c")
    >>> latex(HLambertSphere(1, mu, c))
    'H^{(1)}\\\\left(\\\\mu, c\\\\right)'
    """

    routes = (_h(three_terms.by_equation), _h(three_terms.by_fock))
    methods = ("the nonlinear equation of H by Newton's method", "Fock's integral of log K")

    def _set(self) -> tuple[str, tuple[Any, ...]]:
        return f"H^{{({self.args[0]})}}", self.args[1:]


NAMES = (("A", "B", "C", "D", "E", "F"), ("l", "m"))


def _constants(solve: Callable[[int, float], Array]) -> Route:
    def at(order: int, index: int, c: float) -> Any:
        q = solve(int(order), c)
        if order == 1:
            return float(q[0, 1] / q[0, 0] if index == 0 else 2 * q[1, 1] ** 2 / 3)
        k, n = ((0, 0), (0, 1), (1, 1), (1, 2), (2, 2), (0, 2))[int(index)]
        return c / 2 * float(sum(abs(a) * q[l, k] * q[l, n] for l, a in enumerate(three_terms.FLIGHT)))

    return lambda order, index, c: _by_albedo(lambda value: at(order, index, value), c)


@register
class ModeConstant(Solved):
    """The constants of the modes in terms of c: the arguments are the order, the index and c.

    f^(0) = H H' / (2 pi (mu + mu')) (A + B (mu + mu') + C mu mu' + D mu mu' (mu + mu') + E (mu mu')^2 + F (mu^2 +
    mu'^2)) and f^(1) = c H H' / (3 pi (mu + mu')) sin sin' (1 + (l^2 + 45 m / 64) mu mu' + l (mu + mu')).

    >>> float(ModeConstant.routes[0](0, 0, 0.5).round(12))  # A = 69 c / 128
    0.26953125
    """

    routes = (_constants(three_terms.from_transport), _constants(three_terms.polynomials))
    methods = ("the transport equation over H from its nonlinear equation", "moments of H from Fock's integral")

    def _set(self) -> tuple[str, tuple[Any, ...]]:
        order, index, c = self.args
        return NAMES[int(order)][int(index)], (c,)


def _mode(transport: bool) -> Route:
    def at(order: int, c: float, mu_i: Array, mu_o: Array) -> Array:
        phis = []
        for cosines in (mu_i, mu_o):
            mu, place = np.unique(cosines, return_inverse=True)  # many pairs of few directions, under an integral
            if transport:
                solution = three_terms.transport(order, c)
                orders, phi = np.array(solution[0]), three_terms.anywhere(order, c, solution, mu)
            else:
                q = three_terms.polynomials(order, c)
                orders = np.arange(order, 3)
                outer = three_terms.by_fock(order, mu, c) * np.sqrt(1 - mu**2) ** order
                phi = outer * (q @ mu ** np.arange(3 - order)[:, None])
            phis.append(phi[:, place])
        weights = np.array(three_terms.FLIGHT)[orders] * (-1.0) ** orders
        scale = (1 if order == 0 else 2) * c / (4 * np.pi)
        return scale * np.einsum("l,ln,ln->n", weights, *phis) / (mu_i + mu_o)

    return lambda order, mu_i, mu_o, c: _by_albedo(lambda v, i, o: at(int(order), v, i, o), c, mu_i, mu_o)


@register
class ModeLambertSphere(Solved):
    """f^(m)(mu_i, mu_o, c), per steradian: the arguments are m and these; phi = 0 sends light back.

    >>> float(ModeLambertSphere.routes[0](0, 1.0, 1.0, 0.5).round(10))
    0.0600372688
    """

    routes = (_mode(True), _mode(False))
    methods = ("the transport equation in discrete directions and Newton's method", "H and moments of H")

    def _set(self) -> tuple[str, tuple[Any, ...]]:
        return f"f^{{({self.args[0]})}}", self.args[1:]


# --- the whole phase function ---------------------------------------------------------------------------


@register
class AlbedoLambertSphere(Solved):
    """The Bond albedo of a half-space with the single-scattering albedo c."""

    symbol = "k_d"
    routes = (bond.returned, lambda c: bond.returned(c, doubling=True))
    methods = ("discrete directions and a singular value decomposition", "layers that are doubled")


@register
class ParticleAlbedo(Solved):
    """The single-scattering albedo at which the half-space has the Bond albedo k_d."""

    symbol = "c"
    routes = (bond.particle, lambda k_d: bond.particle(k_d, doubling=True))
    methods = AlbedoLambertSphere.methods


def _rest(theta: Array) -> Array:
    """The share of the light that is scattered by less than theta."""
    x, series = np.minimum(theta, 0.5), np.zeros(np.shape(theta))
    for k in range(2, 14):  # where the closed form would cancel
        series += (-4.0) ** k * (2 * k - 2) / factorial(2 * k + 1) * x ** (2 * k + 1)
    closed = 2 * theta + theta * np.cos(2 * theta) - 1.5 * np.sin(2 * theta)
    return np.where(theta < 0.5, series, closed) / (3 * np.pi)


def _rest_by_quadrature(theta: Array) -> Array:
    """The same from p = 2 theta^2 j_1(theta) / (3 pi^2), without the cancellation at 0."""
    x, weight = three_terms.nodes(30, 1)
    at = theta[..., None] * x
    return 4 / (3 * np.pi) * theta * ((np.sin(at) * at**2 * spherical_jn(1, at)) @ weight)


def _cosine(rest: Callable[[Array], Array]) -> Route:
    def invert(xi: Any) -> Array:
        xi = np.asarray(xi, dtype=np.float64)
        low, high = np.zeros(xi.shape), np.full(xi.shape, np.pi)
        for _ in range(64):
            middle = (low + high) / 2
            below = rest(middle) < 1 - xi
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        return np.where((xi >= 0) & (xi <= 1), np.cos((low + high) / 2), np.nan)

    return invert


@register
class SampledCosine(Solved):
    """The cosine mu of the deviation up to which the phase function has the share xi, from straight back at xi = 0.

    >>> SampledCosine.routes[0](np.array([0.0, 1.0])).round(12)
    array([-1.,  1.])
    """

    symbol = r"\mu"
    routes = (_cosine(_rest), _cosine(_rest_by_quadrature))
    methods = ("bisection of the distribution in closed form", "bisection of the distribution by quadrature")


def heads(e: Expr) -> set[type[Solved]]:
    """The kinds of solved quantities in an expression."""
    return {type(node) for node in e.atoms(Solved)}


__all__ = ["AlbedoLambertSphere", "HLambertSphere", "ModeConstant", "ModeLambertSphere", "ParticleAlbedo",
           "SampledCosine", "Solved", "heads"]  # fmt: skip
