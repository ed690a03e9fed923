"""Redis as one process of a worker sees it. Sockets don't survive a fork, so each process connects for itself."""

import os
from typing import Any

from farm.run.ledger.port import Ledger
from farm.run.ledger.redis import RedisLedger
from farm.run.queue.broker import connect
from farm.run.registry.port import RunRegistry
from farm.run.registry.redis import RedisRegistry


class RedisOfProcess:
    """Opens the registry and ledgers in Redis over one connection pool, which each process makes at its first call.

    Args:
        broker_url: address of the Redis.
    """

    def __init__(self, broker_url: str) -> None:
        self._broker_url = broker_url
        self._client: Any = None
        self._process = 0
        self._ledgers: dict[str, Ledger] = {}

    def client(self) -> Any:
        """The connection pool of the calling process.

        Raises:
            BrokerError: if it is the first call and Redis is not there.
        """
        if self._client is None or self._process != os.getpid():
            self._client, self._process, self._ledgers = connect(self._broker_url), os.getpid(), {}
        return self._client

    def registry(self) -> RunRegistry:
        """The registry of runs and workers."""
        return RedisRegistry(self.client())

    def ledger(self, run_key: str) -> Ledger:
        """The ledger of a run."""
        client = self.client()
        if run_key not in self._ledgers:
            self._ledgers[run_key] = RedisLedger(client, run_key)
        return self._ledgers[run_key]
