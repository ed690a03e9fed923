"""Datasets that earlier releases made: a golden one of each that wrote another form of header or manifest.

Each holds three pictures of 64 px, over the surface in `golden/textures`, made by that release's `farm run --seed 5`. A
release that writes another form adds one of its own.
"""

import json
import shutil
from pathlib import Path

import pytest

from farm import __version__
from farm.cli.installed_assets import InstalledAssets
from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset, find_dataset, open_dataset
from farm.dataset.destination import Destination
from farm.dataset.header_comparison import difference
from farm.dataset.header_file import read_header
from farm.dataset.index import write_index
from farm.dataset.paths import INDEX_FILE, manifest_path
from farm.dataset.release import refuse_to_mix
from farm.dataset.report import write_report
from farm.dataset.verify import verify
from farm.errors import ConflictError
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from farm.spec.make_header import Inputs, make_header
from farm.spec.parse import parse_spec

_GOLDEN = Path(__file__).parent / "golden"
_STYLES = {
    "0.1.0-cloth": "published",
    "0.1.0-rods": "published",
    "0.1.0-budget": "published",
    "0.1.0-faults": "published",
    "0.1.0-wide": "wide",
    "0.1.0-rooms": "wide",
}
"""The golden datasets, named by their release and what was new in it, and the style that each is of."""


@pytest.fixture(params=_STYLES)
def release(request: pytest.FixtureRequest) -> str:
    """One golden dataset's name."""
    return str(request.param)


@pytest.fixture
def made(release: str, tmp_path: Path) -> Dataset:
    """A copy of the golden dataset, under another name."""
    shutil.copytree(_GOLDEN / release, tmp_path / f"{release} (copy)")
    return open_dataset(Destination(str(tmp_path), f"{release} (copy)"))


def _asked_again(release: str, **ranges: object) -> DatasetHeader:
    """The header that this release makes of the same description, with some ranges given in full."""
    keys = {"quotas": {"close_concentrated_light": 1, "far": 2}, "seed": 5, "resolution": 64, "quality": "draft"}
    simulator = "cloth" if release == "0.1.0-cloth" else "rod"
    given = {**keys, "style": _STYLES[release], "ranges": ranges, "simulator": simulator}
    spec = parse_spec(given, source="test")
    inputs = Inputs(textures=(_GOLDEN / "textures",), builtin_textures=False, environments=False)
    return make_header(spec, inputs, InstalledAssets())


def test_every_golden_dataset_is_tested() -> None:
    """A folder that nobody reads proves nothing."""
    assert {path.name for path in _GOLDEN.iterdir()} == {*_STYLES, "textures"}


def test_it_is_clean(made: Dataset) -> None:
    """Every file agrees with its manifest, and no job is missing, under whatever name the folder has."""
    verdict = verify(made)
    assert verdict.findings == ()
    assert verdict.images == 3


def test_it_counts_as_done(made: Dataset) -> None:
    """Nothing is made again."""
    assert len(Completion(made).audit()) == 3


def test_its_index_says_what_it_said(release: str, made: Dataset) -> None:
    """Every key of each line keeps its value."""
    write_index(made)
    before, after = ((folder / INDEX_FILE).read_text() for folder in (_GOLDEN / release, Path(made.storage.location)))
    assert len(before.splitlines()) == len(after.splitlines()) == 3
    for old, new in zip(before.splitlines(), after.splitlines(), strict=True):
        assert json.loads(new).items() >= json.loads(old).items()


def test_its_report_is_written(made: Dataset) -> None:
    """The page shows all pictures."""
    assert write_report(made) == 3


def test_the_same_description_finds_it(release: str, made: Dataset) -> None:
    """What this release resolves otherwise makes no other dataset, as long as the ranges are the same."""
    asked = _asked_again(release, **made.header.spec.ranges.model_dump(mode="json"))
    found = find_dataset(Destination(str(Path(made.storage.location).parent), made.name), asked)
    assert found is not None
    assert found.identity == made.identity


def test_a_style_that_has_changed_is_told_by_release(release: str, made: Dataset) -> None:
    """Where a release draws a style from other ranges, the refusal names the release, the range and the way on."""
    place = Destination(str(Path(made.storage.location).parent), made.name)
    with pytest.raises(ConflictError, match=r"begun by cable-farm 0\.1\.0: spec\.ranges\..*--continue"):
        find_dataset(place, _asked_again(release, wind={"flow_per_strength": 0.3}))


def test_another_seed_is_another_dataset(release: str, made: Dataset) -> None:
    """What the user decides still counts."""
    asked = _asked_again(release, **made.header.spec.ranges.model_dump(mode="json"))
    other = asked.model_copy(update={"spec": asked.spec.model_copy(update={"seed": 6})})
    assert difference(read_header(made.storage), other) == "spec.seed is 5, asked 6"


def test_pictures_of_two_releases_are_not_mixed_unasked(made: Dataset) -> None:
    """A whole dataset is no matter; to add to another takes a word of the user's, which the refusal tells."""
    refuse_to_mix(made)
    made.storage.remove(manifest_path(Job.from_id("far-000001")))
    with pytest.raises(ConflictError, match=rf"cable-farm 0\.1\.0.*{__version__}.*--continue"):
        refuse_to_mix(made)
