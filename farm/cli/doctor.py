"""`farm doctor`: what this machine has and lacks."""

from pathlib import Path

import typer
from pydantic_core import to_json
from rich.markup import escape

from farm.cli.display import console
from farm.cli.options import AsJson
from farm.doctor import examine
from farm.errors import EnvironmentMissingError


def doctor(as_json: AsJson = False) -> None:
    """Tell what this machine has and lacks, and the command that mends each lack."""
    screen = console(results=True)
    with console().status("looking"):
        checks = examine(Path.cwd())
    if as_json:
        typer.echo(to_json([check.model_dump() for check in checks], indent=1).decode())
    else:
        for check in checks:
            mark = "[green]ok     [/]" if check.ok else "[red]missing[/]" if check.needed else "[yellow]lacking[/]"
            screen.print(f"{mark}  {check.name}: {escape(check.detail)}")
            if check.remedy:
                screen.print(f"         -> {escape(check.remedy)}")
    missing = [check.name for check in checks if check.needed and not check.ok]
    if missing:
        raise EnvironmentMissingError(f"this machine can't render yet; it lacks {', '.join(missing)}")
