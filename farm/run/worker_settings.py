"""The settings of a worker and its renderer: checked here, then handed to the worker's program as JSON in one argument.

They go by an argument rather than by standard input: `farm worker` becomes the program and leaves its terminal to it, a
worker that died is started again with the same words, and the commands for one picture read the dataset's header from
standard input. Every user of a machine can read arguments, so the broker's address, which may hold a password, isn't
part of the settings: the environment carries it.
"""

import json
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Self

from pydantic import Field, ValidationError

from farm.model import Model

TASKS_PER_CHILD = 200
"""Jobs after which a renderer is replaced by a fresh one: memory that Blender loses stays bounded."""

MEMORY_PER_CHILD_KIB = 4 * 1024 * 1024
"""Memory, in KiB, above which a renderer is replaced after its job."""

MIN_FREE_MIB = 1024
"""Free space of the store's disk, in MiB, below which a worker takes no job."""

HARD_LIMIT_S = 30 * 60
"""Seconds after which the process of a job is killed; the longest limit that a worker may be given."""


class DeviceChoice(StrEnum):
    """The device that Cycles is asked to render on; `auto` takes a GPU if there is one, else the CPU."""

    AUTO = "auto"
    CPU = "cpu"
    OPTIX = "optix"
    CUDA = "cuda"
    HIP = "hip"
    ONEAPI = "oneapi"


class _Argument(Model):
    """Settings that cross from one program to another as an argument."""

    def as_argument(self) -> str:
        """Write the settings as JSON, in ASCII: a path may hold bytes that are no UTF-8."""
        return json.dumps(self.model_dump(), default=str)

    @classmethod
    def from_argument(cls, text: str) -> Self:
        """Read what `as_argument` wrote.

        Raises:
            ValueError: if the text is no JSON, or a setting is unknown, missing or out of its range; in one line.
        """
        try:
            # Paths and devices are plain text in JSON, which a strict model takes for no other type.
            return cls.model_validate(json.loads(text), strict=False)
        except ValidationError as error:
            first = error.errors()[0]
            setting = ".".join(str(key) for key in first["loc"]) or "settings"
            raise ValueError(f"{setting}: {first['msg']}") from error


class RendererSettings(_Argument):
    """Settings of a renderer on this machine. They decide how fast pictures are made, not what they show.

    Attributes:
        device: device that Cycles renders on.
        threads: threads of the renderer on the CPU; 0 takes all cores.
        assets: folder of the baked surfaces; None for the user's own.
        inputs: folders and files in which the renderer looks for a dataset's textures, HDRIs, photographs and template
            that are not where the header says.
    """

    device: DeviceChoice = DeviceChoice.AUTO
    threads: Annotated[int, Field(ge=0)] = 0
    assets: Path | None = None
    inputs: tuple[Path, ...] = ()


class WorkerSettings(_Argument):
    """Settings of one worker, without the broker's address.

    Attributes:
        store: folder or URL below which the datasets lie.
        name: name of the worker, unique on its host; Flower shows it.
        logs: folder that takes `<name>.log`, and below `jobs` what Blender prints, a file for each job.
        renderer: settings of each child's renderer.
        concurrency: number of children, each with a Blender of its own.
        tasks_per_child: number of jobs after which a child is replaced.
        memory_per_child_kib: memory, in KiB, above which a child is replaced after its job; at twice as much it is
            killed.
        time_limit_s: seconds after which a job's process is killed. A job that can be told to stop is told after five
            sixths of them.
        min_free_mib: free space of the store's disk, in MiB, below which no job is taken.
    """

    store: str
    name: Annotated[str, Field(min_length=1)]
    logs: Path
    renderer: RendererSettings = RendererSettings()
    concurrency: Annotated[int, Field(ge=1)] = 1
    tasks_per_child: Annotated[int, Field(ge=1)] = TASKS_PER_CHILD
    memory_per_child_kib: Annotated[int, Field(ge=1)] = MEMORY_PER_CHILD_KIB
    time_limit_s: Annotated[float, Field(gt=0, le=HARD_LIMIT_S)] = HARD_LIMIT_S
    min_free_mib: Annotated[int, Field(ge=0)] = MIN_FREE_MIB

    def serve_arguments(self) -> list[str]:
        """Build the arguments with which the worker's program takes jobs under these settings."""
        return ["serve", self.as_argument()]
