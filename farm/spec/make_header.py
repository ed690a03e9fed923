"""Makes a dataset's header: finds the files that the user names, and records each by its content."""

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

# First bytes of a .blend file, which is plain, or compressed by Zstandard or, in older versions, by gzip.
_BLEND_STARTS = (b"BLENDER", b"\x28\xb5\x2f\xfd", b"\x1f\x8b")


@dataclass(frozen=True, slots=True)
class Inputs:
    """The files that a dataset uses, as the user names them.

    Attributes:
        template: path of the template; None for the one that comes with the farm.
        textures: folders of PBR textures.
        hdris: folders of .hdr and .exr files.
        builtin_textures: whether the built-in surfaces are used.
        builtin_hdris: whether the HDRIs that come with Blender are used.
        backgrounds: folders of photographs.
        environments: whether the built-in environments are used.
    """

    template: Path | None = None
    textures: tuple[Path, ...] = ()
    hdris: tuple[Path, ...] = ()
    builtin_textures: bool = True
    builtin_hdris: bool = True
    backgrounds: tuple[Path, ...] = ()
    environments: bool = True


class AssetSource(Protocol):
    """The source of surfaces, HDRIs and photographs. Each method may raise AssetError, which names the file."""

    def builtin_surfaces(self, style: Style) -> Sequence[SurfaceRef]:
        """List the built-in surfaces that a style shows."""
        ...

    def surfaces_in(self, folder: Path) -> Sequence[SurfaceRef]:
        """List the surfaces that a folder of PBR textures holds."""
        ...

    def builtin_hdris(self) -> Sequence[HdriRef]:
        """List the HDRIs that come with Blender."""
        ...

    def environments(self) -> Sequence[HdriRef]:
        """List the built-in environments."""
        ...

    def hdris_in(self, folder: Path) -> Sequence[HdriRef]:
        """List the HDRIs of a folder."""
        ...

    def plates_in(self, folder: Path) -> Sequence[PlateRef]:
        """List the photographs of a folder."""
        ...


def make_header(spec: DatasetSpec, inputs: Inputs, assets: AssetSource) -> DatasetHeader:
    """Make the header of a dataset; nothing is written.

    Args:
        spec: description of the dataset.
        inputs: files that the dataset uses.
        assets: source of surfaces, HDRIs and photographs.

    Raises:
        AssetError: if a texture, HDRI or photograph can't be read, two have the same name, or no surface or HDRI is
            left.
        TemplateError: if the template can't be read or is not a .blend file.
        SpecError: if the description names an HDRI that does not exist.
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
    """Choose the settings of each category. One without a quota is left out if it can't be rendered at the quality."""
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
    """Record a template by its content.

    Args:
        template: path of the template; None for the one that comes with the farm.

    Raises:
        TemplateError: if it can't be read or is not a .blend file.
    """
    path = template or _builtin_template()
    try:
        content = path.read_bytes()
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)  # a NUL byte gives a ValueError
        raise TemplateError(f"{path}: can't read the template: {reason}; check --template") from error
    if not content.startswith(_BLEND_STARTS):
        raise TemplateError(f"{path}: not a .blend file; save the template in Blender and name that file")
    absolute = None if template is None else str(template.resolve())
    return TemplateRef(path=absolute, sha256=hashlib.sha256(content).hexdigest())


def _builtin_template() -> Path:
    # The package is found without being imported, which would need Blender.
    found = importlib.util.find_spec("blend")
    for folder in (found and found.submodule_search_locations) or ():
        path = Path(folder) / "template.blend"
        if path.is_file():
            return path
    raise TemplateError("the template that comes with the farm is missing; build it: python -m blend.build")
