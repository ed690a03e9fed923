"""A renderer without Blender: draws noise from the job's own seed, so the queue can be tested in seconds.

As a program it is a worker with this renderer: `python -P tests/stand_in.py serve ...`. Environment variables make it
slow or failing: `STAND_IN_DELAY_S`; `STAND_IN_UNFIT` with a reason why it can't be opened; and `STAND_IN_FAILS` with
`job id=kind` pairs. The kinds: `permanent`; `passing`, which never passes; `once` in each process; `crash` of the
process; `segfault`, a real one; `hang`; `bloat`, which takes 400 MiB and hangs; `asset`, which this machine lacks;
`defect`, an exception of no FarmError.
`STAND_IN_STARTS` names a file that takes a line for each start: job id and process id.
"""

import ctypes
import os
import signal
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

from farm import __version__
from farm.dataset.manifest import RejectedAttempt, RenderSettings, SettleFigures
from farm.dataset.outputs import IMAGE, INSTANCES, MASK, Output, outputs_of
from farm.errors import AssetError, MachineError, RenderError, SceneError
from farm.run.worker_settings import RendererSettings
from farm.scene.backdrop import HdriWorld
from farm.scene.cable import Cable, CableMaterial
from farm.scene.camera import Camera
from farm.scene.floor import Floor
from farm.scene.light import PointLamp
from farm.scene.physics import Friction, Wind
from farm.scene.scene import Scene
from farm.spec.category import Background, Light
from farm.spec.header import BuiltinSurfaceRef, DatasetHeader, HdriRef, TemplateRef
from farm.spec.job import Job
from farm.spec.parse import parse_spec
from farm.spec.rendering import CableDetail
from worker.cli import main
from worker.sample.seeds import Stage, generator
from worker.service.picture import Picture, Renderer

SHA = "0" * 64

_FAILED_ONCE: set[str] = set()

# All figures are zero, as nothing was simulated. Strict models accept no integer for a float.
SETTLED = SettleFigures.model_validate(
    {name: 0 if field.annotation is int else 0.0 for name, field in SettleFigures.model_fields.items()}
)


def stand_in_header(*, seed: int = 0, resolution: int | str = 32, **quotas: int) -> DatasetHeader:
    """A header that asks for the images of each category that the quotas name."""
    wanted = quotas or {"far": 2, "close_concentrated_light": 2}
    data = {"seed": seed, "style": "published", "resolution": resolution, "quotas": wanted}
    return DatasetHeader(
        farm_version=__version__,
        spec=parse_spec(data, source="test"),
        template=TemplateRef(path=None, sha256=SHA),
        surfaces=(BuiltinSurfaceRef(name="oak", recipe_version=1),),
        hdris=(HdriRef(name="city", path=None, sha256=SHA, dark=False),),
    )


def stand_in_scene(job: Job) -> Scene:
    """A plausible scene of the job's category."""
    material = CableMaterial(
        colour=(200, 20, 20),
        dirt_colour=(1, 1, 1),
        dirt_position=0.7,
        dirt_mapping=(0.0, 0.0, 0.0),
        dirt_offset=0.0,
        reflection_position=0.65,
    )
    cable = Cable(
        diameter_m=0.002,
        length_m=0.4,
        x_m=0.0,
        y_m=0.0,
        start_height_m=0.004,
        rotation_deg=0.0,
        bends_per_m=(0.0, 0.0),
        youngs_modulus_pa=1e7,
        density_kg_m3=1500.0,
        material=material,
    )
    far = job.category.traits.background is Background.HDRI
    lit_by_lamp = job.category.traits.light is Light.CONCENTRATED
    lamp = PointLamp(bearing_deg=0.0, radius_m=5.0, height_m=5.0, power_w=900.0, size_m=0.5)
    world = HdriWorld(hdri="city", rotation_deg=0.0, tilt_deg=0.0, brightness=0.0)
    return Scene(
        attempt=0,
        cables=(cable,),
        vertex_mass=0.4,
        friction=Friction(floor=0.4, cable=0.3),
        wind=Wind(
            bearing_deg=0.0, distance=5.0, height=1.0, tilt_deg=90.0, strength=1.0, flow=0.2, speed_m_s=0.2, gusts=()
        ),
        floor=None if far else Floor(texture="oak", offset_x=0.0, offset_y=0.0, rotation_deg=0.0, scale=1.0),
        lamps=(lamp,) if lit_by_lamp else (),
        hdri_world=None if lit_by_lamp else world,
        camera=Camera(height_m=0.2, f_number=8.0),
        render_seed=1,
    )


