"""The source of one kernel: the formula of every branch of its entries, and the masks that choose between them."""

from __future__ import annotations

import keyword
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from math import log2

from sympy import And, Expr, Integral, Not, Piecewise, S, Sum, Symbol, oo, piecewise_fold, preorder_traversal
from sympy.core.function import AppliedUndef
from sympy.logic.boolalg import Boolean, BooleanFunction

from xsec_sym.export import special
from xsec_sym.export.printer import WIDTH, Printer, lines
from xsec_sym.export.search import Form, Search, one_sided
from xsec_sym.proof.domain import Domain, Interval
from xsec_sym.record.entry import Entry

VERIFIED = frozenset({"proved", "confirmed", "misprint"})
MOST_BRANCHES = 12


class Refusal(ValueError):
    """What was asked for is not exported; the message is one sentence that says why."""


@dataclass(frozen=True)
class Branch:
    """A form, and where it holds: in ``within``, under ``condition``, where no earlier branch of the entry does.

    ``domain`` says all of that at once. An infinite side of a cell has the form oo.
    """

    label: str
    form: Expr
    domain: Domain
    within: Domain
    condition: Boolean = S.true

    @property
    def is_constant(self) -> bool:
        return not self.form.free_symbols


def _said(word: str) -> str:
    return f"{'an' if word[0] in 'aeiou' else 'a'} {word}"


def refuse(entry: Entry) -> None:
    """Raise a `Refusal` where an entry is no verified expression of real variables."""
    if entry.kind in ("definition", "out-of-scope"):
        raise Refusal(f"{entry.id} is {_said(entry.kind)}, so there is nothing verified to export")
    if entry.verdict == "divergent":
        raise Refusal(f"{entry.id} is divergent: it is infinite on its whole domain")
    if entry.verdict not in VERIFIED:
        raise Refusal(f"{entry.id} is not verified: its verdict is {entry.verdict}")
    try:
        form, domain = entry.form, entry.where
    except (ValueError, KeyError) as error:
        raise Refusal(f"{entry.id} has no expression on its right side") from error
    for variable in domain.variables:
        if not isinstance(variable, Interval):
            raise Refusal(f"{entry.id} has the variable {variable.symbol}, which takes integer or single values only")
    for node in preorder_traversal(form):
        for kind, word in ((Integral, "an integral"), (Sum, "a sum of many terms"), (AppliedUndef, "a free function")):
            if isinstance(node, kind):
                raise Refusal(f"the form of {entry.id} has {word} in it, so it is no closed form")
        if hasattr(node, "definition"):
            raise Refusal(f"the form of {entry.id} refers to {type(node).__name__}, so it is no closed form")
    if not domain.symbols:
        raise Refusal(f"{entry.id} has no variable: it is the number {form}")
    if form.free_symbols - set(domain.symbols):
        raise Refusal(f"the form of {entry.id} depends on a variable without a range")
    if form in (oo, -oo):
        raise Refusal(f"{entry.id} is infinite on its whole domain")


def branches(entry: Entry, parts: Sequence[Entry] = ()) -> list[Branch]:
    """The branches of an entry, or of a cell that is split into ``parts`` by the sign of its variable."""
    if not parts:
        refuse(entry)
        return _pieces(entry)
    found: list[Branch] = []
    (symbol,) = {s for p in parts for s in p.where.symbols}
    for part in parts:
        infinite = part.verdict == "divergent"
        domain = part.where if part.where.symbols else Domain((interval_at(symbol, 0),))
        if infinite:
            found.append(Branch(part.id, oo, domain, domain))
        elif not part.where.symbols:
            if part.verdict not in VERIFIED:
                refuse(part)
            found.append(Branch(part.id, part.form, domain, domain))
        else:
            refuse(part)
            found += _pieces(part)
    if all(b.form.is_infinite for b in found):
        raise Refusal(f"{entry.id} is infinite on its whole domain")
    return found


