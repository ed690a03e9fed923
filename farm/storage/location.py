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
"""A name, a colon and a password before an @; the password may hold slashes. A port is none, nor is Amazon's `arn:`."""


def open_storage(location: str) -> Storage:
    """The storage at a folder's path or URL; nothing is read or written yet.

    Raises:
        MachineError: if the URL's filesystem needs a package that is not installed.
        DestinationError: if the URL's protocol is unknown or refuses, or the URL holds credentials.
    """
    scheme, separator, _ = location.partition("://")
    return _STORES.get(scheme if separator else _PLAIN_PATH, _open_objects)(location)


def _open_folder(location: str) -> Storage:
    return LocalStorage(Path(location.removeprefix("file://")))


def _open_objects(location: str) -> Storage:
    """What fsspec knows by the URL's scheme."""
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
"""Stands for the scheme of a path, which has none."""

_STORES: Mapping[str, Callable[[str], Storage]] = MappingProxyType({_PLAIN_PATH: _open_folder, "file": _open_folder})
"""What opens a location, by its URL's scheme; fsspec opens those that are not here."""


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
