"""`farm assets`: lists and builds the built-in surfaces and environments, and checks the user's own files."""

from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from assets.environments import DEFAULT_WIDTH, ENVIRONMENTS, LARGEST_WIDTH, SMALLEST_WIDTH, missing_environments
from assets.scan.hdris import registry
from assets.scan.photographs import scan_plates
from assets.surfaces.baked import load_baked, surface_directory
from assets.surfaces.catalogue import SURFACES
from farm.cli.baking import bake, render_environments
from farm.cli.display import console
from farm.cli.fetching import fetch
from farm.cli.installed_assets import InstalledAssets
from farm.cli.options import Assets
from farm.cli.worker_program import blender_is_installed
from farm.errors import AssetError, SpecError

assets_app = typer.Typer(no_args_is_help=True, help="List and build the built-in surfaces and HDRIs; check your own.")
assets_app.command()(fetch)


@assets_app.command("list")
def list_assets(assets: Assets = None) -> None:
    """List the built-in surfaces, HDRIs and environments."""
    folder = assets or surface_directory()
    try:
        baked = set(load_baked(folder))
    except AssetError:
        baked = set()
    surfaces = Table("surface", "made of", "edge", "drawn", box=None, pad_edge=False)
    for recipe in SURFACES.values():
        drawn = "yes" if recipe.name in baked else "not yet"
        surfaces.add_row(recipe.name, recipe.family, f"{recipe.size_m * 100:.0f} cm", drawn)
    hdris = Table("HDRI", "licence", "author", "source", box=None, pad_edge=False)
    for hdri in registry():
        hdris.add_row(hdri.name, hdri.licence, hdri.author, hdri.source)
    rooms = Table("environment", "shows", "rendered", box=None, pad_edge=False)
    lacking = {recipe.name for recipe in missing_environments(folder, None)}
    for room in ENVIRONMENTS.values():
        rooms.add_row(room.name, room.kind.replace("_", " "), "not yet" if room.name in lacking else "yes")
    screen = console(results=True)
    for table in (surfaces, hdris, rooms):
        screen.print(table)
        screen.print()


@assets_app.command()
def build(
    assets: Assets = None,
    environments: Annotated[
        bool, typer.Option("--environments/--no-environments", help="Render the environments too, if Blender is here.")
    ] = True,
    pixels: Annotated[
        int, typer.Option(min=SMALLEST_WIDTH, max=LARGEST_WIDTH, help="Width of the environments' panoramas, even.")
    ] = DEFAULT_WIDTH,
) -> None:
    """Draw every built-in surface, and render every environment, that is not on this machine yet."""
    baked = bake(SURFACES, assets, console())
    typer.echo(f"{len(baked.surfaces)} surfaces in {baked.directory}, {len(baked.drawn)} of them drawn now")
    if not environments:
        return
    if not blender_is_installed():
        typer.echo("environments: left out, as Blender (bpy) is not installed here")
        return
    rendered = render_environments(ENVIRONMENTS, assets, console(), pixels=pixels)
    typer.echo(f"{len(ENVIRONMENTS)} environments, {len(rendered)} of them rendered now")


@assets_app.command()
def check(
    textures: Annotated[list[Path] | None, typer.Option(metavar="DIR", help="Folder of PBR textures.")] = None,
    hdris: Annotated[list[Path] | None, typer.Option(metavar="DIR", help="Folder of .hdr and .exr files.")] = None,
    backgrounds: Annotated[list[Path] | None, typer.Option(metavar="DIR", help="Folder of photographs.")] = None,
) -> None:
    """Check your own textures, HDRIs and photographs before a dataset uses them."""
    if not textures and not hdris and not backgrounds:
        raise SpecError("name a folder to check: --textures DIR, --hdris DIR or --backgrounds DIR")
    source = InstalledAssets()
    for folder in textures or ():
        for surface in source.surfaces_in(folder):
            typer.echo(f"surface {surface.name}: {', '.join(surface.files)}")
    for folder in hdris or ():
        for hdri in source.hdris_in(folder):
            typer.echo(f"HDRI {hdri.name}: {'dark' if hdri.dark else 'bright'}")
    for folder in backgrounds or ():
        for plate in scan_plates(folder):
            typer.echo(f"photograph {plate.name}: {plate.width} x {plate.height}")
