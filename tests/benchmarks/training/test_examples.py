"""Pictures for a network: from datasets, from folders of photographs, and augmented."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from benchmarks.training.augmentation import as_input, augment
from benchmarks.training.examples import EDGE_PX, examples_of, photographs_in
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.errors import SpecError, VerificationError
from tests.stand_in import StandInRenderer, stand_in_header
from worker.service.upload import upload


def made(folder: Path, resolution: int) -> Dataset:
    """A dataset of two categories with two pictures each."""
    dataset = create_dataset(Destination(str(folder), "noise"), stand_in_header(resolution=resolution))
    for job in dataset.header.spec.jobs():
        upload(StandInRenderer().make(job, dataset.header), job, dataset)
    return dataset


def photograph(folder: Path, name: str, rows: int, columns: int, *, mask: bool = True) -> NDArray[np.uint8]:
    """A red photograph whose left half is cable."""
    for part in ("images", "masks"):
        (folder / part).mkdir(parents=True, exist_ok=True)
    picture = np.zeros((rows, columns, 3), np.uint8)
    picture[..., 2] = 200
    cv2.imwrite(str(folder / "images" / f"{name}.jpg"), picture)
    truth = np.zeros((rows, columns), np.uint8)
    truth[:, : columns // 2] = 255
    if mask:
        cv2.imwrite(str(folder / "masks" / f"{name}.png"), truth)
    return truth


@pytest.mark.parametrize("resolution", [32, 512])
def test_a_datasets_pictures_are_scaled(tmp_path: Path, resolution: int) -> None:
    """Pictures are scaled up or down, and the share of cable stays."""
    examples = examples_of(made(tmp_path, resolution))
    assert len(examples) == 4
    assert examples.pictures.shape == (4, EDGE_PX, EDGE_PX, 3)
    assert examples.masks.mean() == pytest.approx(4 / resolution, abs=1 / EDGE_PX)


def test_an_empty_dataset_is_refused(dataset: Dataset) -> None:
    """A dataset without finished pictures is refused."""
    with pytest.raises(VerificationError, match="no picture is done"):
        examples_of(dataset)


def test_photographs_are_cut_square_about_their_middle(tmp_path: Path) -> None:
    """A landscape photograph is cropped to its middle square, in RGB, with a mask of another ending."""
    photograph(tmp_path, "one", 300, 500)
    photograph(tmp_path, "two", 512, 512)
    examples = photographs_in(tmp_path)
    assert len(examples) == 2
    assert examples.masks.mean() == pytest.approx(0.5, abs=0.01)
    assert examples.masks[0, :, : EDGE_PX // 2 - 1].all()
    red, green, blue = examples.pictures[0, 5, 5]
    assert red > 190
    assert max(green, blue) < 10


def test_a_photograph_without_a_mask_is_refused(tmp_path: Path) -> None:
    """The error names a photograph without a mask."""
    photograph(tmp_path, "one", 300, 300)
    photograph(tmp_path, "two", 300, 300, mask=False)
    with pytest.raises(SpecError, match=r"two\.jpg: has no mask"):
        photographs_in(tmp_path)


def test_a_mask_of_another_shape_is_refused(tmp_path: Path) -> None:
    """A mask of another shape than its photograph is refused."""
    photograph(tmp_path, "one", 300, 300)
    cv2.imwrite(str(tmp_path / "masks" / "one.png"), np.zeros((30, 30), np.uint8))
    with pytest.raises(SpecError, match="another shape"):
        photographs_in(tmp_path)


@pytest.mark.parametrize("content", [b"", b"no image"])
def test_a_photograph_that_is_no_image_is_refused(tmp_path: Path, content: bytes) -> None:
    """A photograph that is empty or text is refused."""
    photograph(tmp_path, "one", 300, 300)
    (tmp_path / "images" / "one.jpg").write_bytes(content)
    with pytest.raises(SpecError, match="can't decode"):
        photographs_in(tmp_path)


def test_a_folder_without_photographs_is_refused(tmp_path: Path) -> None:
    """The error says what the folder must hold."""
    with pytest.raises(SpecError, match="images/ and masks/"):
        photographs_in(tmp_path)


def test_picture_and_mask_are_turned_and_mirrored_together() -> None:
    """The mask is set where the picture is bright, whatever was drawn."""
    picture = np.full((16, 16, 3), 40, np.uint8)
    picture[2:5, 1:12] = 220
    mask = picture[..., 0] > 100
    draw = np.random.default_rng(0)
    seen = set()
    for _ in range(40):
        changed, changed_mask = augment(picture, mask, draw)
        assert ((changed.mean(axis=0) > 0) == (changed_mask[0] > 0)).all()
        seen.add(changed_mask.tobytes())
    assert len(seen) == 8


def test_augmentation_changes_light_and_colour_mildly() -> None:
    """A grey picture stays nearly grey, and the same draw gives the same picture."""
    picture, mask = np.full((8, 8, 3), 128, np.uint8), np.zeros((8, 8), np.bool_)
    plain = as_input(picture.astype(np.float32) / 255)
    changes = [augment(picture, mask, np.random.default_rng(seed))[0] - plain for seed in range(20)]
    assert 0.05 < max(float(np.abs(change).max()) for change in changes) < 1
    again = augment(picture, mask, np.random.default_rng(3))[0] - plain
    assert again.tobytes() == changes[3].tobytes()
