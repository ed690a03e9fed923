"""`python -m tests.fuzz`: coverage-guided fuzzing of every parser, with a table and `fuzz.json` at the end.

Exit codes: 0 nothing was found, 1 an input raised something else than a FarmError, 2 atheris is not installed.
"""

import argparse
import importlib.util
import json
import re
import subprocess
import sys
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path

MOST_BYTES = 8192
_STATE = re.compile(r"^#(\d+)\s+\w+\s+cov: (\d+) ft: \d+ corp: (\d+)/", re.MULTILINE)
_TIME_S = 60.0  # seconds that a target may take to start and end, beyond the time that it is fuzzed


@dataclass(frozen=True)
class Result:
    """What fuzzing one target showed.

    Attributes:
        target: name of the target.
        inputs: number of inputs that were tried.
        coverage: number of branches of the farm's code that were reached.
        corpus: number of inputs that were kept since each reached something new.
        failures: one failure of each kind: the error, where it was raised, and the input in hexadecimal digits.
    """

    target: str
    inputs: int
    coverage: int
    corpus: int
    failures: tuple[dict[str, str], ...]


def fuzz(target: str, *, runs: int, seconds: int, seed: int) -> Result:
    """Fuzz one target in a process of its own, since the fuzzer ends its process."""
    with tempfile.TemporaryDirectory(prefix="farm-fuzz-") as folder:
        limits = [f"-runs={runs}", f"-max_total_time={seconds}", f"-seed={seed}", f"-max_len={MOST_BYTES}"]
        command = [sys.executable, "-m", "tests.fuzz.one", target, folder, *limits]
        done = subprocess.run(
            command, capture_output=True, text=True, errors="replace", check=False, timeout=seconds + _TIME_S
        )
        states = _STATE.findall(done.stderr)
        found = Path(folder) / "failures.jsonl"
        failures = [json.loads(line) for line in found.read_text().splitlines()] if found.exists() else []
        if done.returncode != 0 or not states:
            # Other codes are a crash of the interpreter, an input that takes too long, or too much memory.
            failures.append({"error": done.stderr.strip()[-500:], "where": f"exit code {done.returncode}", "input": ""})
        inputs, coverage, corpus = map(int, states[-1]) if states else (0, 0, 0)
    return Result(target, inputs, coverage, corpus, tuple(failures))


def main(arguments: list[str]) -> int:
    """Fuzz all targets, or the named ones; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--runs", type=int, default=-1, help="inputs for each target; default: as many as time allows")
    parser.add_argument("--seconds", type=int, default=30, help="for each target")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--target", action="append", help="one target alone; repeat it")
    parser.add_argument("--out", type=Path, default=Path("bench"))
    options = parser.parse_args(arguments)
    if importlib.util.find_spec("atheris") is None:
        sys.stderr.write("fuzz: atheris is not installed; run: pip install 'cable-farm[fuzz]'\n")
        return 2
    from tests.fuzz.targets import targets  # noqa: PLC0415  # it makes a dataset, which --help can do without

    results = []
    print(f"{'target':20}{'inputs':>10}{'branches':>10}{'corpus':>8}{'failures':>10}")
    for name in options.target or targets():
        result = fuzz(name, runs=options.runs, seconds=options.seconds, seed=options.seed)
        results.append(result)
        print(f"{name:20}{result.inputs:10}{result.coverage:10}{result.corpus:8}{len(result.failures):10}", flush=True)
        for failure in result.failures:
            print(f"    {failure['error']}\n    at {failure['where']}, input {failure['input'][:200]}")
    options.out.mkdir(parents=True, exist_ok=True)
    report = {
        "seconds_each": options.seconds,
        "runs_each": options.runs,
        "seed": options.seed,
        "targets": [asdict(result) for result in results],
    }
    (options.out / "fuzz.json").write_text(json.dumps(report, indent=1) + "\n")
    return 1 if any(result.failures for result in results) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
