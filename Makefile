# Two commands on a fresh machine: `make verify` and `make test`. A second run reuses the set-up.
PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready

.PHONY: verify verify-fresh test test-deep lint bench chart walk report notebooks generate clean

$(READY): pyproject.toml constraints.txt
	$(PYTHON) -c 'import sys; sys.exit("Python 3.11 or newer is needed") if sys.version_info < (3, 11) else None'
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[test]'
	touch $(READY)

verify: $(READY)
	$(BIN)/xsec verify

verify-fresh: $(READY)
	$(BIN)/xsec verify --fresh

lint: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

# Where the record is up to date, verdicts are replayed; where it is not, they are earned anew, which takes longer:
# record first, by `xsec verify --fresh --record`.
test: lint
	$(BIN)/python -m pytest

# The same, with every verdict earned anew, and with the tests that repeat at more points what a quicker one shows.
test-deep: lint
	$(BIN)/python -m pytest --deep

bench: $(READY)
	$(BIN)/python -m tests.bench

# Draws speed against accuracy, and the failure maps, from the stored measurements; `xsec chart NAME --measure` makes new
# ones.
chart: $(READY)
	$(BIN)/python -m xsec_sym.study draw charts

# Simulates two media, and compares them with Smith's theory and with each other.
walk: $(READY)
	$(BIN)/python -m xsec_sym.walks

# Writes the record as a static page; open report/index.html.
report: $(READY)
	$(BIN)/xsec report

notebooks: $(READY)
	$(BIN)/python -m pytest tests/test_notebooks.py

# Writes the generated kernels anew from the recorded verdicts, and the tables of H, of the spherical Gaussian and of the
# fits; tests compare them with what is committed. Last, the code of every entry for the report, which takes minutes.
generate: $(READY)
	$(BIN)/python -m xsec_sym.export
	$(BIN)/python -m xsec_sym.export.isotropic
	$(BIN)/python -m xsec_sym.export.spherical_gaussian
	$(BIN)/python -m xsec_sym.export.spherical_gaussian_slopes
	$(BIN)/python -m xsec_sym.export.lambert_sphere_fits
	$(BIN)/python -m xsec_sym.report.code

clean:
	rm -rf .venv build *.egg-info
