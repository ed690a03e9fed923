"""The header of a dataset, `dataset.json`: written first, it fixes all that decides the pictures."""

import functools
import hashlib
from collections.abc import Mapping
from typing import Annotated, Literal, Self

import pydantic_core
from pydantic import Field, model_validator

from farm.model import Model, Sha256
from farm.spec.category import Category
from farm.spec.dataset_spec import DatasetSpec
from farm.spec.quality import ChosenSettings


class FileRef(Model):
    """A file outside the dataset that the workers need, by absolute path and content."""

    path: str
    sha256: Sha256


class TemplateRef(Model):
    """The template; `path` is None for the one that comes with the farm."""

    path: str | None
    sha256: Sha256


class HdriRef(Model):
    """An HDRI; `path` is None for one from Blender's own files, and for an environment of our own.

    Attributes:
        sha256: of the file; None for an environment, of which each machine renders its own bytes.
        dark: its brightness is drawn.
        backdrop: it can be seen behind cables; others only light them.
        recipe_version: of an environment; None for files.
    """

    name: str
    path: str | None
    sha256: Sha256 | None = None
    dark: bool
    backdrop: bool = True
    recipe_version: Annotated[int, Field(ge=1)] | None = None

    @model_validator(mode="after")
    def _of_one_kind(self) -> Self:
        if (self.sha256 is None) == (self.recipe_version is None):
            raise ValueError(f"the HDRI '{self.name}' needs a checksum or a recipe's version, and not both")
        if self.recipe_version is not None and self.path is not None:
            raise ValueError(f"the HDRI '{self.name}' is an environment, which has no path")
        return self


class PlateRef(Model):
    """A photograph of the user's own that may stand behind far cables."""

    name: str
    path: str
    sha256: Sha256


class BuiltinSurfaceRef(Model):
    """A floor surface of our own recipes, baked on each machine from a fixed seed.

    Attributes:
        light: it is as bright as a table or a bench; a style may draw more of these.
    """

    kind: Literal["builtin"] = "builtin"
    name: str
    recipe_version: int
    light: bool = False


class FolderSurfaceRef(Model):
    """A floor surface from the user's own PBR textures, by role (colour, normal, roughness, ...).

    Attributes:
        size_m: edge of the square that the texture covers, in metres.
        flip_green: the normal map is in DirectX convention.
        gloss: the roughness map holds glossiness.
    """

    kind: Literal["folder"] = "folder"
    name: str
    files: Mapping[str, FileRef]
    size_m: Annotated[float, Field(gt=0)] = 0.4
    flip_green: bool = False
    gloss: bool = False
    light: bool = False


SurfaceRef = Annotated[BuiltinSurfaceRef | FolderSurfaceRef, Field(discriminator="kind")]


class DatasetHeader(Model):
    """What `dataset.json` holds.

    Attributes:
        rendering: what the spec's quality means for each category, so that a farm with another calibration does not mix
            pictures of two kinds; empty for other engines than Cycles.
    """

    format: Literal[1] = 1
    farm_version: str
    spec: DatasetSpec
    template: TemplateRef
    surfaces: Annotated[tuple[SurfaceRef, ...], Field(min_length=1)]
    hdris: Annotated[tuple[HdriRef, ...], Field(min_length=1)]
    plates: tuple[PlateRef, ...] = ()
    rendering: Mapping[Category, ChosenSettings] = {}

    @functools.cached_property  # it takes part in every message
    def spec_sha256(self) -> str:
        """Fingerprint of all that decides the pictures: everything but the farm's version."""
        content = self.model_dump(mode="json", exclude={"farm_version"})
        return hashlib.sha256(pydantic_core.to_json(content)).hexdigest()
