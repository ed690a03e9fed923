"""The table of outputs, and the checks that go by it."""

from itertools import chain
from typing import Any

import numpy as np
import pytest

from farm.dataset.formats import PNG
from farm.dataset.index import IndexEntry
from farm.dataset.outputs import (
    IMAGE,
    INSTANCES,
    MASK,
    OUTPUTS,
    Agreement,
    Output,
    array_fault,
    find_faults,
    outputs_of,
)
from farm.dataset.paths import file_path, manifest_folder
from farm.scene.picture_size import PictureSize
from farm.spec.category import Category
from farm.spec.header import DatasetHeader
from farm.spec.job import Job

JOB = Job.from_id("far-000001")
SIZE = 8
RESOLUTION = PictureSize.square(SIZE)


def contents(**changed: Any) -> dict[str, Any]:
    """Contents by role of a picture whose upper half is a cable; `changed` are put in place of some."""
    instances = np.zeros((SIZE, SIZE), np.uint16)
    instances[: SIZE // 2] = 1
    mask = (instances > 0) * np.uint8(255)
    return {"image": np.zeros((SIZE, SIZE, 3), np.uint8), "mask": mask, "instances": instances, **changed}


def faulty(found: dict[str, Any]) -> list[str]:
    """Roles of the outputs at fault."""
    return [output.role for output, _ in find_faults(OUTPUTS, found, RESOLUTION)]


def test_the_published_layout() -> None:
    """Images, masks and instances lie where datasets have had them from the first."""
    assert [file_path(JOB, output) for output in OUTPUTS[:3]] == [
        "far/images/far-000001.png",
        "far/masks/far-000001.png",
        "far/instances/far-000001.png",
    ]


def test_a_dataset_has_every_output(header: DatasetHeader) -> None:
    """No description can leave one out."""
    assert outputs_of(header.spec) == OUTPUTS


def test_no_two_rows_share_a_name() -> None:
    """Roles are apart, and so are folders, that of the manifests included."""
    folders = [f"{Category.FAR}/{output.folder}" for output in OUTPUTS] + [manifest_folder(Category.FAR)]
    assert len(set(folders)) == len(folders)
    assert len({output.role for output in OUTPUTS}) == len(OUTPUTS)


def test_no_role_is_another_key_of_the_index() -> None:
    """A role, and that with `_sha256`, replaces nothing that a line of the index tells besides."""
    roles = set(chain.from_iterable((output.role, f"{output.role}_sha256") for output in OUTPUTS))
    assert not roles & IndexEntry.model_fields.keys()


def test_agreements_name_outputs() -> None:
    """What an output must agree with is another row."""
    named = {(output.role, agreement.other) for output in OUTPUTS for agreement in output.agreements}
    assert all(role != other and other in {output.role for output in OUTPUTS} for role, other in named)


def test_sound_contents() -> None:
    """Contents that are what the table says have no fault."""
    assert faulty(contents()) == []


@pytest.mark.parametrize(
    ("role", "content"),
    [
        ("image", np.zeros((SIZE, SIZE), np.uint8)),
        ("image", np.zeros((SIZE, SIZE, 3), np.float32)),
        ("mask", np.zeros((4, 4), np.uint8)),
        ("mask", np.full((SIZE, SIZE), 7, np.uint8)),
        ("instances", np.zeros((SIZE, SIZE), np.uint8)),
        ("instances", np.full((SIZE, SIZE), 2, np.uint16)),
    ],
)
def test_a_fault_is_its_own_output_s(role: str, content: Any) -> None:
    """A wrong size, type or value, or instances that do not fill the mask, is one fault of one output."""
    assert faulty(contents(**{role: content})) == [role]


def test_what_is_not_there_is_not_checked() -> None:
    """Neither a content that is missing, nor an agreement with it, is a fault."""
    found = contents()
    del found["mask"]
    assert faulty(found) == []


def test_all_faults_are_told() -> None:
    """Two contents that are wrong in themselves are two faults; they are not compared besides."""
    assert faulty(contents(mask=np.zeros((4, 4), np.uint8), instances=np.zeros((4, 4), np.uint16))) == [
        "mask",
        "instances",
    ]


def test_an_agreement_with_an_output_that_the_dataset_lacks() -> None:
    """A row can be used without the one that it must agree with."""
    lone = Output(
        "lone",
        "lone",
        PNG,
        lambda pixels, resolution: array_fault(pixels, resolution.shape, np.uint8),
        agreements=(Agreement(INSTANCES.role, lambda *_: "never agrees"),),
    )
    found = contents(lone=np.zeros((SIZE, SIZE), np.uint8))
    assert list(find_faults((IMAGE, MASK, lone), {**found, "instances": None}, RESOLUTION)) == []
    assert list(find_faults((*OUTPUTS, lone), found, RESOLUTION)) == [(lone, "never agrees")]


@pytest.mark.parametrize(("width", "height"), [(SIZE, SIZE // 2), (SIZE // 2, SIZE)])
def test_width_and_height_are_told_apart(width: int, height: int) -> None:
    """A picture that lies on its side is at fault, with its labels."""
    instances = np.zeros((height, width), np.uint16)
    found = {
        "image": np.zeros((height, width, 3), np.uint8),
        "mask": instances.astype(np.uint8),
        "instances": instances,
    }
    upright, turned = PictureSize(width=width, height=height), PictureSize(width=height, height=width)
    assert list(find_faults(OUTPUTS, found, upright)) == []
    assert [output for output, _ in find_faults(OUTPUTS, found, turned)] == [IMAGE, MASK, INSTANCES]
