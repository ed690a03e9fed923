"""The command `farm`, under a name that no other project has: Python may find another `farm` on its path."""

import sys
from pathlib import Path


def main() -> None:
    """Run the command line with the packages that lie beside this file."""
    sys.path.insert(0, str(Path(__file__).resolve().parent))
    try:
        from farm.start import prepare  # noqa: PLC0415 - found in the folder above
    except ImportError:
        # Something that ran before has imported another package of this name; its code is 14, that of MachineError.
        found = getattr(sys.modules.get("farm"), "__file__", None)
        sys.stderr.write(f"farm: {found}: stands in the place of the farm's own package; take it off Python's path\n")
        sys.exit(14)
    prepare()
    from farm.cli import main as run_command  # noqa: PLC0415 - the path had to be in order first

    run_command()
