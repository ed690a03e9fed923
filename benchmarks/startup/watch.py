"""The measured process's notes on its pictures."""

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
    """Parse the header and the job's identifier, a line each."""
    header, job_id = text.splitlines()
    return DatasetHeader.model_validate_json(header), Job.from_id(job_id)


@contextmanager
def asset_checks() -> Iterator[Seconds]:
    """Time the finding and checking of asset files by a renderer that is opened within the context.

    Yields:
        Seconds so far, under the key `assets`.
    """
    seconds = {"assets": 0.0}

    class TimedLibrary(AssetLibrary):
        """A library that adds up its time."""

        def surface(self, name: str) -> SurfaceFiles:
            """The files of a surface."""
            start = time.perf_counter()
            files = super().surface(name)
            seconds["assets"] += time.perf_counter() - start
            return files

        def hdri(self, name: str) -> Path:
            """The file of an HDRI."""
            start = time.perf_counter()
            path = super().hdri(name)
            seconds["assets"] += time.perf_counter() - start
            return path

    with patch("worker.blender.renderer.AssetLibrary", TimedLibrary):
        yield seconds


def make(renderer: Renderer, job: Job, header: DatasetHeader, assets: Seconds) -> Mapping[str, object]:
    """Make a picture and return its seconds by stage, a checksum of the picture and mask, and the device."""
    assets["assets"] = 0.0
    start = time.perf_counter()
    made = renderer.make(job, header)
    all_s = time.perf_counter() - start
    stages = {stage: seconds for stage, seconds in made.timings_s.items() if stage != "open"}
    stages["realize"] -= assets["assets"]
    stages |= assets
    stages["other"] = all_s - sum(stages.values())
    digest = hashlib.sha256(made.image.tobytes() + made.mask.tobytes()).hexdigest()
    return {"seconds": stages, "sha256": digest, "device": made.render.device}


def write(result: str, marks: Sequence[float], pause_s: float, pictures: Sequence[Mapping[str, object]]) -> None:
    """Write what was measured.

    Args:
        result: path of the JSON file.
        marks: clock at the request for the process, at its first line, after each of both imports, and when the
            template was open.
        pause_s: time between the last two marks that the measurement itself took.
        pictures: notes that `make` returned.
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
    """Numbers of the compiled functions called by Python that were read from disk, and that were compiled now."""
    ours = [vars(module).values() for name, module in sys.modules.items() if name.startswith("worker.")]
    # A function appears in every module that imports it, so it is counted by identity.
    functions = {id(member): member for members in ours for member in members if isinstance(member, Dispatcher)}
    statistics = [function.stats for function in functions.values()]
    return {
        "read": sum(sum(each.cache_hits.values()) for each in statistics),
        "compiled": sum(sum(each.cache_misses.values()) for each in statistics),
    }
