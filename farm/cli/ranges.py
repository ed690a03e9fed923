"""`farm ranges`: prints every range of a style in the format of a description."""

from typing import Annotated

import tomli_w
import typer

from farm.spec.dataset_spec import DEFAULT_STYLE
from farm.spec.styles import RANGES_OF, Style


def ranges(
    style: Annotated[Style, typer.Option(help="Style whose ranges to print.")] = DEFAULT_STYLE,
) -> None:
    """Print every range that scenes are sampled from, as TOML: change some, and give the file to farm run or submit."""
    description = {"style": style.value, "ranges": RANGES_OF[style].model_dump(mode="json", exclude_none=True)}
    typer.echo(tomli_w.dumps(description), nl=False)
