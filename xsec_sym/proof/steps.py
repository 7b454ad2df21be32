"""Writing a proof: a cursor on a goal. Each method makes one checked move and writes it into the certificate."""

from __future__ import annotations

import traceback
from collections.abc import Iterable, Iterator, Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from sympy import Expr, Integral, Sum, Symbol, preorder_traversal, sympify

from xsec_sym.proof import wire
from xsec_sym.proof.checker import FORMAT, Certificate, apply, opening
from xsec_sym.proof.claim import Claim
from xsec_sym.proof.regular import Refused
from xsec_sym.proof.rules import Goal


class BrokenProof(Exception):
    """A script that cannot be run to its end, as against a move that does not follow: it names what there is not."""


class Step:
    """The goal that is left, and the moves made so far: what the script of a proof is given.

    Every method is a move, which is checked as it is made, and raises `Refused` where it does not follow.

    >>> from sympy import Integral, Symbol
    >>> from xsec_sym.proof import Source, interval
    >>> u, x = Symbol("u", real=True), Symbol("x", real=True)
    >>> paper = Source("example", section="3")
    >>> first = paper.claim("3", "a moment", left=Integral(x, (x, 0, u)), printed=u**2 / 2, where=[interval(u, 0, 1)])
    >>> @first.proof
    ... def moment(step):
    ...     step.antiderivative(x**2 / 2)
    >>> certificate, told = derive(first, {})
    >>> print(*(sentence for _, sentence in told), sep="\\n")
    x**2/2 has the derivative wanted; take it from 0 to u
    both sides are the same polynomial in the same atoms
    """

    def __init__(self, goal: Goal, claims: Mapping[str, Claim], told: list[tuple[int, str]], depth: int = 0) -> None:
        self.goal: Goal | None = goal
        self.claims, self.told, self.depth = claims, told, depth
        self.moves: list[Any] = []

    # --- reading the goal --------------------------------------------------------------------------

    @property
    def left(self) -> Expr:
        return self._open().left

    @property
    def right(self) -> Expr:
        return self._open().right

    @property
    def integrals(self) -> list[Integral]:
        """The integrals of the left side that stand inside no other, in order of appearance."""
        found: list[Integral] = []
        walk = preorder_traversal(self.left)
        for node in walk:
            if isinstance(node, Integral):
                walk.skip()
                if node not in found:
                    found.append(node)
        return found

    def over(self, low: Any, high: Any) -> Integral:
        """The integral of the left side between two limits."""
        for found in self.integrals:
            if found.limits[0][1:] == (sympify(low), sympify(high)):
                return found
        raise Refused(f"there is no integral from {low} to {high} in {self.left}")

    def _open(self) -> Goal:
        if self.goal is None:
            raise Refused("this branch of the proof is already closed")
        return self.goal

    def _integral(self, chosen: Integral | int | None) -> Integral:
        if isinstance(chosen, Integral):
            return chosen
        found = self.integrals
        if not found:
            raise Refused(f"no integral is left in {self.left}")
        return found[chosen or 0]

    # --- moves -------------------------------------------------------------------------------------

    def _move(self, name: str, said: str, **data: Any) -> Step:
        if (lemma := data.get("proven", "")) and lemma not in self.claims:
            raise BrokenProof(f"there is no claim called {lemma}{_meant(lemma, self.claims)}")
        goals = apply(self._open(), name, data, self.claims)
        self.moves.append([name, wire.encode(data)])
        self.told.append((self.depth, said))
        self.goal = goals[0] if goals else None
        return self

    def cases(self, on: Any, symbol: Symbol | None = None, root: Any = None, slope: Any = 1) -> Iterator[Step]:
        """Three branches, in this order: on > 0, on < 0, on = 0 (symbol = root, as on = slope (symbol - root))."""
        on = sympify(on)
        if symbol is None:
            if not on.is_Symbol:
                raise Refused(f"say at which symbol = root {on} vanishes")
            symbol, root = on, 0
        data = {"on": on, "symbol": symbol, "root": sympify(root), "slope": sympify(slope)}
        goals = apply(self._open(), "cases", data, self.claims)
        record: list[Any] = ["cases", wire.encode(data)]
        self.moves.append(record)
        self.goal = None
        for goal, word in zip(goals, ("> 0", "< 0", "= 0"), strict=True):
            self.told.append((self.depth, f"where {on} {word}:"))
            branch = Step(goal, self.claims, self.told, self.depth + 1)
            yield branch
            branch.finish()
            record.append(branch.moves)

    @property
    def is_empty(self) -> bool:
        """Whether it shows that no point of the domain lies on this piece."""
        try:
            apply(self._open(), "vacuous", {}, self.claims)
        except Refused:
            return False
        return True

    def vacuous(self) -> Step:
        return self._move("vacuous", "no point of the domain lies here")

    def fact(self, expression: Any, *terms: Any, inside: tuple[Any, ...] = (), by: Claim | str | None = None,
             mapping: Mapping[Any, Any] | None = None, back: bool = False) -> Step:  # fmt: skip
        """Note a sign, shown by equal terms whose signs agree; without terms, the expression shows it itself.

        ``by`` names a lemma that shows the sign of each term; a lemma |Y| = Y is read ``back``.
        """
        chosen = terms or (expression,)
        said = f"the sign of {expression} is that of {' + '.join(f'({t})' for t in terms)}"
        if not terms:
            said = f"the sign of {expression}" + (f", by {by if isinstance(by, str) else by.id}" if by else " shows")
        data = {"expression": sympify(expression), "terms": [sympify(t) for t in chosen],
                "inner": [sympify(i) for i in inside]}  # fmt: skip
        if by is not None:
            data |= {"proven": by if isinstance(by, str) else by.id,
                     "mapping": {sympify(k): sympify(v) for k, v in (mapping or {}).items()}}  # fmt: skip
            data |= {"back": True} if back else {}
        return self._move("fact", said, **data)

    def unfold(self, only: str = "") -> Step:
        """Write out every definition, or only those of one name."""
        if only:
            return self._move("unfold", f"write out the definition of {only}", only=only)
        return self._move("unfold", "write out the definitions")

    def swap(self) -> Step:
        return self._move("swap", "now the other side")

    def nest(self, integral: Integral | int | None = None) -> Step:
        return self._move("nest", "one integration at a time", integral=self._integral(integral))

    def rewrite(self, old: Any, new: Any, because: str = "") -> Step:
        said = f"{old} = {new}" + (f" ({because})" if because else "")
        return self._move("rewrite", said, old=sympify(old), new=sympify(new))

    def settle(self) -> Step:
        return self._move("settle", "take the branches that hold here")

    def lemma(self, proven: Claim | str, mapping: Mapping[Any, Any] | None = None, back: bool = False) -> Step:
        """Replace the left side of an equation that holds by its right side; ``back`` the other way round."""
        name = proven if isinstance(proven, str) else proven.id
        filled = {sympify(k): sympify(v) for k, v in (mapping or {}).items()}
        at = ", ".join(f"{k} = {v}" for k, v in filled.items() if k != v)
        data: dict[str, Any] = {"proven": name, "mapping": filled} | ({"back": True} if back else {})
        said = f"by {name}" + (" from right to left" if back else "") + (f" with {at}" if at else "")
        return self._move("lemma", said, **data)

    def ode(self, x: Symbol, coefficients: Iterable[Any], at: Any) -> Step:
        listed = [sympify(c) for c in coefficients]
        said = f"the difference solves a linear equation of order {len(listed) - 1} in {x} and starts from 0 at {at}"
        return self._move("ode", said, x=x, coefficients=listed, at=sympify(at))

    def induct(self, index: Symbol, factor: Any, *terms: Any, by: Claim | str | None = None,
               mapping: Mapping[Any, Any] | None = None) -> Step:  # fmt: skip
        """Close a goal |X| = X by induction: X(n + 1) = factor X(n) + terms; ``by`` names a lemma |Y| = Y."""
        data: dict[str, Any] = {"index": index, "factor": sympify(factor), "terms": [sympify(t) for t in terms]}
        if by is not None:
            data |= {"proven": by if isinstance(by, str) else by.id,
                     "mapping": {sympify(k): sympify(v) for k, v in (mapping or {}).items()}}  # fmt: skip
        return self._move("induct", f"by induction on {index}", **data)

    def dominate(self, first: Any, ratio: Any, total: Sum) -> Step:
        said = f"the terms are at most {first} times the powers of {ratio}"
        return self._move("dominate", said, total=total, first=sympify(first), ratio=sympify(ratio))

    def split(self, *points: Any, integral: Integral | int | None = None) -> Step:
        chosen = self._integral(integral)
        where = f" at {', '.join(map(str, points))}" if points else ""
        return self._move("split", f"cut the integral over {chosen.limits[0][0]}{where}", integral=chosen,
                          points=[sympify(p) for p in points])  # fmt: skip

    def extend(self, end: Any, integral: Integral | int | None = None) -> Step:
        said = f"go on to {end}, and take off what that adds"
        return self._move("extend", said, integral=self._integral(integral), end=sympify(end))

    def linear(self, *terms: Any, integral: Integral | int | None = None) -> Step:
        chosen = self._integral(integral)
        return self._move("linear", f"integrate term by term: {', '.join(map(str, terms))}", integral=chosen,
                          terms=[sympify(t) for t in terms])  # fmt: skip

    def exchange(self, integral: Integral | int | None = None, by: Claim | str | None = None,
                 mapping: Mapping[Any, Any] | None = None) -> Step:  # fmt: skip
        """Swap two integrations; ``by`` names the lemma whose right side shows the integrand's sign."""
        said = "exchange the integrations (Tonelli: the integrand keeps one sign)"
        chosen = self._integral(integral)
        if by is None:
            return self._move("exchange", said, integral=chosen)
        filled = {sympify(k): sympify(v) for k, v in (mapping or {}).items()}
        name = by if isinstance(by, str) else by.id
        return self._move("exchange", f"{said}, by {name}", integral=chosen, proven=name, mapping=filled)

    def substitute(self, new: Symbol, g: Any, low: Any, high: Any, integral: Integral | int | None = None) -> Step:
        chosen = self._integral(integral)
        return self._move("substitute", f"put {chosen.limits[0][0]} = {g}", integral=chosen, new=new, g=sympify(g),
                          low=sympify(low), high=sympify(high))  # fmt: skip

    def antiderivative(self, primitive: Any, integral: Integral | int | None = None, flat: str = "") -> Step:
        """``flat`` names an end (low or high) at which the primitive vanishes faster than any power."""
        chosen = self._integral(integral)
        _, low, high = chosen.limits[0]
        said = f"{primitive} has the derivative wanted; take it from {low} to {high}"
        data = {"integral": chosen, "primitive": sympify(primitive)} | ({"flat": flat} if flat else {})
        return self._move("antiderivative", said, **data)

    def recurrence(self, index: Symbol, closed: Any, *, base: Any, primitive: Any, following: Any, present: Any,
                   integral: Integral | int | None = None) -> Step:  # fmt: skip
        said = f"by induction on {index}: ({following}) I({index} + 1) + ({present}) I({index}) from {primitive}"
        return self._move("recurrence", said, integral=self._integral(integral), index=index, closed=sympify(closed),
                          base=sympify(base), primitive=sympify(primitive), following=sympify(following),
                          present=sympify(present))  # fmt: skip

    def telescope(self, primitive: Any, total: Sum | None = None) -> Step:
        chosen = total or next(iter(sorted(self.left.atoms(Sum), key=str)), None)
        if chosen is None:
            raise Refused(f"no sum is left in {self.left}")
        return self._move("telescope", f"the terms are differences of {primitive}", total=chosen,
                          primitive=sympify(primitive))  # fmt: skip

    def diverges(self, minorant: Any, strength: Any, order: int = 0, end: str = "high",
                 integral: Integral | int | None = None) -> Step:  # fmt: skip
        said = f"the integrand lies above {minorant}, whose integral is infinite at the {end} end"
        return self._move("diverges", said, integral=self._integral(integral), minorant=sympify(minorant),
                          strength=sympify(strength), order=order, end=end)  # fmt: skip

    def polar(self, radius: Symbol, azimuth: Symbol, integral: Integral | int | None = None) -> Step:
        said = f"polar coordinates, {radius} and {azimuth}, for the whole plane"
        return self._move("polar", said, integral=self._integral(integral), radius=radius, azimuth=azimuth)

    def turn(self, u: Any, seen: Symbol | None = None, form: Any = None,
             integral: Integral | int | None = None) -> Step:  # fmt: skip
        said = f"turn the sphere: the direction at {u} becomes the pole"
        shape = {} if seen is None else {"seen": seen, "form": sympify(form)}
        return self._move("turn", said, integral=self._integral(integral), u=sympify(u), **shape)

    def funk_hecke(self, u: Any, index: Symbol, integral: Integral | int | None = None) -> Step:
        said = "the moments with each Legendre polynomial multiply (Funk and Hecke)"
        return self._move("funk_hecke", said, integral=self._integral(integral), u=sympify(u), index=index)

    def parities(self, total: Sum | None = None) -> Step:
        chosen = total or next(iter(sorted(self.left.atoms(Sum), key=str)))
        return self._move("parities", "even and odd terms apart", total=chosen)

    def bessel(self, order: Any, argument: Any, factor: Any = 1, integral: Integral | int | None = None) -> Step:
        said = f"the integral over the angle is a Bessel function of order {order} at {argument}"
        return self._move("bessel", said, integral=self._integral(integral), order=sympify(order),
                          argument=sympify(argument), factor=sympify(factor))  # fmt: skip

    def wave(self, old: Any, t: Symbol) -> Step:
        return self._move("wave", f"{old} as an integral over the circle", old=old, t=t)

    def shear(self, a: Symbol, b: Symbol, new: Any, integral: Integral | int | None = None) -> Step:
        chosen = self._integral(integral)
        return self._move("shear", f"shear the torus: {a} is the sum of the angles, {b} their difference",
                          integral=chosen, a=a, b=b, new=sympify(new))  # fmt: skip

    def beats(self, integral: Integral | int | None = None) -> Step:
        return self._move("beats", "products of cosines as sums", integral=self._integral(integral))

    def harmonics(self, index: Symbol, proven: Claim | str, mapping: Mapping[Any, Any] | None = None,
                  integral: Integral | int | None = None) -> Step:  # fmt: skip
        name = proven if isinstance(proven, str) else proven.id
        filled = {sympify(k): sympify(v) for k, v in (mapping or {}).items()}
        return self._move("harmonics", f"integrate the Fourier series, its coefficients by {name}",
                          integral=self._integral(integral), index=index, proven=name, mapping=filled)  # fmt: skip

    def taylor(self, weight: Any, inner_map: Any, z: Symbol, index: Symbol, family: Any, moment: Any,
               integral: Integral | int | None = None) -> Step:  # fmt: skip
        said = f"integrate the Taylor series in {inner_map} term by term, its derivatives being {family}"
        return self._move("taylor", said, integral=self._integral(integral), weight=sympify(weight),
                          inner_map=sympify(inner_map), z=z, index=index, family=sympify(family),
                          moment=sympify(moment))  # fmt: skip

    def peel(self, count: Any = 1, total: Sum | None = None) -> Step:
        chosen = total or next(iter(sorted(self.left.atoms(Sum), key=str)), None)
        if chosen is None:
            raise Refused(f"no sum is left in {self.left}")
        return self._move("peel", f"take the first {count} of the sum's terms out", total=chosen, count=sympify(count))

    def close(self) -> Step:
        return self._move("close", "both sides are the same polynomial in the same atoms")

    def finish(self) -> None:
        """End a branch: whatever equation is left must be an identity."""
        if self.goal is not None:
            self.close()


