"""The command-line options of the measurement of the pictures' worth for training."""

import argparse
from pathlib import Path
from typing import Any

from benchmarks.pictures.making import parse_named
from benchmarks.training.plan import Plan

DEFAULT_IMAGES = 150
"""Images of each style to train on."""
DEFAULT_TEST_IMAGES = 60
"""Images of each style to test on."""
DEFAULT_EPOCHS = 30
"""Passes over the training pictures: 570 steps of 8 pictures with the default images."""


def add_training(commands: Any, shared: argparse.ArgumentParser) -> None:
    """Add the command to `commands`, the subparsers of the benchmarks' parser."""
    training = commands.add_parser("training", parents=[shared], help="a network trained on each style, tested on all")
    training.add_argument("--images", type=int, default=DEFAULT_IMAGES, help="images to train on, of each style")
    training.add_argument(
        "--test-images", type=int, default=DEFAULT_TEST_IMAGES, help="images to test on, of each style"
    )
    training.add_argument("--epochs", type=int, default=DEFAULT_EPOCHS, help="passes over the training pictures")
    for name, use in (("--train", "to train a network on"), ("--test", "to test all networks on")):
        training.add_argument(
            name,
            type=parse_named,
            action="append",
            default=[],
            metavar="NAME=FOLDER",
            help=f"existing dataset {use} instead of making both styles; repeat for several",
        )
    training.add_argument(
        "--extra-test",
        type=Path,
        metavar="FOLDER",
        help="folder of your own photographs to test on, too: images/ and masks/ with equal names",
    )


def training_plan_of(options: argparse.Namespace) -> Plan:
    """The plan that the parsed options ask for."""
    return Plan(
        seed=options.seed,
        images=options.images,
        test_images=options.test_images,
        epochs=options.epochs,
        train=tuple(options.train),
        test=tuple(options.test),
        photographs=options.extra_test,
    )
