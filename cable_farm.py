"""The command `farm`, under a name that no other project has: Python may find another `farm` on its path."""

import sys
from pathlib import Path


def main() -> None:
    """Run the command line with the packages that lie beside this file."""
    # Before all that the user has put there, and after the script's own folder, which comes first unless it is unsafe.
    sys.path.insert(0 if sys.flags.safe_path else 1, str(Path(__file__).resolve().parent))
    from farm.start import run_command  # noqa: PLC0415 - found in the folder above

    run_command()
