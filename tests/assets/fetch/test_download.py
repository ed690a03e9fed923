"""Downloading one file over HTTP."""

import resource
import socket
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler
from pathlib import Path

import pytest

from assets.fetch.download import PassingError, Patience, download
from assets.files import sha256
from farm.errors import AssetError
from tests.assets.fetch.download_server import Answer, ShelfServer, drip, redirect, send, shelf_server
from tests.farm.run.queue.servers import Certificates, make_certificates

CONTENT = bytes(range(256)) * 800
SOON = Patience(silence_s=5.0, pauses_s=(0.0, 0.0))


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch) -> Iterator[ShelfServer]:
    """A server that is reached without a proxy, whatever the environment says."""
    monkeypatch.setenv("no_proxy", "*")
    with shelf_server() as running:
        yield running


def get(url: str, folder: Path, patience: Patience = SOON) -> bytes:
    """Download CONTENT, or a file that pretends to be it."""
    download(url, folder / "got", len(CONTENT), sha256(CONTENT), patience)
    return (folder / "got").read_bytes()


def test_a_file_comes_whole(server: ShelfServer, tmp_path: Path) -> None:
    """Every byte arrives, in one request."""
    assert get(server.put("/a", CONTENT), tmp_path) == CONTENT
    assert server.asked["/a"] == 1


@pytest.mark.parametrize("status", [408, 429, 500, 502, 503, 504])
def test_failures_that_may_pass_are_tried_again(server: ShelfServer, tmp_path: Path, status: int) -> None:
    """A file is fetched from an overloaded server that answers the third time."""

    def answer(request: BaseHTTPRequestHandler) -> None:
        send(request, status if server.asked["/a"] < 3 else 200, CONTENT)

    server.answers["/a"] = answer
    assert get(f"{server.url}/a", tmp_path) == CONTENT
    assert server.asked["/a"] == 3


def test_a_server_that_stays_down_is_given_up(server: ShelfServer, tmp_path: Path) -> None:
    """After three tries the error gives the server's answer and says what to do."""
    server.answers["/a"] = lambda request: send(request, 503)
    with pytest.raises(PassingError, match=r"/a: answered 503 Service Unavailable; try again later, or .*--mirror"):
        get(f"{server.url}/a", tmp_path)
    assert server.asked["/a"] == 3


@pytest.mark.parametrize("status", [401, 403, 404, 410])
def test_a_file_that_is_not_there(server: ShelfServer, tmp_path: Path, status: int) -> None:
    """A file that isn't there is asked for once, as asking again would not help."""
    server.answers["/a"] = lambda request: send(request, status)
    with pytest.raises(AssetError, match=rf"/a: answered {status} .*; the file may have moved"):
        get(f"{server.url}/a", tmp_path)
    assert server.asked["/a"] == 1


def test_another_file_of_the_same_size(server: ShelfServer, tmp_path: Path) -> None:
    """The checksum reveals another file, which isn't asked for again."""
    url = server.put("/a", CONTENT[::-1])
    with pytest.raises(AssetError, match=rf"has checksum {sha256(CONTENT[::-1])}, not {sha256(CONTENT)}"):
        get(url, tmp_path)
    assert server.asked["/a"] == 1


def test_a_file_of_another_size(server: ShelfServer, tmp_path: Path) -> None:
    """A file of another size is refused by the server's header, before anything is read."""
    url = server.put("/a", CONTENT + b"!")
    with pytest.raises(AssetError, match=f"is {len(CONTENT) + 1} bytes, not {len(CONTENT)} as registered"):
        get(url, tmp_path)


def without_length(content: bytes) -> Answer:
    """An answer without a length; the file ends with the connection."""

    def answer(request: BaseHTTPRequestHandler) -> None:
        request.send_response(200)
        request.end_headers()
        request.wfile.write(content)

    return answer


def test_no_more_is_read_than_was_registered(server: ShelfServer, tmp_path: Path) -> None:
    """A body without an end is cut off at the registered size."""
    server.answers["/a"] = without_length(CONTENT * 500)
    with pytest.raises(AssetError, match=f"is more than the {len(CONTENT)} bytes registered"):
        get(f"{server.url}/a", tmp_path)
    assert (tmp_path / "got").stat().st_size <= len(CONTENT)


