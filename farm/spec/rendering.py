"""The render settings of a picture, which decide its noise and its cost."""

from enum import StrEnum
from typing import Annotated

from pydantic import Field

from farm.model import Model

Bounces = Annotated[int, Field(ge=0, le=64)]


class Denoiser(StrEnum):
    """Quality of Open Image Denoise, or none."""

    NONE = "none"
    FAST = "fast"
    BALANCED = "balanced"
    HIGH = "high"


class Guides(StrEnum):
    """Further images that the denoiser gets beside the noisy picture."""

    NONE = "none"
    ALBEDO = "albedo"
    ALBEDO_NORMAL = "albedo_normal"


class Prefilter(StrEnum):
    """The denoising of the guides before the denoiser uses them."""

    NONE = "none"
    FAST = "fast"
    ACCURATE = "accurate"


class Pattern(StrEnum):
    """Cycles' sampling pattern: where in a pixel, and where on lights, it takes its samples."""

    SOBOL = "tabulated_sobol"
    BLUE_NOISE = "blue_noise"


class CyclesSettings(Model):
    """Settings of Cycles; https://docs.blender.org/manual/en/4.5/render/cycles/ explains each.

    Attributes:
        samples: maximum number of samples per pixel.
        adaptive_threshold: noise level at which a pixel stops taking samples; 0 switches adaptive sampling off.
        bounces: maximum number of bounces of a light path.
        diffuse_bounces: maximum number of diffuse bounces among them.
        glossy_bounces: maximum number of glossy bounces among them.
        caustics: whether light may reach a rough surface by way of a glossy one.
        clamp_indirect: brightest value that a sample of indirect light may have; 0 sets no limit.
        denoiser: quality of Open Image Denoise after the last sample.
        guides: further images that the denoiser gets.
        prefilter: denoising of those images.
        light_tree: whether lights are sampled by their contribution at each place, which pays off with many lights.
        pattern: pattern of the samples.
        world_map_px: width, in pixels, of the map by which Cycles samples the world's bright parts; 0 lets Cycles
            choose, which takes 0.7 s for a fine map.
    """

    samples: Annotated[int, Field(ge=1, le=2**20)]
    adaptive_threshold: Annotated[float, Field(ge=0, le=1)] = 0.0
    bounces: Bounces = 3
    diffuse_bounces: Bounces = 3
    glossy_bounces: Bounces = 3
    caustics: bool = False
    clamp_indirect: Annotated[float, Field(ge=0)] = 10.0
    denoiser: Denoiser = Denoiser.FAST
    guides: Guides = Guides.ALBEDO_NORMAL
    prefilter: Prefilter = Prefilter.NONE
    light_tree: bool = False
    pattern: Pattern = Pattern.SOBOL
    world_map_px: Annotated[int, Field(ge=0, le=16384)] = 512


class CableDetail(Model):
    """Fineness of the tube that models a cable; the mask shows the same tube.

    Attributes:
        sides: number of corners of the tube's cross-section.
        points_per_segment: number of rings of the tube for each segment of the fall's rod.
    """

    sides: Annotated[int, Field(ge=4, le=128, multiple_of=2)] = 20
    points_per_segment: Annotated[int, Field(ge=1, le=20)] = 5


class Economy(Model):
    """Savings that no picture shows. Benchmarks switch them off one by one to measure what each saves.

    Attributes:
        cables_in_view: whether cables end a little outside the view.
        texture_window: whether only the part of the floor's texture that the camera sees is loaded, no finer than it
            sees it.
        upper_world: whether an HDRI over a floor lights at low resolution, and is black where the floor hides it.
        backdrop: whether the visible part of an HDRI is looked up in its image, in place of being path-traced.
        keep_loaded: whether decoded textures stay in memory from picture to picture.
        persistent_data: whether Cycles keeps its data from picture to picture where nothing has changed.
    """

    cables_in_view: bool = True
    texture_window: bool = True
    upper_world: bool = True
    backdrop: bool = True
    keep_loaded: bool = True
    persistent_data: bool = False


class PictureSettings(Model):
    """All settings that decide the noise and cost of a picture by Cycles.

    Attributes:
        cycles: settings of Cycles.
        detail: detail of the cables' tubes.
        economy: savings that no picture shows.
    """

    cycles: CyclesSettings
    detail: CableDetail = CableDetail()
    economy: Economy = Economy()
