"""What the measured process notes of its pictures."""

import hashlib
import json
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from unittest.mock import patch

from numba.core.dispatcher import Dispatcher

from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from worker.blender.asset_files import AssetLibrary, SurfaceFiles
from worker.service.picture import Renderer

Seconds = dict[str, float]


def read_task(text: str) -> tuple[DatasetHeader, Job]:
    """The header and the job that stdin holds, a line each."""
    header, job_id = text.splitlines()
    return DatasetHeader.model_validate_json(header), Job.from_id(job_id)


@contextmanager
def asset_checks() -> Iterator[Seconds]:
    """Seconds that a studio opened inside has spent so far on finding and checking asset files, under `assets`."""
    seconds = {"assets": 0.0}

    class TimedLibrary(AssetLibrary):
        """A library that notes its time."""

        def surface(self, name: str) -> SurfaceFiles:
            """Files of a surface."""
            start = time.perf_counter()
            files = super().surface(name)
            seconds["assets"] += time.perf_counter() - start
            return files

        def hdri(self, name: str) -> Path:
            """File of an HDRI."""
            start = time.perf_counter()
            path = super().hdri(name)
            seconds["assets"] += time.perf_counter() - start
            return path

    with patch("worker.blender.renderer.AssetLibrary", TimedLibrary):
        yield seconds


def make(renderer: Renderer, job: Job, header: DatasetHeader, assets: Seconds) -> Mapping[str, object]:
    """Make a picture; its seconds by stage, `all` of them together, and a checksum of what was made."""
    assets["assets"] = 0.0
    start = time.perf_counter()
    made = renderer.make(job, header)
    all_s = time.perf_counter() - start
    stages = {stage: seconds for stage, seconds in made.timings_s.items() if stage != "open"}
    stages["realize"] -= assets["assets"]
    stages |= assets
    stages["other"] = all_s - sum(stages.values())
    digest = hashlib.sha256(made.files["image"].tobytes() + made.files["mask"].tobytes()).hexdigest()
    return {"seconds": stages, "sha256": digest, "device": made.render.device}


def write(result: str, marks: Sequence[float], pause_s: float, pictures: Sequence[Mapping[str, object]]) -> None:
    """Write what was measured.

    Args:
        result: the JSON file.
        marks: the clock at spawning, at the first line, after both imports, and when the template was open.
        pause_s: of the time between the last two, what the measurement itself took.
        pictures: as made.
    """
    spawned, begun, farm, renderer, opened = marks
    content = {
        "steps": {"interpreter": begun - spawned, "main": farm - begun, "child": renderer - farm},
        "open_s": opened - renderer - pause_s,
        "pictures": pictures,
        "compiled": _compiled_now(),
    }
    Path(result).write_text(json.dumps(content))


def _compiled_now() -> dict[str, int]:
    """How many compiled functions that Python called were read from disk, and how many had to be compiled."""
    ours = [vars(module).values() for name, module in sys.modules.items() if name.startswith("worker.")]
    # A function has its name in every module that imports it.
    functions = {id(member): member for members in ours for member in members if isinstance(member, Dispatcher)}
    statistics = [function.stats for function in functions.values()]
    return {
        "read": sum(sum(each.cache_hits.values()) for each in statistics),
        "compiled": sum(sum(each.cache_misses.values()) for each in statistics),
    }
