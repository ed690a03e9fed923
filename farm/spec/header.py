"""The header of a dataset, `dataset.json`. It is written first, and holds everything that decides the pictures."""

from collections.abc import Mapping
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from farm.model import Model, Sha256
from farm.spec.category import Category
from farm.spec.dataset_spec import DatasetSpec
from farm.spec.quality import ChosenSettings


class FileRef(Model):
    """A file outside the dataset that the workers need.

    Attributes:
        path: absolute path.
        sha256: checksum of the content.
    """

    path: str
    sha256: Sha256


class TemplateRef(Model):
    """The template.

    Attributes:
        path: absolute path; None for the template that comes with the farm.
        sha256: checksum of the file.
    """

    path: str | None
    sha256: Sha256


class HdriRef(Model):
    """An HDRI: a file, or an environment that each machine renders by a recipe.

    Attributes:
        name: unique name in the dataset.
        path: absolute path; None for a file that comes with Blender, and for an environment.
        sha256: checksum of the file; None for an environment, whose bytes differ from machine to machine.
        dark: whether scenes brighten it by a random share.
        backdrop: whether it may be seen behind cables; others only light them.
        recipe_version: version of an environment's recipe; None for a file.
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
    """A photograph of the user's that may be shown behind far cables.

    Attributes:
        name: unique name in the dataset.
        path: absolute path.
        sha256: checksum of the file.
    """

    name: str
    path: str
    sha256: Sha256


class BuiltinSurfaceRef(Model):
    """A built-in floor surface, which each machine bakes by a recipe from a fixed seed.

    Attributes:
        name: unique name in the dataset, and name of the recipe.
        recipe_version: version of the recipe.
        light: whether it is as bright as a table or a bench; a style may choose such surfaces more often.
    """

    kind: Literal["builtin"] = "builtin"
    name: str
    recipe_version: int
    light: bool = False


class FolderSurfaceRef(Model):
    """A floor surface made of the user's PBR textures.

    Attributes:
        name: unique name in the dataset.
        files: texture maps by role, such as colour, normal and roughness.
        size_m: edge of the square that the texture covers, in metres.
        flip_green: whether the normal map follows DirectX's convention, whose green points down.
        gloss: whether the roughness map holds glossiness, which is 1 less the roughness.
        light: whether it is as bright as a table or a bench.
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
    """The content of `dataset.json`.

    Attributes:
        format: version of this format.
        farm_version: version of the farm that wrote the header; it is no part of the dataset's identity.
        spec: description of the dataset.
        template: template of the pictures.
        surfaces: floor surfaces that scenes choose from.
        hdris: HDRIs that scenes choose from.
        plates: photographs that far scenes choose from.
        rendering: render settings that the spec's quality means for each category, so that a farm with another
            calibration makes the same kind of pictures; empty for engines other than Cycles.
    """

    format: Literal[1] = 1
    farm_version: str
    spec: DatasetSpec
    template: TemplateRef
    surfaces: Annotated[tuple[SurfaceRef, ...], Field(min_length=1)]
    hdris: Annotated[tuple[HdriRef, ...], Field(min_length=1)]
    plates: tuple[PlateRef, ...] = ()
    rendering: Mapping[Category, ChosenSettings] = {}
