"""Judge a farm that has come to its end: what must hold, whatever happened to it."""

import json
import os
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from farm.dataset.outputs import OUTPUTS
from farm.dataset.paths import file_path, manifest_path
from farm.dataset.verify import Verdict, verify
from farm.errors import IncompleteError
from farm.spec.job import Job
from farm.storage import is_temporary
from tests.chaos.expected import Expected
from tests.chaos.farm_under_test import FarmUnderTest
from tests.chaos.queue_keys import unacknowledged, waiting
from tests.chaos.service import living_with

QUARANTINE = "quarantine"
"""Folder of a dataset that holds a record of each job that was given up."""

_DRAIN_S = 20.0
_STATUS_S = 60.0
_SHOWN = 5


@dataclass(frozen=True, slots=True)
class Claims:
    """The demands of a scenario.

    Attributes:
        expected: bytes of each job's files.
        quarantined: the only jobs that must be given up.
        starts_of_quarantined: number of times that each of them must have been begun; None if other faults affect it.
        workers_stay: whether no worker may have ended by itself.
        told: words that the coordinator must have printed; empty for none.
    """

    expected: Expected
    quarantined: frozenset[str] = frozenset()
    starts_of_quarantined: int | None = None
    workers_stay: bool = False
    told: str = ""


@dataclass(frozen=True, slots=True)
class Judgement:
    """The result of a judgement.

    Attributes:
        findings: sentences on what doesn't hold; empty if everything does.
        notes: sentences on remarkable things that aren't faults.
        quarantined: jobs that were given up.
        done: jobs whose files all agree with their manifest.
    """

    findings: tuple[str, ...]
    notes: tuple[str, ...]
    quarantined: tuple[str, ...]
    done: int


def judge(farm: FarmUnderTest, claims: Claims) -> Judgement:
    """Judge a farm whose coordinator has ended, and end its other processes.

    Every finding is one sentence.
    """
    findings = []
    if not farm.redis.runs:
        findings.append("Redis ended by itself")
        farm.redis.start()
    findings += _drain(farm)
    notes = []
    status = _status(farm)
    left = unacknowledged(farm.redis.client)
    if left:
        notes.append(f"{left} messages of ended workers wait for the visibility timeout")
    if claims.workers_stay:
        findings += [f"{worker.name} ended by itself" for worker in farm.workers if worker.starts > 1]
    if claims.told and not farm.coordinator.has_said(claims.told):
        findings.append(f"the coordinator never told: {claims.told}")
    findings += [f"{name} did not end within its time when asked to" for name in farm.end()]
    farm.redis.kill()
    findings += _left_processes(farm)
    quarantined = given_up(farm, status)
    verdict = verify(farm.dataset)
    findings += _quarantine(farm, claims, quarantined)
    findings += _files(farm, verdict, quarantined)
    findings += _pixels(farm, claims.expected, quarantined)
    findings += _status_findings(farm, status, verdict, quarantined)
    contradictions = farm.manifests.contradictions()
    if contradictions:
        findings.append(f"manifests were written again with another content: {_some(contradictions)}")
    return Judgement(tuple(findings), tuple(notes), tuple(sorted(quarantined)), verdict.images)


def given_up(farm: FarmUnderTest, status: Mapping[str, Any]) -> set[str]:
    """The jobs that were given up: those with a record in the folder, and those that the ledger lists."""
    records = {path.stem for path in (farm.folder / QUARANTINE).glob("*.json")}
    return records | set(status.get("quarantined") or {})


def starts(farm: FarmUnderTest) -> Counter[str]:
    """Number of times that each job was begun; empty if workers keep no journal."""
    if not farm.journal.exists():
        return Counter()
    return Counter(line.split()[0] for line in farm.journal.read_text().splitlines() if line)


def _drain(farm: FarmUnderTest) -> Iterator[str]:
    """Let workers take the rest of the queue, which is mostly duplicates."""
    give_up_s = time.monotonic() + _DRAIN_S
    while True:
        farm.supervise()
        left = {key: len(found) for key, found in waiting(farm.redis.client).items()}
        if not left:
            return
        if time.monotonic() > give_up_s:
            yield f"messages are left in the queue: {left}"
            return
        time.sleep(0.1)


