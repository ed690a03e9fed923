"""Write a picture's files without a manifest."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from farm.dataset.formats import PNG
from farm.storage import LocalStorage


def write_files(folder: Path, **pictures: NDArray[np.uint8] | NDArray[np.uint16]) -> None:
    """Write pictures as PNG files as a worker does, each named after its keyword and read back.

    Raises:
        DestinationError: if a file can't be written.
    """
    storage = LocalStorage(folder)
    for name, pixels in pictures.items():
        storage.write(f"{name}.png", PNG.encode(pixels))
