"""Samples the kind of each cable: its thickness, sheath and colours, whether it is a bundle, and its ends."""

from dataclasses import dataclass, replace

import numpy as np

from assets.colour import REC709_LUMINANCE
from farm.model import Rgb
from farm.scene.cable import (
    Bundle,
    CableEnd,
    EndKind,
    Look,
    Marking,
    Sheath,
    Skin,
    Stripe,
    StripeKind,
    Tie,
    envelope_ratio,
)
from farm.scene.camera import Camera
from farm.spec.ranges.cable import BundleRanges, CableRanges, EndRanges, SkinRanges
from worker.sample.palette import sample_colours
from worker.sample.values import chance, level, log_uniform, pattern_seed, uniform

TIED = 3.0
"""Bending stiffness of strands that ties press together, as a multiple of that of loose strands."""

_STRAIGHT_PITCH_M = (0.15, 1.5)
"""Range of the length, in metres, over which a straight stripe turns once: no cable lies without twist."""

_TEXTS = (
    "H07V-K 1.5 mm2 450/750V",
    "H05VV-F 3G1.5",
    "LIYY 4 x 0.25 mm2 CE",
    "AWG 18 UL1015 105C 600V VW-1",
    "AWG 22 UL1007 80C 300V",
    "CAT.6A S/FTP 4x2xAWG26/7 LSZH",
    "OLFLEX-TYPE 110 2X0.75 CE",
    "RG58 C/U 50 OHM COAX",
    "E312831 AWM STYLE 20276 80C 30V",
)

_FERRULE_COLOURS: tuple[Rgb, ...] = ((232, 230, 222), (132, 134, 136), (188, 30, 34), (26, 26, 28), (28, 76, 164))
"""Colours of ferrules' collars, sRGB levels: white, grey, red, black and blue for 0.5 to 2.5 mm2 (DIN 46228-4)."""

_TIE_COLOURS: tuple[Rgb, ...] = ((22, 22, 24), (226, 224, 212), (22, 22, 24), (40, 90, 170), (180, 40, 40))
"""Colours of cable ties, sRGB levels: black twice, as it is the commonest, natural white, blue and red."""


@dataclass(frozen=True, slots=True)
class CableKind:
    """The thickness, look, stiffness and weight of a cable.

    Attributes:
        diameter_m: diameter in metres; of a bundle, that of the circle around its strands.
        look: skin or bundle; None for the published material.
        stiffness_ratio: bending stiffness, as a multiple of that of a full round cable of this diameter.
        density_ratio: weight, as a multiple of that of a full round cable of this diameter.
    """

    diameter_m: float
    look: Skin | Bundle | None
    stiffness_ratio: float = 1.0
    density_ratio: float = 1.0


@dataclass(frozen=True, slots=True)
class _Make:
    """Everything that cables of the same make share; only their colours differ."""

    diameter_m: float
    sheath: Sheath
    roughness: float
    striped: bool
    marked: bool


def sample_kinds(ranges: CableRanges, count: int, camera: Camera, rng: np.random.Generator) -> list[CableKind]:
    """Sample the kind of each cable of a picture.

    Args:
        ranges: ranges of the style.
        count: number of cables.
        camera: camera of the picture, whose view limits the cables' thickness.
        rng: random generator of the look.
    """
    seen_m = camera.seen_m
    skinned = chance(rng, ranges.skin.share)
    alike = chance(rng, ranges.skin.alike_share)
    common = _sample_make(ranges, seen_m, rng)
    kinds: list[CableKind] = []
    for _ in range(count):
        make = common if alike else _sample_make(ranges, seen_m, rng)
        if not skinned:
            kinds.append(CableKind(make.diameter_m, None))
        elif chance(rng, ranges.bundle.share):
            kinds.append(_sample_bundle(ranges, make, seen_m, rng))
        else:
            kinds.append(CableKind(make.diameter_m, _sample_skin(ranges.skin, make, rng)))
    return kinds


def sample_ends(
    ranges: EndRanges, look: Look, diameter_m: float, rng: np.random.Generator
) -> tuple[CableEnd, CableEnd]:
    """Sample the two ends of a cable; those of a bundle and of a cable with the published surface are cut.

    Args:
        ranges: ranges of the style.
        look: look of the cable.
        diameter_m: diameter of the cable, in metres.
        rng: random generator of the look.
    """
    ends = (_sample_end(ranges, diameter_m, rng), _sample_end(ranges, diameter_m, rng))
    return ends if isinstance(look, Skin) else (CableEnd(), CableEnd())


def _sample_end(ranges: EndRanges, diameter_m: float, rng: np.random.Generator) -> CableEnd:
    drawn = rng.random()
    bare = max(uniform(rng, ranges.bare_m), 2.0 * diameter_m)
    collar = _FERRULE_COLOURS[int(rng.integers(len(_FERRULE_COLOURS)))]
    if drawn < ranges.stripped_share:
        return CableEnd(kind=EndKind.STRIPPED, bare_m=bare)
    if drawn < ranges.stripped_share + ranges.ferrule_share:
        return CableEnd(kind=EndKind.FERRULE, bare_m=bare, collar=collar)
    return CableEnd()


