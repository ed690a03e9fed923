"""fsspec's filesystems: one for each place and process.

Such a filesystem has a thread with an event loop, and open sockets. None of them survives a fork: the child would wait
for a thread that is not there, and talk on its parent's sockets. So nobody keeps a filesystem: whatever needs one asks
here at each use. Before a fork all are closed, and parent and child each open their own when they next need one.
"""

import gc
import os
from functools import lru_cache
from typing import Any

import fsspec

from farm.storage.services import service_of


@lru_cache(maxsize=16)
def connect(url: str) -> tuple[Any, str]:
    """Make the filesystem of a URL, and return it with the URL's path in it. Use it at once, don't keep it.

    The path has no slash at its end. Listings are not cached: other processes write there too.

    Raises:
        ImportError: if the filesystem needs a package that is not installed.
        ValueError: if the protocol is unknown.
    """
    options = {"use_listings_cache": False, "skip_instance_cache": True, **service_of(url).open_options}
    filesystem, root = fsspec.core.url_to_fs(url, **options)
    retries = service_of(url).retries
    if retries is not None:
        filesystem.retries = retries
    return filesystem, root.rstrip("/")


def _close_all() -> None:
    if connect.cache_info().currsize:
        connect.cache_clear()
        # fsspec closes a filesystem's connections when it is collected, which its reference cycles put off.
        gc.collect()


os.register_at_fork(before=_close_all)
