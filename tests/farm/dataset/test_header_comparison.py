"""Comparing a dataset's header with the one that is asked for."""

import json

import pytest

from farm.dataset.header_comparison import difference, first_difference
from farm.dataset.header_file import WrittenHeader, header_content, parse_header
from farm.spec.header import DatasetHeader, FileRef, FolderSurfaceRef, HdriRef, PlateRef, TemplateRef
from tests.stand_in import SHA, stand_in_header

_OTHER = "f" * 64


def _with_files(folder: str, sha256: str = SHA) -> DatasetHeader:
    """A header whose every file of the user's lies in a folder."""
    files = {"colour": FileRef(path=f"{folder}/slate_color.png", sha256=sha256)}
    return stand_in_header().model_copy(
        update={
            "template": TemplateRef(path=f"{folder}/mine.blend", sha256=SHA),
            "surfaces": (FolderSurfaceRef(name=folder.rpartition("/")[2], files=files),),
            "hdris": (HdriRef(name="sky", path=f"{folder}/sky.exr", sha256=SHA, dark=False),),
            "plates": (PlateRef(name="lab", path=f"{folder}/lab.jpg", sha256=SHA),),
        }
    )


def _written(header: DatasetHeader) -> WrittenHeader:
    return parse_header(header_content(header))


@pytest.mark.parametrize("release", ["0.0.1", stand_in_header().farm_version])
def test_moved_files_are_the_same(release: str) -> None:
    """Files count by their content, wherever each machine has them, and be a texture named after its folder."""
    present = _with_files("/mnt/a").model_copy(update={"farm_version": release})
    assert difference(_written(present), _with_files("/media/b")) == ""


@pytest.mark.parametrize("release", ["0.0.1", stand_in_header().farm_version])
def test_changed_files_differ(release: str) -> None:
    """A file of the same name with other content makes another dataset."""
    present = _with_files("/mnt/a").model_copy(update={"farm_version": release})
    assert "colour" in difference(_written(present), _with_files("/mnt/a", _OTHER))


def _by_another_release(**written: object) -> WrittenHeader:
    """A header as release 0.0.1 wrote it, which resolved built-in surfaces otherwise and knew fewer keys."""
    values = json.loads(header_content(stand_in_header()))
    values["farm_version"] = "0.0.1"
    values["surfaces"][0]["recipe_version"] = 7
    del values["spec"]["style"], values["spec"]["ranges"]["clutter"]
    values["spec"].update(written)
    return parse_header(json.dumps(values).encode())


def test_what_a_release_resolves_is_its_own() -> None:
    """Built-in surfaces of an earlier release and keys that it did not know make no other dataset."""
    assert difference(_by_another_release(), stand_in_header()) == ""


def test_what_a_user_decides_counts_in_every_release() -> None:
    """Another seed is another dataset, whichever release began it."""
    assert difference(_by_another_release(seed=3), stand_in_header()) == "spec.seed is 3, asked 0"


@pytest.mark.parametrize(
    ("present", "asked", "found"),
    [
        ({"a": [1, 2]}, {"a": [1]}, "a has 2 entries, asked 1"),
        ({"a": {"b": 1}}, {"a": {"b": None}}, "a.b is 1, asked None"),
        ({}, {"a": 1}, "a is None, asked 1"),
        ([{"a": "x" * 99}], [{"a": 1}], "[0].a is '" + "x" * 56 + "..., asked 1"),
        ({"a": 1}, {"a": 1}, ""),
    ],
)
def test_the_first_difference(present: object, asked: object, found: str) -> None:
    """It is named by its path, with both values, shortened."""
    assert first_difference(present, asked) == found


def test_a_key_that_a_release_did_not_know_counts_if_it_is_asked_for() -> None:
    """The style's own value is nobody's decision; another one is the user's."""
    present = json.loads(header_content(stand_in_header()))
    present["farm_version"] = "0.0.1"
    del present["spec"]["ranges"]["cable"]["background_share"]
    asked = stand_in_header()
    written = parse_header(json.dumps(present).encode())
    assert difference(written, asked) == ""
    cable = asked.spec.ranges.cable.model_copy(update={"background_share": 0.5})
    ranges = asked.spec.ranges.model_copy(update={"cable": cable})
    other = asked.model_copy(update={"spec": asked.spec.model_copy(update={"ranges": ranges})})
    assert difference(written, other) == "spec.ranges.cable.background_share is 0.0, asked 0.5"
