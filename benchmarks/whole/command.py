"""`python -m benchmarks whole`: the cost of a picture, beside the published method and other settings."""

import tempfile
from pathlib import Path

from rich.progress import Progress

from benchmarks.bench_dataset import bench_header
from benchmarks.render.references import References
from benchmarks.render.stage_set import Stage
from benchmarks.terminal import bench_console, blender_writes_to, progress_console
from benchmarks.whole.growth import measure_growth, points
from benchmarks.whole.plan import Plan
from benchmarks.whole.report import Findings, tables, write_json
from benchmarks.whole.slow import Comparison
from benchmarks.whole.standard import make_standard, start_up_s
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.errors import SpecError
from farm.spec.job import Job


def run(out: Path, plan: Plan) -> int:
    """Measure, print the tables, write `whole.json` and `whole.png` into `out`.

    Raises:
        SpecError: if the plan asks for no image, or for more slow images than images.
        VerificationError: if the written dataset fails verification, or a picture or mask doesn't fit its scene.
        FarmError: if an image can't be made.
    """
    if not 0 <= plan.slow_images <= plan.images or plan.images < 1:
        raise SpecError("give at least 1 of --images, and no more --slow-images than that")
    console = bench_console()
    with tempfile.TemporaryDirectory(prefix="cable-farm-") as folder:
        quotas = {str(category): plan.images for category in plan.categories}
        header = bench_header(plan.images, plan.seed, quotas=quotas, resolution=plan.resolution)
        found = _measure(plan, create_dataset(Destination(folder, "bench"), header), Path(folder), out)
    for table in tables(found):
        console.print(table)
    console.print(
        f"once a process: start and load Blender {found.start_s:.2f} s, open the template {found.open_s:.3f} s; peak "
        f"memory after the standard images {found.peak_mib:.0f} MiB",
        highlight=False,
    )
    write_json(out / "whole.json", found)
    # Imported only now, since its memory would count as the pictures'.
    from benchmarks.whole.plot import write_plot  # noqa: PLC0415

    write_plot(out / "whole.png", found)
    return 0


def _measure(plan: Plan, dataset: Dataset, folder: Path, out: Path) -> Findings:
    jobs = [Job(category=category, index=index) for index in range(plan.images) for category in plan.categories]
    slow_jobs = [job for job in jobs if job.index < plan.slow_images]
    growth = plan.growth_images * len(plan.growth_categories) * len(list(points(plan)))
    start_s = start_up_s()
    with progress_console() as console, Progress(console=console, transient=True) as bar:
        standard_bar = bar.add_task("standard", total=len(jobs))
        slow_bar = bar.add_task("other ways", total=len(slow_jobs))
        growth_bar = bar.add_task("growth", total=growth)
        with blender_writes_to(out / "whole.log"):
            standard = make_standard(dataset, jobs, lambda: bar.advance(standard_bar))
            stage = Stage(dataset.header, plan.resolution)
            references = References(dataset.header, stage, plan.resolution) if plan.errors else None
            comparison = Comparison(dataset, stage, references, folder / "published")
            slow = comparison.slow_rows(slow_jobs, lambda: bar.advance(slow_bar))
            row = comparison.with_errors(standard.row, slow_jobs)
            grown = measure_growth(plan, stage, folder / "growth", lambda: bar.advance(growth_bar))
    return Findings(plan, row, slow, grown, start_s, standard.open_s, standard.peak_mib)
