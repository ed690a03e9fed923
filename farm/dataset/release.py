"""Keeps the pictures of two releases apart: the same description may look otherwise in another release."""

from farm import __version__
from farm.dataset.dataset import Dataset
from farm.errors import ConflictError


def begun_by_another(dataset: Dataset) -> bool:
    """Whether another release began the dataset."""
    return dataset.header.farm_version != __version__


def refuse_to_mix(dataset: Dataset) -> None:
    """Refuse to add pictures to a dataset of another release.

    Raises:
        ConflictError: if another release began it.
    """
    if begun_by_another(dataset):
        place = dataset.storage.location
        raise ConflictError(
            f"{place}: begun by cable-farm {dataset.header.farm_version}, whose pictures may differ from those of this "
            f"release, {__version__}; finish it with that release, choose another --out, or mix the two: "
            f"farm run --continue --out {place}, or farm submit --continue --out {place}"
        )
