"""LaTeX as native MathML: the trees that a browser sets, tidied so that two of them can be compared."""

from __future__ import annotations

from copy import deepcopy
from functools import cache
from itertools import pairwise
from xml.etree import ElementTree

Node = ElementTree.Element
# Elements that set their children in a row; in all others the place of a child has a meaning.
ROWS = frozenset({"math", "mrow", "msqrt", "mtd", "mstyle"})
NAMESPACE = "{http://www.w3.org/1998/Math/MathML}"
THIN = "0.17em"
# What stands higher than a letter with its indices: only about these do brackets grow.
TALL = frozenset({"mfrac", "msqrt", "mroot", "munder", "mover", "munderover", "mtable"})
# After these a sign is that of a number, not a sum's.
BEFORE_A_SIGN = frozenset("(=,<>[·≤≥")


class Unset(ValueError):
    """A formula that cannot be set."""


def tree(latex: str) -> Node:
    """A formula as MathML, free to be changed. Raises `Unset`.

    >>> [child.tag for child in tree(r"\\frac{a}{b} + 1")]
    ['mfrac', 'mo', 'mn']
    """
    return deepcopy(_tree(latex))


@cache
def _tree(latex: str) -> Node:
    from latex2mathml.converter import convert

    try:
        found = ElementTree.fromstring(convert(latex))
    except Exception as error:  # the converter has no common class of its own for what it cannot read
        raise Unset(f"{latex} cannot be set: {error!r}") from error
    for node in found.iter():
        node.tag = node.tag.removeprefix(NAMESPACE)
    found.attrib.clear()
    _tidy(found)
    _space(found)
    return found


def written(math: Node, display: bool = True) -> str:
    """The tree as a text for a page."""
    _fit(math)
    math.set("display", "block" if display else "inline")
    return ElementTree.tostring(math, encoding="unicode")


def set_(latex: str, display: bool = True) -> str:
    """A formula as text.

    >>> set_("a^2", display=False)
    '<math display="inline"><msup><mi>a</mi><mn>2</mn></msup></math>'
    """
    return written(tree(latex), display)


def equation(left: Node | None, right: Node | None, relation: str = "=") -> str:
    """Both sides as texts, one after the other: a narrow page puts them on two lines.

    >>> equation(tree("a"), tree("b"))
    '<math display="block"><mi>a</mi></math><math display="block"><mo form="infix">=</mo><mi>b</mi></math>'
    """
    if left is not None and right is not None:
        sign = Node("mo", {"form": "infix"})
        sign.text = relation
        right.insert(0, sign)
    return "".join(written(side) for side in (left, right) if side is not None)


# --- tidying --------------------------------------------------------------------------------------------------


def fenced(node: Node) -> bool:
    """Whether a row stands in brackets that grow with it."""
    return node.tag == "mrow" and len(node) > 0 and node[0].get("fence") == "true"


def _tidy(node: Node) -> None:
    """Rows that group nothing go: two trees shall differ only where the formulas do."""
    children: list[Node] = []
    for child in list(node):
        _tidy(child)
        plain = child.tag == "mrow" and not fenced(child)
        if plain and node.tag in ROWS:
            children.extend(child)
        elif plain and len(child) == 1:
            children.append(child[0])
        else:
            children.append(child)
    if node.tag == "mo" and (_is_name(node.text) or node.text == "∞"):
        node.tag = "mi"
        node.attrib.clear()
    if node.tag == "mrow":
        node.attrib.clear()
    node.tail = None
    node[:] = children


def _fit(node: Node) -> None:
    """Brackets about low things stay low, for a browser sets those that may grow in a wider space; signs join on.

    Only when a tree is written: until then two trees differ only where the formulas do.

    >>> print(set_(r"\\left(-1\\right)", display=False))
    <math display="inline"><mrow><mo stretchy="false" fence="true" form="prefix">(</mo><mo form="prefix">−</mo>\
<mn>1</mn><mo stretchy="false" fence="true" form="postfix">)</mo></mrow></math>
    """
    if fenced(node) and not any(part.tag in TALL or _grows(part) for part in node.iter()):
        for part in node:
            if part.tag == "mo" and part.get("fence") == "true":
                part.set("stretchy", "false")
    for before, sign in pairwise(node):
        if sign.tag == "mo" and sign.text in ("−", "+", "-") and before.tag == "mo" and before.text in BEFORE_A_SIGN:
            sign.set("form", "prefix")
    for child in node:
        _fit(child)


def _grows(node: Node) -> bool:
    """A sign of an integral or a sum, with or without its ends."""
    return node.tag == "mo" and node.text in ("∫", "∑", "∏")


def _is_name(text: str | None) -> bool:
    return bool(text) and len(text or "") > 1 and (text or "").isalpha()


def _function(node: Node) -> bool:
    base = node[0] if node.tag in ("msup", "msub", "msubsup", "munder") and len(node) else node
    return base.tag == "mi" and _is_name(base.text)


def _space(node: Node) -> None:
    """A thin space beside the names of functions, where no operator or bracket keeps them apart."""
    for child in node:
        _space(child)
    if node.tag not in ROWS:
        return
    children: list[Node] = []
    for child in node:
        before = children[-1] if children else None
        if before is not None and before.tag not in ("mo", "mspace") and child.tag not in ("mo", "mspace"):
            applied = _function(before) and fenced(child)
            if (_function(child) or _function(before)) and not applied:
                children.append(Node("mspace", {"width": THIN}))
        children.append(child)
    node[:] = children
