"""The faults themselves. Each strikes at once and, if it lasts, returns the function that undoes it."""

import signal
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from os import kill
from typing import TypeVar

import numpy as np
import redis

from tests.chaos import files, messages
from tests.chaos.clock import HOUR_S
from tests.chaos.farm_under_test import FarmUnderTest
from tests.chaos.schedule import Event, Fault
from tests.chaos.service import Service

Undo = Callable[[], None]
Strike = Callable[[FarmUnderTest, np.random.Generator], Undo | None]
_Thing = TypeVar("_Thing")

_JUMP_HOURS = (3, 9)
"""Least and largest jump of the clock, hours: beyond Celery's visibility timeout of 2 h, so that messages are
delivered to other workers, too."""


class NotNowError(Exception):
    """This fault has nothing to strike at this moment, but may have later."""


def strike(event: Event, farm: FarmUnderTest) -> Undo | None:
    """Let a fault strike.

    Returns:
        A function that undoes the fault; None for a fault without duration.

    Raises:
        NotNowError: if the fault has nothing to strike at this moment.
    """
    try:
        return _STRIKES[event.fault](farm, event.generator())
    except (redis.RedisError, FileNotFoundError, NotADirectoryError) as error:
        # Another fault has taken Redis down or the folder away.
        raise NotNowError(str(error)) from error


def _one_of(things: Sequence[_Thing], rng: np.random.Generator) -> _Thing:
    if not things:
        raise NotNowError("none there")
    return things[int(rng.integers(len(things)))]


def _require(ready: bool) -> None:
    if not ready:
        raise NotNowError("another fault of the kind lasts")


def _running_worker(farm: FarmUnderTest, rng: np.random.Generator) -> Service:
    return _one_of([worker for worker in farm.workers if worker.pid is not None], rng)


def _child(farm: FarmUnderTest, rng: np.random.Generator) -> int:
    return _one_of([pid for worker in farm.workers for pid in worker.children()], rng)


def _signal(pid: int, number: signal.Signals) -> None:
    with suppress(ProcessLookupError):
        kill(pid, number)


def _kill_child(farm: FarmUnderTest, rng: np.random.Generator) -> None:
    _signal(_child(farm, rng), signal.SIGKILL)


def _kill_worker(farm: FarmUnderTest, rng: np.random.Generator) -> None:
    # A process that has a child has finished its start.
    _one_of([worker for worker in farm.workers if worker.children()], rng).send(signal.SIGKILL)


def _kill_coordinator(farm: FarmUnderTest, rng: np.random.Generator) -> None:
    del rng
    _require(farm.coordinator.pid is not None)
    farm.coordinator.send(signal.SIGKILL)


def _stop_child(farm: FarmUnderTest, rng: np.random.Generator) -> Undo:
    victim = _child(farm, rng)
    _signal(victim, signal.SIGSTOP)
    return partial(_signal, victim, signal.SIGCONT)


def _stop_worker(farm: FarmUnderTest, rng: np.random.Generator) -> Undo:
    worker = _running_worker(farm, rng)
    worker.send_group(signal.SIGSTOP)
    return partial(worker.send_group, signal.SIGCONT)


def _empty_redis(farm: FarmUnderTest, rng: np.random.Generator) -> Undo:
    del rng
    _require(farm.redis.runs)
    farm.redis.kill()
    return partial(farm.redis.start, empty=True)


def _restart_redis(farm: FarmUnderTest, rng: np.random.Generator) -> Undo:
    del rng
    _require(farm.redis.runs)
    farm.redis.kill()
    return farm.redis.start


def _cut(farm: FarmUnderTest, rng: np.random.Generator) -> None:
    del rng
    farm.proxy.cut()


def _refuse(farm: FarmUnderTest, rng: np.random.Generator) -> Undo:
    del rng
    _require(farm.proxy.accepts)
    farm.proxy.refuse()
    return farm.proxy.accept


def _swallow(farm: FarmUnderTest, rng: np.random.Generator) -> Undo:
    _require(farm.proxy.flows)
    farm.proxy.swallow()
    cut_at_end = bool(rng.integers(2))

    def undo() -> None:
        if cut_at_end:
            farm.proxy.cut()
        farm.proxy.flow()

    return undo


def _block_folder(farm: FarmUnderTest, rng: np.random.Generator) -> Undo:
    categories = [category for category, quota in farm.plan.header.spec.quotas.items() if quota]
    folder = farm.folder / _one_of(categories, rng)
    _require(folder.is_dir())
    return files.exchange_for_a_file(folder)


def _fill_disk(farm: FarmUnderTest, rng: np.random.Generator) -> Undo:
    del rng
    assert farm.disk is not None, "the scenario has no disk of its own"
    _require(not farm.disk.is_full)
    farm.disk.fill()
    return farm.disk.free


def _hang_store(farm: FarmUnderTest, rng: np.random.Generator) -> Undo:
    del rng
    assert farm.hanging is not None, "the scenario has no store that can hang"
    _require(not farm.hanging.hangs)
    farm.hanging.hang()
    return farm.hanging.answer


def _spoil(spoil: Callable[[FarmUnderTest, str, np.random.Generator], None]) -> Strike:
    def spoil_one(farm: FarmUnderTest, rng: np.random.Generator) -> None:
        spoil(farm, _one_of(farm.manifests.seen(), rng), rng)

    return spoil_one


def _jump_clock(farm: FarmUnderTest, rng: np.random.Generator) -> Undo:
    clock = farm.clock
    assert clock is not None, "the scenario has no clock of its own"
    _require(clock.offset_s == 0)
    clock.set(int(rng.integers(*_JUMP_HOURS, endpoint=True)) * HOUR_S)
    return partial(clock.set, 0)


def _on_messages(change: Callable[[FarmUnderTest, np.random.Generator], bool]) -> Strike:
    def change_now(farm: FarmUnderTest, rng: np.random.Generator) -> None:
        if not change(farm, rng):
            raise NotNowError("no message there")

    return change_now


_STRIKES: Mapping[Fault, Strike] = {
    Fault.KILL_CHILD: _kill_child,
    Fault.KILL_WORKER: _kill_worker,
    Fault.KILL_COORDINATOR: _kill_coordinator,
    Fault.STOP_CHILD: _stop_child,
    Fault.STOP_WORKER: _stop_worker,
    Fault.EMPTY_REDIS: _empty_redis,
    Fault.RESTART_REDIS: _restart_redis,
    Fault.CUT: _cut,
    Fault.REFUSE: _refuse,
    Fault.BLACKHOLE: _swallow,
    Fault.BLOCK_FOLDER: _block_folder,
    Fault.FILL_DISK: _fill_disk,
    Fault.HANG_STORE: _hang_store,
    Fault.TRUNCATE_FILE: _spoil(files.truncate),
    Fault.ALTER_FILE: _spoil(files.alter),
    Fault.REMOVE_MANIFEST: _spoil(files.remove_manifest),
    Fault.DUPLICATE: _on_messages(messages.duplicate),
    Fault.REDELIVER_DONE: _on_messages(messages.redeliver_done),
    Fault.LOSE_MESSAGES: _on_messages(messages.lose),
    Fault.POISON: _on_messages(messages.poison),
    Fault.JUMP_CLOCK: _jump_clock,
}
