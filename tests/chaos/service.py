"""A process with a supervisor, restarted when it fails, as by `restart: on-failure` in a compose file."""

import os
import signal
import subprocess
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from farm.local.processes import stop
from farm.local.tied import tied

RESTART_AFTER_S = 0.3


class Service:
    """One process at a time, the leader of its own process group.

    Args:
        name: name of the service in reports.
        command: program and arguments.
        environment: environment variables in addition to those of this process.
        log: file that receives the process's output.
        final_codes: exit codes after which the process isn't restarted.
    """

    def __init__(
        self,
        name: str,
        command: Sequence[str],
        environment: Mapping[str, str],
        log: Path,
        *,
        final_codes: frozenset[int] = frozenset({0}),
    ) -> None:
        self.name = name
        self.starts = 0
        self.ended_with: int | None = None
        self._command = list(command)
        self._environment = {**os.environ, **environment}
        self._log = log
        self._final_codes = final_codes
        self._process: subprocess.Popen[bytes] | None = None
        self._died_s: float | None = None

    @property
    def pid(self) -> int | None:
        """Process id of the running process; None without one."""
        return None if self._process is None or self._process.poll() is not None else self._process.pid

    def start(self) -> None:
        """Start the process."""
        self._log.parent.mkdir(parents=True, exist_ok=True)
        with self._log.open("ab") as log:
            self._process = subprocess.Popen(
                tied(self._command),
                env=self._environment,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        self.starts += 1
        self._died_s = None

    def supervise(self) -> None:
        """Restart the process some time after it failed; call this often."""
        if self._process is None or self.ended_with is not None:
            return
        code = self._process.poll()
        if code is None:
            return
        if code in self._final_codes:
            self.ended_with = code
        elif self._died_s is None:
            # A container takes all of its processes with it.
            stop([self._process], grace_s=0.0)
            self._died_s = time.monotonic()
        elif time.monotonic() - self._died_s >= RESTART_AFTER_S:
            self.start()

    def send(self, number: signal.Signals) -> None:
        """Send a signal to the process alone."""
        if self.pid is not None:
            os.kill(self.pid, number)

    def send_group(self, number: signal.Signals) -> None:
        """Send a signal to the process and all that it started."""
        if self._process is not None:
            with suppress(ProcessLookupError):
                os.killpg(self._process.pid, number)

    def kill(self) -> None:
        """Kill the process at once, and don't restart it."""
        if self._process is not None:
            stop([self._process], grace_s=0.0)
            self._process = None

    def ended_within(self, grace_s: float) -> bool:
        """Wait this many seconds for the process to end, then kill it; returns whether it ended by itself."""
        if self._process is None:
            return True
        try:
            self._process.wait(grace_s)
        except subprocess.TimeoutExpired:
            return False
        finally:
            self.kill()
        return True

    def children(self) -> list[int]:
        """Process ids of its living children."""
        parent = self.pid
        return [] if parent is None else sorted(pid for pid, above in living().items() if above == parent)

    def has_said(self, words: str) -> bool:
        """Whether the process has printed some words."""
        return self._log.exists() and words in self._log.read_text(errors="replace")

    def last_words(self) -> str:
        """The last line that the process printed."""
        lines = self._log.read_text(errors="replace").strip().splitlines() if self._log.exists() else []
        return lines[-1][:300] if lines else "nothing"


def living() -> dict[int, int]:
    """Living processes of this machine without zombies: process id to the parent's."""
    found = {}
    for folder in Path("/proc").iterdir():
        # A process may end while its folder is being read; other folders have no such file.
        with suppress(OSError, ValueError):
            state, parent = (folder / "stat").read_text().rpartition(")")[2].split()[:2]
            if state not in {"Z", "X"}:
                found[int(folder.name)] = int(parent)
    return found


def living_with(text: str) -> dict[int, str]:
    """Living processes but this one whose arguments hold a text: process id to arguments."""
    found = {}
    for pid in living():
        with suppress(OSError):
            arguments = Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
            if text in arguments and pid != os.getpid():
                found[pid] = arguments
    return found
