"""The installed program."""

import subprocess
import sys
from pathlib import Path

from farm.errors import DestinationError


def test_entry_point(tmp_path: Path) -> None:
    """The installed program ends with its command's exit code."""
    program = [str(Path(sys.executable).with_name("farm")), "status", "data"]
    result = subprocess.run(program, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert result.returncode == DestinationError.exit_code
    assert result.stderr.startswith("farm: ")
