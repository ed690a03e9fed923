"""The folder of compiled code."""

import subprocess
import sys
from pathlib import Path

PROGRAM = "from worker.simulate.rod.compiled import kept_in; print(kept_in())"

# Root may write everywhere, whatever a folder's permissions.
READ_ONLY = "import os; os.access = lambda *_: False; "


def kept_in(before: str = "", **variables: Path) -> Path:
    """The folder that a fresh process uses with these variables."""
    environment = {"PATH": "/usr/bin:/bin"} | {name: str(value) for name, value in variables.items()}
    result = subprocess.run(
        [sys.executable, "-c", before + PROGRAM], capture_output=True, text=True, check=True, env=environment
    )
    return Path(result.stdout.strip())


def test_compiled_code_lies_in_the_users_cache_folder(tmp_path: Path) -> None:
    """Compiled code lies below `cable-farm/compiled`, in a folder for its sources."""
    assert kept_in(XDG_CACHE_HOME=tmp_path).parent == tmp_path / "cable-farm" / "compiled"


def test_a_folder_named_by_the_environment_is_used(tmp_path: Path) -> None:
    """The folder in FARM_COMPILED, which the worker's image sets, is used."""
    assert kept_in(XDG_CACHE_HOME=tmp_path / "cache", FARM_COMPILED=tmp_path).parent == tmp_path


def test_a_folder_that_cannot_be_written_is_copied(tmp_path: Path) -> None:
    """With a read-only image, its compiled code is copied to the user's own folder."""
    kept = kept_in(XDG_CACHE_HOME=tmp_path / "cache", FARM_COMPILED=tmp_path)
    kept.mkdir(exist_ok=True)
    (kept / "some.nbi").write_text("compiled")
    copy = kept_in(READ_ONLY, XDG_CACHE_HOME=tmp_path / "cache", FARM_COMPILED=tmp_path)
    assert copy.parent == tmp_path / "cache" / "cable-farm" / "compiled"
    assert (copy / "some.nbi").read_text() == "compiled"


def test_a_named_folder_that_can_not_be_made(tmp_path: Path) -> None:
    """Where the named folder can't be made, as in a read-only image, the user's cache folder serves."""
    (tmp_path / "file").write_text("")
    found = kept_in(XDG_CACHE_HOME=tmp_path, FARM_COMPILED=tmp_path / "file/in")
    assert found.parent == tmp_path / "cable-farm" / "compiled"


def test_no_folder_for_compiled_code(tmp_path: Path) -> None:
    """Without a folder for it code is compiled in each process, and the log says so once, in one line."""
    (tmp_path / "file").write_text("")
    result = subprocess.run(
        [sys.executable, "-c", "import worker.simulate.rod.banded"],
        capture_output=True,
        text=True,
        check=False,
        env={"PATH": "/usr/bin:/bin", "XDG_CACHE_HOME": str(tmp_path / "file/in")},
    )
    assert result.returncode == 0, result.stderr
    (line,) = result.stderr.strip().splitlines()
    assert f"{tmp_path}/file/in" in line
    assert "can't keep compiled code: Not a directory" in line
