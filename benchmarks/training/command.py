"""`python -m benchmarks training`: train a network on each training set, and test each on every test set."""

import copy
import time
from collections.abc import Iterator, Mapping
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from rich.console import Console

from benchmarks.terminal import bench_console
from benchmarks.training.examples import Examples
from benchmarks.training.outcome import Lesson
from benchmarks.training.plan import Plan, read_sets
from benchmarks.training.plot import write_plot
from benchmarks.training.report import lessons_table, write_json
from farm.errors import MachineError

_WEIGHTS_STREAM, _ORDER_STREAM = 0, 1
"""Streams of the seed: one for the initial weights, one for the order of the pictures and their augmentation."""


def run(out: Path, plan: Plan) -> int:
    """Train, test, print the table, write `training.json` and `training.png` into `out`.

    Args:
        out: an existing folder; datasets are made, and kept, in `pictures` below it.
        plan: training and test sets, and the length of the training.

    Raises:
        SpecError: if the plan can't be carried out.
        MachineError: if PyTorch is missing.
        FarmError: if a dataset can't be made or read.
    """
    plan.check()
    if find_spec("torch") is None:
        raise MachineError("PyTorch is missing; pip install 'cable-farm[train]', or make bench-training")
    console = bench_console()
    with console.status("pictures") as status:
        train_sets, test_sets = read_sets(plan, out / "pictures", status.update)
    lessons = list(_teach(console, plan, train_sets, test_sets))
    console.print(lessons_table(lessons, test_sets))
    write_json(out / "training.json", plan, lessons, test_sets)
    write_plot(out / "training.png", lessons, test_sets)
    return 0


def _teach(
    console: Console, plan: Plan, train_sets: Mapping[str, Examples], test_sets: Mapping[str, Examples]
) -> Iterator[Lesson]:
    """Train and test a network on each training set; all have the same initial weights, order and augmentation."""
    import torch  # noqa: PLC0415  # no other command needs it

    from benchmarks.training.lessons import deterministic, predict, train  # noqa: PLC0415
    from benchmarks.training.network import UNet  # noqa: PLC0415

    weights_seed = np.random.SeedSequence([plan.seed, _WEIGHTS_STREAM]).generate_state(1)[0]
    beginner = UNet(torch.Generator().manual_seed(int(weights_seed)))
    for name, examples in train_sets.items():
        network = copy.deepcopy(beginner)
        draw = np.random.default_rng(np.random.SeedSequence([plan.seed, _ORDER_STREAM]))
        with console.status(f"training on {name}") as status, deterministic():

            def tell(number: int, loss: float, name: str = name) -> None:
                status.update(f"training on {name}: epoch {number} of {plan.epochs}, loss {loss:.3f}")

            start = time.perf_counter()
            losses = train(network, examples, plan.epochs, draw, tell)
            seconds = time.perf_counter() - start
            masks = {test: predict(network, chosen.pictures) for test, chosen in test_sets.items()}
        yield Lesson(name, len(examples), losses, seconds, masks)
