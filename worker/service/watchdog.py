"""Ends a worker that no longer works, so that its supervising program starts another and its jobs go to others.

Three faults are known to stop a worker: an event loop that hangs after a lost connection, a consumer that takes no
jobs after it has connected again, and a shutdown that never ends.
"""

import logging
import os
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from farm.errors import BrokerError

log = logging.getLogger(__name__)

EXIT_CODE = 75
"""Exit code of a worker that ended itself: EX_TEMPFAIL of sysexits.h. It is none of the farm's own errors, so the
worker is started again."""

LOOK_S = 5.0
"""Seconds between two looks at the worker."""

LOOKS = 12
"""Looks in a row that must find the event loop silent. A process that was stopped and goes on is silent only once."""

IDLE_LOOKS = 24
"""Looks in a row that must find jobs waiting beside an idle worker."""


@dataclass(frozen=True, slots=True)
class Observation:
    """One look at a worker.

    Attributes:
        ticked_s: time of the last tick of its event loop, by the monotonic clock.
        busy: whether a job runs.
        stopping: whether it was told to end.
        jobs_wait: whether jobs wait that it should take.
    """

    ticked_s: float
    busy: bool
    stopping: bool
    jobs_wait: bool


class FaultDetector:
    """Counts the looks in a row that find the same fault.

    Args:
        clock: clock of `Observation.ticked_s`, in seconds.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._silent = 0
        self._idle = 0

    def look(self, seen: Observation) -> str:
        """Count a look; return the fault that has lasted long enough to end the worker, or an empty text."""
        silent = self._clock() - seen.ticked_s > LOOKS * LOOK_S / 2
        # A worker that was told to stop waits for its job, and its event loop does not tick meanwhile.
        self._silent = self._silent + 1 if silent and not (seen.stopping and seen.busy) else 0
        self._idle = self._idle + 1 if seen.jobs_wait and not seen.busy and not seen.stopping else 0
        if self._silent >= LOOKS:
            return "its event loop hangs"
        if self._idle >= IDLE_LOOKS:
            return "it takes no jobs though some wait"
        return ""

    def forget(self) -> None:
        """Begin to count again: while Redis is away, nothing can be expected of the worker."""
        self._silent = self._idle = 0


def watch(observe: Callable[[], Observation], end: Callable[[], None]) -> threading.Thread:
    """Watch this process from a thread.

    Args:
        observe: function that looks at the worker; it raises BrokerError while Redis is away.
        end: function that ends the children, called before the process ends.
    """

    def look_for_ever() -> None:
        detector = FaultDetector()
        while True:
            time.sleep(LOOK_S)
            try:
                wrong = detector.look(observe())
            except BrokerError:
                detector.forget()
                continue
            except Exception:  # the watchdog must outlive every defect of what it looks at
                log.exception("the watchdog saw nothing")
                continue
            if wrong:
                log.critical("this worker ends itself: %s", wrong)
                end()
                os._exit(EXIT_CODE)

    thread = threading.Thread(target=look_for_ever, name="watchdog", daemon=True)
    thread.start()
    return thread
