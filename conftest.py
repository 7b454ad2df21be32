"""For every worker of a test run; read before any of them imports NumPy."""

import os

import pytest

# The runner already keeps each core busy: BLAS threads that wait for a core make small matrices ten times slower.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def pytest_addoption(parser):
    parser.addoption("--deep", action="store_true", help="every verdict anew, every point of every grid; takes longer")


def pytest_configure(config):
    config.addinivalue_line("markers", "deep: takes long, and has a cheaper version that always runs; run by --deep")


def pytest_collection_modifyitems(config, items):
    if not config.getoption("--deep"):
        left_out = [item for item in items if item.get_closest_marker("deep")]
        config.hook.pytest_deselected(items=left_out)
        items[:] = [item for item in items if not item.get_closest_marker("deep")]


@pytest.fixture(scope="session")
def deep(request):
    """Whether to do all, or what is enough as long as the same has been done before."""
    return request.config.getoption("--deep")
