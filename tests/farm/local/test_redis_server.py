"""The folder of the private Redis."""

import tempfile
from pathlib import Path

import pytest

from farm.errors import MachineError
from farm.local import redis_server
from farm.local.redis_server import private_redis

pytestmark = pytest.mark.redis


@pytest.mark.usefixtures("redis_url")
def test_the_first_folder_that_takes_a_file_is_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder that is missing or can't be written is passed over, and so is one whose path is too long."""
    (tmp_path / "file").write_text("")
    long = tmp_path / ("d" * 90)
    long.mkdir()
    monkeypatch.setenv("TMPDIR", str(tmp_path / "nowhere"))
    monkeypatch.setenv("TEMP", str(tmp_path / "file"))
    monkeypatch.setenv("TMP", str(long))
    with tempfile.TemporaryDirectory(dir=".") as short:
        monkeypatch.setenv("XDG_RUNTIME_DIR", str(Path(short).resolve()))
        with private_redis() as url:
            assert url.startswith(f"redis+socket://{Path(short).resolve()}/farm-")


@pytest.mark.usefixtures("redis_url")
def test_no_folder_takes_a_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without any such folder each is named in one line, with what to do."""
    monkeypatch.setattr(redis_server, "_places", lambda: iter([str(tmp_path / "one"), str(tmp_path / "two")]))
    with pytest.raises(MachineError, match=r"one: No such file.*two: No such file.*TMPDIR"), private_redis():
        pass
