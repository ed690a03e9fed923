"""`farm report`: writes the page of pictures, the index, and a contact sheet."""

from pathlib import Path
from typing import Annotated

import typer

from farm.cli.options import DatasetPlace
from farm.dataset.contact_sheet import make_contact_sheet
from farm.dataset.dataset import open_dataset
from farm.dataset.destination import parse_destination
from farm.dataset.paths import INDEX_FILE, REPORT_FILE
from farm.dataset.report import write_overview
from farm.storage import open_storage

_MOST_PICTURES = 10_000
"""Pictures of each category that a page may show: with more, browsers take minutes to lay it out."""

_SHEET_EDGE_PX = 192
"""Edge of a picture on the contact sheet, in pixels."""


def report(
    place: DatasetPlace,
    pictures: Annotated[
        int, typer.Option(min=0, max=_MOST_PICTURES, help="Pictures of each category on the page.")
    ] = 40,
    sheet: Annotated[Path | None, typer.Option(help="JPEG file for a contact sheet, if one is wanted.")] = None,
    columns: Annotated[int, typer.Option(min=1, max=40, help="Pictures of each category on the sheet.")] = 4,
) -> None:
    """Write report.html, the pictures beside their masks, and index.jsonl."""
    dataset = open_dataset(parse_destination(place))
    count = write_overview(dataset, pictures_per_category=pictures)
    location = dataset.storage.location
    if sheet is not None:
        open_storage(str(sheet.parent)).write(
            sheet.name, make_contact_sheet(dataset, columns=columns, edge_px=_SHEET_EDGE_PX)
        )
    typer.echo(f"{count} images: {location}/{REPORT_FILE}, {location}/{INDEX_FILE}")
