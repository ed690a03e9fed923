"""Surveys of whole datasets, their files, and the options."""

import argparse
import json
import math
from argparse import ArgumentTypeError
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from benchmarks.pictures.command import run
from benchmarks.pictures.making import STYLES, NamedDataset, make, parse_named
from benchmarks.pictures.options import add_pictures, styles_of
from benchmarks.pictures.survey import distribution, groups, summarize, survey
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.dataset.outputs import IMAGE
from farm.dataset.paths import file_path
from farm.errors import DatasetMissingError, FarmError, SpecError, VerificationError
from farm.spec.category import Category
from farm.spec.job import Job
from tests.stand_in import StandInRenderer, stand_in_header
from worker.service.upload import upload


@pytest.fixture
def made(tmp_path: Path) -> Dataset:
    """A dataset of two categories with two pictures each: noise, with one cable of 4 px across 32."""
    dataset = create_dataset(Destination(str(tmp_path / "store"), "noise"), stand_in_header())
    for job in dataset.header.spec.jobs():
        upload(StandInRenderer().make(job, dataset.header), job, dataset)
    return dataset


def test_a_survey_measures_every_picture_that_is_done(made: Dataset) -> None:
    """Pictures come in the order of the categories, with the seconds of their stages."""
    found = list(survey(made))
    names = ["close_concentrated_light-000000", "close_concentrated_light-000001", "far-000000", "far-000001"]
    assert [picture.job_id for picture in found] == names
    for picture in found:
        assert picture.figures.coverage == pytest.approx(4 / 32)
        assert picture.figures.width_px == pytest.approx(4, abs=0.5)
        assert picture.seconds >= 0.01


def test_groups_are_all_and_each_category(made: Dataset) -> None:
    """A category without pictures has no group."""
    by_group = groups(list(survey(made)))
    assert {group: len(pictures) for group, pictures in by_group.items()} == {
        None: 4,
        Category.CLOSE_CONCENTRATED: 2,
        Category.FAR: 2,
    }
    assert summarize(by_group[None]).figures["coverage"].mean == pytest.approx(4 / 32)


def test_a_distribution_by_hand() -> None:
    """The values 0 to 100 have known percentiles."""
    found = distribution([float(value) for value in range(101)])
    assert (found.pictures, found.mean, found.p5, found.p50, found.p95) == (101, 50, 5, 50, 95)
    assert found.deviation == pytest.approx(np.std(np.arange(101), ddof=1))
    assert math.isnan(distribution([1.0]).deviation)
    assert math.isnan(distribution([]).mean)


def test_a_picture_that_is_no_image_is_told(made: Dataset) -> None:
    """A file of the right size that can't be decoded is reported by its name."""
    pictures = survey(made)
    next(pictures)
    # Sizes are compared before the first picture is read.
    path = file_path(Job.from_id("far-000001"), IMAGE)
    made.storage.write(path, b"x" * len(made.storage.read(path)))
    with pytest.raises(VerificationError, match="far-000001"):
        list(pictures)


def test_everything_is_written_of_a_dataset_that_is_there(made: Dataset, tmp_path: Path) -> None:
    """Under a name of the user's own nothing is promised, so nothing is missed."""
    named = NamedDataset("mine", made.storage.location)
    assert run(tmp_path, seed=0, images=1, scenes=0, styles=(), datasets=[named]) == 0
    content = json.loads((tmp_path / "pictures.json").read_text())
    assert content["promises"] == []
    assert content["datasets"]["mine"]["groups"]["all"]["pictures"] == 4
    assert [entry["crossings"] for entry in content["datasets"]["mine"]["pictures"]] == [0, 0, 0, 0]
    assert Image.open(tmp_path / "pictures.png").size[0] > 500
    assert Image.open(tmp_path / "sheet-mine.jpg").size == (2 * 256 + 4, 2 * 256 + 4)


def test_a_missed_promise_is_told_after_everything_is_written(made: Dataset, tmp_path: Path) -> None:
    """Noise breaks the promises of a style, which is reported after all files are written."""
    with pytest.raises(VerificationError, match="of 8 promises"):
        run(
            tmp_path, seed=0, images=1, scenes=0, styles=(), datasets=[NamedDataset("published", made.storage.location)]
        )
    promises = json.loads((tmp_path / "pictures.json").read_text())["promises"]
    assert len(promises) == 8
    assert not all(promise["kept"] for promise in promises)
    assert (tmp_path / "pictures.png").exists()


@pytest.mark.parametrize(
    ("images", "styles", "names"), [(0, STYLES, ()), (1, (), ()), (1, ("wide",), ("wide",)), (1, (), ("a", "a"))]
)
def test_what_can_not_be_measured_is_refused(
    tmp_path: Path, images: int, styles: tuple[str, ...], names: tuple[str, ...]
) -> None:
    """A run without images, without datasets, or with two of one name is refused."""
    datasets = [NamedDataset(name, str(tmp_path / "nowhere")) for name in names]
    with pytest.raises(SpecError):
        run(tmp_path, seed=0, images=images, scenes=0, styles=styles, datasets=datasets)


def test_a_wrong_path_is_told(tmp_path: Path) -> None:
    """A wrong path is reported before anything is made."""
    with pytest.raises(DatasetMissingError):
        run(
            tmp_path,
            seed=0,
            images=1,
            scenes=0,
            styles=STYLES,
            datasets=[NamedDataset("mine", str(tmp_path / "nowhere"))],
        )


def test_a_run_that_fails_is_told(tmp_path: Path) -> None:
    """A run of an unknown style fails, and the error names the file that holds its output."""
    with pytest.raises(FarmError, match=r"no-style-1-seed-0\.log"):
        make("no-style", 1, 0, tmp_path / "pictures")


def test_named_datasets_are_read_as_they_are_written() -> None:
    """NAME=PATH is read, and the path may hold further equals signs."""
    assert parse_named("wide=data/a=b") == NamedDataset("wide", "data/a=b")
    for wrong in ("wide", "=data", "wide=", "a/b=data"):
        with pytest.raises(ArgumentTypeError):
            parse_named(wrong)


@pytest.mark.parametrize(
    ("arguments", "styles"),
    [
        ([], STYLES),
        (["--style", "wide", "--style", "wide"], ("wide",)),
        (["--dataset", "mine=data"], ()),
        (["--dataset", "mine=data", "--style", "wide"], ("wide",)),
    ],
)
def test_both_styles_are_made_unless_told_otherwise(arguments: list[str], styles: tuple[str, ...]) -> None:
    """A dataset that is named is measured alone; without one, both styles are made."""
    parser = argparse.ArgumentParser()
    add_pictures(parser.add_subparsers(), argparse.ArgumentParser(add_help=False))
    assert styles_of(parser.parse_args(["pictures", *arguments])) == styles
