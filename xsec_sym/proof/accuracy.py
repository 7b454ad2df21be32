"""What an accuracy claim says, as data: how near, and in which coordinates the error may be bounded.

Nothing here decides. `approximate.py` bounds the error, and tries every expression given here at points; `measured.py`
takes errors at many points, of quantities that only a solver gives.
"""

from __future__ import annotations

from dataclasses import dataclass

from sympy import Expr, Symbol


@dataclass(frozen=True)
class Chart:
    """Coordinates (x, y) in which the error is smooth: the claim's variables as expressions of them.

    ``across`` is the first variable and ``rough`` the second, in terms of x and y; ``y_of`` is y in terms of the
    second; ``reach`` is the range of x. ``form`` is the approximant in x and y, written so that wide balls stay
    narrow; it must equal the claim's. ``fine`` names parts of it that depend on y alone, and cancel so much that wide
    balls are cut up for them. ``even`` says why the error is the same on both sides of 0, where x covers one of them
    only. ``removable`` is a y at which the form is bounded but its parts are not.
    """

    x: Symbol
    y: Symbol
    across: Expr
    rough: Expr
    y_of: Expr
    reach: tuple[Expr, Expr]
    form: Expr
    fine: tuple[tuple[Symbol, Expr], ...] = ()
    even: str = ""
    removable: float | None = None


@dataclass(frozen=True)
class Tail:
    """Beyond the chart the error is at most the one on its edge x = ``edge`` plus ``extra``, an expression in y."""

    edge: Expr
    extra: Expr
    because: str


@dataclass(frozen=True)
class Limit:
    """Between y = 0 and ``y`` the error is at most ``bound``, an expression in y that grows with it."""

    y: Expr
    bound: Expr
    because: str


@dataclass(frozen=True)
class Accuracy:
    """Within ``within`` for the claim's whole domain; its second variable ends at ``end`` on the harder side.

    ``by`` is the id of the claim, of the same form and with the same accuracy, that bounds the error, where this one
    only holds the print against it. ``start`` is where the search begins, in y: past the limit, or at the easy end.
    """

    within: Expr
    chart: Chart
    start: Expr
    end: Expr
    tail: Tail | None = None
    limit: Limit | None = None
    by: str = ""


T = Symbol("t", real=True)


@dataclass(frozen=True)
class Measure:
    """What is asked of the form.

    ``within`` is the accuracy stated for it, None where none is stated; ``relative`` says whether it is relative to the
    left side. ``exact`` asks for equality instead. ``along`` gives variables in terms of t in [0, 1], so that
    points crowd where the error changes fast; each must run over the whole range of its variable.
    """

    within: Expr | None = None
    relative: bool = False
    exact: bool = False
    along: tuple[tuple[Symbol, Expr], ...] = ()
