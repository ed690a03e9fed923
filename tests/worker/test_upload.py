"""Writing a made picture."""

from dataclasses import replace
from typing import Any

import cv2
import numpy as np
import pytest

from farm.completion import is_done
from farm.dataset import Dataset
from farm.errors import DestinationError, RenderError
from farm.job import Job
from farm.layout import FileRole, file_path, manifest_path
from tests.stand_in import StandInMaker
from worker.made import MadeImage
from worker.upload import encode_png, upload

JOB = Job.from_id("far-000000")


@pytest.fixture
def made(dataset: Dataset) -> MadeImage:
    """A picture with its labels."""
    return StandInMaker().make(JOB, dataset.header)


@pytest.mark.parametrize("shape_and_type", [((5, 7, 3), np.uint8), ((5, 7), np.uint8), ((5, 7), np.uint16)])
def test_png_keeps_every_value(shape_and_type: tuple[tuple[int, ...], Any]) -> None:
    """A PNG gives back the pixels, red first, in 8 and in 16 bits."""
    shape, kind = shape_and_type
    pixels = np.random.Generator(np.random.PCG64(1)).integers(0, np.iinfo(kind).max, shape, dtype=kind, endpoint=True)
    decoded = cv2.imdecode(np.frombuffer(encode_png(pixels), np.uint8), cv2.IMREAD_UNCHANGED)
    assert decoded is not None
    assert np.array_equal(decoded[:, :, ::-1] if decoded.ndim == 3 else decoded, pixels)


def test_writes_the_layout(dataset: Dataset, made: MadeImage) -> None:
    """Three pictures and a manifest, where the layout says."""
    upload(made, JOB, dataset)
    expected = {file_path(JOB, role) for role in FileRole} | {manifest_path(JOB), "dataset.json"}
    assert set(dataset.storage.files()) == expected
    assert is_done(dataset, JOB)


def test_manifest_is_last(dataset: Dataset, made: MadeImage, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is written after the manifest, so that it never vouches for a file still to come."""
    written: list[str] = []
    write = type(dataset.storage).write

    def recording(storage: object, path: str, content: bytes) -> None:
        written.append(path)
        write(storage, path, content)  # type: ignore[arg-type]  # the class's own method

    monkeypatch.setattr(type(dataset.storage), "write", recording)
    upload(made, JOB, dataset)
    assert written[-1] == manifest_path(JOB)


def test_interrupted_upload_is_not_done(dataset: Dataset, made: MadeImage, monkeypatch: pytest.MonkeyPatch) -> None:
    """When a write fails, the job is not done, whatever was written before."""
    write = type(dataset.storage).write

    def failing(storage: object, path: str, content: bytes) -> None:
        if "instances" in path:
            raise DestinationError("disk full")
        write(storage, path, content)  # type: ignore[arg-type]  # the class's own method

    monkeypatch.setattr(type(dataset.storage), "write", failing)
    with pytest.raises(DestinationError):
        upload(made, JOB, dataset)
    assert not is_done(dataset, JOB)


@pytest.mark.parametrize(
    "damage",
    [
        {"mask": np.zeros((32, 32), np.uint8)},
        {"mask": np.zeros((16, 16), np.uint8)},
        {"image": np.zeros((32, 32), np.uint8)},
        {"instances": np.zeros((32, 32), np.uint8)},
        {"image": np.zeros((32, 32, 3), np.float32)},
    ],
)
def test_labels_that_do_not_fit(dataset: Dataset, made: MadeImage, damage: dict[str, Any]) -> None:
    """A picture and labels that contradict each other are not written."""
    before = dataset.storage.files()
    with pytest.raises(RenderError):
        upload(replace(made, **damage), JOB, dataset)
    assert dataset.storage.files() == before
