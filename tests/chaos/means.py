"""The means that this machine lacks for some faults; a scenario is played without those, or not at all."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.chaos.clock import find_faketime
from tests.chaos.disk import small_disk
from tests.chaos.hang import compile_library
from tests.chaos.scenarios import Scenario
from tests.chaos.schedule import Fault


def lacking() -> Mapping[Fault, str]:
    """The faults that this machine has no means for, each with the reason."""
    found = {}
    if find_faketime() is None:
        found[Fault.JUMP_CLOCK] = "setting clocks wrong needs Debian's package libfaketime"
    with TemporaryDirectory() as folder, small_disk(Path(folder), 1) as disk:
        if isinstance(disk, str):
            found[Fault.FILL_DISK] = disk
    with TemporaryDirectory() as folder:
        library = compile_library(Path(folder))
        if isinstance(library, str):
            found[Fault.HANG_STORE] = library
    return found


def within_means(scenario: Scenario, lacks: Mapping[Fault, str]) -> tuple[Scenario | None, tuple[str, ...]]:
    """Reduce a scenario to the faults that this machine can play.

    Returns:
        The scenario, None if nothing is left of it; and the faults that were left out, each with the reason.
    """
    left_out = [recipe.fault for recipe in scenario.recipes if recipe.fault in lacks]
    if not left_out:
        return scenario, ()
    reasons = tuple(f"without '{fault}': {lacks[fault]}" for fault in dict.fromkeys(left_out))
    recipes = [recipe for recipe in scenario.recipes if recipe.fault not in lacks]
    if not recipes:
        return None, reasons
    faults = {recipe.fault for recipe in recipes}
    reduced = replace(
        scenario,
        recipes=recipes,
        with_clock=Fault.JUMP_CLOCK in faults,
        with_disk=Fault.FILL_DISK in faults,
        with_hang=Fault.HANG_STORE in faults,
    )
    return reduced, reasons
