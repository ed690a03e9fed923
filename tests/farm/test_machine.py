"""The identity of machines."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from farm import machine
from farm.machine import machine_name
from farm.run.ledger.owner import is_gone, this_process


@pytest.fixture(autouse=True)
def fresh() -> Iterator[None]:
    """Forget the machine's name, which is cached, as it changes here."""
    machine_name.cache_clear()
    yield
    machine_name.cache_clear()


@pytest.mark.parametrize("what", ["_MACHINE_ID", "_PROCESSES"])
def test_namesakes_are_apart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, what: str) -> None:
    """A host of the same name with another machine id or pid namespace is another machine, whose dead are unknown."""
    dead = f"{this_process().rpartition(':')[0]}:{2**22 + 1}"
    assert is_gone(dead)
    (tmp_path / "other").write_text("0123456789abcdef\n")
    monkeypatch.setattr(machine, what, tmp_path / "other")
    machine_name.cache_clear()
    assert not is_gone(dead)


def test_name_of_last_resort(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If nothing can be read, the host name identifies the machine."""
    monkeypatch.setattr(machine, "_MACHINE_ID", tmp_path / "none")
    monkeypatch.setattr(machine, "_PROCESSES", tmp_path / "none")
    monkeypatch.setattr("socket.gethostname", lambda: "here")
    assert machine_name() == "here"
