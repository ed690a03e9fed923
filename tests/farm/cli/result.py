"""How a command ended, and what the tests of all commands ask of that."""

from collections.abc import Callable
from dataclasses import dataclass

USAGE = 2


@dataclass(frozen=True)
class Result:
    """How a command ended."""

    returncode: int
    stdout: str
    stderr: str


Farm = Callable[..., Result]


def assert_refused(result: Result, code: int, *words: str) -> None:
    """The command ended with this code, in one line on standard error that has these words."""
    assert result.returncode == code, result.stderr
    lines = result.stderr.strip().splitlines()
    assert len(lines) == 1, result.stderr
    for word in words:
        assert word in lines[0]
