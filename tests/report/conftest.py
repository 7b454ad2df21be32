"""One report for all tests of this folder, built once a worker."""

import contextlib
from dataclasses import dataclass
from pathlib import Path

import pytest

from xsec_sym.record import ledger
from xsec_sym.report import build
from xsec_sym.report.site import steps
from xsec_sym.study import method


@dataclass(frozen=True)
class Site:
    folder: Path

    def text(self, name):
        return (self.folder / name).read_text(encoding="utf-8")

    @property
    def pages(self):
        return sorted(p.name for p in self.folder.glob("*.html"))


@contextlib.contextmanager
def few_charts():
    """Two quantities stand for all: drawing the others is what takes most of a build's time."""
    kept = {name: method.HOMES[name] for name in ("albedo_lambert_sphere", "albedo_lambert_sphere_inverse")}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(method, "HOMES", kept)
        yield


@pytest.fixture(scope="session")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site") / "report"
    with few_charts():
        told = []
        build(folder, tick=told.append)
        assert len(told) == steps(ledger)
    return Site(folder)
