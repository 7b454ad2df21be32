"""The reference against what can be imported, and that every name says enough to be used."""

import importlib
import inspect

import pytest

from tests.report.test_site import Page
from xsec_sym.report.reference import MODULES, STUDY, modules

FOUND = {module.path: module for module in modules()}
NAMES = [name for module in FOUND.values() for name in module.names]


@pytest.mark.parametrize("name", NAMES, ids=lambda name: name.path)
def test_every_public_name_has_a_docstring_with_an_example(name):
    assert len(name.doc.splitlines()[0]) > 10
    assert name.example


def test_no_public_name_is_left_out():
    for path in MODULES:
        listed = [name.path for name in FOUND[path].names]
        if path == "xsec_sym.study":
            assert listed == [f"{home}.{name}" for home, names in STUDY.items() for name in names]
            for home, names in STUDY.items():
                for name in names:
                    assert importlib.import_module(home).__dict__[name].__module__ == home
        elif path == "xsec_sym.kernels.compiled":
            compiled = pytest.importorskip(path)
            own = [n for n, f in vars(compiled).items() if inspect.isfunction(f) and f.__module__ == path]
            assert listed == [f"{path}.{n}" for n in own if not n.startswith("_")]
        else:
            public = importlib.import_module(path).__all__
            assert listed == [f"{path}.{n}" for n in public if n != "REGISTRY"]


def test_an_example_would_fail_if_it_were_wrong():
    """pytest collects every module of the package, by `--doctest-modules` and `testpaths`."""
    import doctest

    for name in NAMES:
        if name.kind in ("function", "class", "exception") and "compiled" not in name.path:
            home, _, attribute = name.path.rpartition(".")
            found = getattr(importlib.import_module(home), attribute)
            assert found.__module__.startswith("xsec_sym.")
            assert any(test.examples for test in doctest.DocTestFinder(recurse=False).find(found)), name.path


def test_the_page(site):
    page = Page(site.text("reference.html"))
    index = [
        e for e in page.elements if e["tag"] == "a" and any(w["attrs"].get("class") == "names" for w in e["within"])
    ]
    assert sorted(e["attrs"]["href"] for e in index) == sorted(f"#api:{n.path}" for n in NAMES)
    articles = page.of_class("name")
    assert [a["attrs"]["id"] for a in articles] == [f"api:{n.path}" for m in FOUND.values() for n in m.names]
    ggx = next(a for a in articles if a["attrs"]["id"] == "api:xsec_sym.kernels.sigma_ggx")
    assert "sigma_ggx(u, alpha)" in ggx["text"] and ">>> sigma_ggx(" in ggx["text"]
    assert 'href="deon2016.html#25"' in site.text("reference.html"), "what a docstring cites can be read"
    assert "projected area" in ggx["attrs"]["data-find"]
    assert " at 0x" not in site.text("reference.html"), "what changes from run to run"
    assert 'href="reference.html"' in site.text("index.html")
