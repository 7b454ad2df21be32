"""Exact expressions as JSON and back: a list headed by a name from a fixed table. Nothing is ever evaluated."""

from __future__ import annotations

from typing import Any

import sympy
from mpmath.libmp import repr_dps, to_str
from sympy import Basic, Float, Integer, Rational, Symbol, Tuple
from sympy.core.function import FunctionClass

_ASSUMED = ("real", "integer", "nonnegative", "positive")
_SYMPY = [
    "Add",
    "Mul",
    "Pow",
    "exp",
    "log",
    "sin",
    "cos",
    "tan",
    "asin",
    "acos",
    "atan",
    "atan2",
    "sinh",
    "cosh",
    "tanh",
    "coth",
    "csch",
    "sech",
    "asinh",
    "acosh",
    "atanh",
    "erf",
    "erfc",
    "besseli",
    "besselj",
    "gamma",
    "loggamma",
    "factorial",
    "binomial",
    "Abs",
    "sign",
    "Heaviside",
    "Max",
    "Min",
    "Piecewise",
    "ExprCondPair",
    "Integral",
    "Sum",
    "hyper",
    "legendre",
    "polylog",
    "floor",
    "StrictLessThan",
    "LessThan",
    "StrictGreaterThan",
    "GreaterThan",
    "Equality",
    "Unequality",
    "And",
    "Or",
    "Not",
    "DiracDelta",
    "zeta",
    "Derivative",
    "Tuple",
    "Union",
    "Interval",
    "bessely",
    "besselk",
    "erfi",
    "Ei",
    "expint",
    "elliptic_k",
    "elliptic_e",
    "chebyshevt",
    "chebyshevu",
    "re",
    "im",
    "asech",
    "acsch",
    "acoth",
    "cot",
    "sec",
    "csc",
    "acot",
    "ceiling",
    "Mod",
]
_ATOMS = {
    "pi": sympy.pi,
    "E": sympy.E,
    "I": sympy.I,
    "oo": sympy.oo,
    "-oo": -sympy.oo,
    "true": sympy.true,
    "false": sympy.false,
    "EulerGamma": sympy.EulerGamma,
    "Catalan": sympy.Catalan,
    "zoo": sympy.zoo,
    "nan": sympy.nan,
}
_NAMES = {value: name for name, value in _ATOMS.items()}
HEADS: dict[str, Any] = {name: getattr(sympy, name) for name in _SYMPY if hasattr(sympy, name)}
HEADS |= {"RisingFactorial": sympy.rf, "FallingFactorial": sympy.ff}
HEADS["ExprCondPair"] = sympy.functions.elementary.piecewise.ExprCondPair


def register(head: type) -> type:
    """Class decorator: a defined object may stand in a certificate or in the record."""
    HEADS[head.__name__] = head
    return head


def encode(value: Any) -> Any:
    """Expressions become lists; dicts, lists and plain values stay what they are."""
    if isinstance(value, dict):
        if any(isinstance(k, Basic) for k in value):
            return {"@map": [[encode(k), encode(v)] for k, v in value.items()]}
        return {k: encode(v) for k, v in value.items()}
    if isinstance(value, list | tuple) and not isinstance(value, Basic):
        return ["@list", *(encode(v) for v in value)]
    if isinstance(value, bool | str | int) or value is None:
        return value
    if not isinstance(value, Basic | FunctionClass):
        raise TypeError(f"{value!r} cannot be written down")
    if isinstance(value, Integer):
        return ["int", str(value)]
    if isinstance(value, Rational):
        return ["int", str(value.p), str(value.q)]
    if isinstance(value, Float):
        return ["dec", _decimal(value), value._prec]
    if isinstance(value, Symbol):
        return ["sym", value.name, *(a for a in _ASSUMED if getattr(value, f"is_{a}") is True)]
    if value in _NAMES:
        return ["atom", _NAMES[value]]
    name = "Tuple" if isinstance(value, Tuple) else value.func.__name__  # the lists of a hyper are a kind of tuple
    if name not in HEADS:
        if isinstance(value, sympy.core.function.AppliedUndef):
            assumed = {a: True for a in _ASSUMED if value.func._kwargs.get(a) is True}
            return ["call", [name, *assumed], *(encode(a) for a in value.args)]
        raise TypeError(f"{name} has no place in the table of heads")
    return [name, *(encode(a) for a in value.args)]


def _decimal(value: Float) -> str:
    """As it was printed where that gives the same number back, else with the digits that do."""
    text = str(value)
    return text if Float(text, precision=value._prec) == value else to_str(value._mpf_, repr_dps(value._prec))


def decode(data: Any, symbols: dict[str, Symbol] | None = None) -> Any:
    if isinstance(data, dict):
        if set(data) == {"@map"}:
            return {decode(k, symbols): decode(v, symbols) for k, v in data["@map"]}
        return {k: decode(v, symbols) for k, v in data.items()}
    if not isinstance(data, list):
        return data
    head, *rest = data
    if head == "@list":
        return [decode(v, symbols) for v in rest]
    if head == "int":
        return Rational(*(int(r) for r in rest))
    if head == "dec":
        return Float(rest[0], precision=rest[1])
    if head == "sym":
        name, *assumed = rest
        return (symbols or {}).get(name) or Symbol(name, **dict.fromkeys(assumed, True))
    if head == "atom":
        return _ATOMS[rest[0]]
    if head == "call":
        (name, *assumed), *given = rest
        return sympy.Function(name, **dict.fromkeys(assumed, True))(*(decode(a, symbols) for a in given))
    if head not in HEADS:
        raise ValueError(f"{head} has no place in the table of heads")
    arguments = [decode(a, symbols) for a in rest]
    if head == "Mul" and any(isinstance(a, Float) for a in arguments):
        return sympy.Mul(*arguments, evaluate=False)  # a printed decimal is not multiplied out
    if head in ("Integral", "Sum"):
        return HEADS[head](arguments[0], *(Tuple(*a) for a in arguments[1:]))
    return HEADS[head](*arguments)
