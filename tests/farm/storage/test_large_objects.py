"""Uploads in parts that are cut off in the middle leave nothing that counts."""

import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable

import pytest

from farm.errors import DestinationError
from farm.storage import open_storage
from tests.object_store import ObjectStore
from tests.relay import Relay, relay

pytestmark = pytest.mark.swift

MB = 1_000_000
PATIENCE_S = 10.0
LARGE = random.Random(0).randbytes(60 * MB)  # noqa: S311 - any bytes will do

UPLOAD = """
import sys
from farm.storage import open_storage
open_storage(sys.argv[1]).write("large", sys.stdin.buffer.read())
"""


def after(sent_bytes: int, act: Callable[[Relay], None]) -> Callable[[Relay], None]:
    """Act once, when clients have sent this many bytes."""
    acted = False

    def look(between: Relay) -> None:
        nonlocal acted
        if not acted and between.sent_bytes > sent_bytes:
            acted = True
            act(between)

    return look


def parts_of(object_store: ObjectStore, bucket: str) -> int:
    """Number of parts of unfinished uploads that the store keeps for a folder."""
    name, prefix = bucket.removeprefix("s3://").split("/", 1)
    client = object_store.client()
    uploads = client.call_s3("list_multipart_uploads", Bucket=name, Prefix=prefix).get("Uploads", [])
    parts = [
        client.call_s3("list_parts", Bucket=name, Key=each["Key"], UploadId=each["UploadId"]).get("Parts", [])
        for each in uploads
    ]
    return sum(map(len, parts))


def test_whole(bucket: str) -> None:
    """A large object arrives, and replaces an earlier one."""
    storage = open_storage(bucket)
    storage.write("large", b"small")
    storage.write("large", LARGE)
    assert storage.files()["large"].bytes == len(LARGE)
    assert storage.read("large") == LARGE
    storage.write("large", b"small again")
    assert storage.read("large") == b"small again"


@pytest.mark.parametrize("former", [None, b"former"])
@pytest.mark.parametrize("end", ["connection", "server"])
def test_cut_off(
    bucket: str, object_store: ObjectStore, monkeypatch: pytest.MonkeyPatch, end: str, former: bytes | None
) -> None:
    """If the line or the server goes down during an upload, it fails, and the earlier object is still there."""
    storage = open_storage(bucket)
    if former is not None:
        storage.write("large", former)

    def break_off(between: Relay) -> None:
        # The smallest part has been sent by now; the store takes a moment to keep it.
        give_up_s = time.monotonic() + PATIENCE_S
        while not parts_of(object_store, bucket) and time.monotonic() < give_up_s:
            time.sleep(0.02)
        if end == "server":
            object_store.kill()
        between.cut()

    with monkeypatch.context() as patch, relay(object_store.port, after(40 * MB, break_off)) as between:
        patch.setenv("AWS_ENDPOINT_URL", f"http://127.0.0.1:{between.port}")
        with pytest.raises(DestinationError, match="large: can't write"):
            open_storage(f"{bucket}/").write("large", LARGE)
        assert 40 * MB < between.sent_bytes < len(LARGE)
    if end == "server":
        object_store.revive()
    assert parts_of(object_store, bucket) > 0
    assert {path: stored.bytes for path, stored in storage.files().items()} == (
        {} if former is None else {"large": len(former)}
    )
    assert storage.is_empty() == (former is None)
    if former is not None:
        assert storage.read("large") == former


@pytest.mark.parametrize("size", [60 * MB, 10 * MB], ids=["in parts", "in one piece"])
def test_killed_writer(bucket: str, object_store: ObjectStore, size: int) -> None:
    """A writer that is killed by SIGKILL during an upload leaves the earlier object and no other."""
    storage = open_storage(bucket)
    storage.write("large", b"former")
    writers: list[subprocess.Popen[bytes]] = []

    def kill(between: Relay) -> None:
        os.kill(writers[0].pid, signal.SIGKILL)
        writers[0].wait()
        between.cut()

    with relay(object_store.port, after(size * 2 // 3, kill)) as between:
        endpoint = {"AWS_ENDPOINT_URL": f"http://127.0.0.1:{between.port}"}
        writer = subprocess.Popen(
            [sys.executable, "-c", UPLOAD, bucket], stdin=subprocess.PIPE, env={**os.environ, **endpoint}
        )
        writers.append(writer)
        writer.communicate(LARGE[:size])
        assert writer.returncode == -signal.SIGKILL
    assert {path: stored.bytes for path, stored in storage.files().items()} == {"large": 6}
    assert storage.read("large") == b"former"
