"""`python -m worker.bench stages|masks --out DIR`."""

import argparse
import sys
from pathlib import Path

from farm.errors import FarmError
from worker.bench import masks, stages
from worker.leave import leave


def main(arguments: list[str]) -> int:
    """Run one benchmark; 0 if its results are right."""
    parser = argparse.ArgumentParser(prog="python -m worker.bench", description=__doc__)
    parser.add_argument("benchmark", choices=("stages", "masks"))
    parser.add_argument("--out", type=Path, required=True, help="folder for the JSON and the plot")
    parser.add_argument("--images", type=int, help="images of each category")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    options.out.mkdir(parents=True, exist_ok=True)
    benchmark = {"stages": stages.run, "masks": masks.run}[options.benchmark]
    try:
        return benchmark(options.out, images=options.images, seed=options.seed)
    except FarmError as error:
        sys.stderr.write(f"{error}\n")
        return error.exit_code


if __name__ == "__main__":
    leave(main(sys.argv[1:]))
