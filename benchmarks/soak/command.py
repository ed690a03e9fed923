"""`python -m benchmarks soak`: a run of two workers; one replaces its renderer now and then, the other never does."""

import tempfile
from collections import defaultdict
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path

from benchmarks.soak.growth import Sample
from benchmarks.soak.report import soak_table, write_json, write_plot
from benchmarks.terminal import bench_console
from farm.cli.installed_assets import InstalledAssets
from farm.dataset.dataset import create_dataset
from farm.dataset.destination import Destination
from farm.dataset.verify import verify
from farm.errors import VerificationError
from farm.local.redis_server import PrivateRedis
from farm.local.workers import LocalWorkers
from farm.run.coordinator import Coordinator
from farm.run.handle import open_handle
from farm.run.progress import Progress
from farm.run.queue.broker import connect
from farm.run.worker_settings import DeviceChoice, RendererSettings, WorkerSettings
from farm.spec.make_header import Inputs, make_header
from farm.spec.parse import parse_spec

RECYCLED_AFTER = 50
"""Images after which one of the workers replaces its renderer."""

_NEVER = 10**9
"""Number of images, and of KiB, that no renderer reaches, so that it is never replaced."""


def run(out: Path, *, seed: int, images: int, quality: str, resolution: int) -> int:
    """Render, print the table, write `soak.json` and `soak.png` into `out`.

    Args:
        out: an existing folder.
        seed: seed of the dataset.
        images: number of images of both workers together, in the published mix and style.
        quality: name of a preset.
        resolution: edge of an image, pixels.

    Raises:
        VerificationError: if the dataset is incomplete or differs from its manifests.
        FarmError: the error with which a worker ended.
    """
    spec = {"seed": seed, "style": "published", "images": images, "quality": quality, "resolution": resolution}
    header = make_header(parse_spec(spec, source="benchmark"), Inputs(environments=False), InstalledAssets())
    samples: dict[str, list[Sample]] = defaultdict(list)

    def look(progress: Progress) -> None:
        for report in progress.workers or ():
            samples[report.name.partition("-1@")[0]].append(Sample(report.done, report.rss_bytes))

    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="cable-farm-")))
        server = stack.enter_context(PrivateRedis())
        dataset = create_dataset(Destination(str(folder), "soak"), header)
        coordinator = Coordinator(dataset, open_handle(dataset, server.url, connect(server.url)))
        coordinator.submit_missing()
        workers = [
            stack.enter_context(LocalWorkers(1, _settings(name, after, folder, out), server.url))
            for name, after in (("recycled", RECYCLED_AFTER), ("kept", _NEVER))
        ]

        def supervise() -> None:
            for each in workers:
                each.supervise()

        with bench_console().status(f"{images} images"):
            coordinator.watch(look, supervise=supervise)
        verdict = verify(dataset)
    if not verdict.clean or verdict.images != images:
        raise VerificationError(f"{verdict.images} of {images} images are as they should be")
    _require_both(samples)
    console = bench_console()
    console.print(soak_table(samples))
    write_json(out / "soak.json", samples, spec)
    write_plot(out / "soak.png", samples)
    return 0


def _settings(name: str, after: int, folder: Path, out: Path) -> WorkerSettings:
    return WorkerSettings(
        store=str(folder),
        name=name,
        renderer=RendererSettings(device=DeviceChoice.CPU, threads=1),
        logs=out / f"soak-{name}-logs",
        tasks_per_child=after,
        memory_per_child_kib=_NEVER,
    )


def _require_both(samples: Mapping[str, list[Sample]]) -> None:
    for name in ("recycled", "kept"):
        if not samples[name] or samples[name][-1].done == 0:
            raise VerificationError(f"the worker '{name}' has made no image")
