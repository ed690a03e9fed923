"""Completes a dataset: queues its missing jobs, and queues lost ones again, until all are done or given up."""

import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import TypeVar

from farm.aside import patiently
from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset
from farm.dataset.foreign import refuse_foreign
from farm.dataset.header_file import read_header
from farm.dataset.paths import HEADER_FILE
from farm.dataset.place import keep_place
from farm.dataset.quarantine import Quarantine
from farm.errors import BrokerError, ConflictError, DestinationError, IncompleteError, RunCancelledError
from farm.run.feeder import LOST_AFTER_S, WINDOW, Feeder
from farm.run.ledger.owner import is_gone, this_process
from farm.run.progress import Progress, RunHandle, on_disk, with_handle
from farm.run.registry.port import RunState
from farm.run.serving import others_of, why_not_ours, why_not_yet
from farm.spec.job import Job
from farm.spec.job_set import JobSet

_REST = 20
"""Pause between two looks, as a multiple of the time that a look takes: looks at a large dataset take little of a core
from the workers."""

_LONGEST_REST_S = 60.0
"""Longest pause between two looks that `_REST` asks for, in seconds: lost jobs are noticed within a few minutes."""

_AUDIT_S = 30.0
"""Shortest time between two audits, which compare the sizes of all files, in seconds; one more precedes the end."""

_AUDIT_REST = 100
"""Shortest time between two audits, as a multiple of the time that one takes: large datasets are audited rarely."""

_LEAD_S = 30.0
"""Time, in seconds, beyond three of the longest pauses, after which another coordinator replaces a silent leader."""

_SILENCE_S = 10.0
"""Seconds without an answer of the folder after which this is told, and told again after as many more."""

_UNSERVED_S = 20.0
"""Time, in seconds, for which no worker must have served a run before a watch says so: workers load Blender first."""

_REASONS_SHOWN = 20
"""Failed jobs listed at most in the error message."""

_Answer = TypeVar("_Answer")


