"""A relay between a client and a server on this machine, with which tests cut connections and act in the middle."""

import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

_CHUNK_BYTES = 64 * 1024


class Relay:
    """A relay that passes bytes on until it is cut.

    Attributes:
        port: port that the relay listens on.
        sent_bytes: number of bytes that clients have sent through it so far, over all connections.
    """

    def __init__(
        self,
        server_port: int,
        on_sent: Callable[["Relay"], None] = lambda _: None,
        on_answer: Callable[[bytes], object] = lambda _: None,
    ) -> None:
        """Start to listen.

        Args:
            server_port: port of the server that receives the bytes.
            on_sent: function that is called with the relay whenever a client has sent bytes, before they are passed on.
            on_answer: function that is called with each piece of an answer, before that is passed on.
        """
        self._server_port = server_port
        self._on_sent = on_sent
        self._on_answer = on_answer
        self._lock = threading.Lock()
        self._open: list[socket.socket] = []
        self.sent_bytes = 0
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port: int = self._listener.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def cut(self) -> None:
        """Close every connection and accept no other."""
        with self._lock:
            for each in [self._listener, *self._open]:
                with suppress(OSError):
                    each.shutdown(socket.SHUT_RDWR)
                each.close()

    def _accept(self) -> None:
        with suppress(OSError):
            while True:
                client, _ = self._listener.accept()
                try:
                    server = socket.create_connection(("127.0.0.1", self._server_port))
                except OSError:
                    client.close()
                    continue
                with self._lock:
                    self._open += [client, server]
                threading.Thread(target=self._pass_on, args=(client, server, True), daemon=True).start()
                threading.Thread(target=self._pass_on, args=(server, client, False), daemon=True).start()

    def _pass_on(self, source: socket.socket, target: socket.socket, from_client: bool) -> None:
        with suppress(OSError):
            while data := source.recv(_CHUNK_BYTES):
                if from_client:
                    with self._lock:
                        self.sent_bytes += len(data)
                    self._on_sent(self)
                else:
                    self._on_answer(data)
                target.sendall(data)
        for each in (source, target):
            with suppress(OSError):
                each.shutdown(socket.SHUT_RDWR)


@contextmanager
def relay(
    server_port: int,
    on_sent: Callable[[Relay], None] = lambda _: None,
    on_answer: Callable[[bytes], object] = lambda _: None,
) -> Iterator[Relay]:
    """Run a relay within the context."""
    made = Relay(server_port, on_sent, on_answer)
    try:
        yield made
    finally:
        made.cut()
