"""`python -m tests.chaos --seed 0 --out results`: faults against a whole farm, and whether it withstands them.

Ends with 0 if every scenario held, else with 1. The files of those that did not are left, and told.
"""

import argparse
import shutil
import sys
import tempfile
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

from rich.console import Console

from benchmarks.terminal import bench_console
from tests.chaos.blender import blender_is_there, for_blender, tiny_header
from tests.chaos.expected import made_before
from tests.chaos.means import lacking, within_means
from tests.chaos.play import Outcome, play
from tests.chaos.report import remarks, table, write_json, write_plot
from tests.chaos.scenarios import BLENDER_SCENARIOS, SCENARIOS, Scenario
from tests.chaos.schedule import draw_schedule
from tests.chaos.upgrade import UPGRADES, Upgrade, play_upgrade

_SIDE_BY_SIDE = 2


def main(arguments: Sequence[str]) -> int:
    """Play the scenarios; print, and write `chaos.json` and `chaos.png`."""
    options = _parser().parse_args(arguments)
    names = {scenario.name for scenario in (*SCENARIOS, *BLENDER_SCENARIOS)} | {upgrade.name for upgrade in UPGRADES}
    if unknown := set(options.only) - names:
        sys.stderr.write(f"no scenario {', '.join(sorted(unknown))}; there are {', '.join(sorted(names))}\n")
        return 2
    options.out.mkdir(parents=True, exist_ok=True)
    console = bench_console()
    folder = Path(tempfile.mkdtemp(prefix="chaos-"))
    start_s = time.monotonic()
    outcomes = _play_stand_ins(_chosen(SCENARIOS, options.only), options.seed, folder, options.jobs, console)
    upgrades = [upgrade for upgrade in UPGRADES if not options.only or upgrade.name in options.only]
    outcomes += _play_upgrades(upgrades, options.seed, folder, options.jobs, console)
    if not options.skip_blender and (of_blender := _chosen(BLENDER_SCENARIOS, options.only)):
        outcomes += _play_blender(of_blender, options.seed, folder, console)
    seconds = time.monotonic() - start_s
    console.print(table(outcomes))
    for line in remarks(outcomes):
        console.print(line)
    console.print(f"{seconds:.0f} s with seed {options.seed}")
    write_json(options.out / "chaos.json", outcomes, options.seed, seconds)
    write_plot(options.out / "chaos.png", outcomes)
    held = all(outcome.held for outcome in outcomes)
    if held:
        shutil.rmtree(folder)
    return 0 if held else 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m tests.chaos", description=__doc__)
    parser.add_argument("--out", type=Path, required=True, help="folder for the JSON and the plot")
    parser.add_argument("--seed", type=int, default=0, help="decides which faults strike when")
    parser.add_argument("--only", action="append", default=[], metavar="NAME", help="this scenario alone; repeat it")
    parser.add_argument("--jobs", type=int, default=_SIDE_BY_SIDE, help="scenarios side by side, but for Blender's")
    parser.add_argument("--skip-blender", action="store_true", help="leave out what needs Blender")
    return parser


def _chosen(scenarios: Sequence[Scenario], only: Sequence[str]) -> list[Scenario]:
    return [scenario for scenario in scenarios if not only or scenario.name in only]


def _tell(outcome: Outcome, console: Console) -> Outcome:
    verdict = "skipped" if outcome.skipped else "held" if outcome.held else "FAILED"
    console.print(f"{outcome.scenario}: {verdict} after {outcome.seconds:.0f} s")
    return outcome


def _play_stand_ins(
    scenarios: Sequence[Scenario], seed: int, folder: Path, side_by_side: int, console: Console
) -> list[Outcome]:
    lacks = lacking()

    def play_one(asked: Scenario) -> Outcome:
        scenario, left_out = within_means(asked, lacks)
        if scenario is None:
            return _tell(Outcome(asked.name, asked.jobs, (), skipped="; ".join(left_out)), console)
        plan, claims = scenario.for_stand_ins(seed)
        events = draw_schedule(seed, scenario.name, scenario.recipes)
        outcome = play(plan, claims, events, folder, scenario.patience_s)
        return _tell(replace(outcome, notes=left_out + outcome.notes), console)

    # The threads live until all is played, since a farm's processes end with the thread that started them.
    with ThreadPoolExecutor(side_by_side) as threads:
        return list(threads.map(play_one, scenarios))


def _play_upgrades(
    upgrades: Sequence[Upgrade], seed: int, folder: Path, side_by_side: int, console: Console
) -> list[Outcome]:
    def play_one(upgrade: Upgrade) -> Outcome:
        return _tell(play_upgrade(upgrade, seed, folder), console)

    with ThreadPoolExecutor(side_by_side) as threads:
        return list(threads.map(play_one, upgrades))


def _play_blender(scenarios: Sequence[Scenario], seed: int, folder: Path, console: Console) -> list[Outcome]:
    if not blender_is_there():
        return [Outcome(scenario.name, scenario.jobs, (), skipped="no bpy here") for scenario in scenarios]
    header = tiny_header(scenarios[0].jobs, seed, folder / "textures")
    calm = BLENDER_SCENARIOS[0]
    outcomes = []
    for scenario in [calm, *(scenario for scenario in scenarios if scenario is not calm)]:
        plan, claims = for_blender(scenario, header, made_before(folder / calm.name / "store" / calm.name))
        events = draw_schedule(seed, scenario.name, scenario.recipes)
        outcome = play(plan, claims, events, folder, scenario.patience_s, keep=scenario is calm)
        outcomes.append(_tell(outcome, console))
    return outcomes


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
