"""A Redis that keeps its data in a file, and can be killed and started again with it or without."""

import shutil
import time
from collections.abc import Mapping
from pathlib import Path

import redis

from farm.local.redis_server import find_redis_server
from tests.chaos.service import Service

_START_S = 15.0


class RedisService:
    """One redis-server on a Unix socket.

    Args:
        folder: takes its data.
        socket: where it listens; a path of less than 100 bytes.
        environment: beside that of this process.
        log: takes what it prints.
    """

    def __init__(self, folder: Path, socket: Path, environment: Mapping[str, str], log: Path) -> None:
        program = find_redis_server()
        if program is None:
            raise FileNotFoundError("no redis-server; run: make setup")
        command = [str(program), "--port", "0", "--unixsocket", str(socket), "--unixsocketperm", "700"]
        command += ["--dir", str(folder), "--save", "", "--appendonly", "yes", "--daemonize", "no"]
        self._folder = folder
        self._service = Service("redis", command, environment, log)
        self.client = redis.Redis(unix_socket_path=str(socket), decode_responses=True, encoding_errors="replace")

    @property
    def runs(self) -> bool:
        """Whether it runs."""
        return self._service.pid is not None

    def start(self, *, empty: bool = False) -> None:
        """Start it, and wait until it answers.

        Args:
            empty: forget all that it kept.

        Raises:
            redis.RedisError: if it does not.
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
                # It refuses while it loads its data.
                if time.monotonic() > give_up_s or not self.runs:
                    raise
                time.sleep(0.02)

    def kill(self) -> None:
        """End it with SIGKILL."""
        self._service.kill()
