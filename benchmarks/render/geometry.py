"""Time and error of the geometries that a cable can have in Cycles: the farm's tube, a bevelled curve, a thick hair.

Textures run differently along each, so the cables are plain here. Pictures are compared with that of a very fine tube
at the same samples, so they differ by the geometry, and by the noise where it moved.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from rich import box
from rich.table import Table

from benchmarks.render.errors import errors
from benchmarks.render.stage_set import SettledScene, Stage
from benchmarks.render.variants import BASE
from blend import names
from farm.spec.rendering import CableDetail, PictureSettings
from worker.curves import Points, smooth

_FINE = CableDetail(sides=64, points_per_segment=10)
"""The very fine tube that others are compared with."""

_BEVEL_RESOLUTION = 8
"""Blender's resolution of a curve's bevel that gives 20 sides."""


@dataclass(frozen=True, slots=True)
class GeometryRow:
    """A kind of geometry on one scene.

    Attributes:
        kind: name of the kind.
        cables: number of cables in the scene.
        build_s: seconds to build the scene with this geometry.
        render_s: seconds to render it.
        flip: mean FLIP against a very fine tube at the same samples.
    """

    kind: str
    cables: int
    build_s: float
    render_s: float
    flip: float


def compare_geometry(stage: Stage, scenes: Sequence[SettledScene]) -> list[GeometryRow]:
    """Render scenes with each kind of geometry."""
    rows = []
    for settled in scenes:
        stage.set(settled, _with(_FINE))
        _make_plain()
        reference = stage.render()
        for kind, detail, build in _KINDS:
            start = time.perf_counter()
            stage.set(settled, _with(detail))
            if build is not None:
                _replace_tubes(settled, build)
            built = time.perf_counter()
            _make_plain()
            begin = time.perf_counter()
            picture = stage.render()
            rows.append(
                GeometryRow(
                    kind=kind,
                    cables=len(settled.shapes.nodes_m),
                    build_s=built - start,
                    render_s=time.perf_counter() - begin,
                    flip=errors(picture, reference).flip,
                )
            )
    return rows


def geometry_table(rows: Sequence[GeometryRow]) -> Table:
    """Mean seconds and FLIP of each kind."""
    table = Table(title="geometry of cables, against a tube of 64 sides at the same samples", box=box.SIMPLE_HEAD)
    for name in ("kind", "set the scene s", "render s", "FLIP"):
        table.add_column(name, justify="left" if name == "kind" else "right")
    for kind in dict.fromkeys(row.kind for row in rows):
        those = [row for row in rows if row.kind == kind]
        figures = ([row.build_s for row in those], [row.render_s for row in those], [row.flip for row in those])
        table.add_row(kind, *(f"{np.mean(figure):.4f}" for figure in figures))
    return table


def _with(detail: CableDetail) -> PictureSettings:
    return BASE.model_copy(update={"detail": detail})


def _cables() -> list[Any]:
    return [item for item in bpy.data.objects if item.name.startswith(f"{names.CABLE}.")]


def _make_plain() -> None:
    """Make the cables' pattern of dirt uniform."""
    for material in bpy.data.materials:
        if material.name.startswith(f"{names.CABLE}."):
            material.node_tree.nodes[names.CABLE_MAPPING].inputs["Scale"].default_value = (0.0, 0.0, 0.0)


def _replace_tubes(settled: SettledScene, build: Callable[[str, Points, float], Any]) -> None:
    """Replace the tubes by other geometry with the same materials."""
    scene = bpy.data.scenes[names.PICTURE_SCENE]
    for tube in _cables():
        bpy.data.objects.remove(tube)
    for number, (nodes, radius) in enumerate(zip(settled.shapes.nodes_m, settled.shapes.radii_m, strict=True), start=1):
        data = build(f"{names.CABLE}.{number}", nodes, float(radius))
        data.materials.append(bpy.data.materials[f"{names.CABLE}.{number}"])
        scene.collection.objects.link(bpy.data.objects.new(f"{names.CABLE}.{number}", data))


def _bevelled_curve(name: str, nodes: Points, radius_m: float) -> Any:
    curve = bpy.data.curves.new(name, "CURVE")
    curve.dimensions = "3D"
    curve.bevel_depth, curve.bevel_resolution, curve.use_fill_caps = radius_m, _BEVEL_RESOLUTION, True
    points = smooth(nodes, CableDetail().points_per_segment)
    spline = curve.splines.new("POLY")
    spline.points.add(len(points) - 1)
    spline.points.foreach_set("co", np.column_stack([points, np.ones(len(points))]).astype(np.float32).ravel())
    spline.use_smooth = True
    return curve


def _hair(name: str, nodes: Points, radius_m: float) -> Any:
    """A hair through a cable's nodes; Cycles itself smooths it between them."""
    hair = bpy.data.hair_curves.new(name)
    hair.add_curves([len(nodes)])
    hair.attributes["position"].data.foreach_set("vector", nodes.astype(np.float32).ravel())
    radius = hair.attributes.get("radius") or hair.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", np.full(len(nodes), radius_m, np.float32))
    bpy.data.scenes[names.PICTURE_SCENE].cycles_curves.shape = "THICK"
    return hair


_KINDS: Sequence[tuple[str, CableDetail, Callable[[str, Points, float], Any] | None]] = (
    ("tube, 20 sides", CableDetail(), None),
    ("tube, 12 sides, 3 rings", CableDetail(sides=12, points_per_segment=3), None),
    ("tube, 6 sides, 1 ring", CableDetail(sides=6, points_per_segment=1), None),
    ("bevelled curve, 20 sides", CableDetail(), _bevelled_curve),
    ("hair", CableDetail(), _hair),
)
