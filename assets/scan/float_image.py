"""EXR and Radiance files of linear light, read and written by OpenImageIO."""

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from assets.files import read_start
from farm.errors import AssetError

if TYPE_CHECKING:
    from OpenImageIO import ImageInput, ImageSpec

FLOAT_SUFFIXES = frozenset({".exr", ".hdr"})

LARGEST_EDGE = 16384
"""Pixels along an edge above which a file is refused: 16 K is the largest size that libraries of panoramas offer."""

LARGEST_PIXELS = 2**26
"""Pixels above which a file is refused: decoding and measuring this many takes 3 GB, and 26 KB may hold them."""

LARGEST_TILE_PIXELS = 2**24
"""Pixels of a tile above which an EXR file is refused: one tile is decoded whole, however small the picture is."""

LARGEST_CHANNELS = 16
"""Channels above which an EXR file is refused: rows are decoded with all their channels, though three are kept."""

LARGEST_HEADER = 2**18
"""Bytes of an EXR header above which a file is refused: parsing time grows with the square of a header's length.

Headers of panoramas have about 1 KB."""

DWAA_LEVEL = 45
"""Strength of the lossy compression that `write_float_image` asks for, which nobody sees. It is OpenEXR's default."""

_EXR_MAGIC = b"\x76\x2f\x31\x01"
_EXR_DEEP, _EXR_MULTIPART = 0x800, 0x1000
_RADIANCE_MAGICS = (b"#?RADIANCE", b"#?RGBE")
_AGAIN = "download or export it again"
_ELSEWHERE = "make room, or use another folder"
_USUAL_ORIENTATION = 1

_standard_error = Lock()


def read_float_image(path: Path) -> NDArray[np.float32]:
    """Decode an EXR or Radiance file completely.

    The values are those that Blender's own reader gives, bit by bit.

    Args:
        path: A file whose suffix is one of `FLOAT_SUFFIXES`, in either case.

    Returns:
        Pixels, shape (height, width, 3), linear, channels red green blue, the top row first. The one channel of a grey
        file is there three times.

    Raises:
        AssetError: The file can't be read, is truncated or damaged, is too large, isn't what its suffix says, or holds
            something else than one picture with the channels R, G and B, or one channel.
    """
    _check_start(path, read_start(path, LARGEST_HEADER))
    with quiet_standard_error():
        source = _library().ImageInput.open(os.fsencode(path))
        if source is None:
            raise _undecodable(path, _library().geterror)
        try:
            channels = _checked_channels(path, source.spec())
            return _pixels(path, source, channels)
        finally:
            source.close()


