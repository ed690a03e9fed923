"""`farm report`: the page of pictures and the index."""

from typing import Annotated

import typer

from farm.cli.options import DatasetPlace
from farm.collect import write_index
from farm.dataset import open_dataset, parse_destination
from farm.layout import INDEX_FILE, REPORT_FILE
from farm.report import write_report


def report(
    place: DatasetPlace,
    pictures: Annotated[int, typer.Option(min=0, help="Pictures shown of each category.")] = 40,
) -> None:
    """Write report.html, the pictures beside their masks, and index.jsonl."""
    dataset = open_dataset(parse_destination(place))
    write_index(dataset)
    count = write_report(dataset, pictures_per_category=pictures)
    location = dataset.storage.location
    typer.echo(f"{count} images: {location}/{REPORT_FILE}, {location}/{INDEX_FILE}")
