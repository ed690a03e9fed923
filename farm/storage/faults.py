"""Translates the failures of object stores into the farm's own errors.

Every filesystem of fsspec has its own exceptions: s3fs turns a server's answers into those of the operating system,
but lets through what its HTTP client and botocore raise when there is no answer.
"""

import re
from collections.abc import Iterator
from contextlib import contextmanager

from farm.errors import DestinationError, FarmError
from farm.storage.services import service_of

_USER_IN_URL = re.compile(r"//[^/\s@]*@")


@contextmanager
def as_destination_error(action: str, place: str) -> Iterator[None]:
    """Turn any failure inside `with` into the farm's own error, without credentials in its text.

    Args:
        action: verb of the failed action, as in "can't read".
        place: URL of the object or folder.

    Raises:
        FileNotFoundError: if the object is not there, though its bucket is.
        DestinationError: for anything else.
    """
    try:
        yield
    except FarmError:
        raise
    except Exception as error:  # each filesystem has its own, which share no other base
        if isinstance(error, FileNotFoundError) and not _lacks_bucket(error):
            raise
        reason = _reason(error)
        raise DestinationError(f"{place}: can't {action}: {reason}; {_advice(error, place)}") from error


def _lacks_bucket(error: Exception) -> bool:
    # s3fs raises the same for an object and its bucket; the server's answer, which it was made of, tells them apart.
    answer = getattr(error.__cause__, "response", None) or {}
    return bool(answer.get("Error", {}).get("Code") == "NoSuchBucket")


def _reason(error: Exception) -> str:
    if _lacks_bucket(error):
        return "there is no such bucket"
    if isinstance(error, TimeoutError):
        return "no answer in time"
    return _USER_IN_URL.sub("//", " ".join(str(error).split())) or type(error).__name__


def _advice(error: Exception, place: str) -> str:
    service = service_of(place)
    if _lacks_bucket(error):
        return "make it, or check its name"
    if isinstance(error, PermissionError) or "Credentials" in type(error).__name__:
        return f"check the credentials{_in_brackets(service.credentials)} and the bucket's rights"
    return f"check the store's address{_in_brackets(service.address)}, and that it runs and can be reached"


def _in_brackets(names: str) -> str:
    return f" ({names})" if names else ""
