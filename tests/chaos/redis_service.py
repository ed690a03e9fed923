"""A Redis that keeps its data in a file, and can be killed and started again with or without it."""

import shutil
import time
from collections.abc import Mapping
from pathlib import Path

import redis

from farm.local.redis_server import bundled_redis_server, find_redis_server
from tests.chaos.service import Service

_START_S = 15.0


class RedisService:
    """One redis-server on a Unix socket.

    Args:
        folder: folder that receives the server's data.
        socket: path of the socket, less than 100 bytes long.
        environment: environment variables in addition to those of this process.
        log: file that receives the server's output.
    """

    def __init__(self, folder: Path, socket: Path, environment: Mapping[str, str], log: Path) -> None:
        # Debian's server is linked with jemalloc, which asks for the time before libfaketime can tell it.
        program = bundled_redis_server() or find_redis_server()
        if program is None:
            raise FileNotFoundError("no redis-server; run: make setup")
        command = [str(program), "--port", "0", "--unixsocket", str(socket), "--unixsocketperm", "700"]
        command += ["--dir", str(folder), "--save", "", "--appendonly", "yes", "--daemonize", "no"]
        self._folder = folder
        self._service = Service("redis", command, environment, log)
        self.client = redis.Redis(unix_socket_path=str(socket), decode_responses=True, encoding_errors="replace")

    @property
    def runs(self) -> bool:
        """Whether the server runs."""
        return self._service.pid is not None

    def start(self, *, empty: bool = False) -> None:
        """Start the server, and wait until it answers.

        Args:
            empty: whether the server forgets all earlier data.

        Raises:
            redis.RedisError: if it doesn't answer.
        """
        if empty:
            shutil.rmtree(self._folder, ignore_errors=True)
        self._folder.mkdir(parents=True, exist_ok=True)
        self._service.start()
        give_up_s = time.monotonic() + _START_S
        while True:
            try:
                self.client.ping()
                return
            except redis.RedisError:
                # The server refuses connections while it loads its data.
                if time.monotonic() > give_up_s or not self.runs:
                    raise
                time.sleep(0.02)

    def kill(self) -> None:
        """End the server with SIGKILL."""
        self._service.kill()
