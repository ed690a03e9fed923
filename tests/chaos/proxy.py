"""A TCP proxy in front of Redis that can cut, refuse or stall connections for a while."""

import asyncio
import threading
from collections.abc import Callable, Coroutine
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any, Self

_CHUNK_BYTES = 65536
_HOST = "127.0.0.1"


class Proxy:
    """Forwards a port of this machine to a Unix socket within the context. Any thread may call its methods.

    Args:
        target: path of the socket, which needn't exist all the time.
    """

    def __init__(self, target: Path) -> None:
        self._target = target
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, name="proxy", daemon=True)
        self._server: asyncio.Server | None = None
        self._flowing = asyncio.Event()
        self._transports: set[asyncio.BaseTransport] = set()
        self._pumps: set[asyncio.Task[None]] = set()
        self.port = 0

    @property
    def url(self) -> str:
        """Address of Redis through this proxy."""
        return f"redis://{_HOST}:{self.port}/0"

    def __enter__(self) -> Self:
        """Start to listen."""
        self._thread.start()
        self._flowing.set()
        self.accept()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        """Cut every connection and stop."""
        self._call(self._end())
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()

    def cut(self) -> None:
        """Cut every present connection at once; new ones are accepted."""
        self._call(self._cut())

    def refuse(self) -> None:
        """Cut every connection, and refuse new ones until `accept`."""
        self._call(self._refuse())

    def accept(self) -> None:
        """Accept connections again, on the same port."""
        self._call(self._accept())

    @property
    def accepts(self) -> bool:
        """Whether connections are accepted."""
        return self._server is not None

    def swallow(self) -> None:
        """Let no byte through until `flow`; connections stay and new ones are accepted, but nothing answers."""
        self._loop.call_soon_threadsafe(self._flowing.clear)

    def flow(self) -> None:
        """Let bytes through again, the ones held back first."""
        self._loop.call_soon_threadsafe(self._flowing.set)

    @property
    def flows(self) -> bool:
        """Whether bytes get through."""
        return self._flowing.is_set()

    def _call(self, action: Coroutine[Any, Any, None]) -> None:
        asyncio.run_coroutine_threadsafe(action, self._loop).result()

    async def _accept(self) -> None:
        if self._server is None:
            self._server = await asyncio.start_server(self._serve, _HOST, self.port)
            self.port = self._server.sockets[0].getsockname()[1]

    async def _refuse(self) -> None:
        if self._server is not None:
            self._server.close()
            self._server = None
        await self._cut()

    async def _cut(self) -> None:
        for transport in list(self._transports):
            if isinstance(transport, asyncio.WriteTransport):
                transport.abort()

    async def _end(self) -> None:
        await self._refuse()
        for pump in self._pumps:
            pump.cancel()
        await asyncio.gather(*self._pumps, return_exceptions=True)

    async def _serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        try:
            up_reader, up_writer = await asyncio.open_unix_connection(str(self._target))
        except OSError:
            writer.transport.abort()
            return
        transports = (writer.transport, up_writer.transport)
        self._transports.update(transports)

        def end() -> None:
            for transport in transports:
                transport.abort()
                self._transports.discard(transport)

        self._start_pump(reader, up_writer, end)
        self._start_pump(up_reader, writer, end)

    def _start_pump(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, end: Callable[[], None]) -> None:
        pump = self._loop.create_task(self._pump(reader, writer, end))
        self._pumps.add(pump)  # The event loop itself keeps only weak references to tasks.
        pump.add_done_callback(self._pumps.discard)

    async def _pump(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, end: Callable[[], None]) -> None:
        try:
            with suppress(OSError):
                while chunk := await reader.read(_CHUNK_BYTES):
                    await self._flowing.wait()
                    writer.write(chunk)
                    await writer.drain()
        finally:
            end()
