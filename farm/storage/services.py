"""Object stores for which the farm has settings of its own.

A store that fsspec opens needs no row here: it then gets the options that suit all, and messages that name no variable.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from farm.storage.many import AT_A_TIME

Options = Mapping[str, Any]

_NO_OPTIONS: Options = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Service:
    """A kind of object store, with the settings that the farm has for it.

    Attributes:
        title: the name that messages give it.
        install: package that pip installs for it; empty where it comes with the farm.
        credentials: environment variables that hold the credentials, in words.
        address: the environment variable that holds the store's address.
        at_sign_is_credential: whether an @ in the URL's first part ends a key, as no bucket's name has one.
        retries: number of times that the client repeats a request that hung; None leaves the client's own number.
        open_options: fsspec's options for the filesystem.
        pages: lists the objects below a folder page by page, as fsspec's descriptions of them; takes the filesystem,
            the folder, and whether to list folders in it, too. None where fsspec has no such listing.
        get_options: fsspec's options for every read.
        put_options: fsspec's options for a write, by the content's number of bytes.
    """

    title: str = ""
    install: str = ""
    credentials: str = ""
    address: str = ""
    at_sign_is_credential: bool = False
    retries: int | None = None
    open_options: Options = field(default_factory=lambda: _NO_OPTIONS)
    pages: Callable[[Any, str, bool], Iterator[list[Options]]] | None = None
    get_options: Options = field(default_factory=lambda: _NO_OPTIONS)
    put_options: Callable[[int], Options] = lambda _size: _NO_OPTIONS


PUT_PATIENCE_S = 120.0
"""Seconds after which a put to S3 is given up, besides those that its bytes take on the slowest line.

The client has limits of its own for all else. But it may ask whether to send a body before it does, and would wait for
the answer forever.
"""

_SLOWEST_BYTES_S = 50_000.0
"""Bytes a second of the slowest line over which a put is waited for."""

_PART_BYTES = 8 * 1024 * 1024
"""Bytes in a part of an object; one of two parts at least is sent in parts, which the store joins once it has all."""


def _s3_put_options(size: int) -> Options:
    return {"chunksize": _PART_BYTES, "timeout": PUT_PATIENCE_S + size / _SLOWEST_BYTES_S}


def _s3_pages(filesystem: Any, folder: str, deep: bool) -> Iterator[list[Options]]:
    bucket, key, _ = filesystem.split_path(folder)
    asked: dict[str, Any] = {"Bucket": bucket, "Prefix": f"{key}/" if key else "", **filesystem.req_kw}
    if not deep:
        asked["Delimiter"] = "/"
    while True:
        page = filesystem.call_s3("list_objects_v2", **asked)
        yield [
            {**found, "name": f"{bucket}/{found['Key']}", "size": found["Size"]} for found in page.get("Contents", [])
        ]
        if not page.get("IsTruncated"):
            return
        asked["ContinuationToken"] = page["NextContinuationToken"]


_S3 = Service(
    title="S3",
    install="cable-farm[s3]",
    credentials="AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY, or AWS_PROFILE",
    address="AWS_ENDPOINT_URL",
    at_sign_is_credential=True,
    # The AWS client's own attempts, AWS_MAX_ATTEMPTS, are within each.
    retries=2,
    # The client's own number, 10, would hold up the reads of many manifests.
    open_options=MappingProxyType({"config_kwargs": {"max_pool_connections": AT_A_TIME}}),
    pages=_s3_pages,
    # A get is one request, not two with its size asked first; and it tells a missing object from a missing bucket.
    get_options=MappingProxyType({"max_concurrency": 1}),
    put_options=_s3_put_options,
)

SERVICES: Mapping[str, Service] = MappingProxyType({"s3": _S3, "s3a": _S3})
"""Object stores for which the farm has settings, by the scheme of their URLs."""

_UNKNOWN = Service()


def service_of(url: str) -> Service:
    """Look up the settings for the store at a URL; a store of another scheme gets empty ones."""
    return SERVICES.get(url.partition("://")[0], _UNKNOWN)
