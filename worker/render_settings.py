"""How a quality is rendered: Cycles samples a pixel (spp) and denoising, by the kind of light."""

from dataclasses import dataclass

from farm.category import Light
from farm.spec import Quality


@dataclass(frozen=True, slots=True)
class CyclesSettings:
    """Settings of one render.

    Attributes:
        samples: paths a pixel.
        denoise: whether Open Image Denoise cleans the picture.
        max_bounces: of a path.
    """

    samples: int
    denoise: bool
    max_bounces: int


_SETTINGS = {
    (Quality.DRAFT, Light.CONCENTRATED): CyclesSettings(samples=4, denoise=True, max_bounces=2),
    (Quality.DRAFT, Light.DISTRIBUTED): CyclesSettings(samples=8, denoise=True, max_bounces=2),
    (Quality.STANDARD, Light.CONCENTRATED): CyclesSettings(samples=8, denoise=True, max_bounces=3),
    (Quality.STANDARD, Light.DISTRIBUTED): CyclesSettings(samples=12, denoise=True, max_bounces=3),
    (Quality.REFERENCE, Light.CONCENTRATED): CyclesSettings(samples=1024, denoise=False, max_bounces=12),
    (Quality.REFERENCE, Light.DISTRIBUTED): CyclesSettings(samples=1024, denoise=False, max_bounces=12),
}


def cycles_settings(quality: Quality, light: Light) -> CyclesSettings:
    """The settings of a quality under a kind of light."""
    return _SETTINGS[quality, light]