@pytest.mark.parametrize("claimed", [True, False])
def test_a_body_cut_short(server: ShelfServer, tmp_path: Path, claimed: bool) -> None:
    """A body that is cut short is tried again, then reported, whether or not the server sent a length."""
    half = CONTENT[: len(CONTENT) // 2]
    server.answers["/a"] = (
        (lambda request: send(request, 200, half, claimed=len(CONTENT))) if claimed else without_length(half)
    )
    with pytest.raises(PassingError, match=f"broke off after {len(half)} of {len(CONTENT)} bytes"):
        get(f"{server.url}/a", tmp_path)
    assert server.asked["/a"] == 3


def test_a_server_that_falls_silent(server: ShelfServer, tmp_path: Path) -> None:
    """A silent server is given up after the time that `Patience` allows."""
    server.answers["/a"] = server.stall(CONTENT)
    with pytest.raises(PassingError, match=r"sent nothing for 0\.2 s"):
        get(f"{server.url}/a", tmp_path, Patience(silence_s=0.2, pauses_s=()))


def test_a_server_that_drips(server: ShelfServer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A server that sends a byte now and then is given up, as the whole file would take days."""
    monkeypatch.setattr(Patience, "limit_s", lambda *_: 0.1)
    server.answers["/a"] = drip(CONTENT, pause_s=0.02)
    with pytest.raises(PassingError, match=rf"of {len(CONTENT)} bytes came in"):
        get(f"{server.url}/a", tmp_path, Patience(silence_s=5.0, pauses_s=()))


def test_nobody_listens(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The error gives the reason why a closed port can't be reached."""
    monkeypatch.setenv("no_proxy", "*")
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
        with pytest.raises(PassingError, match=r"can't be reached \(.*refused"):
            get(f"http://127.0.0.1:{port}/a", tmp_path)


def test_what_speaks_no_http(tmp_path: Path, server: ShelfServer) -> None:
    """An answer that isn't HTTP is reported as a broken connection."""

    def answer(request: BaseHTTPRequestHandler) -> None:
        request.wfile.write(b"SSH-2.0-something\r\n")

    server.answers["/a"] = answer
    with pytest.raises(PassingError, match=r"/a: the connection broke"):
        get(f"{server.url}/a", tmp_path)


def test_redirects_are_followed(server: ShelfServer, tmp_path: Path) -> None:
    """A redirect on the same server is followed, also from an http address."""
    server.put("/b", CONTENT)
    server.answers["/a"] = redirect("/b")
    assert get(f"{server.url}/a", tmp_path) == CONTENT


@pytest.mark.parametrize(
    "to", ["http://localhost:1/b", "http://example.org/b", "file:///etc/passwd", "ftp://127.0.0.1/b"]
)
def test_redirects_to_elsewhere_are_refused(server: ShelfServer, tmp_path: Path, to: str) -> None:
    """A redirect to plain http of another server, to a file of this machine or to FTP is refused."""
    server.answers["/a"] = redirect(to)
    with pytest.raises(AssetError, match=r"/a: (redirects to|answered 302 Found, which leads nowhere)"):
        get(f"{server.url}/a", tmp_path)
    assert not list(tmp_path.iterdir())


@pytest.fixture(scope="module")
def certificates(tmp_path_factory: pytest.TempPathFactory) -> Certificates:
    """Certificates of a server on this machine."""
    return make_certificates(tmp_path_factory.mktemp("certificates"))


def test_https_by_a_trusted_certificate(
    server: ShelfServer, certificates: Certificates, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The system's authorities are trusted, or those in SSL_CERT_FILE, and http may redirect to https."""
    monkeypatch.setenv("SSL_CERT_FILE", str(certificates.authority))
    with shelf_server(certificates) as safe:
        server.answers["/a"] = redirect(safe.put("/a", CONTENT))
        assert get(f"{safe.url}/a", tmp_path) == CONTENT
        assert get(f"{server.url}/a", tmp_path) == CONTENT


def test_https_by_a_strangers_certificate(
    certificates: Certificates, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An untrusted certificate is refused at once, and the error says what to do behind a proxy."""
    monkeypatch.setenv("no_proxy", "*")
    monkeypatch.setenv("SSL_CERT_FILE", str(certificates.stranger))
    with (
        shelf_server(certificates) as safe,
        pytest.raises(AssetError, match=r"/a: its certificate isn't trusted \(.*SSL_CERT_FILE"),
    ):
        get(safe.put("/a", CONTENT), tmp_path)
    assert not safe.asked


def test_https_never_leads_to_http(
    server: ShelfServer, certificates: Certificates, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A redirect from https to http is refused, even to this machine, where the file is."""
    monkeypatch.setenv("SSL_CERT_FILE", str(certificates.authority))
    with shelf_server(certificates) as safe:
        safe.answers["/a"] = redirect(server.put("/a", CONTENT))
        with pytest.raises(AssetError, match=rf"/a: redirects to {server.url}/a, which isn't https"):
            get(f"{safe.url}/a", tmp_path)
    assert not server.asked


def test_a_redirect_to_no_address(server: ShelfServer, tmp_path: Path) -> None:
    """A redirect to an address that can't be parsed is refused."""
    server.answers["/a"] = redirect("http://[")
    with pytest.raises(AssetError, match=r"/a: redirects to a malformed address"):
        get(f"{server.url}/a", tmp_path)


def test_what_a_server_says_does_not_steer_the_terminal(server: ShelfServer, tmp_path: Path) -> None:
    """Control characters in a server's answer don't reach the terminal."""

    def answer(request: BaseHTTPRequestHandler) -> None:
        request.wfile.write(b"\x1b]0;mine\x07\r\n")

    server.answers["/a"] = answer
    with pytest.raises(PassingError, match=r"broke \(\?\]0;mine\?+\)"):
        get(f"{server.url}/a", tmp_path)


def test_a_ring_of_redirects(server: ShelfServer, tmp_path: Path) -> None:
    """A ring of redirects ends in an error."""
    server.answers["/a"] = redirect("/a")
    with pytest.raises(AssetError, match=r"/a: answered 302"):
        get(f"{server.url}/a", tmp_path)


def test_no_room(server: ShelfServer, tmp_path: Path) -> None:
    """A file that can't grow is reported with its folder and what to do; the server isn't asked again."""
    url = server.put("/a", CONTENT)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, limits[1]))
    try:
        with pytest.raises(AssetError, match=rf"{tmp_path}: can't be written \(File too large\); make room .*--to"):
            get(url, tmp_path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert server.asked["/a"] == 1
