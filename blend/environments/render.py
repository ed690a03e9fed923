"""Rendering the environments into panoramas, once on each machine."""

import json
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from assets.environments import (
    BRIGHTEST,
    LARGEST_WIDTH,
    PANORAMA_NAME,
    RECORD_NAME,
    SMALLEST_WIDTH,
    TARGET_LUMINANCE,
    EnvironmentRecipe,
    EnvironmentRecord,
    environment_directory,
    missing_environments,
)
from assets.files import read_bounded, sha256, write_atomically
from assets.scan.float_image import write_float_image
from assets.scan.hdris import mean_luminance
from blend.devices import choose_device
from blend.environments.build import build_environment
from blend.rendered import read_plain_exr, render_file
from farm.errors import AssetError, RenderError
from farm.run.worker_settings import DeviceChoice

SAMPLES = 4
"""Cycles samples per pixel. They suffice since a denoiser follows, which is led by sharp colours and normals."""

BAND_DEG = 30.0
"""Degrees above and below the horizon that are rendered at full resolution: a far picture shows 20 degrees of them."""

COARSER = 4
"""Factor by which the resolution of the rest is smaller: it only lights, and a lit cable is far from a mirror."""

FADE_DEG = 2.0
"""Degrees at each edge of the full band over which it is mixed with the coarse panorama, so that no edge shows."""

RENDER_SEED = 0

SEAM_SHARE = 0.1
"""Largest step at the seam, relative to its darker side, that counts as the denoiser's doing and is smoothed."""


def render_environments(
    folder: Path, *, pixels: int, names: tuple[str, ...] | None, device: DeviceChoice, threads: int
) -> Iterator[str]:
    """Render the environments that a folder lacks, one after the other.

    Args:
        folder: Folder of the baked surfaces, below which the environments are written.
        pixels: Width of the panoramas, 64 to 8192 and even.
        names: Names of the environments to render; None for all.
        device: Device that Cycles is asked to render on.
        threads: Number of threads on the CPU; 0 for all cores.

    Yields:
        The name of each as soon as it is on disk.

    Raises:
        AssetError: A name is unknown, `pixels` is out of range, or the folder can't be written.
        MachineError: There is no such device.
        RenderError: Blender gives no picture, or one that can't be used.
    """
    if not SMALLEST_WIDTH <= pixels <= LARGEST_WIDTH or pixels % 2:
        raise AssetError(f"pixels: {pixels} is no even number from {SMALLEST_WIDTH} to {LARGEST_WIDTH}; try 4096")
    for recipe in missing_environments(folder, pixels, names):
        # An empty file has factory settings, so the device is chosen afresh for each.
        light = normalised(without_seam(render_panorama(recipe, pixels, device, threads)))
        write_environment(folder, recipe, light)
        yield recipe.name


