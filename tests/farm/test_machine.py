"""The identity of machines."""

import os
import stat
from collections.abc import Iterator
from pathlib import Path

import pytest

from farm import machine
from farm.errors import MachineError
from farm.machine import cache_folder, expanded, home_folder, machine_name, state_folder
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


@pytest.fixture
def nobody(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A user id without an entry in the list of users, without HOME; returns the temporary folder."""

    def no_entry(_: int) -> None:
        raise KeyError

    monkeypatch.setattr("pwd.getpwuid", no_entry)
    for name in ("HOME", "XDG_CACHE_HOME", "XDG_STATE_HOME"):
        monkeypatch.delenv(name, raising=False)
    (tmp_path / "temporary").mkdir()
    monkeypatch.setattr("tempfile.gettempdir", lambda: str(tmp_path / "temporary"))
    return tmp_path / "temporary"


def test_without_a_home_the_temporary_folder_serves(nobody: Path) -> None:
    """Caches and logs lie in a folder of the temporary folder that only this user can enter."""
    own = nobody / f"cable-farm-{os.getuid()}"
    assert (cache_folder(), state_folder()) == (own / "cache", own / "local-state")
    assert stat.S_IMODE(own.stat().st_mode) == 0o700
    assert home_folder() is None


@pytest.mark.parametrize("home", ["", "relative/home", "{}/file", "{}/file/below"])
def test_a_home_that_cannot_serve(nobody: Path, monkeypatch: pytest.MonkeyPatch, home: str) -> None:
    """A home that is empty, relative, a file, or where nothing can be made counts as none."""
    (nobody / "file").touch()
    monkeypatch.setenv("HOME", home.format(nobody))
    assert cache_folder().parent == nobody / f"cable-farm-{os.getuid()}"


def test_a_home_without_rights(nobody: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A home in which this user can't write, such as / in a container, counts as none."""
    monkeypatch.setenv("HOME", str(nobody))
    monkeypatch.setattr(os, "access", lambda *_: False)
    assert cache_folder().parent == nobody / f"cable-farm-{os.getuid()}"


def test_a_home_that_is_not_there_yet(nobody: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A home that can be made serves, as before."""
    monkeypatch.setenv("HOME", str(nobody / "home"))
    assert cache_folder() == nobody / "home/.cache/cable-farm"
    assert state_folder() == nobody / "home/.local/state/cable-farm"


@pytest.mark.parametrize("given", ["", "relative", "./cache"])
def test_a_relative_base_folder_is_not_set(nobody: Path, monkeypatch: pytest.MonkeyPatch, given: str) -> None:
    """A relative XDG_CACHE_HOME is passed over, as its specification says; an absolute one serves."""
    monkeypatch.setenv("HOME", str(nobody))
    monkeypatch.setenv("XDG_CACHE_HOME", given)
    assert cache_folder() == nobody / ".cache/cable-farm"
    monkeypatch.setenv("XDG_CACHE_HOME", str(nobody / "own"))
    assert cache_folder() == nobody / "own/cable-farm"


@pytest.mark.parametrize("trap", ["writable", "link", "file"])
def test_a_folder_that_others_laid_out(nobody: Path, trap: str) -> None:
    """A folder of our name that others can write in, a link, or a file is refused in one line."""
    place = nobody / f"cable-farm-{os.getuid()}"
    if trap == "link":
        place.symlink_to(nobody)
    elif trap == "file":
        place.touch()
    else:
        place.mkdir()
        place.chmod(0o777)
    with pytest.raises(MachineError, match="set HOME") as refused:
        cache_folder()
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("path", ["~/data", "~nobody-of-this-name/data"])
def test_a_tilde_without_a_home(nobody: Path, path: str) -> None:
    """A path from a home folder that nobody knows is refused by name."""
    del nobody
    with pytest.raises(MachineError, match=r"^~\S*: no home folder is known"):
        expanded(path)
