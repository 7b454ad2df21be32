"""What a source says, as data: the two sides that are tested, where they should meet, and how that is shown.

A claim carries no verdict. `verify.py` earns one.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from sympy import Expr, Integral, Symbol, sympify

from xsec_sym.proof.accuracy import Accuracy, Measure
from xsec_sym.proof.domain import Domain, domain
from xsec_sym.proof.magnitude import Magnitude
from xsec_sym.proof.typeset import latex

NEAR = ("approximation", "accuracy")  # kinds whose sides are only near to each other
KINDS = ("equation", "definition", "statement", "whole", "out-of-scope", "approximation", "accuracy")


@dataclass
class Claim:
    """One thing that a source says, as data: the two sides, the domain, and the script that proves it.

    Made by the methods of a `Source`. `form` is the side that is held to be right; `proof` decorates the script, which
    gets a `Step`.

    >>> from sympy import Integral, Symbol
    >>> from xsec_sym.proof import Source, interval
    >>> u, x = Symbol("u", real=True), Symbol("x", real=True)
    >>> paper = Source("example", section="2")
    >>> first = paper.claim("2", "a moment", left=Integral(x, (x, 0, u)), printed=u**2 / 2, where=[interval(u, 0, 1)])
    >>> first.id, first.kind, first.form
    ('example:2', 'equation', u**2/2)
    """

    id: str
    source: str
    section: str
    label: str
    title: str
    kind: str
    left: Expr
    printed: Expr | None
    corrected: Expr | None
    domain: Domain
    edit: str = ""
    reading: str = ""
    reduces: tuple[str, ...] = ()
    parts: tuple[str, ...] = ()
    points: Mapping[Any, Any] = field(default_factory=dict)
    accuracy: Accuracy | None = None
    measure: Measure | None = None
    module: str = ""
    prove: Callable[[Any], None] | None = None

    @property
    def form(self) -> Expr:
        """The side that is held to be right: what is printed, unless something else holds instead."""
        chosen = self.printed if self.corrected is None else self.corrected
        if chosen is None:
            raise ValueError(f"{self.id} has neither a printed nor a corrected form")
        return chosen

    def proof(self, script: Callable[[Any], None]) -> Callable[[Any], None]:
        """Decorator: the script that shows left = form, move by move."""
        self.prove = script
        return script

    def latex(self) -> str:
        """What the source prints, set from the very objects that are tested."""
        left, sign = latex(self.left), r"\approx" if self.kind in NEAR else "="
        return left if self.printed is None else f"{left} {sign} {latex(self.printed)}"

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex()}$"


REGISTRY: dict[str, Claim] = {}


class Source:
    """One document, one section of it, and the claims it makes, in its own order.

    >>> from sympy import Symbol
    >>> from xsec_sym.proof import Source, interval
    >>> u = Symbol("u", real=True)
    >>> paper = Source("example", section="1")
    >>> square = paper.claim("1", "a square", left=(u + 1) ** 2, printed=u**2 + 2 * u + 1, where=[interval(u, -1, 1)])
    >>> square.id
    'example:1'
    """

    def __init__(self, key: str, *, section: str = "") -> None:
        self.key, self.section = key, section
        self.claims: list[Claim] = []
        frame = inspect.currentframe()
        caller = frame.f_back.f_globals if frame and frame.f_back else {}
        self.module = caller["__spec__"].name if caller.get("__spec__") else caller.get("__name__", "")

    def _add(self, label: str, title: str, **rest: Any) -> Claim:
        claim = Claim(id=f"{self.key}:{label}", source=self.key, section=self.section, label=label, title=title,
                      module=self.module, **rest)  # fmt: skip
        earlier = REGISTRY.get(claim.id)
        if earlier is not None and earlier.module not in (claim.module, "__main__"):
            raise ValueError(f"{claim.id} is claimed twice: in {earlier.module} and in {claim.module}")
        if any(c.label == label for c in self.claims):
            raise ValueError(f"{claim.id} is claimed twice in {claim.module}")
        self.claims.append(claim)
        REGISTRY[claim.id] = claim
        return claim

    def claim(
        self,
        label: str,
        title: str,
        *,
        left: Any,
        printed: Any = None,
        corrected: Any = None,
        edit: str = "",
        where: Iterable[Any] = (),
        instances: Mapping[Any, Iterable[Any]] | None = None,
        reading: str = "",
        reduces: Iterable[str] = (),
        points: Mapping[Any, Any] | None = None,
        statement: bool = False,
    ) -> Claim:
        """An equation: ``left`` from the definitions, ``printed`` as it stands in the source.

        ``printed`` is None for a blank that is filled; ``corrected`` holds where the print does not, ``edit`` says
        in words what to change. ``reading`` names the normalisation and whatever the print leaves open.
        ``reduces`` names equations that turn a nested ``left`` into a single integral for the enclosures; ``points``
        lists the kinks of an outer integrand. ``statement`` marks a property told in words: it holds or fails.
        """
        if printed is None and corrected is None:
            raise ValueError(f"{self.key}:{label} says nothing: give a printed or a corrected form")
        if printed is not None and corrected is not None and not edit:
            raise ValueError(f"{self.key}:{label} corrects the print without saying in words what to change")
        left = sympify(left)
        for side in (printed, corrected):
            if side is not None and _defined(left) & _defined(sympify(side)) and not statement:
                shared = ", ".join(sorted(str(n) for n in _defined(left) & _defined(sympify(side))))
                raise ValueError(f"{self.key}:{label} has {shared} on both sides, so it tests nothing")
        return self._add(
            label,
            title,
            kind="statement" if statement else "equation",
            left=left,
            printed=None if printed is None else sympify(printed),
            corrected=None if corrected is None else sympify(corrected),
            domain=domain(where, instances),
            edit=edit,
            reading=reading,
            reduces=tuple(reduces),
            points=dict(points or {}),
        )

    def approximation(
        self,
        label: str,
        title: str,
        *,
        left: Any,
        accuracy: Accuracy,
        printed: Any = None,
        corrected: Any = None,
        edit: str = "",
        where: Iterable[Any] = (),
        reading: str = "",
        statement: bool = False,
    ) -> Claim:
        """A form that is near to ``left``, judged by its error: it holds where it is as ``accuracy`` says.

        It is a misprint where the print is not and the corrected form is. As a ``statement`` the claim is the accuracy
        itself: it holds or fails, and its evidence says how far it really reaches.
        """
        if printed is not None and corrected is not None and not edit:
            raise ValueError(f"{self.key}:{label} corrects the print without saying in words what to change")
        if printed is None and corrected is None:
            raise ValueError(f"{self.key}:{label} says nothing: give a printed or a corrected form")
        return self._add(
            label,
            title,
            kind="accuracy" if statement else "approximation",
            left=sympify(left),
            printed=None if printed is None else sympify(printed),
            corrected=None if corrected is None else sympify(corrected),
            domain=domain(where),
            edit=edit,
            reading=reading,
            accuracy=accuracy,
        )

    def accuracy(self, label: str, title: str, **rest: Any) -> Claim:
        """An accuracy that the source states of a form."""
        return self.approximation(label, title, statement=True, **rest)

    def measured(
        self,
        label: str,
        title: str,
        *,
        left: Any,
        printed: Any = None,
        corrected: Any = None,
        edit: str = "",
        where: Iterable[Any] = (),
        reading: str = "",
        statement: bool = False,
        within: Any = None,
        relative: bool = False,
        exact: bool = False,
        along: Mapping[Symbol, Any] | None = None,
    ) -> Claim:
        """A form near to a quantity that only a solver gives (`exact/solved.py`), judged at many points.

        ``within``, ``relative``, ``exact`` and ``along`` are those of `Measure`. As a ``statement`` the claim is the
        accuracy itself: it holds or fails.
        """
        if printed is not None and corrected is not None and not edit:
            raise ValueError(f"{self.key}:{label} corrects the print without saying in words what to change")
        if printed is None and corrected is None:
            raise ValueError(f"{self.key}:{label} says nothing: give a printed or a corrected form")
        if exact and (within is not None or relative):
            raise ValueError(f"{self.key}:{label} is exact, or near to an accuracy, but not both")
        target = sympify(left)
        sides = [None if side is None else sympify(side) for side in (printed, corrected)]
        if not (_solved(target) or target.has(Integral)):
            raise ValueError(f"{self.key}:{label} has a left side that no two methods evaluate")
        if any(side is not None and _solved(side) & _solved(target) for side in sides):
            raise ValueError(f"{self.key}:{label} has the same solved quantity on both sides, so it tests nothing")
        kinds = ("statement", "equation") if exact else ("accuracy", "approximation")
        return self._add(
            label,
            title,
            kind=kinds[0] if statement else kinds[1],
            left=target,
            printed=sides[0],
            corrected=sides[1],
            domain=domain(where),
            edit=edit,
            reading=reading,
            measure=Measure(
                None if within is None else sympify(within),
                relative,
                exact,
                tuple((s, sympify(e)) for s, e in (along or {}).items()),
            ),
        )

    def inequality(self, label: str, title: str, greater: Any, lesser: Any = 0, **rest: Any) -> Claim:
        """A statement that one side is nowhere smaller than the other: the magnitude of the difference is itself."""
        gap = sympify(greater) - sympify(lesser)
        return self.claim(label, title, left=Magnitude(gap), corrected=gap, statement=True, **rest)

    def definition(self, label: str, title: str, *, left: Any, printed: Any, reading: str = "") -> Claim:
        """A display that only introduces a symbol: nothing in it could be false."""
        return self._add(label, title, kind="definition", left=sympify(left), printed=sympify(printed),
                         corrected=None, domain=Domain(), reading=reading)  # fmt: skip

    def whole(self, label: str, title: str, parts: Iterable[str], *, left: Any, printed: Any = None,
              reading: str = "") -> Claim:  # fmt: skip
        """A display whose parts have verdicts of their own; it carries the worst of them."""
        ids = tuple(f"{self.key}:{p}" for p in parts)
        return self._add(label, title, kind="whole", left=sympify(left), corrected=None, domain=Domain(),
                         printed=None if printed is None else sympify(printed), parts=ids,
                         reading=reading)  # fmt: skip

    def out_of_scope(self, label: str, title: str, *, because: str) -> Claim:
        """A sentence that no computation can settle, with the reason."""
        return self._add(label, title, kind="out-of-scope", left=sympify(0), printed=None, corrected=None,
                         domain=Domain(), reading=because)  # fmt: skip

    def __iter__(self) -> Iterator[Claim]:
        return iter(self.claims)

    def tell(self) -> None:
        """Run every proof of this section and print it step by step, each claim with the verdict it earns."""
        from xsec_sym.proof.tell import tell

        tell(self.claims)


def _defined(e: Expr) -> set[Expr]:
    from sympy import preorder_traversal

    return {node for node in preorder_traversal(e) if hasattr(node, "definition")}


def _solved(e: Expr) -> set[Expr]:
    from xsec_sym.exact.solved import Solved

    return e.atoms(Solved)
