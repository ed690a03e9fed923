"""The groups of examples; each example is a dataset of its own in which one thing is fixed and the rest is drawn."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from farm.cli.installed_assets import InstalledAssets
from farm.spec.category import Category
from farm.spec.header import DatasetHeader
from farm.spec.make_header import Inputs, make_header
from farm.spec.parse import parse_spec
from farm.spec.styles import Style

_CLOSE = {"camera": {"heights_m": [0.12, 0.15, 0.2]}}
"""Camera heights, metres, close enough to show a cable's surface."""

_NO_CLUTTER = {"clutter": {"share": 0.0}}
"""Ranges without clutter, so that nothing hides the example."""

_WELL_EXPOSED = {"development": {"exposure_ev": [0.0, 0.0]}}
"""Ranges without any error of exposure, stops."""

_ONE_CABLE = {"count": [1, 3], "diameter_m": [0.002, 0.006]}
"""Number of cables and their diameters, metres, unless a kind of cable says otherwise: few and clearly visible."""

_PLAIN_SKIN: Mapping[str, float] = {
    "share": 1.0,
    "stripe_share": 0.0,
    "translucent_share": 0.0,
    "braided_share": 0.0,
    "marking_share": 0.0,
    "clean_share": 1.0,
}
"""Shares of a cable's surface without stripes, braid, print or dirt, over which each kind lays its own."""

_ENDS_IN_VIEW = {"length_m": [0.07, 0.11]}
"""Lengths, metres, short enough that a cable's ends are in view."""


def _cable(
    skin: Mapping[str, object], cable: Mapping[str, object] | None = None, placement: Mapping[str, object] | None = None
) -> Mapping[str, object]:
    bundle = {"share": 0.0}
    ends = {"stripped_share": 0.0, "ferrule_share": 0.0}
    return {
        "cable": {**_ONE_CABLE, "bundle": bundle, "ends": ends, **(cable or {}), "skin": {**_PLAIN_SKIN, **skin}},
        "placement": {"loop_share": 0.0, "coil_share": 0.0, **(placement or {})},
        **_CLOSE,
        **_NO_CLUTTER,
    }


CABLE_KINDS: Mapping[str, Mapping[str, object]] = {
    "published surface": _cable({"share": 0.0}),
    "matt": _cable({"roughness": [0.6, 0.75]}),
    "gloss": _cable({"roughness": [0.15, 0.22]}),
    "black, white, grey": _cable({"palette": {"uniform_rgb": 0.0, "neutral": 1.0, "din_47100": 0.0, "iec_60757": 0.0}}),
    "DIN 47100": _cable(
        {"palette": {"uniform_rgb": 0.0, "neutral": 0.0, "din_47100": 1.0, "iec_60757": 0.0}, "stripe_share": 0.6}
    ),
    "IEC 60757": _cable({"palette": {"uniform_rgb": 0.0, "neutral": 0.0, "din_47100": 0.0, "iec_60757": 1.0}}),
    "straight stripe": _cable({"stripe_share": 1.0, "spiral_share": 0.0}),
    "spiral stripe": _cable({"stripe_share": 1.0, "spiral_share": 1.0}),
    "translucent": _cable({"translucent_share": 1.0}),
    "braided": _cable({"braided_share": 1.0}),
    "printed": _cable({"marking_share": 1.0}, {"diameter_m": [0.004, 0.008]}),
    "dirty": _cable({"clean_share": 0.0, "dirt": [0.15, 0.25]}),
    "mixed thickness": _cable({"alike_share": 0.0}, {"count": [4, 7], "diameter_m": [0.001, 0.012]}),
    "thick": _cable({}, {"diameter_m": [0.008, 0.012]}),
    "bundle": _cable({"palette": {"uniform_rgb": 0.2, "din_47100": 1.0}}, {"count": [1, 2], "bundle": {"share": 1.0}}),
    "stripped end": _cable({}, {**_ENDS_IN_VIEW, "ends": {"stripped_share": 1.0, "ferrule_share": 0.0}}),
    "ferrule": _cable({}, {**_ENDS_IN_VIEW, "ends": {"stripped_share": 0.0, "ferrule_share": 1.0}}),
    "loop": _cable({}, {"count": [1, 2]}, {"loop_share": 1.0}),
    "coil": _cable({}, {"count": [1, 2], "length_m": [0.4, 0.55]}, {"coil_share": 1.0}),
}
"""Ranges of the description that show one kind of cable, by the kind's label."""


@dataclass(frozen=True, slots=True)
class Example:
    """A thing to show, and the pictures that show it.

    Attributes:
        label: name printed beneath the pictures.
        header: header of a dataset in which every scene has the thing.
        category: category of the pictures.
    """

    label: str
    header: DatasetHeader
    category: Category


def surfaces(seed: int) -> Iterator[Example]:
    """Every built-in floor surface, alternately under lamps and under HDRIs."""
    categories = (Category.CLOSE_CONCENTRATED, Category.CLOSE_DISTRIBUTED)
    for number, surface in enumerate(_header(seed, {}).surfaces):
        header = _header(seed + number, {**_NO_CLUTTER, **_WELL_EXPOSED})
        yield Example(surface.name, header.model_copy(update={"surfaces": (surface,)}), categories[number % 2])


def environments(seed: int) -> Iterator[Example]:
    """Every HDRI that may be the backdrop of a picture."""
    for number, hdri in enumerate(_header(seed, {}).hdris):
        if hdri.backdrop:
            header = _header(seed + number, _WELL_EXPOSED)
            yield Example(hdri.name, header.model_copy(update={"hdris": (hdri,)}), Category.FAR)


def cables(seed: int) -> Iterator[Example]:
    """Every kind of cable."""
    for number, (label, ranges) in enumerate(CABLE_KINDS.items()):
        yield Example(label, _header(seed + number, {**ranges, **_WELL_EXPOSED}), Category.CLOSE_CONCENTRATED)


GROUPS = {"surfaces": surfaces, "environments": environments, "cables": cables}
"""Functions that make the examples of each group from a seed; each example has scenes of its own, well exposed."""


def _header(seed: int, ranges: Mapping[str, object]) -> DatasetHeader:
    quotas = {str(category): 1000 for category in Category}
    data = {"seed": seed, "style": Style.WIDE.value, "quotas": quotas, "ranges": ranges}
    return make_header(parse_spec(data, source="examples"), Inputs(), InstalledAssets())
