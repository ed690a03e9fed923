"""The collected index and the page of pictures."""

import json
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

import pytest

from farm.dataset.dataset import Dataset
from farm.dataset.index import done_manifests, write_index
from farm.dataset.manifest import Manifest
from farm.dataset.paths import INDEX_FILE, REPORT_FILE
from farm.dataset.report import write_report
from tests.stand_in import StandInRenderer
from worker.service.upload import upload


@pytest.fixture
def made(dataset: Dataset) -> Dataset:
    """A finished dataset."""
    for job in dataset.header.spec.jobs():
        upload(StandInRenderer().make(job, dataset.header), job, dataset)
    return dataset


class Page(HTMLParser):
    """Collects the addresses to which a page refers."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.references: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note a tag and its address."""
        self.tags.append(tag)
        self.references += [value for name, value in attrs if name in {"src", "href"} and value]


def page_of(dataset: Dataset) -> str:
    """Write the page and read it."""
    write_report(dataset)
    return dataset.storage.read(REPORT_FILE).decode()


def test_index_has_a_line_for_each(made: Dataset) -> None:
    """The index lists the done images by category and number, with paths that exist."""
    assert write_index(made) == 4
    lines = [json.loads(line) for line in made.storage.read(INDEX_FILE).splitlines()]
    assert [line["job_id"] for line in lines] == [
        "close_concentrated_light-000000",
        "close_concentrated_light-000001",
        "far-000000",
        "far-000001",
    ]
    assert all(line[role] in made.storage.files() for line in lines for role in ("image", "mask", "instances"))


def test_index_repeats(made: Dataset) -> None:
    """Collecting again gives the same bytes."""
    write_index(made)
    first = made.storage.read(INDEX_FILE)
    write_index(made)
    assert made.storage.read(INDEX_FILE) == first


def test_unfinished_images_are_left_out(made: Dataset) -> None:
    """An image that lacks a file is not listed."""
    made.storage.remove("far/masks/far-000001.png")
    assert [job.id for job, _ in done_manifests(made)][-1] == "far-000000"


def test_page_shows_every_picture_with_its_mask(made: Dataset) -> None:
    """The page refers to image and mask of each job, by paths below its own folder that exist."""
    page = Page(page_of(made))
    pictures = [unquote(reference) for reference in page.references if not reference.startswith("#")]
    assert set(pictures) <= made.storage.files().keys()
    assert page.tags.count("img") == 8


def test_page_stands_alone(made: Dataset) -> None:
    """The page has no script and loads nothing from elsewhere."""
    page = Page(page_of(made))
    assert "script" not in page.tags
    assert not [reference for reference in page.references if "//" in reference]


def test_page_escapes(made: Dataset) -> None:
    """A name with markup in it, as a texture's file may have, is shown as text."""
    evil = "<script>alert(1)</script>"
    for job, manifest in done_manifests(made):
        if manifest.scene.floor is not None:
            floor = manifest.scene.floor.model_copy(update={"texture": evil})
            scene = manifest.scene.model_copy(update={"floor": floor})
            forged: Manifest = manifest.model_copy(update={"scene": scene})
            path = f"{job.category}/manifests/{job.id}.json"
            made.storage.write(path, forged.model_dump_json().encode())
    text = page_of(made)
    assert evil not in text
    assert "&lt;script&gt;" in text


def test_page_of_nothing(dataset: Dataset) -> None:
    """A dataset of which nothing is done has a page, too."""
    assert "0 of 4" in page_of(dataset)


def test_page_shows_only_so_many(made: Dataset) -> None:
    """A large category shows its first pictures and says how many there are."""
    write_report(made, pictures_per_category=1)
    text = made.storage.read(REPORT_FILE).decode()
    assert Page(text).tags.count("img") == 4
    assert "2 of 2, the first 1 shown" in text


def test_report_is_no_extra_file(made: Dataset, tmp_path: Path) -> None:
    """The index and the page in the dataset's folder don't count as extra files."""
    write_index(made)
    write_report(made)
    assert (tmp_path / "store/cables" / REPORT_FILE).exists()
    assert (tmp_path / "store/cables" / INDEX_FILE).exists()
