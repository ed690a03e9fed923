"""Styles: named sets of ranges. A description names one and overrides what it wants to have otherwise."""

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType

from farm.spec.ranges.all import Ranges
from farm.spec.ranges.backdrop import WorldRanges
from farm.spec.ranges.cable import BundleRanges, CableRanges, EndRanges, PaletteRanges, SkinRanges
from farm.spec.ranges.camera import CameraRanges, DevelopmentRanges
from farm.spec.ranges.clutter import ClutterRanges
from farm.spec.ranges.floor import FloorRanges, WearRanges
from farm.spec.ranges.light import StudioRanges
from farm.spec.ranges.placement import PlacementRanges
from farm.spec.ranges.tangle import TangleRanges
from farm.spec.simulation import Simulator


class Style(StrEnum):
    """The style of pictures: like the published ones, or as varied as photographs."""

    PUBLISHED = "published"
    WIDE = "wide"


WIDE = Ranges(
    floor=FloorRanges(light_share=0.3, scale=(0.7, 1.5), wear=WearRanges(share=0.8)),
    placement=PlacementRanges(
        free_x_m=(-0.035, 0.035),
        free_y_m=(-0.035, 0.035),
        free_rotation_deg=(0.0, 360.0),
        aligned_x_m=(-0.016, 0.016),
        aligned_y_m=(-0.018, 0.018),
        bend_per_m=(-10.0, 10.0),
        loop_share=0.08,
        coil_share=0.06,
        # Aligned pictures, half of all, have knots alone, and some pictures too few cables: about 11 % are tangled.
        tangle=TangleRanges(
            heap_share=0.06, knot_share=0.05, threaded_share=0.04, crossed_bundles_share=0.04, peg_share=0.04
        ),
    ),
    cable=CableRanges(
        # A stub, a small ring or a corner that a cable cuts off shows less; one cable of 6 px across the picture, more.
        least_visible_share=0.01,
        count_draws=1,
        diameter_m=(0.001, 0.012),
        narrowest_share=4 / 512,
        widest_share=40 / 512,
        length_m=(0.10, 0.55),
        far_length_m=(0.55, 0.80),
        skin=SkinRanges(
            share=0.85,
            alike_share=0.35,
            palette=PaletteRanges(uniform_rgb=0.25, neutral=0.3, din_47100=0.25, iec_60757=0.2),
            stripe_share=0.3,
            translucent_share=0.06,
            braided_share=0.08,
            marking_share=0.15,
            clean_share=0.5,
        ),
        bundle=BundleRanges(share=0.12),
        ends=EndRanges(stripped_share=0.2, ferrule_share=0.15),
    ),
    clutter=ClutterRanges(share=0.6),
    studio=StudioRanges(share=0.85),
    world=WorldRanges(one_over_floors=False),
    camera=CameraRanges(
        heights_m=(0.09, 0.12, 0.15, 0.18, 0.22, 0.27, 0.33, 0.40, 0.50),
        f_number=(4.0, 32.0),
        focal_lengths_mm=(35.0, 50.0, 70.0, 100.0),
        tilt_deg=(0.0, 15.0),
        roll_deg=(-12.0, 12.0),
        focus_offset_share=(-0.01, 0.03),
        distortion=(-0.06, 0.03),
    ),
    development=DevelopmentRanges(share=1.0, contrast=(0.75, 2.05)),
)
"""Ranges of the wide style: thick and thin cables, two colours, bundles, gloss, ends, clutter, a real camera."""

RANGES_OF: Mapping[Style, Ranges] = MappingProxyType({Style.PUBLISHED: Ranges(), Style.WIDE: WIDE})
"""Every range of each style."""


_UNTANGLED = {f"{kind}_share": 0.0 for kind in ("heap", "knot", "threaded", "crossed_bundles", "peg")}
"""Shares of a style without tangles."""


def merge_ranges(
    style: Style, overrides: Mapping[str, object], simulator: Simulator = Simulator.ROD
) -> dict[str, object]:
    """Override some ranges of a style; return all as plain values, of which none is validated yet.

    Args:
        style: style whose ranges hold where none is given.
        overrides: tables of ranges, nested as in `Ranges`.
        simulator: simulator of the fall. Cloth holds no tangle, so with it a style has none.
    """
    base: Mapping[str, object] = RANGES_OF[style].model_dump(mode="json")
    if simulator is Simulator.CLOTH:
        base = merge_tables(base, {"placement": {"tangle": _UNTANGLED}})
    return merge_tables(base, overrides)


def merge_tables(base: Mapping[str, object], overrides: Mapping[str, object]) -> dict[str, object]:
    """Lay tables over tables: where both have one under a key they are merged, else the override holds."""
    merged = dict(base)
    for key, value in overrides.items():
        present = merged.get(key)
        both = isinstance(present, Mapping) and isinstance(value, Mapping)
        merged[key] = merge_tables(present, value) if both else value  # type: ignore[arg-type]  # both are mappings here
    return merged
