"""One file over HTTP, of a size and checksum known beforehand."""

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
_PASSING = frozenset({408, 425, 429, 500, 502, 503, 504})
"""Statuses that another try may not see."""


@dataclass(frozen=True, slots=True)
class Patience:
    """How long to wait for whom.

    Attributes:
        silence_s: For a connection, or the next piece.
        pauses_s: Before each further try after a failure that may pass.
        slowest: Bytes a second below which a file, less its first minute, takes too long.
    """

    silence_s: float = 30.0
    pauses_s: tuple[float, ...] = (1.0, 5.0)
    slowest: float = 2.0**14

    def limit_s(self, size: int) -> float:
        """How long a file may take in all."""
        return 60.0 + size / self.slowest


class PassingError(AssetError):
    """A server couldn't be reached, or broke off: it may answer another time."""


def download(url: str, target: Path, size: int, checksum: str, patience: Patience) -> None:
    """Get a file, whole and as registered.

    Redirects are followed to https alone, or on the same host where the address itself is http. The proxy is that of
    the environment.

    Args:
        url: https or http.
        target: Where to; what a failure leaves there must be removed by the caller.
        size: Its bytes; no more are read.
        checksum: SHA-256, hexadecimal.
        patience: How long to wait.

    Raises:
        PassingError: It can't be reached, stalls or breaks off, however often it is tried.
        AssetError: It is not there, is another file, or can't be written.
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
            raise AssetError(f"{told}, which leads nowhere; look for a newer farm, or name a --mirror") from error
        raise AssetError(f"{told}; the file may have moved: look for a newer farm, or name a --mirror") from error
    except urllib.error.URLError as error:
        if isinstance(error.reason, ssl.SSLCertVerificationError):
            raise AssetError(
                f"{url}: its certificate isn't trusted ({error.reason.verify_message}); if a proxy of yours "
                "stands between, name its certificates in SSL_CERT_FILE"
            ) from error
        raise PassingError(
            f"{url}: can't be reached ({_shown(error.reason)}); check the connection, or {again}"
        ) from error
    except TimeoutError as error:
        raise PassingError(f"{url}: sent nothing for {patience.silence_s:g} s; {again}") from error
    except (OSError, http.client.HTTPException) as error:
        reason = _shown(error) or type(error).__name__
        raise PassingError(f"{url}: the connection broke ({reason}); {again}") from error
    except ValueError as error:  # from urllib's parsing of where a redirect leads
        raise AssetError(f"{url}: leads to what is no address ({_shown(error)}); name a --mirror") from error
    if found != checksum:
        raise AssetError(
            f"{url}: has checksum {found}, not {checksum} as registered; it is another file and was not kept"
        )


def _shown(said: object) -> str:
    """What a server said, without what would steer a terminal."""
    return "".join(sign if sign.isprintable() else "?" for sign in str(said))[:200]


def _phrase(status: int) -> str:
    """The standard's, not the server's own."""
    return HTTPStatus(status).phrase if status in set(HTTPStatus) else "with no known status"


def _writable(target: Path) -> FileIO:
    """Without a buffer, whose rest would be written at the end, where a full disk looks like a broken connection."""
    try:
        return target.open("wb", buffering=0)
    except OSError as error:
        raise no_room(target, error) from error


def _copy(url: str, response: HTTPResponse, file: FileIO, target: Path, size: int, patience: Patience) -> str:
    """Returns the checksum of what came."""
    told = response.headers.get("Content-Length")
    if told is not None and told != str(size):
        raise AssetError(
            f"{url}: is {_shown(told)} bytes, not {size} as registered; it is another file and was not kept"
        )
    digest, done, end = hashlib.sha256(), 0, time.monotonic() + patience.limit_s(size)
    # read() would wait for a whole piece, however slowly it comes; read1() returns what is there.
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
    """What to tell of a file that can't be written."""
    return AssetError(
        f"{target.parent}: can't be written ({error.strerror}); make room there, or name another folder with --to"
    )


class _SafeRedirects(urllib.request.HTTPRedirectHandler):
    """Follows to https, or where the first address is http, to http of the same host and port."""

    def __init__(self, first: str) -> None:
        self._first = urlsplit(first)

    def redirect_request(
        self, req: urllib.request.Request, fp: IO[bytes], code: int, msg: str, headers: HTTPMessage, newurl: str
    ) -> urllib.request.Request | None:
        """Refuses the rest."""
        to = urlsplit(newurl)
        same = (to.scheme, to.netloc) == (self._first.scheme, self._first.netloc)
        if to.scheme != "https" and not same:
            fp.close()
            raise AssetError(
                f"{self._first.geturl()}: leads to {_shown(newurl)}, where anybody may change what comes; "
                "name a --mirror"
            )
        return super().redirect_request(req, fp, code, msg, headers, newurl)


def _opener(url: str) -> urllib.request.OpenerDirector:
    """One that knows http and https alone, neither files nor FTP."""
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
