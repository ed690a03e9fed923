"""A web server on this machine for the tests of downloads, and registries of the files that it holds."""

import ssl
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import cv2
import numpy as np

from assets.fetch.registry import Asset, AssetFile, Kind, Registry
from assets.files import sha256
from tests.farm.run.queue.servers import Certificates

Answer = Callable[[BaseHTTPRequestHandler], None]


class ShelfServer:
    """A server that answers each path with the answer it was given for it.

    Attributes:
        answers: answer of each path; any other path is answered with 404.
        asked: number of requests for each path.
        released: event that is set at the end, so that answers which stall don't outlive the test.
    """

    def __init__(self, scheme: str, port: int) -> None:
        self.url = f"{scheme}://127.0.0.1:{port}"
        self.answers: dict[str, Answer] = {}
        self.asked: Counter[str] = Counter()
        self.released = threading.Event()

    def put(self, path: str, content: bytes) -> str:
        """Serve a file; returns its address."""
        self.answers[path] = lambda request: send(request, 200, content)
        return self.url + path

    def stall(self, content: bytes) -> Answer:
        """Send one half and then nothing more."""

        def answer(request: BaseHTTPRequestHandler) -> None:
            send(request, 200, content[: len(content) // 2], claimed=len(content))
            request.wfile.flush()
            self.released.wait(30.0)

        return answer


def send(request: BaseHTTPRequestHandler, status: int, content: bytes = b"", *, claimed: int | None = None) -> None:
    """Answer with a whole body, or claim another length than the body's; None claims the body's own."""
    request.send_response(status)
    request.send_header("Content-Length", str(len(content) if claimed is None else claimed))
    request.end_headers()
    request.wfile.write(content)


def missing(request: BaseHTTPRequestHandler) -> None:
    """The answer for a path that the server doesn't hold."""
    send(request, 404)


def redirect(to: str) -> Answer:
    """An answer that redirects to another address."""

    def answer(request: BaseHTTPRequestHandler) -> None:
        request.send_response(302)
        request.send_header("Location", to)
        request.send_header("Content-Length", "0")
        request.end_headers()

    return answer


def drip(content: bytes, *, pause_s: float) -> Answer:
    """An answer that sends its body byte by byte."""

    def answer(request: BaseHTTPRequestHandler) -> None:
        send(request, 200, claimed=len(content))
        for value in content:
            request.wfile.write(bytes([value]))
            request.wfile.flush()
            time.sleep(pause_s)

    return answer


@contextmanager
def shelf_server(certificates: Certificates | None = None) -> Iterator[ShelfServer]:
    """Run a server within the context; with certificates it speaks https."""

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            server.asked[self.path] += 1
            try:
                server.answers.get(self.path, missing)(self)
            except ConnectionError:
                self.close_connection = True  # the client has closed the connection

        def log_message(self, *_: object) -> None:
            """Print nothing."""

    http = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    if certificates is not None:
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.load_cert_chain(certificates.certificate, certificates.key)
        http.socket = context.wrap_socket(http.socket, server_side=True)
    server = ShelfServer("http" if certificates is None else "https", http.server_port)
    thread = threading.Thread(target=http.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True)
    thread.start()
    try:
        yield server
    finally:
        server.released.set()
        http.shutdown()
        http.server_close()
        thread.join()


def panorama(folder: Path) -> bytes:
    """The content of a small HDRI."""
    path = folder / "made.hdr"
    cv2.imwrite(str(path), np.random.default_rng(0).random((32, 64, 3), np.float32) + 0.2)
    data = path.read_bytes()
    path.unlink()
    return data


def hdri_asset(content: bytes, name: str = "hall", **place: str) -> Asset:
    """A registry's entry for an HDRI; `place` holds its url, or its archive and member."""
    file = AssetFile(file=f"{name}.hdr", sha256=sha256(content), bytes=len(content), **place)
    return Asset(
        name=name, kind=Kind.HDRI, licence="CC0-1.0", author="A. Person", source="https://example.org", file=(file,)
    )


def registry_of(*assets: Asset) -> Registry:
    """A registry with these entries alone."""
    return Registry(asset=assets)
