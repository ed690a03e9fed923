"""The fuzzed parsers: each target takes bytes, and may raise nothing but a FarmError."""

import atexit
import base64
import json
import shutil
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image

from assets.fetch.registry import OWN_REGISTRY, read_registry
from assets.scan.float_image import LARGEST_PIXELS, read_float_image
from assets.scan.photographs import decode_plate
from farm.dataset.completion import job_of_manifest
from farm.dataset.dataset import Dataset, create_dataset, open_dataset
from farm.dataset.destination import Destination, parse_destination
from farm.dataset.manifest import parse_manifest
from farm.dataset.outputs import OUTPUTS
from farm.dataset.paths import HEADER_FILE, file_path, manifest_path
from farm.errors import FarmError
from farm.run.queue.broker import broker_url, masked
from farm.run.queue.wire import ENVELOPE_BYTES, checked_envelope, decode_json
from farm.spec.job import Job, JobMessage
from farm.spec.parse import describe, parse_quotas
from farm.spec.quality import read_quality
from tests.assets.scan.float_files import write_image
from tests.stand_in import StandInRenderer, stand_in_header
from worker.service.upload import upload

JOB = Job.from_id("far-000000")
_SPEC = b"""
images = 6
seed = 1
resolution = 64
quality = 0.05
textures = ["a"]
[ranges.wind]
strength = [0.0, 1.0]
"""


@dataclass(frozen=True)
class Target:
    """A target of the fuzzer.

    Attributes:
        parse: function that parses the bytes.
        seeds: good inputs from which the fuzzer starts.
    """

    parse: Callable[[bytes], object]
    seeds: tuple[bytes, ...]


