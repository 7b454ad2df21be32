"""What differs between two formulas, made visible in both."""

from __future__ import annotations

from difflib import SequenceMatcher
from xml.etree import ElementTree

from xsec_sym.report.formula import ROWS, Node, fenced

GONE, NEW = "gone", "new"
# Stands where the print lacks something.
GAP = "gap"


def mark(printed: Node, corrected: Node) -> None:
    """Give the parts of one tree that the other has not the class "gone", and "new" the other way round.

    Where the print lacks something between its parts, it gets a mark of the class "gap".

    >>> from xsec_sym.report.formula import tree
    >>> one, other = tree("a + b x"), tree("a - b x^2")
    >>> mark(one, other)
    >>> [(n.text, n.get("class")) for n in one.iter() if n.get("class")]
    [('+', 'gone'), ('x', 'gone')]
    >>> [(n.text, n.get("class")) for n in other.iter() if n.get("class")]
    [('−', 'new'), ('2', 'new')]
    """
    if _same(printed, corrected):
        return
    if printed.tag == corrected.tag and len(printed) and printed.tag in ROWS:
        if not (_holds(corrected, printed, NEW) or _holds(printed, corrected, GONE)):
            _rows(printed, corrected)
    elif printed.tag == corrected.tag and len(printed) == len(corrected) > 0 and not _nested(printed, corrected):
        for place in range(len(printed)):
            if "mrow" in (printed[place].tag, corrected[place].tag):
                _as_row(printed, place)
                _as_row(corrected, place)
            mark(printed[place], corrected[place])
    elif _wraps(corrected, printed, NEW):
        # what is about it is marked beside; in print, the thing itself shows the place
        if sum(len(node) == 0 for node in printed.iter()) <= 3:
            _flag([printed], GONE)
    elif not _wraps(printed, corrected, GONE):
        _flag([printed], GONE)
        _flag([corrected], NEW)


def marked(node: Node) -> list[Node]:
    return [n for n in node.iter() if n.get("class") in (GONE, NEW, GAP)]


def _text(node: Node) -> str:
    return ElementTree.tostring(node, encoding="unicode")


def _same(one: Node, other: Node) -> bool:
    return _text(one) == _text(other)


def _part(whole: Node, part: Node) -> bool:
    """A letter in a row says nothing: it occurs in many."""
    return (len(part) > 0 or whole.tag not in ROWS) and any(_same(child, part) for child in whole)


def _nested(one: Node, other: Node) -> bool:
    return _part(one, other) or _part(other, one)


def _flag(nodes: list[Node], word: str) -> None:
    for node in nodes:
        if node.tag != "mspace":
            node.set("class", word)


def _wraps(outer: Node, inner: Node, word: str) -> bool:
    """Where one is the other with something about it, such as an exponent or bars, only that is marked."""
    children = list(outer)
    inside = list(inner) if (inner.tag, outer.tag) in (("mrow", outer.tag), ("msub", "msubsup")) else [inner]
    texts, wanted = [_text(c) for c in children], [_text(c) for c in inside]
    for start in range(len(children) - len(wanted) + 1):
        if texts[start : start + len(wanted)] == wanted and len(wanted) < len(texts):
            _flag(children[:start] + children[start + len(wanted) :], word)
            return True
    return False


def _holds(outer: Node, inner: Node, word: str) -> bool:
    """Where one row has become a part of the only thing in the other, such as a numerator, the rest is marked."""
    if len(outer) != 1 or len(inner) < 2 or fenced(inner) or _part(inner, outer[0]):
        return False
    rated = [(_alike(part, inner), place) for place, part in enumerate(outer[0]) if part.tag == "mrow"]
    if not rated or max(rated)[0] < 0.8:
        return False
    place = max(rated)[1]
    _flag([part for k, part in enumerate(outer[0]) if k != place], word)
    _rows(*((inner, outer[0][place]) if word == NEW else (outer[0][place], inner)))
    return True


def _as_row(parent: Node, place: int) -> None:
    if parent[place].tag != "mrow" or fenced(parent[place]):
        row = Node("mrow")
        row.append(parent[place])
        parent[place] = row


def _rows(printed: Node, corrected: Node) -> None:
    ones, others = list(printed), list(corrected)
    texts, wanted = [_text(n) for n in ones], [_text(n) for n in others]
    gaps = []
    for action, i, i_end, j, j_end in SequenceMatcher(None, texts, wanted, autojunk=False).get_opcodes():
        if action == "equal":
            continue
        here, there = ones[i:i_end], others[j:j_end]
        for one, other in _paired(here, there):
            mark(one, other)
            here = [n for n in here if n is not one]
            there = [n for n in there if n is not other]
        _flag(here, GONE)
        _flag(there, NEW)
        if action == "insert":
            gaps.append(i)
    for place in reversed(gaps):
        printed.insert(place, Node("mspace", {"class": GAP, "width": "0.16em", "height": "0.7em", "depth": "0.2em"}))


def _paired(ones: list[Node], others: list[Node]) -> list[tuple[Node, Node]]:
    """Which parts of two unequal runs stand for each other: in order, those that are most alike."""
    found: list[tuple[Node, Node]] = []
    start = 0
    for one in ones:
        rated = [(_alike(one, other), -place) for place, other in enumerate(others) if place >= start]
        if rated and max(rated)[0] >= 0.5:
            place = -max(rated)[1]
            found.append((one, others[place]))
            start = place + 1
    return found


def _alike(one: Node, other: Node) -> float:
    if len(one) == 0 and len(other) == 0:
        return 0.0
    if _nested(one, other):
        return 1.0
    here, there = ([n.tag + (n.text or "") for n in node.iter()] for node in (one, other))
    return SequenceMatcher(None, here, there, autojunk=False).ratio()
