"""The dataset that a benchmark renders: so many images of every category, from the built-in assets."""

from farm.asset_source import InstalledAssets
from farm.catalogue import Inputs, make_header
from farm.category import Category
from farm.header import DatasetHeader
from farm.job import Job
from farm.spec import parse_spec


def bench_header(images: int, seed: int, **keys: object) -> DatasetHeader:
    """A header that asks for `images` of each category, as published unless `keys`, others of the spec, say otherwise.

    Raises:
        SpecError: if a key is wrong.
        AssetError: if the built-in assets are not complete.
    """
    quotas = {str(category): images for category in Category}
    spec = parse_spec({"seed": seed, "quotas": quotas, "style": "published", **keys}, source="benchmark")
    return make_header(spec, Inputs(), InstalledAssets())


def bench_jobs(images: int) -> list[Job]:
    """The jobs, the categories taking turns, so that a drift of the machine's speed touches all alike."""
    return [Job(category=category, index=index) for index in range(images) for category in Category]
