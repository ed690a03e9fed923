"""The soak's table, JSON file and plot."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib as mpl
from rich.table import Table

from benchmarks.physics.report import machine
from benchmarks.soak.growth import MIB, Sample, growth_mib

mpl.use("Agg")
from matplotlib import pyplot as plt  # the backend must be chosen first

_FILLED = 100
"""Number of images after which a renderer's cache of decoded textures, a GiB, is full."""


def _figures(samples: Sequence[Sample]) -> dict[str, float | None]:
    done = samples[-1].done
    memory = [sample.rss_bytes / MIB for sample in samples if sample.rss_bytes]
    return {
        "images": done,
        "peak_mib": max(memory),
        "last_mib": memory[-1],
        "growth_mib_per_100": growth_mib(samples, after=1),
        "growth_mib_per_100_from_100": growth_mib(samples, after=_FILLED),
        "growth_mib_per_100_second_half": growth_mib(samples, after=done // 2),
    }


def soak_table(samples: Mapping[str, Sequence[Sample]]) -> Table:
    """A table with one row per worker."""
    table = Table(title="resident memory of a renderer", title_justify="left")
    for name in (
        "worker",
        "images",
        "peak MiB",
        "last MiB",
        "MiB per 100 images",
        f"from image {_FILLED} on",
        "second half",
    ):
        table.add_column(name, justify="left" if name == "worker" else "right")
    for name, each in samples.items():
        figures = _figures(each)
        table.add_row(name, *("-" if value is None else f"{value:.1f}" for value in figures.values()))
    return table


def write_json(path: Path, samples: Mapping[str, Sequence[Sample]], spec: Mapping[str, object]) -> None:
    """Write every sample, and a description of the machine."""
    content = {
        "machine": machine(),
        "spec": spec,
        "workers": {
            name: {**_figures(each), "samples": [[sample.done, sample.rss_bytes] for sample in each]}
            for name, each in samples.items()
        },
    }
    path.write_text(json.dumps(content, indent=1))


def write_plot(path: Path, samples: Mapping[str, Sequence[Sample]]) -> None:
    """Draw memory over images, one line per worker."""
    figure, axes = plt.subplots(figsize=(7, 3.5), layout="constrained")
    for name, each in samples.items():
        shown = [sample for sample in each if sample.rss_bytes]
        axes.plot([sample.done for sample in shown], [sample.rss_bytes / MIB for sample in shown], label=name)
    axes.set(xlabel="images of this worker", ylabel="resident memory, MiB", ylim=(0, None))
    axes.legend()
    figure.savefig(path, dpi=120)
    plt.close(figure)
