"""Translates the failures of folders into the farm's own errors: what is in the way, and what to do about it."""

import errno
import os
import stat
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from types import MappingProxyType

from farm.errors import DestinationError

_ADVICE: Mapping[int, str] = MappingProxyType(
    {
        errno.EACCES: "check its owner and permissions",
        errno.EPERM: "check its owner and permissions",
        errno.EROFS: "choose a place that can be written",
        errno.ENOSPC: "make room on that disk",
        errno.EDQUOT: "make room in that quota",
        errno.ENAMETOOLONG: "choose a shorter path",
        errno.ELOOP: "remove the link that leads to itself",
        errno.EISDIR: "move that folder away",
        errno.EIO: "check the disk",
        errno.ESTALE: "is its file server there? mount it again",
        errno.ENOTCONN: "is its file server there? mount it again",
    }
)
"""What to do, by the system's error number."""

_USUAL_ADVICE = "check the folder's permissions and free space"

_KINDS = (
    (stat.S_ISREG, "a file"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
)


def find_folder(text: str) -> Path:
    """Find the folder that a person names: `~` and links are resolved.

    Raises:
        DestinationError: if it is no path, or leads through a link whose target is not there.
    """
    try:
        named = Path(text).expanduser().absolute()
        folder = named.resolve()
        lost = lost_link(named)
    except (ValueError, RuntimeError, OSError) as error:
        # A NUL byte, an unknown user's home, a ring of links.
        raise DestinationError(f"{text!a}: no path: {error}") from error
    if lost:
        raise lost_link_error(lost, "use", named)
    return folder


def folder_error(error: OSError, action: str, place: Path) -> DestinationError:
    """Make the farm's error out of the system's.

    Args:
        error: the system's error.
        action: verb of the failed action, as in "can't read".
        place: path of the file or folder.
    """
    if link := lost_link(place):
        return lost_link_error(link, action, place)
    if blocker := _blocker(place):
        path, kind = blocker
        return DestinationError(f"{place}: can't {action}: {path} is {kind}, not a folder; choose another place")
    reason = error.strerror or str(error)
    return DestinationError(f"{place}: can't {action}: {reason}; {_ADVICE.get(error.errno or 0, _USUAL_ADVICE)}")


def lost_link_error(link: Path, action: str, place: Path) -> DestinationError:
    """Make the error of a path that leads through a link whose target is away."""
    through = "it" if link == place else str(link)
    return DestinationError(
        f"{place}: can't {action}: {through} is a link to {_target(link)}, which is not there; is its disk mounted?"
    )


def lost_link(place: Path, below: Path | None = None) -> Path | None:
    """Find the link in a path whose target is not there.

    Args:
        place: the path.
        below: folder above which no link is looked for; None looks everywhere.
    """
    for path in (place, *place.parents):
        with suppress(OSError):
            # Where the system finds this, it found all above.
            return path if stat.S_ISLNK(os.lstat(path).st_mode) and _leads_nowhere(path) else None
        if path == below:
            break
    return None


def _leads_nowhere(link: Path) -> bool:
    try:
        link.stat()
    except (FileNotFoundError, NotADirectoryError):
        return True
    except OSError:
        # The target may be there: this user may not look at it, or its server is away.
        return False
    return False


def _blocker(place: Path) -> tuple[Path, str] | None:
    """Find what stands where a path needs a folder."""
    for path in reversed(place.parents):
        try:
            mode = path.stat().st_mode
        except OSError:
            return None
        for is_kind, kind in _KINDS:
            if is_kind(mode):
                return path, kind
    return None


def _target(link: Path) -> str:
    try:
        return str(link.readlink())
    except OSError:
        return "another place"
