"""The options of the examples; no Blender is needed to read them."""

import argparse
from typing import Any

GROUP_NAMES = ("surfaces", "environments", "cables")


def add_examples(commands: Any, shared: argparse.ArgumentParser) -> None:
    """Add the command to `commands`, the subparsers of the benchmarks' parser."""
    examples = commands.add_parser("examples", parents=[shared], help="pictures of every surface and kind of cable")
    examples.add_argument("--each", type=int, help="pictures of an example")
    examples.add_argument("--group", action="append", default=[], choices=GROUP_NAMES, help="repeat it; default: all")
    examples.add_argument("--only", action="append", default=[], metavar="NAME", help="this example; repeat it")
