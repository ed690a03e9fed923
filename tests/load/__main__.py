"""`python -m tests.load jobs|submit|read --out DIR`: fails on wrong results, never on slow ones."""

import argparse
import sys
from pathlib import Path

from benchmarks.terminal import bench_console
from farm.errors import FarmError
from tests.load.jobs import measure_jobs
from tests.load.reading import measure_reading
from tests.load.report import jobs_table, plot_jobs, plot_submissions, reading_table, submission_table, write_json
from tests.load.submission import measure_submission


def main(arguments: list[str]) -> int:
    """Run one benchmark and return its exit code: 0 if its results are right."""
    parser = argparse.ArgumentParser(prog="python -m tests.load", description=__doc__)
    commands = parser.add_subparsers(dest="benchmark", required=True)
    shared = argparse.ArgumentParser(add_help=False)
    shared.add_argument("--out", type=Path, required=True, help="folder for the JSON and the plot")
    shared.add_argument("--seed", type=int, default=0)
    jobs = commands.add_parser("jobs", parents=[shared], help="jobs a second and their overhead")
    jobs.add_argument("--workers", type=int, nargs="+", default=[1, 2, 4, 8])
    jobs.add_argument("--jobs", type=int, default=2000)
    submit = commands.add_parser("submit", parents=[shared], help="farm submit by its size")
    submit.add_argument("--images", type=int, nargs="+", default=[1000, 10_000, 25_000, 100_000, 1_000_000])
    read = commands.add_parser("read", parents=[shared], help="farm status, report and verify by a dataset's size")
    read.add_argument("--images", type=int, nargs="+", default=[25_000, 1_000_000])
    read.add_argument("--latency-ms", type=float, nargs="+", default=[20.0, 0.0], help="of the store, for each size")
    options = parser.parse_args(arguments)
    options.out.mkdir(parents=True, exist_ok=True)
    console = bench_console()
    try:
        if options.benchmark == "jobs":
            jobs_costs = [measure_jobs(number, options.jobs, options.seed) for number in options.workers]
            console.print(jobs_table(jobs_costs))
            write_json(options.out / "queue.json", jobs_costs, options.seed)
            plot_jobs(options.out / "queue.png", jobs_costs)
        elif options.benchmark == "read":
            sizes = zip(options.images, options.latency_ms, strict=True)
            reading_costs = [cost for images, latency_ms in sizes for cost in measure_reading(images, latency_ms)]
            console.print(reading_table(reading_costs))
            write_json(options.out / "read.json", reading_costs, options.seed)
        else:
            costs = [measure_submission(images, options.seed) for images in options.images]
            console.print(submission_table(costs))
            write_json(options.out / "submit.json", costs, options.seed)
            plot_submissions(options.out / "submit.png", costs)
    except FarmError as error:
        sys.stderr.write(f"{error}\n")
        return error.exit_code
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
