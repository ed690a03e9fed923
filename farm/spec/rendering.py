"""How a picture is rendered: the settings that decide its noise and its cost."""

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
    """What the denoiser sees beside the noisy picture."""

    NONE = "none"
    ALBEDO = "albedo"
    ALBEDO_NORMAL = "albedo_normal"


class Prefilter(StrEnum):
    """How the denoiser's guides are denoised themselves."""

    NONE = "none"
    FAST = "fast"
    ACCURATE = "accurate"


class Pattern(StrEnum):
    """Where in a pixel, and where on lights, Cycles takes its samples."""

    SOBOL = "tabulated_sobol"
    BLUE_NOISE = "blue_noise"


class CyclesSettings(Model):
    """What Cycles does; see https://docs.blender.org/manual/en/4.5/render/cycles/ for more of each.

    Attributes:
        samples: paths a pixel (spp).
        adaptive_threshold: noise at which a pixel takes no more samples; 0 lets all take them.
        bounces: of a path, of any kind.
        diffuse_bounces: of them.
        glossy_bounces: of them.
        caustics: whether light may reach a rough surface by way of a glossy one.
        clamp_indirect: brightest sample that a bounced path may bring; 0 is no limit.
        denoiser: Open Image Denoise, after the last sample.
        guides: its inputs.
        prefilter: of them.
        light_tree: lights are sampled by their share at each place, at some cost; of use where there are many.
        pattern: of the samples.
        world_map_px: width of the map by which the world's bright parts are found; 0 leaves it to Cycles, which takes
            0.7 s for a fine one.
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
    """How finely a cable is modelled; its mask is that of the very same tube.

    Attributes:
        sides: corners of a tube's cross-section.
        points_per_segment: rings of a tube for each segment of the fall.
    """

    sides: Annotated[int, Field(ge=4, le=128, multiple_of=2)] = 20
    points_per_segment: Annotated[int, Field(ge=1, le=20)] = 5


class Economy(Model):
    """What is left out because the picture does not show it. All on, but to measure what each saves.

    Attributes:
        cables_in_view: cables end a little outside the view.
        texture_window: of a floor's texture only what the camera sees is loaded, no finer than it sees it.
        upper_world: an HDRI lights at low resolution, and is black where the floor hides it.
        backdrop: what is seen of an HDRI is looked up in it, not sampled by paths.
        keep_loaded: decoded textures stay in memory from picture to picture.
        persistent_data: Cycles keeps what has not changed from picture to picture.
    """

    cables_in_view: bool = True
    texture_window: bool = True
    upper_world: bool = True
    backdrop: bool = True
    keep_loaded: bool = True
    persistent_data: bool = False


class PictureSettings(Model):
    """Everything that decides a Cycles picture's noise and cost."""

    cycles: CyclesSettings
    detail: CableDetail = CableDetail()
    economy: Economy = Economy()
