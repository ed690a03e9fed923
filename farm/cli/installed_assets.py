"""Lists the surfaces, HDRIs and photographs of this machine in the form that a dataset's header has for them."""

from collections.abc import Sequence
from pathlib import Path

from assets.environments import ENVIRONMENTS
from assets.scan.hdris import registry, scan_hdris
from assets.scan.photographs import scan_plates
from assets.scan.texture_names import TextureRole
from assets.scan.textures import TextureSet, scan_textures
from assets.surfaces.catalogue import SURFACES
from farm.spec.header import BuiltinSurfaceRef, FileRef, FolderSurfaceRef, HdriRef, PlateRef
from farm.spec.styles import Style


class InstalledAssets:
    """Implements `farm.spec.make_header.AssetSource` over the `assets` package."""

    def builtin_surfaces(self, style: Style) -> Sequence[BuiltinSurfaceRef]:
        """See `AssetSource.builtin_surfaces`."""
        return [
            BuiltinSurfaceRef(name=recipe.name, recipe_version=recipe.version, light=recipe.light)
            for recipe in SURFACES.values()
            if recipe.published or style is not Style.PUBLISHED
        ]

    def surfaces_in(self, folder: Path) -> Sequence[FolderSurfaceRef]:
        """See `AssetSource.surfaces_in`."""
        return [_surface(texture) for texture in scan_textures(folder)]

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
        return [
            HdriRef(
                name=hdri.name,
                path=str(hdri.path.resolve()),
                sha256=hdri.sha256,
                dark=hdri.dark,
                backdrop=hdri.backdrop,
            )
            for hdri in scan_hdris(folder)
        ]

    def plates_in(self, folder: Path) -> Sequence[PlateRef]:
        """See `AssetSource.plates_in`."""
        return [
            PlateRef(name=plate.name, path=str(plate.path.resolve()), sha256=plate.sha256)
            for plate in scan_plates(folder)
        ]


_RENDERED = frozenset({TextureRole.COLOUR, TextureRole.ROUGHNESS, TextureRole.NORMAL, TextureRole.METALLIC})
"""Roles of the texture maps that the floor's material uses; occlusion and height maps are checked and not used."""


def _surface(texture: TextureSet) -> FolderSurfaceRef:
    return FolderSurfaceRef(
        name=texture.name,
        files={
            entry.role.value: FileRef(path=str(entry.path.resolve()), sha256=entry.sha256)
            for entry in texture.maps
            if entry.role in _RENDERED
        },
        flip_green=texture.flip_green,
        gloss=texture.invert_roughness,
    )
