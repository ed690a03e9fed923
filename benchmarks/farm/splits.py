"""How a machine's cores are shared out between workers."""

import re
from argparse import ArgumentTypeError
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Split:
    """Processes, and threads of each one's renderer."""

    workers: int
    threads: int

    def __str__(self) -> str:
        """As it is named on the command line."""
        return f"{self.workers}x{self.threads}"


SPLITS = (Split(1, 1), Split(1, 2), Split(2, 1))


def parse_split(text: str) -> Split:
    """Read `WORKERSxTHREADS`.

    Raises:
        argparse.ArgumentTypeError: if it is not written so, or a number is below 1.
    """
    found = re.fullmatch(r"([1-9][0-9]*)x([1-9][0-9]*)", text, re.ASCII)
    if found is None:
        raise ArgumentTypeError(f"expected WORKERSxTHREADS, such as 2x1, not {text!r}")
    return Split(int(found[1]), int(found[2]))