def interval_at(symbol: Symbol, value: int) -> Interval:
    return Interval(symbol, S(value), S(value))


def _pieces(entry: Entry) -> list[Branch]:
    form, domain = entry.form, entry.where
    if not form.has(Piecewise):
        return [Branch(entry.id, form, domain, domain)]
    folded = piecewise_fold(form)
    if not isinstance(folded, Piecewise) or len(folded.args) > MOST_BRANCHES:
        raise Refusal(f"the form of {entry.id} has too many branches")
    found, before = [], S.true
    for value, condition in folded.args:
        if value is S.NaN:
            raise Refusal(f"the form of {entry.id} leaves a part of its domain without a value")
        here = condition if condition not in (S.true, True) else S.true
        narrow = Domain(domain.variables, (*domain.conditions, *_each(And(before, here))))
        found.append(Branch(entry.id, value, narrow, domain, here))
        before = And(before, Not(here))
    return found


def _each(condition: Boolean) -> tuple[Boolean, ...]:
    if condition is S.true:
        return ()
    return condition.args if isinstance(condition, And) else (condition,)


def named(branch: Branch, names: Mapping[Symbol, Symbol]) -> Branch:
    """The branch with its variables called as they can be in Python."""

    def domain(d: Domain) -> Domain:
        changed = tuple(
            Interval(names[v.symbol], v.low.xreplace(names), v.high.xreplace(names), v.low_open, v.high_open)
            for v in d.variables
            if isinstance(v, Interval)
        )
        return Domain(changed, tuple(c.xreplace(names) for c in d.conditions))

    form, condition = branch.form.xreplace(names), branch.condition.xreplace(names)
    return Branch(branch.label, form, domain(branch.domain), domain(branch.within), condition)


def python_names(symbols: Iterable[Symbol]) -> dict[Symbol, Symbol]:
    return {s: Symbol(_identifier(s.name), **s.assumptions0) for s in symbols}


def _identifier(name: str) -> str:
    word = "".join(c if c.isalnum() and c.isascii() else "_" for c in name).strip("_") or "x"
    taken = keyword.iskeyword(word) or keyword.issoftkeyword(word) or word in ("np", "value", "here", "inside")
    return f"{word}_" if taken or word[0].isdigit() else word


def formula(branch: Branch) -> list[str]:
    """The lines that compute one branch, in the form that rounds best."""
    # what cannot be printed is refused before anything is computed
    form = special.bessels(branch.form)
    lines(form)
    form, domain, meaning = one_sided(form, branch.domain)
    best = _special(form, domain) if special.concerned(form) else Search(form, domain).best()
    printer = Printer()
    sides = {v.symbol.name: v for v in branch.domain.variables if isinstance(v, Interval)}
    first = []
    for new, old in meaning.items():
        (symbol,) = old.free_symbols
        below = sides[symbol.name].high.is_nonpositive
        first.append(f"{new.name} = {'-' + symbol.name if below else printer._print(old)}")
    return [*first, *best.body]


def _special(form: Expr, domain: Domain) -> Form:
    """The best of the forms with special functions; no rule is applied to them."""
    tried = Search(form, domain)
    found = [tried.form(e) for e in (form, *special.candidates(form, domain))]

    def digits_lost(f: Form) -> float:
        # a sum over all points: beside a zero of the value every form loses all of them
        return sum(log2(1 + error) for error in tried.errors(f.body))

    return min(found, key=digits_lost)


