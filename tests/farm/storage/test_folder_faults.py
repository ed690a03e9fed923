"""What is told of a folder that can't be used: what is in the way, and what to do."""

import errno
import os
import socket
import tempfile
from collections.abc import Callable
from pathlib import Path

import pytest

from farm.dataset.dataset import create_dataset, open_dataset
from farm.dataset.destination import parse_destination
from farm.errors import DestinationError
from farm.spec.header import DatasetHeader
from farm.storage.folder_faults import find_folder, folder_error


def _file(place: Path) -> Path:
    place.write_text("")
    return place


def _pipe(place: Path) -> Path:
    os.mkfifo(place)
    return place


def _socket(place: Path) -> Path:
    # A socket's path must be short.
    short = Path(tempfile.mkdtemp(prefix="farm-", dir="/tmp")) / "s"
    with socket.socket(socket.AF_UNIX) as made:
        made.bind(str(short))
    place.symlink_to(short)
    return place


@pytest.mark.parametrize("below", ["", "ds", "more/ds"])
@pytest.mark.parametrize(
    ("make", "kind"),
    [
        (_file, "a file"),
        (_pipe, "a pipe"),
        (_socket, "a socket"),
        (lambda _: Path("/dev/null"), "a device"),
    ],
)
def test_place_that_is_no_folder(
    tmp_path: Path, header: DatasetHeader, make: Callable[[Path], Path], kind: str, below: str
) -> None:
    """A dataset at or below a file, pipe, socket or device is refused, and the line says what it is."""
    blocker = make(tmp_path / "place").resolve()
    with pytest.raises(DestinationError, match=f"{blocker} is {kind}, not a folder; choose another place"):
        create_dataset(parse_destination(str(blocker / below)), header)
    with pytest.raises(DestinationError, match=f"{blocker} is {kind}"):
        open_dataset(parse_destination(str(blocker / below)))


@pytest.mark.parametrize(
    ("number", "advice"),
    [
        (errno.EACCES, "Permission denied; check its owner and permissions"),
        (errno.EPERM, "Operation not permitted; check its owner and permissions"),
        (errno.EROFS, "Read-only file system; choose a place that can be written"),
        (errno.ENOSPC, "No space left on device; make room on that disk"),
        (errno.EDQUOT, "Disk quota exceeded; make room in that quota"),
        (errno.ENAMETOOLONG, "File name too long; choose a shorter path"),
        (errno.ESTALE, "Stale file handle; is its file server there? mount it again"),
        (errno.EXDEV, "Invalid cross-device link; check the folder's permissions and free space"),
    ],
)
def test_advice(tmp_path: Path, number: int, advice: str) -> None:
    """Each error of the system comes with what to do about it, in one line."""
    told = str(folder_error(OSError(number, os.strerror(number)), "write", tmp_path / "a"))
    assert told == f"{tmp_path / 'a'}: can't write: {advice}"


def test_path_that_is_too_long(tmp_path: Path, header: DatasetHeader) -> None:
    """A path that is longer than the system allows is refused in one line."""
    with pytest.raises(DestinationError, match="File name too long"):
        create_dataset(parse_destination(str(tmp_path / ("a" * 300) / "ds")), header)


@pytest.mark.parametrize("below", ["", "ds", "more/ds"])
def test_link_to_a_disk_that_is_away(tmp_path: Path, below: str) -> None:
    """A place that a link leads to is not made anew where the link's target is not there."""
    (tmp_path / "data").symlink_to(tmp_path / "disk/data")
    with pytest.raises(DestinationError, match=f"is a link to {tmp_path}/disk/data, which is not there"):
        parse_destination(str(tmp_path / "data" / below))
    (tmp_path / "disk/data").mkdir(parents=True)
    assert find_folder(str(tmp_path / "data" / below)) == tmp_path / "disk/data" / below


def test_ring_of_links(tmp_path: Path) -> None:
    """Links that lead to each other are no path."""
    (tmp_path / "a").symlink_to("b")
    (tmp_path / "b").symlink_to("a")
    with pytest.raises(DestinationError, match="no path"):
        parse_destination(str(tmp_path / "a/ds"))