def _sample_make(ranges: CableRanges, seen_m: float, rng: np.random.Generator) -> _Make:
    skin = ranges.skin
    drawn = rng.random()
    sheath = Sheath.PLAIN
    if drawn < skin.translucent_share:
        sheath = Sheath.TRANSLUCENT
    elif drawn < skin.translucent_share + skin.braided_share:
        sheath = Sheath.BRAIDED
    return _Make(
        diameter_m=log_uniform(rng, ranges.diameters_m(seen_m)),
        sheath=sheath,
        roughness=uniform(rng, skin.roughness),
        striped=chance(rng, skin.stripe_share),
        marked=chance(rng, skin.marking_share),
    )


def _sample_skin(ranges: SkinRanges, make: _Make, rng: np.random.Generator) -> Skin:
    colour, second = sample_colours(ranges.palette, rng)
    stripe = _sample_stripe(ranges, make, second, rng)
    marking = _sample_marking(make, colour, rng)
    dirty = not chance(rng, ranges.clean_share)
    dirt, wear = uniform(rng, ranges.dirt), uniform(rng, ranges.wear)
    plain = make.sheath is Sheath.PLAIN
    return Skin(
        sheath=make.sheath,
        colour=colour,
        roughness=make.roughness,
        stripe=stripe if make.striped and make.sheath is not Sheath.TRANSLUCENT else None,
        marking=marking if make.marked and plain else None,
        dirt=dirt if dirty else 0.0,
        wear=wear,
        pattern_seed=pattern_seed(rng),
    )


def _sample_stripe(ranges: SkinRanges, make: _Make, colour: Rgb, rng: np.random.Generator) -> Stripe:
    spiral = chance(rng, ranges.spiral_share)
    pitch = uniform(rng, ranges.spiral_pitch_diameters) * make.diameter_m
    twist = log_uniform(rng, _STRAIGHT_PITCH_M)
    return Stripe(
        kind=StripeKind.SPIRAL if spiral else StripeKind.STRAIGHT,
        colour=colour,
        share=uniform(rng, ranges.stripe_width),
        count=level(rng, ranges.stripe_count),
        pitch_m=pitch if spiral else twist,
    )


def _sample_marking(make: _Make, sheath: Rgb, rng: np.random.Generator) -> Marking:
    text = _TEXTS[int(rng.integers(len(_TEXTS)))]
    height = float(rng.uniform(0.35, 0.6))
    dark = float(np.dot(sheath, REC709_LUMINANCE)) < 110
    letters: Rgb = (225, 225, 215) if dark else (25, 25, 30)
    # A letter is about 0.6 of its height wide; a gap follows each text.
    words_m = 0.6 * height * make.diameter_m * len(text)
    return Marking(text=text, colour=letters, height_share=height, repeat_m=words_m + float(rng.uniform(0.01, 0.06)))


def _sample_bundle(ranges: CableRanges, make: _Make, seen_m: float, rng: np.random.Generator) -> CableKind:
    bundle: BundleRanges = ranges.bundle
    strands = level(rng, bundle.strands)
    ratio = envelope_ratio(strands)
    # A bundle may be up to 1.5 times as wide as a single cable.
    strand = max(log_uniform(rng, bundle.strand_diameter_m), ranges.narrowest_share * seen_m)
    strand = min(strand, 1.5 * ranges.widest_share * seen_m / ratio)
    diameter = ratio * strand
    lay = uniform(rng, bundle.lay_diameters) * diameter * (1.0 if chance(rng, 0.5) else -1.0)
    ties = _sample_ties(bundle, rng)
    make = replace(make, diameter_m=strand, marked=False)
    look = Bundle(
        strands=tuple(_sample_skin(ranges.skin, make, rng) for _ in range(strands)),
        strand_diameter_m=strand,
        lay_m=lay,
        phase_deg=float(rng.uniform(0.0, 360.0)),
        ties=ties,
    )
    # The stiffness and weight of strands that slide on each other add up; both are relative to a full round section.
    return CableKind(
        diameter_m=diameter,
        look=look,
        stiffness_ratio=TIED * strands / ratio**4,
        density_ratio=strands / ratio**2,
    )


def _sample_ties(ranges: BundleRanges, rng: np.random.Generator) -> tuple[Tie, ...]:
    count = level(rng, ranges.ties)
    colour = _TIE_COLOURS[int(rng.integers(len(_TIE_COLOURS)))]
    width = uniform(rng, ranges.tie_width_m)
    # Ties are spread over the middle half of the bundle, where the picture shows them.
    places = 0.25 + 0.5 * (np.arange(count) + rng.uniform(0.15, 0.85, count)) / max(count, 1)
    return tuple(Tie(along=float(place), width_m=width, colour=colour) for place in places)