class Coordinator:
    """Completes one dataset. If several coordinators watch a dataset, one queues jobs and the others only look.

    Args:
        dataset: dataset whose header is written.
        handle: ledger, queue and registry of the dataset's run in Redis.
        poll_s: shortest pause between two looks, in seconds; `_REST` makes it longer if a look takes long.
        lost_after_s: time, in seconds, after which a missing job counts as lost; see `farm.run.feeder.LOST_AFTER_S`.
        window: number of jobs that may wait in Redis; see `farm.run.feeder.WINDOW`.
    """

    def __init__(
        self,
        dataset: Dataset,
        handle: RunHandle,
        *,
        poll_s: float = 1.0,
        lost_after_s: float = LOST_AFTER_S,
        window: int = WINDOW,
    ) -> None:
        self._dataset = dataset
        self._handle = handle
        self._poll_s = poll_s
        self._completion = Completion(dataset)
        self._quarantine = Quarantine(dataset)
        self._feeder = Feeder(dataset, handle, window=window, lost_after_s=lost_after_s)
        self._quarantined: Mapping[str, str] = {}
        self._leads = False
        self._unserved_since_s: float | None = None
        self._judged: set[Job] = set()
        self._audited_s = float("-inf")
        self._audit_took_s = 0.0

    def submit_missing(self, on_submitted: Callable[[int], None] = lambda _: None) -> int:
        """Queue every job that is neither done, given up, waiting nor held by a worker, up to the window.

        Args:
            on_submitted: function that gets the number of jobs queued so far, at every hundredth and at the end.

        Returns:
            The number of jobs queued.

        Raises:
            BrokerError: if Redis can't be reached.
            DestinationError: if the folder can't be read.
            RunCancelledError: if the run was cancelled, and not submitted again since.
            ConflictError: if the run is another release's.
        """
        self._audit()
        self._completion.remove_leftovers(time.time())
        self._look_at_quarantine()
        undone = self._undone()
        if len(undone):
            self._follow_notice()
            if theirs := why_not_ours(self._handle.run, self._dataset):
                raise ConflictError(f"{self._dataset.storage.location}: {theirs}")
            refuse_foreign(self._dataset, self._completion.unfit)
        else:
            self._take_down()
        self._feeder.survey()
        return self._feeder.feed(undone, on_submitted)

    @property
    def left_out(self) -> int:
        """Number of jobs that were undone at the last look and are neither queued nor held: the window is full."""
        return self._feeder.left_out(self._undone())

    def _undone(self) -> JobSet:
        given_up = JobSet(self._dataset.header.spec.quotas)
        for job_id in self._quarantined:
            given_up.add(Job.from_id(job_id))
        return self._completion.done.others() - given_up

    def _audit(self) -> None:
        start_s = time.monotonic()
        self._completion.audit()
        self._audited_s = time.monotonic()
        self._audit_took_s = self._audited_s - start_s

    def _look_at_quarantine(self) -> None:
        found = self._quarantine.look()
        done = [job_id for job_id in found if Job.from_id(job_id) in self._completion.done]
        # A job in quarantine may be done after all, for example by a worker that was thought dead.
        self._quarantine.release(done)
        self._quarantined = {job_id: why for job_id, why in found.items() if job_id not in done}

    def watch(
        self,
        on_progress: Callable[[Progress], None] = lambda _: None,
        *,
        supervise: Callable[[], None] = lambda: None,
    ) -> Progress:
        """Wait until every job is done or given up; wait also while Redis or the folder can't be reached.

        Args:
            on_progress: function that gets the progress after every look.
            supervise: function called before every look; it may restart workers.

        Returns:
            The progress at the last look.

        Raises:
            IncompleteError: if jobs were given up; it lists their reasons.
            RunCancelledError: if somebody cancelled the run.
            ConflictError: if the dataset's header was replaced by another's.
            FarmError: if `supervise` raises one.
        """

        def on_silence(progress: Progress) -> None:
            supervise()
            on_progress(progress)

        try:
            while True:
                supervise()
                start_s = time.monotonic()
                progress = self._look(mend=True, on_silence=on_silence)
                on_progress(progress)
                # The end needs nothing from Redis, so it may be away.
                if progress.ended and self._patiently(self._ends_well, on_silence):
                    return self._end(progress)
                took_s = time.monotonic() - start_s
                time.sleep(max(self._poll_s, min(_LONGEST_REST_S, _REST * took_s)))
        finally:
            with suppress(BrokerError):
                self._handle.ledger.resign(this_process())

    def end_if_complete(self, on_progress: Callable[[Progress], None] = lambda _: None) -> Progress | None:
        """Look once, and queue nothing.

        Args:
            on_progress: function that gets the progress if every job is done or given up.

        Returns:
            The progress, if every job is done; None if some are neither done nor given up.

        Raises:
            IncompleteError: if every job that is not done was given up.
        """
        progress = self._look(mend=False, on_silence=on_progress)
        if not progress.ended or not self._patiently(self._ends_well, on_progress):
            return None
        on_progress(progress)
        return self._end(progress)

    def _look(self, *, mend: bool, on_silence: Callable[[Progress], None]) -> Progress:
        trouble = None
        try:
            self._patiently(self._look_at_folder, on_silence)
        except DestinationError as error:
            trouble = f"{error}; waiting for it"
        progress = on_disk(self._dataset, self._completion.done, self._quarantined)
        try:
            if trouble is None and mend and not progress.ended:
                trouble = self._tend() or None
            progress = self._told(with_handle(progress, self._handle))
        except BrokerError as error:
            # Redis may come back empty, without the jobs that were queued: the next lead begins with a survey.
            self._leads = False
            trouble = f"{error}; waiting for it"
        return progress.model_copy(update={"trouble": trouble})

    def _patiently(self, call: Callable[[], _Answer], on_silence: Callable[[Progress], None]) -> _Answer:
        """Make a call that looks at the folder; while it hangs, tell the last progress with the reason."""

        def tell(_seconds: float) -> None:
            progress = on_disk(self._dataset, self._completion.done, self._quarantined)
            trouble = f"{progress.location}: gives no answer; is its file server there? waiting for it"
            on_silence(progress.model_copy(update={"trouble": trouble}))

        return patiently(call, tell, every_s=_SILENCE_S)

    def _look_at_folder(self) -> None:
        self._require_header()
        if time.monotonic() - self._audited_s > max(_AUDIT_S, _AUDIT_REST * self._audit_took_s):
            self._audit()
        else:
            self._completion.look()
        self._look_at_quarantine()
        self._refuse_new_foreign()
        keep_place(self._dataset.storage, self._handle.run.place)

    def _require_header(self) -> None:
        # A folder that is gone, for example with its mount, lists no file, as if no job were done.
        try:
            present = read_header(self._dataset.storage)
        except FileNotFoundError as error:
            raise DestinationError(f"{self._dataset.storage.location}: its {HEADER_FILE} is gone") from error
        if present.identity != self._dataset.identity:
            # Two commands began different datasets here at once, and the other one wrote last.
            raise ConflictError(
                f"{self._dataset.storage.location}: its {HEADER_FILE} is another dataset's by now; choose another --out"
            )

    def _told(self, progress: Progress) -> Progress:
        """Leave out that nobody serves the run until this has lasted: workers take a while to start."""
        if progress.unserved is None:
            self._unserved_since_s = None
            return progress
        now_s = time.monotonic()
        self._unserved_since_s = now_s if self._unserved_since_s is None else self._unserved_since_s
        lasts = now_s - self._unserved_since_s >= _UNSERVED_S
        return progress if lasts else progress.model_copy(update={"unserved": None})

    def _tend(self) -> str:
        """Queue what is missing, if that is this coordinator's task; returns the reason why it can't be done."""
        try:
            self._follow_notice()
        except ConflictError as error:
            return str(error)
        if self._handle.run.state is RunState.PAUSED:
            return ""
        run = self._handle.run
        if theirs := why_not_ours(run, self._dataset) or why_not_yet(run, self._dataset, self._handle.registry.runs()):
            return theirs
        if not self._take_the_lead():
            return ""
        undone = self._undone()
        self._feeder.mend(undone)
        self._feeder.top_up(undone)
        return self._feeder.trouble

    def _refuse_new_foreign(self) -> None:
        """Look for pictures of another description where manifests have come that don't fit; see `refuse_foreign`."""
        if new := [job for job in self._completion.unfit if job not in self._judged]:
            refuse_foreign(self._dataset, new)
            self._judged.update(new)

    def _follow_notice(self) -> None:
        """Register the run as it was last seen, and take up its changes: a Redis that lost its data keeps a pause."""
        run = self._handle.run
        if why_not_ours(run, self._dataset):
            run = self._handle.registry.runs().get(run.key, run)
        else:
            run = self._handle.registry.register(run)
        self._handle = replace(self._handle, run=run)
        self._feeder.follow(run)
        if run.state is RunState.CANCELLED:
            # Jobs that a coordinator queued while the run was being cancelled are removed too.
            self._handle.queue.clear(run)
            raise RunCancelledError(
                f"{self._dataset.storage.location}: cancelled by farm cancel; submit it again to go on"
            )

    def _take_the_lead(self) -> bool:
        ledger, me = self._handle.ledger, this_process()
        leader = ledger.leader()
        if leader is not None and leader != me and is_gone(leader):
            ledger.resign(leader)
        led, self._leads = self._leads and leader == me, ledger.lead(me, _LEAD_S + 3 * _LONGEST_REST_S)
        if self._leads and not led:
            self._feeder.survey()
        return self._leads

    def _ends_well(self) -> bool:
        """Whether every job is still done or given up after an audit of the files."""
        try:
            self._require_header()
            self._audit()
            self._look_at_quarantine()
            self._completion.remove_leftovers(time.time())
        except DestinationError:
            return False
        return not len(self._undone())

    def _take_down(self) -> None:
        registry, run = self._handle.registry, self._handle.run
        registry.remove(run.key)
        for other in others_of(run, registry.runs()):
            if other.state is RunState.CANCELLED:
                # This run replaced it.
                registry.remove(other.key)

    def _end(self, progress: Progress) -> Progress:
        with suppress(BrokerError):
            self._take_down()
            self._handle.queue.clear(self._handle.run)
        if progress.quarantined:
            raise IncompleteError(_reasons(progress))
        return progress


def _reasons(progress: Progress) -> str:
    given_up = progress.quarantined
    lines = [
        f"{progress.location}: {len(given_up)} of {progress.quota} images failed and are in quarantine; once the cause "
        f"is mended, farm retry {progress.location}"
    ]
    lines += [f"  {job_id}: {reason}" for job_id, reason in list(given_up.items())[:_REASONS_SHOWN]]
    if len(given_up) > _REASONS_SHOWN:
        lines.append(f"  and {len(given_up) - _REASONS_SHOWN} more; see farm status")
    return "\n".join(lines)
