"""The command-line options of the measurement of pictures."""

import argparse
from typing import Any

from benchmarks.pictures.making import STYLES, parse_named

DEFAULT_IMAGES = 150
"""Images of each style unless the command line says otherwise."""

DEFAULT_SCENES = 300
"""Scenes of each category to label without a render: the mean coverage is then known to a third of a percentage
point."""


def add_pictures(commands: Any, shared: argparse.ArgumentParser) -> None:
    """Add the command to `commands`, the subparsers of the benchmarks' parser."""
    pictures = commands.add_parser("pictures", parents=[shared], help="light, colour, cables and clutter of pictures")
    pictures.add_argument(
        "--images", type=int, default=DEFAULT_IMAGES, help="images of each style, in the published mix"
    )
    pictures.add_argument(
        "--scenes",
        type=int,
        default=DEFAULT_SCENES,
        help="scenes of each category to label without a render, for the published style's coverage; 0 for none",
    )
    pictures.add_argument(
        "--style",
        choices=STYLES,
        action="append",
        help="style to make pictures of; repeat for several; default: both, or none if a dataset is given",
    )
    pictures.add_argument(
        "--dataset",
        type=parse_named,
        action="append",
        default=[],
        metavar="NAME=FOLDER",
        help="existing dataset to measure; named like a style, it must keep the style's promises; repeat for several",
    )


def styles_of(options: argparse.Namespace) -> tuple[str, ...]:
    """The styles to make pictures of."""
    return tuple(dict.fromkeys(options.style or (() if options.dataset else STYLES)))
