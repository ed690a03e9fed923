"""`farm assets`: lists and builds the built-in surfaces and environments, and checks the user's own files."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, TypeVar

import typer
from rich.table import Table

from assets.environments import DEFAULT_WIDTH, ENVIRONMENTS, LARGEST_WIDTH, SMALLEST_WIDTH, missing_environments
from assets.scan.hdris import registry, survey_hdris
from assets.scan.photographs import survey_plates
from assets.scan.survey import Survey
from assets.scan.textures import TextureSet, survey_textures
from assets.surfaces.baked import load_baked, surface_directory
from assets.surfaces.catalogue import SURFACES
from farm.cli.baking import bake, render_environments
from farm.cli.display import console, one_line
from farm.cli.fetching import fetch
from farm.cli.options import Assets
from farm.cli.worker_program import blender_is_installed
from farm.errors import AssetError, SpecError

T = TypeVar("T")

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
    """Check your own textures, HDRIs and photographs before a dataset uses them, and list what it would leave out."""
    if not textures and not hdris and not backgrounds:
        raise SpecError("name a folder to check: --textures DIR, --hdris DIR or --backgrounds DIR")
    faults = [
        *_check(textures, survey_textures, _of_surface),
        *_check(hdris, survey_hdris, lambda hdri: f"HDRI {hdri.name}: {'dark' if hdri.dark else 'bright'}"),
        *_check(backgrounds, survey_plates, lambda plate: f"photograph {plate.name}: {plate.width} x {plate.height}"),
    ]
    if faults:
        others = f" ({len(faults) - 1} more are listed above)" if len(faults) > 1 else ""
        raise AssetError(one_line(f"{faults[0]}{others}"))


def _of_surface(texture: TextureSet) -> str:
    return f"surface {texture.name}: {', '.join(entry.role for entry in texture.maps)}"


def _check(folders: list[Path] | None, survey: Callable[[Path], Survey[T]], line_of: Callable[[T], str]) -> list[str]:
    """Print what folders hold and each file that is left out; return what is wrong with them."""
    faults = []
    for folder in folders or ():
        try:
            holds = survey(folder)
        except AssetError as error:
            typer.echo(one_line(f"can not be used: {error}"))
            faults.append(str(error))
            continue
        for entry in holds.found:
            typer.echo(one_line(line_of(entry)))
        for left_out in holds.left_out:
            typer.echo(one_line(f"{'can not be used' if left_out.broken else 'left aside'}: {left_out.message}"))
        wrong = [left_out.message for left_out in holds.left_out if left_out.broken]
        if not wrong and not holds.found:
            wrong = [f"{folder}: holds nothing that can be used; name the folder that holds your files"]
        faults += wrong
    return faults
