"""The interface of every ledger. The folder and a new submission restore all that the loss of a ledger loses."""

import os
from collections.abc import Callable, Iterable, Mapping
from typing import Protocol

from farm.model import Model

CLAIM_VARIABLE = "FARM_CLAIM_S"

CLAIM_S = float(os.environ.get(CLAIM_VARIABLE, "60"))
"""Seconds after which a claim that is not refreshed is void. All processes of a farm must have the same value."""

RECENT_COMPLETIONS = 200
"""Largest number of finished pictures, the latest ones, from which the rate is estimated."""

RECENT_S = 3600.0
"""Largest age of these pictures, in seconds, so that yesterday's run doesn't lower today's rate."""

RETRY_OWNER = ""
"""Owner's name of a job that waits for its next attempt. Any worker may take the job over."""


class Activity(Model):
    """The progress of the work at present.

    Attributes:
        images_per_hour: rate over the recent completions; None before the first two.
        last_picture: path of the newest picture below the dataset's folder; None before the first.
    """

    images_per_hour: float | None
    last_picture: str | None


class Ledger(Protocol):
    """The ledger of one dataset. Every method may raise BrokerError."""

    def claim(self, job_id: str, owner: str, ttl_s: float = CLAIM_S) -> int | None:
        """Claim a job for `ttl_s` seconds.

        Returns:
            Which start of the job this is, from 1, or None if another owner has it.
        """
        ...

    def refresh(self, job_id: str, owner: str, ttl_s: float = CLAIM_S) -> bool:
        """Hold a claim for `ttl_s` more seconds, even a lapsed one that nobody took; False if it is another owner's."""
        ...

    def release(self, job_id: str, owner: str) -> None:
        """Give a claim up if it is the owner's, even a lapsed one: a clock that is set back must not revive it."""
        ...

    def give_back(self, job_id: str, owner: str) -> None:
        """Give a claim up, if it is the owner's, as if the job had not been started."""
        ...

    def postpone(self, job_id: str, owner: str, delay_s: float) -> None:
        """Turn the owner's claim into one that any worker may take over, and that lapses after `delay_s` seconds.

        The start is no longer counted: its end is known, and `count_trouble` has counted it.
        """
        ...

    def claims(self) -> Mapping[str, str]:
        """List the live claims: job id to owner."""
        ...

    def finish(self, job_id: str, owner: str, picture: str) -> bool:
        """Note a finished job and its picture, forget its starts and troubles, and release its claim.

        Returns:
            False if the claim is no longer the owner's: then nothing is noted, as its new owner will note it.
        """
        ...

    def count_trouble(self, job_id: str) -> int:
        """Count a failure that may pass; returns the job's failures so far."""
        ...

    def keep_log(self, job_id: str, text: str) -> None:
        """Keep what a job printed before its process ended, for the report on the job if it is given up."""
        ...

    def log_of(self, job_id: str) -> str:
        """Return the text that `keep_log` kept last for a job; empty if there is none."""
        ...

    def forgive(self, job_ids: Iterable[str]) -> None:
        """Forget the starts, troubles and logs of some jobs."""
        ...

    def lead(self, owner: str, ttl_s: float) -> bool:
        """Become the owner that queues this dataset's jobs, or stay it for `ttl_s` seconds; False if another is."""
        ...

    def leader(self) -> str | None:
        """Return the owner that queues this dataset's jobs; None if there is none."""
        ...

    def resign(self, owner: str) -> None:
        """Stop queueing this dataset's jobs, if the owner does."""
        ...

    def add_figures(self, figures: Mapping[str, float]) -> None:
        """Add to the running totals, by name, that metrics show."""
        ...

    def figures(self) -> Mapping[str, float]:
        """Return the running totals, by name."""
        ...

    def activity(self) -> Activity:
        """Return the rate over the recent completions and the newest picture."""
        ...


LedgerFactory = Callable[[str], Ledger]
"""Opens the ledger of a run by the run's key."""


def images_per_hour(finished_s: list[float], now_s: float) -> float | None:
    """Compute the rate over recent completions, in images an hour.

    Args:
        finished_s: times at which pictures were finished, in seconds of the Unix epoch, in any order.
        now_s: the time now.

    Returns:
        None if fewer than two are recent.
    """
    recent = sorted(moment for moment in finished_s if 0 <= now_s - moment <= RECENT_S)
    if len(recent) < 2 or now_s <= recent[0]:
        return None
    return (len(recent) - 1) / (now_s - recent[0]) * 3600.0