def _status(farm: FarmUnderTest) -> Mapping[str, Any]:
    command = [sys.executable, "-P", "-m", "farm", "status", str(farm.folder), "--json", "--broker", farm.proxy.url]
    # They run without the clock of the farm under test, which was put right long before.
    told = subprocess.run(command, check=False, capture_output=True, text=True, timeout=_STATUS_S, env=os.environ)
    if told.returncode != 0:
        return {"error": told.stderr.strip()}
    status: Mapping[str, Any] = json.loads(told.stdout)
    return status


def _left_processes(farm: FarmUnderTest) -> Iterator[str]:
    give_up_s = time.monotonic() + 2.0
    while left := living_with(str(farm.root)):
        if time.monotonic() > give_up_s:
            yield f"processes are left behind: {_some([f'{pid} {arguments[:200]}' for pid, arguments in left.items()])}"
            return
        time.sleep(0.05)


def _quarantine(farm: FarmUnderTest, claims: Claims, quarantined: Collection[str]) -> Iterator[str]:
    unexpected = sorted(set(quarantined) - claims.quarantined)
    if unexpected:
        yield f"{len(unexpected)} jobs were given up that can be made: {_some(unexpected)}"
    missing = sorted(claims.quarantined - set(quarantined))
    if missing:
        yield f"jobs that can't be made were not given up: {_some(missing)}"
    code = IncompleteError.exit_code if claims.quarantined else 0
    if farm.coordinator.ended_with not in {code, None}:
        yield f"the coordinator ended with exit code {farm.coordinator.ended_with}, not {code}"
    if claims.starts_of_quarantined is not None:
        begun = starts(farm)
        for job_id in sorted(claims.quarantined):
            if begun[job_id] != claims.starts_of_quarantined:
                yield f"{job_id} was begun {begun[job_id]} times, not {claims.starts_of_quarantined}"


def _files(farm: FarmUnderTest, verdict: Verdict, quarantined: Collection[str]) -> Iterator[str]:
    excused = {manifest_path(Job.from_id(job_id)) for job_id in quarantined}
    wrong = [
        f"{finding.fault} {finding.path} ({finding.detail})"
        for finding in verdict.findings
        if finding.path not in excused and not finding.path.startswith(f"{QUARANTINE}/")
    ]
    if wrong:
        yield f"farm verify finds {len(wrong)} faults: {_some(wrong)}"
    temporary = [path for path in farm.dataset.storage.files() if is_temporary(path)]
    if temporary:
        yield f"temporary files are left: {_some(temporary)}"


def _pixels(farm: FarmUnderTest, expected: Expected, quarantined: Collection[str]) -> Iterator[str]:
    wrong = []
    for job in farm.plan.header.spec.jobs():
        for output, content in expected(job).items() if job.id not in quarantined else ():
            path = farm.folder / file_path(job, output)
            if path.exists() and path.read_bytes() != content:
                wrong.append(file_path(job, output))
    if wrong:
        yield f"{len(wrong)} files are not their job's own: {_some(wrong)}"


def _status_findings(
    farm: FarmUnderTest, status: Mapping[str, Any], verdict: Verdict, quarantined: Collection[str]
) -> Iterator[str]:
    if "error" in status:
        yield f"farm status fails: {status['error']}"
        return
    done = Counter(job.category for job in farm.plan.header.spec.jobs() if _is_there(farm, job))
    for category, quota in farm.plan.header.spec.quotas.items():
        told = status["categories"][category]
        if told != {"done": done[category], "quota": quota}:
            yield f"farm status tells {told} of {category}, the folder {done[category]} of {quota}"
    if sum(done.values()) + len(quarantined) != verdict.quota:
        yield f"{sum(done.values())} done and {len(quarantined)} given up are not the quota of {verdict.quota}"
    if status.get("running"):
        yield f"jobs are still claimed: {_some(status['running'])}"


def _is_there(farm: FarmUnderTest, job: Job) -> bool:
    paths = [manifest_path(job), *(file_path(job, output) for output in OUTPUTS)]
    return all((farm.folder / path).is_file() for path in paths)


def _some(things: Collection[str], describe: Callable[[str], str] = str) -> str:
    shown = ", ".join(describe(thing) for thing in list(things)[:_SHOWN])
    return shown if len(things) <= _SHOWN else f"{shown} and {len(things) - _SHOWN} more"
