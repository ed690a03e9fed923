"""The options of the measurement of the pictures' worth for training."""

import argparse
from pathlib import Path
from typing import Any

from benchmarks.pictures.making import parse_named
from benchmarks.training.plan import Plan

DEFAULT_IMAGES = 150
DEFAULT_TEST_IMAGES = 60
DEFAULT_EPOCHS = 30
"""570 steps of 8 pictures with the default images."""


def add_training(commands: Any, shared: argparse.ArgumentParser) -> None:
    """Add the command to `commands`, the subparsers of the benchmarks' parser."""
    training = commands.add_parser("training", parents=[shared], help="a network trained on each style, tested on all")
    training.add_argument("--images", type=int, default=DEFAULT_IMAGES, help="to train on, of each style")
    training.add_argument("--test-images", type=int, default=DEFAULT_TEST_IMAGES, help="to test on, of each style")
    training.add_argument("--epochs", type=int, default=DEFAULT_EPOCHS, help="passes over the training pictures")
    for name, use in (("--train", "train a network on"), ("--test", "test all networks on")):
        training.add_argument(
            name,
            type=parse_named,
            action="append",
            default=[],
            metavar="NAME=FOLDER",
            help=f"{use} a dataset that is there instead of making both styles; repeat it",
        )
    training.add_argument(
        "--extra-test",
        type=Path,
        metavar="FOLDER",
        help="test on photographs of yours, too: images/ and masks/ with equal names",
    )


def training_plan_of(options: argparse.Namespace) -> Plan:
    """What the parsed options ask for."""
    return Plan(
        seed=options.seed,
        images=options.images,
        test_images=options.test_images,
        epochs=options.epochs,
        train=tuple(options.train),
        test=tuple(options.test),
        photographs=options.extra_test,
    )
