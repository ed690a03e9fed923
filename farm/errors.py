"""One tree of errors. What the farm does with a failure follows from its type.

`RetryableError`: the same job may succeed later, elsewhere or unchanged. `PermanentError`: it never will, until
a person changes something. `UnfitWorkerError` tells of a worker, not of its job. Each class carries the exit code with
which the command line ends.

Exit codes: 0 done, 1 an unexpected error (a defect: please report it), 2 wrong usage (from the argument parser),
75 a worker that hung and ended itself, 128 + N stopped by signal N (130 by Ctrl-C, 143 by SIGTERM), and those below.
"""

from typing import ClassVar


class FarmError(Exception):
    """Any failure the farm foresees; its text says what was wrong, where, and what to do."""

    exit_code: ClassVar[int] = 1


class RetryableError(FarmError):
    """May succeed when tried again."""


class PermanentError(FarmError):
    """Fails the same way until its cause is changed."""


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
    """The dataset's place can't be read or written."""

    exit_code = 6


class DatasetMissingError(DestinationError):
    """The place holds no dataset."""


class ConflictError(PermanentError):
    """The dataset's place already holds something else."""

    exit_code = 7


class BrokerError(RetryableError):
    """Redis can't be reached or refused the request."""

    exit_code = 8


class MessageError(PermanentError):
    """A job message is malformed, of an unknown version, or names what it must not."""

    exit_code = 9


class StaleMessageError(MessageError):
    """A job message was made for another description than that of the dataset in its place."""


class SceneError(PermanentError):
    """No scene drawn for this job passed the physics checks within the allowed attempts."""

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
    """A worker can't work, whatever the job: its device, template, assets or store are not what they must be.

    The job did not fail: its message goes back to the queue, and the worker ends with the fault's exit code.

    Attributes:
        code: the exit code of what was wrong.
    """

    def __init__(self, reason: str, code: int) -> None:
        super().__init__(reason)
        self.code = code

    def __reduce__(self) -> tuple[type, tuple[str, int]]:
        """Whole: it goes from the pool's child to the worker's main process by pickle."""
        return UnfitWorkerError, (str(self), self.code)

    def as_fault(self) -> FarmError:
        """What was wrong, as the error that it was."""
        return error_of(self.code, str(self)) or MachineError(str(self))


def error_of(exit_code: int, text: str) -> FarmError | None:
    """The error with which a program of the farm ended; None if the code is none of the farm's own."""
    kinds = (*RetryableError.__subclasses__(), *PermanentError.__subclasses__())
    kind = next((kind for kind in kinds if kind.exit_code == exit_code != FarmError.exit_code), None)
    return None if kind is None else kind(text)
