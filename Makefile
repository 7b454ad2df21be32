# Two commands on a fresh machine: `make verify` and `make test`. A second run reuses the set-up.
PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready

.PHONY: help verify verify-fresh test test-deep test-newest lint bench chart walk report notebooks lab generate clean

$(READY): pyproject.toml constraints.txt
	$(PYTHON) -c 'import sys; sys.exit("Python 3.11 or newer is needed") if sys.version_info < (3, 11) else None'
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[test]'
	touch $(READY)

# `make` alone is `make verify`.
.DEFAULT_GOAL := verify

help:  ## this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-14s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

verify: $(READY)  ## replay the recorded proofs, check every claim again, print the verdicts
	$(BIN)/xsec verify

verify-fresh: $(READY)  ## derive everything anew, and compare with the record
	$(BIN)/xsec verify --fresh

lint: $(READY)  ## ruff and mypy
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

# Where the record is up to date, verdicts are replayed; where it is not, they are earned anew, which takes longer:
# record first, by `xsec verify --fresh --record`.
test: lint  ## lint, tests, doctests, guides and notebooks; warnings are errors
	$(BIN)/python -m pytest

# The same, with every verdict earned anew, and with the tests that repeat at more points what a quicker one shows.
test-deep: lint  ## the same with every verdict earned anew, at more points
	$(BIN)/python -m pytest --deep

# The suite with the newest releases, whatever the pins say, to see what the next ones will break: a set-up of its own,
# where warnings are shown but are no errors. `make test-newest PRE=--pre` takes pre-releases, `PAST=mpmath==1.4.1` what
# the newest SymPy does not allow, and `TESTS=tests/kernels` a part of the suite.
NEWEST := .venv-newest/bin/python
NAMES := import re, tomllib; p = tomllib.load(open("pyproject.toml", "rb"))["project"]; \
    print(*sorted({re.match(r"[\w.-]+", d)[0] for d in p["dependencies"] + p["optional-dependencies"]["test"]}))
test-newest:  ## the suite with the newest releases, in a set-up of its own
	$(PYTHON) -m venv --clear .venv-newest
	$(NEWEST) -m pip install --quiet --disable-pip-version-check --upgrade $(PRE) \
	    setuptools $$($(PYTHON) -c '$(NAMES)')
	$(if $(PAST),$(NEWEST) -m pip install --quiet --disable-pip-version-check --no-deps $(PAST))
	$(NEWEST) -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	$(NEWEST) -m pip list --disable-pip-version-check | grep -iE '^(sympy|mpmath|numpy|scipy|gmpy2|python-flint|numba) '
	$(NEWEST) -m pytest -W default $(TESTS)

bench: $(READY)  ## what the kernels cost
	$(BIN)/python -m tests.bench

# Draws speed against accuracy, and the failure maps, from the stored measurements; `xsec chart NAME --measure` makes new
# ones.
chart: $(READY)  ## charts and failure maps from the stored measurements
	$(BIN)/python -m xsec_sym.study draw charts

# Simulates two media, and compares them with Smith's theory and with each other.
walk: $(READY)  ## random walks against the closed forms and each other
	$(BIN)/python -m xsec_sym.walks

# Writes the record as a static page; open report/index.html.
report: $(READY)  ## the record as pages: report/index.html
	$(BIN)/xsec report

notebooks: $(READY)  ## run the notebooks
	$(BIN)/python -m pytest tests/test_notebooks.py

# Opens the notebooks in JupyterLab, which is installed on the first use; the sliders work there.
lab: .venv/.lab  ## open the notebooks in JupyterLab
	$(BIN)/jupyter lab --notebook-dir notebooks

.venv/.lab: $(READY)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[test,notebooks]'
	touch .venv/.lab

# Writes the generated kernels anew from the recorded verdicts, and the tables of H, of the spherical Gaussian and of the
# fits; tests compare them with what is committed. Last, the code of every entry for the report, which takes minutes.
generate: $(READY)  ## write the generated kernels, tables and code anew
	$(BIN)/python -m xsec_sym.export
	$(BIN)/python -m xsec_sym.export.isotropic
	$(BIN)/python -m xsec_sym.export.spherical_gaussian
	$(BIN)/python -m xsec_sym.export.spherical_gaussian_slopes
	$(BIN)/python -m xsec_sym.export.lambert_sphere_fits
	$(BIN)/python -m xsec_sym.report.code

clean:  ## remove the set-ups and what was built
	rm -rf .venv .venv-newest build *.egg-info
