"""Faults of a bucket: each one of a real object store is foreseen and reported without credentials."""

import threading

import fsspec
import pytest
from fsspec.implementations.memory import MemoryFileSystem

from farm.errors import DestinationError
from farm.storage import Storage, open_storage, services
from tests.object_store import ObjectStore
from tests.relay import relay

pytestmark = pytest.mark.swift


def faults(storage: Storage) -> list[str]:
    """The error of each operation of a storage, after asserting that all of them fail."""
    told = []
    for act in (
        lambda: storage.read("a/b"),
        lambda: storage.write("a/b", b"1"),
        storage.files,
        lambda: storage.files("a"),
        storage.is_empty,
        lambda: storage.remove("a/b"),
    ):
        with pytest.raises(DestinationError) as caught:
            act()
        told.append(str(caught.value))
    return told


def test_missing_bucket(bucket: str) -> None:
    """A bucket that doesn't exist is neither an empty folder nor a missing file."""
    del bucket
    for told in faults(open_storage("s3://no-such-bucket/place")):
        assert told.startswith("s3://no-such-bucket/place")
        assert "no such bucket" in told


def test_wrong_secret(bucket: str, object_store: ObjectStore, monkeypatch: pytest.MonkeyPatch) -> None:
    """A refused signature names the variables to check, and shows neither key nor secret."""
    monkeypatch.setenv("AWS_SECRET_ACCESS_KEY", "not-the-secret")
    for told in faults(open_storage(f"{bucket}/wrong")):
        assert "AWS_SECRET_ACCESS_KEY" in told
        assert "not-the-secret" not in told
        assert object_store.key not in told