def write_float_image(path: Path, pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    """Write an EXR file of half floats with DWAA compression. The same pixels give the same bytes.

    Args:
        path: The file, which ends in .exr; its folder exists.
        pixels: Shape (height, width, 3), linear, channels red green blue, the top row first.

    Returns:
        The pixels as the file holds them: rounded, and with the compression's loss.

    Raises:
        AssetError: The file can't be written, or does not read back.
    """
    library = _library()
    height, width, channels = pixels.shape
    spec = library.ImageSpec(width, height, channels, "half")
    spec.attribute("compression", f"dwaa:{DWAA_LEVEL}")
    # OpenImageIO would put the time of day there.
    spec.attribute("DateTime", "")
    target = library.ImageOutput.create("exr")
    written = target.open(os.fsencode(path), spec) and target.write_image(np.ascontiguousarray(pixels))
    if not (target.close() and written):
        raise AssetError(f"{path}: can't be written ({_reason(target.geterror)}); {_ELSEWHERE}")
    try:
        # A disk that fills up with the last few bytes shows here alone.
        return read_float_image(path)
    except AssetError as error:
        raise AssetError(f"{path}: does not read back as it was written; {_ELSEWHERE}") from error


def open_image(name: bytes) -> tuple["ImageInput | None", Callable[[], str]]:
    """Open an image by the reader of its suffix alone.

    Args:
        name: The file's path in the bytes that the disk has.

    Returns:
        The opened image, or None if it can't be opened, and a function that says in one line what went wrong.
    """
    library = _library()
    source = library.ImageInput.open(name)
    return source, lambda: _reason(library.geterror if source is None else source.geterror)


@cache
def _library() -> Any:
    """Load OpenImageIO, with the limits and readers that this module relies on."""
    import OpenImageIO  # noqa: PLC0415  # it takes 26 MB and 0.08 s, and most processes read no such file

    # A file that the reader of its suffix refuses is not given to the readers of twenty other formats.
    OpenImageIO.attribute("try_all_readers", 0)
    # By default this limit goes with the machine's memory; `_checked_channels` has one that doesn't.
    OpenImageIO.attribute("limits:imagesize_MB", 0)
    return OpenImageIO


def _check_start(path: Path, start: bytes) -> None:
    """Check the first bytes of a file for faults that OpenImageIO would find out too late."""
    suffix = path.suffix.lower()
    if suffix == ".exr":
        _check_exr_header(path, start)
    elif suffix != ".hdr":
        raise AssetError(f"{path}: ends in neither .exr nor .hdr; rename it, or export it as one of them")
    elif not start.startswith(_RADIANCE_MAGICS):
        raise AssetError(f"{path}: isn't a Radiance file, whatever its name says; {_AGAIN}")


def _check_exr_header(path: Path, start: bytes) -> None:
    """Check that a header is one of a plain file, and ends within `start`."""
    if not start.startswith(_EXR_MAGIC):
        raise AssetError(f"{path}: isn't an EXR file, whatever its name says; {_AGAIN}")
    if int.from_bytes(start[4:8], "little") & (_EXR_DEEP | _EXR_MULTIPART):
        raise AssetError(f"{path}: deep and multi-part EXR files aren't supported; export a plain one")
    place = 8
    try:
        while start[place]:
            # An attribute is its name and type, each ended by a zero, the length of its value, and the value.
            length = start.index(b"\0", start.index(b"\0", place) + 1) + 1
            place = length + 4 + int.from_bytes(start[length : length + 4], "little")
    except (IndexError, ValueError) as error:
        if len(start) < LARGEST_HEADER:
            raise AssetError(f"{path}: is truncated or damaged in its header; {_AGAIN}") from error
        raise AssetError(
            f"{path}: has a header of more than {LARGEST_HEADER // 2**10} KiB; export it without a preview and notes"
        ) from error


def _checked_channels(path: Path, spec: "ImageSpec") -> int:
    """Check the size and the channels that a header announces, before memory is taken for it.

    Returns:
        Number of channels to read: 3 or 1.
    """
    size = f"{path}: {spec.width} x {spec.height} pixels"
    if not (1 <= spec.width <= LARGEST_EDGE and 1 <= spec.height <= LARGEST_EDGE):
        raise AssetError(f"{size} is outside 1 to {LARGEST_EDGE} an edge; resize it")
    if spec.width * spec.height > LARGEST_PIXELS:
        raise AssetError(f"{size} is more than {LARGEST_PIXELS // 2**20} Mi; resize it")
    if spec.tile_width * spec.tile_height > LARGEST_TILE_PIXELS:
        raise AssetError(
            f"{path}: its tiles have {spec.tile_width} x {spec.tile_height} pixels; export it without tiles"
        )
    if spec.get_int_attribute("Orientation", _USUAL_ORIENTATION) != _USUAL_ORIENTATION:
        raise AssetError(f"{path}: is stored turned or mirrored; export it the usual way up")
    try:
        names = tuple(name.upper() for name in spec.channelnames)
    except UnicodeDecodeError as error:
        raise AssetError(f"{path}: has a channel whose name is no text; export it with R, G and B") from error
    if len(names) > LARGEST_CHANNELS:
        raise AssetError(f"{path}: has {len(names)} channels; export R, G and B alone")
    # OpenImageIO puts colours before alpha, and alpha before all else.
    channels = 3 if names[:3] == ("R", "G", "B") else 1
    if channels == 1 and len(names) != 1 and names != ("Y", "A"):
        raise AssetError(f"{path}: has the channels {', '.join(names)}; export it with R, G and B")
    if {str(spec.channelformat(channel)) for channel in range(channels)} - {"half", "float"}:
        raise AssetError(f"{path}: holds whole numbers; export it with half or float channels")
    return channels


def _pixels(path: Path, source: "ImageInput", channels: int) -> NDArray[np.float32]:
    pixels = source.read_image(0, 0, 0, channels, "float")
    if pixels is None:
        raise _undecodable(path, source.geterror)
    decoded = np.asarray(pixels, np.float32)
    return decoded if channels == 3 else np.repeat(decoded, 3, axis=2)


def _undecodable(path: Path, error: Callable[[], str]) -> AssetError:
    return AssetError(f"{path}: is truncated or damaged ({_reason(error)}); {_AGAIN}")


def _reason(error: Callable[[], str]) -> str:
    """Put OpenImageIO's message about an error in one line."""
    try:
        return " ".join(error().split())
    except UnicodeDecodeError:
        return "OpenImageIO's reason quotes bytes that are no text"


@contextmanager
def quiet_standard_error() -> Iterator[None]:
    """Keep codecs from writing about damaged files to standard error on their own; the AssetError tells of them.

    Whatever other threads write there meanwhile is lost, too.
    """
    with _standard_error:
        kept = os.dup(2)
        try:
            with Path(os.devnull).open("wb") as nowhere:
                os.dup2(nowhere.fileno(), 2)
            yield
        finally:
            os.dup2(kept, 2)
            os.close(kept)
