"""Makes a dataset's header: finds the files that the user names, and records each by its content."""

import hashlib
import importlib.util
import itertools
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, TypeVar

from farm import __version__
from farm.errors import AssetError, SpecError, TemplateError
from farm.spec.category import Category
from farm.spec.dataset_spec import DatasetSpec, Engine
from farm.spec.header import (
    BuiltinSurfaceRef,
    DatasetHeader,
    FolderSurfaceRef,
    HdriRef,
    PlateRef,
    SurfaceRef,
    TemplateRef,
)
from farm.spec.quality import ChosenSettings, settings_for
from farm.spec.styles import Style

_Ref = TypeVar("_Ref", BuiltinSurfaceRef | FolderSurfaceRef, HdriRef, PlateRef)

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

    @property
    def places(self) -> tuple[Path, ...]:
        """The user's own folders, and the template, in which a dataset's files are found by their content."""
        own = () if self.template is None else (self.template,)
        return (*self.textures, *self.hdris, *self.backgrounds, *own)


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
        AssetError: if a folder holds nothing that can be used, or no surface or HDRI is left.
        TemplateError: if the template can't be read or is not a .blend file.
        SpecError: if the description names an HDRI that does not exist.
    """
    surfaces = list(assets.builtin_surfaces(spec.style)) if inputs.builtin_textures else []
    for folder in inputs.textures:
        surfaces = _joined(surfaces, assets.surfaces_in(folder))
    hdris = list(assets.builtin_hdris()) if inputs.builtin_hdris else []
    if inputs.environments:
        hdris += assets.environments()
    for folder in inputs.hdris:
        hdris = _joined(hdris, assets.hdris_in(folder))
    plates: list[PlateRef] = []
    for folder in inputs.backgrounds:
        plates = _joined(plates, assets.plates_in(folder))
    _check_any("surface", "--textures", surfaces)
    _check_any("HDRI", "--hdris", hdris)
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


def _joined(had: Sequence[_Ref], more: Sequence[_Ref]) -> list[_Ref]:
    """Add the assets of another folder; one whose name is taken gets a number: cameras call all pictures IMG_0001.

    The numbers go by the order of the folders, not by their names, so that folders may be moved. An asset of the same
    name and content is not added twice.
    """
    joined = {reference.name: reference for reference in had}
    for reference in more:
        rival = joined.get(reference.name)
        if rival is None:
            joined[reference.name] = reference
        elif _content(rival) != _content(reference):
            name = _free_name(reference.name, joined)
            joined[name] = reference.model_copy(update={"name": name})
    return list(joined.values())


def _content(reference: _Ref) -> object:
    """What a reference says apart from where its files are."""
    return reference.model_dump(exclude={"path": True, "files": {"__all__": {"path"}}})


def _free_name(name: str, taken: Collection[str]) -> str:
    numbered = (f"{name} ({number})" for number in itertools.count(2))
    return next(free for free in itertools.chain((name,), numbered) if free not in taken)


def _check_any(kind: str, flag: str, found: Sequence[object]) -> None:
    if not found:
        raise AssetError(f"no {kind} is left; name a folder with {flag}, or leave the built-in ones in")


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
    if absolute is not None and not _is_utf8(absolute):
        raise TemplateError(f"{path}: its path isn't UTF-8; rename the template or its folder")
    return TemplateRef(path=absolute, sha256=hashlib.sha256(content).hexdigest())


def _is_utf8(path: str) -> bool:
    try:
        path.encode()
    except UnicodeEncodeError:
        return False
    return True


def _builtin_template() -> Path:
    # The package is found without being imported, which would need Blender.
    found = importlib.util.find_spec("blend")
    for folder in (found and found.submodule_search_locations) or ():
        path = Path(folder) / "template.blend"
        if path.is_file():
            return path
    raise TemplateError("the template that comes with the farm is missing; build it: python -m blend.build")
