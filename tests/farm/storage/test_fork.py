"""A storage that was used before a fork works in the child and in the parent."""

import os
import signal
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest

from farm.storage import open_storage
from tests.object_store import ObjectStore

PATIENCE_S = 60


def in_child(act: Callable[[], str]) -> str:
    """Run a function in a forked child and return its result; a child that hangs is killed."""
    told, tell = os.pipe()
    child = os.fork()
    if child == 0:
        signal.alarm(PATIENCE_S)
        try:
            answer = act()
        except BaseException as error:  # whatever the error, the parent is to hear of it
            answer = repr(error)
        os.write(tell, answer.encode())
        os._exit(0)
    os.close(tell)
    with os.fdopen(told, "rb") as pipe:
        answer = pipe.read().decode()
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    return answer


def connections_to(port: int) -> int:
    """Number of this process's sockets that are connected to a port of this machine."""
    table = [line.split() for line in Path("/proc/self/net/tcp").read_text().splitlines()[1:]]
    wanted = {f"socket:[{row[9]}]" for row in table if row[2].endswith(f":{port:04X}")}
    links = []
    for name in Path("/proc/self/fd").iterdir():
        with suppress(OSError):
            links.append(os.readlink(name))  # noqa: PTH115 - no path, but the socket's number
    return len(wanted.intersection(links))


def test_used_on_both_sides(any_store: Callable[[str], str]) -> None:
    """The parent uses a storage and forks, and both go on using that very one, and new ones."""
    place = any_store("place")
    storage = open_storage(place)
    storage.write("a", b"parent")
    assert not storage.is_empty()

    def act() -> str:
        read = storage.read("a") + open_storage(place).read("a")
        storage.write("b", read)
        open_storage(place).write("c", read)
        return ",".join(sorted(storage.files()))

    assert in_child(act) == "a,b,c"
    assert storage.read("a") == b"parent"
    storage.write("d", b"")
    assert "d" in storage.files()


def test_children_one_after_the_other(any_store: Callable[[str], str]) -> None:
    """A parent that uses its storage between forks, as a worker's main process may, has healthy children."""
    storage = open_storage(any_store("place"))
    for number in range(3):
        storage.write(f"{number}", b"parent")
        assert in_child(lambda: str(len(storage.files()))) == str(number + 1)


@pytest.mark.swift
def test_child_has_none_of_its_parents_connections(bucket: str, object_store: ObjectStore) -> None:
    """The sockets on which the parent talks to the store are closed before the fork."""
    storage = open_storage(bucket)
    storage.write("a", b"1")
    assert connections_to(object_store.port) > 0
    assert in_child(lambda: str(connections_to(object_store.port))) == "0"
