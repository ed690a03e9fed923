"""A store that hangs, as one on a file server that is away: a library, preloaded into processes, holds their calls."""

import os
import shutil
import subprocess
from collections.abc import Mapping
from pathlib import Path

_SOURCE = Path(__file__).with_name("preload") / "hang.c"


class HangingStore:
    """A folder on which the calls of those processes that are started with its environment can be made to hang.

    Args:
        library: the library, from `compile_library`.
        folder: the folder.
        flag: file that is there while calls hang; it is outside the folder.
    """

    def __init__(self, library: Path, folder: Path, flag: Path) -> None:
        self._library = library
        self._folder = folder
        self._flag = flag

    @property
    def hangs(self) -> bool:
        """Whether calls hang now."""
        return self._flag.exists()

    def hang(self) -> None:
        """Let every call on files below the folder wait from now on."""
        self._flag.write_bytes(b"")

    def answer(self) -> None:
        """Let the calls go on."""
        self._flag.unlink(missing_ok=True)

    def environment(self) -> Mapping[str, str]:
        """The environment variables with which a process uses the folder."""
        return {"LD_PRELOAD": str(self._library), "HANG_BELOW": str(self._folder), "HANG_WHILE": str(self._flag)}


def compile_library(folder: Path) -> Path | str:
    """Compile the library in a folder; returns its path, or the reason why it can't be had here."""
    compiler = shutil.which("cc")
    if compiler is None:
        return "letting a store hang needs a C compiler"
    library = folder / "hang.so"
    command = [compiler, "-shared", "-fPIC", "-O1", "-o", str(library), str(_SOURCE), "-ldl"]
    made = subprocess.run(command, check=False, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if made.returncode != 0:
        return f"the library that lets a store hang does not compile: {made.stderr.strip().splitlines()[-1]}"
    return library


def join_environments(*environments: Mapping[str, str]) -> Mapping[str, str]:
    """Put environments together; each may preload a library of its own."""
    joined: dict[str, str] = {}
    for environment in environments:
        joined |= environment
    libraries = [environment["LD_PRELOAD"] for environment in environments if "LD_PRELOAD" in environment]
    return joined | ({"LD_PRELOAD": os.pathsep.join(libraries)} if libraries else {})
