"""Signs and their arithmetic, and what an inequality says."""

from __future__ import annotations

from sympy import And, Expr, Ge, Gt, Le, Lt, S, exp

Sign = str | None  # "+", "-", "0", ">=" (not negative), "<=" (not positive), None: unknown
FLIP: dict[Sign, Sign] = {"+": "-", "-": "+", "0": "0", ">=": "<=", "<=": ">=", None: None}


def times(a: Sign, b: Sign) -> Sign:
    if "0" in (a, b):
        return "0"
    if a is None or b is None:
        return None
    strict = a in "+-" and b in "+-"
    positive = (a in ("+", ">=")) == (b in ("+", ">="))
    return ("+" if positive else "-") if strict else (">=" if positive else "<=")


def plus(a: Sign, b: Sign) -> Sign:
    if a == "0":
        return b
    if b == "0":
        return a
    if a is None or b is None:
        return None
    up_a, up_b = a in ("+", ">="), b in ("+", ">=")
    if up_a != up_b:
        return None
    strict = a in "+-" or b in "+-"
    return ("+" if strict else ">=") if up_a else ("-" if strict else "<=")


def relation_facts(condition: Expr) -> list[tuple[Expr, bool]]:
    """What an inequality says, as (expression, strict); other conditions say nothing usable."""
    if isinstance(condition, And):
        return [fact for c in condition.args for fact in relation_facts(c)]
    if isinstance(condition, Gt | Ge):
        return [(condition.lhs - condition.rhs, isinstance(condition, Gt))]
    if isinstance(condition, Lt | Le):
        return [(condition.rhs - condition.lhs, isinstance(condition, Lt))]
    return []


def both_sides(condition: Expr) -> list[tuple[Expr, Expr]]:
    """The larger and the smaller side of each inequality in a condition."""
    if isinstance(condition, And):
        return [pair for c in condition.args for pair in both_sides(c)]
    if isinstance(condition, Gt | Ge):
        return [(condition.lhs, condition.rhs)]
    return [(condition.rhs, condition.lhs)] if isinstance(condition, Lt | Le) else []


def difference_of_exponentials(first: Expr, second: Expr) -> tuple[Expr, Expr] | None:
    """(a, b) where the two terms are exp(a) and -exp(b), 1 being exp(0)."""
    exponents: dict[int, Expr] = {}
    for term in (first, second):
        side, rest = term.as_coeff_Mul()
        if side not in (1, -1) or not (rest == 1 or isinstance(rest, exp)):
            return None
        exponents[int(side)] = S.Zero if rest == 1 else rest.args[0]
    return (exponents[1], exponents[-1]) if len(exponents) == 2 else None
