"""A contact sheet: the first pictures of every category in one image, a row a category."""

import io

from PIL import Image

from farm.dataset.dataset import Dataset
from farm.dataset.outputs import IMAGE
from farm.dataset.paths import file_path
from farm.errors import IncompleteError
from farm.spec.job import Job
from farm.storage import in_order

_GAP_PX = 4
_JPEG_QUALITY = 88


def make_contact_sheet(dataset: Dataset, *, columns: int, edge_px: int) -> bytes:
    """Make a JPEG of the first `columns` pictures of each category that has a quota, their longer edge `edge_px` long.

    Raises:
        IncompleteError: if a picture is not there yet.
        DestinationError: if the dataset can't be read.
    """
    rows = [(category, min(columns, quota)) for category, quota in dataset.header.spec.quotas.items() if quota]
    width, height = (max(1, round(edge_px * share)) for share in dataset.header.spec.resolution.shares)
    right, down = width + _GAP_PX, height + _GAP_PX
    sheet = Image.new("RGB", (right * max(count for _, count in rows) - _GAP_PX, down * len(rows) - _GAP_PX), "white")
    places = [(row, column) for row, (_, count) in enumerate(rows) for column in range(count)]
    jobs = [Job(category=rows[row][0], index=column) for row, column in places]
    pictures = in_order(lambda job: _read(dataset, job, (width, height)), jobs)
    for (row, column), picture in zip(places, pictures, strict=True):
        sheet.paste(picture, (column * right, row * down))
    encoded = io.BytesIO()
    sheet.save(encoded, "JPEG", quality=_JPEG_QUALITY)
    return encoded.getvalue()


def _read(dataset: Dataset, job: Job, size_px: tuple[int, int]) -> Image.Image:
    try:
        content = dataset.storage.read(file_path(job, IMAGE))
    except FileNotFoundError as error:
        raise IncompleteError(f"{job.id} is not there yet; finish the dataset first") from error
    picture = Image.open(io.BytesIO(content)).convert("RGB")
    return picture.resize(size_px, Image.Resampling.LANCZOS)
