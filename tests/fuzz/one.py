"""Fuzzes one target in this process, which libFuzzer then ends: TARGET FOLDER OPTIONS-OF-LIBFUZZER..."""

import json
import sys
import traceback
from pathlib import Path

import atheris

with atheris.instrument_imports(include=["assets", "farm", "tomllib", "json"]):
    from tests.fuzz.targets import targets

from farm.errors import FarmError


def main(arguments: list[str]) -> None:
    """Run libFuzzer on the target. Each kind of failure is recorded once, and doesn't end the run."""
    name, folder = arguments[0], Path(arguments[1])
    target = targets()[name]
    corpus = folder / "corpus"
    corpus.mkdir()
    for number, seed in enumerate(target.seeds):
        (corpus / f"seed-{number}").write_bytes(seed)
    known: set[tuple[str, str]] = set()

    def try_one(data: bytes) -> None:
        try:
            target.parse(data)
        except FarmError:
            pass
        except Exception as error:  # any other error is a finding
            frame = traceback.extract_tb(error.__traceback__)[-1]
            kind = (type(error).__name__, f"{frame.filename}:{frame.lineno}")
            if kind not in known:
                known.add(kind)
                entry = {"error": f"{kind[0]}: {error}"[:300], "where": kind[1], "input": data.hex()}
                with (folder / "failures.jsonl").open("a") as file:
                    file.write(json.dumps(entry) + "\n")

    atheris.Setup([sys.argv[0], *arguments[2:], str(corpus)], try_one)
    atheris.Fuzz()


if __name__ == "__main__":
    main(sys.argv[1:])
