"""A clock that can be set wrong for running processes: Debian's libfaketime, preloaded into them."""

import os
from collections.abc import Mapping
from pathlib import Path

_PLACES = ("/usr/lib/*/faketime", "/usr/lib*/faketime", "/usr/local/lib/faketime")
_LIBRARY = "libfaketimeMT.so.1"
_PRELOAD = Path(__file__).with_name("preload")

HOUR_S = 3600


def find_faketime() -> Path | None:
    """The path of the library; None if the package `libfaketime` isn't installed."""
    for place in _PLACES:
        for found in sorted(Path("/").glob(f"{place.removeprefix('/')}/{_LIBRARY}")):
            return found
    return None


class WrongClock:
    """The wall clock of those processes that are started with its environment; monotonic clocks stay right.

    Args:
        library: path of the library, from `find_faketime`.
        file: file that tells the processes how wrong the clock is.
    """

    def __init__(self, library: Path, file: Path) -> None:
        self._library = library
        self._file = file
        self.offset_s = 0
        self.set(0)

    def set(self, offset_s: int) -> None:
        """Set the clock ahead by this many seconds from now on, or behind if negative."""
        self.offset_s = offset_s
        fresh = self._file.with_suffix(".new")
        fresh.write_text(f"{offset_s:+d}\n")
        fresh.replace(self._file)  # written atomically, since the processes read it at every look at the clock

    def environment(self) -> Mapping[str, str]:
        """The environment variables with which a process uses this clock."""
        return {
            "LD_PRELOAD": str(self._library),
            "FAKETIME_TIMESTAMP_FILE": str(self._file),
            "FAKETIME_NO_CACHE": "1",
            "FAKETIME_DONT_FAKE_MONOTONIC": "1",
            "PYTHONPATH": os.pathsep.join([str(_PRELOAD), *filter(None, [os.environ.get("PYTHONPATH")])]),
        }
