"""Every claim has LaTeX that can be set."""

import re

import pytest
from latex2mathml.converter import convert

from xsec_sym.proof.typeset import latex
from xsec_sym.record.discover import discover

CLAIMS = discover()
NAME = re.compile(r"\\(?:operatorname|mathrm|text|begin|end)\{[^{}]*\}|\\[a-zA-Z]+|_\{\w+\}")


def sides(claim):
    return [latex(e) for e in (claim.left, claim.printed, claim.corrected) if e is not None]


def balanced(text):
    depth = 0
    for brace in re.findall(r"(?<!\\)[{}]", text):
        depth += 1 if brace == "{" else -1
        if depth < 0:
            return False
    return depth == 0 and text.count(r"\left") - text.count(r"\leftarrow") == text.count(r"\right")


@pytest.mark.parametrize("source", sorted({c.source for c in CLAIMS.values()}))
def test_every_form_is_set(source):
    for claim in (c for c in CLAIMS.values() if c.source == source):
        for text in sides(claim):
            assert balanced(text) and convert(text), (claim.id, text)
            # a name that SymPy took for a subscript, or left as code: "omega_{1.omega m}", "cos(theta)"
            assert not re.search(r"[a-zA-Z]{4,}|[a-zA-Z}]\.|\.[a-zA-Z{]", NAME.sub(" ", text)), (claim.id, text)


def test_names_that_mean_something():
    assert r"\left(-\omega_{1} \cdot \omega_{m}\right)" in latex(CLAIMS["dupuy2016:4"].printed)
    assert r"\omega_{1} \cdot \nabla L" in latex(CLAIMS["dupuy2016:1"].left)
    assert latex(CLAIMS["deon2021:28"].corrected).startswith(r"{H^{(1)}}^{\frac")
