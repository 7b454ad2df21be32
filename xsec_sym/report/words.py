"""Texts of the record as HTML: letters for the names of symbols, and links for the ids in them."""

from __future__ import annotations

import re
from collections.abc import Container
from typing import Any

from markupsafe import Markup, escape

GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "zeta": "ζ", "theta": "θ", "kappa": "κ",
    "lambda": "λ", "Lambda": "Λ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π", "rho": "ρ", "sigma": "σ", "tau": "τ",
    "phi": "φ", "varphi": "φ", "chi": "χ", "psi": "ψ", "Psi": "Ψ", "omega": "ω", "ell": "ℓ", "Gamma": "Γ", "oo": "∞",
}  # fmt: skip
SIGNS = {"<=": "≤", ">=": "≥", "!=": "≠", "-": "−", "*": "·", "|": "or", "&": "and"}
BALL = re.compile(r"\[?(?:(?P<middle>-?[\d.e+-]+) )?\+/- (?P<radius>[\d.e+-]+)\]?")


def href(name: str) -> str:
    """Where an entry stands, from any page.

    >>> href("deon2016:T1.u2.s3")
    'deon2016.html#T1.u2.s3'
    """
    source, _, label = name.partition(":")
    return f"{source}.html#{label}"


def linked(text: str, known: Container[str]) -> Markup:
    """The text with the ids in it as links.

    >>> print(linked("by xsec:sg-odd, x < 1", {"xsec:sg-odd"}))
    by <a href="xsec.html#sg-odd">xsec:sg-odd</a>, x &lt; 1
    """
    said = Markup("")
    end = 0
    for found in re.finditer(r"\b[a-z_0-9]+:[\w.-]*\w", text):
        if found[0] in known:
            said += escape(text[end : found.start()]) + Markup('<a href="{}">{}</a>').format(href(found[0]), found[0])
            end = found.end()
    return said + escape(text[end:])


def symbols(text: str) -> Markup:
    """A domain or a point as a reader writes it.

    >>> print(symbols("u_i in (-1, 1); alpha in (0, oo)"))
    <i>u<sub>i</sub></i> ∈ (−1, 1); <i>α</i> ∈ (0, ∞)
    >>> print(symbols("sqrt(1 - u**2) >= 0"))
    sqrt(1 − <i>u</i><sup>2</sup>) ≥ 0
    """
    said = Markup("")
    end = 0
    for found in re.finditer(r"[A-Za-z]+_[+-]|[A-Za-z]\w*|\*\*(\d+)|<=|>=|!=|[-*|&]", text):
        power = Markup("<sup>{}</sup>").format(found[1]) if found[1] else _symbol(found[0])
        said += escape(text[end : found.start()]) + power
        end = found.end()
    return said + escape(text[end:])


def _symbol(word: str) -> Markup:
    if word in SIGNS:
        return Markup(SIGNS[word])
    if word == "in":
        return Markup("∈")
    base, _, low = word.partition("_")
    letter = GREEK.get(base, base)
    if letter == "∞" or len(letter) > 1:
        return escape(letter if not low else word)
    if not low and (tail := re.fullmatch(r"(\w)(\d+)", letter)):
        letter, low = tail[1], tail[2]
    low = SIGNS.get(low, GREEK.get(low, low))
    below = Markup("<sub>{}</sub>").format(low) if low else ""
    return Markup("<i>{}{}</i>").format(letter, below)


def ball(text: str) -> str:
    """A number with its radius, as it is usually written.

    >>> ball("[14.969063729665949471 +/- 2.09e-19]")
    '14.969063729665949471 ± 2.09e−19'
    >>> ball("[+/- 3.39e-111]")
    '0 ± 3.39e−111'
    """
    found = BALL.fullmatch(text)
    return f"{found['middle'] or 0} ± {found['radius']}".replace("-", "−") if found else text


def said(value: Any) -> str:
    """A value of the evidence in words."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, dict):
        return ", ".join(f"{k} = {said(v)}" for k, v in value.items())
    return ", ".join(map(said, value)) if isinstance(value, list) else str(value)
