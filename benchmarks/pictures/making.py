"""The datasets that are measured: made by `farm run` in a folder that is kept, or there already."""

import sys
from argparse import ArgumentTypeError
from dataclasses import dataclass
from pathlib import Path

from benchmarks.farm.play import run_to_end
from farm.dataset.dataset import Dataset, open_dataset, parse_destination

STYLES = ("published", "wide")


@dataclass(frozen=True, slots=True)
class NamedDataset:
    """A dataset that is there already: a path or URL, and the name to show it by."""

    name: str
    place: str


def parse_named(text: str) -> NamedDataset:
    """Read `NAME=FOLDER`.

    Raises:
        argparse.ArgumentTypeError: if it is not written so.
    """
    name, equals, place = text.partition("=")
    if not (equals and place and name.replace("-", "").replace("_", "").isalnum()):
        raise ArgumentTypeError(f"expected NAME=FOLDER, such as wide=data/wide, not {text!r}")
    return NamedDataset(name, place)


def make(style: str, images: int, seed: int, folder: Path) -> Dataset:
    """Make a dataset of a style in the published mix, or complete the one that a former call began.

    Args:
        style: its name, as `farm run --style` takes it.
        images: in all.
        seed: of the dataset.
        folder: where datasets, and what `farm run` prints, are kept from call to call; made if it is not there.

    Raises:
        ConflictError: if the folder holds a dataset that this version of the farm describes otherwise.
        FarmError: that with which `farm run` ended.
    """
    folder.mkdir(parents=True, exist_ok=True)
    place = folder / f"{style}-{images}-seed-{seed}"
    logs = folder / f"{place.name}-logs"
    command = [sys.executable, "-P", "-m", "farm", "run", "--style", style, "--images", str(images)]
    command += ["--seed", str(seed), "--out", str(place), "--logs", str(logs), "--device", "cpu"]
    run_to_end(command, folder / f"{place.name}.log")
    return open_dataset(parse_destination(str(place)))
