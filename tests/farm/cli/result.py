"""The result of a command, and the assertions that the tests of all commands share."""

from collections.abc import Callable
from dataclasses import dataclass

USAGE = 2


@dataclass(frozen=True)
class Result:
    """The result of a command."""

    returncode: int
    stdout: str
    stderr: str


Farm = Callable[..., Result]


def assert_refused(result: Result, code: int, *words: str) -> None:
    """Assert that the command ended with this code and one line on standard error that holds these words."""
    assert result.returncode == code, result.stderr
    lines = result.stderr.strip().splitlines()
    assert len(lines) == 1, result.stderr
    for word in words:
        assert word in lines[0]
