"""`farm ranges`: every range of a style, as a description takes them."""

from typing import Annotated

import tomli_w
import typer

from farm.spec.dataset_spec import DEFAULT_STYLE
from farm.spec.styles import RANGES_OF, Style


def ranges(
    style: Annotated[Style, typer.Option(help="Whose ranges to print.")] = DEFAULT_STYLE,
) -> None:
    """Print every range that pictures are drawn from, as TOML: change some and name the file to farm run or submit."""
    drawn_from = {"style": style.value, "ranges": RANGES_OF[style].model_dump(mode="json", exclude_none=True)}
    typer.echo(tomli_w.dumps(drawn_from), nl=False)
