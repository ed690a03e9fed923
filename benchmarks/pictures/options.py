"""The options of the measurement of pictures."""

import argparse
from typing import Any

from benchmarks.pictures.making import STYLES, parse_named

DEFAULT_IMAGES = 150

DEFAULT_SCENES = 300
"""Means are then known to a third of a point in a hundred."""


def add_pictures(commands: Any, shared: argparse.ArgumentParser) -> None:
    """Add the command to `commands`, the subparsers of the benchmarks' parser."""
    pictures = commands.add_parser("pictures", parents=[shared], help="light, colour, cables and clutter of pictures")
    pictures.add_argument("--images", type=int, default=DEFAULT_IMAGES, help="of each style, in the published mix")
    pictures.add_argument(
        "--scenes",
        type=int,
        default=DEFAULT_SCENES,
        help="of each category that are labelled without a render, for the published style's coverage; 0 for none",
    )
    pictures.add_argument(
        "--style",
        choices=STYLES,
        action="append",
        help="make pictures of this style; repeat it; default: both, or none where a dataset is given",
    )
    pictures.add_argument(
        "--dataset",
        type=parse_named,
        action="append",
        default=[],
        metavar="NAME=FOLDER",
        help="measure a dataset that is there; under the name of a style, its promises are checked; repeat it",
    )


def styles_of(options: argparse.Namespace) -> tuple[str, ...]:
    """The styles to make pictures of."""
    return tuple(dict.fromkeys(options.style or (() if options.dataset else STYLES)))
