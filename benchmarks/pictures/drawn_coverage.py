"""The share of a picture that cables cover, over more scenes than are rendered, since labels need no render.

The coverage of a category's pictures has a standard deviation of five percentage points. A small dataset has thirty of
them, so its mean is known only to one point, while the published examples span two.
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
    """The share of pixels that show a cable, for each of a category's first scenes, settled by the rod solver.

    Args:
        header: header of the dataset.
        category: a category of the dataset.
        scenes: number of scenes, which may exceed the dataset's images.

    Raises:
        SceneError: if a fall diverges.
    """
    for index in range(scenes):
        scene = sample_scene(header, Job(category=category, index=index), 0)
        shapes = drop_cables(scene, header.spec.fall.rod)
        labels = label_scene(scene, shapes, CableDetail(), header.spec.resolution)
        yield float(np.mean(labels.mask > 0))
