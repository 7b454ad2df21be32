# Two commands on a fresh machine: `make verify` and `make test`. A second run reuses the set-up. `make help` lists all:
# what stands behind ## at a target.
PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready

.DEFAULT_GOAL := verify
.PHONY: help verify verify-fresh test test-deep test-newest lint bench chart walk report notebooks lab generate clean

help:  ## this list
	@sed -nE 's/^([a-z-]+):.*## (.*)/make \1|\2/p' Makefile | awk -F'|' '{ printf "%-18s %s\n", $$1, $$2 }'

$(READY): pyproject.toml constraints.txt
	$(PYTHON) -c 'import sys; sys.exit("Python 3.11 or newer is needed") if sys.version_info < (3, 11) else None'
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[test]'
	touch $(READY)

verify: $(READY)  ## replay the recorded proofs, check every claim again numerically; some three minutes
	$(BIN)/xsec verify

verify-fresh: $(READY)  ## derive everything anew
	$(BIN)/xsec verify --fresh

lint: $(READY)  ## ruff and mypy
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

# Where the record is up to date, verdicts are replayed; where it is not, they are earned anew, which takes longer:
# record first, by `xsec verify --fresh --record`.
test: lint  ## these, the tests, doctests, guides and notebooks
	$(BIN)/python -m pytest

# The same, with every verdict earned anew, and with the tests that repeat at more points what a quicker one shows.
test-deep: lint  ## the same, every verdict earned anew, at more points
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
chart: $(READY)  ## charts and maps from the stored measurements
	$(BIN)/python -m xsec_sym.study draw charts

# Simulates two media, and compares them with Smith's theory and with each other.
walk: $(READY)  ## simulate light in two media, against the closed forms
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
generate: $(READY)  ## the generated kernels, tables and the report's code anew
	$(BIN)/python -m xsec_sym.export
	$(BIN)/python -m xsec_sym.export.isotropic
	$(BIN)/python -m xsec_sym.export.spherical_gaussian
	$(BIN)/python -m xsec_sym.export.spherical_gaussian_slopes
	$(BIN)/python -m xsec_sym.export.lambert_sphere_fits
	$(BIN)/python -m xsec_sym.report.code

clean:  ## remove the set-up
	rm -rf .venv .venv-newest build *.egg-info
