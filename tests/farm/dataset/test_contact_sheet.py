"""Contact sheets."""

import io
from pathlib import Path

import pytest
from PIL import Image

from farm.dataset.contact_sheet import make_contact_sheet
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.errors import IncompleteError
from tests.stand_in import StandInRenderer, stand_in_header
from worker.service.upload import upload


def test_a_row_for_each_category_with_a_quota(dataset: Dataset) -> None:
    """Two categories have a row of two pictures each, 20 pixels wide with gaps of 4."""
    for job in dataset.header.spec.jobs():
        upload(StandInRenderer().make(job, dataset.header), job, dataset)
    sheet = Image.open(io.BytesIO(make_contact_sheet(dataset, columns=4, edge_px=20)))
    assert sheet.size == (44, 44)


def test_a_dataset_that_is_not_finished_has_no_sheet(dataset: Dataset) -> None:
    """The error names the first missing picture."""
    with pytest.raises(IncompleteError, match="close_concentrated_light-000000"):
        make_contact_sheet(dataset, columns=4, edge_px=20)


@pytest.mark.parametrize(("resolution", "size"), [("64x32", (44, 24)), ("32x64", (24, 44))])
def test_pictures_keep_their_shape(tmp_path: Path, resolution: str, size: tuple[int, int]) -> None:
    """The longer edge of a picture has the width that was asked for, and the other its share of it."""
    oblong = create_dataset(Destination(str(tmp_path), "oblong"), stand_in_header(resolution=resolution))
    for job in oblong.header.spec.jobs():
        upload(StandInRenderer().make(job, oblong.header), job, oblong)
    sheet = Image.open(io.BytesIO(make_contact_sheet(oblong, columns=4, edge_px=20)))
    assert sheet.size == size
