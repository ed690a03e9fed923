"""What a worker's store holds of the registered runs: asked from a thread, as a store may hang, and remembered."""

import logging
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from farm.errors import FarmError
from farm.run.registry.port import Refusal, Run

log = logging.getLogger(__name__)

_SERVED_S = 30.0
"""Seconds until the store is asked again for a run that is served: its header may be replaced."""

_REFUSED_S = (2.0, 60.0)
"""Seconds until the store is asked again for a run that is not served, after the first answer, and at most; they double
with each answer. Its dataset may appear late, on a file server that remembers what it has not."""

_PATIENCE_S = 0.25
"""Seconds that the caller waits for the answer on a new run: most stores answer within milliseconds."""


@dataclass(slots=True)
class _Answer:
    asked: Run
    refusal: Refusal | None
    again_s: float
    pause_s: float = 0.0


class Holdings:
    """Tells which runs a worker serves.

    Args:
        look: function that looks into the store, and returns why a run is not served, or None if it is; called from the
            thread, and may raise a FarmError.
        clock: clock that counts seconds.
        patience_s: see `_PATIENCE_S`.
    """

    def __init__(
        self,
        look: Callable[[Run], Refusal | None],
        clock: Callable[[], float] = time.monotonic,
        patience_s: float = _PATIENCE_S,
    ) -> None:
        self._look = look
        self._clock = clock
        self._patience_s = patience_s
        self._answers: dict[str, _Answer] = {}
        self._wanted: dict[str, Run] = {}
        self._waited_for: set[str] = set()
        self._changed = threading.Condition()
        self._thread: threading.Thread | None = None

    def judge(self, runs: Mapping[str, Run]) -> Mapping[str, Refusal | None]:
        """Return why each run is not served, None if it is; runs on which the store has not answered are left out.

        Args:
            runs: the runs in question, by key; others are forgotten.
        """
        with self._changed:
            self._wanted = dict(runs)
            stale = [key for key, answer in self._answers.items() if not self._holds_for(key, answer)]
            for key in stale:
                del self._answers[key]
            self._waited_for = (self._waited_for & runs.keys()) - set(stale)
            if self._due() is not None:
                self._start()
                self._changed.notify_all()
            if new := runs.keys() - self._answers.keys() - self._waited_for:
                # Once only: a store that hangs must not stop the caller's loop each time.
                self._waited_for |= new
                self._changed.wait_for(lambda: new <= self._answers.keys(), self._patience_s)
            return {key: answer.refusal for key, answer in self._answers.items()}

    def ask_again(self) -> None:
        """Ask the store for all runs as soon as it can be; until it answers, the former answers hold."""
        with self._changed:
            for answer in self._answers.values():
                answer.again_s = self._clock()
            self._changed.notify_all()

    def _holds_for(self, key: str, answer: _Answer) -> bool:
        """Whether an answer is on the run as it is registered now, but for what doesn't matter here."""
        run = self._wanted.get(key)
        return run is not None and (run.release, run.located) == (answer.asked.release, answer.asked.located)

    def _due(self) -> str | None:
        """Key of the run for which the store is to be asked next: a new one, or the one that is due for longest."""
        for key in self._wanted:
            if key not in self._answers:
                return key
        longest = min(self._answers, key=lambda key: self._answers[key].again_s, default=None)
        return longest if longest is not None and self._answers[longest].again_s <= self._clock() else None

    def _start(self) -> None:
        if self._thread is None or not self._thread.is_alive():
            self._thread = threading.Thread(target=self._ask_for_ever, name="holdings", daemon=True)
            self._thread.start()

    def _ask_for_ever(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._due() is not None)
                key = self._due()
                run = None if key is None else self._wanted.get(key)
            if key is not None and run is not None:
                self._note(key, run, self._ask(run))

    def _ask(self, run: Run) -> Refusal | None:
        try:
            return self._look(run)
        except FarmError as error:
            log.warning("%s: %s", run.key, error)
        except Exception:  # the thread must outlive every defect of what it asks
            log.exception("the store can't be asked for %s", run.key)
        former = self._answers.get(run.key)
        # A store that is away for a while is waited for: the backoff holds the worker, and no run is left.
        return Refusal.UNREADABLE if former is None else former.refusal

    def _note(self, key: str, run: Run, refused: Refusal | None) -> None:
        with self._changed:
            former = self._answers.get(key)
            if refused is None:
                pause_s = _SERVED_S
            elif former is not None and former.refusal is refused:
                pause_s = min(_REFUSED_S[1], 2.0 * former.pause_s)
            else:
                pause_s = _REFUSED_S[0]
                log.info("%s is not served: %s", key, refused)
            if key in self._wanted:
                self._answers[key] = _Answer(run, refused, self._clock() + pause_s, pause_s)
            self._changed.notify_all()
