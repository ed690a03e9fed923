"""Lists the surfaces, HDRIs and photographs of this machine in the form that a dataset's header has for them."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TypeVar

from assets.environments import ENVIRONMENTS
from assets.scan.hdris import Hdri, registry, survey_hdris
from assets.scan.photographs import PlateFile, survey_plates
from assets.scan.survey import LeftOut, Survey
from assets.scan.textures import TextureSet, survey_textures
from assets.surfaces.catalogue import SURFACES
from farm.cli.display import console, one_line
from farm.spec.header import BuiltinSurfaceRef, FileRef, FolderSurfaceRef, HdriRef, PlateRef
from farm.spec.styles import Style

T = TypeVar("T")

_MOST_LINES = 20
"""Files that can't be used and are named one by one, for each folder; of more, the rest is counted."""


def tell_left_out(folder: Path, option: str, left_out: Sequence[LeftOut], tell: Callable[[str], None]) -> None:
    """Tell which files of a folder a dataset does without: each that can't be used, and how many are of no use.

    Args:
        folder: The folder.
        option: The option that names it.
        left_out: The files.
        tell: Called with each line.
    """
    broken = [entry for entry in left_out if entry.broken]
    for entry in broken[:_MOST_LINES]:
        tell(one_line(f"left out: {entry.message}"))
    if len(broken) > _MOST_LINES:
        tell(one_line(f"left out: {len(broken) - _MOST_LINES} more files of {folder}"))
    spare = len(left_out) - len(broken)
    if spare:
        tell(one_line(f"{spare} files of {folder} are not used; list them: farm assets check {option} {folder}"))


class InstalledAssets:
    """Implements `farm.spec.make_header.AssetSource` over the `assets` package.

    Args:
        tell: Called with each line about files that are left out; None to print them as remarks.
    """

    def __init__(self, tell: Callable[[str], None] | None = None) -> None:
        self._tell = tell or (lambda line: console().print(line, markup=False))

    def builtin_surfaces(self, style: Style) -> Sequence[BuiltinSurfaceRef]:
        """See `AssetSource.builtin_surfaces`."""
        return [
            BuiltinSurfaceRef(name=recipe.name, recipe_version=recipe.version, light=recipe.light)
            for recipe in SURFACES.values()
            if recipe.published or style is not Style.PUBLISHED
        ]

    def surfaces_in(self, folder: Path) -> Sequence[FolderSurfaceRef]:
        """See `AssetSource.surfaces_in`."""
        kind = "no textures, which are images with names such as 'oak_color' and 'oak_normal',"
        return [_surface(texture) for texture in self._needed(folder, "--textures", kind, survey_textures(folder))]

    def builtin_hdris(self) -> Sequence[HdriRef]:
        """See `AssetSource.builtin_hdris`. The registry lists them, as a coordinator may lack Blender's files."""
        return [
            HdriRef(name=hdri.name, path=None, sha256=hdri.sha256, dark=hdri.dark, backdrop=hdri.backdrop)
            for hdri in registry()
        ]

    def environments(self) -> Sequence[HdriRef]:
        """See `AssetSource.environments`. The recipes list them, as each machine renders its own panoramas."""
        return [
            HdriRef(name=recipe.name, path=None, dark=False, recipe_version=recipe.version)
            for recipe in ENVIRONMENTS.values()
        ]

    def hdris_in(self, folder: Path) -> Sequence[HdriRef]:
        """See `AssetSource.hdris_in`."""
        found = self._needed(folder, "--hdris", "no .hdr or .exr file", survey_hdris(folder))
        return [_hdri(hdri) for hdri in found]

    def plates_in(self, folder: Path) -> Sequence[PlateRef]:
        """See `AssetSource.plates_in`."""
        found = self._needed(folder, "--backgrounds", "no photograph", survey_plates(folder))
        return [_plate(plate) for plate in found]

    def _needed(self, folder: Path, option: str, kind: str, survey: Survey[T]) -> tuple[T, ...]:
        found = survey.needed(folder, kind)
        tell_left_out(folder, option, survey.left_out, self._tell)
        return found


def _hdri(hdri: Hdri) -> HdriRef:
    return HdriRef(
        name=hdri.name, path=str(hdri.path.resolve()), sha256=hdri.sha256, dark=hdri.dark, backdrop=hdri.backdrop
    )


def _plate(plate: PlateFile) -> PlateRef:
    return PlateRef(name=plate.name, path=str(plate.path.resolve()), sha256=plate.sha256)


def _surface(texture: TextureSet) -> FolderSurfaceRef:
    return FolderSurfaceRef(
        name=texture.name,
        files={
            entry.role.value: FileRef(path=str(entry.path.resolve()), sha256=entry.sha256) for entry in texture.maps
        },
        flip_green=texture.flip_green,
        gloss=texture.invert_roughness,
    )
