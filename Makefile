# make study      packings, spectra and figures of config/default.yaml
# make test       the tests, on all cores (minutes)
# make test-slow  the slow physics and large systems      make test-all   both
# make pardiso    add a faster sparse factorisation to the environment (x86-64, MKL's licence)
# make lint       style, the walls between rooms, and types
# make handbook the parts of the documentation that follow from tables
# make reference CONFIG=…  a finished study becomes a reference ensemble of the package
# make clean      forget results, logs, compiled kernels and Snakemake's bookkeeping
#
# Needed on the machine: Python >= 3.11 with pip, a C compiler, make. CONFIG=config/paper_a.yaml
# chooses another scene, JOBS=8 more jobs at once, WORKERS=4 more processes that test,
# PYTHON=python3.12 another Python for .venv.

PYTHON ?= python3
JOBS ?= 2
WORKERS ?= auto
CONFIG ?=
BIN := .venv/bin
READY := .venv/ready

# Each process takes whole files, the longest unit first (tests/conftest.py).
PYTEST := $(BIN)/python -m pytest --numprocesses $(WORKERS) --no-loadscope-reorder

.PHONY: study test test-slow test-all pardiso lint handbook reference clean
.NOTPARALLEL:

study: $(READY)
	$(BIN)/python workflow/scripts/study.py -j$(JOBS) $(if $(CONFIG),--configfile $(CONFIG))

test: $(READY)
	$(PYTEST)

test-slow: $(READY)
	$(PYTEST) -m slow

test-all: test test-slow

pardiso: $(READY)
	$(BIN)/python -m pip install --quiet --requirement requirements-pardiso.lock

lint: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/snakefmt --check --line-length 100 Snakefile workflow
	$(BIN)/lint-imports
	$(BIN)/mypy --no-error-summary | $(BIN)/mypy-baseline filter

handbook: $(READY)
	$(BIN)/python workflow/scripts/handbook.py

reference: $(READY)
	$(BIN)/python workflow/scripts/reference.py $(CONFIG)

clean:
	rm -rf results/* logs .snakemake .numba_cache .pytest_cache .ruff_cache .import_linter_cache .mypy_cache

$(READY): requirements.lock
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --requirement requirements.lock
	$(BIN)/python -m pip install --quiet --no-deps --editable .
	touch $@
