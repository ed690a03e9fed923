"""The measured process's notes on its pictures."""

import hashlib
import json
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from numba.core.dispatcher import Dispatcher

from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from worker.blender.asset_files import AssetLibrary, SurfaceFiles
from worker.service.picture import Renderer
from worker.stopwatch import Stopwatch


def read_task(text: str) -> tuple[DatasetHeader, Job]:
    """Parse the header and the job's identifier, a line each."""
    header, job_id = text.splitlines()
    return DatasetHeader.model_validate_json(header), Job.from_id(job_id)


class TimedLibrary(AssetLibrary):
    """A library that counts the time it takes.

    Attributes:
        watch: seconds spent on finding and checking asset files, under `assets`.
    """

    def __init__(self, header: DatasetHeader) -> None:
        super().__init__(header, None)
        self.watch = Stopwatch()

    def surface(self, name: str) -> SurfaceFiles:
        """Files of a surface."""
        with self.watch.stage("assets"):
            return super().surface(name)

    def hdri(self, name: str) -> Path:
        """File of an HDRI."""
        with self.watch.stage("assets"):
            return super().hdri(name)


def make(renderer: Renderer, job: Job, header: DatasetHeader, library: TimedLibrary) -> Mapping[str, object]:
    """Make a picture; return its seconds by stage, a checksum of image and mask, and the device.

    Args:
        renderer: the open renderer.
        job: the picture's job.
        header: its dataset's header.
        library: the renderer's own library.
    """
    library.watch = Stopwatch()
    start = time.perf_counter()
    made = renderer.make(job, header)
    all_s = time.perf_counter() - start
    stages = {stage: seconds for stage, seconds in made.timings_s.items() if stage != "open"}
    stages["assets"] = library.watch.stages_s.get("assets", 0.0)
    stages["realize"] -= stages["assets"]
    stages["other"] = all_s - sum(stages.values())
    digest = hashlib.sha256(made.files["image"].tobytes() + made.files["mask"].tobytes()).hexdigest()
    return {"seconds": stages, "sha256": digest, "device": made.render.device}


def write(result: str, marks: Sequence[float], pause_s: float, pictures: Sequence[Mapping[str, object]]) -> None:
    """Write the measurements of one start.

    Args:
        result: path of the JSON file.
        marks: the clock at spawning, at the first line, after both imports, and when the template was open.
        pause_s: seconds between the last two marks that the measurement itself took.
        pictures: result of `make` for each picture.
    """
    spawned, begun, farm, blender, opened = marks
    content = {
        "steps": {"interpreter": begun - spawned, "main": farm - begun, "child": blender - farm},
        "open_s": opened - blender - pause_s,
        "pictures": pictures,
        "compiled": _compiled_now(),
    }
    Path(result).write_text(json.dumps(content))


def _compiled_now() -> dict[str, int]:
    """Number of compiled functions that were read from disk, and of those that had to be compiled."""
    ours = [vars(module).values() for name, module in sys.modules.items() if name.startswith("worker.")]
    # A function appears in every module that imports it, so it is counted by identity.
    functions = {id(member): member for members in ours for member in members if isinstance(member, Dispatcher)}
    statistics = [function.stats for function in functions.values()]
    return {
        "read": sum(sum(each.cache_hits.values()) for each in statistics),
        "compiled": sum(sum(each.cache_misses.values()) for each in statistics),
    }
