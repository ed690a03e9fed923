"""`python -m benchmarks NAME --out DIR`."""

import argparse
import sys
from pathlib import Path

from benchmarks.examples.options import add_examples
from benchmarks.farm.options import add_farm
from benchmarks.farm.splits import SPLITS
from benchmarks.pictures.options import add_pictures, styles_of
from benchmarks.soak.options import add_soak
from benchmarks.stress.options import add_stress, stress_plan_of
from benchmarks.training.options import add_training, training_plan_of
from benchmarks.whole.options import add_whole, plan_of
from farm.errors import FarmError
from worker.service.exit import end_process


def main(arguments: list[str]) -> int:
    """Run one benchmark and return its exit code: 0 if its results are right."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    commands = parser.add_subparsers(dest="benchmark", required=True)
    shared = argparse.ArgumentParser(add_help=False)
    shared.add_argument("--out", type=Path, required=True, help="folder for the JSON and the plot")
    shared.add_argument("--seed", type=int, default=0, help="seed of all that is drawn at random")
    add_whole(commands, shared)
    add_farm(commands, shared)
    add_pictures(commands, shared)
    add_training(commands, shared)
    masks = commands.add_parser("masks", parents=[shared], help="masks against fine renders")
    masks.add_argument("--images", type=int, help="images of each category")
    add_stress(commands, shared)
    render = commands.add_parser("render", parents=[shared], help="time against error of rendering")
    render.add_argument("--scenes", type=int, help="scenes of each category, for the ladder of samples")
    render.add_argument("--turn-scenes", type=int, help="how many of these scenes to use for single changed settings")
    skips = commands.add_parser("skips", parents=[shared], help="what is left out of a picture, and what that saves")
    skips.add_argument("--scenes", type=int, help="scenes of each category")
    physics = commands.add_parser("physics", parents=[shared], help="time against error of all simulators")
    physics.add_argument("--scenes", type=int, help="most scenes for each setting")
    startup = commands.add_parser("startup", parents=[shared], help="from a worker's start to its first picture")
    startup.add_argument("--starts", type=int, help="number of starts to measure")
    add_soak(commands, shared)
    add_examples(commands, shared)
    surfaces = commands.add_parser("surfaces", parents=[shared], help="what each floor surface costs to render")
    surfaces.add_argument("--scenes", type=int, help="number of scenes to try each surface on")
    surfaces.add_argument(
        "--only", action="append", default=[], metavar="NAME", help="surface to measure; repeat for several"
    )
    options = parser.parse_args(arguments)
    options.out.mkdir(parents=True, exist_ok=True)
    try:
        return _run(options)
    except FarmError as error:
        sys.stderr.write(f"{error}\n")
        return error.exit_code


def _run(options: argparse.Namespace) -> int:
    """Run the chosen benchmark, importing no more than it needs.

    Blender must not be loaded in the stress test's processes. The comparison of simulators must move the process to one
    core before it loads Blender.
    """
    if options.benchmark == "stress":
        from benchmarks.stress.command import run  # noqa: PLC0415

        return run(options.out, stress_plan_of(options))
    if options.benchmark == "physics":
        from benchmarks.physics.command import run as run_physics  # noqa: PLC0415

        return run_physics(options.out, seed=options.seed, scenes=options.scenes)
    if options.benchmark == "startup":
        from benchmarks.startup.command import run as run_startup  # noqa: PLC0415

        return run_startup(options.out, seed=options.seed, starts=options.starts)
    if options.benchmark == "soak":
        from benchmarks.soak.command import run as run_soak  # noqa: PLC0415

        return run_soak(
            options.out,
            seed=options.seed,
            images=options.images,
            quality=options.quality,
            resolution=options.resolution,
        )
    if options.benchmark in {"pictures", "training"}:
        return _run_styles(options)
    return _run_pictures(options)


def _run_styles(options: argparse.Namespace) -> int:
    """Run a benchmark of styles; other processes make the pictures, so this one never loads Blender."""
    if options.benchmark == "training":
        from benchmarks.training.command import run as run_training  # noqa: PLC0415

        return run_training(options.out, training_plan_of(options))
    from benchmarks.pictures.command import run as run_pictures  # noqa: PLC0415

    return run_pictures(
        options.out,
        seed=options.seed,
        images=options.images,
        scenes=options.scenes,
        styles=styles_of(options),
        datasets=options.dataset,
    )


def _run_pictures(options: argparse.Namespace) -> int:
    """Run a benchmark of whole pictures."""
    if options.benchmark == "render":
        from benchmarks.render.command import run as run_render  # noqa: PLC0415

        return run_render(options.out, seed=options.seed, scenes=options.scenes, turn_scenes=options.turn_scenes)
    if options.benchmark == "skips":
        from benchmarks.skips.command import run as run_skips  # noqa: PLC0415

        return run_skips(options.out, seed=options.seed, scenes=options.scenes)
    if options.benchmark == "whole":
        from benchmarks.whole.command import run as run_whole  # noqa: PLC0415

        return run_whole(options.out, plan_of(options))
    if options.benchmark == "farm":
        from benchmarks.farm.command import run as run_farm  # noqa: PLC0415

        return run_farm(options.out, seed=options.seed, images=options.images, splits=options.split or SPLITS)
    if options.benchmark == "masks":
        from benchmarks.masks import command as masks  # noqa: PLC0415

        return masks.run(options.out, images=options.images, seed=options.seed)
    return _run_looks(options)


def _run_looks(options: argparse.Namespace) -> int:
    """Run a benchmark of the look of pictures."""
    if options.benchmark == "examples":
        from benchmarks.examples.command import run as run_examples  # noqa: PLC0415

        return run_examples(options.out, seed=options.seed, each=options.each, groups=options.group, only=options.only)
    from benchmarks.surfaces.command import run as run_surfaces  # noqa: PLC0415

    return run_surfaces(options.out, seed=options.seed, scenes=options.scenes, only=options.only)


if __name__ == "__main__":
    end_process(main(sys.argv[1:]))
