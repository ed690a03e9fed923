import socket
import threading
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from tests.chaos.proxy import Proxy

_ANSWER_S = 10.0


@pytest.fixture
def echo(tmp_path: Path) -> Iterator[Path]:
    """A Unix socket that echoes its input."""
    path = tmp_path / "echo"
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(str(path))
        server.listen()
        threading.Thread(target=_serve, args=[server], daemon=True).start()
        yield path
        server.shutdown(socket.SHUT_RDWR)


def _serve(server: socket.socket) -> None:
    with suppress(OSError):
        while True:
            threading.Thread(target=_send_back, args=[server.accept()[0]], daemon=True).start()


def _send_back(connection: socket.socket) -> None:
    with connection:
        while chunk := connection.recv(1024):
            connection.sendall(chunk)


def _connect(proxy: Proxy) -> socket.socket:
    return socket.create_connection(("127.0.0.1", proxy.port), timeout=_ANSWER_S)


def _answers(connection: socket.socket) -> bool:
    connection.sendall(b"ping")
    return connection.recv(1024) == b"ping"


def _is_over(connection: socket.socket) -> bool:
    try:
        return connection.recv(1024) == b""
    except ConnectionError:
        return True


def test_cut(echo: Path) -> None:
    """A cut ends the present connections, and nothing else."""
    with Proxy(echo) as proxy, _connect(proxy) as old:
        assert _answers(old)
        proxy.cut()
        assert _is_over(old)
        with _connect(proxy) as new:
            assert _answers(new)


def test_refuse_and_accept(echo: Path) -> None:
    """Connections are refused for a while, and accepted again on the same port."""
    with Proxy(echo) as proxy:
        port = proxy.port
        proxy.refuse()
        with pytest.raises(ConnectionRefusedError):
            _connect(proxy)
        proxy.accept()
        assert proxy.port == port
        with _connect(proxy) as new:
            assert _answers(new)


def test_swallow_and_flow(echo: Path) -> None:
    """Nothing gets through for a while, and everything afterwards, in order."""
    with Proxy(echo) as proxy, _connect(proxy) as connection:
        assert _answers(connection)
        proxy.swallow()
        connection.sendall(b"late")
        connection.settimeout(0.2)
        with pytest.raises(TimeoutError):
            connection.recv(1024)
        connection.settimeout(_ANSWER_S)
        proxy.flow()
        assert connection.recv(1024) == b"late"


def test_nothing_behind_it(tmp_path: Path) -> None:
    """If nothing listens behind the proxy, a connection ends at once."""
    with Proxy(tmp_path / "none") as proxy, _connect(proxy) as connection:
        assert _is_over(connection)
