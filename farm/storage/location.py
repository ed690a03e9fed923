"""Opens the storage at a path or URL."""

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from farm.errors import DestinationError, MachineError
from farm.storage.faults import as_destination_error
from farm.storage.local import LocalStorage
from farm.storage.objects import ObjectStorage
from farm.storage.port import Storage
from farm.storage.services import SERVICES, service_of

_USER = re.compile(r"(?!arn:)[^/:@]*:(?!\d+/)[^@]*@")
"""Pattern of a name, a colon and a password before an @; the password may hold slashes. A port doesn't count as a
password, nor `arn:` as the start of a name: it begins the addresses of Amazon's resources."""


def open_storage(location: str, *, anchor: str = "") -> Storage:
    """Open the storage at a folder's path or URL; nothing is read or written yet.

    Args:
        location: the path or URL.
        anchor: file without which nothing is written there; see `LocalStorage`. A bucket, which is no mount that may
            vanish, takes no notice.

    Raises:
        MachineError: if the URL's filesystem needs a package that is not installed.
        DestinationError: if the URL's protocol is unknown or refuses, or the URL holds credentials.
    """
    scheme, separator, _ = location.partition("://")
    storage = _STORES.get(scheme if separator else _PLAIN_PATH, _open_objects)(location)
    return storage.anchored(anchor) if anchor and isinstance(storage, LocalStorage) else storage


def _open_folder(location: str) -> Storage:
    return LocalStorage(Path(location.removeprefix("file://")))


def _open_objects(location: str) -> Storage:
    """Open the storage at a URL whose scheme fsspec knows."""
    refuse_credentials(location)
    protocol = location.partition("://")[0]
    with as_destination_error("open", location):
        try:
            return ObjectStorage(location)
        except ImportError as error:
            package = service_of(location).install
            advice = f"; run: pip install '{package}'" if package else ""
            raise MachineError(f"{protocol}://: {error}{advice}") from error
        except ValueError as error:
            raise DestinationError(f"{protocol}://: no such kind of storage; see fsspec's list of protocols") from error


_PLAIN_PATH = ""
"""Key of `_STORES` for a path, which has no scheme."""

_STORES: Mapping[str, Callable[[str], Storage]] = MappingProxyType({_PLAIN_PATH: _open_folder, "file": _open_folder})
"""Functions that open a storage, by its URL's scheme; `_open_objects` opens those of all other schemes."""


def refuse_credentials(location: str) -> None:
    """Make sure that a URL can be shown: in messages, logs and manifests.

    Raises:
        DestinationError: if it holds a password or key; the text does not.
    """
    protocol, _, rest = location.partition("://")
    if _USER.match(rest) or (service_of(location).at_sign_is_credential and "@" in rest.partition("/")[0]):
        by_service = {service.title: service.credentials for service in SERVICES.values()}
        variables = "; ".join(f"for {title}: {names}" for title, names in by_service.items())
        raise DestinationError(
            f"{protocol}://: this URL holds credentials, which would be shown wherever it is; "
            f"give them by the environment instead ({variables})"
        )
