"""Rendering the picture's scene into an array."""

import tempfile
from pathlib import Path
from typing import Any

import bpy
import cv2
import numpy as np
from numpy.typing import NDArray

from blend import names
from farm.errors import RenderError
from farm.rendering import CyclesSettings, Denoiser, Pattern, PictureSettings
from worker.eevee import light_with_a_spot
from worker.matte import Backdrop, lay_over

ADAPTIVE_LEAST_SAMPLES = 4
"""Taken of every pixel before noise is looked at."""


def configure_picture(resolution: int, threads: int) -> Any:
    """Set what does not depend on the engine; returns the picture's scene.

    Args:
        resolution: pixels along an edge.
        threads: CPU threads; 0 takes all.
    """
    scene = bpy.data.scenes[names.PICTURE_SCENE]
    render = scene.render
    render.resolution_x = render.resolution_y = resolution
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1.0
    render.use_border = False
    render.film_transparent = False
    render.use_compositing = render.use_sequencer = False
    render.threads_mode = "FIXED" if threads else "AUTO"
    if threads:
        render.threads = threads
    render.dither_intensity = 0.0
    image = render.image_settings
    image.file_format, image.color_mode, image.color_depth, image.compression = "PNG", "RGB", "8", 0
    return scene


def configure_eevee(scene: Any, samples: int) -> None:
    """Render the configured scene with Eevee."""
    scene.render.engine = "BLENDER_EEVEE_NEXT"
    scene.eevee.taa_render_samples = samples
    # Ambient occlusion and bounced light, without which cables under an HDRI seem to float.
    scene.eevee.use_raytracing = True
    light_with_a_spot(scene)


def configure_cycles(scene: Any, settings: PictureSettings, device: str, seed: int) -> None:
    """Render the configured scene with Cycles.

    Args:
        scene: the picture's.
        settings: are all set, every time.
        device: as chosen by `worker.devices.choose_device`.
        seed: of the sampling pattern.
    """
    scene.render.engine = "CYCLES"
    scene.render.use_persistent_data = settings.economy.persistent_data
    cycles, wanted = scene.cycles, settings.cycles
    cycles.device = "CPU" if device == "cpu" else "GPU"
    cycles.seed = seed
    cycles.sampling_pattern = "TABULATED_SOBOL" if wanted.pattern is Pattern.SOBOL else "BLUE_NOISE"
    cycles.samples = wanted.samples
    cycles.time_limit = 0.0
    cycles.use_adaptive_sampling = wanted.adaptive_threshold > 0
    cycles.adaptive_threshold = wanted.adaptive_threshold
    cycles.adaptive_min_samples = ADAPTIVE_LEAST_SAMPLES
    _limit_paths(cycles, wanted)
    cycles.use_light_tree = wanted.light_tree
    _find_bright_parts(scene.world, wanted.world_map_px)
    cycles.use_denoising = wanted.denoiser is not Denoiser.NONE
    cycles.denoiser = "OPENIMAGEDENOISE"
    cycles.denoising_use_gpu = False
    cycles.denoising_input_passes = {"none": "RGB", "albedo": "RGB_ALBEDO", "albedo_normal": "RGB_ALBEDO_NORMAL"}[
        wanted.guides
    ]
    cycles.denoising_prefilter = wanted.prefilter.upper()
    if cycles.use_denoising:
        cycles.denoising_quality = wanted.denoiser.upper()


def _limit_paths(cycles: Any, wanted: CyclesSettings) -> None:
    cycles.max_bounces = wanted.bounces
    cycles.diffuse_bounces, cycles.glossy_bounces = wanted.diffuse_bounces, wanted.glossy_bounces
    cycles.transmission_bounces = cycles.transparent_max_bounces = wanted.bounces
    cycles.volume_bounces = 0
    cycles.caustics_reflective = cycles.caustics_refractive = wanted.caustics
    cycles.sample_clamp_direct, cycles.sample_clamp_indirect = 0.0, wanted.clamp_indirect


def _find_bright_parts(world: Any, map_px: int) -> None:
    """Set the map that Cycles makes of the world at each render; its own choice takes 0.8 s for an HDRI of 1,024."""
    world.cycles.sampling_method = "MANUAL" if map_px else "AUTOMATIC"
    if map_px:
        world.cycles.sample_map_resolution = map_px


def render_picture(behind: Backdrop | None = None) -> NDArray[np.uint8]:
    """Render the picture's scene as configured.

    Args:
        behind: what is behind all that is rendered; None if the scene has it all.

    Returns:
        (H, W, 3) uint8 sRGB.

    Raises:
        RenderError: if Blender gives no picture.
    """
    scene = bpy.data.scenes[names.PICTURE_SCENE]
    with tempfile.TemporaryDirectory(prefix="cable-farm-") as folder:
        target = Path(folder) / "picture.png"
        if behind is None:
            _render_into(scene, target)
        else:
            _render_before(scene, behind, target)
        pixels = cv2.imread(str(target), cv2.IMREAD_COLOR)
    if pixels is None:
        raise RenderError("Blender ended a render without writing a picture; see the worker's log")
    return cv2.cvtColor(pixels, cv2.COLOR_BGR2RGB).astype(np.uint8, copy=False)


def _render_into(scene: Any, target: Path) -> None:
    scene.render.filepath = str(target)
    try:
        bpy.ops.render.render(write_still=True, scene=scene.name)
    except RuntimeError as error:
        raise RenderError(f"Blender failed to render: {' '.join(str(error).split())}") from error


def _render_before(scene: Any, behind: Backdrop, target: Path) -> None:
    """Render without the world, and put it behind in linear light, before Blender's view transform."""
    light = target.with_suffix(".exr")
    settings = scene.render.image_settings
    scene.render.film_transparent = True
    settings.file_format, settings.color_mode, settings.color_depth, settings.exr_codec = (
        "OPEN_EXR",
        "RGBA",
        "32",
        "NONE",
    )
    try:
        _render_into(scene, light)
    finally:
        scene.render.film_transparent = False
        settings.file_format, settings.color_mode, settings.color_depth, settings.compression = "PNG", "RGB", "8", 0
    image = bpy.data.images.load(str(light))
    try:
        rows, columns = behind.covered.shape
        pixels = np.empty(rows * columns * 4, np.float32)
        if tuple(image.size) != (columns, rows):
            raise RenderError("Blender ended a render without writing a picture; see the worker's log")
        image.pixels.foreach_get(pixels)
        layers = pixels.reshape(rows, columns, 4)[::-1]  # Blender's rows go up
        layers[:, :, :3] = lay_over(np.ascontiguousarray(layers[:, :, :3]), behind)
        layers[:, :, 3] = 1.0
        image.pixels.foreach_set(pixels)
        image.save_render(str(target), scene=scene)
    finally:
        bpy.data.images.remove(image)
