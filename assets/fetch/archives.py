"""Read one file out of a tar or zip archive. A name in the archive never decides where a file is written."""

import lzma
import tarfile
import zipfile
import zlib
from pathlib import Path

from farm.errors import AssetError


def read_member(archive: Path, shown: str, member: str, size: int) -> bytes:
    """Read one regular file of a known size.

    Args:
        archive: A zip file, or a tar file of any compression.
        shown: Name of the archive in error messages; an ending of .zip or .whl means zip, any other tar.
        member: Full name of the file inside the archive.
        size: Size of the file in bytes; no more are read.

    Returns:
        The file's content, exactly `size` bytes.

    Raises:
        AssetError: The archive is damaged, or `member` is missing from it, a link, a folder or of another size.
    """
    reader = _from_zip if shown.endswith((".zip", ".whl")) else _from_tar
    try:
        data = reader(archive, member, size)
    except KeyError as error:
        raise AssetError(f"{shown}: holds no {member}; the registry names another archive than this") from error
    except (
        *(OSError, EOFError, ValueError, RuntimeError, NotImplementedError),
        *(tarfile.TarError, zipfile.BadZipFile, zlib.error, lzma.LZMAError),
    ) as error:
        raise AssetError(f"{shown}: {member} can't be read from it ({error}); the archive is damaged") from error
    if data is None:
        raise AssetError(f"{shown}: {member} isn't a file of {size} bytes, as registered; nothing was kept")
    return data


def _from_tar(archive: Path, member: str, size: int) -> bytes | None:
    with tarfile.open(archive) as tar:
        entry = tar.getmember(member)
        if not entry.isreg() or entry.size != size:
            return None
        file = tar.extractfile(entry)
        data = file.read(size) if file is not None else b""
    return data if len(data) == size else None


def _from_zip(archive: Path, member: str, size: int) -> bytes | None:
    with zipfile.ZipFile(archive) as packed:
        entry = packed.getinfo(member)
        if entry.is_dir() or entry.file_size != size:
            return None
        with packed.open(entry) as file:
            # The size checked above is only what the archive claims, so read one byte more to notice a longer file.
            data = file.read(size + 1)
    return data if len(data) == size else None
