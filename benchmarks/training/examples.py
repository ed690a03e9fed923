"""Read pictures and their masks for the network, from a dataset or from a folder of photographs."""

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from farm.dataset.dataset import Dataset
from farm.dataset.index import done_manifests
from farm.dataset.outputs import IMAGE, MASK
from farm.errors import SpecError, VerificationError

EDGE_PX = 256
"""Edge of the network's pictures, pixels."""

_PICTURES = frozenset({".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".webp"})


@dataclass(frozen=True, slots=True)
class Examples:
    """A set of pictures, all of one size.

    Attributes:
        pictures: RGB pictures, (N, H, W, 3).
        masks: masks, true where a cable is visible, (N, H, W).
    """

    pictures: NDArray[np.uint8]
    masks: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.pictures)


def examples_of(dataset: Dataset) -> Examples:
    """Every finished picture of a dataset, at `EDGE_PX`.

    Raises:
        VerificationError: if none is finished, or one can't be decoded.
        DestinationError: if the dataset can't be read.
    """
    pairs = []
    for _, manifest in done_manifests(dataset):
        paths = [manifest.files[output.folder].path for output in (IMAGE, MASK)]
        contents = [dataset.storage.read(path) for path in paths]
        picture, mask = _decode(contents[0], cv2.IMREAD_COLOR), _decode(contents[1], cv2.IMREAD_GRAYSCALE)
        if picture is None or mask is None:
            where = f"{dataset.storage.location}/{paths[0]}"
            raise VerificationError(f"{where}: can't decode it or its mask; farm repair makes it again")
        pairs.append((_fit(picture), _fit(mask)))
    if not pairs:
        raise VerificationError(f"{dataset.storage.location}: no picture is done; finish the dataset first")
    return _together(pairs)


def photographs_in(folder: Path) -> Examples:
    """Read photographs from the folder `images` and their masks from `masks`.

    A mask has the same name as its photograph, up to the ending. The middle square of a picture is scaled to an edge of
    `EDGE_PX`. A mask's pixels that are brighter than middle grey are cable.

    Raises:
        SpecError: if there is no picture, or one can't be decoded, has no mask or a mask of another shape.
    """
    files = [folder / "images" / name for name in sorted(_names(folder / "images"))]
    masks = {Path(name).stem: folder / "masks" / name for name in _names(folder / "masks")}
    if not files:
        raise SpecError(f"{folder}: no pictures here; it must hold images/ and masks/ with equal names")
    pairs = []
    for file in files:
        if file.stem not in masks:
            raise SpecError(f"{file}: has no mask; add {folder / 'masks' / file.stem}.png")
        picture = _decode(file.read_bytes(), cv2.IMREAD_COLOR)
        mask = _decode(masks[file.stem].read_bytes(), cv2.IMREAD_GRAYSCALE)
        if picture is None or mask is None:
            raise SpecError(f"{file}: can't decode it or its mask; replace the file")
        if picture.shape[:2] != mask.shape:
            raise SpecError(f"{file}: has another shape than its mask, {picture.shape[:2]} and {mask.shape}")
        pairs.append((_fit(picture), _fit(mask)))
    return _together(pairs)


def _names(folder: Path) -> list[str]:
    if not folder.is_dir():
        return []
    return [file.name for file in folder.iterdir() if file.suffix.lower() in _PICTURES]


def _decode(content: bytes, how: int) -> NDArray[np.uint8] | None:
    """Decode an image to RGB or grey; None if it isn't one."""
    decoded = cv2.imdecode(np.frombuffer(content, np.uint8), how) if content else None
    if decoded is None:
        return None
    return (decoded[:, :, ::-1] if decoded.ndim == 3 else decoded).astype(np.uint8)


def _fit(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Crop an image to its middle square, and scale that to an edge of `EDGE_PX`."""
    rows, columns = image.shape[:2]
    edge = min(rows, columns)
    top, left = (rows - edge) // 2, (columns - edge) // 2
    middle = np.ascontiguousarray(image[top : top + edge, left : left + edge])
    how = cv2.INTER_AREA if edge > EDGE_PX else cv2.INTER_LINEAR
    return cv2.resize(middle, (EDGE_PX, EDGE_PX), interpolation=how).astype(np.uint8)


def _together(pairs: list[tuple[NDArray[np.uint8], NDArray[np.uint8]]]) -> Examples:
    pictures, masks = zip(*pairs, strict=True)
    return Examples(np.stack(pictures), np.stack(masks) > 127)
