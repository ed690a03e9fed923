"""The soak's options."""

import argparse
from typing import Any

DEFAULT_IMAGES = 1100


def add_soak(commands: Any, shared: argparse.ArgumentParser) -> None:
    """Add the command to `commands`, the subparsers of the benchmarks' parser."""
    soak = commands.add_parser("soak", parents=[shared], help="memory over many images")
    soak.add_argument("--images", type=int, default=DEFAULT_IMAGES, help="of two workers together")
    soak.add_argument("--quality", default="draft")
    soak.add_argument("--resolution", type=int, default=512)
