"""Ways to split a machine's cores between workers."""

import re
from argparse import ArgumentTypeError
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Split:
    """A number of worker processes, and of threads of each one's renderer."""

    workers: int
    threads: int

    def __str__(self) -> str:
        """The split as the command line writes it."""
        return f"{self.workers}x{self.threads}"


SPLITS = (Split(1, 1), Split(1, 2), Split(2, 1))
"""Splits to measure unless the command line names others: one core, then two cores by threads and by processes."""


def parse_split(text: str) -> Split:
    """Read `WORKERSxTHREADS`.

    Raises:
        argparse.ArgumentTypeError: if the text has another form, or a number is below 1.
    """
    found = re.fullmatch(r"([1-9][0-9]*)x([1-9][0-9]*)", text, re.ASCII)
    if found is None:
        raise ArgumentTypeError(f"expected WORKERSxTHREADS, such as 2x1, not {text!r}")
    return Split(int(found[1]), int(found[2]))
