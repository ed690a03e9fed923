"""Storage of a dataset's files: a local folder, or any filesystem that fsspec knows by its URL.

A reader never sees half a file. A local folder gets a temporary file beside the target, which is flushed, read back
and moved into place; an object store gets each object in one put, or in parts that count only once all are there, and
is asked what it holds afterwards. A killed writer's leftover has a name that starts with `TEMPORARY_PREFIX`,
or is no object at all, and counts for nothing.
"""

from farm.storage.folder_faults import find_folder
from farm.storage.local import LocalStorage
from farm.storage.location import open_storage, refuse_credentials
from farm.storage.many import in_order
from farm.storage.objects import ObjectStorage
from farm.storage.port import TEMPORARY_PREFIX, Storage, StoredFile, is_temporary
from farm.storage.streams import read_parts, scan, write_parts

__all__ = [
    "TEMPORARY_PREFIX",
    "LocalStorage",
    "ObjectStorage",
    "Storage",
    "StoredFile",
    "find_folder",
    "in_order",
    "is_temporary",
    "open_storage",
    "read_parts",
    "refuse_credentials",
    "scan",
    "write_parts",
]
