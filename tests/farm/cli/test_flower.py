"""`farm flower`: on this machine alone, or with a password."""

import base64
import os
import signal
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from farm.errors import BrokerError, SpecError
from tests.farm.cli.result import Farm, assert_refused
from tests.farm.run.queue.servers import free_port

START_S = 30.0
PASSWORD = "me:hush"  # noqa: S105  # of a server that lives for one test
EVERYWHERE = "0.0.0.0"  # noqa: S104  # nothing is bound to it here


@contextmanager
def flower(redis_url: str, *, password: str | None) -> Iterator[str]:
    """Run the real Flower with the farm's command within the context; yields its address."""
    port = free_port()
    command = [sys.executable, "-P", "-m", "farm", "flower", "--broker", redis_url, f"--port={port}"]
    environment = {key: value for key, value in os.environ.items() if key != "FLOWER_BASIC_AUTH"}
    if password is not None:
        environment["FLOWER_BASIC_AUTH"] = password
    process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    url = f"http://127.0.0.1:{port}"
    try:
        give_up_s = time.monotonic() + START_S
        while status(f"{url}/healthcheck") is None:
            assert process.poll() is None
            assert time.monotonic() < give_up_s
            time.sleep(0.1)
        yield url
    finally:
        process.send_signal(signal.SIGTERM)
        try:
            process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def status(url: str, user: str | None = None, method: str = "GET") -> int | None:
    """The HTTP status of an answer; None if there is none."""
    request = urllib.request.Request(url, method=method)  # noqa: S310  # always http to the loopback
    if user is not None:
        request.add_header("Authorization", f"Basic {base64.b64encode(user.encode()).decode()}")
    try:
        with urllib.request.urlopen(request, timeout=10) as answer:  # noqa: S310  # as above
            return int(answer.status)
    except urllib.error.HTTPError as error:
        return error.code
    except OSError:
        return None


@pytest.mark.redis
def test_flower_asks_for_the_password(redis_url: str) -> None:
    """Pages and commands to workers answer 401 without the right password; with it pages are shown."""
    with flower(redis_url, password=PASSWORD) as url:
        for place, method in (("/workers", "GET"), ("/api/workers", "GET"), ("/api/worker/shutdown/x", "POST")):
            assert status(url + place, None, method) == 401
            assert status(url + place, "me:wrong", method) == 401
        assert status(f"{url}/workers", PASSWORD) == 200


@pytest.mark.redis
def test_flower_without_a_password_stays_on_this_machine(redis_url: str) -> None:
    """By default Flower listens on 127.0.0.1 alone, and takes no commands to workers."""
    with flower(redis_url, password=None) as url:
        port = int(url.rpartition(":")[2])
        assert status(f"{url}/workers") == 200
        assert status(f"http://127.0.0.2:{port}/workers") is None
        assert status(f"{url}/api/worker/shutdown/x", method="POST") == 401


@pytest.mark.parametrize("address", [EVERYWHERE, "::", "", "192.168.0.1", "example.org", "127.0.0.1.example.org"])
def test_the_network_needs_a_password(farm: Farm, monkeypatch: pytest.MonkeyPatch, address: str) -> None:
    """The network without a password is refused before anything starts, and the error says what to set."""
    monkeypatch.delenv("FLOWER_BASIC_AUTH", raising=False)
    assert_refused(farm("flower", f"--address={address}"), SpecError.exit_code, "FLOWER_BASIC_AUTH", "127.0.0.1")


def test_the_network_is_let_in_with_a_password(farm: Farm, monkeypatch: pytest.MonkeyPatch) -> None:
    """With a password the network is allowed, and the missing Redis is the next error."""
    monkeypatch.setenv("FLOWER_BASIC_AUTH", PASSWORD)
    refused = farm("flower", f"--address={EVERYWHERE}", "--broker", "redis://127.0.0.1:1/0")
    assert_refused(refused, BrokerError.exit_code, "no Redis at")


@pytest.mark.parametrize("password", ["hush", ":", "me:", ":hush", "me:hush,"])
@pytest.mark.parametrize("address", ["127.0.0.1", EVERYWHERE])
def test_half_a_password_is_none(farm: Farm, monkeypatch: pytest.MonkeyPatch, address: str, password: str) -> None:
    """User and password must both be non-empty; the error doesn't repeat the text."""
    monkeypatch.setenv("FLOWER_BASIC_AUTH", password)
    result = farm("flower", f"--address={address}")
    assert_refused(result, SpecError.exit_code, "USER:PASSWORD")
    assert "hush" not in result.stderr
