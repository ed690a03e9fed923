"""How much of a picture cables cover, over more scenes than are rendered: labels need no render.

Pictures of a category differ by five points in a hundred, so that the mean of the thirty that a small dataset has of it
is known to a point; what the published examples show is a range of two.
"""

from collections.abc import Iterator

import numpy as np

from farm.spec.category import Category
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from farm.spec.rendering import CableDetail
from worker.label.label import label_scene
from worker.sample.scene import sample_scene
from worker.simulate.rod.fall import drop_cables


def drawn_coverage(header: DatasetHeader, category: Category, scenes: int) -> Iterator[float]:
    """The share of each of a category's first scenes that shows a cable, as rods settle in it.

    Args:
        header: of the dataset.
        category: one of its own.
        scenes: how many; more than the dataset has images of it, if that is wanted.

    Raises:
        SceneError: if a fall diverges.
    """
    for index in range(scenes):
        scene = sample_scene(header, Job(category=category, index=index), 0)
        shapes = drop_cables(scene, header.spec.fall.rod)
        labels = label_scene(scene, shapes, CableDetail(), header.spec.resolution)
        yield float(np.mean(labels.mask > 0))
