"""Draws the built-in surfaces and renders the environments that this machine does not have yet; each is made once."""

from collections.abc import Iterable
from pathlib import Path

from rich.console import Console
from rich.progress import Progress

from assets.environments import DEFAULT_WIDTH, FOLDER_NAME, missing_environments
from assets.surfaces.bake import BakedSet, bake_surfaces
from assets.surfaces.baked import surface_directory
from farm.cli.options import log_folder
from farm.cli.worker_program import ask_worker, require_blender
from farm.spec.category import Background, Light
from farm.spec.header import BuiltinSurfaceRef, DatasetHeader


def bake(names: Iterable[str], folder: Path | None, screen: Console) -> BakedSet:
    """Draw the surfaces that are missing, and show a progress bar.

    Args:
        names: names of the surfaces; those that exist already take no time.
        folder: folder of the surfaces; None for the default one in the user's cache.
        screen: console for the bar, on a terminal, and for the closing line.

    Returns:
        The surfaces asked for, and which of them were drawn now.

    Raises:
        AssetError: if the folder can't be written.
    """
    wanted = list(names)
    directory = folder or surface_directory()
    with Progress(console=screen, disable=not screen.is_terminal, transient=True) as bar:
        task = bar.add_task("preparing the surfaces, once", total=len(wanted))
        baked = bake_surfaces(directory, names=wanted, progress=lambda _: bar.advance(task))
    if baked.drawn:
        screen.print(f"{len(baked.drawn)} surfaces drawn into {directory}", markup=False)
    return baked


def render_environments(
    names: Iterable[str], folder: Path | None, screen: Console, *, pixels: int | None = None
) -> tuple[str, ...]:
    """Render the environments that are missing, in another process, and show a progress bar.

    Args:
        names: names of the environments; those that exist already take no time.
        folder: folder of the surfaces, which holds the environments too; None for the default one in the user's cache.
        screen: console for the bar, on a terminal, and for the closing line.
        pixels: width of the panoramas, px; None accepts existing ones of any width, and renders at the default width.

    Returns:
        Names of the environments that were rendered now.

    Raises:
        AssetError: if the folder can't be written.
        MachineError: if Blender is not installed.
        FarmError: if the worker's program fails.
    """
    directory = folder or surface_directory()
    missing = [recipe.name for recipe in missing_environments(directory, pixels, tuple(names))]
    if not missing:
        return ()
    require_blender()
    wanted = [word for name in missing for word in ("--name", name)]
    with Progress(console=screen, disable=not screen.is_terminal, transient=True) as bar:
        task = bar.add_task("rendering the environments, once", total=len(missing))
        ask_worker(
            ["environments", "--out", str(directory), "--pixels", str(pixels or DEFAULT_WIDTH), *wanted],
            None,
            log_folder(None),
            told=lambda _: bar.advance(task),
        )
    screen.print(f"{len(missing)} environments rendered into {directory / FOLDER_NAME}", markup=False)
    return tuple(missing)


def bake_for(header: DatasetHeader, folder: Path | None, screen: Console) -> None:
    """Draw the surfaces that a dataset shows, and render the environments that light it.

    Args:
        header: header of the dataset; categories without a quota need nothing.
        folder: folder of the surfaces and environments; None for the default one in the user's cache.
        screen: console for the progress bars.

    Raises:
        AssetError: if the folder can't be written.
        MachineError: if environments are missing and Blender is not installed.
        FarmError: if the worker's program fails.
    """
    shown = [category.traits for category, quota in header.spec.quotas.items() if quota]
    environments = [hdri.name for hdri in header.hdris if hdri.recipe_version is not None]
    if environments and any(traits.light is Light.DISTRIBUTED for traits in shown):
        render_environments(environments, folder, screen)
    # A floor is chosen at random from all surfaces, so a single picture over a floor may need any of them.
    if any(traits.background is Background.FLOOR for traits in shown):
        bake([surface.name for surface in header.surfaces if isinstance(surface, BuiltinSurfaceRef)], folder, screen)
