"""Makes a picture's labels: calls the functions that the table of outputs names."""

import pkgutil
from collections.abc import Callable, Iterable, Mapping
from typing import Any, TypeAlias

from farm.dataset.outputs import Output
from worker.geometry import SettledGeometry

Maker: TypeAlias = Callable[[SettledGeometry], Mapping[str, Any]]
"""Makes one label, or several that come from one computation: contents by role. It draws no random number, so that the
same geometry gives the same contents."""


def find_maker(name: str) -> Maker:
    """Find a maker by its `module:function`.

    Raises:
        ImportError: if there is no such module.
        AttributeError: if the module has no such function.
    """
    maker: Maker = pkgutil.resolve_name(name)
    return maker


def make_labels(geometry: SettledGeometry, outputs: Iterable[Output]) -> dict[str, Any]:
    """Make every label among the outputs; each maker is called once.

    Args:
        geometry: geometry of the picture.
        outputs: the outputs that the picture must have; those without a maker are left out.

    Returns:
        Contents by role, in the order of the outputs.
    """
    labels = {output.role: output.maker for output in outputs if output.maker is not None}
    made = {name: find_maker(name)(geometry) for name in dict.fromkeys(labels.values())}
    return {role: made[name][role] for role, name in labels.items()}
