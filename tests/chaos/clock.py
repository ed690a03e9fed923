"""A clock that can be set wrong while processes look at it: Debian's libfaketime, preloaded into them."""

from collections.abc import Mapping
from pathlib import Path

_PLACES = ("/usr/lib/*/faketime", "/usr/lib*/faketime", "/usr/local/lib/faketime")
_LIBRARY = "libfaketimeMT.so.1"

HOUR_S = 3600


def find_faketime() -> Path | None:
    """The library, if the package `libfaketime` is installed."""
    for place in _PLACES:
        for found in sorted(Path("/").glob(f"{place.removeprefix('/')}/{_LIBRARY}")):
            return found
    return None


class WrongClock:
    """The wall clock of those processes that are started with its environment; monotonic clocks stay right.

    Args:
        library: see `find_faketime`.
        file: tells the processes how wrong the clock is.
    """

    def __init__(self, library: Path, file: Path) -> None:
        self._library = library
        self._file = file
        self.offset_s = 0
        self.set(0)

    def set(self, offset_s: int) -> None:
        """Let the clock be so many seconds ahead, or behind if negative, from now on."""
        self.offset_s = offset_s
        fresh = self._file.with_suffix(".new")
        fresh.write_text(f"{offset_s:+d}\n")
        fresh.replace(self._file)  # whole at any time, as it is read at every look at the clock

    def environment(self) -> Mapping[str, str]:
        """What makes a process look at this clock."""
        return {
            "LD_PRELOAD": str(self._library),
            "FAKETIME_TIMESTAMP_FILE": str(self._file),
            "FAKETIME_NO_CACHE": "1",
            "FAKETIME_DONT_FAKE_MONOTONIC": "1",
        }
