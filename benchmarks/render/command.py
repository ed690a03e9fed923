"""`python -m benchmarks render`: time against error of rendering, and the calibration of qualities."""

from pathlib import Path

from rich.progress import track

from benchmarks.bench_dataset import bench_header
from benchmarks.render.geometry import compare_geometry, geometry_table
from benchmarks.render.measure import Measurement
from benchmarks.render.references import References
from benchmarks.render.report import calibrate, ladder_table, turns_table, verdicts, write_json, write_plot
from benchmarks.render.rows import disturbing_settings, idle_settings
from benchmarks.render.stage_set import Stage, settle
from benchmarks.render.variants import BASE, Group, Variant, ladder, turns
from benchmarks.terminal import bench_console, blender_writes_to
from farm.errors import VerificationError
from farm.spec.category import Category
from farm.spec.quality import Preset

DEFAULT_SCENES = 4
"""Scenes of each category that all ladders of samples are rendered on."""

DEFAULT_TURN_SCENES = 1
"""Scenes of each category that single settings are turned on."""

RESOLUTION = 512
"""Edge of a picture, pixels: the default of a dataset."""


def run(out: Path, *, seed: int, scenes: int | None, turn_scenes: int | None) -> int:
    """Measure, print, write `render.json`, `render.png` and `calibration.json` into `out`.

    Args:
        out: existing folder for the results.
        seed: seed of the dataset whose scenes are used.
        scenes: number of scenes of each category for the ladder of samples; None for `DEFAULT_SCENES`.
        turn_scenes: number of these scenes for the settings turned one at a time; None for `DEFAULT_TURN_SCENES`.

    Raises:
        VerificationError: if a setting changed a picture that it must not change.
        FarmError: if a scene can't be made.
    """
    console = bench_console()
    log_file = out / "render.log"
    # A category that is calibrated for the first time can be rendered as a reference alone.
    header = bench_header(1, seed, quality=Preset.REFERENCE)
    with blender_writes_to(log_file):
        stage = Stage(header, RESOLUTION)
        settled = list(settle(header, tuple(Category), scenes or DEFAULT_SCENES))
    references = References(header, stage, RESOLUTION)
    missing = sum(not references.path(scene).exists() for scene in settled)
    if missing:
        console.print(f"{missing} references are rendered first, a few minutes each; they are kept")
    climbing = Measurement(stage, references, log_file)
    turning = Measurement(stage, references, log_file)
    few = len(Category) * (DEFAULT_TURN_SCENES if turn_scenes is None else turn_scenes)
    for number, scene in enumerate(track(settled, "scenes", console=console, transient=True)):
        with blender_writes_to(log_file):
            references.picture(scene)
            # The scene's textures are read before the clock runs.
            stage.set(scene, BASE)
            stage.render()
        climbing.measure(scene, ladder())
        if number < few:
            turning.measure(scene, (_BASE_FIRST, *turns()))
    rows, turned = climbing.rows(), [row for row in turning.rows() if row.variant is not _BASE_FIRST]
    console.print(ladder_table(rows))
    if turned:
        console.print(turns_table(turned))
    with blender_writes_to(log_file):
        shapes = compare_geometry(stage, settled[: len(Category)])
    console.print(geometry_table(shapes))
    calibration = calibrate(rows)
    for line in verdicts(calibration):
        console.print(line, highlight=False)
    write_json(out / "render.json", [*rows, *turned], shapes, seed=seed)
    write_plot(out / "render.png", rows)
    (out / "calibration.json").write_text(calibration.model_dump_json(indent=1) + "\n")
    idle = idle_settings(turned)
    if idle:
        console.print(f"changed no picture: {', '.join(idle)}", highlight=False)
    disturbing = disturbing_settings(turned)
    if disturbing:
        raise VerificationError(f"these may not change a picture, and did: {', '.join(disturbing)}")
    return 0


_BASE_FIRST = Variant("base first", Group.SAMPLES, BASE)
"""Rendered before the turns and not counted, so that all turns follow the same picture."""
