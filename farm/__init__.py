"""A render farm for labelled pictures of cables: planning, queue, storage and command line.

This package knows what a dataset is. It never imports Blender, nor the packages that use it.
"""

__version__ = "0.2.0"