def derive(claim: Claim, claims: Mapping[str, Claim]) -> tuple[Certificate, list[tuple[int, str]]]:
    """Run a claim's proof script. Returns its certificate, and its steps in words with their depth.

    Raises `Refused` where a move does not follow, and `BrokenProof` where the script fails otherwise.
    """
    told: list[tuple[int, str]] = []
    if claim.prove is None:
        raise Refused(f"{claim.id} has no proof script")
    step = Step(opening(claim), claims, told)
    try:
        claim.prove(step)
    except Refused:
        raise
    except Exception as error:
        raise BrokenProof(f"{_said(error)}{_line(error)}") from error
    step.finish()
    return {"format": FORMAT, "claim": claim.id, "moves": step.moves}, told


def _said(error: Exception) -> str:
    if isinstance(error, BrokenProof):
        return str(error)
    if isinstance(error, AttributeError) and isinstance(error.obj, Step) and error.name:
        return f"there is no move called {error.name}{_meant(error.name, dir(Step))}"
    return f"{type(error).__name__}: {error}"


def _meant(word: str, known: Iterable[str]) -> str:
    near = get_close_matches(word, [k for k in known if not k.startswith("_")], 1)
    return f"; did you mean {near[0]}?" if near else ""


def _line(error: Exception) -> str:
    """Where in the script it happened: the last line that is not the engine's own."""
    engine = Path(__file__).parent
    frames = [f for f in traceback.extract_tb(error.__traceback__) if Path(f.filename).parent != engine]
    written = [f for f in frames if Path(f.filename).is_file() and "site-packages" not in Path(f.filename).parts]
    return f" ({Path(written[-1].filename).name}, line {written[-1].lineno})" if written else ""
