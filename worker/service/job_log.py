"""The logs of jobs: all output, that of Blender's C code included, a file for each job, bounded in size and number."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from farm.errors import DestinationError
from farm.spec.job import JobMessage

MAX_BYTES = 256 * 1024
"""Maximum bytes of a finished job's log; a longer one keeps its end."""

MAX_FILES = 1000
"""Number of logs kept of a dataset's jobs, the newest; up to `_ROOM_EVERY` more stay until a worker makes room."""

_ROOM_EVERY = 100
"""Number of a process's jobs after which it makes room."""

_RUNNING_BYTES = 16 * MAX_BYTES
"""Bytes above which the log of a running job is cut, so that it does not fill the disk."""

_TAIL_BYTES = 16 * 1024
"""Bytes from the end of a log that go into a record of quarantine."""


class JobLogs:
    """The logs of the jobs that this machine's workers run.

    Args:
        folder: folder in which each dataset gets a folder of its own.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._taken = 0

    def path(self, message: JobMessage) -> Path:
        """The file of a job's log."""
        return self._folder / message.key.replace(":", "-") / f"{message.job_id}.log"

    @contextmanager
    def taking(self, message: JobMessage) -> Iterator[None]:
        """Send all that this process prints inside `with` to the job's log.

        Raises:
            DestinationError: if the log can't be written.
        """
        path = self.path(message)
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            if self._taken % _ROOM_EVERY == 0:
                self._make_room(path.parent)
            self._taken += 1
            descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_APPEND, 0o644)
        except OSError as error:
            raise DestinationError(f"{path}: can't write logs: {error.strerror}") from error
        former = os.dup(1), os.dup(2)
        try:
            _send_output(descriptor, descriptor)
            os.close(descriptor)
            yield
        finally:
            _send_output(*former)
            for each in former:
                os.close(each)
            _keep_the_end(path, MAX_BYTES)

    def bound(self, message: JobMessage) -> None:
        """Cut the log of a job that still runs, or whose process died, if it is large."""
        _keep_the_end(self.path(message), _RUNNING_BYTES)

    @staticmethod
    def _make_room(folder: Path) -> None:
        dated = []
        for path in folder.iterdir():
            # Another worker may make room at the same time.
            with suppress(FileNotFoundError):
                dated.append((path.stat().st_mtime_ns, path))
        for _, path in sorted(dated)[:-MAX_FILES]:
            path.unlink(missing_ok=True)

    def tail(self, message: JobMessage) -> str:
        """The end of a job's log; empty if this machine has none."""
        try:
            with self.path(message).open("rb") as file:
                file.seek(0, os.SEEK_END)
                file.seek(max(0, file.tell() - _TAIL_BYTES))
                return file.read().decode(errors="replace")
        except OSError:
            return ""


def _send_output(standard: int, error: int) -> None:
    for stream in (sys.stdout, sys.stderr):
        # On a full disk the last output is lost.
        with suppress(OSError):
            stream.flush()
    os.dup2(standard, 1)
    os.dup2(error, 2)


def _keep_the_end(path: Path, most: int) -> None:
    # A log that can't be cut must not stop the process.
    with suppress(OSError):
        size = path.stat().st_size
        if size > most:
            with path.open("r+b") as file:
                file.seek(size - MAX_BYTES)
                end = file.read()
                file.seek(0)
                file.write(end)
                file.truncate()
