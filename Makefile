# Targets are plain words; `make` alone lists them. Nothing but Debian's packages is needed before any of them.
SHELL := /bin/sh
PYTHON ?= python3.11
VENV := .venv
BIN := $(VENV)/bin
SECONDS_EACH ?= 30
WORKERS ?= $(shell nproc 2>/dev/null || echo 1)

.DEFAULT_GOAL := help
.PHONY: help setup demo test lint bench bench-farm bench-physics bench-render bench-skips bench-startup bench-queue bench-pictures bench-training bench-surfaces examples masks soak stress flower template clean fuzz audit chaos

help: ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | expand -t 16

$(VENV)/installed: pyproject.toml constraints.txt docker/debian-packages.txt
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || \
	    { echo "Python 3.11 with venv is missing; on Debian 12: apt-get install -y python3.11-venv"; exit 1; }
	@docker/missing-packages.sh docker/debian-packages.txt
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[worker,local,s3,flower,metrics,dev]'
	$(BIN)/python -m worker.rod
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

chaos: setup ## kill, stop, cut, fill and spoil a farm while it works; writes bench/chaos.json and .png
	$(BIN)/python -m tests.chaos --out bench

lint: setup ## lint and check types only
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

bench: setup ## what an image costs, beside the published method; writes bench/whole.json and .png
	$(BIN)/farm assets build --no-environments
	$(BIN)/python -m worker.bench whole --out bench

bench-farm: setup ## images an hour of farm run by workers and threads; writes bench/farm.json and .png
	$(BIN)/farm assets build --no-environments
	$(BIN)/python -m worker.bench farm --out bench

bench-pictures: setup ## light, colour, cables and clutter of each style; writes bench/pictures.json, .png and sheets
	$(BIN)/farm assets build
	$(BIN)/python -m worker.bench pictures --out bench

bench-training: setup ## a network trained on each style and tested on both; writes bench/training.json and .png
	$(BIN)/pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[train]'
	$(BIN)/farm assets build
	$(BIN)/python -m worker.bench training --out bench

examples: setup ## contact sheets of every surface, environment and kind of cable, into bench/
	$(BIN)/farm assets build
	$(BIN)/python -m worker.bench examples --out bench

bench-surfaces: setup ## CPU seconds of rendering each surface beside a plain one; writes bench/surfaces.json and .png
	$(BIN)/farm assets build --no-environments
	$(BIN)/python -m worker.bench surfaces --out bench

masks: setup ## masks against Cycles renders of 1,024 samples; writes bench/masks.json
	$(BIN)/farm assets build --no-environments
	$(BIN)/python -m worker.bench masks --out bench

stress: setup ## 560 falls over the whole range of everything; writes bench/stress.json and .png
	$(BIN)/python -m worker.bench stress --out bench

bench-physics: setup ## time against error of all simulators; writes bench/physics.json and .png
	$(BIN)/python -m worker.bench physics --out bench

bench-render: setup ## time against error of rendering; writes bench/render.json, .png and calibration.json
	$(BIN)/python -m worker.bench render --out bench

bench-skips: setup ## what is left out of a picture, and the time that saves; writes bench/skips.json and .png
	$(BIN)/farm assets build --no-environments
	$(BIN)/python -m worker.bench skips --out bench

bench-startup: setup ## from a worker's start to its first picture; writes bench/startup.json and .png
	$(BIN)/farm assets build --no-environments
	$(BIN)/python -m worker.bench startup --out bench

bench-queue: setup ## jobs a second through the queue and what a submission costs; writes bench/queue.* and submit.*
	$(BIN)/python -m tests.load jobs --out bench
	$(BIN)/python -m tests.load submit --out bench

soak: setup ## memory of renderers over 1,100 images; writes bench/soak.json and .png
	$(BIN)/farm assets build --no-environments
	$(BIN)/python -m worker.bench soak --out bench

fuzz: setup ## feed all parsers hostile bytes, guided by coverage (SECONDS_EACH); writes bench/fuzz.json
	$(BIN)/pip install --quiet --disable-pip-version-check --only-binary :all: -c constraints.txt -e '.[fuzz]'
	$(BIN)/python -m tests.fuzz --seconds $(SECONDS_EACH) --out bench

audit: setup ## look all pinned packages up in the databases of known vulnerabilities
	$(BIN)/python .ci/audit.py

flower: setup ## watch the tasks of a farm in the browser (FARM_BROKER_URL)
	$(BIN)/farm flower

template: setup ## build blend/template.blend afresh
	$(BIN)/python -m blend.build

clean: ## remove what the other targets made
	rm -rf $(VENV) demo bench .pytest_cache .mypy_cache .ruff_cache .hypothesis
