"""Rendering the picture's scene into an array."""

import tempfile
from pathlib import Path
from typing import Any

import bpy
import cv2
import numpy as np
from numpy.typing import NDArray

from blend import names
from farm.category import Light
from farm.errors import RenderError
from farm.manifest import RenderSettings
from farm.spec import DatasetSpec, Engine, Quality
from worker.eevee import light_with_a_spot
from worker.render_settings import CyclesSettings, cycles_settings

_EEVEE_SAMPLES = {Quality.DRAFT: 8, Quality.STANDARD: 16, Quality.REFERENCE: 128}


def configure(spec: DatasetSpec, light: Light, *, device: str, threads: int, seed: int) -> RenderSettings:
    """Set how the picture's scene renders.

    Args:
        spec: resolution, engine and quality.
        light: decides how many samples are needed.
        device: as chosen by `worker.devices.choose_device`.
        threads: CPU threads; 0 takes all.
        seed: of Cycles' sampling pattern.

    Returns:
        The settings as acted on, for the manifest.
    """
    scene = bpy.data.scenes[names.PICTURE_SCENE]
    render = scene.render
    render.resolution_x = render.resolution_y = spec.resolution
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
    if spec.engine is Engine.EEVEE:
        return _configure_eevee(scene, spec)
    return _configure_cycles(scene, spec, cycles_settings(spec.quality, light), device, seed)


def _configure_eevee(scene: Any, spec: DatasetSpec) -> RenderSettings:
    scene.render.engine = "BLENDER_EEVEE_NEXT"
    samples = _EEVEE_SAMPLES[spec.quality]
    scene.eevee.taa_render_samples = samples
    # Ambient occlusion and bounced light, without which cables under an HDRI seem to float.
    scene.eevee.use_raytracing = True
    light_with_a_spot(scene)
    return RenderSettings(engine="eevee", device="opengl", samples=samples, denoiser=None, resolution=spec.resolution)


def _configure_cycles(
    scene: Any, spec: DatasetSpec, settings: CyclesSettings, device: str, seed: int
) -> RenderSettings:
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU" if device == "cpu" else "GPU"
    cycles.seed = seed
    cycles.samples = settings.samples
    # Adaptive sampling saves little at so few samples, and would make cost depend on the noise it sees.
    cycles.use_adaptive_sampling = False
    cycles.max_bounces = settings.max_bounces
    cycles.diffuse_bounces = cycles.glossy_bounces = settings.max_bounces
    cycles.transmission_bounces = cycles.volume_bounces = cycles.transparent_max_bounces = 0
    cycles.caustics_reflective = cycles.caustics_refractive = False
    cycles.use_denoising = settings.denoise
    if settings.denoise:
        cycles.denoiser = "OPENIMAGEDENOISE"
        cycles.denoising_input_passes = "RGB_ALBEDO_NORMAL"
        cycles.denoising_prefilter = "NONE"
        cycles.denoising_quality = "FAST"
    return RenderSettings(
        engine="cycles",
        device=device,
        samples=settings.samples,
        denoiser="openimagedenoise" if settings.denoise else None,
        resolution=spec.resolution,
    )


def render_picture() -> NDArray[np.uint8]:
    """Render the picture's scene as configured: (H, W, 3) uint8 sRGB.

    Raises:
        RenderError: if Blender gives no picture.
    """
    with tempfile.TemporaryDirectory(prefix="cable-farm-") as folder:
        target = Path(folder) / "picture.png"
        scene = bpy.data.scenes[names.PICTURE_SCENE]
        scene.render.filepath = str(target)
        try:
            bpy.ops.render.render(write_still=True, scene=scene.name)
        except RuntimeError as error:
            raise RenderError(f"Blender failed to render: {' '.join(str(error).split())}") from error
        pixels = cv2.imread(str(target), cv2.IMREAD_COLOR)
    if pixels is None:
        raise RenderError("Blender ended a render without writing a picture; see the worker's log")
    return cv2.cvtColor(pixels, cv2.COLOR_BGR2RGB).astype(np.uint8, copy=False)
