"""The index in `help(xsec_sym.kernels)`, and how the signatures read there."""

import inspect
import re

import pytest

from xsec_sym import kernels

LISTED = re.findall(r"^    (\w+)\((.*?)\): (.+)$", kernels.__doc__, re.MULTILINE)


def test_every_public_name_is_listed_once():
    assert sorted(name for name, _, _ in LISTED) == sorted(kernels.__all__)


@pytest.mark.parametrize(("name", "arguments", "said"), LISTED)
def test_with_the_arguments_that_it_needs(name, arguments, said):
    needed = [p.name for p in inspect.signature(getattr(kernels, name)).parameters.values() if p.default is p.empty]
    assert arguments == ", ".join(needed) and said


@pytest.mark.parametrize("name", kernels.__all__)
def test_a_signature_names_types_as_they_are_written(name):
    """What ArrayLike stands for takes ten lines, and would hide the arguments."""
    said = str(inspect.signature(getattr(kernels, name)))
    assert len(said) < 240 and "_NestedSequence" not in said