def test_no_credentials(bucket: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without any credentials, the error names the variables, too."""
    monkeypatch.delenv("AWS_ACCESS_KEY_ID")
    monkeypatch.delenv("AWS_SECRET_ACCESS_KEY")
    assert all("AWS_ACCESS_KEY_ID" in told for told in faults(open_storage(f"{bucket}/none")))


def test_stopped_server(bucket: str, object_store: ObjectStore) -> None:
    """A server that isn't there is reported by its address; once it is back, the same storage works again."""
    storage = open_storage(bucket)
    storage.write("a/b", b"1")
    object_store.kill()
    try:
        told = faults(storage)
    finally:
        object_store.revive()
    assert all(object_store.endpoint in each and "AWS_ENDPOINT_URL" in each for each in told)
    assert storage.read("a/b") == b"1"


def test_endpoint_with_a_password(bucket: str, object_store: ObjectStore, monkeypatch: pytest.MonkeyPatch) -> None:
    """A password in the endpoint's address is in no message."""
    monkeypatch.setenv("AWS_ENDPOINT_URL", f"http://me:hush@127.0.0.1:{object_store.port}")
    assert not any("hush" in told for told in faults(open_storage(f"{bucket}/password")))


def test_endpoint_that_is_none(bucket: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """An endpoint that isn't a URL is foreseen."""
    monkeypatch.setenv("AWS_ENDPOINT_URL", "nowhere")
    assert all("AWS_ENDPOINT_URL" in told for told in faults(open_storage(f"{bucket}/nowhere")))


def test_bad_bucket_name(bucket: str) -> None:
    """A name that no bucket can have gives one line."""
    del bucket
    assert not any("\n" in told for told in faults(open_storage("s3://no_bucket!/place")))


def test_server_that_hangs_up(bucket: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A server that accepts a connection and closes it is foreseen."""
    with relay(server_port=0) as between:  # nothing listens there, so each connection is closed at once
        monkeypatch.setenv("AWS_ENDPOINT_URL", f"http://127.0.0.1:{between.port}")
        assert len(faults(open_storage(f"{bucket}/closed"))) == 6


def test_server_that_hangs(bucket: str, object_store: ObjectStore, monkeypatch: pytest.MonkeyPatch) -> None:
    """A server that accepts a request and never answers is given up."""
    monkeypatch.setattr(fsspec.get_filesystem_class("s3"), "read_timeout", 0.2)
    monkeypatch.setattr(services, "PUT_PATIENCE_S", 0.5)
    ended = threading.Event()
    with relay(object_store.port, on_answer=lambda _: ended.wait()) as between:
        monkeypatch.setenv("AWS_ENDPOINT_URL", f"http://127.0.0.1:{between.port}")
        try:
            told = faults(open_storage(f"{bucket}/hangs"))
        finally:
            ended.set()
    assert all("Read timeout" in each or "no answer in time" in each for each in told)


def test_server_in_trouble(bucket: str, object_store: ObjectStore) -> None:
    """A store that answers with an HTTP status of 5xx is reported, and nothing is lost."""
    storage = open_storage(bucket)
    storage.write("a", b"1")
    object_store.kill("object")
    try:
        with pytest.raises(DestinationError, match="a: can't write: "):
            storage.write("a", b"2")
        with pytest.raises(DestinationError, match="a: can't read: "):
            storage.read("a")
    finally:
        object_store.revive("object")
    assert storage.read("a") == b"1"


def test_no_file_is_no_fault(bucket: str) -> None:
    """A missing object in an existing bucket is a missing file."""
    with pytest.raises(FileNotFoundError):
        open_storage(bucket).read("a/b")


def test_others_changes_are_seen(bucket: str, object_store: ObjectStore) -> None:
    """Another process's changes show in the next look, whatever was looked at before."""
    storage = open_storage(bucket)
    client, place = object_store.client(), bucket.removeprefix("s3://")
    storage.write("a/1", b"old")
    assert not storage.is_empty()
    assert storage.files().keys() == {"a/1"}
    client.pipe_file(f"{place}/a/2", b"")
    client.pipe_file(f"{place}/a/1", b"newer")
    assert {path: stored.bytes for path, stored in storage.files().items()} == {"a/1": 5, "a/2": 0}
    assert storage.read("a/1") == b"newer"
    client.rm_file(f"{place}/a/1")
    client.rm_file(f"{place}/a/2")
    assert storage.files() == {}
    assert storage.is_empty()


def test_markers_of_folders(bucket: str, object_store: ObjectStore) -> None:
    """The empty object by which a console makes a folder isn't a file."""
    client = object_store.client()
    for name in ("", "far/"):
        client.call_s3("put_object", Bucket=bucket.split("/")[2], Key=f"{bucket.split('/', 3)[3]}/{name}", Body=b"")
    storage = open_storage(bucket)
    assert storage.files() == {}
    storage.write("far/a", b"1")
    assert storage.files().keys() == {"far/a"}
    assert not storage.is_empty()


def test_store_that_holds_something_else(
    bucket: str, object_store: ObjectStore, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A put fails if the stored object is another one when it is looked at."""
    others = object_store.client()
    path = f"{bucket}/a".removeprefix("s3://")
    contents = iter([b"theirs", b"other lengths"])

    def write_in_between(answer: bytes) -> None:
        if b"\r\nETag:" in answer and b"\r\nContent-Length: 0" in answer and (content := next(contents, None)):
            others.pipe_file(path, content)

    with relay(object_store.port, on_answer=write_in_between) as between:
        monkeypatch.setenv("AWS_ENDPOINT_URL", f"http://127.0.0.1:{between.port}")
        storage = open_storage(bucket)
        for _ in range(2):
            with pytest.raises(DestinationError, match="a: the store holds other than was sent"):
                storage.write("a", b"really")
        storage.write("a", b"really")
        assert storage.read("a") == b"really"


class ForgetfulFileSystem(MemoryFileSystem):  # type: ignore[misc]  # fsspec is untyped
    """A file system that gives no checksums, and loses a bit of each object."""

    protocol = "forgetful"

    def pipe_file(self, path: str, value: bytes, mode: str = "overwrite", **options: object) -> None:
        """Put an object with one bit lost."""
        super().pipe_file(path, value[:-1] + b"?", mode, **options)


def test_store_without_checksums_is_read_back() -> None:
    """If a store has no MD5 of an object, the object is compared byte by byte."""
    fsspec.register_implementation("forgetful", ForgetfulFileSystem, clobber=True)
    with pytest.raises(DestinationError, match="holds other than was sent"):
        open_storage("forgetful://place").write("a", b"12")
