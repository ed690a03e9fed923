"""The manifest: the record of one picture, written after its files. A job is done when it is there and fits."""

import hashlib
from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from farm.dataset.dataset import Dataset
from farm.dataset.instances import VisibleInstance
from farm.dataset.outputs import outputs_of
from farm.dataset.paths import file_path
from farm.model import Model, Sha256
from farm.scene.picture_size import PictureSize
from farm.scene.scene import Scene
from farm.spec.job import DatasetName, Job
from farm.spec.rendering import PictureSettings

Seconds = Annotated[float, Field(ge=0)]


class FileRecord(Model):
    """One file of a job: where it is below the dataset's folder, its size and checksum."""

    path: str
    bytes: Annotated[int, Field(ge=0)]
    sha256: Sha256


def file_record(path: str, content: bytes) -> FileRecord:
    """Make the record of a file with this content."""
    return FileRecord(path=path, bytes=len(content), sha256=hashlib.sha256(content).hexdigest())


class RejectedAttempt(Model):
    """A scene that was drawn and failed a check: of the settled cables, or of what the picture shows of them."""

    attempt: Annotated[int, Field(ge=0)]
    reason: str


class SettleFigures(Model):
    """Measurements of the settled cables, taken on the smooth centrelines that are rendered.

    Attributes:
        fall_s: true time for which the cables fell and settled, in seconds.
        steps: time steps of the rod solver, or frames of the cloth.
        length_error: worst cable, |L/L0 - 1|.
        cable_penetration: depth of a cable in another, or in itself farther along than four radii, over the smaller
            radius; the 99.9th percentile of all places.
        cable_penetration_max: deepest single place.
        floor_penetration: depth of a cable in the floor over its radius; the 99.9th percentile of all places.
        floor_penetration_max: deepest single place.
        pass_throughs: passages of cables through each other that the simulator saw; of one that does not watch,
            crossings of two cables, away from all ends, whose order flipped between start and rest.
        end_slips: crossings of two cables that lie the other way round than their start heights without a passage: one
            slipped round an end, came to lie across one that it had left, or was woven at the start.
        floor_pass_throughs: cables whose centreline is anywhere below the floor.
        self_crossings: places where a cable crosses itself, seen from above.
        speed_rms_mm_s: root mean square speed of the nodes at the end, in true time.
        speed_max_mm_s: fastest node at the end.
        support_gap: smallest clearance of a cable to the floor, or to another cable within half a radius, over its
            radius; the worst cable's. Negative where it is pressed in.
    """

    fall_s: float
    steps: int
    length_error: float
    cable_penetration: float
    cable_penetration_max: float
    floor_penetration: float
    floor_penetration_max: float
    pass_throughs: int
    end_slips: int
    floor_pass_throughs: int
    self_crossings: int
    speed_rms_mm_s: float
    speed_max_mm_s: float
    support_gap: float


class RenderSettings(Model):
    """The settings that the picture was rendered with, which may differ from those that were asked for.

    Attributes:
        resolution: size of the picture, in pixels.
        samples: most samples that a pixel takes.
        settings: settings that Cycles rendered with; None for another engine.
        expected_flip: mean FLIP against a picture without noise, as calibrated; None where it is not known, as for
            pictures that a camera's development changes.
    """

    engine: str
    device: str
    resolution: PictureSize
    samples: int
    settings: PictureSettings | None = None
    expected_flip: float | None = None


class Manifest(Model):
    """Everything about one picture.

    Attributes:
        settled: measurements of the settled cables; None for a picture without cables.
        instances: the instances that the picture shows, by number; none in a picture without cables, and None in a
            manifest of a farm that did not list them.
        timings_s: seconds per stage of this job (open, randomize, simulate, check, mask, realize, render, write).
        versions: versions of the farm, Blender and the libraries that take part.
        files: every file of the picture but this one, by the folder of its output; see `farm.dataset.outputs.Output`.
    """

    version: Literal[1] = 1
    dataset: DatasetName
    spec_sha256: Sha256
    job_id: str
    seed: int
    scene: Scene
    settled: SettleFigures | None
    instances: tuple[VisibleInstance, ...] | None = None
    rejected: tuple[RejectedAttempt, ...]
    render: RenderSettings
    timings_s: Mapping[str, Seconds]
    versions: Mapping[str, str]
    files: Mapping[str, FileRecord]


class _Facts(BaseModel):
    """A part of a manifest of whatever release, of which only some keys are known."""

    model_config = ConfigDict(frozen=True, extra="ignore", strict=True, allow_inf_nan=False)


class _Floor(_Facts):
    texture: str


class _World(_Facts):
    hdri: str


class _Lamp(_Facts):
    kind: str


class _Camera(_Facts):
    height_m: float


class SceneFacts(_Facts):
    """The part of a scene that the index lists, as every release describes it.

    Attributes:
        lamp: the one lamp of the first datasets of release 0.1.0.
        lamps: the lamps of all others.
    """

    attempt: Annotated[int, Field(ge=0)]
    cables: tuple[Mapping[str, Any], ...]
    floor: _Floor | None = None
    hdri_world: _World | None = None
    lamp: _Lamp | None = None
    lamps: tuple[_Lamp, ...] = ()
    camera: _Camera

    @property
    def first_lamp(self) -> str | None:
        """Kind of the first lamp; None if there is none."""
        lamp = next(iter(self.lamps), self.lamp)
        return None if lamp is None else lamp.kind


class Receipt(_Facts):
    """The part of a manifest by which its picture is done. Every release writes it, though their scenes differ.

    Attributes:
        spec_sha256: identity of the dataset.
        files: every file of the picture but its manifest, by the folder of its output.
        scene: what the index lists of the scene.
        timings_s: seconds per stage.
        instances: its list of instances; None in manifests of releases that list none.
    """

    spec_sha256: Sha256
    job_id: str
    seed: Annotated[int, Field(ge=0)]
    files: Mapping[str, FileRecord]
    scene: SceneFacts
    timings_s: Mapping[str, Seconds] = {}
    instances: tuple[Mapping[str, Any], ...] | None = None

    def belongs_to(self, dataset: Dataset, job: Job) -> bool:
        """Whether it is that of this job of this dataset, whatever the dataset's folder is called."""
        return (
            self.job_id == job.id
            and self.spec_sha256 == dataset.identity
            and self.seed == dataset.header.spec.seed
            and {folder: record.path for folder, record in self.files.items()}
            == {output.folder: file_path(job, output) for output in outputs_of(dataset.header.spec)}
        )


def parse_receipt(content: bytes, dataset: Dataset, job: Job) -> Receipt | None:
    """Read the receipt in a manifest of any release; None if it is damaged, or is not of this job of this dataset."""
    try:
        receipt = Receipt.model_validate_json(content)
    except ValidationError:
        return None
    return receipt if receipt.belongs_to(dataset, job) else None


def parse_manifest(content: bytes, dataset: Dataset, job: Job) -> Manifest | None:
    """Read a whole manifest.

    Returns:
        None if it is damaged, is not of this job of this dataset, or holds a scene that only another release can read.
    """
    if parse_receipt(content, dataset, job) is None:
        return None
    try:
        return Manifest.model_validate_json(content)
    except ValidationError:
        return None
