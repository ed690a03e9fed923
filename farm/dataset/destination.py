"""The place of a dataset: a store, and the dataset's name in it."""

from dataclasses import dataclass

from pydantic import TypeAdapter, ValidationError

from farm.errors import DestinationError
from farm.spec.job import DatasetName
from farm.storage import find_folder, refuse_credentials

_NAME: TypeAdapter[str] = TypeAdapter(DatasetName)


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
    else:
        path = find_folder(out)
        store, name = str(path.parent), path.name
    try:
        return Destination(store=store, name=_NAME.validate_python(name))
    except ValidationError as error:
        raise DestinationError(
            f"{out}: '{name}' can't name a dataset; use up to 100 letters, digits, '.', '_' and '-', and begin with a "
            "letter or digit"
        ) from error
