"""The place of a dataset: a store, and the dataset's name in it."""

import re
from dataclasses import dataclass

from pydantic import TypeAdapter, ValidationError

from farm.errors import DestinationError
from farm.spec.job import DatasetName
from farm.storage import find_folder, refuse_credentials

_NAME: TypeAdapter[str] = TypeAdapter(DatasetName)
_NAME_IN_URL = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,99}")
"""Pattern of a dataset's name in a bucket, where other signs mean something in URLs and listings."""


@dataclass(frozen=True, slots=True)
class Destination:
    """The place of a dataset: the store (a folder or URL), and the name of the dataset's own folder in it."""

    store: str
    name: str

    @property
    def location(self) -> str:
        """The dataset's folder."""
        return f"{self.store.rstrip('/')}/{self.name}"


def parse_destination(out: str) -> Destination:
    """Split a place, a path or URL, into the store and the dataset's name.

    Raises:
        DestinationError: if a URL names no folder in a bucket or holds credentials, a path leads through a link whose
            target is not there, or the last part can't be the name of a dataset.
    """
    if "://" in out:
        refuse_credentials(out)
        kind, _, rest = out.partition("://")
        store, _, name = rest.rstrip("/").rpartition("/")
        if not store.strip("/"):
            raise DestinationError(f"{out}: names no folder for the dataset; write {kind}://BUCKET/FOLDER")
        store = f"{kind}://{store}"
        if not _NAME_IN_URL.fullmatch(name):
            raise DestinationError(
                f"{out}: '{name}' can't name a dataset in a bucket; use up to 100 letters, digits, '.', '_' and '-', "
                "and begin with a letter or digit"
            )
        return Destination(store=store, name=name)
    path = find_folder(out)
    try:
        return Destination(store=str(path.parent), name=_NAME.validate_python(path.name))
    except ValidationError as error:
        raise DestinationError(
            f"{out!a}: {path.name!a} can't name a dataset; use up to 100 printable characters, and begin with a letter "
            "or digit"
        ) from error
