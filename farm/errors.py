"""The tree of errors. Its type decides what the farm does about a failure.

`RetryableError`: the same job may succeed later or on another machine. `PermanentError`: the job fails until a person
changes something. `UnfitWorkerError`: the worker is at fault, not its job. Each class holds the exit code with which
the command line ends.

Exit codes: 0 done, 1 an unexpected error (a defect: please report it), 2 wrong usage (from the argument parser),
75 a worker that hung and ended itself, 128 + N stopped by signal N (130 by Ctrl-C, 143 by SIGTERM), and those below.
"""

from typing import ClassVar


class FarmError(Exception):
    """Any failure that the farm foresees; its text says what is wrong, where, and what to do."""

    exit_code: ClassVar[int] = 1

    def __str__(self) -> str:
        """Return the text, which any log, JSON file and terminal can hold: a path may have bytes that are no UTF-8."""
        return super().__str__().encode(errors="backslashreplace").decode()


class RetryableError(FarmError):
    """A failure that may not happen again when the job is tried again."""


class PermanentError(FarmError):
    """A failure that happens again until a person removes its cause."""


class SpecError(PermanentError):
    """The dataset's description is wrong: file, key, value or flag."""

    exit_code = 3


class TemplateError(PermanentError):
    """The template can't be opened, or lacks something that the farm needs in it."""

    exit_code = 4


class AssetError(PermanentError):
    """A texture or HDRI is missing, unreadable or not what its name says."""

    exit_code = 5


class DestinationError(RetryableError):
    """The dataset's folder or store can't be read or written."""

    exit_code = 6


class DatasetMissingError(DestinationError):
    """The folder or store holds no dataset of that name."""


class ConflictError(PermanentError):
    """The dataset's folder already holds something else, or its run is not in the state that the command needs."""

    exit_code = 7


class BrokerError(RetryableError):
    """Redis can't be reached or refused the request."""

    exit_code = 8


class MessageError(PermanentError):
    """A job message is malformed, has an unknown version, or names something that it must not."""

    exit_code = 9


class StaleMessageError(MessageError):
    """A job message was made for another description than that of the dataset of this name."""


class SceneError(PermanentError):
    """No scene sampled for this job passed the checks of its physics and its mask within the allowed attempts."""

    exit_code = 10


class VerificationError(PermanentError):
    """Files of the dataset are missing, extra, truncated or altered."""

    exit_code = 11


class IncompleteError(RetryableError):
    """A run ended before its quota was full."""

    exit_code = 12


class RenderError(RetryableError):
    """Blender failed to produce a picture."""

    exit_code = 13


class MachineError(PermanentError):
    """This machine lacks a program or library that the command needs."""

    exit_code = 14


class RunCancelledError(PermanentError):
    """Somebody cancelled the run that this command waits for."""

    exit_code = 15


class UnfitWorkerError(FarmError):
    """A worker can't do any job: its device, template, assets or store are not as they must be.

    The job did not fail: its message goes back to the queue, and the worker ends with the exit code of its own fault.

    Args:
        reason: text of the error that was found.
        code: exit code of that error.

    Attributes:
        code: exit code of the error that was found.
    """

    def __init__(self, reason: str, code: int) -> None:
        super().__init__(reason)
        self.code = code

    def __reduce__(self) -> tuple[type, tuple[str, int]]:
        """Keep the code in a pickle: the error goes from the pool's child process to the worker's main process."""
        return UnfitWorkerError, (str(self), self.code)

    def as_fault(self) -> FarmError:
        """Return the error that was found, with its own type."""
        return error_of(self.code, str(self)) or MachineError(str(self))


def error_of(exit_code: int, text: str) -> FarmError | None:
    """Make the error that a program of the farm ended with.

    Args:
        exit_code: exit code of the program.
        text: text of the error.

    Returns:
        The error of the type that has this exit code; None if no type has it.
    """
    kinds = (*RetryableError.__subclasses__(), *PermanentError.__subclasses__())
    kind = next((kind for kind in kinds if kind.exit_code == exit_code != FarmError.exit_code), None)
    return None if kind is None else kind(text)
