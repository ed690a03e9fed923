"""The share of a picture that cables cover, over more scenes than are rendered, since labels need no render.

Coverage differs by five percentage points between pictures of a category, so the mean of the thirty that a small
dataset has of it is known to a point; the published examples range over two points.
"""

from collections.abc import Iterator

import numpy as np

from farm.spec.category import Category
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from farm.spec.rendering import CableDetail
from worker.geometry import SettledGeometry
from worker.label.label import label_scene
from worker.sample.scene import sample_scene
from worker.simulate.rod.fall import drop_cables


def drawn_coverage(header: DatasetHeader, category: Category, scenes: int) -> Iterator[float]:
    """The share of pixels that show a cable, for each of a category's first scenes, settled by the rod solver.

    Args:
        header: the dataset's header.
        category: one of the dataset's categories.
        scenes: number of scenes; it may exceed the dataset's images of the category.

    Raises:
        SceneError: if a fall diverges.
    """
    for index in range(scenes):
        scene = sample_scene(header, Job(category=category, index=index), 0)
        shapes = drop_cables(scene, header.spec.fall.rod)
        geometry = SettledGeometry(scene, shapes, CableDetail(), header.spec.resolution)
        yield float(np.mean(label_scene(geometry).mask > 0))
