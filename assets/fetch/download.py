"""Download one file whose size and checksum are known beforehand."""

import hashlib
import http.client
import ssl
import time
import urllib.error
import urllib.request
from dataclasses import dataclass
from http import HTTPStatus
from http.client import HTTPMessage, HTTPResponse
from io import FileIO
from pathlib import Path
from typing import IO
from urllib.parse import urlsplit

from farm.errors import AssetError

_PIECE = 2**16
"""Most bytes to read from the connection at once: 64 KiB, so that memory stays small whatever the file's size."""

_PASSING = frozenset({408, 425, 429, 500, 502, 503, 504})
"""HTTP statuses of failures that may pass: the download is tried again."""


@dataclass(frozen=True, slots=True)
class Patience:
    """Limits on the wait for a server.

    Attributes:
        silence_s: Longest wait for a connection or for the next piece of the file, seconds.
        pauses_s: Pause before each further try after a failure that may pass, seconds; their number is that of the
            further tries.
        slowest: Lowest acceptable rate, bytes a second; every file has another 60 s.
    """

    silence_s: float = 30.0
    pauses_s: tuple[float, ...] = (1.0, 5.0)
    slowest: float = 2.0**14

    def limit_s(self, size: int) -> float:
        """Compute the longest time that a file of `size` bytes may take, seconds."""
        return 60.0 + size / self.slowest


class PassingError(AssetError):
    """A server couldn't be reached or broke off, and may answer another time."""


def download(url: str, target: Path, size: int, checksum: str, patience: Patience) -> None:
    """Download a file and check that it is whole and the one that is registered.

    A redirect may lead to https, or from an http address to http on the same host and port. The proxy comes from the
    environment variables, as `urllib` reads them.

    Args:
        url: Address of the file, https or http.
        target: Path to write the file to; after a failure the caller removes what lies there.
        size: Registered size in bytes; no more are read.
        checksum: Registered SHA-256, hexadecimal.
        patience: Limits on waiting for the server.

    Raises:
        PassingError: Every try failed, since the server couldn't be reached, stalled or broke off.
        AssetError: The server has no such file or another one, or the target can't be written.
    """
    for pause in patience.pauses_s:
        try:
            return _try(url, target, size, checksum, patience)
        except PassingError:
            time.sleep(pause)
    return _try(url, target, size, checksum, patience)


def _try(url: str, target: Path, size: int, checksum: str, patience: Patience) -> None:
    again = "try again later, or name another place with --mirror"
    try:
        with _opener(url).open(url, timeout=patience.silence_s) as response, _writable(target) as file:
            found = _copy(url, response, file, target, size, patience)
    except urllib.error.HTTPError as error:
        error.close()
        told = f"{url}: answered {error.code} {_phrase(error.code)}"
        if error.code in _PASSING:
            raise PassingError(f"{told}; {again}") from error
        if 300 <= error.code < 400:
            raise AssetError(f"{told}, which leads nowhere; install a newer farm, or name a --mirror") from error
        raise AssetError(f"{told}; the file may have moved: install a newer farm, or name a --mirror") from error
    except urllib.error.URLError as error:
        if isinstance(error.reason, ssl.SSLCertVerificationError):
            raise AssetError(
                f"{url}: its certificate isn't trusted ({error.reason.verify_message}); behind a proxy of your own, "
                "name the proxy's certificates in SSL_CERT_FILE"
            ) from error
        raise PassingError(
            f"{url}: can't be reached ({_shown(error.reason)}); check the connection, or {again}"
        ) from error
    except TimeoutError as error:
        raise PassingError(f"{url}: sent nothing for {patience.silence_s:g} s; {again}") from error
    except (OSError, http.client.HTTPException) as error:
        reason = _shown(error) or type(error).__name__
        raise PassingError(f"{url}: the connection broke ({reason}); {again}") from error
    except ValueError as error:  # urllib couldn't parse the address that a redirect names
        raise AssetError(f"{url}: redirects to a malformed address ({_shown(error)}); name a --mirror") from error
    if found != checksum:
        raise AssetError(
            f"{url}: has checksum {found}, not {checksum} as registered; it is another file and was not kept"
        )


