"""The command-line options of the throughput benchmark."""

import argparse
from typing import Any

from benchmarks.farm.splits import SPLITS, parse_split

DEFAULT_IMAGES = 200
"""Images of each run unless the command line says otherwise: enough for a rate that start-up doesn't blur."""


def add_farm(commands: Any, shared: argparse.ArgumentParser) -> None:
    """Add the command to `commands`, the subparsers of the benchmarks' parser."""
    farm = commands.add_parser("farm", parents=[shared], help="images an hour of `farm run`")
    farm.add_argument("--images", type=int, default=DEFAULT_IMAGES, help="images of each run, in the published mix")
    farm.add_argument(
        "--split",
        type=parse_split,
        action="append",
        metavar="WORKERSxTHREADS",
        help=f"split to measure; repeat for several; default: {', '.join(map(str, SPLITS))}",
    )
