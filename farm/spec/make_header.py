"""From what a user names (a template, folders of textures and HDRIs) to the dataset's header, by content."""

import hashlib
import importlib.util
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from farm import __version__
from farm.errors import AssetError, SpecError, TemplateError
from farm.spec.category import Category
from farm.spec.dataset_spec import DatasetSpec, Engine
from farm.spec.header import DatasetHeader, HdriRef, PlateRef, SurfaceRef, TemplateRef
from farm.spec.quality import ChosenSettings, settings_for
from farm.spec.styles import Style

# A .blend file is plain, or compressed by Zstandard or (older ones) gzip.
_BLEND_STARTS = (b"BLENDER", b"\x28\xb5\x2f\xfd", b"\x1f\x8b")


@dataclass(frozen=True, slots=True)
class Inputs:
    """What a dataset takes from outside, as named by the user.

    Attributes:
        template: the template's file; None for the one that comes with the farm.
        textures: folders of PBR textures.
        hdris: folders of .hdr and .exr files.
        backgrounds: folders of photographs.
        builtin_textures: whether our own surfaces take part.
        builtin_hdris: whether Blender's own HDRIs take part.
        environments: whether our own environments take part.
    """

    template: Path | None = None
    textures: tuple[Path, ...] = ()
    hdris: tuple[Path, ...] = ()
    builtin_textures: bool = True
    builtin_hdris: bool = True
    backgrounds: tuple[Path, ...] = ()
    environments: bool = True


class AssetSource(Protocol):
    """Where surfaces and HDRIs come from. Each method may raise AssetError, naming the file."""

    def builtin_surfaces(self, style: Style) -> Sequence[SurfaceRef]:
        """Our own surfaces that a style shows."""
        ...

    def surfaces_in(self, folder: Path) -> Sequence[SurfaceRef]:
        """The PBR textures of a folder."""
        ...

    def builtin_hdris(self) -> Sequence[HdriRef]:
        """Blender's own HDRIs."""
        ...

    def environments(self) -> Sequence[HdriRef]:
        """Our own environments."""
        ...

    def hdris_in(self, folder: Path) -> Sequence[HdriRef]:
        """The HDRIs of a folder."""
        ...

    def plates_in(self, folder: Path) -> Sequence[PlateRef]:
        """The photographs of a folder."""
        ...


def make_header(spec: DatasetSpec, inputs: Inputs, assets: AssetSource) -> DatasetHeader:
    """Resolve the inputs; nothing is written.

    Raises:
        AssetError: if a texture, HDRI or photograph is unreadable, two have one name, or no surface or HDRI is left.
        TemplateError: if the template is not readable or no .blend file.
        SpecError: if the description names an HDRI that is not there, or a category can't be rendered so well.
    """
    surfaces = list(assets.builtin_surfaces(spec.style)) if inputs.builtin_textures else []
    for folder in inputs.textures:
        surfaces += assets.surfaces_in(folder)
    hdris = list(assets.builtin_hdris()) if inputs.builtin_hdris else []
    if inputs.environments:
        hdris += assets.environments()
    for folder in inputs.hdris:
        hdris += assets.hdris_in(folder)
    plates = [plate for folder in inputs.backgrounds for plate in assets.plates_in(folder)]
    _check_names("surface", "--textures", [surface.name for surface in surfaces])
    _check_names("HDRI", "--hdris", [hdri.name for hdri in hdris])
    _check_unique("photograph", [plate.name for plate in plates], "rename one of the files")
    wanted = spec.close_distributed_hdri
    if wanted is not None and wanted not in {hdri.name for hdri in hdris}:
        names = ", ".join(hdri.name for hdri in hdris)
        raise SpecError(f"close_distributed_hdri: there is no HDRI '{wanted}'; there are {names}")
    return DatasetHeader(
        farm_version=__version__,
        spec=spec,
        template=template_ref(inputs.template),
        surfaces=tuple(surfaces),
        hdris=tuple(hdris),
        plates=tuple(plates),
        rendering=_rendering(spec) if spec.engine is Engine.CYCLES else {},
    )


def _rendering(spec: DatasetSpec) -> Mapping[Category, ChosenSettings]:
    """The settings of every category, but for those that make no picture and can't be rendered so well."""
    chosen: dict[Category, ChosenSettings] = {}
    for category, quota in spec.quotas.items():
        try:
            chosen[category] = settings_for(spec.quality, category)
        except ValueError as error:
            if quota:
                raise SpecError(str(error)) from error
    return chosen


def _check_names(kind: str, flag: str, names: list[str]) -> None:
    if not names:
        raise AssetError(f"no {kind} is left; name a folder with {flag}, or leave the built-in ones in")
    _check_unique(kind, names, "rename the files of one, or leave the built-in ones out")


def _check_unique(kind: str, names: list[str], advice: str) -> None:
    for name, count in Counter(names).most_common(1):
        if count > 1:
            raise AssetError(f"{count} {kind}s are called '{name}'; {advice}")


def template_ref(template: Path | None) -> TemplateRef:
    """Name a template by its content; None is the one that comes with the farm.

    Raises:
        TemplateError: if it can't be read or is no .blend file.
    """
    path = template or _builtin_template()
    try:
        content = path.read_bytes()
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)  # a NUL byte is no OSError
        raise TemplateError(f"{path}: can't read the template: {reason}; check --template") from error
    if not content.startswith(_BLEND_STARTS):
        raise TemplateError(f"{path}: not a .blend file; save the template in Blender and name that file")
    absolute = None if template is None else str(template.resolve())
    return TemplateRef(path=absolute, sha256=hashlib.sha256(content).hexdigest())


def _builtin_template() -> Path:
    # Found without importing the package, which may need Blender.
    found = importlib.util.find_spec("blend")
    for folder in (found and found.submodule_search_locations) or ():
        path = Path(folder) / "template.blend"
        if path.is_file():
            return path
    raise TemplateError("the template that comes with the farm is not there; build it: python -m blend.build")
