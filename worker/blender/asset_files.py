"""The files of the surfaces, HDRIs and photographs that a dataset's header names, checked against it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from assets.environments import Environment, load_environment
from assets.scan.hdris import Hdri, builtin_hdris
from assets.surfaces.baked import BakedSurface, load_surface, surface_directory
from farm.errors import AssetError
from farm.spec.header import BuiltinSurfaceRef, DatasetHeader, FileRef, FolderSurfaceRef
from worker.blender.input_files import InputFiles


@dataclass(frozen=True, slots=True)
class SurfaceFiles:
    """Image files of one floor surface.

    Attributes:
        size_m: edge of the square that the texture covers.
        colour: map of the sRGB colour.
        roughness: map of the roughness; None if there is none.
        normal: map of the normals; None if there is none.
        metallic: map of the metallic share, or one value for the whole surface.
        joints: map of the places where pieces meet (`assets.surfaces.kit.maps.joint_levels`); None if there is none.
        flip_green: whether the normal map is in DirectX convention.
        gloss: whether the roughness map holds glossiness.
    """

    size_m: float
    colour: Path
    roughness: Path | None
    normal: Path | None
    metallic: Path | float
    joints: Path | None = None
    flip_green: bool = False
    gloss: bool = False


class AssetLibrary:
    """Finds files by the names that scenes use."""

    def __init__(self, header: DatasetHeader, baked_folder: Path | None, places: Sequence[Path] = ()) -> None:
        """Look up nothing yet.

        Args:
            header: the dataset's header.
            baked_folder: folder of the baked built-in surfaces; None for the usual place.
            places: folders and files in which the user's files are looked for, where they are not at their paths.
        """
        self._surfaces = {surface.name: surface for surface in header.surfaces}
        self._hdris = {hdri.name: hdri for hdri in header.hdris}
        self._plates = {plate.name: plate for plate in header.plates}
        self._baked_folder = baked_folder or surface_directory()
        self._baked: dict[str, BakedSurface] = {}
        self._environments: dict[str, Environment] = {}
        self._builtin_hdris: Mapping[str, Hdri] | None = None
        self._inputs = InputFiles(places)

    def template(self, path: Path, sha256: str) -> Path:
        """File of the dataset's template.

        Raises:
            AssetError: if it is not on this machine, or differs from the header's.
        """
        return self._inputs.once_checked(FileRef(path=str(path), sha256=sha256))

    def surface(self, name: str) -> SurfaceFiles:
        """Files of a surface.

        Raises:
            AssetError: if they are not on this machine, or differ from the header's.
        """
        surface = self._surfaces[name]
        return self._from_bakery(surface) if isinstance(surface, BuiltinSurfaceRef) else self._from_folder(surface)

    def hdri(self, name: str) -> Path:
        """File of an HDRI.

        Raises:
            AssetError: if it is not on this machine, or differs from the header's.
        """
        reference = self._hdris[name]
        if reference.recipe_version is not None:
            return self._environment(name, reference.recipe_version)
        if reference.path is not None and reference.sha256 is not None:
            return self._inputs.once_checked(FileRef(path=reference.path, sha256=reference.sha256))
        if self._builtin_hdris is None:
            self._builtin_hdris = {hdri.name: hdri for hdri in builtin_hdris()}
        builtin = self._builtin_hdris.get(name)
        if builtin is None or builtin.sha256 != reference.sha256:
            raise AssetError(
                f"the HDRI '{name}' is not among this Blender's own; install the bpy it was submitted with"
            )
        return builtin.path

    def plate(self, name: str) -> Path:
        """File of a photograph.

        Raises:
            AssetError: if it is not on this machine, or differs from the header's.
        """
        reference = self._plates[name]
        return self._inputs.once_checked(FileRef(path=reference.path, sha256=reference.sha256))

    def _environment(self, name: str, version: int) -> Path:
        """An environment of our own. This process reads its checksum when a scene first shows it."""
        if name not in self._environments:
            self._environments[name] = load_environment(self._baked_folder, name)
        found = self._environments[name]
        if found.record.version != version:
            raise AssetError(
                f"{self._baked_folder}: the environment '{name}' is of version {found.record.version}, not {version}; "
                "run `farm assets build`"
            )
        return found.path

    def _from_bakery(self, surface: BuiltinSurfaceRef) -> SurfaceFiles:
        """A surface of our own. Its checksums are read when a scene first shows it, as all together take 0.4 s."""
        if surface.name not in self._baked:
            self._baked[surface.name] = load_surface(self._baked_folder, surface.name)
        baked = self._baked[surface.name]
        if baked.record.recipe_version != surface.recipe_version:
            raise AssetError(
                f"{self._baked_folder}: the surface '{surface.name}' is of version {baked.record.recipe_version}, not "
                f"{surface.recipe_version}; run `farm assets build`"
            )
        metallic = baked.record.metallic
        return SurfaceFiles(
            size_m=baked.record.size_m,
            colour=baked.path("colour"),
            roughness=baked.path("roughness"),
            normal=baked.path("normal"),
            metallic=baked.path("metallic") if metallic is None else metallic,
            joints=baked.path("joints") if baked.record.has_joints else None,
        )

    def _from_folder(self, surface: FolderSurfaceRef) -> SurfaceFiles:
        files = {role: self._inputs.once_checked(reference) for role, reference in surface.files.items()}
        return SurfaceFiles(
            size_m=surface.size_m,
            colour=files["colour"],
            roughness=files.get("roughness"),
            normal=files.get("normal"),
            metallic=files.get("metallic", 0.0),
            flip_green=surface.flip_green,
            gloss=surface.gloss,
        )


def checked(reference: FileRef) -> Path:
    """Find the file of a reference at its own path, and check its content.

    Raises:
        AssetError: if the file is not there, or has changed.
    """
    return InputFiles().find(reference)
