# `make study` and `make test` set up everything from nothing: a virtual environment from the
# hashed lock file, then the job. With an environment at hand use `snakemake --cores 2` and pytest.

VENV ?= .venv
PYTHON ?= python3.11
CORES ?= 2
STAMP := $(VENV)/.installed
RUN := $(abspath $(VENV))/bin
# Snakemake keeps a cache in the home; where that cannot be written, here.
ifneq ($(shell mkdir -p "$$HOME/.cache" 2>/dev/null && test -w "$$HOME/.cache" && echo yes),yes)
export XDG_CACHE_HOME ?= $(CURDIR)/.snakemake/cache
endif
export OPENBLAS_NUM_THREADS ?= 1
export OMP_NUM_THREADS ?= 1

.PHONY: help study demo report test quick verification lint bench clean

help:
	@echo "make study         fold, size and cross-check the nine designs tagged supports: results/summary.xlsx"
	@echo "make demo          one small design to its page: results/demo-paraboloid-5-2-9x8-all/page.html"
	@echo "make report        Table 1, the claims and results/report.html"
	@echo "make test          the tests"
	@echo "make quick         the tests that start no Snakemake, in two minutes"
	@echo "make verification  the long verification chapter"
	@echo "make bench         timings, written to results/bench"
	@echo "make lint          style checks"
	@echo "CORES=$(CORES) VENV=$(VENV) PYTHON=$(PYTHON) may be set on the command line"

$(STAMP): envs/requirements.lock
	@command -v $(PYTHON) >/dev/null || { echo "error: $(PYTHON) is not on the path: Python 3.11 is needed, or call make PYTHON=..."; exit 1; }
	$(PYTHON) -m venv $(VENV)
	$(RUN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r envs/requirements.lock
	@touch $@

study: $(STAMP)
	PATH="$(RUN):$$PATH" snakemake --cores $(CORES) --config study=supports

demo: $(STAMP)
	PATH="$(RUN):$$PATH" snakemake --cores $(CORES) demo

report: $(STAMP)
	PATH="$(RUN):$$PATH" snakemake --cores $(CORES) all report

test: $(STAMP)
	PATH="$(RUN):$$PATH" python -m pytest

quick: $(STAMP)
	PATH="$(RUN):$$PATH" PYTHONHASHSEED=0 python -m pytest -n $(CORES) -m "not workflow and not slow and not verification and not bench and not cluster"

verification: $(STAMP)
	PATH="$(RUN):$$PATH" python -m pytest -m "verification or slow"

bench: $(STAMP)
	-$(RUN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r envs/bench.lock
	PATH="$(RUN):$$PATH" python -m pytest -m bench tests/bench -s

lint: $(STAMP)
	$(RUN)/ruff check .
	$(RUN)/ruff format --check .
	$(RUN)/snakefmt --check Snakefile rules
	PATH="$(RUN):$$PATH" snakemake --lint

clean:
	rm -rf $(VENV) .pytest_cache .ruff_cache
