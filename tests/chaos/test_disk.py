import errno
from pathlib import Path

import pytest

from tests.chaos.disk import small_disk


def test_full_and_freed(tmp_path: Path) -> None:
    """Nothing can be written to a full disk, and everything again once it is freed."""
    with small_disk(tmp_path, 1) as disk:
        if isinstance(disk, str):
            pytest.skip(disk)
        disk.fill()
        with pytest.raises(OSError, match="No space") as caught:
            (tmp_path / "file").write_bytes(b"1")
        assert caught.value.errno == errno.ENOSPC
        disk.free()
        (tmp_path / "file").write_bytes(b"1")
    assert list(tmp_path.iterdir()) == []
