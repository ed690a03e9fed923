"""A watch that sees every manifest put in place, even one that is replaced at once, by inotify through libc."""

import ctypes
import hashlib
import json
import os
import select
import struct
import threading
import time
from collections import defaultdict
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Self

# These values are from linux/inotify.h.
_IN_CLOSE_WRITE = 0x08
_IN_MOVED_TO = 0x80
_EVENT = struct.Struct("iIII")

_LOOK_S = 0.1
_BUFFER_BYTES = 65536


class ManifestWatch:
    """Watches folders of manifests from its own thread, within the context.

    Args:
        folders: folders to watch, made if missing; they may be moved away and back meanwhile.
    """

    def __init__(self, folders: Iterable[Path]) -> None:
        self._libc = ctypes.CDLL(None, use_errno=True)
        self._inotify = self._checked(self._libc.inotify_init1(os.O_NONBLOCK | os.O_CLOEXEC))
        self._folders: dict[int, int] = {}
        for folder in folders:
            folder.mkdir(parents=True, exist_ok=True)
            number = self._libc.inotify_add_watch(self._inotify, os.fsencode(folder), _IN_CLOSE_WRITE | _IN_MOVED_TO)
            # The folders are held open, since their paths may lead elsewhere for a while.
            self._folders[self._checked(number)] = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
        self._contents: dict[str, list[str]] = defaultdict(list)
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="manifest watch", daemon=True)
        self._start_s = time.monotonic()
        self.growth: list[tuple[float, int]] = [(0.0, 0)]

    @staticmethod
    def _checked(result: int) -> int:
        if result < 0:
            raise OSError(ctypes.get_errno(), "inotify failed")
        return result

    def __enter__(self) -> Self:
        """Start to watch."""
        self._start_s = time.monotonic()
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        """Stop, after taking in everything that happened before."""
        self._ending.set()
        self._thread.join()
        for descriptor in (self._inotify, *self._folders.values()):
            os.close(descriptor)

    def _watch(self) -> None:
        while True:
            ending = self._ending.is_set()
            ready, _, _ = select.select([self._inotify], [], [], 0 if ending else _LOOK_S)
            if ready:
                self._take(os.read(self._inotify, _BUFFER_BYTES))
            elif ending:
                return

    def _take(self, events: bytes) -> None:
        start = 0
        while start < len(events):
            number, _, _, length = _EVENT.unpack_from(events, start)
            start += _EVENT.size
            name = os.fsdecode(events[start : start + length].rstrip(b"\0"))
            start += length
            if name.endswith(".json") and not name.startswith("."):
                self._note(name.removesuffix(".json"), number)

    def _note(self, job_id: str, number: int) -> None:
        # A fault may have removed the manifest again at once.
        with suppress(FileNotFoundError):
            descriptor = os.open(f"{job_id}.json", os.O_RDONLY, dir_fd=self._folders[number])
            with os.fdopen(descriptor, "rb") as file:
                self._contents[job_id].append(fingerprint(file.read()))
            self.growth.append((time.monotonic() - self._start_s, len(self._contents)))

    def seen(self) -> list[str]:
        """Ids of the jobs whose manifest was put in place, in the order of their first one."""
        return list(self._contents)

    @property
    def again(self) -> int:
        """Number of manifests that were put in place beyond each job's first."""
        return sum(len(contents) - 1 for contents in list(self._contents.values()))

    def contradictions(self) -> list[str]:
        """Jobs of which two manifests differ in more than their timings."""
        return sorted(job_id for job_id, contents in list(self._contents.items()) if len(set(contents)) > 1)


def fingerprint(manifest: bytes) -> str:
    """A checksum of everything in a manifest that is the same whenever the job is made, so without the timings."""
    try:
        counts = {name: value for name, value in json.loads(manifest).items() if name != "timings_s"}
        return hashlib.sha256(json.dumps(counts, sort_keys=True).encode()).hexdigest()
    except (ValueError, AttributeError):
        return f"damaged: {hashlib.sha256(manifest).hexdigest()}"
