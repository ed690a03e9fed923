"""The dataset that a benchmark renders: the same number of images of every category, from the built-in assets."""

from collections.abc import Mapping

from farm.cli.installed_assets import InstalledAssets
from farm.spec.category import Category
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from farm.spec.make_header import Inputs, make_header
from farm.spec.parse import parse_spec
from farm.spec.styles import merge_tables

_RANGES: Mapping[str, object] = {"cable": {"count_draws": 1, "diameter_m": [0.002, 0.002]}}

PUBLISHED: Mapping[str, object] = {"style": "published", "close_distributed_hdri": "city", "ranges": _RANGES}
"""The scenes on which quality is calibrated and times are compared: those of the published style, but for as many
cables as an even draw gives, of 2 mm. Changing them would make all that was measured on them void."""


def bench_header(images: int, seed: int, **keys: object) -> DatasetHeader:
    """A header that asks for `images` of each category, as published unless `keys`, others of the spec, say otherwise.

    Ranges among them are laid over those of the benchmarks.

    Raises:
        SpecError: if a key is wrong.
        AssetError: if the built-in assets are not complete.
    """
    quotas = {str(category): images for category in Category}
    own = {key: value for key, value in keys.items() if key != "ranges"}
    ranges = merge_tables({"ranges": _RANGES}, {"ranges": keys.get("ranges", {})})
    spec = parse_spec({**PUBLISHED, "seed": seed, "quotas": quotas, **own, **ranges}, source="benchmark")
    return make_header(spec, Inputs(environments=False), InstalledAssets())


def bench_jobs(images: int) -> list[Job]:
    """The jobs, the categories taking turns, so that a drift of the machine's speed touches all alike."""
    return [Job(category=category, index=index) for index in range(images) for category in Category]
