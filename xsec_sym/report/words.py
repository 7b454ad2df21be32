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
    """The text with the ids in it as links, and formulas in a face of equal widths.

    >>> print(linked("by xsec:sg-odd, x < 1", {"xsec:sg-odd"}))
    by <a href="xsec.html#sg-odd">xsec:sg-odd</a>, <code class="maths">x &lt; 1</code>
    """
    said = Markup("")
    end = 0
    for found in re.finditer(r"\b[a-z_0-9]+:[\w.-]*\w", text):
        if found[0] in known:
            said += prose(text[end : found.start()]) + Markup('<a href="{}">{}</a>').format(href(found[0]), found[0])
            end = found.end()
    return said + prose(text[end:])


# What the words beside a formula mean, in the order in which an entry has them.
TERMS = {
    "in print": "the equation as the text of the paper has it; what differs from what holds is red",
    "what holds": "the corrected form, proved or confirmed; what the print lacks is green",
    "change": "the smallest edit of the print that mends it",
    "where": "the values for which it is claimed, and was checked",
    "reading": "how the text is understood where it leaves something open: normalisations, conventions, what is meant",
    "fails at": "a point where the two sides differ, each with the radius of the ball that encloses it",
    "derivation": "the moves of the proof, in order; the checker replays each of them",
    "evidence": "what else was tried, and with what result",
    "uses": "the entries on which its proof rests",
}


def to_entries(text: str, known: Container[str]) -> Markup:
    """A text of HTML in which ids that stand as code lead to their entries.

    >>> print(to_entries("by <code>deon2016:25</code> or <code>a:b</code>", {"deon2016:25"}))
    by <a href="deon2016.html#25"><code>deon2016:25</code></a> or <code>a:b</code>
    """

    def leading(found: re.Match[str]) -> str:
        return f'<a href="{href(found[1])}">{found[0]}</a>' if found[1] in known else found[0]

    return Markup(re.sub(r"<code>([a-z_0-9]+:[\w.-]+)</code>", leading, text))


# A word that only a formula has, one that may stand in it, and a sign between two.
_SURE = re.compile(r"\S*(?:[\^*]|\w_\w|\w\(|\|\w|\de[-+]?\d)\S*")
_MAYBE = re.compile(r"[(\[|-]*(?:\d[\w.]*|[A-Za-z]'?|infinity|" + "|".join(GREEK) + r")[)\]|,;:.]*")
_SIGN = re.compile(r"[-+*/=<>~]|[<>!]=|->")
# Stands before a formula as its factor: letters but those that are words.
_FACTOR = re.compile(r"\(*(?:\d+|[b-zB-HJ-Z]|" + "|".join(GREEK) + ")")
LONG = 28


def prose(text: str) -> Markup:
    """Words, with the formulas among them told apart as code.

    >>> print(prose("square the u_i in the bracket: (u_i^2 - 1) for (u_i - 1), for p < 0 (an even one)"))
    square the <code class="maths">u_i</code> in the bracket: <code class="maths">(u_i^2 - 1)</code> for \
<code class="maths">(u_i - 1)</code>, for <code class="maths">p &lt; 0</code> (an even one)
    """
    parts = re.split(r"(\s+)", text)  # words at even places, what is between them at odd ones
    words, said, k = parts[::2], Markup(""), 0
    while k < len(words):
        end = _formula(words, k)
        run = "".join(parts[2 * k : 2 * end + 1])
        said += _code(run) if end > k or _SURE.fullmatch(run) else escape(run)
        said += escape(parts[2 * end + 1]) if 2 * end + 1 < len(parts) else ""
        k = end + 1
    return said


def _formula(words: list[str], k: int) -> int:
    """The place of the last word of the formula that begins at this one."""

    def fits(word: str) -> bool:
        return bool(_SURE.fullmatch(word) or _MAYBE.fullmatch(word))

    end = k
    inside = _deeper(words[k])
    while fits(words[k]) and end + 1 < len(words) and (words[end][-1] not in ",;:." or inside > 0):
        following = words[end + 1]
        factors = (_SURE.fullmatch(following) and (_SURE.fullmatch(words[end]) or _FACTOR.fullmatch(words[end]))) or (
            words[end].lstrip("(").isdigit()
            and _FACTOR.fullmatch(following.rstrip("),;:."))
            and not following.rstrip("),;:.").isdigit()
        )
        if _SIGN.fullmatch(following) and end + 2 < len(words) and fits(words[end + 2]):
            step = 2
        elif factors or (inside > 0 and (end > k or _SURE.fullmatch(words[k])) and fits(following)):
            step = 1
        else:
            break
        inside += sum(map(_deeper, words[end + 1 : end + 1 + step]))
        end += step
    return end


def _deeper(word: str) -> int:
    return word.count("(") - word.count(")")


def _code(run: str) -> Markup:
    """Brackets and stops that belong to the sentence stay out of it."""
    core = run.rstrip(",;:.")
    head = tail = ""
    while core.count("(") > core.count(")") and core.startswith("("):
        head, core = head + "(", core[1:]
    while core.count(")") > core.count("(") and core.endswith(")"):
        tail, core = ")" + tail, core[:-1]
    tail += run[len(run.rstrip(",;:.")) :]
    kind = "maths long" if len(core) > LONG else "maths"
    return escape(head) + Markup('<code class="{}">{}</code>').format(kind, core) + escape(tail)


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


def titled(text: str) -> Markup:
    """A title, with letters for the names of Greek ones and indices below.

    >>> print(titled("the area is Lambda cos(theta_i), with D_+ and alpha^2"))
    the area is <i>Λ</i> cos(<i>θ<sub>i</sub></i>), with <i>D<sub>+</sub></i> and <i>α</i><sup>2</sup>
    """
    greek = "|".join(name for name in GREEK if name not in ("oo", "ell"))
    said = Markup("")
    end = 0
    for found in re.finditer(rf"\b(?:(?:{greek})(?:_(?:\w+\b|[+-]))?|[A-Za-z]_(?:\w+\b|[+-]))(?!\w)|\^(\d+)", text):
        letter = Markup("<sup>{}</sup>").format(found[1]) if found[1] else _symbol(found[0])
        said += escape(text[end : found.start()]) + letter
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
