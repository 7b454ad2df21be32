"""One report for all tests of this folder, built once a worker."""

import time
from dataclasses import dataclass
from pathlib import Path

import pytest

from xsec_sym.report import build


@dataclass(frozen=True)
class Site:
    folder: Path
    seconds: float

    def text(self, name):
        return (self.folder / name).read_text(encoding="utf-8")

    @property
    def pages(self):
        return sorted(p.name for p in self.folder.glob("*.html"))


@pytest.fixture(scope="session")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site") / "report"
    start = time.process_time()
    build(folder)
    return Site(folder, time.process_time() - start)