def stand_in_files(job: Job, header: DatasetHeader) -> dict[str, Any]:
    """Contents by role: noise that no other job has, one cable across it, and every other label from its maker."""
    rows, columns = header.spec.resolution.shape
    draw = generator(header.spec.seed, job.category, job.index, 0, Stage.CABLES)
    instances = np.zeros((rows, columns), np.uint16)
    top = int(draw.integers(1, rows - 5))
    instances[top : top + 4] = 1
    files = {
        IMAGE.role: draw.integers(0, 256, (rows, columns, 3), dtype=np.uint8),
        MASK.role: np.where(instances > 0, 255, 0).astype(np.uint8),
        INSTANCES.role: instances,
    }
    others = [output for output in outputs_of(header.spec) if output.role not in files]
    return files | _made_labels(job, header, others, top / rows) if others else files


def _made_labels(job: Job, header: DatasetHeader, outputs: list[Output], place: float) -> dict[str, Any]:
    """Labels of a straight cable that lies `place`, 0 to 1, of the picture's height below its top."""
    # They bring SciPy, which would slow the start of every stand-in.
    from worker.camera.view import View  # noqa: PLC0415
    from worker.geometry import SettledGeometry  # noqa: PLC0415
    from worker.label.makers import make_labels  # noqa: PLC0415
    from worker.simulate.shapes import CableShapes  # noqa: PLC0415

    scene, rows = stand_in_scene(job), header.spec.resolution.height
    cable = scene.cables[0]
    along = np.linspace(-cable.length_m / 2, cable.length_m / 2, 51)
    across_m = (0.5 - place) * rows / View.of(scene.camera, header.spec.resolution).pixels_per_m
    shapes = CableShapes(
        nodes_m=(np.stack([along, np.full(51, across_m), np.full(51, cable.diameter_m / 2)], axis=1),),
        radii_m=np.array([cable.diameter_m / 2]),
        lengths_m=np.array([cable.length_m]),
        speeds_m_s=(np.zeros(51),),
        start_order=(0,),
        fall_s=0.0,
        steps=0,
    )
    return make_labels(SettledGeometry(scene, shapes, CableDetail(), header.spec.resolution), outputs)


class StandInRenderer:
    """Implements `worker.service.picture.Renderer`."""

    def make(self, job: Job, header: DatasetHeader) -> Picture:
        """Draw noise, with one cable across."""
        _note_start(job)
        time.sleep(float(os.environ.get("STAND_IN_DELAY_S", "0")))
        _fail_if_told(job)
        print("noise of Blender, which belongs in the log")
        return Picture(
            files=stand_in_files(job, header),
            scene=stand_in_scene(job),
            settled=SETTLED,
            rejected=(RejectedAttempt(attempt=0, reason="one for the show"),),
            render=RenderSettings(engine="none", device="CPU", samples=1, resolution=header.spec.resolution),
            timings_s={"render": 0.01},
            versions={"farm": __version__},
        )


def _note_start(job: Job) -> None:
    if journal := os.environ.get("STAND_IN_STARTS"):
        # The file is opened to append, and each line is one write, so lines of several processes don't mix.
        with Path(journal).open("a") as file:
            file.write(f"{job.id} {os.getpid()}\n")


def _fail_if_told(job: Job) -> None:
    told = dict(pair.split("=") for pair in os.environ.get("STAND_IN_FAILS", "").split() if pair)
    kind = told.get(job.id)
    if kind == "permanent":
        raise SceneError("no scene passed the checks")
    if kind == "passing" or (kind == "once" and job.id not in _FAILED_ONCE):
        _FAILED_ONCE.add(job.id)
        raise RenderError("Blender lost the device")
    if kind == "defect":
        raise ZeroDivisionError("a bug")
    if kind == "asset":
        raise AssetError("the surface 'oak' is not baked here")
    if kind == "hang":
        signal.signal(signal.SIGUSR1, signal.SIG_IGN)  # Celery's soft limit doesn't reach into Blender's C code
        time.sleep(3600)
    if kind == "segfault":
        ctypes.string_at(0)
    if kind == "bloat":
        taken = np.ones(400 * 2**20, np.uint8)
        time.sleep(3600 + taken[0])
    if kind == "crash":
        print("the last words", flush=True)
        os.kill(os.getpid(), signal.SIGKILL)


def open_stand_in(header: DatasetHeader, settings: RendererSettings) -> Renderer:
    """Takes what the real one takes, and needs none of it.

    Raises:
        MachineError: if the variable `STAND_IN_UNFIT` holds a reason.
    """
    del header, settings
    if reason := os.environ.get("STAND_IN_UNFIT"):
        raise MachineError(reason)
    return StandInRenderer()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:], open_stand_in))
