"""The command-line options of the examples; reading them doesn't need Blender."""

import argparse
from typing import Any

GROUP_NAMES = ("surfaces", "environments", "cables")
"""Names of the groups, the keys of `groups.GROUPS`, which the parser needn't import."""


def add_examples(commands: Any, shared: argparse.ArgumentParser) -> None:
    """Add the command to `commands`, the subparsers of the benchmarks' parser."""
    examples = commands.add_parser("examples", parents=[shared], help="pictures of every surface and kind of cable")
    examples.add_argument("--each", type=int, help="number of pictures of each example")
    examples.add_argument(
        "--group",
        action="append",
        default=[],
        choices=GROUP_NAMES,
        help="group of examples to make; repeat for several; default: all",
    )
    examples.add_argument(
        "--only", action="append", default=[], metavar="NAME", help="example to make; repeat for several"
    )