def render_panorama(recipe: EnvironmentRecipe, pixels: int, device: DeviceChoice, threads: int) -> NDArray[np.float32]:
    """Build a recipe and render it: the band about the horizon, which pictures show, in full; the rest coarser.

    Returns:
        (pixels / 2, pixels, 3) linear light, red first, the zenith first; its scale is arbitrary.

    Raises:
        MachineError: There is no such device.
        RenderError: Blender gives no picture.
    """
    scene = build_environment(recipe).scene
    configure(scene, choose_device(device), threads)
    rows = pixels // 2
    if pixels < COARSER * SMALLEST_WIDTH:
        return _render(scene, pixels, 0, rows)
    above = round(rows * (0.5 - BAND_DEG / 180))
    whole = _render(scene, pixels // COARSER, 0, pixels // COARSER // 2)
    light = cv2.resize(whole, (pixels, rows), interpolation=cv2.INTER_LINEAR).astype(np.float32, copy=False)
    band = _render(scene, pixels, above, rows - above)
    # Near its edges the band gives way to the coarse render little by little.
    inside = np.arange(len(band)) + 0.5
    share = np.clip(np.minimum(inside, len(band) - inside) / (FADE_DEG / 180 * rows), 0.0, 1.0).astype(np.float32)
    part = light[above : rows - above]
    part += (band - part) * share[:, None, None]
    return light


def _render(scene: Any, pixels: int, first: int, last: int) -> NDArray[np.float32]:
    """Render rows `first` to `last` of a panorama that is `pixels` wide, (last - first, pixels, 3)."""
    render, rows = scene.render, pixels // 2
    render.resolution_x, render.resolution_y, render.resolution_percentage = pixels, rows, 100
    render.use_border = render.use_crop_to_border = last - first < rows
    render.border_min_x, render.border_max_x = 0.0, 1.0
    # Blender's rows go up. It cuts rows off in single precision, of which a quarter of a row is clear.
    render.border_min_y, render.border_max_y = ((rows - row + 0.25) / rows for row in (last, first))
    light = read_plain_exr(render_file(scene))
    if light.shape != (last - first, pixels, 3):
        raise RenderError(
            f"Blender rendered {light.shape[1]} x {light.shape[0]} pixels of a panorama; install bpy 4.5 afresh"
        )
    return light


def configure(scene: Any, device: str, threads: int) -> None:
    """Set how a panorama renders: few samples and bounces, light from all around in their place, and a denoiser."""
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.use_compositing = render.use_sequencer = False
    render.threads_mode = "FIXED" if threads else "AUTO"
    if threads:
        render.threads = threads
    cycles.device = "CPU" if device == "cpu" else "GPU"
    cycles.seed, cycles.samples, cycles.use_adaptive_sampling = RENDER_SEED, SAMPLES, False
    cycles.max_bounces, cycles.diffuse_bounces, cycles.glossy_bounces = 4, 3, 2
    cycles.transmission_bounces, cycles.transparent_max_bounces, cycles.volume_bounces = 2, 6, 0
    cycles.caustics_reflective = cycles.caustics_refractive = False
    cycles.sample_clamp_direct, cycles.sample_clamp_indirect = 0.0, 6.0
    cycles.use_light_tree, cycles.use_auto_tile = True, False
    cycles.use_fast_gi, cycles.fast_gi_method, cycles.ao_bounces_render = True, "REPLACE", 1
    cycles.use_denoising, cycles.denoiser, cycles.denoising_use_gpu = True, "OPENIMAGEDENOISE", False
    cycles.denoising_input_passes, cycles.denoising_prefilter = "RGB_ALBEDO_NORMAL", "FAST"
    cycles.denoising_quality = "HIGH"
    image = render.image_settings
    image.file_format, image.color_mode, image.color_depth, image.exr_codec = "OPEN_EXR", "RGB", "32", "NONE"


def without_seam(light: NDArray[np.float32]) -> NDArray[np.float32]:
    """Make the first and last columns of a panorama meet: the denoiser, which does not know that, shades them apart.

    Their small difference, smoothed along the seam, is shared out over a few columns on both sides.
    """
    reach, beside = max(2, light.shape[1] // 128), max(1, light.shape[1] // 1024)
    left, right = light[:, :beside].mean(axis=1), light[:, -beside:].mean(axis=1)
    step = cv2.blur((left - right)[:, None, :], (1, 2 * reach + 1))[:, 0]
    # Where the scene itself changes at the seam there is nothing to mend.
    most = SEAM_SHARE * np.minimum(left, right)
    step = np.where(np.abs(step) <= most, step, 0.0)
    fading = 0.5 * (1 - (np.arange(reach) + 0.5) / reach)
    change = step[:, None, :] * fading[None, :, None]
    mended = light.copy()
    mended[:, :reach] -= change
    mended[:, : -reach - 1 : -1] += change
    return mended


def normalised(light: NDArray[np.float32]) -> NDArray[np.float32]:
    """Scale light to a mean luminance of `TARGET_LUMINANCE`, from 0 to `BRIGHTEST`.

    Raises:
        RenderError: It holds what is not finite, or is black.
    """
    if not np.isfinite(light).all():
        raise RenderError("a rendered panorama holds infinite or undefined light; this Blender can't be used")
    clipped = np.maximum(light, 0.0)
    # Clipping the lamps takes light away, so the scale is found in a few steps, most often two.
    for _ in range(20):
        mean = mean_luminance(clipped)
        if mean <= 0:
            raise RenderError("a rendered panorama is black all over; this Blender can't be used")
        if abs(mean / TARGET_LUMINANCE - 1) < 1e-3 and clipped.max() <= BRIGHTEST:
            break
        clipped = np.minimum(clipped * np.float32(TARGET_LUMINANCE / mean), np.float32(BRIGHTEST))
    return clipped.astype(np.float32, copy=False)


def write_environment(folder: Path, recipe: EnvironmentRecipe, light: NDArray[np.float32]) -> None:
    """Write a panorama, and its record last: without a record it counts as not rendered.

    Raises:
        AssetError: The folder can't be written.
        RenderError: What was written does not read back.
    """
    directory = environment_directory(folder, recipe.name)
    path = directory / PANORAMA_NAME
    try:
        directory.mkdir(parents=True, exist_ok=True)
        # Beside its place: there must be room anyhow, and no other folder is needed.
        with tempfile.TemporaryDirectory(prefix=".making-", dir=directory) as made:
            written = Path(made) / PANORAMA_NAME
            back = write_float_image(written, light)
            data = read_bounded(written)
    except OSError as error:
        raise AssetError(f"{directory}: can't be written ({error.strerror}); choose another folder") from error
    if back.shape != light.shape or not np.isfinite(back).all():
        raise RenderError(f"{path}: it does not read back as it was written; install OpenImageIO afresh")
    record = EnvironmentRecord(
        name=recipe.name,
        kind=recipe.kind,
        version=recipe.version,
        pixels=light.shape[1],
        sha256=sha256(data),
        mean_luminance=mean_luminance(back),
    )
    text = json.dumps(record.model_dump(mode="json"), indent=2) + "\n"
    try:
        write_atomically(path, data)
        write_atomically(directory / RECORD_NAME, text.encode())
    except OSError as error:
        raise AssetError(f"{directory}: can't be written ({error.strerror}); choose another folder") from error
