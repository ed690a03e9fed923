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
"""Ranges of the benchmarks' scenes: an even draw of the number of cables, and a diameter of 2 mm."""

PUBLISHED: Mapping[str, object] = {"style": "published", "close_distributed_hdri": "city", "ranges": _RANGES}
"""Description of the scenes on which quality is calibrated and times are compared: the published style, but with the
benchmarks' own ranges of cables. A change to it makes every earlier measurement void."""


def bench_header(images: int, seed: int, **keys: object) -> DatasetHeader:
    """Make a header that asks for the same number of images of each category.

    Args:
        images: number of images of each category.
        seed: seed of the dataset.
        keys: keys of the description that replace those of `PUBLISHED`; `ranges` are merged with the benchmarks' own.

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
    """The jobs; categories take turns, so that a drift in the machine's speed affects all of them equally."""
    return [Job(category=category, index=index) for index in range(images) for category in Category]
