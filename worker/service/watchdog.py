"""Ends a worker that no longer works: whoever supervises it starts another, and its jobs go to others.

Known ways into that state: an event loop that hangs after a lost connection, a consumer that came back from one and
takes nothing, a shutdown that never ends.
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
"""EX_TEMPFAIL of sysexits.h: none of the farm's own, so a supervisor starts the worker again."""

LOOK_S = 5.0
LOOKS = 12
"""So many looks in a row must find the same fault; a process that was stopped and goes on looks once."""

IDLE_LOOKS = 24


@dataclass(frozen=True, slots=True)
class Signs:
    """What can be seen of a worker.

    Attributes:
        ticked_s: when its event loop last came by, by the monotonic clock.
        busy: whether a job runs.
        stopping: whether it was told to end.
        jobs_wait: whether jobs wait that it should take.
    """

    ticked_s: float
    busy: bool
    stopping: bool
    jobs_wait: bool


class Judge:
    """Counts looks that find the same fault."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._hung = 0
        self._idle = 0

    def look(self, signs: Signs) -> str:
        """What is wrong for long enough to end the worker; empty if nothing is."""
        silent = self._clock() - signs.ticked_s > LOOKS * LOOK_S / 2
        # Told to stop, it waits for its job without coming by.
        self._hung = self._hung + 1 if silent and not (signs.stopping and signs.busy) else 0
        self._idle = self._idle + 1 if signs.jobs_wait and not signs.busy and not signs.stopping else 0
        if self._hung >= LOOKS:
            return "its event loop hangs"
        if self._idle >= IDLE_LOOKS:
            return "it takes no jobs though some wait"
        return ""

    def forget(self) -> None:
        """Redis is away: nothing can be expected of the worker."""
        self._hung = self._idle = 0


def watch(see: Callable[[], Signs], end: Callable[[], None]) -> threading.Thread:
    """Watch this process from a thread.

    Args:
        see: tells the signs; raises BrokerError while Redis is away.
        end: called before the process ends, to end its children.
    """

    def look_now_and_then() -> None:
        judge = Judge()
        while True:
            time.sleep(LOOK_S)
            try:
                wrong = judge.look(see())
            except BrokerError:
                judge.forget()
                continue
            except Exception:  # it must outlive whatever it looks at
                log.exception("the watchdog saw nothing")
                continue
            if wrong:
                log.critical("this worker ends itself: %s", wrong)
                end()
                os._exit(EXIT_CODE)

    thread = threading.Thread(target=look_now_and_then, name="watchdog", daemon=True)
    thread.start()
    return thread
