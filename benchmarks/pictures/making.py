"""The datasets that are measured: existing ones, and those that `farm run` makes in a folder that is kept."""

import sys
from argparse import ArgumentTypeError
from dataclasses import dataclass
from pathlib import Path

from benchmarks.farm.play import run_to_end
from farm.dataset.dataset import Dataset, open_dataset
from farm.dataset.destination import parse_destination

STYLES = ("published", "wide")
"""Styles that are measured unless the command line says otherwise."""


@dataclass(frozen=True, slots=True)
class NamedDataset:
    """An existing dataset: its path or URL, and the name under which it is shown."""

    name: str
    place: str


def parse_named(text: str) -> NamedDataset:
    """Read `NAME=FOLDER`.

    Raises:
        argparse.ArgumentTypeError: if the text has another form.
    """
    name, equals, place = text.partition("=")
    if not (equals and place and name.replace("-", "").replace("_", "").isalnum()):
        raise ArgumentTypeError(f"expected NAME=FOLDER, such as wide=data/wide, not {text!r}")
    return NamedDataset(name, place)


def make(style: str, images: int, seed: int, folder: Path) -> Dataset:
    """Make a dataset of a style in the published mix, or complete the one that an earlier call began.

    Args:
        style: name of the style, as `farm run --style` takes it.
        images: number of images in all.
        seed: seed of the dataset.
        folder: folder that keeps the datasets and the output of `farm run` from call to call; made if missing.

    Raises:
        ConflictError: if the folder holds a dataset that this version of the farm describes differently.
        FarmError: the error with which `farm run` ended.
    """
    folder.mkdir(parents=True, exist_ok=True)
    place = folder / f"{style}-{images}-seed-{seed}"
    logs = folder / f"{place.name}-logs"
    command = [sys.executable, "-P", "-m", "farm", "run", "--style", style, "--images", str(images)]
    command += ["--seed", str(seed), "--out", str(place), "--logs", str(logs), "--device", "cpu"]
    run_to_end(command, folder / f"{place.name}.log")
    return open_dataset(parse_destination(str(place)))
