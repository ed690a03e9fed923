"""Adding named shader nodes and linking them."""

from typing import Any


def add_node(tree: Any, kind: str, name: str, location: tuple[float, float], **settings: Any) -> Any:
    """Add a node of type `kind` under `name` (also its label) and set its attributes."""
    node = tree.nodes.new(kind)
    node.name = node.label = name
    node.location = location
    for attribute, value in settings.items():
        setattr(node, attribute, value)
    return node


def link(tree: Any, source: Any, output: str | int, target: Any, target_input: str | int) -> None:
    """Connect an output of one node with an input of another."""
    tree.links.new(source.outputs[output], target.inputs[target_input])
