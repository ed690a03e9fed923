"""The command-line options of the soak."""

import argparse
from typing import Any

DEFAULT_IMAGES = 1100
"""Images of both workers together unless the command line says otherwise."""


def add_soak(commands: Any, shared: argparse.ArgumentParser) -> None:
    """Add the command to `commands`, the subparsers of the benchmarks' parser."""
    soak = commands.add_parser("soak", parents=[shared], help="memory over many images")
    soak.add_argument("--images", type=int, default=DEFAULT_IMAGES, help="images of two workers together")
    soak.add_argument("--quality", default="draft", help="preset of the quality")
    soak.add_argument("--resolution", type=int, default=512, help="edge of an image in pixels")
