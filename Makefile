# Targets are plain words; `make` alone lists them. Nothing but Debian's packages is needed before any of them.
SHELL := /bin/sh
PYTHON ?= python3.11
VENV := .venv
BIN := $(VENV)/bin
SECONDS_EACH ?= 30
WORKERS ?= $(shell nproc 2>/dev/null || echo 1)

.DEFAULT_GOAL := help
.PHONY: help setup demo test lint bench bench-farm bench-physics bench-render bench-skips bench-startup bench-queue bench-reading bench-pictures bench-training bench-surfaces examples masks soak stress flower template clean fuzz audit chaos

help: ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | expand -t 16

$(VENV)/installed: pyproject.toml constraints.txt docker/debian-packages.txt
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || \
	    { echo "Python 3.11 with venv is missing; on Debian 12: apt-get install -y python3.11-venv"; exit 1; }
	@docker/missing-packages.sh docker/debian-packages.txt
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[worker,local,s3,flower,metrics,dev]'
	$(BIN)/python -m worker.simulate.rod
	@touch $@

setup: $(VENV)/installed ## make .venv, install the pinned dependencies, compile the rod solver

demo: setup ## render 12 pictures, two of each category, into demo/
	$(BIN)/farm assets build --no-environments
	$(BIN)/farm run --spec examples/demo.toml --out demo --workers $(WORKERS)
	@echo "Pictures: $(CURDIR)/demo/<category>/images"
	@echo "Report:   $(CURDIR)/demo/report.html"

test: setup ## lint, check types, run the whole test suite
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/pytest

chaos: setup ## kill, stop, cut, fill and spoil a farm while it works; writes results/chaos.json and .png
	$(BIN)/python -m tests.chaos --out results

lint: setup ## lint and check types only
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

bench: setup ## what an image costs, beside the published method; writes results/whole.json and .png
	$(BIN)/farm assets build --no-environments
	$(BIN)/python -m benchmarks whole --out results

bench-farm: setup ## images an hour of farm run by workers and threads; writes results/farm.json and .png
	$(BIN)/farm assets build --no-environments
	$(BIN)/python -m benchmarks farm --out results

bench-pictures: setup ## light, colour, cables and clutter of each style; writes results/pictures.json, .png and sheets
	$(BIN)/farm assets build
	$(BIN)/python -m benchmarks pictures --out results

bench-training: setup ## a network trained on each style and tested on both; writes results/training.json and .png
	$(BIN)/pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[train]'
	$(BIN)/farm assets build
	$(BIN)/python -m benchmarks training --out results

examples: setup ## contact sheets of every surface, environment and kind of cable, into results/
	$(BIN)/farm assets build
	$(BIN)/python -m benchmarks examples --out results

bench-surfaces: setup ## CPU seconds of rendering each surface beside a plain one; writes results/surfaces.json and .png
	$(BIN)/farm assets build --no-environments
	$(BIN)/python -m benchmarks surfaces --out results

masks: setup ## masks against Cycles renders of 1,024 samples; writes results/masks.json
	$(BIN)/farm assets build --no-environments
	$(BIN)/python -m benchmarks masks --out results

stress: setup ## 2,000 extreme falls and 3,000 drawn ones; writes results/stress.json and .png
	$(BIN)/python -m benchmarks stress --out results

bench-physics: setup ## time against error of all simulators; writes results/physics.json and .png
	$(BIN)/python -m benchmarks physics --out results

bench-render: setup ## time against error of rendering; writes results/render.json, .png and calibration.json
	$(BIN)/python -m benchmarks render --out results

bench-skips: setup ## what is left out of a picture, and the time that saves; writes results/skips.json and .png
	$(BIN)/farm assets build --no-environments
	$(BIN)/python -m benchmarks skips --out results

bench-startup: setup ## from a worker's start to its first picture; writes results/startup.json and .png
	$(BIN)/farm assets build --no-environments
	$(BIN)/python -m benchmarks startup --out results

bench-queue: setup ## jobs a second through the queue and what a submission costs; writes results/queue.* and submit.*
	$(BIN)/python -m tests.load jobs --out results
	$(BIN)/python -m tests.load submit --out results

bench-reading: setup ## what farm status, report and verify take of 25,000 pictures on a bucket, and of a million; writes results/read.json
	$(BIN)/python -m tests.load read --out results

soak: setup ## memory of renderers over 1,100 images; writes results/soak.json and .png
	$(BIN)/farm assets build --no-environments
	$(BIN)/python -m benchmarks soak --out results

fuzz: setup ## feed all parsers hostile bytes, guided by coverage (SECONDS_EACH); writes results/fuzz.json
	$(BIN)/pip install --quiet --disable-pip-version-check --only-binary :all: -c constraints.txt -e '.[fuzz]'
	$(BIN)/python -m tests.fuzz --seconds $(SECONDS_EACH) --out results

audit: setup ## look all pinned packages up in the databases of known vulnerabilities
	$(BIN)/python .ci/audit.py

flower: setup ## watch the tasks of a farm in the browser (FARM_BROKER_URL)
	$(BIN)/farm flower

template: setup ## build blend/template.blend afresh
	$(BIN)/python -m blend.build

clean: ## remove what the other targets made
	rm -rf $(VENV) demo results .pytest_cache .mypy_cache .ruff_cache .hypothesis
