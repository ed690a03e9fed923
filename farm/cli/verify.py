"""`farm verify`: checks every file of a dataset against its manifest."""

from collections import Counter
from collections.abc import Callable, Sequence

import typer
from rich.progress import Progress

from farm.cli.display import console
from farm.cli.options import AsJson, DatasetPlace
from farm.dataset.dataset import open_dataset
from farm.dataset.destination import parse_destination
from farm.dataset.verify import Fault, Verdict
from farm.dataset.verify import verify as verify_dataset
from farm.errors import IncompleteError, VerificationError

_SHOWN = 50
"""Findings listed at most in the error message; `--json` lists all."""

_REMEDIES: Sequence[tuple[frozenset[Fault], Callable[[str], str]]] = (
    (
        frozenset({Fault.TRUNCATED, Fault.ALTERED}),
        lambda place: f"farm repair --checksums {place} has the damaged pictures made again",
    ),
    (frozenset({Fault.MISSING}), lambda _: "run or submit it again to make what is missing"),
    (frozenset({Fault.EXTRA}), lambda _: "the farm never uses extra files, and leaves them alone: they may be yours"),
)
"""What to do about findings, by their faults. None removes a file that may be anybody's data."""


def verify(place: DatasetPlace, as_json: AsJson = False) -> None:
    """Check every file's size, checksum and pixels; list what is missing, extra, truncated or altered."""
    dataset = open_dataset(parse_destination(place))
    screen = console()
    with Progress(console=screen, disable=not screen.is_terminal, transient=True) as bar:
        task = bar.add_task("checking", total=dataset.header.spec.total)
        verdict = verify_dataset(dataset, lambda count: bar.update(task, completed=count))
    if as_json:
        typer.echo(verdict.model_dump_json(indent=1))
    if not verdict.clean:
        raise VerificationError(_summary(verdict, listed=not as_json))
    if verdict.quarantined:
        raise IncompleteError(
            f"{verdict.location}: {verdict.images} images, every file agrees with its manifest; "
            f"{len(verdict.quarantined)} are in quarantine; farm status tells why, farm retry puts them back"
        )
    if not as_json:
        typer.echo(f"{verdict.location}: {verdict.images} images, every file agrees with its manifest")


def _summary(verdict: Verdict, *, listed: bool) -> str:
    counts = Counter(finding.fault for finding in verdict.findings)
    words = ", ".join(f"{count} {fault}" for fault, count in counts.items())
    remedies = "; ".join(remedy(verdict.location) for faults, remedy in _REMEDIES if faults & counts.keys())
    sound = f"{verdict.images} of {verdict.quota} images are as they should be"
    lines = [f"{verdict.location}: {words}; {sound}; {remedies}"]
    if listed:
        findings = verdict.findings
        lines += [f"  {finding.fault}: {finding.path} ({finding.detail})" for finding in findings[:_SHOWN]]
        if len(findings) > _SHOWN:
            lines.append(f"  and {len(findings) - _SHOWN} more; --json lists all")
    return "\n".join(lines)
