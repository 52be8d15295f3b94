# Everything runs in a virtual environment of its own, made on first use.
PYTHON ?= python3
VENV ?= .venv
BIN := $(VENV)/$(if $(filter Windows_NT,$(OS)),Scripts,bin)
PIP := $(BIN)/python -m pip --disable-pip-version-check -q
OLDEST := .venv-oldest
CODES := .codes
# Linear algebra here is small: threads would only get in each other's way.
export OMP_NUM_THREADS ?= 1
export OPENBLAS_NUM_THREADS ?= 1
# Tests are compiled once, not again by each worker and child.
export PYTHONDONTWRITEBYTECODE :=

.PHONY: run figures images golden references codes test test-all test-oldest coverage bench lint pages docs docs-draft check-site check clean

run: $(VENV)/.run  ## the main job: spin the paper's beam up
	$(BIN)/python models/rotating_beam.py

figures: $(VENV)/.run  ## data, pictures and captions of every figure
	$(BIN)/rotbeam figure all

images: $(VENV)/.dev  ## the README's pictures, three of the pages', the drawings, and the class as a notebook
	$(BIN)/python docs/images/regenerate.py
	$(BIN)/python tools/notebook.py

golden: $(VENV)/.dev  ## regenerate the golden data of the tests
	$(BIN)/python tests/comparison/golden/regenerate.py
	$(BIN)/python tests/golden/test_paper_beam.py

references: $(VENV)/.kit  ## the benchmark's reference data, its problem statement, and the Explorer's data
	$(BIN)/python tools/references.py
	$(BIN)/python tools/problem.py
	$(BIN)/python tools/explorer.py

codes: $(CODES)/.made  ## other codes run the benchmark anew, in an hour; wants g++, CalculiX's ccx, OPENFAST for BeamDyn, WITH_MBDYN for MBDyn, CHRONO for Project Chrono
	for script in models/codes/*/run.py; do $(CODES)/bin/python $$script || exit 1; done
	$(CODES)/bin/python models/codes/overview.py

test: $(VENV)/.dev  ## the default test suite
	$(BIN)/python -m pytest -n auto --dist worksteal -m "not slow and not benchmarks and not site"

test-all: $(VENV)/.dev  ## the default suite, and what is marked slow
	$(BIN)/python -m pytest -n auto --dist worksteal -m "not benchmarks and not site" --hypothesis-profile all

test-oldest: $(OLDEST)/.made  ## the default suite on the lowest versions that pyproject.toml allows
	$(subst $(VENV),$(OLDEST),$(BIN))/python -m pytest -n auto --dist worksteal -m "not slow and not benchmarks and not site"

coverage: $(VENV)/.dev  ## which lines the default suite runs, in htmlcov/
	$(BIN)/python -m pytest -n auto --dist worksteal -m "not slow and not benchmarks and not site" \
	  --cov=analytic --cov=rotbeam_exu --cov-report=html --cov-report=term:skip-covered

bench: $(VENV)/.dev  ## speed and memory, each against a reference measured in the same run
	$(BIN)/python -m pytest -m benchmarks --benchmark-enable

lint: $(VENV)/.dev  ## linters and type checks
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

docs: $(VENV)/.docs  ## the site, in docs/_build/html; a warning is an error
	$(BIN)/python -m sphinx -j auto -E -W --keep-going -q -d docs/_build/doctrees docs docs/_build/html

pages: $(VENV)/.docs  ## what the pages' hidden code prints, written into the pages: as long as docs
	$(BIN)/python -m sphinx -j auto -E -q -D fill_pages=1 -D plot_gallery=0 -d docs/_build/draft-doctrees docs docs/_build/draft

docs-draft: $(VENV)/.docs  ## text, links and formulas of the site, in docs/_build/draft: half a minute
	$(BIN)/python -m sphinx -j auto -q -D computed_runs=0 -D plot_gallery=0 -d docs/_build/draft-doctrees docs docs/_build/draft

check-site: docs $(VENV)/.dev  ## the built site in a browser without a network, and by axe where npm is
	command -v npm >/dev/null && npm install --no-save --silent axe-core || echo "no axe: its tests will be skipped"
	$(BIN)/python -m pytest -m site tests/docs/test_site.py

check: lint test

$(VENV)/.pip:
	$(PYTHON) -m venv $(VENV)
	$(PIP) install "pip>=25.1"  # the first that knows dependency groups
	touch $@

$(VENV)/.run: pyproject.toml constraints.txt | $(VENV)/.pip
	$(PIP) install -c constraints.txt -e .
	touch $@

$(VENV)/.dev: pyproject.toml constraints.txt | $(VENV)/.pip
	$(PIP) install -c constraints.txt -e . --group test --group dev
	touch $@ $(VENV)/.run

$(VENV)/.docs: pyproject.toml constraints.txt | $(VENV)/.pip
	$(PIP) install -c constraints.txt -e . --group docs
	touch $@ $(VENV)/.run

$(VENV)/.kit: $(VENV)/.run
	$(PIP) install -c constraints.txt -e . --group kit
	touch $@

$(CODES)/.made: pyproject.toml constraints.txt
	$(PYTHON) -m venv $(CODES)
	$(CODES)/bin/python -m pip install -q "pip>=25.1"
	$(CODES)/bin/python -m pip install -q -c constraints.txt -e . --group codes
	touch $@

$(OLDEST)/.made: pyproject.toml constraints.txt | $(VENV)/.pip
	$(PIP) install -c constraints.txt uv
	$(BIN)/uv venv -q --clear --python 3.11 $(OLDEST)  # the lowest, too
	$(BIN)/uv pip install -q --python $(OLDEST) --resolution lowest-direct -e . --group test
	touch $@

clean:
	rm -rf $(VENV) $(OLDEST) $(CODES) results docs/_build docs/gallery docs/reference/api docs/_static/figures docs/_static/explorer.html .pytest_cache .mypy_cache .ruff_cache
