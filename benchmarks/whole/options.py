"""The command-line options of the whole-image benchmark."""

import argparse
from typing import Any

from benchmarks.whole.plan import Plan


def add_whole(commands: Any, shared: argparse.ArgumentParser) -> None:
    """Add the command to `commands`, the subparsers of the benchmarks' parser."""
    whole, usual = commands.add_parser("whole", parents=[shared], help="what a picture costs, and its growth"), Plan()
    whole.add_argument("--images", type=int, default=usual.images, help="standard images of each category")
    whole.add_argument(
        "--slow-images",
        type=int,
        default=usual.slow_images,
        help="how many of them to make in the published way and with others' settings, too, minutes each; 0 for none",
    )
    whole.add_argument(
        "--growth-images",
        type=int,
        default=usual.growth_images,
        help="scenes for each resolution and number of cables; 0 for none",
    )
    whole.add_argument("--resolution", type=int, default=usual.resolution, help="pixels along an edge")
    whole.add_argument(
        "--errors",
        action=argparse.BooleanOptionalAction,
        default=usual.errors,
        help="compare with references, which take minutes each unless an earlier run has kept them",
    )


def plan_of(options: argparse.Namespace) -> Plan:
    """The plan that the parsed options ask for."""
    return Plan(
        seed=options.seed,
        images=options.images,
        slow_images=options.slow_images,
        growth_images=options.growth_images,
        resolution=options.resolution,
        errors=options.errors,
    )
