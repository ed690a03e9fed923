"""Rendering the template's picture into an array, by Cycles or Eevee."""

from typing import Any

import bpy
import cv2
import numpy as np
from numpy.typing import NDArray

from blend import names
from blend.rendered import read_plain_exr, render_file, save_file
from farm.errors import RenderError
from farm.scene.camera import Development
from farm.spec.rendering import CyclesSettings, Denoiser, Pattern, PictureSettings
from worker.backdrop.matte import Matte, lay_over
from worker.blender.build_scene import BuiltScene
from worker.blender.eevee import light_with_a_spot
from worker.camera.develop import develop
from worker.camera.distortion import Distortion
from worker.camera.illuminant import NEUTRAL, illuminant

ADAPTIVE_LEAST_SAMPLES = 4
"""Samples of every pixel before adaptive sampling may stop."""


def configure_picture(resolution: int, threads: int) -> Any:
    """Set everything about a render that does not depend on the engine.

    Args:
        resolution: pixels along an edge.
        threads: CPU threads; 0 takes one for each core.

    Returns:
        Blender's scene of the picture.
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
        scene: Blender's scene of the picture.
        settings: all of Cycles' settings; each of them is set, every time.
        device: device as chosen by `blend.devices.choose_device`.
        seed: number that starts the sampling pattern.
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
    """Set the size of the map that Cycles makes of the world; its own choice takes 0.8 s for an HDRI 1,024 wide."""
    world.cycles.sampling_method = "MANUAL" if map_px else "AUTOMATIC"
    if map_px:
        world.cycles.sample_map_resolution = map_px


def render_picture(
    matte: Matte | None = None,
    *,
    distortion: float = 0.0,
    development: Development | None = None,
    lit_by: NDArray[np.float64] = NEUTRAL,
) -> NDArray[np.uint8]:
    """Render the picture as configured.

    Args:
        matte: the backdrop to lay the render over; None if the render has everything.
        distortion: the lens's distortion, which Blender's lens lacks; see `farm.scene.camera.Camera`.
        development: settings by which the camera develops the light; None for Blender's view transform.
        lit_by: (3,), colour of the scene's light, for the development.

    Returns:
        (H, W, 3) uint8 sRGB.

    Raises:
        RenderError: if Blender gives no picture.
    """
    scene = bpy.data.scenes[names.PICTURE_SCENE]
    if matte is None and distortion == 0.0 and development is None:
        return _decode(render_file(scene))
    light = _render_light(scene, matte)
    if development is not None:
        return develop(light, development, distortion=distortion, lit_by=lit_by)
    return _view(scene, Distortion(distortion).distort(light))


def render_scene(built: BuiltScene) -> NDArray[np.uint8]:
    """Render a built scene as its own camera takes it; see `render_picture`."""
    scene = built.scene
    return render_picture(
        built.matte,
        distortion=scene.camera.distortion,
        development=scene.development,
        lit_by=illuminant(scene.lamps, scene.grey_world),
    )


def _render_light(scene: Any, matte: Matte | None) -> NDArray[np.float32]:
    """Render linear light (H, W, 3); with a matte the world is left out, and the backdrop is laid behind."""
    settings = scene.render.image_settings
    scene.render.film_transparent = matte is not None
    settings.file_format, settings.color_mode, settings.color_depth, settings.exr_codec = (
        "OPEN_EXR",
        "RGBA",
        "32",
        "NONE",
    )
    try:
        light = read_plain_exr(render_file(scene))
    finally:
        scene.render.film_transparent = False
        settings.file_format, settings.color_mode, settings.color_depth, settings.compression = "PNG", "RGB", "8", 0
    if matte is None:
        return light
    if light.shape[:2] != matte.covered.shape:
        raise RenderError(f"Blender rendered {light.shape[1]} x {light.shape[0]} pixels; see the worker's log")
    return lay_over(light, matte)


def _view(scene: Any, light: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Light (H, W, 3) through the scene's view transform."""
    rows, columns = light.shape[:2]
    image = bpy.data.images.new("light", columns, rows, float_buffer=True)
    try:
        image.pixels.foreach_set(cv2.cvtColor(np.ascontiguousarray(light[::-1]), cv2.COLOR_RGB2RGBA).ravel())
        return _decode(save_file(image, scene))
    finally:
        bpy.data.images.remove(image)


def _decode(png: bytes) -> NDArray[np.uint8]:
    pixels = cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR)
    if pixels is None:
        raise RenderError("Blender wrote a picture that is no PNG; see the worker's log")
    return cv2.cvtColor(pixels, cv2.COLOR_BGR2RGB).astype(np.uint8, copy=False)
