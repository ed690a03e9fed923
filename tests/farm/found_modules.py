"""A program that `farm.start` runs: it tells where modules are found, and imports none of them."""

import importlib.util
import json
import os
import sys


def main(names: list[str]) -> None:
    """Print the modules' files, and the variables that this process sees, as JSON."""
    origins = {name: getattr(importlib.util.find_spec(name), "origin", None) for name in names}
    sys.stdout.write(json.dumps({"origins": origins, "environment": dict(os.environ)}))
