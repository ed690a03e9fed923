"""Who may import whom: one sentence a border, proved over every module that there is."""

import ast
import subprocess
import sys
from collections.abc import Callable

import pytest

from tests.rooms import CircleError, arrows, floors, imports, is_in, modules

TOPS = ("farm", "worker", "blend", "assets", "benchmarks", "tests")
BLENDER = ("bpy", "bmesh", "mathutils", "bpy_extras", "gpu")
BLENDER_ROOMS = ("blend", "worker.blender", "worker.simulate.cloth")


def blender_stays_in_its_rooms(module: str, imported: str) -> bool:
    """Blender's modules are imported in blend, worker.blender and worker.simulate.cloth alone."""
    return is_in(module, *BLENDER_ROOMS) or not is_in(imported, *BLENDER)


def the_farm_knows_no_worker(module: str, imported: str) -> bool:
    """Nothing in farm imports worker or blend."""
    return not (is_in(module, "farm") and is_in(imported, "worker", "blend"))


def only_the_command_line_knows_assets(module: str, imported: str) -> bool:
    """Of farm, the command line alone imports assets."""
    return is_in(module, "farm.cli") or not (is_in(module, "farm") and is_in(imported, "assets"))


def assets_know_errors_and_machine(module: str, imported: str) -> bool:
    """Of our own packages, assets imports its own, farm.errors and farm.machine."""
    ours = is_in(imported, *TOPS)
    return not (is_in(module, "assets") and ours) or is_in(imported, "assets", "farm.errors", "farm.machine")


def the_template_knows_no_worker(module: str, imported: str) -> bool:
    """Nothing in blend imports worker."""
    return not (is_in(module, "blend") and is_in(imported, "worker"))


def only_tests_know_benchmarks(module: str, imported: str) -> bool:
    """The product imports neither benchmarks nor tests; benchmarks import no tests."""
    if is_in(module, "benchmarks"):
        return not is_in(imported, "tests")
    return not is_in(imported, "benchmarks", "tests")


Border = Callable[[str, str], bool]
BORDERS: tuple[Border, ...] = (
    blender_stays_in_its_rooms,
    the_farm_knows_no_worker,
    only_the_command_line_knows_assets,
    assets_know_errors_and_machine,
    the_template_knows_no_worker,
    only_tests_know_benchmarks,
)
BROKEN: dict[Border, tuple[str, str]] = {
    blender_stays_in_its_rooms: ("worker.label.label", "bpy"),
    the_farm_knows_no_worker: ("farm.run.coordinator", "worker.cli"),
    only_the_command_line_knows_assets: ("farm.spec.header", "assets.scan.hdris"),
    assets_know_errors_and_machine: ("assets.files", "farm.model"),
    the_template_knows_no_worker: ("blend.mesh", "worker.colour"),
    only_tests_know_benchmarks: ("worker.simulate.simulate", "benchmarks.physics.gates"),
}


@pytest.mark.parametrize("border", BORDERS, ids=lambda border: border.__name__)
def test_no_module_crosses_a_border(border: Border) -> None:
    """Each border holds for every import of every module, those inside functions included."""
    tops: tuple[str, ...] = ("farm", "worker", "blend", "assets")
    if border is only_tests_know_benchmarks:
        tops = (*tops, "benchmarks")
    crossings = [
        f"{module} imports {imported}"
        for module, file in modules(*tops).items()
        for imported in imports(ast.parse(file.read_text(encoding="utf-8")))
        if not border(module, imported)
    ]
    assert crossings == []


@pytest.mark.parametrize("border", BORDERS, ids=lambda border: border.__name__)
def test_a_crossing_is_found(border: Border) -> None:
    """A border that let everything through would prove nothing."""
    assert not border(*BROKEN[border])


def test_an_import_inside_a_function_is_found() -> None:
    """Imports are found wherever they stand, by every spelling."""
    source = "def f():\n    import worker.cli\n    from benchmarks import physics\n"
    assert list(imports(ast.parse(source))) == ["worker.cli", "benchmarks", "benchmarks.physics"]


@pytest.mark.parametrize("package", ["farm", "worker", "assets", "blend", "benchmarks"])
def test_rooms_form_floors(package: str) -> None:
    """Imports between the rooms of a package run one way: no room imports, however indirectly, one that imports it."""
    assert floors(arrows(package))


def test_a_circle_of_rooms_is_found() -> None:
    """Rooms that import each other form no floors, and the error names the circle."""
    with pytest.raises(CircleError, match="sample -> label -> sample"):
        floors({"sample": frozenset({"label"}), "label": frozenset({"sample"})})


def loaded_by(names: list[str]) -> set[str]:
    """The top-level packages that a fresh interpreter holds after it has imported some modules."""
    program = "import importlib, sys\nfor name in sys.argv[1:]: importlib.import_module(name)\n"
    program += "print(*{name.partition('.')[0] for name in sys.modules})"
    done = subprocess.run([sys.executable, "-c", program, *names], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return set(done.stdout.split())


def test_the_farm_brings_neither_blender_nor_worker() -> None:
    """All modules of farm together load neither Blender nor the packages that use it, however deep."""
    names = [name for name in modules("farm") if not name.endswith("__main__")]
    assert loaded_by(names).isdisjoint({*BLENDER, "worker", "blend", "benchmarks"})


def test_the_service_brings_no_blender() -> None:
    """Celery's main process forks, so nothing in worker.service, nor the worker's command line, loads Blender."""
    names = [name for name in modules("worker") if is_in(name, "worker.service", "worker.cli")]
    assert loaded_by(names).isdisjoint({*BLENDER, "blend"})


def test_numpy_rooms_bring_no_blender() -> None:
    """Every room of worker but those named for Blender can be imported, and so tested, without it."""
    needs = ("worker.blender", "worker.simulate.cloth", "worker.simulate.simulate", "worker.__main__")
    names = [name for name in modules("worker") if not is_in(name, *needs)]
    assert loaded_by(names).isdisjoint({*BLENDER, "blend"})


def test_assets_bring_neither_blender_nor_worker() -> None:
    """Surfaces and panoramas are drawn and checked without Blender and without the packages that use them."""
    assert loaded_by(list(modules("assets"))).isdisjoint({*BLENDER, "blend", "worker"})