def core(name: str, found: Sequence[Branch]) -> str:
    """The private functions of a kernel: ``_name`` of arrays, and one for each formula."""
    arguments = [s.name for s in found[0].domain.symbols]
    typed = ", ".join(f"{a}: np.ndarray" for a in arguments)
    shown = ", ".join(arguments)
    calculated = [b for b in found if not b.is_constant]
    formulas: list[str] = []
    callee: dict[int, str] = {}
    for k, branch in enumerate(calculated):
        own = f"_{name}_{_suffix(branch, k)}" if len(found) > 1 else f"_{name}_inside"
        callee[id(branch)] = own
        body = "\n".join(f"    {line}" for line in formula(branch))
        formulas.append(f"def {own}({typed}) -> np.ndarray:\n{body}\n")
    if len(found) == 1 and calculated:
        steps = [*_mask("inside", found[0].within), f"return np.where(inside, {callee[id(found[0])]}({shown}), np.nan)"]
    else:
        steps = [f"value = np.full_like({arguments[0]}, np.nan)"]
        for within, group in groupby(found, key=lambda b: b.within):
            steps += _fill(within, list(group), callee, arguments)
        steps.append("return value")
    body = "\n".join(f"    {line}" for line in steps)
    return "\n\n".join([*formulas, f"def _{name}({typed}) -> np.ndarray:\n{body}\n"])


def _fill(within: Domain, group: list[Branch], callee: Mapping[int, str], arguments: Sequence[str]) -> list[str]:
    """Values for the branches of one entry: each where its condition holds and none before it did."""
    alone = len(group) == 1 and group[0].condition is S.true
    steps = _mask("here" if alone else "left", within)
    for k, branch in enumerate(group):
        if not alone:
            before, said = _condition(branch.condition, f"case_{k + 1}", Printer())
            steps += [*before, "here = left" if branch.condition is S.true else f"here = left & {_bracketed(said)}"]
            if branch.condition is not S.true and k + 1 < len(group):
                steps.append("left &= ~here")
        if branch.is_constant:
            steps.append(f"value[here] = {Printer()._print(branch.form)}")
        else:
            steps.append(f"value[here] = {callee[id(branch)]}({', '.join(f'{a}[here]' for a in arguments)})")
    return steps


def _bracketed(said: str) -> str:
    return said if said.isidentifier() else f"({said})"


def _suffix(branch: Branch, k: int) -> str:
    side = branch.label.rpartition(".")[2]
    return side if side in ("neg", "pos") else str(k + 1)


def _mask(name: str, domain: Domain) -> list[str]:
    printer = Printer()
    conditions: list[str] = []
    before: list[str] = []
    for variable in domain.variables:
        assert isinstance(variable, Interval)
        u, low, high = (printer._print(e) for e in (variable.symbol, variable.low, variable.high))
        if variable.low == variable.high:
            conditions.append(f"{u} == {low}")
            continue
        conditions.append(f"{u} > {low}" if variable.low_open or variable.low == -oo else f"{u} >= {low}")
        conditions.append(f"{u} < {high}" if variable.high_open or variable.high == oo else f"{u} <= {high}")
    for k, condition in enumerate(domain.conditions):
        lines, said = _condition(condition, f"{name}_{k + 1}", printer)
        before += lines
        conditions.append(said)
    line = f"{name} = " + " & ".join(_bracketed(c) for c in conditions)
    if len(conditions) == 1:
        line = f"{name} = {conditions[0]}"
    if len(line) + 4 <= WIDTH:
        return [*before, line]
    return [*before, f"{name} = {conditions[0]}", *(f"{name} &= {c}" for c in conditions[1:])]


def _condition(condition: Boolean, name: str, printer: Printer) -> tuple[list[str], str]:
    """A condition in one line, or in several that end in a name for it."""
    said = printer._print(condition)
    if len(said) < WIDTH // 3 or not isinstance(condition, BooleanFunction):
        return [], said
    if isinstance(condition, Not):
        lines, inner = _condition(condition.args[0], f"{name}n", printer)
        return lines, f"~{_bracketed(inner)}"
    lines, words = [], []
    for k, part in enumerate(sorted(condition.args, key=str)):
        more, word = _condition(part, f"{name}{'abcdefgh'[k]}", printer)
        lines += more
        words.append(word)
    sign = "&" if isinstance(condition, And) else "|"
    return [*lines, f"{name} = " + f" {sign} ".join(_bracketed(w) for w in words)], name