@cache
def _folder() -> Path:
    folder = Path(tempfile.mkdtemp(prefix="farm-fuzz-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


@cache
def _dataset() -> Dataset:
    dataset = create_dataset(Destination(str(_folder() / "store"), "cables"), stand_in_header())
    upload(StandInRenderer().make(JOB, dataset.header), JOB, dataset)
    return dataset


def _one_line(parse: Callable[[bytes], object]) -> Callable[[bytes], object]:
    """Assert that a message is one line, since messages about foreign input go into logs."""

    def parse_and_look(data: bytes) -> None:
        try:
            parse(data)
        except FarmError as error:
            if len(str(error).splitlines()) > 1:
                raise ValueError("the error has several lines") from None
            raise

    return parse_and_look


def _text(data: bytes) -> str:
    return data.decode("utf-8", "surrogateescape")


def _message(data: bytes) -> None:
    message = JobMessage.decode(decode_json(data))
    assert JobMessage.decode(message.encode()) == message
    assert message.job.id == message.job_id


def _envelope(data: bytes) -> None:
    passed = checked_envelope(decode_json(data, ENVELOPE_BYTES))
    assert checked_envelope(passed) == passed


def _job_id(data: bytes) -> None:
    text = _text(data)
    job_of_manifest(text)
    assert Job.from_id(text).id == text


def _spec(data: bytes) -> None:
    path = _folder() / "spec.toml"
    path.write_bytes(data)
    spec = describe(path, {}, {}).spec
    assert spec.total > 0


def _registry(data: bytes) -> None:
    path = _folder() / "registry.toml"
    path.write_bytes(data)
    assert all("/" not in entry.file for asset in read_registry(path).asset for entry in asset.file)


def _header(data: bytes) -> None:
    folder = _folder() / "fuzzed" / "cables"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / HEADER_FILE).write_bytes(data)
    assert len(open_dataset(Destination(str(folder.parent), "cables")).identity) == 64


def _manifest(data: bytes) -> None:
    manifest = parse_manifest(data, _dataset(), JOB)
    if manifest is not None:
        assert {record.path for record in manifest.files.values()} == {file_path(JOB, output) for output in OUTPUTS}


def _destination(data: bytes) -> None:
    place = parse_destination(_text(data))
    assert "/" not in place.name
    assert place.name not in {"", ".", ".."}


def _quotas(data: bytes) -> None:
    assert all(number >= 0 for number in parse_quotas(_text(data).split("\n")).values())


def _address(data: bytes) -> None:
    text = _text(data)
    masked(text)
    # An empty registry would be replaced by the environment's.
    url = broker_url(text or "redis://there")
    assert not url.startswith("rediss") or "ssl_cert_reqs=required" in url


def _good_envelope() -> bytes:
    body = [[], {"message": _dataset().message(JOB).encode()}, {"callbacks": None, "chain": None}]
    envelope = {
        "body": base64.b64encode(json.dumps(body).encode()).decode(),
        "content-encoding": "utf-8",
        "content-type": "application/json",
        "headers": {"task": "farm.render_image", "id": "cables:0:far-000000", "eta": None, "retries": 0},
        "properties": {
            "delivery_tag": "1",
            "delivery_info": {"exchange": "", "routing_key": "farm"},
            "body_encoding": "base64",
        },
    }
    return json.dumps(envelope).encode()


def _photograph(kind: str) -> bytes:
    note = Image.Exif()
    note[0x0112] = 8  # a picture that is turned
    buffer = BytesIO()
    Image.new("RGB", (260, 256), "teal").save(buffer, kind, exif=note)
    return buffer.getvalue()


def _float_image(suffix: str) -> Callable[[bytes], object]:
    path = _folder() / f"fuzzed{suffix}"

    def parse(data: bytes) -> None:
        path.write_bytes(data)
        pixels = read_float_image(path)
        assert pixels.ndim == 3
        assert pixels.shape[2] == 3
        assert pixels.size <= 3 * LARGEST_PIXELS

    return parse


def _exr_files() -> tuple[bytes, ...]:
    """One of each way in which pixels are packed."""
    pixels = np.random.default_rng(0).random((6, 10, 3), np.float32)
    kinds = [("zip", 0), ("none", 4), ("piz", 0), ("b44", 4), ("rle", 0), ("pxr24", 0), ("dwaa", 4)]
    return tuple(
        write_image(_folder() / "seed.exr", pixels, compression=compression, tile=tile).read_bytes()
        for compression, tile in kinds
    )


def _radiance_files() -> tuple[bytes, ...]:
    """With runs, and too narrow for them."""
    pixels = np.random.default_rng(0).random((4, 10, 3), np.float32)
    return tuple(write_image(_folder() / "seed.hdr", pixels[:, :width]).read_bytes() for width in (6, 10))


def _registry_seed() -> bytes:
    """The farm's own registry up to its first asset."""
    return b"[[asset]]".join(OWN_REGISTRY.read_bytes().split(b"[[asset]]")[:2])


def targets() -> dict[str, Target]:
    """All targets by name."""
    dataset = _dataset()
    message = json.dumps(dataset.message(JOB).encode()).encode()
    return {
        "job message": Target(_one_line(_message), (message,)),
        "envelope": Target(_one_line(_envelope), (_good_envelope(),)),
        "job id": Target(_one_line(_job_id), (b"far-000042", manifest_path(JOB).encode())),
        "description": Target(_spec, (_SPEC, b"[quotas]\nfar = 2\n")),
        "header": Target(_header, (dataset.storage.read(HEADER_FILE),)),
        "manifest": Target(_manifest, (dataset.storage.read(manifest_path(JOB)),)),
        "destination": Target(_destination, (b"a/b", b"s3://bucket/cables", b"~/x", b"file:///a/b")),
        "quotas": Target(_quotas, (b"far=2\nfar_aligned=3",)),
        "quality": Target(lambda data: read_quality(_text(data)), (b"draft", b"0.02")),
        "broker address": Target(_address, (b"rediss://:word@there:1/0?ssl_ca_certs=/a.pem", b"redis+socket:///a")),
        "EXR": Target(_float_image(".exr"), _exr_files()),
        "photograph": Target(lambda data: decode_plate(Path("x"), data), (_photograph("JPEG"), _photograph("WEBP"))),
        "registry": Target(_one_line(_registry), (_registry_seed(),)),
        "Radiance": Target(_float_image(".hdr"), _radiance_files()),
    }
