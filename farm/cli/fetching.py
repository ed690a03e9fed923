"""`farm assets fetch`: downloads HDRIs and textures from public libraries."""

from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from assets.fetch.fetch import Fetcher, is_whole
from assets.fetch.registry import Asset, Kind, Registry, own_registry, read_registry
from farm.cli.display import console
from farm.errors import AssetError
from farm.machine import cache_folder

_MIB = 2**20
_LABELS = {Kind.HDRI: "HDRI", Kind.TEXTURE: "texture"}


def fetch(
    names: Annotated[
        list[str] | None, typer.Argument(metavar="[NAME]...", help="Names of HDRIs and textures; none means all.")
    ] = None,
    list_them: Annotated[bool, typer.Option("--list", help="Only list what can be fetched.")] = False,
    to: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Folder for the files; default: in the user's cache.")
    ] = None,
    mirror: Annotated[
        str | None, typer.Option(metavar="URL", help="Server to ask in place of all others, with the same paths.")
    ] = None,
    registry: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Your own registry, in the format of the farm's.")
    ] = None,
) -> None:
    """Fetch HDRIs and textures from public libraries, each checked against the checksum registered here."""
    known = own_registry() if registry is None else read_registry(registry)
    assets = known.find(names or [])
    root = (to or cache_folder() / "fetched").absolute()
    if list_them:
        console(results=True).print(_table(assets, root))
        return
    failed = _fetch(assets, known, root, mirror)
    for kind in Kind:
        count = sum(asset.kind is kind and _is_there(asset, root) for asset in assets)
        if count:
            folder = root / kind.folder
            label = _LABELS[kind] + ("" if count == 1 else "s")
            typer.echo(f"{count} {label} in {folder}; add to a dataset with --{kind.folder} {folder}")
    if failed:
        raise AssetError(
            f"{len(failed)} of {len(assets)} could not be fetched ({', '.join(failed)}); what is wrong is told above"
        )


def _fetch(assets: tuple[Asset, ...], registry: Registry, root: Path, mirror: str | None) -> list[str]:
    """Fetch assets one after another; a failure does not stop the next ones.

    Args:
        assets: assets to fetch.
        registry: registry that lists them.
        root: folder for the files.
        mirror: address of the server to ask in place of all others, if any.

    Returns:
        Names of the assets that failed.

    Raises:
        AssetError: if there is one asset and it failed, or if the mirror is not an address.
    """
    failed: list[str] = []
    screen = console()
    with Fetcher(registry, root, mirror) as fetcher:
        for asset in assets:
            try:
                with screen.status(f"fetching {asset.name}"):
                    outcome = fetcher.fetch(asset)
            except AssetError as error:
                if len(assets) == 1:
                    raise AssetError(f"{asset.name}: {error}") from error
                screen.print(f"{asset.name}: {error}", markup=False)
                failed.append(asset.name)
            else:
                typer.echo(f"{asset.name}: {outcome}")
    return failed


def _table(assets: tuple[Asset, ...], root: Path) -> Table:
    table = Table("asset", "kind", "MiB", "licence", "author", "source", "here", box=None, pad_edge=False)
    for asset in assets:
        size = sum(entry.bytes for entry in asset.file) / _MIB
        here = "yes" if _is_there(asset, root) else "no"
        table.add_row(asset.name, asset.kind, f"{size:.1f}", asset.licence, asset.author, asset.source, here)
    return table


def _is_there(asset: Asset, root: Path) -> bool:
    return all(is_whole(root / asset.kind.folder / entry.file, entry) for entry in asset.file)