def _shown(said: object) -> str:
    """Fit a server's words for an error message: at most 200 characters, with a ? for each that isn't printable."""
    return "".join(sign if sign.isprintable() else "?" for sign in str(said))[:200]


def _phrase(status: int) -> str:
    """Look up the standard phrase of an HTTP status; the server's own could hold anything."""
    return HTTPStatus(status).phrase if status in set(HTTPStatus) else "with no known status"


def _writable(target: Path) -> FileIO:
    """Open the target without a buffer.

    A buffer is written out when the file closes; there, the error of a full disk would pass for a broken connection.
    """
    try:
        return target.open("wb", buffering=0)
    except OSError as error:
        raise no_room(target, error) from error


def _copy(url: str, response: HTTPResponse, file: FileIO, target: Path, size: int, patience: Patience) -> str:
    """Write the response to the file and return the SHA-256 of what arrived, hexadecimal."""
    told = response.headers.get("Content-Length")
    if told is not None and told != str(size):
        raise AssetError(
            f"{url}: is {_shown(told)} bytes, not {size} as registered; it is another file and was not kept"
        )
    digest, done, end = hashlib.sha256(), 0, time.monotonic() + patience.limit_s(size)
    # read() waits for a whole piece, however slowly it arrives; read1() returns what has arrived.
    while piece := response.read1(_PIECE):
        done += len(piece)
        if done > size:
            raise AssetError(f"{url}: is more than the {size} bytes registered; it is another file and was not kept")
        if time.monotonic() > end:
            raise PassingError(f"{url}: only {done} of {size} bytes came in {patience.limit_s(size):.0f} s; try later")
        digest.update(piece)
        try:
            rest = memoryview(piece)
            while rest:
                rest = rest[file.write(rest) :]
        except OSError as error:
            raise no_room(target, error) from error
    if done < size:
        raise PassingError(f"{url}: broke off after {done} of {size} bytes; try again later")
    return digest.hexdigest()


def no_room(target: Path, error: OSError) -> AssetError:
    """Make the error for a file that can't be written.

    Args:
        target: Path of the file; the message names its folder.
        error: Error that the operating system gave.
    """
    return AssetError(
        f"{target.parent}: can't be written ({error.strerror}); make room there, or name another folder with --to"
    )


class _SafeRedirects(urllib.request.HTTPRedirectHandler):
    """Follows redirects to https, and from a first address of http also to http on the same host and port."""

    def __init__(self, first: str) -> None:
        self._first = urlsplit(first)

    def redirect_request(
        self, req: urllib.request.Request, fp: IO[bytes], code: int, msg: str, headers: HTTPMessage, newurl: str
    ) -> urllib.request.Request | None:
        """Return the request to follow.

        Raises:
            AssetError: The redirect leads to another address without https.
        """
        to = urlsplit(newurl)
        same = (to.scheme, to.netloc) == (self._first.scheme, self._first.netloc)
        if to.scheme != "https" and not same:
            fp.close()
            raise AssetError(
                f"{self._first.geturl()}: redirects to {_shown(newurl)}, which isn't https, so anybody could change "
                "the file on its way; name a --mirror"
            )
        return super().redirect_request(req, fp, code, msg, headers, newurl)


def _opener(url: str) -> urllib.request.OpenerDirector:
    """Make an opener of http and https addresses alone; urllib's own also opens local files and FTP."""
    opener = urllib.request.OpenerDirector()
    for handler in (
        urllib.request.ProxyHandler(),
        urllib.request.HTTPHandler(),
        urllib.request.HTTPSHandler(),
        urllib.request.HTTPDefaultErrorHandler(),
        urllib.request.HTTPErrorProcessor(),
        _SafeRedirects(url),
    ):
        opener.add_handler(handler)
    opener.addheaders = [("User-Agent", "cable-farm")]
    return opener
