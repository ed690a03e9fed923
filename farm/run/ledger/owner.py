"""The owner of a claim: a process, by machine and number. A dead process of this machine loses its claims at once."""

import os
from collections.abc import Mapping
from pathlib import Path

from farm.machine import machine_name
from farm.run.ledger.port import Ledger


def this_process() -> str:
    """Name the calling process as an owner of claims."""
    return process_of_this_machine(os.getpid())


def process_of_this_machine(process_id: int) -> str:
    """Name a process of this machine as an owner of claims."""
    return f"{machine_name()}:{process_id}"


def is_gone(owner: str) -> bool:
    """Whether the owner is a process of this machine that has ended. It is False for processes of other machines."""
    machine, _, number = owner.rpartition(":")
    if machine != machine_name() or not number.isdecimal():
        return False
    return not _lives(int(number))


def _lives(process_id: int) -> bool:
    try:
        os.kill(process_id, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    try:
        # A zombie answers signals although it has ended. Its state follows the name in brackets.
        state = Path(f"/proc/{process_id}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return True
    return state not in {"Z", "X"}


def live_claims(ledger: Ledger) -> Mapping[str, str]:
    """Release the claims of ended processes; return those of living ones and of jobs that wait for a retry."""
    living = {}
    for job_id, owner in ledger.claims().items():
        if is_gone(owner):
            ledger.release(job_id, owner)
        else:
            living[job_id] = owner
    return living
