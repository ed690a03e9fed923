"""The variants that the rendering benchmark tries: ladders of samples, and a base with one other setting changed."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

from farm.spec.rendering import (
    CableDetail,
    CyclesSettings,
    Denoiser,
    Economy,
    Guides,
    Pattern,
    PictureSettings,
    Prefilter,
)

LADDER = (2, 4, 6, 8, 12, 16)
"""Samples per pixel to try with the denoiser."""

PLAIN_LADDER = (16, 32)
"""Samples without a denoiser."""

BASE = PictureSettings(
    cycles=CyclesSettings(samples=8, caustics=True, pattern=Pattern.BLUE_NOISE, prefilter=Prefilter.FAST)
)
"""The settings from which one at a time is turned."""


class Group(StrEnum):
    """The subject of a variant."""

    SAMPLES = "denoised with albedo and normals"
    UNGUIDED = "denoised unguided"
    PLAIN = "not denoised"
    ADAPTIVE = "adaptive"
    DENOISER = "denoiser"
    PATHS = "paths"
    LIGHTS = "lights"
    PATTERN = "pattern"
    DETAIL = "detail"
    ECONOMY = "left out"


@dataclass(frozen=True, slots=True)
class Variant:
    """Settings with a name.

    Attributes:
        name: name of the variant.
        group: subject of the variant.
        settings: settings of the picture.
        same_picture: whether the picture must be the base's to the byte.
    """

    name: str
    group: Group
    settings: PictureSettings
    same_picture: bool = False


def ladder() -> Iterator[Variant]:
    """The variants that a quality chooses from: samples with two kinds of denoising, without it, and adaptive."""
    for samples in LADDER:
        yield Variant(f"{samples} spp, OIDN", Group.SAMPLES, _cycles(samples=samples))
        yield Variant(f"{samples} spp, OIDN unguided", Group.UNGUIDED, _cycles(samples=samples, guides=Guides.NONE))
    for samples in PLAIN_LADDER:
        yield Variant(f"{samples} spp", Group.PLAIN, _cycles(samples=samples, denoiser=Denoiser.NONE))
    yield Variant("32 spp, adaptive 0.05, OIDN", Group.ADAPTIVE, _cycles(samples=32, adaptive_threshold=0.05))


def turns() -> Iterator[Variant]:
    """The base, and the base with one setting changed at a time."""
    yield Variant("base", Group.SAMPLES, BASE, same_picture=True)
    for denoiser in (Denoiser.NONE, Denoiser.BALANCED, Denoiser.HIGH):
        yield Variant(f"OIDN {denoiser}", Group.DENOISER, _cycles(denoiser=denoiser))
    for guides in (Guides.NONE, Guides.ALBEDO):
        yield Variant(f"guides {guides}", Group.DENOISER, _cycles(guides=guides))
    for prefilter in (Prefilter.NONE, Prefilter.ACCURATE):
        yield Variant(f"prefilter {prefilter}", Group.DENOISER, _cycles(prefilter=prefilter))
    slowest = {"denoiser": Denoiser.HIGH, "prefilter": Prefilter.ACCURATE}
    yield Variant("OIDN high, prefilter accurate", Group.DENOISER, _cycles(**slowest))
    for bounces in (0, 1, 2, 12):
        limits = {"bounces": bounces, "diffuse_bounces": min(bounces, 4), "glossy_bounces": min(bounces, 4)}
        yield Variant(f"{bounces} bounces", Group.PATHS, _cycles(**limits))
    yield Variant("no caustics", Group.PATHS, _cycles(caustics=False))
    for clamp in (0.0, 1.0):
        yield Variant(f"clamp {clamp:g}", Group.PATHS, _cycles(clamp_indirect=clamp))
    yield Variant("light tree", Group.LIGHTS, _cycles(light_tree=True))
    for width in (0, 256, 1024):
        yield Variant(f"world map {width or 'automatic'}", Group.LIGHTS, _cycles(world_map_px=width))
    yield Variant("Sobol", Group.PATTERN, _cycles(pattern=Pattern.SOBOL))
    yield Variant("adaptive 0.02", Group.ADAPTIVE, _cycles(adaptive_threshold=0.02))
    for sides, points in ((6, 1), (12, 3), (40, 10)):
        detail = CableDetail(sides=sides, points_per_segment=points)
        yield Variant(f"{sides} sides, {points} rings", Group.DETAIL, _picture(detail=detail))
    for field in Economy.model_fields:
        value = not getattr(BASE.economy, field)
        name = f"{'with' if value else 'without'} {field.replace('_', ' ')}"
        same = field in _CHANGE_NO_PICTURE
        yield Variant(name, Group.ECONOMY, _picture(economy=BASE.economy.model_copy(update={field: value})), same)


_CHANGE_NO_PICTURE = frozenset({"keep_loaded", "persistent_data"})
"""Economies that must not change a picture."""


def _cycles(**settings: object) -> PictureSettings:
    return _picture(cycles=CyclesSettings.model_validate({**BASE.cycles.model_dump(), **settings}))


def _picture(**parts: object) -> PictureSettings:
    return PictureSettings.model_validate({**dict(BASE), **parts})
