"""Compiles functions with numba, and keeps the compiled code on disk.

The code lies in a folder named after the contents of the sources: numba alone would not notice a change in a function
that another file's function calls. Fast-math is off: operations keep their order, so that results are the same bits in
every process.
"""

import hashlib
import logging
import os
import shutil
import tempfile
from collections.abc import Callable
from contextlib import chdir, nullcontext, suppress
from pathlib import Path
from typing import TypeVar, cast

from farm.machine import cache_folder

# numba reads settings from .numba_config.yaml in the working folder, which is a project's own.
with chdir(Path(__file__).parent) if Path(".numba_config.yaml").exists() else nullcontext():
    import numba

log = logging.getLogger(__name__)

_ROOM_BYTES = 2**20
"""Bytes that a folder must have room for: the compiled code of one function takes up to a few hundred thousand."""

Function = TypeVar("Function", bound=Callable[..., object])


def compiled(function: Function) -> Function:
    """Compile a function on its first call, or load it from disk."""
    return cast("Function", numba.njit(cache=_KEEPS, error_model="numpy")(function))


def kept_in() -> Path:
    """Find the folder of the compiled code, below FARM_COMPILED or the user's cache folder.

    A folder that can't be written, such as one in a container's read-only image, is copied to the user's cache folder
    first: numba does not read from a folder in which it can't write.
    """
    fingerprint = _fingerprint()
    own = cache_folder() / "compiled" / fingerprint
    chosen = os.environ.get("FARM_COMPILED")
    if not chosen:
        return own
    kept = Path(chosen) / fingerprint
    with suppress(OSError):
        kept.mkdir(parents=True, exist_ok=True)
    if kept.is_dir() and os.access(kept, os.W_OK):
        return kept
    if kept.is_dir() and not own.is_dir():
        # Where there is no room for the copy, the code is compiled.
        with suppress(OSError):
            _copy(kept, own)
    return own


def can_keep_in(folder: Path) -> bool:
    """Whether compiled code can be kept in a folder; if not, the log says so, and each process compiles its own."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder) as file:
            file.write(bytes(_ROOM_BYTES))
    except OSError as error:
        log.warning(
            "%s: can't keep compiled code: %s; each worker's start takes minutes; name a folder by XDG_CACHE_HOME",
            folder,
            error.strerror,
        )
        return False
    return True


def _copy(source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=target.parent) as folder:
        copy = Path(folder) / "copy"
        shutil.copytree(source, copy)
        # Another process may have put its copy there first.
        with suppress(OSError):
            copy.rename(target)


def _fingerprint() -> str:
    digest = hashlib.sha256(numba.__version__.encode())
    for source in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(source.name.encode() + source.read_bytes())
    return digest.hexdigest()[:16]


_KEPT_IN = kept_in()

_KEEPS = can_keep_in(_KEPT_IN)

numba.config.CACHE_DIR = str(_KEPT_IN)
