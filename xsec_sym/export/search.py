"""The equal form of an expression that rounds best: rules applied one after the other, the best few kept."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from sympy import Abs, Dummy, Expr, Ne, Pow, S, Symbol

from xsec_sym.export import floats
from xsec_sym.export.printer import Unprintable, guarded, lines
from xsec_sym.export.rules import NotShown, checked, plain, rewritten
from xsec_sym.proof.domain import Domain, Interval
from xsec_sym.proof.piece import Piece

POINTS = 120
KEPT = 3
DEPTH = 6
# A form as good as half of what a kernel may be off by needs no improvement: of two such, the shorter is better.
GOOD = 4.0
LOST = 2.0**40


@dataclass(frozen=True)
class Form:
    """An expression, its source, and the largest error found, in units of the last place."""

    expression: Expr
    body: tuple[str, ...]
    error: float

    @property
    def rank(self) -> tuple[float, int]:
        return max(self.error, GOOD), len("".join(self.body))


class Search:
    """One expression on one domain, with reference values at its points."""

    def __init__(self, e: Expr, domain: Domain, count: int = POINTS, seed: int = 0) -> None:
        self.original, self.domain = e, domain
        self.symbols = domain.symbols
        self.piece = Piece.of(domain)
        found = floats.points(domain, count, seed)
        references = [floats.exact(plain(e), self.symbols, p) for p in found]
        self.points = [p for p, r in zip(found, references, strict=True) if r is not None]
        self.references = [r for r in references if r is not None]
        self._least: dict[Expr, float] = {}

    def form(self, e: Expr) -> Form:
        body = tuple(lines(guarded(e, self._smallest)))
        return Form(e, body, max(self.errors(body), default=0.0))

    def errors(self, body: Sequence[str]) -> list[float]:
        """In units of the last place at every point."""
        values = floats.values(body, self.symbols, self.points)
        return [min(floats.ulps(v, r), LOST) for v, r in zip(values.tolist(), self.references, strict=True)]

    def _smallest(self, e: Expr) -> float:
        if e not in self._least:
            found = [floats.exact(plain(e), self.symbols, p) for p in self.points[:40]]
            self._least[e] = min((float(f) for f in found if f is not None), default=0.0)
        return self._least[e]

    def best(self) -> Form:
        """Rules are applied to the best forms so far; one that cannot be shown equal is left out."""
        best = self.form(self.original)
        frontier, seen = [best], {self.original}
        for _ in range(DEPTH):
            if best.error <= GOOD:
                break
            found = []
            for form in frontier:
                for new, old_part, new_part in rewritten(form.expression, self.piece):
                    if new not in seen:
                        seen.add(new)
                        found.append((self._tried(new), form, old_part, new_part))
            found = sorted((f for f in found if f[0] is not None), key=lambda f: f[0].rank)
            frontier = []
            for form, _before, old_part, new_part in found:
                if len(frontier) == KEPT:
                    break
                if self._equal(old_part, new_part, form.expression):
                    frontier.append(form)
            best = min([best, *frontier], key=lambda form: form.rank)
        if best.expression != self.original:
            # what was chosen at some points has to hold up at others
            others = Search(self.original, self.domain, 3 * POINTS, seed=1)
            if others.form(self.original).rank <= others.form(best.expression).rank:
                return self.form(self.original)
        return best

    def _tried(self, e: Expr) -> Any:
        try:
            return self.form(e)
        except (Unprintable, ArithmeticError, ValueError):
            return None

    def _equal(self, old: Expr, new: Expr, whole: Expr) -> bool:
        # The part may not be settled where the whole is: then the whole is compared with what was verified.
        for before, after in ((old, new), (self.original, whole)):
            try:
                checked(before, after, self.piece)
            except NotShown:
                continue
            return True
        return False


def one_sided(e: Expr, domain: Domain) -> tuple[Expr, Domain, dict[Symbol, Expr]]:
    """The same in non-negative variables where it can be: |u| for u where e is even in u, -u where u is not positive.

    >>> from xsec_sym.proof.domain import domain, interval
    >>> u = Symbol("u", real=True)
    >>> one_sided(u + 1, domain([interval(u, -1, 0)]))[0]
    1 - abs_u
    """
    meaning: dict[Symbol, Expr] = {}
    for variable in domain.variables:
        assert isinstance(variable, Interval)
        u, low, high = variable.symbol, variable.low, variable.high
        others = [v for v in domain.variables if v is not variable and isinstance(v, Interval)]
        away = Ne(u, 0)
        if set(domain.conditions) - {away} or any(u in b.free_symbols for v in others for b in (v.low, v.high)):
            continue
        size = Symbol(f"abs_{u.name}", real=True)
        if Piece.of(domain).sign(u) in ("-", "<="):
            # through a symbol with a sign, so that |-x| becomes x
            positive = Dummy(nonnegative=True)
            new = e.subs(u, -positive).subs(positive, size)
            turned = Interval(size, -high, -low, variable.high_open or away in domain.conditions, variable.low_open)
        elif low == -high and variable.low_open == variable.high_open and high.is_number and e.has(Abs(u)):
            even = {p: size**p.exp for p in e.atoms(Pow) if p.base == u and p.exp.is_even}
            new = e.xreplace({Abs(u): size, **even})
            if new.has(u):
                continue
            turned = Interval(size, S.Zero, high, away in domain.conditions, variable.high_open)
        else:
            continue
        e, domain = new, Domain(tuple(turned if v is variable else v for v in domain.variables))
        meaning[size] = Abs(u)
    return e, domain, meaning
