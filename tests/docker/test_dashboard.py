"""The Grafana dashboard asks for metrics that exist."""

import json
import re
from pathlib import Path

from prometheus_client import CollectorRegistry, generate_latest

from farm.dataset.dataset import Dataset
from farm.run.metrics import FarmCollector
from farm.run.progress import RunHandle
from farm.run.registry.port import Run
from tests.doubles.ledger import MemoryLedger
from tests.doubles.queue import MemoryQueue
from tests.doubles.registry import MemoryRegistry

_DASHBOARD = Path(__file__).parents[2] / "docker/grafana/cable-farm.json"


def test_every_metric_of_the_dashboard_is_served(dataset: Dataset) -> None:
    """Each name in a panel's query is a metric of the collector."""
    run = Run(dataset=dataset.name, spec_sha256=dataset.identity)
    handle = RunHandle(run=run, ledger=MemoryLedger(), queue=MemoryQueue(), registry=MemoryRegistry())
    registry = CollectorRegistry(auto_describe=False)
    registry.register(FarmCollector(lambda: [(dataset, handle)], handle.registry))
    served = set(re.findall(r"^# TYPE (\w+)", generate_latest(registry).decode(), re.MULTILINE))
    panels = json.loads(_DASHBOARD.read_text())["panels"]
    asked = {
        name for panel in panels for target in panel["targets"] for name in re.findall(r"\bfarm_\w+", target["expr"])
    }
    assert asked
    assert asked <= served


def test_panels_do_not_overlap() -> None:
    """Each panel has its own place on the grid of 24 columns."""
    taken: set[tuple[int, int]] = set()
    for panel in json.loads(_DASHBOARD.read_text())["panels"]:
        at = panel["gridPos"]
        cells = {(at["x"] + x, at["y"] + y) for x in range(at["w"]) for y in range(at["h"])}
        assert at["x"] + at["w"] <= 24
        assert not cells & taken
        taken |= cells
