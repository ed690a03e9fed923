"""Writing a picture's files where no manifest is wanted."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from farm.dataset.formats import PNG
from farm.storage import LocalStorage


def write_files(folder: Path, **pictures: NDArray[np.uint8] | NDArray[np.uint16]) -> None:
    """Write PNG files as a worker does, each read back, named after its keyword.

    Raises:
        DestinationError: if one can't be written.
    """
    storage = LocalStorage(folder)
    for name, pixels in pictures.items():
        storage.write(f"{name}.png", PNG.encode(pixels))
