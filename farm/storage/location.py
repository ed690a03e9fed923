"""From a path or URL to the storage there."""

import re
from pathlib import Path

from farm.errors import DestinationError, MachineError
from farm.storage.connection import is_s3
from farm.storage.faults import as_destination_error
from farm.storage.local import LocalStorage
from farm.storage.objects import ObjectStorage
from farm.storage.port import Storage

# A name, a colon and a password before an @; the password may hold slashes. A port is none, nor is Amazon's `arn:`.
_USER = re.compile(r"(?!arn:)[^/:@]*:(?!\d+/)[^@]*@")


def open_storage(location: str) -> Storage:
    """The storage at a folder's path or URL; nothing is read or written yet.

    Raises:
        MachineError: if the URL's filesystem needs a package that is not installed.
        DestinationError: if the URL's protocol is unknown or refuses, or the URL holds credentials.
    """
    if "://" not in location:
        return LocalStorage(Path(location))
    if location.startswith("file://"):
        return LocalStorage(Path(location.removeprefix("file://")))
    refuse_credentials(location)
    protocol = location.partition("://")[0]
    with as_destination_error("open", location):
        try:
            return ObjectStorage(location)
        except ImportError as error:
            advice = "; run: pip install 'cable-farm[s3]'" if is_s3(location) else ""
            raise MachineError(f"{protocol}://: {error}{advice}") from error
        except ValueError as error:
            raise DestinationError(f"{protocol}://: no such kind of storage; see fsspec's list of protocols") from error


def refuse_credentials(location: str) -> None:
    """Make sure that a URL can be shown: in messages, logs and manifests.

    Raises:
        DestinationError: if it holds a password or key; the text does not.
    """
    protocol, _, rest = location.partition("://")
    if _USER.match(rest) or (is_s3(location) and "@" in rest.partition("/")[0]):
        raise DestinationError(
            f"{protocol}://: this URL holds credentials, which would be shown wherever it is; "
            "give them by the environment instead (for S3: AWS_ACCESS_KEY_ID, AWS_SECRET_ACCESS_KEY)"
        )
