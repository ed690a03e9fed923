"""Drawing the built-in surfaces that are not on this machine yet; done once."""

from collections.abc import Iterable
from pathlib import Path

from rich.console import Console
from rich.progress import Progress

from assets.bake import BakedSet, bake_surfaces
from assets.baked import surface_directory
from farm.category import Background
from farm.header import BuiltinSurfaceRef, DatasetHeader


def bake(names: Iterable[str], folder: Path | None, screen: Console) -> BakedSet:
    """Draw surfaces, showing how far it is.

    Args:
        names: which ones; those that are there already take no time.
        folder: where they go; None for the usual place.
        screen: for the bar, or a plain line for each.

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


def bake_for(header: DatasetHeader, folder: Path | None, screen: Console) -> None:
    """Draw the surfaces that a dataset shows.

    Raises:
        AssetError: if the folder can't be written.
    """
    # Surfaces are drawn at random from all of them, so a single picture over a floor may need any.
    if any(quota and category.traits.background is Background.FLOOR for category, quota in header.spec.quotas.items()):
        bake([surface.name for surface in header.surfaces if isinstance(surface, BuiltinSurfaceRef)], folder, screen)
